"""The table of actions: menu, text, tip, keys, and what each one calls on whom."""

from collections.abc import Iterator, Mapping
from functools import partial

import attrs
from PySide6.QtCore import QT_TRANSLATE_NOOP, QCoreApplication, QObject
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu, QMenuBar

from hullquad.metrics import METRICS
from hullquad_app.abilities import Abilities
from hullquad_app.colours import Palette
from hullquad_app.theme import icon


@attrs.frozen
class Row:
    """One action; its texts are translated when it is made."""

    menu: str
    text: str
    tip: str
    calls: str
    """``target.method``; `target` is one of those that the table is made with."""
    keys: str = ""
    icon: str = ""
    able: str = ""
    """Field of `Abilities` that enables it; empty: always."""
    argument: str | int | tuple[()] | None = None
    name: str = ""
    """By which the action is found; empty: the method's."""
    short: str = ""
    """What the tool bar says; empty: the text."""

    @property
    def key(self) -> str:
        """By which the action is found."""
        return self.name or self.calls.rpartition(".")[2]


FILE = str(QT_TRANSLATE_NOOP("Actions", "&File"))
EDIT = str(QT_TRANSLATE_NOOP("Actions", "&Edit"))
VIEW = str(QT_TRANSLATE_NOOP("Actions", "&View"))
QUALITY = str(QT_TRANSLATE_NOOP("Actions", "&Quality"))
MESH = str(QT_TRANSLATE_NOOP("Actions", "&Mesh"))
OPTIMISE = str(QT_TRANSLATE_NOOP("Actions", "&Optimise"))
HELP = str(QT_TRANSLATE_NOOP("Actions", "&Help"))
MENUS = (FILE, EDIT, VIEW, MESH, QUALITY, OPTIMISE, HELP)


def _tr(text: str) -> str:
    return str(QT_TRANSLATE_NOOP("Actions", text))


# menu, text, tip, what it calls, keys, icon, what enables it, argument, name
ROWS = (
    Row(FILE, _tr("&Open…"), _tr("Open plates or a mesh"), "filing.choose_file", "Ctrl+O", "open"),
    Row(FILE, _tr("&Save mesh…"), _tr("Save the mesh as it is shown"), "filing.choose_output", "Ctrl+S", "save", "can_save"),
    Row(FILE, _tr("Save p&lates as…"), _tr("Save the plates, with the divisions of their edges"), "filing.choose_plates_output", "Ctrl+Alt+S", "", "can_save_plates"),
    Row(FILE, _tr("Save &picture…"), _tr("Picture of the plate for a report"), "filing.choose_picture", "Ctrl+Shift+S", "picture", "can_picture", short=_tr("Picture")),
    Row(FILE, _tr("&Copy picture"), _tr("Put the picture on the clipboard"), "filing.copy_picture", "Ctrl+Shift+C", "", "can_picture"),
    Row(FILE, _tr("&Quit"), _tr("Close the window and end the program"), "window.close", "Ctrl+Q"),
    Row(EDIT, _tr("&Undo"), _tr("Take the last change back"), "session.undo", "Ctrl+Z", "undo", "can_undo"),
    Row(EDIT, _tr("&Redo"), _tr("Do again what was taken back"), "session.redo", "Ctrl+Y", "redo", "can_redo"),
    Row(EDIT, _tr("&Clear selection"), _tr("Select nothing"), "session.select", "Esc", "", "", (), "clear_selection"),
    Row(QUALITY, _tr("&Next worst element"), _tr("Select the next element of the list, the worst first"), "docks.next_worst", "N", "", "can_picture"),
    Row(QUALITY, _tr("&Previous worst element"), _tr("Select the element before it"), "docks.previous_worst", "P", "", "can_picture"),
    Row(VIEW, _tr("&Fit"), _tr("Show the whole plate"), "canvas.fit", "F", "fit"),
    Row(VIEW, _tr("&Plan of the plate"), _tr("Look square onto the plate"), "canvas.look", "F5", "plan", "", "plan", "plan"),
    Row(VIEW, _tr("F&ront"), _tr("Look from the front of the ship"), "canvas.look", "F6", "", "", "front", "front"),
    Row(VIEW, _tr("&Top"), _tr("Look from above"), "canvas.look", "F7", "", "", "top", "top"),
    Row(VIEW, _tr("&Side"), _tr("Look from the side of the ship"), "canvas.look", "F8", "", "", "side", "side"),
    Row(VIEW, _tr("&Isometric"), _tr("Look from between the axes"), "canvas.look", "F9", "isometric", "", "isometric", "isometric"),
    Row(VIEW, _tr("&Edges"), _tr("Show or hide the edges of the elements"), "canvas.toggle_edges", "E"),
    Row(VIEW, _tr("&Dark or light"), _tr("Change between the dark and the light theme"), "window.toggle_theme", "D", "theme"),
    Row(MESH, _tr("&Mesh plate"), _tr("Make quads of the plate that is shown"), "docks.mesh_plate", "M", "mesh", "can_mesh", None, "mesh_plate", _tr("Mesh")),
    Row(MESH, _tr("Mesh &all plates"), _tr("Make quads of every plate of the document"), "docks.mesh_all_plates", "Shift+M", "", "can_mesh_all", None, "mesh_all"),
    Row(MESH, _tr("Make all contours &even"), _tr("Divide as few edges otherwise as are needed to have no unavoidable triangle"), "docks.make_even", "", "", "can_even"),
    Row(MESH, _tr("&Cancel"), _tr("Give up what is being opened, divided or meshed"), "session.cancel", "", "", "can_cancel"),
    Row(OPTIMISE, _tr("&Step"), _tr("One iteration from the mesh that is shown"), "session.step", "S", "step", "can_step"),
    Row(OPTIMISE, _tr("&Run"), _tr("Iterate until nothing is gained"), "session.run", "R", "run", "can_run"),
    Row(OPTIMISE, _tr("Open &folded elements"), _tr("Turn elements that are inside out the right way"), "session.untangle", "U", "", "can_untangle"),
    Row(OPTIMISE, _tr("&Optimiser and options"), _tr("Choose how the nodes are moved, or go back to the history"), "docks.toggle_search", "O", "", "", None, "choose_optimizer"),
    Row(OPTIMISE, _tr("&Pause"), _tr("End the run here"), "session.pause", "Space", "pause", "can_pause"),
    Row(OPTIMISE, _tr("R&eset"), _tr("Go back to the mesh as it was made or loaded"), "session.reset", "Ctrl+R", "reset", "can_reset"),
    Row(OPTIMISE, _tr("One iterate &back"), _tr("Show the iterate before this one"), "session.scrub_by", "Ctrl+Left", "", "can_scrub", -1, "back"),
    Row(OPTIMISE, _tr("One iterate &on"), _tr("Show the iterate after this one"), "session.scrub_by", "Ctrl+Right", "", "can_scrub", 1, "on"),
    Row(QUALITY, _tr("&Inspect element"), _tr("Every value of the selected element, with its lengths and angles"), "docks.toggle_inspector", "I", "", "can_picture", None, "inspect"),
    Row(QUALITY, _tr("&Reset limit"), _tr("Take back the limit of the metric itself"), "judging.reset_limit", "Ctrl+L"),
    Row(QUALITY, _tr("Reset &all limits"), _tr("Take back the limits of all metrics"), "judging.reset_limits"),
    Row(QUALITY, _tr("&Load criteria…"), _tr("Take the limits in a file"), "judging_files.load_criteria"),
    Row(QUALITY, _tr("&Save criteria…"), _tr("Put the limits of all metrics into a file"), "judging_files.save_criteria"),
    Row(QUALITY, _tr("&Judge by a file of rules…"), _tr("Judge by the rules in a file"), "judging_files.choose_rules"),
    Row(HELP, _tr("&Keys"), _tr("What the keys do"), "about.show_keys", "F1"),
    Row(HELP, _tr("&About HullQuad"), _tr("What this program is, its version and licences"), "about.show_about"),
    *(
        Row(QUALITY, metric.title.replace("&", "&&"), metric.formula, "session.choose_metric", str(row + 1), "", "", metric.key, metric.key)
        for row, metric in enumerate(METRICS[:9])
    ),
)  # fmt: skip


class Actions:
    """The actions of a window, by name."""

    def __init__(self, targets: Mapping[str, QObject], parent: QObject) -> None:
        self._rows = {row.key: row for row in ROWS}
        self._made = {key: _action(row, targets, parent) for key, row in self._rows.items()}
        self.show_abilities(Abilities())

    def __getitem__(self, name: str) -> QAction:
        return self._made[name]

    def __iter__(self) -> Iterator[QAction]:
        return iter(self._made.values())

    def fill(self, bar: QMenuBar) -> dict[str, QMenu]:
        """Put every action into its menu; the menus by title."""
        menus = {title: bar.addMenu(_translated(title)) for title in MENUS}
        for key, row in self._rows.items():
            menus[row.menu].addAction(self._made[key])
        return menus

    def show_abilities(self, abilities: Abilities) -> None:
        """Enable what can be done."""
        for key, row in self._rows.items():
            if row.able:
                self._made[key].setEnabled(getattr(abilities, row.able))

    def show_edits(self, undo: str, redo: str) -> None:
        """Name what would be undone and redone."""
        self._made["undo"].setText(_translated("&Undo {edit}").format(edit=undo).strip())
        self._made["redo"].setText(_translated("&Redo {edit}").format(edit=redo).strip())

    def set_palette(self, palette: Palette) -> None:
        """Draw the icons in the colours of a theme."""
        for key, row in self._rows.items():
            if row.icon:
                self._made[key].setIcon(icon(row.icon, palette))


def _action(row: Row, targets: Mapping[str, QObject], parent: QObject) -> QAction:
    made = QAction(_translated(row.text), parent)
    made.setObjectName(row.key)
    made.setShortcut(QKeySequence(row.keys))
    keys = made.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
    tip = _translated(row.tip)
    made.setIconText(_translated(row.short or row.text.replace("&", "").rstrip("…")))
    made.setToolTip(f"{tip} ({keys})" if keys else tip)
    made.setStatusTip(tip)
    target, _, method = row.calls.rpartition(".")
    call = getattr(targets[target], method)
    made.triggered.connect(partial(_called, call, row.argument))
    return made


def _called(call: object, argument: str | int | tuple[()] | None, _checked: bool = False) -> None:
    assert callable(call)
    if argument is None:
        call()
    else:
        call(argument)


def _translated(text: str) -> str:
    return QCoreApplication.translate("Actions", text)
