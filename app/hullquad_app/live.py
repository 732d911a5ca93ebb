"""How a run is shown while it goes on: the view as often as possible, the panels in turns of their own."""

from functools import partial
from typing import Protocol

from PySide6.QtCore import QElapsedTimer

from hullquad_app.document import Document
from hullquad_app.scene import Scene
from hullquad_app.turns import Turns

_SELDOM = 300
"""Between two refreshes of what is read rather than watched [ms]."""


class Shows(Protocol):
    """What shows a scene."""

    def show_scene(self, scene: Scene) -> None:
        """Show it."""


class Live:
    """Has groups of widgets show the newest scene of a document, each group in its own turn."""

    def __init__(self, document: Document, turns: Turns) -> None:
        self._document, self._turns = document, turns
        self._often: list[partial[None]] = []
        self._seldom: list[partial[None]] = []
        self._since = QElapsedTimer()

    def follow(self, *group: Shows, seldom: bool = False) -> None:
        """Have a group follow every frame, or a few times a second."""
        (self._seldom if seldom else self._often).append(partial(self._show_on, group))

    def show(self) -> None:
        """Show the newest scene soon."""
        pieces = list(self._often)
        if not self._since.isValid() or self._since.hasExpired(_SELDOM):
            self._since.start()
            pieces += self._seldom
        for piece in pieces:
            self._turns.ask(piece)

    def _show_on(self, group: tuple[Shows, ...]) -> None:
        for shows in group:
            shows.show_scene(self._document.scene)
