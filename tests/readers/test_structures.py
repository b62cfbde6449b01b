"""SAF by openpyxl, IFC by ifcopenshell's validator, OpenSees by openseespy."""

import logging
import os

import ifcopenshell
import ifcopenshell.util.element
import ifcopenshell.validate
import numpy
import openpyxl
import pytest
from conftest import column, gridshell

# Columns that the specification requires, with what makes them valid.
ANY = object()
REQUIRED = {
    "StructuralMaterial": {"Name": ANY, "Type": {"Steel", "Timber", "Aluminium", "Other"}, "Quality": ANY},
    "StructuralCrossSection": {
        "Name": ANY,
        "Material": ANY,
        "Cross-section type": {"Parametric"},
        "Shape": {"Tube", "Pipe", "Rectangle"},
        "Parameters [mm]": ANY,
    },
    "StructuralPointConnection": {
        "Name": ANY,
        "Coordinate X [m]": float,
        "Coordinate Y [m]": float,
        "Coordinate Z [m]": float,
    },
    "StructuralCurveMember": {
        "Name": ANY,
        "Cross section": {"CS1"},
        "Nodes": ANY,
        "Segments": {"Line"},
        "Begin node": ANY,
        "End node": ANY,
        "LCS": {"z by vector"},
        "LCS Rotation [deg]": float,
        "Coordinate X [m]": float,
        "Coordinate Y [m]": float,
        "Coordinate Z [m]": float,
        "System line": {"Centre"},
        "Analysis Y Eccentricity of Beg Node [mm]": float,
        "Analysis Z Eccentricity of Beg Node [mm]": float,
        "Analysis Y Eccentricity of End Node [mm]": float,
        "Analysis Z Eccentricity of End Node [mm]": float,
        "Behaviour in analysis": {"Standard"},
    },
    "StructuralSurfaceMember": {
        "Name": ANY,
        "Material": ANY,
        "Thickness type": {"Constant"},
        "Thickness [mm]": float,
        "System plane at": {"Centre"},
        "Nodes": ANY,
        "Edges": {"Line;Line;Line"},
        "LCS Type": {"x by vector"},
        "Coordinate X [m]": float,
        "Coordinate Y [m]": float,
        "Coordinate Z [m]": float,
        "LCS Rotation [deg]": float,
        "Analysis Z Eccentricity [mm]": float,
        "Behavior in analysis": {"Isotropic"},
    },
    "StructuralPointSupport": {
        "Name": ANY,
        "Node": ANY,
        "ux": {"Rigid"},
        "uy": {"Rigid"},
        "uz": {"Rigid"},
        "fix": {"Free"},
        "fiy": {"Free"},
        "fiz": {"Free"},
    },
}
MODEL = {
    "Global coordinate system": "Z vertical",
    "LCS of cross-section": "ZYX",
    "System of units": "Metric",
    "National code": "EC-Standard-EN",
}


def sheets(path):
    """Every sheet as a list of rows, and the two of properties as dictionaries."""
    book = openpyxl.load_workbook(path, read_only=True)
    tables, properties = {}, {}
    for sheet in book.worksheets:
        rows = list(sheet.iter_rows(values_only=True))
        if sheet.title in ("Project", "Model"):
            properties[sheet.title] = {row[0]: row[1] for row in rows}
        else:
            tables[sheet.title] = [dict(zip(rows[0], row)) for row in rows[1:]]
    return tables, properties


def test_saf_has_the_sheets_and_columns_of_the_specification(made):
    tables, properties = sheets(made.folder / "a.saf.xlsx")
    assert set(tables) == set(REQUIRED)
    model = properties["Model"]
    assert {key: model[key] for key in MODEL} == MODEL
    assert model["SAF Version"] == "2.0.0"
    assert "seed 7" in model["Description"] and made.run["version"] in model["Source application"]
    for name, columns in REQUIRED.items():
        names = [row["Name"] for row in tables[name]]
        assert len(set(names)) == len(names) > 0, name
        for row in tables[name]:
            for key, valid in columns.items():
                value = row[key]
                assert value is not None, (name, key)
                if valid is float:
                    assert isinstance(value, (int, float)), (name, key, value)
                elif valid is not ANY:
                    assert value in valid, (name, key, value)


def test_saf_refers_to_what_is_there_and_agrees(made, ends, lengths):
    tables, _ = sheets(made.folder / "a.saf.xlsx")
    nodes = {row["Name"]: k for k, row in enumerate(tables["StructuralPointConnection"])}
    axes = [f"Coordinate {x} [m]" for x in "XYZ"]
    xyz = [[row[x] for x in axes] for row in tables["StructuralPointConnection"]]
    assert numpy.allclose(xyz, made.xyz, rtol=0, atol=1e-9)
    members = tables["StructuralCurveMember"]
    joined = [[nodes[n] for n in row["Nodes"].split(";")] for row in members]
    assert (numpy.array(joined) == ends).all()
    assert numpy.allclose([row["Length [m]"] for row in members], lengths, rtol=0, atol=1e-9)
    normals = numpy.array([[row[x] for x in axes] for row in members])
    told = numpy.stack([column(made.members, f"normal {x}") for x in "xyz"], axis=1)
    assert numpy.allclose(normals, told, rtol=0, atol=1e-9)
    along = made.xyz[ends[:, 1]] - made.xyz[ends[:, 0]]
    assert numpy.abs((normals * along).sum(axis=1)).max() < 1e-9
    panels = [[nodes[n] for n in row["Nodes"].split(";")] for row in tables["StructuralSurfaceMember"]]
    assert (numpy.array(panels) == made.panels).all()
    held = [nodes[row["Node"]] for row in tables["StructuralPointSupport"]]
    assert held == made.truth["supports"]
    materials = {row["Name"] for row in tables["StructuralMaterial"]}
    assert tables["StructuralCrossSection"][0]["Material"] in materials


def test_saf_options_replace_what_is_stated(made):
    options = ["--saf", "1.0.5", "--section", "CHS 88.9x5", "--material", "S235", "--supports", "none"]
    gridshell(made.folder, "convert", "a.gridshell", "-o", "old.saf.xlsx", *options)
    tables, properties = sheets(made.folder / "old.saf.xlsx")
    assert properties["Model"]["SAF Version"] == "1.0.5"
    section = tables["StructuralCrossSection"][0]
    assert (section["Shape"], section["Parameters [mm]"]) == ("Pipe", "88.9;5")
    assert tables["StructuralMaterial"][0]["Name"] == section["Material"] == "S235"
    assert tables["StructuralPointSupport"] == []


def test_ifc_is_valid_and_complete(made, ends, lengths):
    model = ifcopenshell.open(made.folder / "a.ifc")
    assert not faults_of(model)
    assembly = model.by_type("IfcElementAssembly")[0]
    parts = ifcopenshell.util.element.get_decomposition(assembly)
    members = model.by_type("IfcMember")
    plates = model.by_type("IfcPlate")
    assert len(members) == len(ends) and len(plates) == len(made.panels)
    assert len(parts) == len(members) + len(plates)
    facts = ifcopenshell.util.element.get_psets(assembly)["Gridshell"]
    assert facts["Seed"] == "7" and facts["Units"] == "m"
    for k, member in enumerate(members):
        shapes = {s.RepresentationIdentifier: s.Items[0] for s in member.Representation.Representations}
        axis = [point.Coordinates for point in shapes["Axis"].Points]
        assert numpy.allclose(axis, made.xyz[ends[k]], rtol=0, atol=1e-9)
        body = shapes["Body"]
        assert abs(body.Depth - lengths[k]) < 1e-9
        assert ifcopenshell.util.element.get_material(member).Name == "S355"
        # The profile's y stands along the member's normal.
        x = numpy.array(body.Position.RefDirection.DirectionRatios)
        z = numpy.array(body.Position.Axis.DirectionRatios)
        normal = [float(made.members[k][f"normal {c}"]) for c in "xyz"]
        assert numpy.allclose(numpy.cross(z, x), normal, rtol=0, atol=1e-9)
    for k, plate in enumerate(plates):
        face = plate.Representation.Representations[0].Items[0]
        assert face.CoordIndex == ((1, 2, 3),)
        corners = face.Coordinates.CoordList
        assert numpy.allclose(corners, made.xyz[made.panels[k]], rtol=0, atol=1e-9)


def test_ifc_has_the_frame_and_what_holds_it(made, ends):
    model = ifcopenshell.open(made.folder / "a.ifc")
    frame = model.by_type("IfcStructuralAnalysisModel")[0]
    assert frame.ServicesBuildings[0].RelatedBuildings[0].is_a("IfcBuilding")
    assert len(frame.IsGroupedBy[0].RelatedObjects) == len(made.xyz) + len(ends)
    nodes = model.by_type("IfcStructuralPointConnection")
    places = [n.Representation.Representations[0].Items[0].VertexGeometry.Coordinates for n in nodes]
    assert numpy.allclose(places, made.xyz, rtol=0, atol=1e-9)
    held = [k for k, node in enumerate(nodes) if node.AppliedCondition]
    assert held == made.truth["supports"]
    support = model.by_type("IfcBoundaryNodeCondition")[0]
    moves = [support.TranslationalStiffnessX, support.TranslationalStiffnessY, support.TranslationalStiffnessZ]
    turns = [support.RotationalStiffnessX, support.RotationalStiffnessY, support.RotationalStiffnessZ]
    assert [s.wrappedValue for s in moves + turns] == [True] * 3 + [False] * 3
    members = model.by_type("IfcStructuralCurveMember")
    for k, member in enumerate(members):
        joined = [c.RelatedStructuralConnection.Name for c in member.ConnectedBy]
        assert joined == [f"N{v}" for v in ends[k]]
        normal = [float(made.members[k][f"normal {c}"]) for c in "xyz"]
        assert numpy.allclose(member.Axis.DirectionRatios, normal, rtol=0, atol=1e-9)
    section = ifcopenshell.util.element.get_material(members[0]).MaterialProfiles[0]
    assert section.Material.Name == "S355" and section.Profile.is_a("IfcRectangleHollowProfileDef")


def test_ifc_without_supports_is_valid_and_has_no_frame(made):
    gridshell(made.folder, "convert", "a.gridshell", "-o", "loose.ifc", "--supports", "none")
    model = ifcopenshell.open(made.folder / "loose.ifc")
    assert not model.by_type("IfcStructuralItem") and not faults_of(model)


def faults_of(model):
    """What the validator finds wrong."""
    logger = ifcopenshell.validate.json_logger()
    ifcopenshell.validate.validate(model, logger, express_rules=True)
    return [s for s in logger.statements if s.get("severity", "error").lower() != "info"]


def commands(path):
    """The commands of an OpenSees input: one a line, without loops."""
    for line in path.read_text().splitlines():
        words = line.replace("{", "").replace("}", "").split()
        if words and not line.startswith("#"):
            yield words[0], [number(word) for word in words[1:]]


def number(word):
    try:
        return int(word)
    except ValueError:
        pass
    try:
        return float(word)
    except ValueError:
        return word


def weight_of(path):
    """The weight that the loads add up to, by their directions, with the numbers of everything."""
    counts = {}
    for name, _ in commands(path):
        counts[name] = counts.get(name, 0) + 1
    last = path.read_text().splitlines()[-1]
    return float(last.split()[-2]), counts


def test_opensees_has_every_node_member_and_load(made, ends, lengths):
    weight, counts = weight_of(made.folder / "a.tcl")
    assert counts["node"] == len(made.xyz) and counts["fix"] == len(made.truth["supports"])
    assert counts["element"] == counts["geomTransf"] == counts["eleLoad"] == len(ends)
    loads = [args for name, args in commands(made.folder / "a.tcl") if name == "eleLoad"]
    size = numpy.linalg.norm([args[-3:] for args in loads], axis=1)
    assert abs(size @ lengths - weight) < 1e-6 * weight


def test_opensees_stands_and_the_reactions_are_the_weight(made):
    if os.environ.get("GRIDSHELL_OPENSEES"):
        pytest.skip(os.environ["GRIDSHELL_OPENSEES"])
    import openseespy.opensees as ops

    weight, _ = weight_of(made.folder / "a.tcl")
    for name, args in commands(made.folder / "a.tcl"):
        result = getattr(ops, name)(*args)
        assert name != "analyze" or result == 0
    reactions = numpy.array([ops.nodeReaction(v + 1)[:3] for v in made.truth["supports"]]).sum(axis=0)
    assert abs(reactions[2] - weight) < 1e-6 * weight
    assert numpy.abs(reactions[:2]).max() < 1e-6 * weight
    sag = min(ops.nodeDisp(v + 1, 3) for v in range(len(made.xyz)))
    assert -1.0 < sag < 0.0
