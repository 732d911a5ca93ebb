"""By what elements are judged: the limits of metrics, and rule sets; remembered from day to day."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import attrs
from PySide6.QtCore import QObject

from hullquad.errors import HullquadError
from hullquad.metrics import Band, metric
from hullquad_app.document import Document
from hullquad_app.limits import with_limit
from hullquad_app.settings import Settings

if TYPE_CHECKING:
    from hullquad.rules import RuleSet


class Judging(QObject):
    """Changes how the document is judged; what cannot be done is told by `tell`."""

    def __init__(
        self, document: Document, settings: Settings, tell: Callable[[HullquadError], object], parent: QObject
    ) -> None:
        super().__init__(parent)
        self._document, self._settings, self._tell = document, settings, tell
        document.look(metric=metric(settings.metric), bands=settings.bands)
        if settings.rules:
            self._look_by(settings.rules, lambda _: None)

    def set_limit(self, end: int, limit: float) -> None:
        """Have quads fail from another value on; of a two-sided metric limit 0 is the lower and 1 the upper one."""
        scene, by = self._document.scene, self._document.scene.view.metric
        self._accept({**scene.view.bands, by.key: with_limit(by, scene.band, end, limit)})

    def reset_limit(self) -> None:
        """Have quads fail where the metric's acceptable band ends."""
        view = self._document.scene.view
        self._accept({key: band for key, band in view.bands.items() if key != view.metric.key})

    def reset_limits(self) -> None:
        """The same for every metric."""
        self._accept({})

    def read_criteria(self, path: Path) -> None:
        """Take the limits in a file; metrics that it does not name have their own."""
        from hullquad.rules.criteria import read_criteria  # noqa: PLC0415  an empty window does not wait for it

        try:
            self._accept(read_criteria(path))
        except HullquadError as error:
            self._tell(error)

    def write_criteria(self, path: Path) -> None:
        """Put the limits of every metric into a file."""
        from hullquad.metrics import METRICS  # noqa: PLC0415
        from hullquad.rules.criteria import write_criteria  # noqa: PLC0415

        bands = self._document.scene.view.bands
        try:
            write_criteria({row.key: bands.get(row.key, row.band) for row in METRICS}, path)
        except HullquadError as error:
            self._tell(error)

    def judge_by(self, name: str) -> None:
        """Judge by a rule set, one of the program's or that in a file; an empty name: by the metric."""
        if name:
            self._look_by(name, self._tell)
        else:
            self._document.look(rules=None)
        rules = self._document.scene.view.rules
        self._settings.rules = "" if rules is None else rules.key

    def _look_by(self, name: str, tell: Callable[[HullquadError], object]) -> None:
        try:
            chosen = named_rules(name)
        except HullquadError as error:
            tell(error)
            return
        if chosen.key == name and Path(name).is_absolute():
            self._settings.add_rule_file(Path(name))
        self._document.look(rules=chosen)

    def _accept(self, bands: Mapping[str, Band]) -> None:
        own = {key: band for key, band in bands.items() if band != metric(key).band}
        self._document.look(bands=own)
        self._settings.bands = own


def named_rules(name: str) -> "RuleSet":
    """Rule set of the program by its key, or that in a file, whose key is then the file's name.

    Raises
    ------
    HullquadError
        There is neither, or the file is of no use.
    """
    from hullquad.rules import rule_set  # noqa: PLC0415  an empty window does not wait for it
    from hullquad.rules.built_in import KEYS  # noqa: PLC0415

    found = rule_set(name)
    return found if name in KEYS else attrs.evolve(found, key=name)
