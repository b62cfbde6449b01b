"""glTF by the Khronos validator and pygltflib, DXF by ezdxf, COMPAS by itself."""

import json
import os
import subprocess
from pathlib import Path

import compas
import ezdxf
import numpy
import pygltflib
import trimesh


def test_gltf_is_valid_and_complete(made, ends, lengths):
    script = Path(__file__).with_name("validate_gltf.js")
    paths = {**os.environ, "NODE_PATH": os.environ["GRIDSHELL_NODE"]}
    report = subprocess.run(
        ["node", script, made.folder / "a.glb"], env=paths, check=True, capture_output=True
    )
    issues = json.loads(report.stdout)["issues"]
    assert issues["numErrors"] == issues["numWarnings"] == 0, issues["messages"]

    gltf = pygltflib.GLTF2().load(made.folder / "a.glb")
    assert gltf.asset.extras["seed"] == 7 and gltf.asset.extras["units"] == "m"
    meshes = {mesh.name: mesh for mesh in gltf.meshes}
    panels, members = meshes["panels"], meshes["members"]
    count = lambda accessor: gltf.accessors[accessor].count
    assert count(panels.primitives[0].indices) == 3 * len(made.panels)
    assert count(panels.primitives[0].attributes.COLOR_0) == len(made.xyz)
    assert count(members.primitives[0].attributes.POSITION) == 2 * len(ends)
    assert numpy.allclose(members.extras["length"], lengths, rtol=0, atol=1e-9)
    assert meshes["supports"].extras["nodes"] == made.truth["supports"]


def test_gltf_stands_upright(made):
    scene = trimesh.load(made.folder / "a.glb")
    low, high = scene.bounds
    y_up = numpy.stack([made.xyz[:, 0], made.xyz[:, 2], -made.xyz[:, 1]], axis=1)
    size = numpy.abs(y_up).max()
    assert numpy.allclose(low, y_up.min(axis=0), rtol=0, atol=1e-6 * size)
    assert numpy.allclose(high, y_up.max(axis=0), rtol=0, atol=1e-6 * size)


def test_dxf_passes_the_audit_and_is_complete(made, ends):
    drawing = ezdxf.readfile(made.folder / "a.dxf")
    audit = drawing.audit()
    assert not audit.errors and not audit.fixes, [str(e.message) for e in audit.errors + audit.fixes]
    assert drawing.header["$INSUNITS"] == 6 and drawing.dxfversion == "AC1015"
    space = drawing.modelspace()
    lines = space.query('LINE[layer=="members"]')
    drawn = numpy.array([[line.dxf.start, line.dxf.end] for line in lines])
    assert numpy.allclose(drawn, made.xyz[ends], rtol=0, atol=1e-9)
    faces = space.query('3DFACE[layer=="panels"]')
    drawn = numpy.array([[f.dxf.vtx0, f.dxf.vtx1, f.dxf.vtx2] for f in faces])
    assert numpy.allclose(drawn, made.xyz[made.panels], rtol=0, atol=1e-9)
    points = space.query('POINT[layer=="nodes"]')
    drawn = numpy.array([point.dxf.location for point in points])
    assert numpy.allclose(drawn, made.xyz, rtol=0, atol=1e-9)
    irregular = made.run["irregular"]
    assert len(space.query('POINT[layer=="irregular"]')) == len(irregular)
    loops = space.query('POLYLINE[layer=="boundary"]')
    assert len(loops) == made.run["surface"]["loops"]
    assert sum(len(loop.vertices) for loop in loops) == made.run["quality"]["boundary_nodes"]
    assert all(loop.is_closed for loop in loops)


def test_compas_loads_the_mesh_with_its_data(made, ends, lengths):
    mesh = compas.json_load(made.folder / "a.compas.json")
    assert mesh.is_valid() and mesh.is_manifold()
    assert mesh.number_of_vertices() == len(made.xyz)
    assert mesh.number_of_faces() == len(made.panels)
    assert mesh.number_of_edges() == len(ends)
    xyz = [mesh.vertex_coordinates(v) for v in range(len(made.xyz))]
    assert numpy.allclose(xyz, made.xyz, rtol=0, atol=1e-9)
    assert [mesh.face_vertices(f) for f in range(len(made.panels))] == made.panels.tolist()
    told = [mesh.edge_attribute((int(a), int(b)), "length") for a, b in ends]
    assert numpy.allclose(told, lengths, rtol=0, atol=1e-9)
    supports = [v for v in mesh.vertices() if mesh.vertex_attribute(v, "is_support")]
    assert supports == made.truth["supports"]
    assert mesh.attributes["seed"] == 7 and mesh.attributes["units"] == "m"
