"""Where each plate was left: which of its iterates was shown last."""

from hullquad.optimization.iterate import Iterate
from hullquad_app.scene import Scene
from hullquad_app.track import Track


class Bookmarks:
    """The iterate of each plate that is shown, saved and continued from."""

    def __init__(self) -> None:
        self._shown: dict[str, Iterate] = {}

    def remember(self, scene: Scene) -> None:
        """Note what is shown; iterates of a run that goes on may not stay, and are not noted."""
        if not scene.running:
            keys = scene.state.keys
            self._shown = {key: iterate for key, iterate in self._shown.items() if key in keys}
            if scene.view.key is not None and scene.iterate is not None and scene.stage is None:
                self._shown[scene.view.key] = scene.iterate

    def row(self, key: str, track: Track) -> int:
        """Position where a plate was left; else of the best iterate if its last run ended by itself, else the last."""
        shown = self._shown.get(key)
        for row, iterate in enumerate(track.iterates):
            if iterate is shown:
                return row
        return len(track.iterates) - 1 if track.last.stop is None else track.best_of_run(0)
