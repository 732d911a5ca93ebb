"""Take the pictures of the README from the program itself: ``python assets/make_pictures.py`` (on a screen or Xvfb).

Those of meshes alone are drawn first, and by themselves by ``make_figures.py``, which needs no screen.
"""

import tempfile
from collections.abc import Callable
from pathlib import Path

import make_figures
from PySide6.QtCore import QSettings
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from hullquad_app import pictures
from hullquad_app.colours import Theme
from hullquad_app.session import Session
from hullquad_app.settings import Settings
from hullquad_app.window import MainWindow

ASSETS = Path(__file__).parent
FOLDER = ASSETS / "pictures"
SAMPLE = ASSETS / "plates" / "hopper_web_ring.json"


def wait(condition: Callable[[], object]) -> None:
    """Let the program go on until the condition holds, and a moment longer."""
    while not condition():
        QTest.qWait(20)
    QTest.qWait(300)


def take(window: MainWindow, name: str) -> None:
    """Picture of the whole window."""
    QTest.qWait(300)
    window.screen().grabWindow(window.winId()).save(str(FOLDER / f"{name}.png"))


def main() -> None:
    """Go through the README's five minutes, taking pictures on the way."""
    make_figures.main()
    application = QApplication([])
    application.setStyle("Fusion")
    FOLDER.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        settings = Settings(QSettings(f"{folder}/settings.ini", QSettings.Format.IniFormat))
        settings.theme = Theme.LIGHT.value
        window = MainWindow(Session(settings))
        window.resize(1440, 900)
        window.show()
        window.start()
        session = window.session
        wait(lambda: not session.workshop.jobs.preparing.is_running)
        take(window, "start")
        window.filing.open(SAMPLE)
        wait(lambda: session.document.scene.state.keys)
        session.mesh("fine")
        wait(lambda: session.document.scene.mesh is not None)
        session.choose_metric("shape")
        take(window, "meshed")
        session.run()
        wait(lambda: not session.document.scene.running)
        take(window, "optimised")
        session.judging.judge_by("bv")
        take(window, "rules")
        session.judging.judge_by("")
        window.docks.worst.next()
        window.docks.inspect()
        window.canvas.zoom_to(session.document.scene.view.selection)
        take(window, "inspector")
        window.docks.toggle_inspector()
        session.select(())
        window.canvas.fit()
        window.apply_theme(Theme.DARK)
        take(window, "dark")
        pictures.write(session.document.scene, FOLDER / "report.png")
        session.stop_and_wait()
        session.document.edits.setClean()
        window.filing.leave(window.close)
        window.canvas.stop()


if __name__ == "__main__":
    main()
