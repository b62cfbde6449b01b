//! STEP texts made here, read: units, ways of edges, and what is refused.

use super::*;
use crate::surface::{Sampling, tessellate};

/// A plate of 4 x 2 (in the unit) in the plane z = 1 with a round hole of radius 0.5; the hole's circle
/// is run backwards and begins a quarter past the circle's own start.
fn plate(unit: &str, plane: &str) -> String {
    use std::fmt::Write;
    let corners = ["0.,0.,1.", "4.,0.,1.", "4.,2.,1.", "0.,2.,1."];
    let ways = ["1.,0.,0.", "0.,1.,0.", "-1.,0.,0.", "0.,-1.,0."];
    let mut data = String::new();
    for (i, (corner, way)) in corners.iter().zip(ways).enumerate() {
        let next = (i + 1) % 4;
        writeln!(
            data,
            "#1{i}=CARTESIAN_POINT('',({corner}));#2{i}=VERTEX_POINT('',#1{i});
#3{i}=DIRECTION('',({way}));#4{i}=VECTOR('',#3{i},1.);#5{i}=LINE('',#1{i},#4{i});
#6{i}=EDGE_CURVE('',#2{i},#2{next},#5{i},.T.);#7{i}=ORIENTED_EDGE('',*,*,#6{i},.T.);"
        )
        .unwrap();
    }
    format!(
        "ISO-10303-21;HEADER;FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));ENDSEC;DATA;
#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({unit},.METRE.));
#2=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));
#3=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());
#4=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#1,#2,#3))
REPRESENTATION_CONTEXT('',''));
{data}#80=EDGE_LOOP('',(#70,#71,#72,#73));#81=FACE_BOUND('',#80,.T.);
#90=CARTESIAN_POINT('',(2.,1.,1.));#91=DIRECTION('',(0.,0.,1.));#92=DIRECTION('',(1.,0.,0.));
#93=AXIS2_PLACEMENT_3D('',#90,#91,#92);#94=CIRCLE('',#93,0.5);
#95=CARTESIAN_POINT('',(2.,1.5,1.));#96=VERTEX_POINT('',#95);
#97=EDGE_CURVE('',#96,#96,#94,.F.);#98=ORIENTED_EDGE('',*,*,#97,.T.);
#99=EDGE_LOOP('',(#98));#100=FACE_BOUND('',#99,.T.);
#101={plane};
#102=ADVANCED_FACE('plate',(#81,#100),#101,.T.);
#103=OPEN_SHELL('',(#102));#104=SHELL_BASED_SURFACE_MODEL('',(#103));
#105=MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#104),#4);
ENDSEC;END-ISO-10303-21;
"
    )
}

#[test]
fn plate_with_a_hole_is_read_in_its_unit() {
    for (name, unit) in [("$", 1.0), (".MILLI.", 0.001)] {
        let brep = parse(plate(name, "PLANE('',#93)").as_bytes()).unwrap();
        assert_eq!((brep.faces.len(), brep.edges.len(), brep.vertices.len()), (1, 5, 5));
        assert_eq!(brep.unit_in_metres, unit);
        assert_eq!(brep.source.version, "AP214");
        assert_eq!(brep.source.unit.as_ref().unwrap().metres, unit);
        let sampling =
            Sampling { max_edge: 0.3 * unit, chord_error: 0.002 * unit, corner_angle: 0.5 };
        let surface = tessellate(&brep, &sampling).unwrap();
        assert_eq!(surface.loops.len(), 2);
        assert_eq!(surface.loops[0].corners.len(), 4);
        assert!(surface.loops[1].corners.is_empty());
        let exact = (8.0 - 0.25 * std::f64::consts::PI) * unit * unit;
        assert!((surface.area / exact - 1.0).abs() < 1e-5, "{}", surface.area);
    }
}

#[test]
fn closed_edge_begins_at_its_vertex_and_runs_its_way() {
    let brep = parse(plate("$", "PLANE('',#93)").as_bytes()).unwrap();
    let hole = brep.edges.iter().find(|e| e.ends[0] == e.ends[1]).unwrap();
    let [a, b] = hole.range;
    assert!(hole.curve.point(a).distance(DVec3::new(2.0, 1.5, 1.0)) < 1e-9);
    assert!(hole.curve.point(b).distance(DVec3::new(2.0, 1.5, 1.0)) < 1e-9);
    // Against the circle's own direction: from the top of the hole to the right.
    assert!(hole.curve.point(a + 0.1 * (b - a)).x > 2.1);
}

#[test]
fn unknown_surface_is_named_not_swallowed() {
    let (_, what) = parse(plate("$", "FANCY_SURFACE('',#93)").as_bytes()).unwrap_err();
    assert!(what.contains("no face") && what.contains("FANCY_SURFACE"), "{what}");
}

#[test]
fn text_that_is_no_step_file_is_an_error() {
    for text in ["", "solid cube", "ISO-10303-21;HEADER;ENDSEC;DATA;#1=", "ISO-10303-21;"] {
        assert!(parse(text.as_bytes()).is_err());
    }
}

#[test]
fn missing_file_is_named() {
    let e = read(Path::new("no/such/roof.step")).unwrap_err().to_string();
    assert!(e.contains("roof.step"), "{e}");
}
