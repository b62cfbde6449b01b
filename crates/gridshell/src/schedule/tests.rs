use super::*;
use crate::surface::Surface;
use glam::DVec3;

/// Two panels of side 1 that meet at a right angle along the y axis, seen from above a ridge.
fn ridge() -> (Grid, Surface) {
    let h = 0.75f64.sqrt() * 0.5f64.sqrt();
    let xyz = vec![
        DVec3::new(0.0, 0.0, 0.0),
        DVec3::new(0.0, 1.0, 0.0),
        DVec3::new(-h, 0.5, -h),
        DVec3::new(h, 0.5, -h),
    ];
    Grid::alone("ridge", xyz, &[[0, 1, 2], [1, 0, 3]]).expect("two panels")
}

fn schedule(grid: &Grid, surface: &Surface) -> Schedule {
    Schedule::new(grid, surface, &Tolerances::default())
}

#[test]
fn a_ridge_folds_by_a_right_angle_outwards() {
    let (grid, surface) = ridge();
    let schedule = schedule(&grid, &surface);
    let ridge = schedule.members.between(1, 0).expect("the ridge is a member");
    assert!((schedule.members.fold_deg[ridge].expect("inside") - 90.0).abs() < 1e-9);
    assert!(schedule.members.normal[ridge].distance(DVec3::Z) < 1e-12);
    assert_eq!(schedule.members.fold_deg.iter().flatten().count(), 1);
    assert_eq!(schedule.figures.length.groups, 1);
    assert!((schedule.figures.length.total - 5.0).abs() < 1e-12);
    assert_eq!(schedule.figures.panel.distinct, 1);
    assert!((schedule.figures.angle_deg.mean - 60.0).abs() < 1e-9);
}

#[test]
fn a_valley_folds_the_other_way() {
    let (grid, _) = ridge();
    let xyz: Vec<DVec3> = grid.xyz.iter().map(|p| DVec3::new(p.x, p.y, -p.z)).collect();
    let (grid, surface) = Grid::alone("valley", xyz, &[[0, 1, 2], [1, 0, 3]]).expect("two panels");
    let schedule = schedule(&grid, &surface);
    let valley = schedule.members.between(0, 1).expect("a member");
    assert!((schedule.members.fold_deg[valley].expect("inside") + 90.0).abs() < 1e-9);
}

#[test]
fn twist_is_the_turn_of_the_normals_about_the_member() {
    // A strip that turns by 20 degrees from one end to the other about the x axis.
    let turn = 20f64.to_radians();
    let (n, half) = (40, 0.5);
    let mut xyz = Vec::new();
    for k in 0..=n {
        let (sin, cos) = (turn * f64::from(k) / f64::from(n)).sin_cos();
        for y in [-half, 0.0, half] {
            xyz.push(DVec3::new(f64::from(k) / f64::from(n), y * cos, y * sin));
        }
    }
    let mut panels = Vec::new();
    for k in 0..n as u32 {
        for j in 0..2 {
            let a = 3 * k + j;
            panels.extend([[a, a + 3, a + 4], [a, a + 4, a + 1]]);
        }
    }
    let (grid, surface) = Grid::alone("strip", xyz, &panels).expect("a strip");
    let schedule = schedule(&grid, &surface);
    let middle = schedule.members.between(3 * 20 + 1, 3 * 21 + 1).expect("along the axis");
    let twist = schedule.members.twist_deg[middle];
    assert!((twist - 0.5).abs() < 0.01, "{twist}");
}

#[test]
fn groups_hold_no_more_than_the_tolerance() {
    let groups = groups_within(&[1.0, 1.3, 1.1, 1.21, 1.0], 0.2);
    assert_eq!(groups, [0, 1, 0, 1, 0]);
    assert!(groups_within(&[], 0.1).is_empty());
}

#[test]
fn a_hexagon_has_one_kind_of_panel_and_two_of_nodes() {
    let h = 0.75f64.sqrt();
    let mut xyz = vec![DVec3::ZERO];
    for (x, y) in [(1.0, 0.0), (0.5, h), (-0.5, h), (-1.0, 0.0), (-0.5, -h), (0.5, -h)] {
        xyz.push(DVec3::new(x, y, 0.0));
    }
    let panels: Vec<[u32; 3]> = (0..6).map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect();
    let (grid, surface) = Grid::alone("six", xyz, &panels).expect("a hexagon");
    let figures = schedule(&grid, &surface).figures;
    assert_eq!((figures.panel.distinct, figures.distinct_nodes), (1, 2));
    assert_eq!(figures.curvature_share, None);
    assert!(figures.gauss_curvature_deg.abs() < 1e-9);
    assert_eq!(figures.length.spread.histogram.counts.iter().sum::<usize>(), 12);
}
