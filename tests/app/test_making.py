"""The making of a mesh, stage by stage: shown like iterates, and not part of any run."""

from itertools import pairwise
from pathlib import Path

import pytest
from PySide6.QtCore import QSettings

from hullquad.metrics import metric
from hullquad.pipeline import MeshStage
from hullquad.quads.stages import Step
from hullquad_app.making import MOST, Making
from hullquad_app.mesher import Mesher
from hullquad_app.session import Session
from hullquad_app.settings import Settings

PLATES = Path(__file__).parents[2] / "assets" / "plates"
HOPPER = PLATES / "hopper_partition.json"


@pytest.fixture
def session(qapp, tmp_path):
    session = Session(Settings(QSettings(str(tmp_path / "settings.ini"), QSettings.Format.IniFormat)))
    yield session
    session.stop_and_wait()


@pytest.fixture
def mesh(session, qtbot):
    """Opens the hopper's partition and meshes it."""

    def act(mesher):
        session.set_mesher(mesher)
        with qtbot.waitSignal(session.opened, timeout=10_000):
            session.open(HOPPER)
        session.mesh(400.0)
        qtbot.waitUntil(lambda: session.document.scene.mesh is not None, timeout=20_000)
        return session.document.scene

    return act


@pytest.fixture
def meshed(mesh):
    return mesh(Mesher())


@pytest.fixture
def shown(session):
    """The scene after an act."""

    def act(method, *args):
        method(*args)
        return session.document.scene

    return act


def test_it_goes_from_triangles_to_the_finished_mesh(meshed):
    making = meshed.track.making
    assert [stage.stage for stage in making][:2] == ["triangulated", "joined"]
    assert [stage.number for stage in making] == list(range(-len(making), 0))
    triangles = [len(stage.mesh.topology.triangles) for stage in (*making, meshed.track.first)]
    assert all(after <= before for before, after in pairwise(triangles))


@pytest.mark.parametrize("mesher", [Mesher(), Mesher(name="paper")])
def test_every_join_is_a_stage(mesh, mesher):
    making = mesh(mesher).track.making
    joined = [len(stage.mesh.topology.quads) for stage in making if stage.stage in ("triangulated", "joined")]
    assert joined == list(range(len(joined)))
    assert len(joined) > 15


def test_the_last_stage_of_the_papers_making_lacks_one_quad(mesh):
    scene = mesh(Mesher(name="paper"))
    assert len(scene.track.making[-1].mesh.topology.quads) == len(scene.mesh.topology.quads) - 1


def test_of_thousands_of_stages_a_part_is_kept_with_the_first_and_the_last_of_each_step():
    steps = [Step.TRIANGULATED, *[Step.JOINED] * 5000, *[Step.CLEANED] * 700]
    stages = [MeshStage(step=step, candidate=0, candidates=1, is_best=False, mesh=lambda: None) for step in steps]
    kept = Making.of(stages, metric("stretch")).stages
    assert MOST / 2 < len(kept) <= MOST + len(set(steps))
    assert {stages[0], stages[5000], stages[-1]} < set(kept)


def test_stages_are_scrubbed_to_their_ends(session, meshed, shown):
    making = meshed.track.making
    assert shown(session.scrub, -1).mesh is making[-1].mesh
    assert shown(session.scrub, -len(making)).mesh is making[0].mesh
    assert shown(session.scrub_by, -1).mesh is making[0].mesh
    assert shown(session.scrub_by, 1).mesh is making[1].mesh
    assert shown(session.scrub, 0).mesh is meshed.mesh


def test_a_stage_changes_nothing(session, meshed, shown):
    count = session.document.edits.count()
    assert shown(session.scrub, -1).state is meshed.state
    assert session.document.edits.count() == count


def test_a_run_starts_from_the_finished_mesh(session, meshed, shown, qtbot):
    session.scrub(-2)
    session.run()
    qtbot.waitUntil(lambda: not session.optimizer.is_running, timeout=20_000)
    track = session.document.scene.track
    assert track.first.mesh is meshed.mesh
    assert track.last.number > 0
    assert track.making == meshed.track.making
    assert shown(session.reset).track.making == meshed.track.making


def test_the_finished_mesh_is_saved_while_a_stage_is_shown(session, meshed, qtbot, tmp_path):
    session.scrub(-1)
    with qtbot.waitSignal(session.saved) as saved:
        session.save(tmp_path / "out.vtu")
    assert saved.args == [[tmp_path / "out.vtu"]]
    with qtbot.waitSignal(session.opened):
        session.open(tmp_path / "out.vtu")
    assert session.document.scene.mesh.points.tobytes() == meshed.mesh.points.tobytes()


@pytest.mark.parametrize("mesher", ["paper", "best"])
def test_triangles_that_could_have_been_avoided_are_told(session, qtbot, mesher):
    told = []
    session.message.connect(lambda text: told.append(str(text)))
    session.set_mesher(Mesher(name=mesher))
    with qtbot.waitSignal(session.opened, timeout=10_000):
        session.open(PLATES / "floor_manholes.json")
    told.clear()
    session.mesh("coarse")
    qtbot.waitUntil(lambda: session.document.scene.mesh is not None, timeout=20_000)
    assert [text.endswith("W_TRIANGLES at /plates/0") for text in told] == [True] * (mesher == "paper")
