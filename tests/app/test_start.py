"""Starting the program: what it says when it cannot, what it loads, what it leaves behind."""

import os
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest

HEAVY = ("PySide6", "pyvista", "vtk", "vtkmodules", "numba", "scipy.optimize", "matplotlib", "ezdxf")
SHOWING = ("PySide6", "shiboken6", "pyvista", "pyvistaqt", "vtk", "vtkmodules", "matplotlib")
LINUX = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a screen is taken for granted")


def python(code, **environment):
    """Run code in a Python of its own."""
    kept = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "QT_QPA_PLATFORM")}
    command = [sys.executable, "-c", code]
    return subprocess.run(command, capture_output=True, text=True, check=False, env=kept | environment)


def loaded(code, modules):
    """Those of `modules` that are imported after `code`."""
    answer = python(f"{code}\nimport sys; print('loaded:', *(set(sys.modules) & set({modules!r})))")
    assert answer.returncode == 0, answer.stderr
    return answer.stdout.rpartition("loaded:")[2].split()


def hullquad(*arguments):
    """Code that runs the command and survives its end."""
    return f"from hullquad_app.main import main\ntry: main({list(arguments)!r})\nexcept SystemExit: pass"


def test_pyside_is_in_the_range_that_works():
    assert (6, 8) <= tuple(int(part) for part in version("PySide6-Essentials").split(".")[:2]) < (6, 12)


def test_importing_the_program_loads_nothing_heavy():
    assert loaded("import hullquad_app.main", HEAVY) == []


@pytest.mark.parametrize("arguments", [("--help",), ("--version",)])
def test_asking_for_help_loads_nothing_heavy(arguments):
    assert loaded(hullquad(*arguments), HEAVY) == []


@pytest.mark.parametrize("command", ["mesh", "optimize", "quality"])
def test_the_help_of_engine_commands_loads_nothing_heavy(command):
    assert loaded(hullquad(command, "--help"), HEAVY) == []


def test_showing_the_empty_window_loads_nothing_for_plates(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    code = (
        "import os\nos.environ['QT_QPA_PLATFORM'] = 'offscreen'\n"
        "from PySide6.QtCore import QTimer\nfrom PySide6.QtWidgets import QApplication\n"
        "from hullquad_app.session import Session\nfrom hullquad_app.window import MainWindow\n"
        "application = QApplication([])\nwindow = MainWindow(Session())\nwindow.show()\n"
        "QTimer.singleShot(0, application.quit)\napplication.exec()"
    )
    assert loaded(code, ("scipy", "shapely", "numba", "pyvista", "pyvistaqt", "vtkmodules", "matplotlib", "PIL")) == []


def test_opening_a_plate_waits_for_nothing_that_meshing_needs():
    plate = Path(__file__).parents[2] / "assets" / "plates" / "hopper_partition.json"
    code = f"from pathlib import Path\nfrom hullquad.formats import read_plates\nread_plates(Path({str(plate)!r}))"
    assert loaded(code, ("scipy", "numba")) == []


def test_importing_the_engine_loads_nothing_that_shows():
    engine = (
        "import hullquad, pkgutil\n"
        "for found in pkgutil.walk_packages(hullquad.__path__, 'hullquad.'):\n"
        "    if not found.name.endswith('__main__'): __import__(found.name)"
    )
    assert loaded(engine, SHOWING) == []


@LINUX
def test_without_a_screen_it_says_so():
    answer = python("import sys\nfrom hullquad_app.main import main\nsys.exit(main([]))")
    assert answer.returncode == 1
    assert answer.stderr.startswith("hullquad: no screen")


@LINUX
def test_a_missing_library_is_named_with_its_package():
    answer = python(
        "import sys\nfrom hullquad_app import libraries, main\n"
        "libraries.missing = lambda: ['libEGL.so.1']\nsys.exit(main.main([]))",
        QT_QPA_PLATFORM="offscreen",
    )
    assert answer.returncode == 1
    assert "libegl1" in answer.stderr
    assert "libEGL.so.1" in answer.stderr


@LINUX
def test_it_shows_a_window_and_keeps_a_log(tmp_path):
    code = (
        "import sys\nfrom pathlib import Path\nfrom PySide6.QtCore import QTimer\n"
        "from hullquad_app import application\n"
        f"application.log_folder = lambda: Path({str(tmp_path)!r}) / 'logs'\n"
        "def fail():\n    QTimer.singleShot(0, lambda: application.QApplication.exit(0))\n    raise ValueError('odd')\n"
        "QTimer.singleShot(0, fail)\n"
        "sys.exit(application.show([]))"
    )
    answer = python(code, QT_QPA_PLATFORM="xcb", DISPLAY=os.environ["DISPLAY"], XDG_CONFIG_HOME=str(tmp_path))
    log = (tmp_path / "logs" / "hullquad.log").read_text()
    assert answer.returncode == 0, answer.stderr
    assert "INFO root: HullQuad" in log
    assert "ValueError: odd" in log


def test_a_crash_leaves_a_trace(tmp_path):
    code = (
        "from pathlib import Path\nimport faulthandler\nfrom hullquad_app.logs import start_logging\n"
        f"start_logging(Path({str(tmp_path)!r}))\nfaulthandler._sigabrt()"
    )
    assert python(code).returncode != 0
    assert "Fatal Python error" in (tmp_path / "crash.log").read_text()


def test_a_log_that_cannot_be_kept_stops_nothing(tmp_path):
    (tmp_path / "file").touch()
    code = (
        "from pathlib import Path\nfrom hullquad_app.logs import start_logging\n"
        f"start_logging(Path({str(tmp_path)!r}) / 'file' / 'logs')"
    )
    answer = python(code)
    assert answer.returncode == 0
    assert "no log is kept" in answer.stderr


@LINUX
@pytest.mark.parametrize("words", [["picture", "no.vtu", "-o", "no.png"], ["quality", "no.vtu"]])
def test_an_interrupt_while_libraries_load_is_quiet(words):
    interrupting = "import os, signal, sys; sys.meta_path.insert(0, type('Ctrl', (), {'find_spec': find})()); "
    finder = "def find(_, name, *__):\n    if name == 'numpy': os.kill(os.getpid(), signal.SIGINT)\n"
    done = python(f"{finder}{interrupting}from hullquad_app.main import main; sys.exit(main({words}))")
    assert (done.returncode, done.stderr) == (130, "")
