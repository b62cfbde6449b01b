//! STEP texts made here, read: units, ways of edges, and what is refused.

use super::*;
use crate::job::Job;
use crate::surface::{Sampling, tessellate};
use glam::DVec3;

/// The exact faces in a text.
fn parse(text: &[u8]) -> std::result::Result<Brep, (String, String)> {
    match super::parse(text.to_vec())? {
        Found::Faces(brep) => Ok(brep),
        Found::Triangles(..) => panic!("triangles only"),
    }
}

/// A plate of 4 x 2 (in the unit) in the plane z = 1 with a round hole of radius 0.5; the hole's circle
/// is run backwards and begins a quarter past the circle's own start.
fn plate(unit: &str, plane: &str) -> String {
    plate_of(unit, plane, ["0.,0.,1.", "4.,0.,1.", "4.,2.,1.", "0.,2.,1."])
}

/// The same with other corners.
fn plate_of(unit: &str, plane: &str, corners: [&str; 4]) -> String {
    use std::fmt::Write;
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
        let surface = tessellate(&brep, &sampling, &Job::default()).unwrap();
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
    let whole = plate("$", "PLANE('',#93)");
    let odd = whole.replacen("DATA;", "DATA;\n=;", 1);
    for (text, place, what) in [
        ("", "file", "it is empty"),
        ("solid cube", "line 1", "it does not begin with ISO-10303-21"),
        ("ISO-10303-21;", "line 1", "the file ends here"),
        (&whole[..900], "line", "cut off; export it again"),
        (&odd, "line", "should be; export it again"),
    ] {
        let (at, why) = parse(text.as_bytes()).unwrap_err();
        assert!(at.starts_with(place) && why.contains(what), "{at}: {why}");
    }
}

#[test]
fn missing_file_is_named() {
    let e = read(Path::new("no/such/roof.step"), &Job::default()).unwrap_err().to_string();
    assert!(e.contains("roof.step"), "{e}");
}

#[test]
fn coordinates_out_of_reach_are_refused_with_the_point() {
    for far in ["1.E15,0.,1.", "-1.E300,0.,1."] {
        let corners = ["0.,0.,1.", far, "4.,2.,1.", "0.,2.,1."];
        let (_, what) = parse(plate_of("$", "PLANE('',#93)", corners).as_bytes()).unwrap_err();
        assert!(what.contains("no face") && what.len() > 40, "{what}");
    }
}

#[test]
fn what_is_no_number_is_refused() {
    for odd in ["NAN,0.,1.", "4.,$,1.", "'four',0.,1.", ".INF.,0.,1.", "1.E400,0.,1."] {
        let corners = ["0.,0.,1.", odd, "4.,2.,1.", "0.,2.,1."];
        let (_, what) = parse(plate_of("$", "PLANE('',#93)", corners).as_bytes()).unwrap_err();
        assert!(!what.is_empty(), "{what}");
    }
}

#[test]
fn faces_without_area_are_left_out_with_a_note() {
    let corners = ["0.,0.,1.", "4.,0.,1.", "2.,0.,1.", "1.,0.,1."];
    let flat = plate_of("$", "PLANE('',#93)", corners).replace("(#81,#100)", "(#81)");
    let (_, what) = parse(flat.as_bytes()).unwrap_err();
    assert!(what.contains("plate"), "{what}");
}

#[test]
fn outline_that_crosses_itself_is_refused_with_the_place() {
    let corners = ["0.,0.,1.", "4.,2.,1.", "4.,0.,1.", "0.,2.,1."];
    let bow = plate_of("$", "PLANE('',#93)", corners).replace("(#81,#100)", "(#81)");
    let sampling = Sampling { max_edge: 0.3, chord_error: 0.002, corner_angle: 0.5 };
    let brep = parse(bow.as_bytes()).unwrap();
    let Err(e) = tessellate(&brep, &sampling, &Job::default()) else {
        panic!("a bow tie is not a face")
    };
    assert!(e.to_string().contains("crosses itself near (2."), "{e}");
}

#[test]
fn loop_with_a_missing_edge_leaves_its_face_out() {
    let open = plate("$", "PLANE('',#93)").replace("(#70,#71,#72,#73)", "(#70,#71,#73)");
    let (_, what) = parse(open.as_bytes()).unwrap_err();
    assert!(what.contains("gap of 4.0000 m"), "{what}");
    let dangling = plate("$", "PLANE('',#93)").replace("#62=EDGE_CURVE", "#962=EDGE_CURVE");
    let (_, what) = parse(dangling.as_bytes()).unwrap_err();
    assert!(what.contains('#'), "{what}");
}

/// Products that hold each other: `uses` are pairs of a whole and a part in it.
fn products(count: usize, uses: &[(usize, usize)]) -> String {
    use std::fmt::Write;
    let mut data = String::from(
        "#200=APPLICATION_CONTEXT('');#201=PRODUCT_CONTEXT('',#200,'mechanical');
#202=PRODUCT_DEFINITION_CONTEXT('part definition',#200,'design');\n",
    );
    for i in 0..count {
        let id = 300 + 10 * i;
        writeln!(
            data,
            "#{id}=PRODUCT('p{i}','p{i}','',(#201));
#{}=PRODUCT_DEFINITION_FORMATION('','',#{id});
#{}=PRODUCT_DEFINITION('design','',#{},#202);",
            id + 1,
            id + 2,
            id + 1
        )
        .unwrap();
    }
    for (k, (whole, part)) in uses.iter().enumerate() {
        let [whole, part] = [whole, part].map(|i| 302 + 10 * i);
        let id = 20_000 + k;
        writeln!(data, "#{id}=NEXT_ASSEMBLY_USAGE_OCCURRENCE('{k}','','',#{whole},#{part},$);")
            .unwrap();
    }
    plate("$", "PLANE('',#93)").replace("ENDSEC;END-ISO", &format!("{data}ENDSEC;END-ISO"))
}

#[test]
fn assemblies_that_hold_themselves_end() {
    // 0 holds 1, 1 and 2 hold each other; then alone, then twice over at every level.
    let brep = parse(products(3, &[(0, 1), (1, 2), (2, 1)]).as_bytes()).unwrap();
    assert_eq!(brep.faces.len(), 1);
    assert!(brep.notes.iter().any(|n| n.contains("contains itself")), "{:?}", brep.notes);
    assert_eq!(parse(products(1, &[(0, 0)]).as_bytes()).unwrap().faces.len(), 1);
    let doubled = products(3, &[(0, 1), (1, 2), (1, 2), (2, 1), (2, 1)]);
    let (_, what) = parse(doubled.as_bytes()).unwrap_err();
    assert!(what.contains("parts"), "{what}");
}

#[test]
fn deep_nesting_and_huge_counts_end_in_an_error() {
    let deep = "(".repeat(200_000);
    let text = plate("$", &format!("PLANE('',{deep}#93)"));
    assert!(parse(text.as_bytes()).is_err());
    for times in ["(2000000000,2000000000)", "(-1,5)", "(2)"] {
        let spline = format!(
            "B_SPLINE_SURFACE_WITH_KNOTS('',1,1,((#10,#11),(#13,#12)),.UNSPECIFIED.,.F.,.F.,.F.,
{times},(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)"
        );
        let (_, what) = parse(plate("$", &spline).as_bytes()).unwrap_err();
        assert!(what.contains("no face"), "{what}");
    }
}

#[test]
fn mapped_items_are_placed() {
    // The plate's representation stamped 10 to the right, and turned a quarter about z at 20.
    let placed = plate("$", "PLANE('',#93)").replace(
        "ENDSEC;END-ISO",
        "#400=CARTESIAN_POINT('',(0.,0.,0.));#401=AXIS2_PLACEMENT_3D('',#400,$,$);
#402=REPRESENTATION_MAP(#401,#105);
#403=CARTESIAN_POINT('',(10.,0.,0.));#404=AXIS2_PLACEMENT_3D('',#403,$,$);
#405=MAPPED_ITEM('right',#402,#404);
#406=CARTESIAN_POINT('',(20.,0.,0.));#407=DIRECTION('',(0.,1.,0.));
#408=AXIS2_PLACEMENT_3D('',#406,$,#407);#409=MAPPED_ITEM('turned',#402,#408);
#410=SHAPE_REPRESENTATION('',(#405,#409),#4);
ENDSEC;END-ISO",
    );
    let brep = parse(placed.as_bytes()).unwrap();
    assert_eq!(brep.faces.len(), 2);
    let has =
        |x: f64, y: f64| brep.vertices.iter().any(|v| v.distance(DVec3::new(x, y, 1.0)) < 1e-12);
    assert!(has(14.0, 2.0) && has(18.0, 4.0) && !has(4.0, 2.0), "{:?}", brep.vertices);
}

#[test]
fn edges_without_length_mark_a_pole_only() {
    let text = plate("$", "PLANE('',#93)").replace(
        "#80=EDGE_LOOP('',(#70,",
        "#110=EDGE_CURVE('',#20,#20,#50,.T.);#111=ORIENTED_EDGE('',*,*,#110,.T.);
#80=EDGE_LOOP('',(#111,#70,",
    );
    let brep = parse(text.as_bytes()).unwrap();
    assert_eq!((brep.faces.len(), brep.faces[0].loops[0].len()), (1, 4));
}

/// The area of what a text holds.
fn area(text: &str) -> f64 {
    let brep = parse(text.as_bytes()).unwrap();
    let sampling = Sampling { max_edge: 0.3, chord_error: 0.002, corner_angle: 0.5 };
    tessellate(&brep, &sampling, &Job::default()).unwrap().area
}

/// The plate with more entities.
fn plate_with(more: &str) -> String {
    plate("$", "PLANE('',#93)").replace("ENDSEC;END-ISO", &format!("{more}\nENDSEC;END-ISO"))
}

const PLATE: f64 = 8.0 - 0.25 * std::f64::consts::PI;

#[test]
fn parts_in_units_of_their_own_are_brought_to_the_first() {
    let inches = "#500=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));
#501=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#500);
#502=(CONVERSION_BASED_UNIT('INCH',#501)LENGTH_UNIT()NAMED_UNIT(#503));
#503=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);
#504=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#502,#2,#3))
REPRESENTATION_CONTEXT('',''));";
    let text = plate_with(inches).replace("(#104),#4)", "(#104),#504)");
    let brep = parse(text.as_bytes()).unwrap();
    assert!(brep.vertices.iter().any(|v| v.distance(DVec3::new(4.0, 2.0, 1.0) * 0.0254) < 1e-12));
    // The hole's radius too.
    let hole = brep.edges.iter().find(|e| e.ends[0] == e.ends[1]).unwrap();
    let across = hole.curve.point(hole.range[0]).distance(DVec3::new(2.0, 1.0, 1.0) * 0.0254);
    assert!((across - 0.5 * 0.0254).abs() < 1e-12);
}

#[test]
fn edges_in_any_order_are_strung_together() {
    for order in ["(#70,#72,#71,#73)", "(#70,#71,#111,#73)"] {
        let turned = plate_with("#111=ORIENTED_EDGE('',*,*,#62,.F.);");
        assert!((area(&turned.replace("(#70,#71,#72,#73)", order)) / PLATE - 1.0).abs() < 1e-5);
    }
}

#[test]
fn hidden_faces_are_left_out_unless_all_are() {
    let hide = |more: &str| {
        let text = format!(
            "#600=STYLED_ITEM('',(#601),#104);#601=PRESENTATION_STYLE_ASSIGNMENT((.NULL.));
#602=INVISIBILITY((#600));{more}"
        );
        parse(plate_with(&text).as_bytes()).unwrap()
    };
    assert_eq!(hide("").faces.len(), 1);
    let second = "#610=ADVANCED_FACE('seen',(#81),#101,.T.);#611=OPEN_SHELL('',(#610));
#612=SHELL_BASED_SURFACE_MODEL('',(#611));";
    let brep = hide(second);
    assert_eq!((brep.faces.len(), brep.faces[0].loops.len()), (1, 1));
    assert!(brep.notes.iter().any(|n| n.contains("1 hidden")), "{:?}", brep.notes);
}

#[test]
fn what_is_left_out_is_named_as_in_the_file() {
    let text = plate_with("").replace("(#70,#71,#72,#73)", "(#70,#71,#73)");
    let (_, what) = parse(text.as_bytes()).unwrap_err();
    assert!(what.contains("#102 'plate'"), "{what}");
}

#[test]
fn roofs_of_corners_alone_have_edges_in_common() {
    // A pyramid's four sides: each is given by its corners, with points of its own.
    let corners = [[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [6.0, 6.0, 0.0], [0.0, 6.0, 0.0]];
    for kind in ["FACETED_BREP", "FACE_BASED_SURFACE_MODEL"] {
        let mut data = String::new();
        for k in 0..4 {
            let id = 700 + 10 * k;
            for (n, p) in [corners[k], corners[(k + 1) % 4], [3.0, 3.0, 2.0]].iter().enumerate() {
                data +=
                    &format!("#{}=CARTESIAN_POINT('',({:?},{:?},{:?}));", id + n, p[0], p[1], p[2]);
            }
            let (a, b, c) = (id, id + 1, id + 2);
            data += &format!(
                "#{}=POLY_LOOP('',(#{a},#{b},#{c}));#{}=FACE_BOUND('',#{},.T.);",
                id + 3,
                id + 4,
                id + 3
            );
            data += &format!("#{}=FACE('',(#{}));", id + 5, id + 4);
        }
        data += "#760=CONNECTED_FACE_SET('',(#705,#715,#725,#735));#761=";
        data += kind;
        data += if kind == "FACETED_BREP" { "('',#760);" } else { "('',(#760));" };
        let text = plate_with(&data).replace("#102=ADVANCED_FACE", "#102=NO_FACE");
        let text = if kind == "FACETED_BREP" {
            text.replace("CONNECTED_FACE_SET", "CLOSED_SHELL")
        } else {
            text
        };
        let brep = parse(text.as_bytes()).unwrap();
        assert_eq!((brep.faces.len(), brep.edges.len(), brep.vertices.len()), (4, 8, 5), "{kind}");
        assert!((area(&text) / (12.0 * 13.0_f64.sqrt()) - 1.0).abs() < 1e-9);
    }
}

#[test]
fn surfaces_in_sets_are_faces_and_their_curves_edges() {
    let whole = "#800=BEZIER_SURFACE('',1,1,((#10,#13),(#11,#12)),.UNSPECIFIED.,.F.,.F.,.U.);
#801=GEOMETRIC_SET('',(#800,#50));";
    let text = plate_with(whole).replace("#102=ADVANCED_FACE", "#102=NO_FACE");
    assert!((area(&text) / 8.0 - 1.0).abs() < 1e-9);
    let mut bounded = String::from("#801=GEOMETRIC_SET('',(#802));");
    let mut segments = Vec::new();
    for k in 0..4 {
        let (from, to) = (10 + k, 10 + (k + 1) % 4);
        bounded += &format!("#81{k}=TRIMMED_CURVE('',#5{k},(#{from}),(#{to}),.T.,.CARTESIAN.);");
        bounded += &format!("#82{k}=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#81{k});");
        segments.push(format!("#82{k}"));
    }
    bounded += &format!(
        "#803=OUTER_BOUNDARY_CURVE('',({}),.F.);#804=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.F.,#94);",
        segments.join(",")
    );
    bounded +=
        "#805=BOUNDARY_CURVE('',(#804),.F.);#802=CURVE_BOUNDED_SURFACE('',#101,(#803,#805),.F.);";
    let text = plate_with(&bounded).replace("#102=ADVANCED_FACE", "#102=NO_FACE");
    assert!((area(&text) / PLATE - 1.0).abs() < 1e-5);
}

#[test]
fn triangles_are_read_where_there_is_nothing_exact() {
    for list in [
        "TRIANGULATED_SURFACE_SET('',#900,4,(),(),((1,2,3),(1,3,4)))",
        "COMPLEX_TRIANGULATED_SURFACE_SET('',#900,4,(),(),((1,2,4,3)),())",
    ] {
        let text = plate_with(&format!(
            "#900=COORDINATES_LIST('',4,((0.,0.,0.),(6.,0.,0.),(6.,4.,1.),(0.,4.,1.)));#901={list};"
        ));
        assert!(matches!(super::parse(text.as_bytes().to_vec()).unwrap(), Found::Faces(_)));
        let text = text.replace("#102=ADVANCED_FACE", "#102=NO_FACE");
        let Found::Triangles(soup, source) = super::parse(text.as_bytes().to_vec()).unwrap() else {
            panic!("no triangles")
        };
        assert_eq!((soup.points.len(), soup.faces.len()), (4, 2));
        assert_eq!(source.unit.unwrap().metres, 1.0);
    }
}

#[test]
fn vaults_and_domes_of_conics_are_as_large_as_their_faces() {
    // A parabola over x from -3 to 3, 3 high, drawn along y for 4.
    let vault = "#300=CARTESIAN_POINT('',(0.,0.,3.));#301=DIRECTION('',(0.,1.,0.));#302=DIRECTION('',(0.,0.,-1.));
#303=AXIS2_PLACEMENT_3D('',#300,#301,#302);#304=PARABOLA('',#303,0.75);#305=VECTOR('',#301,1.);
#306=SURFACE_OF_LINEAR_EXTRUSION('',#304,#305);#307=CARTESIAN_POINT('',(-3.,0.,0.));#308=CARTESIAN_POINT('',(3.,0.,0.));
#309=CARTESIAN_POINT('',(-3.,4.,0.));#310=CARTESIAN_POINT('',(3.,4.,0.));#311=VERTEX_POINT('',#307);
#312=VERTEX_POINT('',#308);#313=VERTEX_POINT('',#309);#314=VERTEX_POINT('',#310);#315=CARTESIAN_POINT('',(0.,4.,3.));
#316=AXIS2_PLACEMENT_3D('',#315,#301,#302);#317=PARABOLA('',#316,0.75);#318=LINE('',#307,#305);#319=LINE('',#308,#305);
#320=EDGE_CURVE('',#311,#312,#304,.F.);#321=EDGE_CURVE('',#312,#314,#319,.T.);#322=EDGE_CURVE('',#313,#314,#317,.F.);
#323=EDGE_CURVE('',#311,#313,#318,.T.);#324=ORIENTED_EDGE('',*,*,#320,.T.);#325=ORIENTED_EDGE('',*,*,#321,.T.);
#326=ORIENTED_EDGE('',*,*,#322,.F.);#327=ORIENTED_EDGE('',*,*,#323,.F.);#328=EDGE_LOOP('',(#324,#325,#326,#327));
#329=FACE_BOUND('',#328,.T.);#330=ADVANCED_FACE('',(#329),#306,.T.);";
    let text = plate_with(vault).replace("#102=ADVANCED_FACE", "#102=NO_FACE");
    // Length of z = 3 - x^2 / 3 from -3 to 3.
    let length = 3.0 * 5.0_f64.sqrt() + 1.5 * 2.0_f64.asinh();
    assert!((area(&text) / (4.0 * length) - 1.0).abs() < 1e-5, "{} {}", area(&text), 4.0 * length);
}

/// A product whose shape is what the representations hold, and the axes that operators need.
const ROOF: &str = "#200=APPLICATION_CONTEXT('');#201=PRODUCT_CONTEXT('',#200,'mechanical');
#202=PRODUCT_DEFINITION_CONTEXT('part definition',#200,'design');#203=PRODUCT('roof','roof','',(#201));
#204=PRODUCT_DEFINITION_FORMATION('','',#203);#205=PRODUCT_DEFINITION('design','',#204,#202);
#206=PRODUCT_DEFINITION_SHAPE('','',#205);
#400=CARTESIAN_POINT('',(0.,0.,0.));#401=AXIS2_PLACEMENT_3D('',#400,$,$);
#402=REPRESENTATION_MAP(#401,#105);#403=DIRECTION('',(1.,0.,0.));#404=DIRECTION('',(-1.,0.,0.));
#405=DIRECTION('',(0.,1.,0.));#406=DIRECTION('',(0.,0.,1.));#407=CARTESIAN_POINT('',(10.,0.,0.));
#408=CARTESIAN_POINT('',(20.,0.,0.));";

fn has(brep: &Brep, x: f64, y: f64, z: f64) -> bool {
    brep.vertices.iter().any(|v| v.distance(DVec3::new(x, y, z)) < 1e-9)
}

#[test]
fn mapped_items_are_mirrored_and_scaled() {
    // The plate of 4 x 2 at z = 1 mirrored at x = 5, doubled from x = 20, and both, one in the other.
    let operators = "#410=CARTESIAN_TRANSFORMATION_OPERATOR_3D('',$,'',#404,#405,#407,1.,#406);
#411=MAPPED_ITEM('mirrored',#402,#410);
#412=(CARTESIAN_TRANSFORMATION_OPERATOR($,$,#408,2.)CARTESIAN_TRANSFORMATION_OPERATOR_3D($)
FUNCTIONALLY_DEFINED_TRANSFORMATION('','')GEOMETRIC_REPRESENTATION_ITEM()REPRESENTATION_ITEM(''));
#413=MAPPED_ITEM('doubled',#402,#412);";
    for (placed, faces, places) in [
        ("(#411)", 1, vec![[6.0, 2.0, 1.0], [10.0, 0.0, 1.0]]),
        ("(#413)", 1, vec![[28.0, 4.0, 2.0], [20.0, 0.0, 2.0]]),
        ("(#411,#413)", 2, vec![[6.0, 2.0, 1.0], [28.0, 4.0, 2.0]]),
        ("(#104,#411)", 2, vec![[0.0, 2.0, 1.0], [6.0, 2.0, 1.0]]),
    ] {
        let text = plate_with(&format!(
            "{ROOF}{operators}#420=SHAPE_REPRESENTATION('',{placed},#4);
#421=SHAPE_DEFINITION_REPRESENTATION(#206,#420);"
        ));
        let brep = parse(text.as_bytes()).unwrap();
        assert_eq!(brep.faces.len(), faces, "{placed}");
        assert!(
            places.iter().all(|&[x, y, z]| has(&brep, x, y, z)),
            "{placed} {:?}",
            brep.vertices
        );
        assert!(brep.source.losses.is_empty(), "{:?}", brep.source.losses);
    }
    let nested = plate_with(&format!(
        "{ROOF}{operators}#420=SHAPE_REPRESENTATION('',(#104,#411),#4);
#421=REPRESENTATION_MAP(#401,#420);#422=MAPPED_ITEM('',#421,#412);
#423=SHAPE_REPRESENTATION('',(#422),#4);#424=SHAPE_DEFINITION_REPRESENTATION(#206,#423);"
    ));
    let brep = parse(nested.as_bytes()).unwrap();
    assert_eq!(brep.faces.len(), 2);
    assert!(has(&brep, 28.0, 4.0, 2.0) && has(&brep, 32.0, 4.0, 2.0), "{:?}", brep.vertices);
    // Mirrored, a face keeps its outside: the two look the same way.
    let up = |f: &crate::surface::brep::BrepFace| {
        let normal = f.shape.jet(glam::DVec2::splat(0.5)).normal().z;
        normal * if f.reversed { -1.0 } else { 1.0 }
    };
    assert!(up(&brep.faces[0]) * up(&brep.faces[1]) > 0.0);
}

/// An assembly of one part, placed by what `operator` is.
fn assembly(operator: &str, order: &str) -> String {
    plate_with(&format!(
        "{ROOF}#210=PRODUCT('plate','plate','',(#201));#211=PRODUCT_DEFINITION_FORMATION('','',#210);
#212=PRODUCT_DEFINITION('design','',#211,#202);#213=PRODUCT_DEFINITION_SHAPE('','',#212);
#214=SHAPE_DEFINITION_REPRESENTATION(#213,#105);#215=SHAPE_REPRESENTATION('',(#401,#410),#4);
#216=SHAPE_DEFINITION_REPRESENTATION(#206,#215);#410={operator};
#411=(REPRESENTATION_RELATIONSHIP('','',{order})REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#410)
SHAPE_REPRESENTATION_RELATIONSHIP());#412=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#411,#413);
#413=PRODUCT_DEFINITION_SHAPE('','',#414);
#414=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','','',#205,#212,$);"
    ))
}

#[test]
fn parts_of_assemblies_are_mirrored_and_scaled() {
    let mirror = "CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#404,#405,#407,1.,#406)";
    let half = "CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#403,#405,#408,0.5,#406)";
    for (operator, order, corner) in [
        (mirror, "#105,#215", [6.0, 2.0, 1.0]),
        (half, "#105,#215", [22.0, 1.0, 0.5]),
        // The other way round the operator leads from the assembly to the part.
        (half, "#215,#105", [-32.0, 4.0, 2.0]),
    ] {
        let brep = parse(assembly(operator, order).as_bytes()).unwrap();
        assert_eq!(brep.faces.len(), 1);
        let [x, y, z] = corner;
        assert!(has(&brep, x, y, z), "{operator} {order} {:?}", brep.vertices);
    }
    // OpenCascade writes the scale of the way back, below 0 where it mirrors: p -> (T p + A) / S.
    let by_occ = |operator: &str| {
        let text = assembly(operator, "#105,#215");
        parse(text.replace("FILE_NAME('',''", "FILE_NAME('Open CASCADE Shape Model',''").as_bytes())
    };
    let brep = by_occ(half).unwrap();
    assert!(has(&brep, 48.0, 4.0, 2.0), "{:?}", brep.vertices);
    let back = "CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#403,$,#407,-1.,#406)";
    let brep = by_occ(back).unwrap();
    assert!(has(&brep, -14.0, -2.0, -1.0), "{:?}", brep.vertices);
}

#[test]
fn placements_that_distort_are_refused_by_name() {
    let uneven =
        "CARTESIAN_TRANSFORMATION_OPERATOR_3D_NON_UNIFORM('','','',#403,#405,#407,1.,#406)";
    let nothing = "CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#403,#405,#407,0.,#406)";
    let one = "CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#406,#405,#407,1.,#406)";
    for (operator, why) in [(uneven, "differently"), (nothing, "nothing"), (one, "are one")] {
        let (_, what) = parse(assembly(operator, "#105,#215").as_bytes()).unwrap_err();
        assert!(what.contains("part 'plate' (1 face)") && what.contains(why), "{what}");
        let mapped = plate_with(&format!(
            "{ROOF}#410={operator};#411=MAPPED_ITEM('wing',#402,#410);
#420=SHAPE_REPRESENTATION('',(#104,#411),#4);#421=SHAPE_DEFINITION_REPRESENTATION(#206,#420);"
        ));
        let brep = parse(mapped.as_bytes()).unwrap();
        assert_eq!((brep.faces.len(), brep.source.losses.len()), (1, 1));
        let lost = &brep.source.losses[0];
        assert!(lost.what == "mapped item 'wing'" && lost.whole && lost.faces == 1, "{lost}");
        assert!(lost.why.contains(why), "{lost}");
    }
}
