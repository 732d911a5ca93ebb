"""The tables in the documentation are the program's own."""

import importlib.util
from pathlib import Path

import pytest

from hullquad.metrics import METRICS
from hullquad.rules import rule_sets

ASSETS = Path(__file__).parents[2] / "assets"


@pytest.fixture(scope="module")
def make_tables():
    """The script that writes them."""
    specification = importlib.util.spec_from_file_location("make_tables", ASSETS / "make_tables.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", ["metrics.md", "rules.md"])
def test_the_pages_are_as_the_program_would_write_them(name, make_tables):
    written = (ASSETS / "docs" / name).read_text(encoding="utf-8")
    assert written.splitlines() == make_tables.text(name).splitlines(), "run assets/make_tables.py"


def test_every_metric_and_every_rule_stands_on_its_page(make_tables):
    metrics, rules = map(make_tables.text, make_tables.PAGES)
    assert all(f"| `{row.key}` | {row.title}" in metrics for row in METRICS)
    for found in rule_sets():
        assert f"`{found.key}`" in rules
        assert all(rule.text in rules for rule in found.rules)
