"""What `run.py` decides, without a network and without touching the machine."""

import importlib.util
import os
import subprocess
import sys
import types
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
POSIX = pytest.mark.skipif(os.name == "nt", reason="shell scripts stand in for programs")


@pytest.fixture
def run(tmp_path, monkeypatch):
    """`run.py` of a checkout in an empty folder."""
    spec = importlib.util.spec_from_file_location("run", ROOT / "run.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for name, place in {"HERE": "", "VENV": ".venv", "STAMP": ".venv/stamp", "PYTHON": ".venv/python"}.items():
        monkeypatch.setattr(module, name, str(tmp_path / place))
    lock = tmp_path / "requirements.lock"
    lock.write_text("numpy==2.0\n")
    monkeypatch.setattr(module, "LOCK", str(lock))
    return module


@pytest.fixture
def complete(run):
    """The same, set up."""
    venv = Path(run.VENV)
    venv.mkdir()
    Path(run.PYTHON).touch()
    Path(run.STAMP).write_text(run.key())
    return run


@pytest.fixture
def programs(tmp_path, monkeypatch):
    """The only folder on PATH; gives a function that puts a shell script there."""
    folder = tmp_path / "programs"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))

    def add(name, script):
        (folder / name).write_text(f"#!/bin/sh\n{script}\n")
        (folder / name).chmod(0o755)

    return add


def test_a_finished_environment_is_current(complete):
    assert complete.current()


def test_changed_code_needs_no_new_environment(complete):
    (Path(complete.HERE) / "engine").mkdir()
    (Path(complete.HERE) / "engine" / "new.py").touch()
    assert complete.current()


def test_an_environment_without_stamp_is_not_current(complete):
    Path(complete.STAMP).unlink()
    assert not complete.current()


def test_an_environment_whose_python_is_gone_is_not_current(complete):
    Path(complete.PYTHON).unlink()
    assert not complete.current()


def test_other_pins_need_a_new_environment(complete):
    Path(complete.LOCK).write_text("numpy==2.1\n")
    assert not complete.current()


def test_another_folder_needs_a_new_environment(complete, monkeypatch):
    monkeypatch.setattr(complete, "HERE", "/elsewhere")
    assert not complete.current()


def test_another_python_needs_a_new_environment(complete, monkeypatch):
    monkeypatch.setattr(complete.sys, "version_info", (3, 99, 0))
    assert not complete.current()


def test_a_failed_installation_leaves_no_stamp(complete, monkeypatch):
    Path(complete.LOCK).write_text("numpy==2.1\n")
    results = iter([0, 1])  # venv, pip
    monkeypatch.setattr(complete.subprocess, "call", lambda *_, **__: next(results))
    with pytest.raises(SystemExit, match="network"):
        complete.make_environment()
    assert not Path(complete.STAMP).exists()


def test_only_one_start_at_a_time_sets_up(run):
    ask = (
        "import importlib.util, sys\n"
        f"spec = importlib.util.spec_from_file_location('run', {str(ROOT / 'run.py')!r})\n"
        "run = importlib.util.module_from_spec(spec)\n"
        "spec.loader.exec_module(run)\n"
        f"print(run.locked(open({run.VENV + '.lock'!r}, 'a+')))\n"
    )
    with run.alone():
        during = subprocess.run([sys.executable, "-c", ask], capture_output=True, text=True, check=True)
    after = subprocess.run([sys.executable, "-c", ask], capture_output=True, text=True, check=True)
    assert (during.stdout.strip(), after.stdout.strip()) == ("False", "True")


def test_the_engines_commands_need_no_system_library(complete, monkeypatch):
    monkeypatch.setattr("hullquad_app.libraries.missing", lambda: ["libEGL.so.1"])
    for command in ("mesh", "optimize", "quality", "--help", "--version"):
        assert complete.missing_packages([command]) == ([], [])


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have what Qt needs")
@pytest.mark.parametrize("arguments", [[], ["plate.json"], ["picture"], ["test"]])
def test_the_window_needs_system_libraries(complete, monkeypatch, arguments):
    monkeypatch.setattr("hullquad_app.libraries.missing", lambda: ["libEGL.so.1"])
    sonames, packages = complete.missing_packages(arguments)
    assert sonames == ["libEGL.so.1"]
    assert "libegl1" in packages


@POSIX
@pytest.mark.skipif(sys.platform != "linux", reason="a virtual screen is a matter of X")
def test_the_tests_need_a_virtual_screen(complete, programs):
    assert "xvfb" in complete.missing_packages(["test"])[1]
    programs("Xvfb", "true")
    assert "xvfb" not in complete.missing_packages(["test"])[1]


@POSIX
def test_without_rights_the_exact_command_is_said(run, programs, monkeypatch):
    programs("apt-get", "exit 1")
    monkeypatch.setattr(run.os, "geteuid", lambda: 1000)
    with pytest.raises(SystemExit) as end:
        run.install(["libEGL.so.1"], ["libegl1", "xvfb"])
    assert "sudo apt-get install -y --no-install-recommends libegl1 xvfb" in end.value.code
    assert "libEGL.so.1" in end.value.code


@POSIX
def test_root_installs_without_being_asked(run, programs, monkeypatch, tmp_path):
    programs("env", f'echo "$@" >> {tmp_path}/calls')
    programs("apt-get", "")
    monkeypatch.setattr(run.os, "geteuid", lambda: 0)
    run.install([], ["xvfb"])
    update, install = (tmp_path / "calls").read_text().splitlines()
    assert update.endswith("update")
    assert install.endswith("install -y --no-install-recommends xvfb")


@POSIX
def test_sudo_asks_first(run, programs, monkeypatch):
    for name in ("apt-get", "sudo"):
        programs(name, "exit 1")
    monkeypatch.setattr(run.os, "geteuid", lambda: 1000)
    monkeypatch.setattr(run.sys, "stdin", types.SimpleNamespace(isatty=lambda: True))
    monkeypatch.setattr("builtins.input", lambda _: "n")
    with pytest.raises(SystemExit, match="sudo apt-get install"):
        run.install([], ["xvfb"])


@POSIX
def test_another_interpreter_is_found_by_running_it(run, programs):
    programs("python3.13", "echo 'no such version is chosen' >&2; exit 127")
    programs("python3.12", "echo 3.12; echo /opt/python3.12")
    assert run.other_python() == "/opt/python3.12"


@POSIX
def test_an_old_interpreter_says_what_to_install(run, programs, monkeypatch, capsys):
    monkeypatch.setattr(run.sys, "version_info", (3, 10, 1))
    assert run.main([]) == 1
    assert "3.11, 3.12 or 3.13" in capsys.readouterr().err


@POSIX
def test_exit_codes_are_passed_on(run, programs):
    ask = f"import sys; sys.path.insert(0, {str(ROOT)!r}); import run; run.become([sys.executable, '-c', 'exit(7)'])"
    assert subprocess.run([sys.executable, "-B", "-c", ask], check=False).returncode == 7
