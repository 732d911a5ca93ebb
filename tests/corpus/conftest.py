"""How many plates of the corpus are meshed, and what is told of them at the end."""


def pytest_addoption(parser):
    parser.addoption("--plates", type=int, default=100, help="so many of the 2000 plates of the corpus")


def pytest_terminal_summary(terminalreporter):
    reports = [report for kind in ("passed", "failed") for report in terminalreporter.stats.get(kind, [])]
    for report in reports:
        for name, text in report.user_properties:
            if name == "corpus" and report.when == "call":
                terminalreporter.write_line(f"corpus: {text}")
