"""What can be done now: actions and buttons read it, and are enabled by it."""

import attrs

from hullquad_app.document import Document
from hullquad_app.jobs import Jobs


@attrs.frozen(kw_only=True)
class Abilities:
    """One claim for each intention that is not always possible."""

    can_step: bool = False
    can_run: bool = False
    can_untangle: bool = False
    """Elements of the shown mesh are inside out."""
    can_pause: bool = False
    can_reset: bool = False
    can_scrub: bool = False
    """There is more than one iterate, or the making of the mesh to show."""
    can_mesh: bool = False
    """The plate that is shown."""
    can_mesh_all: bool = False
    can_cancel: bool = False
    """What is being opened, divided or meshed."""
    can_even: bool = False
    """Contours of the document are known to have odd numbers of edges."""
    can_save: bool = False
    can_save_plates: bool = False
    can_picture: bool = False
    """A mesh is shown: there is something to judge, select and picture."""
    can_undo: bool = False
    can_redo: bool = False


def abilities(document: Document, jobs: Jobs, *, has_odd: bool) -> Abilities:
    """What can be done with a document while jobs run; whether it has odd contours."""
    scene, plates = document.scene, document.scene.state.plates
    is_meshing, is_opening, is_editing = (job.is_running for job in (jobs.meshing, jobs.opening, jobs.editing))
    may_change = not is_meshing and not is_opening and not is_editing
    has_mesh, iterates = scene.mesh is not None, 0 if scene.track is None else len(scene.track.iterates)
    is_idle = has_mesh and not scene.running and not is_meshing and not is_opening
    return Abilities(
        can_step=is_idle,
        can_run=is_idle,
        can_untangle=is_idle and scene.quality is not None and scene.quality.inverted_count > 0,
        can_pause=scene.running,
        can_reset=iterates > 1,
        can_scrub=iterates > 1 or (scene.track is not None and bool(scene.track.making)),
        can_mesh=scene.plate is not None and scene.plate.is_plane and may_change,
        can_mesh_all=plates is not None and len(plates.plates) > 1 and may_change,
        can_cancel=not may_change or jobs.dividing.is_running,
        can_even=has_odd and may_change,
        can_save=bool(scene.state.tracks) and not jobs.saving.is_running,
        can_save_plates=plates is not None and not jobs.saving.is_running,
        can_picture=has_mesh,
        can_undo=scene.running or document.edits.canUndo(),
        can_redo=not scene.running and document.edits.canRedo(),
    )
