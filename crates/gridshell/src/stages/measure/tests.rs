//! Small grids whose measures are worked out by hand.

use super::*;
use crate::math::trig;
use crate::surface::Surface;
use glam::DVec3;
use std::f64::consts::PI;

const OPTIONS: recipe::Measure =
    recipe::Measure { lambda: 0.9, length_tolerance: None, angle_tolerance_deg: 1.0 };

fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9 * b.abs().max(1.0), "{a} is not {b}");
}

/// A hub with `n` spokes of length 1 in the plane, the hub lifted by `z`.
fn wheel(n: u32, z: f64) -> (Grid, Surface) {
    let mut xyz = vec![DVec3::new(0.0, 0.0, z)];
    for k in 0..n {
        let a = 2.0 * PI * f64::from(k) / f64::from(n);
        xyz.push(DVec3::new(trig::cos(a), trig::sin(a), 0.0));
    }
    let panels: Vec<[u32; 3]> = (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]).collect();
    Grid::alone("wheel", xyz, &panels).expect("a disc")
}

fn measured((grid, surface): &(Grid, Surface)) -> Quality {
    measure(grid, surface, 1.0, &OPTIONS)
}

#[test]
fn a_hexagon_of_equilateral_panels_is_a_perfect_lattice() {
    let quality = measured(&wheel(6, 0.0));
    assert_eq!((quality.nodes, quality.members, quality.panels), (7, 12, 6));
    assert_eq!(
        (quality.interior_nodes, quality.boundary_nodes, quality.euler_characteristic),
        (1, 6, 1)
    );
    assert_eq!(quality.irregular, Irregular { interior: 0, boundary: 0 });
    assert_eq!(quality.degrees.interior, BTreeMap::from([(6, 1)]));
    assert_eq!(quality.degrees.boundary, BTreeMap::from([(6, 6)]));
    assert_eq!(quality.mu, 0.0);
    assert_eq!(quality.mu_floor, 0.0);
    close(quality.delta_deg, 0.0);
    close(quality.delta_floor_deg, 0.0);
    // n* = 0.9 + 6 * 0.1 = 1.5, so rho = 0.9 / 1.5.
    close(quality.rho, 0.6);
    assert_eq!(quality.fluency, None);
    close(quality.edge_length.mean, 1.0);
    close(quality.edge_length.cv, 0.0);
    close(quality.shape.mean, 1.0);
    close(quality.shape.min, 1.0);
    close(quality.min_angle_deg, 60.0);
    close(quality.area_ratio, 1.0);
    assert_eq!((quality.bridging_members, quality.folded_panels), (0, 0));
    close(quality.border.shape_mean, 1.0);
}

#[test]
fn a_single_node_of_degree_five() {
    let wheel = wheel(5, 0.0);
    let quality = measured(&wheel);
    // R = 0.9 and n* = 0.9 + 5 * 0.1; corners of 108 degrees have degree 3 and virtual degree 3.
    close(quality.mu, (0.9f64 / 1.4).sqrt());
    // 6 chi - 5 (3 - 2) = 1: one irregular node, which would weigh 0.1 on the boundary.
    close(quality.mu_floor, (0.1f64 / 1.4).sqrt());
    assert_eq!((quality.rho, quality.delta_deg), (0.0, 0.0));
    close(quality.fluency.expect("finite"), (1.4f64 / 0.9).sqrt());
    // Five spokes of 1 and five sides of 2 sin 36.
    let side = 2.0 * trig::sin(PI / 5.0);
    close(quality.edge_length.mean, f64::midpoint(1.0, side));
    close(quality.edge_length.variance, 10.0 * ((side - 1.0) / 2.0).powi(2) / 9.0);
    close(
        quality.edge_length.cv,
        ((side - 1.0) / 2.0) * (10.0f64 / 9.0).sqrt() / f64::midpoint(1.0, side),
    );
    close(quality.max_length_ratio, side);
    close(quality.min_length_ratio, 1.0);
    // q = 4 sqrt(3) (sin 72) / 2 / (2 + side^2)
    close(quality.shape.min, 2.0 * 3f64.sqrt() * trig::sin(0.4 * PI) / (2.0 + side * side));
    close(quality.min_angle_deg, 54.0);
    let irregular = irregular_nodes(&wheel.0);
    assert_eq!(irregular.len(), 1);
    assert_eq!((irregular[0].node, irregular[0].degree, irregular[0].adjusted_degree), (0, 5, 5));
    assert!(!irregular[0].boundary);
}

#[test]
fn a_lifted_hub_bends_its_three_lines_alike() {
    // Opposite members make 180 - 2 atan z; all beta_j are alike, so delta = sigma = 2 atan z.
    let quality = measured(&wheel(6, 0.1));
    let bend = 2.0 * trig::atan2(0.1, 1.0).to_degrees();
    close(quality.delta_deg, bend);
    close(quality.fluency.expect("finite"), 1.0 / (0.6 * bend / 60.0));
}

#[test]
fn a_crooked_node_has_sigma_and_tau() {
    // The spoke at 0 degrees turned to 6: beta_1 54 and beta_6 66 stand against beta_4 60 and beta_3 60,
    // one line is bent by 6. sigma^2 = 36 / 3, tau^2 = (36 + 36) / 3.
    let (mut grid, surface) = wheel(6, 0.0);
    let a = 6f64.to_radians();
    grid.xyz[1] = DVec3::new(trig::cos(a), trig::sin(a), 0.0);
    let quality = measure(&grid, &surface, 1.0, &OPTIONS);
    close(quality.delta_deg, 36f64.sqrt());
}

#[test]
fn the_rim_of_a_flat_disc_has_six_too_few() {
    // A 12-gon: virtual degree of its 150 degree corners is 2, so 6 chi - 0 = 6 stay missing.
    let quality = measured(&wheel(12, 0.0));
    close(quality.mu_floor, (0.1f64 * 6.0 / (0.9 + 1.2)).sqrt());
    // Degree 12 inside, 3 + 2 = 5 at every corner.
    assert_eq!(quality.degrees.boundary, BTreeMap::from([(5, 12)]));
    close(quality.mu, ((0.9f64 * 36.0 + 0.1 * 12.0) / 2.1).sqrt());
}

#[test]
fn an_octahedron_has_no_boundary_to_hide_twelve_in() {
    let xyz = vec![DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
    let panels =
        [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    let quality = measured(&Grid::alone("octahedron", xyz, &panels).expect("closed"));
    assert_eq!(quality.euler_characteristic, 2);
    // Six nodes of degree 4: R = 0.9 * 24, n* = 5.4; the floor has |6 chi| = 12 of deviation 1.
    close(quality.mu, 2.0);
    close(quality.mu_floor, 2f64.sqrt());
    assert_eq!(quality.boundary_deviation, 0.0);
}

#[test]
fn the_floor_of_delta_is_the_turning_of_the_surface() {
    // A strip of a cylinder of radius 5 about the y axis: at the middle node the surface turns by phi per
    // member along x and by phi / 2 per member along the two slanted lines, whose chord makes 60 degrees
    // with x (the third part of the curvature per unit length, cos^2 60, times the member's length).
    let (phi, radius) = (0.02, 5.0);
    let at = |u: f64, y: f64| {
        DVec3::new(radius * trig::sin(u * phi), y * radius * phi, radius * trig::cos(u * phi))
    };
    let h = 3f64.sqrt() / 2.0;
    let xyz = vec![
        at(0., 0.),
        at(1., 0.),
        at(0.5, h),
        at(-0.5, h),
        at(-1., 0.),
        at(-0.5, -h),
        at(0.5, -h),
    ];
    let panels: Vec<[u32; 3]> = (0..6).map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect();
    let (grid, _) = Grid::alone("cylinder", xyz, &panels).expect("a disc");
    let normals: Vec<DVec3> = grid.xyz.iter().map(|p| DVec3::new(p.x, 0.0, p.z) / radius).collect();
    // kappa l: phi along x; along a slanted line phi cos^2 60 = phi / 4.
    let by_hand = phi * ((1.0 + 2.0 / 16.0) / 3.0f64).sqrt();
    let floor = floors::delta_deg(&grid, &normals).to_radians();
    assert!((floor / by_hand - 1.0).abs() < 1e-3, "{floor} is not {by_hand}");
}

#[test]
fn a_node_off_the_surface_and_off_the_boundary_shows() {
    let (mut grid, surface) = wheel(6, 0.0);
    grid.xyz[0].z = 0.25;
    grid.xyz[1].x += 0.1;
    let quality = measure(&grid, &surface, 2.0, &OPTIONS);
    close(quality.surface_deviation, 0.125);
    close(quality.boundary_deviation, 0.05);
}

#[test]
fn a_panel_turned_over_is_folded() {
    // The hub dragged over the side between nodes 1 and 2 turns that one panel over.
    let (mut grid, surface) = wheel(6, 0.0);
    grid.xyz[0] = DVec3::new(1.0, 0.7, 0.0);
    assert_eq!(measure(&grid, &surface, 1.0, &OPTIONS).folded_panels, 1);
}

#[test]
fn a_grid_read_inside_out_is_turned() {
    let (grid, surface) = wheel(6, 0.1);
    let inwards: Vec<[u32; 3]> = grid.mesh.triangles().map(|[a, b, c]| [a, c, b]).collect();
    let read = Grid::from_panels(grid.xyz.clone(), &inwards, &surface).expect("a disc");
    assert_eq!(measure(&read, &surface, 1.0, &OPTIONS).folded_panels, 0);
    assert_eq!(read.mesh.triangles().next(), grid.mesh.triangles().next());
}

#[test]
fn a_member_between_two_sheets_is_a_bridge_and_one_at_a_concave_border_is_not() {
    // A strip in the shape of a U, 10 long in each leg, the legs 0.4 apart.
    let mut xyz = Vec::new();
    let stations = (0..=20)
        .map(|k| (f64::from(k) * 0.5, 0.0))
        .chain((0..=20).map(|k| (10.0 - f64::from(k) * 0.5, 0.4)));
    for (x, z) in stations {
        xyz.extend([DVec3::new(x, 0.0, z), DVec3::new(x, 1.0, z)]);
    }
    let mut facets = Vec::new();
    for k in (0..xyz.len() as u32 - 2).step_by(2) {
        facets.extend([[k, k + 2, k + 3], [k, k + 3, k + 1]]);
    }
    let surface = Surface::from_facets("fold", xyz, facets);
    // Two panels on the lower leg and one whose tip sits on the upper leg above them.
    let nodes = vec![
        DVec3::new(2.0, 0.0, 0.0),
        DVec3::new(3.0, 0.0, 0.0),
        DVec3::new(2.5, 0.9, 0.0),
        DVec3::new(2.5, 0.0, 0.4),
    ];
    let honest = Grid::from_panels(nodes[..3].to_vec(), &[[0, 1, 2]], &surface).expect("a panel");
    assert_eq!(measure(&honest, &surface, 1.0, &OPTIONS).bridging_members, 0);
    let leaping = Grid::from_panels(nodes, &[[0, 1, 2], [1, 0, 3]], &surface).expect("two panels");
    assert_eq!(measure(&leaping, &surface, 1.0, &OPTIONS).bridging_members, 2);

    // A ring between radius 2 and 4: the chord of a member along the inner circle lies in the hole.
    let ring = |r: f64, k: u32| {
        let a = PI * f64::from(k) / 24.0;
        DVec3::new(r * trig::cos(a), r * trig::sin(a), 0.0)
    };
    let xyz: Vec<DVec3> = (0..48).flat_map(|k| [ring(2.0, k), ring(4.0, k)]).collect();
    let facets: Vec<[u32; 3]> = (0..48u32)
        .flat_map(|k| {
            let (a, b) = (2 * k, 2 * ((k + 1) % 48));
            [[a, a + 1, b + 1], [a, b + 1, b]]
        })
        .collect();
    let surface = Surface::from_facets("ring", xyz, facets);
    let nodes = vec![ring(2.0, 0), ring(3.5, 3), ring(2.0, 6)];
    let grid = Grid::from_panels(nodes, &[[0, 1, 2]], &surface).expect("a panel");
    assert_eq!(measure(&grid, &surface, 1.5, &OPTIONS).bridging_members, 0);
}
