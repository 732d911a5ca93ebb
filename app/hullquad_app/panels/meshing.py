"""How a plate is meshed: element size, mesher, what the contour makes of it; and how far meshing is."""

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QDoubleSpinBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from hullquad.plate import Plate
from hullquad_app.abilities import Abilities
from hullquad_app.colours import COLOUR_MAPS, LIGHT, ColourMap, Palette
from hullquad_app.division import Division, Size
from hullquad_app.grouped_box import narrow
from hullquad_app.panels.explained import explain
from hullquad_app.panels.ground import coloured, dress
from hullquad_app.panels.mesher_rows import MesherRows
from hullquad_app.panels.prospect import Prospect
from hullquad_app.scene import Scene

_LEAST, _MOST = 0.1, 1e6
_OTHER = "other"


class MeshingPanel(QWidget):
    """Asks by `size_chosen` for the contours of a size, by `requested` for meshes."""

    size_chosen = Signal(object)
    """Emitted with a size to divide the contours for: a number [mm], a name, or None for the plates' own."""
    requested = Signal(object, bool)
    """Emitted with the size, and whether all plates are to be meshed."""
    remedy_wanted = Signal(object, object)
    """Emitted with a `Remedy` to carry out, or None to make all contours even; and the size."""
    cancelled = Signal()
    """Emitted when meshing is to be given up."""

    def __init__(self) -> None:
        super().__init__()
        self._scene = Scene()
        self._division: Division | None = None
        self.sizes, self.mesher = QComboBox(), MesherRows()
        narrow(self.sizes)
        self.millimetres = QDoubleSpinBox(minimum=_LEAST, maximum=_MOST, decimals=1)
        self.millimetres.setKeyboardTracking(False)
        self.prospect = Prospect()
        self.one, self.all_plates = QPushButton(self.tr("&Mesh")), QPushButton()
        self.task, self.progress = QLabel(), QProgressBar(textVisible=False)
        self.cancel = QPushButton(self.tr("Cancel"))
        self._explain()
        self._arrange()
        self._list_sizes(None)
        self._connect()
        self.show_abilities(Abilities())
        self.show_idle()
        self.set_palette(LIGHT)

    @property
    def size_wanted(self) -> Size:
        """Element size to mesh with."""
        chosen = self.sizes.currentData()
        return self.millimetres.value() if chosen == _OTHER else chosen

    def show_scene(self, scene: Scene) -> None:
        """Show the sizes of the plate, and what its contour makes of the chosen one."""
        before, self._scene = self._scene, scene
        if scene.plate is not before.plate:
            self._list_sizes(scene.plate)
            self._show_prospect()
        if scene.state.plates is not before.state.plates:
            count = 0 if scene.state.plates is None else len(scene.state.plates.plates)
            self.all_plates.setText(self.tr("Mesh &all {count} plates").format(count=count))
            self.all_plates.setVisible(count > 1)
            self.ask()

    def show_abilities(self, able: Abilities) -> None:
        """Enable what can be done."""
        self.one.setEnabled(able.can_mesh)
        self.all_plates.setEnabled(able.can_mesh_all)
        self.prospect.enable(can_edit=able.can_mesh)
        self.cancel.setEnabled(able.can_cancel)

    def show_division(self, division: Division) -> None:
        """Show what the contour makes of a size."""
        self._division = division
        self._show_prospect()

    def show_progress(self, text: str, done: int = 0, total: int = 0) -> None:
        """Show what is being done, and how much of it is done of how much."""
        self.task.setText(text)
        self.progress.setRange(0, total)
        self.progress.setValue(done)
        self._show_task(visible=True)

    def show_idle(self) -> None:
        """Nothing is being done, and no division is to come."""
        self._show_task(visible=False)
        self.prospect.give_up()

    def set_palette(self, palette: Palette, _: ColourMap = COLOUR_MAPS[0]) -> None:
        """Draw in the colours of a theme."""
        dress(self, palette)
        coloured(self.task, palette.dim)
        self.prospect.set_palette(palette)

    def ask(self) -> None:
        """Ask for the contours of the size that is chosen, and say meanwhile that they are to come."""
        self._show_prospect()
        if self._scene.state.plates is not None:
            self.size_chosen.emit(self.size_wanted)

    def _connect(self) -> None:
        self.sizes.activated.connect(self._choose)
        self.millimetres.valueChanged.connect(self.ask)
        self.one.clicked.connect(lambda: self.requested.emit(self.size_wanted, False))
        self.all_plates.clicked.connect(lambda: self.requested.emit(self.size_wanted, True))
        self.cancel.clicked.connect(self.cancelled)
        self.prospect.remedy_wanted.connect(lambda change: self.remedy_wanted.emit(change, self.size_wanted))
        self.prospect.evening_wanted.connect(lambda: self.remedy_wanted.emit(None, self.size_wanted))

    def _choose(self) -> None:
        self.millimetres.setVisible(self.sizes.currentData() == _OTHER)
        self.ask()

    def _list_sizes(self, plate: Plate | None) -> None:
        """List the sizes with the lengths that a plate gives them; the chosen one stays."""
        row = max(self.sizes.currentIndex(), 0)
        self.sizes.clear()
        named = ((self.tr("as the plate says"), None), (self.tr("coarse"), "coarse"), (self.tr("fine"), "fine"))
        for title, key in (*named, (self.tr("very fine"), "very_fine")):
            length = "" if plate is None else f": {_length(plate, key):g} mm"
            self.sizes.addItem(title + length, key)
        self.sizes.addItem(self.tr("other …"), _OTHER)
        self.sizes.setCurrentIndex(row)
        if plate is not None and not self.millimetres.isVisibleTo(self):
            with QSignalBlocker(self.millimetres):
                self.millimetres.setValue(plate.target_size)

    def _show_prospect(self) -> None:
        known = self._division
        wanted = self._scene.state.plates, self.size_wanted, self.mesher.mesher.follows_lines
        is_of_this = known is not None and (known.plates, known.size, known.follows_lines) == wanted
        self.prospect.show_division(self._scene.plate, known if is_of_this else None)

    def _show_task(self, *, visible: bool) -> None:
        for widget in (self.task, self.progress, self.cancel):
            widget.setVisible(visible)

    def _explain(self) -> None:
        """Accessible names and tips of all controls."""
        texts = (
            (self.sizes, self.tr("Element size"), self.tr("Length that an element's edge should have.")),
            (self.millimetres, self.tr("Element size in millimetres"), self.tr("Any length [mm].")),
            (self.one, self.tr("Mesh the plate"), self.tr("Mesh the plate that is shown.")),
            (self.all_plates, self.tr("Mesh all plates"), self.tr("Mesh every plate of the document.")),
            (self.progress, self.tr("Progress"), ""),
            (self.cancel, self.tr("Cancel"), self.tr("Give up; the document stays as it was.")),
        )
        for widget, name, tip in texts:
            explain(widget, name, tip)
        self.millimetres.setSuffix(self.tr(" mm"))

    def _arrange(self) -> None:
        self.sizes.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.all_plates.hide()
        self.millimetres.hide()
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(self.tr("Element &size"), self.sizes)
        form.addRow("", self.millimetres)
        self.mesher.add_to(form)
        buttons, running = QHBoxLayout(), QHBoxLayout()
        buttons.addWidget(self.one)
        buttons.addWidget(self.all_plates)
        buttons.addStretch()
        running.addWidget(self.progress, stretch=1)
        running.addWidget(self.cancel)
        column = QVBoxLayout(self)
        column.addWidget(self.task)  # on top: Cancel must be in sight however low the panel is
        column.addLayout(running)
        column.addLayout(form)
        column.addWidget(self.prospect)
        column.addLayout(buttons)
        column.addWidget(self.prospect.notices)
        column.addStretch()


def _length(plate: Plate, key: str | None) -> float:
    return plate.target_size if key is None else float(getattr(plate.sizes, key))
