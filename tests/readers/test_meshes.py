"""OBJ, PLY, STL, OFF and VTK, read by trimesh and meshio."""

import meshio
import numpy
import pytest
import trimesh
from conftest import column


@pytest.mark.parametrize("end", ["obj", "ply", "off"])
def test_meshes_have_every_node_and_panel(made, end):
    mesh = trimesh.load(made.folder / f"a.{end}", process=False, maintain_order=True)
    assert numpy.allclose(mesh.vertices, made.xyz, rtol=0, atol=1e-9)
    assert (mesh.faces == made.panels).all()


def test_obj_has_members_as_lines_and_groups(made, ends):
    lines = (made.folder / "a.obj").read_text().splitlines()
    drawn = [[int(k) - 1 for k in line.split()[1:]] for line in lines if line.startswith("l ")]
    assert (numpy.array(drawn) == ends).all()
    assert {"g panels", "g members", "g supports"} <= set(lines)
    assert "metres" in "\n".join(lines[:2]) and "seed 7" in "\n".join(lines[:2])


def test_ply_has_the_measures_as_properties(made, ends, lengths):
    mesh = trimesh.load(made.folder / "a.ply", process=False)
    raw = mesh.metadata["_ply_raw"]
    assert numpy.allclose(raw["edge"]["data"]["length"].ravel(), lengths, rtol=0, atol=1e-9)
    assert (raw["edge"]["data"]["vertex1"].ravel() == ends[:, 0]).all()
    assert (raw["vertex"]["data"]["degree"].ravel() == column(made.nodes, "degree")).all()
    area = raw["face"]["data"]["area"].ravel()
    assert numpy.allclose(area, mesh.area_faces, rtol=0, atol=1e-9)


def test_stl_has_every_panel_in_single_precision(made):
    mesh = trimesh.load(made.folder / "a.stl", process=False)
    single = made.xyz[made.panels].astype("float32")
    assert (mesh.triangles.astype("float32") == single).all()
    assert b"seed 7" in (made.folder / "a.stl").read_bytes()[:80]


def test_vtk_has_panels_members_and_measures(made, ends, lengths):
    mesh = meshio.read(made.folder / "a.vtu")
    assert numpy.allclose(mesh.points, made.xyz, rtol=0, atol=1e-9)
    assert (mesh.cells_dict["triangle"] == made.panels).all()
    assert (mesh.cells_dict["line"] == ends).all()
    assert numpy.allclose(mesh.cell_data_dict["length"]["line"], lengths, rtol=0, atol=1e-9)
    area = mesh.cell_data_dict["area"]["triangle"]
    assert numpy.allclose(area, column(made.plates, "area [m2]"), rtol=0, atol=1e-9)
    assert (mesh.point_data["support"] == column(made.nodes, "support")).all()
