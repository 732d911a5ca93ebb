"""From the start of the process to the empty window, and to the first frame of a plate beside a bare script.

Warm: the start before has left the bytecode of all modules, as Python does unless it is told not to.
"""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

PLATE = Path(__file__).parents[2] / "assets" / "plates" / "hopper_partition.json"

EMPTY_WINDOW = """
    from functools import partial
    from PySide6.QtCore import QTimer
    from hullquad_app import application, main
    leave = lambda window: QTimer.singleShot(0, lambda: os._exit(0))
    application.show = partial(application.show, watch=leave)
    main.main([])
"""
FIRST_FRAME = """
    from functools import partial
    from hullquad_app import application, main
    def leave(window):
        seen = lambda _: os._exit(0) if window.session.document.scene.state.keys else None
        window.canvas.painted.connect(seen)
    application.show = partial(application.show, watch=leave)
    main.main(sys.argv[1:])
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
    environment = {**os.environ, "QT_QPA_PLATFORM": "xcb", "PYTHONDONTWRITEBYTECODE": ""}
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
