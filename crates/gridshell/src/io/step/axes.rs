//! Placements whose x axis is left out or lies along their z axis: given the x axis that STEP lays down for them.
//!
//! Left out, it is the model's x, or y where the z axis is along x. So stand the planes of many facades.

use super::text::{Draft, Text, reference, triple};
use glam::DVec3;

/// Directions that differ by less than this (the sine of their angle) are one.
const PARALLEL: f64 = 1e-9;

/// The text with an x axis for each such placement; None where there is none.
pub(super) fn mended(text: &Text) -> Option<Vec<u8>> {
    let mut draft = Draft::of(text);
    let placements = text.records.iter().filter(|r| text.keyword(r) == b"AXIS2_PLACEMENT_3D");
    for record in placements {
        let list = text.list(record);
        let way = |k: usize| {
            let id = reference(text.words(list.get(k)?))?;
            Some(DVec3::from(text.xyz(text.get(id)?)?).normalize_or_zero())
        };
        let Some(z) = way(2).filter(|z| *z != DVec3::ZERO) else { continue };
        let x = way(3).unwrap_or(DVec3::X);
        if list.len() == 4 && x.cross(z).length() < PARALLEL {
            let x = if z.x.abs() > 0.5 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
            let id = draft.add(&triple("DIRECTION", x));
            draft.put(list[3].clone(), format!("#{id}"));
        }
    }
    draft.done()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facades_get_an_x_axis_and_others_keep_theirs() {
        let text = "DATA;#1=DIRECTION('',(1.,0.,0.));#2=DIRECTION('',(0.,0.,1.));
#3=AXIS2_PLACEMENT_3D('',#9,#1,$);#4=AXIS2_PLACEMENT_3D('',#9,#2,#2);#5=AXIS2_PLACEMENT_3D('',#9,#2,$);ENDSEC;";
        let done = String::from_utf8(mended(&Text::of(text.into())).unwrap()).unwrap();
        assert!(
            done.contains("#9,#1,#6)") && done.contains("#6=DIRECTION('',(0.0,1.0,0.0))"),
            "{done}"
        );
        assert!(
            done.contains("#9,#2,#7)") && done.contains("#7=DIRECTION('',(1.0,0.0,0.0))"),
            "{done}"
        );
        assert!(done.contains("#5=AXIS2_PLACEMENT_3D('',#9,#2,$)"), "{done}");
    }
}
