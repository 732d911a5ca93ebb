"""Watching a run: frames per second, and how long the window does not answer, beside a bare PyVista view.

A paint is all that one frame has painted: VTK's drawing of the plate, and every repaint of the window until the next
drawing, by Qt's own measure (the event `UpdateRequest`: view, panels, and handing both to the screen). What computes
or lists is no part of it. A heartbeat is a timer of 10 ms; no gap between two of its beats can be shorter than that.
Qt's own loop runs as in the program: `QTest.qWait` would sleep 10 ms after every look at what waits.
"""

import os
import statistics
import sys
import time

if sys.platform.startswith("linux"):
    os.environ.setdefault("QT_QPA_PLATFORM", "xcb")

import numpy as np
import pytest
import pyvista
from PySide6.QtCore import QEvent, QEventLoop, QSettings, QTimer
from PySide6.QtTest import QTest

from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.optimization.paper import PaperSettings, unmoved
from hullquad_app.scene import State
from hullquad_app.search import Search
from hullquad_app.session import Session
from hullquad_app.settings import Settings
from hullquad_app.track import Track
from hullquad_app.window import MainWindow

SECONDS = 6.0
SIZES = (1000, 10_000, 100_000)


class MeasuredWindow(MainWindow):
    """The window, with the seconds of every repaint."""

    def __init__(self, session):
        super().__init__(session)
        self.frames = []
        self.canvas.painted.connect(self.frames.append)

    def event(self, happening):
        start = time.perf_counter()
        result = super().event(happening)
        if happening.type() == QEvent.Type.UpdateRequest and self.frames:
            self.frames[-1] += time.perf_counter() - start
        return result


@pytest.fixture
def window(qapp, tmp_path):
    window = MeasuredWindow(Session(Settings(QSettings(str(tmp_path / "s.ini"), QSettings.Format.IniFormat))))
    window.resize(1440, 900)
    window.show()
    window.start()
    while window.session.workshop.jobs.preparing.is_running:
        QTest.qWait(20)
    yield window
    window.session.stop_and_wait()
    window.session.document.edits.setClean()
    window.close()
    window.deleteLater()


@pytest.mark.parametrize("quads", SIZES)
def test_watching_a_run(window, shaken_grid, quads, capsys):
    session, gaps = window.session, []
    session.set_search(Search(optimizer="paper"))
    session.set_paper(PaperSettings(iterations=10**6, tolerance=0.0))
    mesh = shaken_grid(quads)
    session.document.open(State(title="grid", tracks={"grid": Track((unmoved(mesh, metric("stretch")),))}))
    QTest.qWait(500)
    window.frames.clear()
    beat = QTimer(interval=10)
    last = time.perf_counter()

    def note() -> None:
        nonlocal last
        now = time.perf_counter()
        gaps.append(now - last)
        last = now

    beat.timeout.connect(note)
    session.run()
    beat.start()
    start, cpu = time.perf_counter(), time.process_time()
    loop = QEventLoop()
    QTimer.singleShot(int(1000 * SECONDS), loop.quit)
    loop.exec()
    beat.stop()
    seconds, cpu = time.perf_counter() - start, time.process_time() - cpu
    session.pause()
    iterates = session.document.scene.track.last.number
    while session.document.scene.running:
        QTest.qWait(10)
    paints = window.frames[:-1]
    assert len(paints) > 5
    bare = bare_frames(mesh)
    p95, paint = float(np.percentile(gaps, 95)), statistics.median(paints)
    with capsys.disabled():
        print(
            f"\n{quads:>7} quads: {len(paints) / seconds:5.1f} frames/s, {iterates / seconds:7.1f} iterates/s, "
            f"paint median {1e3 * paint:5.1f} ms, heartbeat median {1e3 * statistics.median(gaps):5.1f} "
            f"p95 {1e3 * p95:6.1f} max {1e3 * max(gaps):6.1f} ms, p95 by paint {p95 / paint:4.2f}, "
            f"cpu per frame {1e3 * cpu / len(paints):6.1f} ms, bare frame {1e3 * bare:6.1f} ms"
        )


def bare_frames(mesh: Mesh) -> float:
    """CPU seconds per frame of a bare plotter whose points and colours change."""
    quads = mesh.topology.quads
    cells = np.insert(quads, 0, 4, axis=1).ravel()
    data = pyvista.PolyData(mesh.points.copy(), faces=cells)
    data.cell_data["colours"] = np.full((len(quads), 3), 200, dtype=np.uint8)
    plotter = pyvista.Plotter(off_screen=True, window_size=(1000, 750))
    plotter.add_mesh(data, scalars="colours", rgb=True, show_edges=True, lighting=False)
    plotter.show(auto_close=False, interactive=False)
    frames, start = 10, time.process_time()
    for _ in range(frames):
        data.points += 1e-3
        data.cell_data["colours"][:] ^= 1
        data.Modified()
        plotter.render()
    seconds = (time.process_time() - start) / frames
    plotter.close()
    return seconds
