"""The main window: arranges what the program shows, nothing else."""

from pathlib import Path

from PySide6.QtCore import QObject, Qt, QTimer
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QMainWindow, QStackedWidget, QToolBar, QVBoxLayout, QWidget

from hullquad.errors import HullquadError
from hullquad.plate import Notice
from hullquad_app import theme
from hullquad_app.about import About
from hullquad_app.actions import FILE, VIEW, Actions
from hullquad_app.canvas import Canvas
from hullquad_app.colour_menu import ColourMenu
from hullquad_app.colours import LIGHT, ColourMap, Theme
from hullquad_app.docks import Docks
from hullquad_app.filing import Filing
from hullquad_app.fold_bar import FoldBar
from hullquad_app.history_bar import HistoryBar
from hullquad_app.judging_files import JudgingFiles
from hullquad_app.live import Live
from hullquad_app.message_bar import MessageBar
from hullquad_app.recent import RecentFiles
from hullquad_app.scene import Scene, State
from hullquad_app.session import Session
from hullquad_app.status import StatusBar
from hullquad_app.theme_menu import ThemeMenu
from hullquad_app.toolbar import Choices
from hullquad_app.tools import Tools
from hullquad_app.turns import Turns
from hullquad_app.welcome import Welcome

_LAYOUT_VERSION = 1
_LETTERS = (205, 52)
"""Width and height of the window when it opens for the first time, in letters."""


class MainWindow(QMainWindow):
    """The view with its bars and panels round it; all of them show the scene of the session's document."""

    def __init__(self, session: Session) -> None:
        super().__init__()
        self.session = session
        self.filing, self.judging_files = Filing(session, self), JudgingFiles(session.judging, self)
        self._turns = Turns(self)
        self.canvas, self.welcome = Canvas(turns=self._turns), Welcome()
        self.messages, self.choices = MessageBar(), Choices()
        self.docks, self.history, self.status = Docks(self, session, self.canvas), HistoryBar(), StatusBar()
        self._live = Live(session.document, self._turns)
        self.actions_by_name = Actions(self._targets(), self)
        self.folds = FoldBar(self.actions_by_name["untangle"])
        self._state = session.document.scene.state
        self._middle, self._colours = QStackedWidget(), ColourMenu(self)
        self._themes = ThemeMenu(self)
        self._may_close = False
        self.setAcceptDrops(True)
        self._arrange()
        self._connect()
        self._palette = LIGHT
        self.apply_theme(Theme(session.settings.theme))
        self._restore()
        self.show_scene(session.document.scene)

    def start(self, path: Path | None = None) -> None:
        """Open a file and fill the view, once the window is there; load the engine when that is on the screen."""
        if self.session.settings.layout.isEmpty():
            self.docks.set_width()
        if path is not None:
            self.filing.open(path)  # read in a thread while VTK is loaded
        self.canvas.start()
        opening = self.session.workshop.jobs.opening
        if opening.is_running:
            once = Qt.ConnectionType.SingleShotConnection
            opening.ended.connect(lambda: self._turns.ask(self.session.prepare), once)  # after the picture's turn
        else:
            self.session.prepare()

    def stop(self) -> None:
        """End threads and worker, then the view, in this order; what is stopped already stays so."""
        self.session.stop_and_wait()
        self.canvas.stop()

    def show_scene(self, scene: Scene) -> None:
        """Show a scene everywhere; what was said of another document or mesh is said no longer."""
        before, self._state = self._state, scene.state
        if _is_other(before, scene.state, scene.view.key):
            self.messages.hide()
        self._middle.setCurrentWidget(self.canvas if scene.state.keys else self.welcome)
        if scene.running:
            self.folds.hide()
            self._live.show()
        else:
            for shows in (self.folds, self.canvas, self.docks, self.choices, self.history, self.status):
                shows.show_scene(scene)
        self._show_title()

    def apply_theme(self, chosen: Theme) -> None:
        """Take a theme, and remember it."""
        self.session.settings.theme = chosen.value
        self._themes.show_choice(chosen)
        self._palette = theme.apply(chosen)
        bars = (self.choices, self.history, self.status, self.messages, self.folds)
        for dressed in (self.canvas, *bars, self.actions_by_name):
            dressed.set_palette(self._palette)
        self.docks.set_palette(self._palette, self._colours.chosen)

    def colour_by(self, chosen: ColourMap) -> None:
        """Colour elements, histogram and swatches by another map."""
        self.canvas.set_colour_map(chosen)
        self.docks.set_palette(self._palette, chosen)

    def toggle_theme(self) -> None:
        """Change between dark and light."""
        self.apply_theme(Theme.LIGHT if self._palette.is_dark else Theme.DARK)

    def say(self, message: HullquadError | str) -> None:
        """Say a message above the view, and show on the plate where it is."""
        self.messages.say(message)
        plate = self.session.document.scene.plate
        if plate is not None and message is self.session.workshop.refused.get(plate.id):
            self.canvas.show_place(plate.place_of(message))

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask first if something would be lost; then end everything before Qt does."""
        if self.session.is_modified and not self._may_close:
            event.ignore()
            self.filing.leave(self._close_soon)
            return
        self.session.settings.geometry = self.saveGeometry()
        self.session.settings.layout = self.saveState(_LAYOUT_VERSION)
        self.stop()
        event.accept()

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take files."""
        if _dropped(event):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open the first of the files."""
        event.acceptProposedAction()
        self.filing.open(_dropped(event)[0])

    def _show_edits(self) -> None:
        edits = self.session.document.edits
        self.actions_by_name.show_edits(edits.undoText(), edits.redoText())
        self._show_title()

    def _show_title(self) -> None:
        name = self.session.title
        self.setWindowTitle(self.tr("{name}[*] – HullQuad").format(name=name) if name else self.tr("HullQuad"))
        self.setWindowModified(self.session.is_modified)

    def _show_place(self, notice: Notice) -> None:
        plate = self.session.document.scene.plate
        if plate is not None:
            self.canvas.show_place(plate.place_of(notice))

    def _close_soon(self) -> None:
        self._may_close = True
        QTimer.singleShot(0, self, self.close)  # Qt closes nothing that is being closed

    def _targets(self) -> dict[str, QObject]:
        return {
            "window": self,
            "filing": self.filing,
            "session": self.session,
            "judging": self.session.judging,
            "judging_files": self.judging_files,
            "canvas": self.canvas,
            "docks": self.docks,
            "about": About(self),
        }

    def _arrange(self) -> None:
        centre = QWidget()
        column = QVBoxLayout(centre)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        for page in (self.welcome, self.canvas):
            self._middle.addWidget(page)
        column.addWidget(self.messages)
        column.addWidget(self.folds)
        column.addWidget(self._middle, stretch=1)
        self.setCentralWidget(centre)
        self.addToolBar(self._tools())
        self.addToolBar(Qt.ToolBarArea.BottomToolBarArea, _fixed("history", self._history_bar()))
        self.setStatusBar(self.status)
        self.docks.arrange()
        menus = self.actions_by_name.fill(self.menuBar())
        recent = RecentFiles(self.session.settings, self.filing, self)
        menus[FILE].insertMenu(self.actions_by_name["choose_output"], recent)
        menus[FILE].insertMenu(self.actions_by_name["close"], self.filing.picture_menu)
        menus[VIEW].addMenu(self._themes)
        menus[VIEW].addMenu(self._colours)
        menus[VIEW].addSeparator()
        menus[VIEW].addActions(self.docks.toggles())

    def _tools(self) -> QToolBar:
        made = self.actions_by_name
        groups = (
            (made["choose_file"], made["mesh_plate"]),
            (self.choices,),
            (made["step"], made["run"], made["pause"], made["reset"]),
            (made["choose_picture"],),
        )
        return _fixed("tools", Tools(self.tr("Tools"), groups, self.choices.squeeze))

    def _history_bar(self) -> QToolBar:
        bar = QToolBar(self.tr("History"))
        bar.addWidget(self.history)
        return bar

    def _connect(self) -> None:
        session, edits = self.session, self.session.document.edits
        session.document.changed.connect(self.show_scene)
        session.message.connect(self.say)
        session.saved.connect(self._show_title)
        session.divided.connect(self.canvas.show_division)
        session.busy.connect(lambda text, done, total: self.status.say_activity(_progress(text, done, total)))
        session.idle.connect(lambda: self.status.say_activity(""))
        session.able.connect(self.actions_by_name.show_abilities)
        edits.cleanChanged.connect(self._show_edits)
        edits.indexChanged.connect(self._show_edits)
        self._colours.picked.connect(self.colour_by)
        self._themes.picked.connect(self.apply_theme)
        self.welcome.chosen.connect(self.filing.open)
        self.history.position_chosen.connect(session.scrub)
        self.choices.plate_chosen.connect(session.choose_plate)
        self.choices.metric_chosen.connect(session.choose_metric)
        self.choices.limit_moved.connect(session.judging.set_limit)
        self.choices.limit_reset.connect(session.judging.reset_limit)
        self.choices.rules.offer(lambda: session.settings.rule_files)
        self.choices.rules_chosen.connect(session.judging.judge_by)
        for wanted in (self.choices.rules_file_wanted, self.docks.rules_file_wanted):
            wanted.connect(self.judging_files.choose_rules)
        self.canvas.picked.connect(lambda row, extend: session.select({row}, extend=extend))
        self.canvas.painted.connect(session.optimizer.run.painted)
        self.docks.place_wanted.connect(self._show_place)
        self.canvas.missed.connect(lambda: session.select(()))
        self._live.follow(self.canvas)
        self._live.follow(*self.docks.watched, self.choices, self.history, self.status)
        for group in self.docks.read:
            self._live.follow(*group, seldom=True)
        for box in self.choices.limits.boxes:
            box.lineEdit().returnPressed.connect(self.canvas.setFocus)  # letters are keys again

    def _restore(self) -> None:
        letter = self.fontMetrics()
        self.resize(letter.averageCharWidth() * _LETTERS[0], letter.height() * _LETTERS[1])
        self.restoreGeometry(self.session.settings.geometry)
        self.restoreState(self.session.settings.layout, _LAYOUT_VERSION)


def _fixed(name: str, bar: QToolBar) -> QToolBar:
    bar.setObjectName(name)
    bar.setMovable(False)
    bar.toggleViewAction().setVisible(False)
    return bar


def _is_other(before: State, after: State, key: str | None) -> bool:
    """Whether another document is open or the plate was meshed anew; a run only moves nodes."""
    if before.path != after.path or before.plates is not after.plates:
        return True
    known, track = before.tracks.get(key or ""), after.tracks.get(key or "")
    return track is not None and (known is None or known.first.mesh.topology is not track.first.mesh.topology)


def _progress(text: str, done: int, total: int) -> str:
    return f"{text} ({done} / {total})" if total else text


def _dropped(event: QDropEvent) -> list[Path]:
    return [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]
