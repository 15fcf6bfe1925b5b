//! Ground forces as arrows, from tables with the columns of `grf.mot`.

use super::{ForceRole, StageForce};
use ambulo::model::Side;
use ambulo::spatial::Vec3;
use ambulo_formats::table::Table;

/// Forces of a table with one row per instant: `ground_force_{s}_v` and `ground_force_{s}_p` with x, y, z. An unloaded
/// foot has zeros in the table and no arrow.
pub(super) fn forces(table: &Table, role: ForceRole) -> Vec<StageForce> {
    Side::BOTH.into_iter().filter_map(|side| force(table, side, role)).collect()
}

fn force(table: &Table, side: Side, role: ForceRole) -> Option<StageForce> {
    let [force, point] = ["v", "p"].map(|kind| vectors(table, &format!("ground_force_{}_{kind}", side.letter())));
    let (force, point) = (force?, point?);
    let acts = |f: &Vec3| f.norm() > 0.0 && f.iter().all(|x| x.is_finite());
    let gap = Vec3::repeat(f64::NAN);
    let point = force.iter().zip(point).map(|(f, p)| if acts(f) { p } else { gap }).collect();
    let force: Vec<Vec3> = force.into_iter().map(|f| if acts(&f) { f } else { gap }).collect();
    if force.iter().all(|f| f.x.is_nan()) {
        return None;
    }
    let name = if role == ForceRole::Measured { format!("{side}, plates") } else { side.to_string() };
    Some(StageForce { name, side: Some(side), role, point, force })
}

fn vectors(table: &Table, stem: &str) -> Option<Vec<Vec3>> {
    let [x, y, z] = ["x", "y", "z"].map(|axis| table.column(&format!("{stem}{axis}")));
    Some(x?.iter().zip(y?).zip(z?).map(|((x, y), z)| Vec3::new(*x, *y, *z)).collect())
}
