"""Make the small test files in this folder and table.csv, what OpenCascade measures of them.

    python -m venv somewhere && somewhere/bin/pip install cadquery-ocp==8.0.1.1.0 rhino3dm==8.35.0
    somewhere/bin/python make.py [NAME]...

One function a shape; its decorator names the files it is written to. Lengths are metres here, and
millimetres inside OpenCascade. Columns of the table: area in m2; the numbers of faces, of boundary loops
and of corners in them (turning by more than 0.5 rad). `joined` tells how faces meet: by shared edges, or
only where they are sewn (then loops and corners are those of the sewn shape); `solid` files also bound
space with shells that have no boundary at all.
"""

import csv
import math
import re
import sys
from pathlib import Path

from OCP import collections as col
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import (
    BRepBuilderAPI_MakeEdge,
    BRepBuilderAPI_MakeFace,
    BRepBuilderAPI_MakePolygon,
    BRepBuilderAPI_MakeVertex,
    BRepBuilderAPI_MakeWire,
    BRepBuilderAPI_Sewing,
    BRepBuilderAPI_Transform,
)
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet
from OCP.BRepGProp import BRepGProp
from OCP.BRepLib import BRepLib
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepOffsetAPI import BRepOffsetAPI_ThruSections
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeBox,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakePrism,
    BRepPrimAPI_MakeSphere,
)
from OCP.BRepTools import BRepTools
from OCP.Geom import (
    Geom_BezierSurface,
    Geom_BSplineCurve,
    Geom_BSplineSurface,
    Geom_ConicalSurface,
    Geom_CylindricalSurface,
    Geom_Ellipse,
    Geom_Hyperbola,
    Geom_Line,
    Geom_OffsetSurface,
    Geom_Parabola,
    Geom_Plane,
    Geom_SphericalSurface,
    Geom_SurfaceOfLinearExtrusion,
    Geom_SurfaceOfRevolution,
    Geom_ToroidalSurface,
    Geom_TrimmedCurve,
)
from OCP.Geom2d import Geom2d_BSplineCurve, Geom2d_Circle, Geom2d_Line, Geom2d_TrimmedCurve
from OCP.GeomAPI import GeomAPI_Interpolate
from OCP.gp import gp_Ax1, gp_Ax2, gp_Ax2d, gp_Ax3, gp_Dir, gp_Dir2d, gp_Pnt, gp_Pnt2d, gp_Trsf, gp_Vec
from OCP.GProp import GProp_GProps
from OCP.IGESControl import IGESControl_Writer
from OCP.Interface import Interface_Static
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Compound, TopoDS_Shell
from OCP.XCAFDoc import XCAFDoc_DocumentTool

HERE = Path(__file__).parent
M = 1000.0  # a metre in OpenCascade's unit
TAU = 2 * math.pi
CORNER = 0.5
ROWS = []
TASKS = []


# ---------------------------------------------------------------- small words


def P(x, y, z):
    return gp_Pnt(x * M, y * M, z * M)


def axes(at=(0, 0, 0), z=(0, 0, 1), x=(1, 0, 0)):
    return gp_Ax3(P(*at), gp_Dir(*z), gp_Dir(*x))


def ax2(*a):
    return axes(*a).Ax2()


def array(kind, items):
    a = getattr(col, "Array1_" + kind)(1, len(items))
    for i, x in enumerate(items):
        a.SetValue(i + 1, x)
    return a


def array2(kind, rows):
    a = getattr(col, "Array2_" + kind)(1, len(rows), 1, len(rows[0]))
    for i, row in enumerate(rows):
        for j, x in enumerate(row):
            a.SetValue(i + 1, j + 1, x)
    return a


def knots(count, degree):
    """Clamped, even."""
    spans = count - degree
    return list(range(spans + 1)), [degree + 1] + [1] * (spans - 1) + [degree + 1]


def bspline(height, count, degree, size=(10, 8), weight=None):
    """A clamped B-spline surface over a rectangle with control points at `height(i, j)`."""
    (nu, nv), (p, q) = count, degree
    at = lambda i, j: P(size[0] * i / (nu - 1), size[1] * j / (nv - 1), height(i, j))
    poles = array2("gp_Pnt", [[at(i, j) for j in range(nv)] for i in range(nu)])
    (ku, mu), (kv, mv) = knots(nu, p), knots(nv, q)
    parts = [array("double", [float(k) for k in x]) for x in (ku, kv)]
    parts += [array("int", m) for m in (mu, mv)]
    if weight is None:
        return Geom_BSplineSurface(poles, *parts, p, q)
    weights = array2("double", [[weight(i, j) for j in range(nv)] for i in range(nu)])
    return Geom_BSplineSurface(poles, weights, *parts, p, q)


def wave(i, j):
    return 1.1 * math.sin(0.9 * i) * math.cos(0.7 * j)


def through(points, closed=False):
    pts = col.HArray1_gp_Pnt(1, len(points))
    for i, p in enumerate(points):
        pts.SetValue(i + 1, P(*p))
    maker = GeomAPI_Interpolate(pts, closed, 1e-7)
    maker.Perform()
    return maker.Curve()


def face(surface, *bounds):
    """All of a surface, or the part between these parameters."""
    maker = BRepBuilderAPI_MakeFace(surface, *bounds, 1e-6)
    BRepLib.BuildCurves3d_s(maker.Face())
    return maker.Face()


def edge2d(surface, curve, a, b):
    return BRepBuilderAPI_MakeEdge(Geom2d_TrimmedCurve(curve, a, b), surface).Edge()


def circle2d(surface, u, v, r):
    axis = gp_Ax2d(gp_Pnt2d(u, v), gp_Dir2d(1, 0))
    return wire(BRepBuilderAPI_MakeEdge(Geom2d_Circle(axis, r), surface).Edge())


def polygon2d(surface, points):
    edges = []
    for (a, b), (c, d) in zip(points, points[1:] + points[:1]):
        length = math.hypot(c - a, d - b)
        line = Geom2d_Line(gp_Pnt2d(a, b), gp_Dir2d(c - a, d - b))
        edges.append(edge2d(surface, line, 0, length))
    return wire(*edges)


def wire(*edges):
    maker = BRepBuilderAPI_MakeWire()
    for e in edges:
        maker.Add(e)
    w = maker.Wire()
    BRepLib.BuildCurves3d_s(w)
    return w


def trimmed(surface, outer, *holes):
    maker = BRepBuilderAPI_MakeFace(surface, outer, True)
    for h in holes:
        maker.Add(TopoDS.Wire(h.Reversed()))
    BRepLib.BuildCurves3d_s(maker.Face())
    return maker.Face()


def polygon(points):
    maker = BRepBuilderAPI_MakePolygon()
    for p in points:
        maker.Add(P(*p))
    maker.Close()
    return maker.Wire()


def ellipse(at, a, b, z=(0, 0, 1), x=(1, 0, 0)):
    curve = Geom_Ellipse(ax2(at, z, x), a * M, b * M)
    return wire(BRepBuilderAPI_MakeEdge(curve).Edge())


def flat(outer, *holes):
    maker = BRepBuilderAPI_MakeFace(outer, True)
    for h in holes:
        maker.Add(TopoDS.Wire(h.Reversed()))
    return maker.Face()


def compound(*shapes):
    c, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(c)
    for s in shapes:
        builder.Add(c, s)
    return c


def shell(*faces):
    c, builder = TopoDS_Shell(), BRep_Builder()
    builder.MakeShell(c)
    for s in faces:
        builder.Add(c, s)
    return c


def sewn(tolerance, *shapes):
    maker = BRepBuilderAPI_Sewing(tolerance * M)
    for s in shapes:
        maker.Add(s)
    maker.Perform()
    return maker.SewedShape()


def moved(shape, at=(0, 0, 0), axis=(0, 0, 1), angle=0.0, mirror=None):
    spin, shift = gp_Trsf(), gp_Trsf()
    if angle:
        spin.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(*axis)), angle)
    if mirror:
        spin.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(*mirror)))
    shift.SetTranslation(gp_Vec(*(M * x for x in at)))
    return BRepBuilderAPI_Transform(shape, shift.Multiplied(spin), True).Shape()


def parts(shape, kind):
    walk = TopExp_Explorer(shape, getattr(TopAbs_ShapeEnum, "TopAbs_" + kind))
    while walk.More():
        yield walk.Current()
        walk.Next()


def faces(shape):
    return [TopoDS.Face(f) for f in parts(shape, "FACE")]


# ---------------------------------------------------------------- what is measured


def area(shape):
    """By OpenCascade's integrals where those of three tolerances agree, else (rational patches with very
    uneven weights, offsets) by fine meshes of the face and what they lead to."""
    return sum(face_area(f) for f in faces(shape)) / (M * M)


def face_area(f):
    by = []
    for tolerance in (1e-3, 1e-6, 1e-8):
        props = GProp_GProps()
        BRepGProp.SurfaceProperties_s(f, props, tolerance)
        by.append(props.Mass())
    if max(by) - min(by) < 2e-6 * max(by):
        return by[-1]
    coarse, fine = (mesh_area(f, d) for d in (1.0, 0.25))
    return fine + (fine - coarse) / 3


def mesh_area(f, deflection):
    """Area of a mesh this many millimetres off at most; it misses by a share of that."""
    BRepTools.Clean_s(f)
    BRepMesh_IncrementalMesh(f, deflection, False, 0.5, False)
    mesh = BRep_Tool.Triangulation_s(f, TopLoc_Location())
    total = 0.0
    for i in range(1, mesh.NbTriangles() + 1):
        a, b, c = (mesh.Node(n) for n in mesh.Triangle(i).Get())
        total += gp_Vec(a, b).Crossed(gp_Vec(a, c)).Magnitude() / 2
    BRepTools.Clean_s(f)
    return total


def boundary(shape):
    """Loops of the edges that have one face, and corners on them."""
    uses, kept = {}, {}
    for f in faces(shape):
        for e in parts(f, "EDGE"):
            e = TopoDS.Edge(e)
            if BRep_Tool.Degenerated_s(e):
                continue
            key = next((k for k in uses if kept[k].IsSame(e)), len(kept))
            kept.setdefault(key, e)
            uses[key] = uses.get(key, 0) + 1
    free = [kept[k] for k, n in uses.items() if n == 1]
    ends = []  # vertex, edge, tangent leaving the vertex
    for n, e in enumerate(free):
        e = TopoDS.Edge(e.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
        curve, walk = BRepAdaptor_Curve(e), list(parts(e, "VERTEX"))
        for v in walk:
            last = v.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
            t = curve.LastParameter() if last else curve.FirstParameter()
            p, d = gp_Pnt(), gp_Vec()
            curve.D1(t, p, d)
            ends.append((v, n, d.Reversed() if last else d))
    joint, at = [], []
    for v, n, d in ends:
        k = next((k for k, w in enumerate(at) if w.IsSame(v)), len(at))
        if k == len(at):
            at.append(v)
            joint.append([])
        joint[k].append((n, d))
    group = list(range(len(free)))
    corners = 0
    for two in joint:
        assert len(two) == 2, f"{len(two)} boundary edges meet"
        (a, d), (b, e) = two
        group = [group[a] if g == group[b] else g for g in group]
        turn = math.pi - d.Angle(e)
        assert abs(turn - CORNER) > 0.05, "a corner that may be none"
        corners += turn > CORNER
    return len(set(group)), corners


# ---------------------------------------------------------------- what is written


def row(file, what, shape, joined):
    loops, corners = boundary(sewn(2e-3, shape) if joined == "sewn" else shape)
    ROWS.append([file, what, f"{area(shape):.9g}", len(faces(shape)), loops, corners, joined])


def step(name, schema="AP214IS", unit="M", pcurves=False):
    def write(shape, what, joined, text=lambda t: t):
        writer = STEPControl_Writer()
        Interface_Static.SetCVal_s("write.step.schema", schema)
        Interface_Static.SetCVal_s("write.step.unit", unit)
        Interface_Static.SetIVal_s("write.surfacecurve.mode", int(pcurves))
        Interface_Static.SetCVal_s("write.step.product.name", name)
        writer = STEPControl_Writer()
        writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
        path = HERE / f"{name}.step"
        writer.Write(str(path))
        plain(path, text)
        row(path.name, what, shape, joined)

    return write


def plain(path, text=lambda t: t):
    """The same at every run: no date, no spare digits or blanks."""
    t = path.read_text()
    t = re.sub(r"'\d{4}-\d\d-\d\dT[\d:]+'", "'2026-01-01T00:00:00'", t)
    path.write_text(text(t))


def iges(name, unit="M", brep=False):
    def write(shape, what, joined, text=None):
        path = HERE / f"{name}.igs"
        writer = IGESControl_Writer(unit, int(brep))
        writer.AddShape(shape)
        writer.ComputeModel()
        writer.Write(str(path))
        t = path.read_text()
        t = re.sub(r"15H\d{8}\.\d{6}", "15H20260101.000000", t)
        path.write_text(t)
        row(path.name, what, shape, "sewn" if joined == "shared" and not brep else joined)

    return write


def case(what, *writers, joined="shared", text=None):
    def keep(make):
        def task():
            shape = make()
            for w in writers:
                w(shape, what, joined, *([text] if text else []))

        TASKS.append((make.__name__, task))
        return make

    return keep


# ---------------------------------------------------------------- one unit, one schema, one format each


def cubic():
    return bspline(lambda i, j: 0.4 * wave(i, j), (6, 5), (3, 3))


def court():
    """A doubly curved patch with a notch and two holes: straight, elliptic and free edges."""
    s = cubic()
    (u, v) = (3.0, 2.0)
    at = [(0.02, 0.02), (0.98, 0.02), (0.98, 0.5), (0.8, 0.55), (0.98, 0.6), (0.98, 0.98), (0.02, 0.98)]
    outer = polygon2d(s, [(u * a, v * b) for a, b in at])
    return trimmed(s, outer, circle2d(s, 0.9, 0.9, 0.3), circle2d(s, 2.0, 0.6, 0.2))


@case(
    "one roof, in every unit, schema and format",
    step("roof_m_ap203", "AP203", "M", pcurves=True),
    step("roof_mm_ap214", "AP214IS", "MM", pcurves=True),
    step("roof_inch_ap242", "AP242DIS", "INCH", pcurves=True),
    step("roof_no_pcurves"),
    iges("roof_m", "M"),
    iges("roof_mm", "MM"),
    iges("roof_inch_brep", "IN", brep=True),
)
def roof():
    return court()


# ---------------------------------------------------------------- analytic surfaces


@case("sphere cap with its pole and seam", step("sphere_cap"), iges("sphere_cap"))
def sphere_cap():
    return face(Geom_SphericalSurface(axes(), 4 * M), 0, TAU, 0.3, math.pi / 2)


@case("zone of a sphere, no pole", step("sphere_zone"))
def sphere_zone():
    return face(Geom_SphericalSurface(axes(z=(0.2, 0.1, 1)), 4 * M), 0, TAU, -0.6, 0.9)


@case("whole sphere and whole torus: no boundary", step("sphere_and_torus"), joined="solid")
def sphere_and_torus():
    torus = moved(face(Geom_ToroidalSurface(axes(), 4 * M, M)), (12, 0, 0))
    return compound(face(Geom_SphericalSurface(axes(), 2 * M)), torus)


@case("sphere patch across the seam with a hole across it", step("sphere_seam"))
def sphere_seam():
    s = Geom_SphericalSurface(axes(), 5 * M)
    outer = polygon2d(s, [(5.6, -0.5), (7.2, -0.5), (7.2, 0.8), (5.6, 0.8)])
    return trimmed(s, outer, circle2d(s, TAU, 0.1, 0.3))


@case("wedge of a sphere from pole to pole", step("sphere_wedge"))
def sphere_wedge():
    return face(Geom_SphericalSurface(axes(), 4 * M), 0.4, 1.9, -math.pi / 2, math.pi / 2)


@case("cylinder all round, with a round hole across the seam", step("cylinder_hole"), iges("cylinder_hole"))
def cylinder_hole():
    tube = BRepPrimAPI_MakeCylinder(2 * M, 6 * M).Shape()
    drill = moved(BRepPrimAPI_MakeCylinder(0.8 * M, 9 * M).Shape(), (0, 0, 3), (0, 1, 0), math.pi / 2)
    whole = BRepAlgoAPI_Cut(tube, drill).Shape()
    return max(faces(whole), key=area)


@case("half cylinder, reversed", step("cylinder_half"))
def cylinder_half():
    return face(Geom_CylindricalSurface(axes(), 3 * M), 2.0, 2.0 + math.pi, 0, 7 * M).Reversed()


@case("cone with its tip", step("cone_tip"), iges("cone_tip", brep=True))
def cone_tip():
    return face(Geom_ConicalSurface(axes(), 0.5, 3 * M), 0, TAU, -3 * M / math.sin(0.5), 0)


@case("part of a cone without its tip", step("cone_part"))
def cone_part():
    return face(Geom_ConicalSurface(axes(), -0.4, 3 * M), 0.5, 4.0, -2 * M, 5 * M)


@case("part of a torus across both seams", step("torus_part"), iges("torus_part"))
def torus_part():
    return face(Geom_ToroidalSurface(axes(), 5 * M, 2 * M), 5.0, 7.5, 5.2, 8.0)


@case("ring of a torus, closed one way", step("torus_ring"))
def torus_ring():
    return face(Geom_ToroidalSurface(axes(), 5 * M, 2 * M), 0, TAU, 0.3, 2.4)


@case("revolution of a free curve, part of a turn", step("revolution_part"), iges("revolution_part"))
def revolution_part():
    c = through([(3, 0, 0), (4, 0, 1.5), (3.2, 0, 3), (3.8, 0, 5)])
    return face(Geom_SurfaceOfRevolution(c, gp_Ax1(P(0, 0, 0), gp_Dir(0, 0, 1))), 0.5, 3.5, *ends(c))


@case("revolution of a free curve that meets the axis, all round", step("revolution_dome"))
def revolution_dome():
    c = through([(5, 0, 0), (4.4, 0, 2), (2.5, 0, 3.2), (0, 0, 3.6)])
    return face(Geom_SurfaceOfRevolution(c, gp_Ax1(P(0, 0, 0), gp_Dir(0, 0, 1))), 0, TAU, *ends(c))


@case("hyperboloid: revolution of a line askew", step("revolution_line"))
def revolution_line():
    line = Geom_Line(P(3, 0, 0), gp_Dir(0, 0.6, 1))
    s = Geom_SurfaceOfRevolution(line, gp_Ax1(P(0, 0, 0), gp_Dir(0, 0, 1)))
    return face(s, 0.2, 5.0, -3 * M, 4 * M)


@case("extrusions of a free curve and of an ellipse", step("extrusions"))
def extrusions():
    free = through([(0, 0, 0), (2, 0, 1), (4, 0, 0.4), (7, 0, 1.4)])
    made = [face(Geom_SurfaceOfLinearExtrusion(free, gp_Dir(0.2, 1, 0.1)), *ends(free), 0, 5 * M)]
    for n, (c, a, b) in enumerate(
        [
            (Geom_Ellipse(ax2((0, 0, 0), (0, 1, 0)), 3 * M, 2 * M), 0.4, 3.4),
        ]
    ):
        s = Geom_SurfaceOfLinearExtrusion(c, gp_Dir(0, 1, 0.3))
        made.append(moved(face(s, a, b, 0, 4 * M), (12 * (n + 1), 0, 0)))
    return compound(*made)


def ends(curve):
    return curve.FirstParameter(), curve.LastParameter()


@case("vault drawn from a parabola, and one from a hyperbola", step("conic_vaults"))
def conic_vaults():
    p = Geom_TrimmedCurve(Geom_Parabola(ax2((0, 0, 3), (0, 1, 0), (0, 0, -1)), 0.75 * M), -3 * M, 3 * M)
    h = Geom_TrimmedCurve(Geom_Hyperbola(ax2((9, 0, 5), (0, 1, 0), (0, 0, -1)), 2 * M, 3 * M), -1.1, 1.1)
    return compound(*(drawn(c, (0.2, 5, 0.1)) for c in (p, h)))


def drawn(curve, way):
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeEdge(curve).Edge(), gp_Vec(*(M * x for x in way))).Shape()


@case("whole ellipsoid: an ellipse turned about its axis", step("ellipsoid"), joined="solid")
def ellipsoid():
    e = Geom_Ellipse(ax2((0, 0, 0), (0, -1, 0), (0, 0, -1)), 4 * M, 3 * M)
    s = Geom_SurfaceOfRevolution(Geom_TrimmedCurve(e, 0, math.pi), gp_Ax1(P(0, 0, 0), gp_Dir(0, 0, 1)))
    return BRepBuilderAPI_MakeFace(s, 1e-6).Face()


@case("tower: a hyperbola turned about an axis", step("tower"), iges("tower"))
def tower():
    h = Geom_TrimmedCurve(Geom_Hyperbola(ax2((0, 0, 6), (0, -1, 0), (1, 0, 0)), 3 * M, 5 * M), -1, 0.6)
    return face(Geom_SurfaceOfRevolution(h, gp_Ax1(P(0, 0, 0), gp_Dir(0, 0, 1))), 0, TAU, *ends(h))


@case("half a sphere whose axis lies in the plane of its rim", step("axis_in_rim"), iges("axis_in_rim"))
def axis_in_rim():
    # OpenCascade parts the rim at the poles, others do not.
    s = face(Geom_SphericalSurface(axes((0, 0, 0), (1, 0, 0), (0, 1, 0)), 3 * M), 0, TAU, -math.pi / 2, math.pi / 2)
    return max(faces(BRepAlgoAPI_Cut(s, moved(box(20), (-10, -10, -20))).Shape()), key=middle)


def box(size):
    return BRepPrimAPI_MakeBox(size * M, size * M, size * M).Shape()


@case("torus with a hole where its seams meet", step("torus_hole"), iges("torus_hole"), iges("torus_hole_brep", brep=True))
def torus_hole():
    whole = BRepBuilderAPI_MakeFace(Geom_ToroidalSurface(axes(), 5 * M, 2 * M), 1e-6).Face()
    drill = moved(BRepPrimAPI_MakeCylinder(0.8 * M, 9 * M).Shape(), (5, 0.2, 0))
    return max(faces(BRepAlgoAPI_Cut(whole, drill).Shape()), key=area)


# ---------------------------------------------------------------- offsets


@case("offset of a free-form patch, trimmed with a hole", step("offset_free"), iges("offset_free"))
def offset_free():
    s = Geom_OffsetSurface(bspline(lambda i, j: 0.5 * wave(i, j), (6, 5), (3, 3)), 0.5 * M)
    outer = polygon2d(s, [(0.1, 0.1), (2.9, 0.1), (2.9, 1.9), (0.1, 1.7)])
    return trimmed(s, outer, circle2d(s, 1.4, 1.0, 0.4))


@case("offsets of an extrusion and of a revolution", step("offset_swept"))
def offset_swept():
    c = through([(0, 0, 0), (2, 0, 1), (4, 0, 0.4), (7, 0, 1.4)])
    a = Geom_OffsetSurface(Geom_SurfaceOfLinearExtrusion(c, gp_Dir(0, 1, 0)), 0.4 * M)
    d = through([(3, 0, 0), (4, 0, 1.5), (3.2, 0, 3), (3.8, 0, 5)])
    r = Geom_SurfaceOfRevolution(d, gp_Ax1(P(0, 0, 0), gp_Dir(0, 0, 1)))
    b = Geom_OffsetSurface(r, -0.3 * M)
    return compound(face(a, *ends(c), 0, 4 * M), moved(face(b, 0.0, 2.5, *ends(d)), (20, 0, 0)))


@case("offset of a drawn ellipse, and of a sphere", step("offset_conics"), iges("offset_conics"))
def offset_conics():
    e = Geom_Ellipse(ax2((0, 0, 0), (0, 1, 0)), 3 * M, 2 * M)
    a = Geom_OffsetSurface(Geom_SurfaceOfLinearExtrusion(e, gp_Dir(0, 1, 0)), 0.2 * M)
    b = Geom_OffsetSurface(Geom_SphericalSurface(axes((9, 0, 0)), 2 * M), 0.3 * M)
    return compound(face(a, 0.3, 2.8, 0, 4 * M), face(b, 0, TAU, 0.2, math.pi / 2))


@case("offset of a closed free-form tube, all round", step("offset_tube"), joined="sewn")
def offset_tube():
    s = tube()
    s = Geom_OffsetSurface(s, 0.25 * M)
    return face(s, *s.Bounds())


# ---------------------------------------------------------------- B-splines


# Kinks inside a face belong to meshes: degree 1 has one span.
@case("degrees 2 by 7, 9 by 3 and 1 by 5", step("degrees"), iges("degrees"))
def degrees():
    mid = bspline(lambda i, j: 0.3 * wave(i, j), (6, 9), (2, 7))
    high = bspline(lambda i, j: 0.5 * wave(i, j), (11, 5), (9, 3))
    made = [face(s, *s.Bounds()) for s in (mid, high)]
    ramp = bspline(lambda i, j: 0.3 * j * (i % 2), (2, 8), (1, 5))
    made.append(face(ramp, *ramp.Bounds()))
    return compound(*(moved(f, (14 * n, 0, 0)) for n, f in enumerate(made)))


@case("rational, with weights from 0.3 to 4", step("rational"), iges("rational"))
def rational():
    s = bspline(wave, (6, 6), (3, 2), weight=lambda i, j: 0.3 + (3.7 * ((5 * i + 3 * j) % 7)) / 6)
    return face(s, *s.Bounds())


def tube():
    """Periodic in u, not clamped."""
    ring = lambda a, z, r: P(r * math.cos(a), 1.3 * r * math.sin(a), z)
    rows = [[ring(TAU * i / 7, 1.5 * j, 2 + 0.5 * math.sin(j + i)) for j in range(5)] for i in range(7)]
    kv, mv = knots(5, 3)
    return Geom_BSplineSurface(
        array2("gp_Pnt", rows),
        array("double", [float(i) for i in range(8)]),
        array("double", [float(k) for k in kv]),
        array("int", [1] * 8),
        array("int", mv),
        3,
        3,
        True,
        False,
    )


@case("periodic tube with a hole across its seam", step("periodic_tube"), iges("periodic_tube"))
def periodic_tube():
    s = tube()
    whole = face(s, *s.Bounds())
    drill = moved(BRepPrimAPI_MakeCylinder(0.7 * M, 9 * M).Shape(), (0, 0, 3), (0, 1, 0), math.pi / 2)
    return max(faces(BRepAlgoAPI_Cut(whole, drill).Shape()), key=area)


@case("a side of no length", step("degenerate_side"), iges("degenerate_side"))
def degenerate_side():
    rows = [[P(10 * i / 4, (8 * (j - 2) / 4) * (i / 4), 0.3 * wave(i, j) * i / 4) for j in range(5)] for i in range(5)]
    k, m = knots(5, 3)
    k, m = array("double", [float(x) for x in k]), array("int", m)
    s = Geom_BSplineSurface(array2("gp_Pnt", rows), k, k, m, m, 3, 3)
    return face(s, *s.Bounds())


@case("Bezier patch", step("bezier"))
def bezier():
    rows = [[P(i * 2, j * 2, 0.6 * wave(i, j)) for j in range(5)] for i in range(4)]
    s = Geom_BezierSurface(array2("gp_Pnt", rows))
    return face(s, 0, 1, 0, 1)


def loft(*sections):
    maker = BRepOffsetAPI_ThruSections(False, False, 1e-6)
    for w in sections:
        maker.AddWire(w)
    maker.Build()
    return maker.Shape()


@case("loft from a square to a circle", step("loft"), iges("loft", brep=True))
def lofted():
    turn = gp_Ax2(P(0, 0, 4), gp_Dir(0, 0, 1), gp_Dir(1, 1, 0))
    e = Geom_Ellipse(turn, 2.5 * M, 2 * M)
    quarter = [BRepBuilderAPI_MakeEdge(e, TAU * k / 4, TAU * (k + 1) / 4).Edge() for k in range(4)]
    return loft(polygon([(3, 3, 0), (-3, 3, 0), (-3, -3, 0), (3, -3, 0)]), wire(*quarter))


# ---------------------------------------------------------------- trimming and joining


@case("plate with 12 holes", step("many_loops"), iges("many_loops"))
def many_loops():
    holes = [ellipse((1.5 + 2 * i, 1.5 + 2 * j, 0), 0.6, 0.4) for i in range(4) for j in range(3)]
    return flat(polygon([(0, 0, 0), (9, 0, 0), (9, 7, 0), (0, 7, 0)]), *holes)


@case("box without a lid, edges rounded by 2 cm", step("tiny_faces"))
def tiny_faces():
    box = BRepPrimAPI_MakeBox(6 * M, 5 * M, 3 * M).Shape()
    maker = BRepFilletAPI_MakeFillet(box)
    done = []
    for e in parts(box, "EDGE"):
        if not any(e.IsSame(d) for d in done):
            done.append(e)
            maker.Add(0.02 * M, TopoDS.Edge(e))
    top = max(faces(maker.Shape()), key=lambda f: (area(f) > 20, middle(f)[2]))
    return shell(*(f for f in faces(maker.Shape()) if not f.IsSame(top)))


def middle(f):
    props = GProp_GProps()
    BRepGProp.SurfaceProperties_s(f, props)
    c = props.CentreOfMass()
    return c.X() / M, c.Y() / M, c.Z() / M


@case("outline with edges of 0.1 mm", step("tiny_edges"))
def tiny_edges():
    return flat(polygon([(0, 0, 0), (5, 0, 0), (5, 1e-4, 0), (9, 3, 0), (9, 6, 0), (0, 6, 0)]), polygon(TINY))


TINY = [(2, 2, 0), (3, 2, 0), (3, 3, 0), (2.5, 3.2, 0), (2.4999, 3.2, 0), (2, 3, 0)]


@case("four quarters joined, two of them reversed", step("reversed_faces"), iges("reversed_faces", brep=True))
def reversed_faces():
    s = bspline(lambda i, j: 0.5 * wave(i, j), (6, 6), (3, 3))
    cuts = [(0, 1.5, 0, 1.4), (1.5, 3, 0, 1.4), (0, 1.5, 1.4, 3), (1.5, 3, 1.4, 3)]
    quarters = [face(s, *c) for c in cuts]
    quarters = [q.Reversed() if n % 2 else q for n, q in enumerate(quarters)]
    return sewn(1e-6, *quarters)


@case("shells that only touch", step("loose"), iges("loose"), joined="sewn")
def loose():
    s = bspline(lambda i, j: 0.5 * wave(i, j), (6, 6), (3, 3))
    return compound(*(face(s, *c) for c in [(0, 1.5, 0, 3), (1.5, 3, 0, 3)]))


@case("two patches against one: T-junctions", step("t_junctions"), joined="tee")
def t_junctions():
    s = bspline(lambda i, j: 0.5 * wave(i, j), (6, 6), (3, 3))
    return compound(*(face(s, *c) for c in [(0, 1.5, 0, 3), (1.5, 3, 0, 1.4), (1.5, 3, 1.4, 3)]))


@case("faces 0.05 mm apart", step("gap"), joined="sewn")
def gap():
    a = flat(polygon([(0, 0, 0), (4, 0, 0), (4, 3, 0), (0, 3, 0)]))
    b = flat(polygon([(4.00005, 0, 0), (9, 0, 2), (9, 3, 2), (4.00005, 3, 0)]))
    return compound(a, b)


@case("solid, shell, face, wire and point in one file", step("mixed"), joined="solid")
def mixed():
    box = moved(BRepPrimAPI_MakeBox(2 * M, 2 * M, M).Shape(), (0, 0, 5))
    drill = moved(BRepPrimAPI_MakeCylinder(0.5 * M, 9 * M).Shape(), (1, 1, 0))
    box = BRepAlgoAPI_Cut(box, drill).Shape()
    point = BRepBuilderAPI_MakeVertex(P(1, 1, 1)).Vertex()
    free = shell(*faces(reversed_faces()))
    return compound(box, free, moved(court(), (20, 0, 0)), ellipse((0, 0, 9), 3, 2), point)


@case("two spheres made one: pole, seams and a free cut", step("boolean"), joined="solid")
def boolean():
    one = BRepPrimAPI_MakeSphere(2 * M).Shape()
    two = moved(BRepPrimAPI_MakeSphere(1.5 * M).Shape(), (2, 0.3, 0.5))
    return BRepAlgoAPI_Fuse(one, two).Shape()


@case("shell mirrored and turned", step("mirrored"))
def mirrored():
    return moved(moved(reversed_faces(), mirror=(1, 0, 0)), (3, 2, 1), (1, 1, 0), 0.7)


def unbounded(text):
    """The sphere's face without its bounds."""
    return re.sub(r"(ADVANCED_FACE\('',)\(#\d+\)", r"\1()", text)


@case("faces without bounds: a whole sphere", step("no_bounds"), joined="solid", text=unbounded)
def no_bounds():
    return face(Geom_SphericalSurface(axes(), 2 * M))


# ---------------------------------------------------------------- assemblies


def assembly():
    """A panel twice in a frame, the frame twice in the whole, each turned and moved."""
    panel = court()
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())

    def place(at, axis, angle):
        spin, shift = gp_Trsf(), gp_Trsf()
        spin.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(*axis)), angle)
        shift.SetTranslation(gp_Vec(*(M * x for x in at)))
        return shift.Multiplied(spin)

    one = tool.AddShape(panel, False)
    frame, whole = tool.NewShape(), tool.NewShape()
    inner = [place((0, 0, 0), (0, 0, 1), 0.4), place((12, 0, 1), (1, 0, 0), 0.6)]
    outer = [place((0, 0, 0), (0, 1, 0), -0.3), place((0, 15, 4), (0, 0, 1), 1.9)]
    for t in inner:
        tool.AddComponent(frame, one, TopLoc_Location(t))
    for t in outer:
        tool.AddComponent(whole, frame, TopLoc_Location(t))
    tool.UpdateAssemblies()
    placed = [BRepBuilderAPI_Transform(panel, o.Multiplied(i), True).Shape() for o in outer for i in inner]
    return document, compound(*placed)


def write_assembly():
    for name, unit in [("assembly_m", "M"), ("assembly_mm", "MM")]:
        document, placed = assembly()
        Interface_Static.SetCVal_s("write.step.schema", "AP214IS")
        Interface_Static.SetCVal_s("write.step.unit", unit)
        Interface_Static.SetIVal_s("write.surfacecurve.mode", 0)
        writer = STEPCAFControl_Writer()
        writer.Transfer(document)
        path = HERE / f"{name}.step"
        writer.Write(str(path))
        plain(path)
        row(path.name, "nested assembly, one panel placed four times", placed, "shared")


TASKS.append(("assembly", write_assembly))


# ---------------------------------------------------------------- Rhino


@case(
    "the untrimmed patch of the Rhino files, in other formats",
    step("patch_m"),
    step("patch_mm", unit="MM"),
    step("patch_in", unit="INCH"),
)
def patch():
    return face(cubic(), *cubic().Bounds())


def write_rhino():
    import rhino3dm as r

    pi = math.pi

    def file(name, version, unit, objects):
        model = r.File3dm()
        model.Settings.ModelUnitSystem = unit
        for n, (layer, label, geometry) in enumerate(objects):
            at = next((l.Index for l in model.Layers if l.Name == layer), None)
            if at is None:
                at = model.Layers.AddLayer(layer, (0, 0, 0, 255))
            a = r.ObjectAttributes()
            a.Name, a.LayerIndex = label, at
            model.Objects.Add(geometry, a)
        model.Write(str(HERE / f"{name}.3dm"), version)

    def surface(scale):
        s = r.NurbsSurface.Create(3, False, 4, 4, 6, 5)
        (ku, kv) = s.KnotsU, s.KnotsV
        for k, values in ((ku, [0, 0, 0, 1, 2, 3, 3, 3]), (kv, [0, 0, 0, 1, 2, 2, 2])):
            for i, x in enumerate(values):
                k[i] = float(x)
        for i in range(6):
            for j in range(5):
                p = (10 * i / 5, 8 * j / 4, 0.4 * wave(i, j))
                s.Points[i, j] = r.Point4d(*(scale * x for x in p), 1)
        return s

    units = {"mm": (r.UnitSystem.Millimeters, 1000.0), "m": (r.UnitSystem.Meters, 1.0)}
    units["in"] = (r.UnitSystem.Inches, 1 / 0.0254)
    for version, unit in [(2, "mm"), (3, "m"), (4, "in"), (5, "mm"), (6, "m"), (7, "mm"), (8, "in")]:
        system, scale = units[unit]
        name = f"patch_v{version}_{unit}"
        file(name, version, system, [("roof", "patch", surface(scale))])
        row(f"{name}.3dm", f"one untrimmed patch, version {version}", patch(), "shared")

    ball = r.Brep.CreateFromSphere(r.Sphere(r.Point3d(0, 0, 0), 2))
    box = r.Brep.CreateFromBox(r.Box(r.BoundingBox(5, 0, 0, 8, 2, 1)))
    tube = r.Brep.CreateFromCylinder(r.Cylinder(r.Circle(r.Point3d(12, 0, 0), 1.5), 4), False, False)
    profile = r.Circle(r.Point3d(20, 0, 0), 1).ToNurbsCurve()
    beam = r.Extrusion.Create(profile, 3, False)
    mesh = r.Mesh()
    for p in [(30, 0, 0), (32, 0, 0), (32, 2, 0), (30, 2, 1)]:
        mesh.Vertices.Add(*p)
    mesh.Faces.AddFace(0, 1, 2, 3)
    stray = r.LineCurve(r.Point3d(0, 9, 0), r.Point3d(9, 9, 1))
    objects = [
        ("solids", "ball", ball),
        ("solids", "box", box),
        ("tubes", "tube", tube),
        ("tubes", "beam", beam),
        ("meshes", "mesh", mesh),
        ("lines", "stray", stray),
    ]
    file("objects_v7", 7, r.UnitSystem.Meters, objects)
    for name, label in [("tube_v6", "tube"), ("ball_v6", "ball"), ("beam_v6", "beam")]:
        file(name, 6, r.UnitSystem.Meters, [o for o in objects if o[1] == label])
    ROWS.append(["tube_v6.3dm", "tube of radius 1.5, 4 long", f"{TAU * 1.5 * 4:.9g}", 1, 2, 0, "shared"])
    ROWS.append(["ball_v6.3dm", "sphere of radius 2", f"{4 * pi * 4:.9g}", 1, 0, 0, "solid"])
    ROWS.append(["beam_v6.3dm", "extrusion of a circle of radius 1 by 3", f"{TAU * 3:.9g}", 1, 2, 0, "shared"])


TASKS.append(("rhino", write_rhino))


def write_rhino_profiles():
    """Edges that are polycurves, plane surfaces without a brep, and blocks: mirrored, stretched, one in another."""
    import rhino3dm as r

    pi, P = math.pi, r.Point3d
    units = {"mm": (r.UnitSystem.Millimeters, 1000.0), "m": (r.UnitSystem.Meters, 1.0)}
    units["in"] = (r.UnitSystem.Inches, 1 / 0.0254)

    def model(unit):
        m = r.File3dm()
        m.Settings.ModelUnitSystem = units[unit][0]
        m.Layers.AddLayer("roof", (0, 0, 0, 255))
        return m

    def lantern(s, turn):
        """A wall 2 high at radius 4 and a quarter round of radius 1 on it, about the z axis."""
        arc = r.Arc(P(4 * s, 0, 2 * s), P((3 + math.sqrt(0.5)) * s, 0, (2 + math.sqrt(0.5)) * s), P(3 * s, 0, 3 * s))
        profile = r.PolyCurve()
        profile.AppendSegment(r.LineCurve(P(4 * s, 0, 0), P(4 * s, 0, 2 * s)))
        profile.AppendSegment(r.ArcCurve.CreateFromArc(arc))
        turned = r.RevSurface.Create(profile, r.Line(P(0, 0, 0), P(0, 0, 1)), 0, turn)
        return r.Brep.CreateFromRevSurface(turned, False, False)

    def plane(s):
        return r.PlaneSurface(r.Plane(P(s, 0, s), r.Vector3d(0, 0.6, 0.8)), r.Interval(-s, 4 * s), r.Interval(0, 4 * s))

    def named(label):
        a = r.ObjectAttributes()
        a.Name = label
        return a

    def block(m, name, geometry, *places):
        k = m.InstanceDefinitions.Add(name, "", "", "", P(0, 0, 0), (geometry,), (named("member"),))
        return [r.InstanceReference(m.InstanceDefinitions.FindIndex(k).Id, place) for place in places]

    def write(m, name, version, what, area, loops, corners):
        m.Write(str(HERE / f"{name}.3dm"), version)
        ROWS.append([f"{name}.3dm", f"{what}, version {version}", f"{area:.9g}", 1, loops, corners, "shared"])

    whole = TAU * (4 * 2 + 3 * pi / 2 + 1)
    for version, unit in [(2, "mm"), (4, "m"), (7, "in")]:
        m = model(unit)
        m.Objects.Add(lantern(units[unit][1], TAU), named("lantern"))
        write(m, f"lantern_v{version}_{unit}", version, "a wall and a quarter round turned as one", whole, 2, 0)
    for version, unit in [(3, "m"), (6, "mm"), (8, "in")]:
        m = model(unit)
        m.Objects.Add(lantern(units[unit][1], pi), named("niche"))
        write(m, f"niche_v{version}_{unit}", version, "half of the lantern", whole / 2, 1, 4)
    for version, unit in [(2, "in"), (5, "mm"), (8, "m")]:
        m = model(unit)
        m.Objects.Add(plane(units[unit][1]), named("plane"))
        write(m, f"plane_v{version}_{unit}", version, "a plane surface of 5 by 4", 20, 1, 4)

    around, steps = 0.0, 200_000
    for i in range(steps):
        a = TAU * (i + 0.5) / steps
        around += math.hypot(3 * math.sin(a), 1.5 * math.cos(a)) * TAU / steps
    tube = r.Brep.CreateFromCylinder(r.Cylinder(r.Circle(P(0, 0, 0), 1.5), 4), False, False)
    stretched = r.Transform.Scale(r.Plane(P(0, 0, 0), r.Vector3d(0, 0, 1)), 2, 1, 3)
    m = model("m")
    for reference in block(m, "tube", tube, stretched):
        m.Objects.AddInstanceObject(reference, named("stretched"))
    write(m, "block_stretched_v7", 7, "a tube in a block that is stretched", around * 12, 2, 0)
    m = model("mm")
    mirrored = r.Transform.Mirror(P(-9000, 0, 0), r.Vector3d(1, 0, 0))
    for reference in block(m, "niche", lantern(1000, pi), mirrored):
        m.Objects.AddInstanceObject(reference, named("mirrored"))
    write(m, "block_mirrored_v5", 5, "half of the lantern in a block that is mirrored", whole / 2, 1, 4)
    m = model("m")
    [inner] = block(m, "inner", plane(1.0), r.Transform.Translation(3, 0, 0))
    for reference in block(m, "outer", inner, r.Transform.Scale(P(0, 0, 0), 2)):
        m.Objects.AddInstanceObject(reference, named("nested"))
    write(m, "block_nested_v8", 8, "a plane surface in a block in a block twice as large", 80, 1, 4)


TASKS.append(("rhino-profiles", write_rhino_profiles))


# ---------------------------------------------------------------- all of it


def main(names):
    for name, task in TASKS:
        if names and name not in names:
            continue
        task()
    if names:
        for r in ROWS:
            print(*r, sep=",")
        return
    with open(HERE / "table.csv", "w", newline="") as f:
        out = csv.writer(f, lineterminator="\n")
        out.writerow(["file", "what", "area_m2", "faces", "loops", "corners", "joined"])
        out.writerows(ROWS)


if __name__ == "__main__":
    main(sys.argv[1:])
