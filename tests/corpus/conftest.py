"""How many plates of the corpus are meshed."""


def pytest_addoption(parser):
    parser.addoption("--plates", type=int, default=100, help="so many of the 2000 plates of the corpus")
