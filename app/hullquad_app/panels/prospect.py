"""What the contour makes of a mesh before there is one: unavoidable triangles, their cause, and what helps."""

from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from hullquad.errors import HullquadError, MeshingError
from hullquad.plate import Notice, Plate
from hullquad_app.colours import LIGHT, Palette
from hullquad_app.division import Division
from hullquad_app.panels.explained import explain
from hullquad_app.panels.ground import coloured
from hullquad_app.panels.notices import NoticeList
from hullquad_app.remedy_words import remedy_words

if TYPE_CHECKING:
    from hullquad.triangulation.contour import Contour
    from hullquad.triangulation.remedies import Remedy


class Prospect(QWidget):
    """Tells it of one plate, at the element size that is chosen; its list of notices finds its place in the panel."""

    remedy_wanted = Signal(object)
    """Emitted with a `Remedy`, when it is to be carried out."""
    evening_wanted = Signal()
    """Emitted when all contours of the document are to be made even."""
    place_wanted = Signal(object)
    """Emitted with a `Notice`, when its place is to be shown on the plate."""

    def __init__(self) -> None:
        super().__init__()
        self._palette = LIGHT
        self._plate: Plate | None = None
        self._division: Division | None = None
        self.sentence, self.notices = QLabel(wordWrap=True), NoticeList()
        self.remedy, self.show_edge, self.evening = QPushButton(), QPushButton(self.tr("Show")), QPushButton()
        self._explain()
        self._arrange()
        self.remedy.clicked.connect(lambda: self.remedy_wanted.emit(self._change))
        self.show_edge.clicked.connect(lambda: self.place_wanted.emit(self._odd_notice))
        self.evening.clicked.connect(self.evening_wanted)
        self.notices.place_wanted.connect(self.place_wanted)
        self.show_division(None, None)

    def show_division(self, plate: Plate | None, division: Division | None) -> None:
        """Tell about a plate; a division of None is still to come."""
        self._plate, self._division = plate, division
        text, is_refused = self._words()
        self.sentence.setText(text)
        coloured(self.sentence, self._palette.fail if is_refused else self._palette.dim)
        change = self._change
        if change is not None:
            self.remedy.setText(remedy_words(change))
        self.evening.setText(self.tr("Make all contours even ({count} are odd)").format(count=self._odd_count))
        for button, is_of_use in (
            (self.remedy, change is not None),
            (self.show_edge, change is not None),
            (self.evening, self._odd_count > 1),
        ):
            button.setVisible(is_of_use)
        self.notices.show_notices([notice for notice in self._notices if notice.code != "W_ODD"])

    def give_up(self) -> None:
        """Say of a division that was to come that it does not."""
        if self._plate is not None and self._division is None:
            self.sentence.setText(self.tr("Unavoidable triangles: not looked for. Choose a size to look for them."))

    def enable(self, *, can_edit: bool) -> None:
        """Let the document be edited, or not now."""
        self.remedy.setEnabled(can_edit)
        self.evening.setEnabled(can_edit)

    def set_palette(self, palette: Palette) -> None:
        """Draw in the colours of a theme."""
        self._palette = palette
        self.show_division(self._plate, self._division)

    @property
    def _change(self) -> "Remedy | None":
        if self._plate is None or self._division is None:
            return None
        return self._division.remedies.get(self._plate.id)

    @property
    def _notices(self) -> list[Notice]:
        if self._plate is None or self._division is None:
            return []
        return list(self._division.notices.get(self._plate.id, ()))

    @property
    def _odd_notice(self) -> Notice:
        return next(notice for notice in self._notices if notice.code == "W_ODD")

    @property
    def _odd_count(self) -> int:
        return 0 if self._division is None else len(self._division.odd)

    def _words(self) -> tuple[str, bool]:
        """What the contour makes of the size, and whether the plate is refused."""
        plate, division = self._plate, self._division
        if plate is None:
            return self.tr("Open a plate document to mesh its plates."), False
        if division is None:
            return self.tr("Unavoidable triangles: …"), False
        contour = division.contours.get(plate.id, MeshingError("E_CURVED", plate.id))
        if isinstance(contour, HullquadError):
            return contour.text, True
        return self._contour_words(contour, division), False

    def _contour_words(self, contour: "Contour", division: Division) -> str:
        if not contour.triangles_unavoidable:
            return self.tr("Unavoidable triangles: 0 ({edges} contour edges)").format(edges=contour.edge_count)
        if contour.plate.id not in division.odd:
            text = self.tr("Unavoidable triangles: {count}. So many parts of the plate have an odd number of edges.")
            return text.format(count=contour.triangles_unavoidable)
        text = self.tr(
            "Unavoidable triangles: 1. Odd number of contour edges: {edges}; "
            "one node more or fewer on an edge makes it none."
        )
        return text.format(edges=contour.edge_count) + self._neighbour_words(division)

    def _neighbour_words(self, division: Division) -> str:
        """What the remedy makes of the plates that have the same edge."""
        change = self._change
        if change is None or not change.neighbours:
            return ""
        healed = [key for key in change.neighbours if key in division.odd]
        spoilt = [key for key in change.neighbours if key not in division.odd]
        words = self.tr(" The edge is divided in {plates} too.").format(plates=", ".join(change.neighbours))
        words += self.tr(" That makes {plates} even.").format(plates=", ".join(healed)) if healed else ""
        return words + (self.tr(" That makes {plates} odd.").format(plates=", ".join(spoilt)) if spoilt else "")

    def _explain(self) -> None:
        rule = self.tr(
            "Quads have an even number of contour edges: an odd one leaves a triangle, however it is meshed."
        )
        explain(self.sentence, self.tr("Unavoidable triangles"), rule)
        explain(
            self.remedy,
            self.tr("Make the contour even"),
            self.tr("Divide this edge otherwise, in all plates that have it; one step of undo."),
        )
        explain(self.show_edge, self.tr("Show the edge"), self.tr("Show on the plate which edge that is."))
        explain(
            self.evening,
            self.tr("Make all contours even"),
            self.tr("Divide as few edges of the document otherwise as all its plates need; one step of undo."),
        )

    def _arrange(self) -> None:
        self.sentence.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        first, second = QHBoxLayout(), QHBoxLayout()
        for line, buttons in ((first, (self.remedy, self.show_edge)), (second, (self.evening,))):
            for button in buttons:
                line.addWidget(button)
            line.addStretch()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.sentence)
        column.addLayout(first)
        column.addLayout(second)
