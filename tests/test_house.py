"""The rules of the house: the tools are content, and the contracts would notice."""

import ast
import os
import re
import shutil
import statistics
import subprocess
import sys
import sysconfig
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PRODUCT = sorted([*(ROOT / "engine").rglob("*.py"), *(ROOT / "app").rglob("*.py")])
LINT_IMPORTS = str(Path(sysconfig.get_path("scripts")) / "lint-imports")
MACHINE_PATH = re.compile(r"(?<![\w.])(?:/(?:home|root|Users|work|builds)/\w|[A-Z]:\\Users\\)")
VIOLATIONS = {
    "The rooms of the engine: each knows only those below": ("engine/hullquad/arrays.py", "hullquad.mesh"),
    "The engine is headless": ("engine/hullquad/mesh.py", "PySide6"),
    "Only the Delaunay module knows Triangle": ("engine/hullquad/mesh.py", "triangle"),
    "The app keeps matplotlib, meshio and whole VTK out": ("app/hullquad_app/window.py", "matplotlib"),
}


def demand(*command, **environment):
    """Fail with what a tool has to say."""
    text = complaints(*command, **environment)
    if text:
        pytest.fail(text, pytrace=False)


def complaints(*command, cwd=ROOT, **environment):
    """What a tool has to say, empty when it is content."""
    done = subprocess.run(
        command, cwd=cwd, capture_output=True, text=True, encoding="utf-8", check=False, env=os.environ | environment
    )
    return done.stdout + done.stderr if done.returncode else ""


def broken_contracts(text):
    """Names of the import contracts that a report calls broken."""
    return {name for name in VIOLATIONS if re.search(rf"^{re.escape(name)}\s+BROKEN", text, re.MULTILINE)}


def tracked_files():
    """Paths of the text files under version control."""
    if not (ROOT / ".git").exists() or not shutil.which("git"):
        pytest.skip("not a git checkout, or a machine without git")
    names = subprocess.check_output(["git", "ls-files", "-z"], cwd=ROOT, text=True).split("\0")
    suffixes = {".py", ".md", ".toml", ".lock", ".json", ".yml", ".yaml", ".txt", ""}
    return [ROOT / name for name in names if name and Path(name).suffix in suffixes and (ROOT / name).is_file()]


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """Engine and app in a folder where they may be spoilt."""
    folder = tmp_path_factory.mktemp("house")
    for name in ("engine", "app"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", folder)
    return folder


def test_the_code_is_formatted():
    demand(sys.executable, "-m", "ruff", "format", "--diff", "--quiet", ".")


def test_the_linter_is_content():
    demand(sys.executable, "-m", "ruff", "check", "--quiet", ".")


def test_the_types_fit():
    demand(sys.executable, "-m", "mypy")


def test_imports_keep_the_contracts():
    demand(LINT_IMPORTS, PYTHONUTF8="1")


def test_every_contract_has_a_violation_to_notice():
    assert set(VIOLATIONS) == {contract["name"] for contract in PROJECT["tool"]["importlinter"]["contracts"]}


@pytest.mark.parametrize("contract", VIOLATIONS)
def test_a_contract_notices_its_violation(contract, copy):
    file, module = VIOLATIONS[contract]
    text = (copy / file).read_text(encoding="utf-8")
    (copy / file).write_text(f"{text}\nimport {module}\n", encoding="utf-8")
    sources = os.pathsep.join(str(copy / name) for name in ("engine", "app"))
    report = complaints(LINT_IMPORTS, "--no-cache", cwd=copy, PYTHONPATH=sources, PYTHONUTF8="1")
    (copy / file).write_text(text, encoding="utf-8")
    assert broken_contracts(report) == {contract}, report


def test_the_engine_prints_nothing_but_on_its_command_line():
    calls = [
        f"{path.relative_to(ROOT)}:{node.lineno}"
        for path in PRODUCT
        if path.is_relative_to(ROOT / "engine") and "cli" not in (path.stem, path.parent.name)
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Name) and node.id == "print"
    ]
    assert calls == []


def test_modules_are_short():
    assert statistics.median(len(path.read_text(encoding="utf-8").splitlines()) for path in PRODUCT) < 150


def test_the_version_is_the_same_everywhere():
    engine = (ROOT / "engine" / "hullquad" / "__init__.py").read_text(encoding="utf-8")
    assert f'__version__ = "{PROJECT["project"]["version"]}"' in engine


def test_the_pins_name_no_registry():
    lock = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    assert re.findall(r"https?:|file:|--index-url|--extra-index-url|--find-links", lock) == []


def test_no_file_names_a_path_of_one_machine():
    found = [
        f"{path.relative_to(ROOT)}: {line.strip()}"
        for path in tracked_files()
        for line in path.read_text(encoding="utf-8", errors="replace").splitlines()
        if MACHINE_PATH.search(line)
    ]
    assert found == []


def test_no_commit_names_a_path_of_one_machine():
    tracked_files()
    messages = subprocess.check_output(["git", "log", "--format=%B"], cwd=ROOT, text=True, encoding="utf-8")
    assert [line for line in messages.splitlines() if MACHINE_PATH.search(line)] == []
