"""Watching a run: frames per second, and how long the window does not answer, beside a bare PyVista view."""

import os
import statistics
import sys
import time

if sys.platform.startswith("linux"):
    os.environ.setdefault("QT_QPA_PLATFORM", "xcb")

import numpy as np
import pytest
import pyvista
from PySide6.QtCore import QSettings, QTimer
from PySide6.QtTest import QTest

from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.optimization.paper import PaperSettings, unmoved
from hullquad_app.scene import State
from hullquad_app.session import Session
from hullquad_app.settings import Settings
from hullquad_app.track import Track
from hullquad_app.window import MainWindow

SECONDS = 6.0
SIZES = (1000, 10_000, 100_000)


@pytest.fixture
def window(qapp, tmp_path):
    window = MainWindow(Session(Settings(QSettings(str(tmp_path / "s.ini"), QSettings.Format.IniFormat))))
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
    session, paints, gaps = window.session, [], []
    session.set_paper(PaperSettings(iterations=10**6, tolerance=0.0))
    mesh = shaken_grid(quads)
    session.document.open(State(title="grid", tracks={"grid": Track((unmoved(mesh, metric("stretch")),))}))
    QTest.qWait(500)
    window.canvas.painted.connect(paints.append)
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
    QTest.qWait(int(1000 * SECONDS))
    seconds, cpu = time.perf_counter() - start, time.process_time() - cpu
    session.pause()
    iterates = session.document.scene.track.last.number
    while session.document.scene.running:
        QTest.qWait(10)
    assert len(paints) > 5
    bare = bare_frames(mesh)
    p95 = float(np.percentile(gaps, 95))
    with capsys.disabled():
        print(
            f"\n{quads:>7} quads: {len(paints) / seconds:5.1f} frames/s, {iterates / seconds:7.1f} iterates/s, "
            f"paint median {1e3 * statistics.median(paints):5.1f} ms, "
            f"heartbeat median {1e3 * statistics.median(gaps):5.1f} "
            f"p95 {1e3 * p95:6.1f} max {1e3 * max(gaps):6.1f} ms, cpu per frame {1e3 * cpu / len(paints):6.1f} ms, "
            f"bare frame {1e3 * bare:6.1f} ms"
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
