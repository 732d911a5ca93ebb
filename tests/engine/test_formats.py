"""A file's format is found by the ending of its name."""

from pathlib import Path

import numpy as np
import pytest

from hullquad import formats
from hullquad.errors import FileError
from hullquad.mesh import Mesh
from hullquad.topology import topology

BARE = Mesh(
    points=[[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]],
    topology=topology(np.array([[0, 1, 2, 3]], dtype=np.int32), np.ones(4, dtype=np.int8)),
    target_size=1.0,
)


@pytest.mark.parametrize("name", ["mesh.vtu", "MESH.VTU", "a.b.vtu"])
def test_the_ending_chooses_the_format(tmp_path, name):
    formats.check_output(tmp_path / name)
    formats.write_mesh(BARE, tmp_path / name)
    assert formats.read_mesh(tmp_path / name).points.tolist() == BARE.points.tolist()


@pytest.mark.parametrize("name", ["mesh.stl", "mesh", "mesh.json", ".vtu"])
def test_an_unknown_ending_is_refused_and_the_known_are_listed(tmp_path, name):
    with pytest.raises(FileError, match=r"only to \.vtu") as caught:
        formats.check_output(tmp_path / name)
    assert caught.value.key == "E_SUFFIX:write_mesh"
    with pytest.raises(FileError, match=r"only from \.vtu"):
        formats.read_mesh(tmp_path / name)


def test_plates_are_read_from_plate_documents_only(tmp_path):
    partition = Path(__file__).parents[2] / "assets" / "plates" / "hopper_partition.json"
    assert len(formats.read_plates(partition).plates) == 1
    with pytest.raises(FileError, match=r"only from \.json"):
        formats.read_plates(tmp_path / "mesh.vtu")


def test_an_output_in_no_folder_is_refused_beforehand(tmp_path):
    with pytest.raises(FileError, match="no folder"):
        formats.check_output(tmp_path / "no" / "mesh.vtu")


def test_checking_an_output_makes_no_file(tmp_path):
    formats.check_output(tmp_path / "mesh.vtu")
    assert list(Path(tmp_path).iterdir()) == []
