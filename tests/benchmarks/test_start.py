"""From the start of the process to the empty window, and to the first frame of a plate beside a bare script."""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

PLATE = Path(__file__).parents[2] / "assets" / "plates" / "hopper_partition.json"

EMPTY_WINDOW = """
    from PySide6.QtCore import QTimer
    from PySide6.QtWidgets import QApplication
    from hullquad_app.session import Session
    from hullquad_app.window import MainWindow
    application = QApplication([])
    application.setStyle("Fusion")
    window = MainWindow(Session())
    window.show()
    QTimer.singleShot(0, lambda: os._exit(0))
    application.exec()
"""
FIRST_FRAME = """
    from pathlib import Path
    from PySide6.QtWidgets import QApplication
    from hullquad_app.session import Session
    from hullquad_app.window import MainWindow
    application = QApplication([])
    window = MainWindow(Session())
    window.show()
    window.canvas.painted.connect(lambda _: os._exit(0) if window.session.document.scene.state.keys else None)
    window.start()
    window.filing.open(Path(sys.argv[1]))
    application.exec()
"""
BARE_SCRIPT = """
    import pyvista
    from PySide6.QtCore import QTimer
    from PySide6.QtWidgets import QApplication, QMainWindow
    from pyvistaqt import QtInteractor
    application = QApplication([])
    window = QMainWindow()
    view = QtInteractor(window, auto_update=False, multi_samples=0)
    window.setCentralWidget(view)
    view.add_mesh(pyvista.Plane(), show_edges=True, lighting=False)
    window.show()
    application.processEvents()
    view.render()
    os._exit(0)
"""


def started(code: str) -> None:
    """Run a script in a process of its own until it ends itself."""
    script = "import os, sys\n" + textwrap.dedent(code)
    environment = {**os.environ, "QT_QPA_PLATFORM": "xcb"}
    subprocess.run([sys.executable, "-c", script, PLATE], check=True, env=environment, timeout=120)


@pytest.mark.benchmark(group="process start to the empty window")
def test_empty_window(benchmark, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    benchmark.pedantic(started, (EMPTY_WINDOW,), rounds=5, warmup_rounds=1)


@pytest.mark.parametrize("code", [FIRST_FRAME, BARE_SCRIPT], ids=["window with a plate", "bare pyvistaqt script"])
@pytest.mark.benchmark(group="process start to the first frame")
def test_first_frame(benchmark, code, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    benchmark.pedantic(started, (code,), rounds=5, warmup_rounds=1)
