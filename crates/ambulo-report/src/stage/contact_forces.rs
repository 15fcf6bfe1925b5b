//! Forces between the bodies of a scene, from `contacts.csv`: one arrow per pair of bodies, the sum over their contact
//! points, at the mean of the points weighted by the normal forces.

use super::StageForce;
use super::csv_rows::Row;
use ambulo::model::Side;
use ambulo::numerics::Order;
use ambulo::spatial::Vec3;
use ambulo_results::{CONTACTS, Folder, ResultsError};
use std::collections::BTreeMap;

const HEAD: &str = "time,kind,first,second,px,py,pz,nx,ny,nz,fx,fy,fz,normal_force";
/// Maximum number of drawn pairs; those with the largest forces are drawn.
const MOST_PAIRS: usize = 32;

/// Bodies of a foot without their side, in built-in figures and in OpenSim models.
const FOOT: [&str; 2] = ["calcn", "toes"];

/// Sum over the contact points of a pair at one instant.
#[derive(Clone, Copy, Default)]
struct Sum {
    force: Vec3,
    /// Sum of points times normal forces.
    moment: Vec3,
    normal: f64,
}

/// The forces at these instants (as written in the file), and a sentence on what is left out.
pub(super) fn read(
    folder: &Folder<'_>,
    text: &str,
    times: &[String],
) -> Result<(Vec<StageForce>, Option<String>), ResultsError> {
    let instants: BTreeMap<&str, usize> = times.iter().enumerate().map(|(i, time)| (time.as_str(), i)).collect();
    let mut pairs: BTreeMap<(String, String), BTreeMap<usize, Sum>> = BTreeMap::new();
    for row in Row::all(folder, CONTACTS, text, HEAD)? {
        let Some(&instant) = instants.get(row.word(0)?).filter(|_| row.word(1).is_ok_and(|kind| kind == "contact"))
        else {
            continue;
        };
        let [px, py, pz, _, _, _, fx, fy, fz, normal] = row.numbers(4)?;
        let pair = (owner(row.word(2)?), owner(row.word(3)?));
        let sum = pairs.entry(pair).or_default().entry(instant).or_default();
        sum.force += Vec3::new(fx, fy, fz);
        sum.moment += Vec3::new(px, py, pz) * normal;
        sum.normal += normal;
    }
    let mut forces: Vec<StageForce> = pairs.iter().map(|(pair, sums)| arrow(pair, sums, times.len())).collect();
    let left = forces.len().saturating_sub(MOST_PAIRS);
    if left > 0 {
        forces.sort_by_number(|force| -largest(force));
        forces.truncate(MOST_PAIRS);
    }
    let note = format!(
        "Of {} pairs of bodies in contact, only the {MOST_PAIRS} with the largest forces have arrows.",
        left + MOST_PAIRS
    );
    Ok((forces, (left > 0).then_some(note)))
}

/// The body on which a force acts; rear foot and toes are one foot.
fn owner(body: &str) -> String {
    let foot = body.rsplit_once('/').and_then(|(figure, name)| {
        let (side, stem) = Side::split_name(name)?;
        FOOT.contains(&stem.as_str()).then(|| format!("{figure}/foot_{}", side.letter()))
    });
    foot.unwrap_or_else(|| body.to_owned())
}

fn arrow((first, second): &(String, String), sums: &BTreeMap<usize, Sum>, instants: usize) -> StageForce {
    let mut arrow = StageForce::nowhere(format!("{second} on {first}"), Side::of_name(first), instants);
    for (&instant, sum) in sums.iter().filter(|(_, sum)| sum.normal > 0.0) {
        arrow.force[instant] = sum.force;
        arrow.point[instant] = sum.moment / sum.normal;
    }
    arrow
}

fn largest(force: &StageForce) -> f64 {
    force.force.iter().map(|f| f.norm()).fold(0.0, f64::max)
}
