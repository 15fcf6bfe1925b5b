//! Curves of a walk in three dimensions over the cycle of the right foot, and those of people.

use crate::normative::{self, Band, SAMPLES, Sheet};
use Reading::{Angle, Force, Moment};
use ambulo::gait::Walk;
use ambulo::model::anthropometry::Human;
use ambulo::model::{Model, Side};
use ambulo::optimal::{Sample, Solution, WalkProblem};

/// One curve, with its names in the tables of people.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quantity {
    pub(super) name: &'static str,
    pub(super) sheet: Sheet,
    /// Name in Schwartz's tables.
    pub(super) table: &'static str,
    /// Name in Pinzone's tables.
    pub(super) second: Option<&'static str>,
    reading: Reading,
}

/// How a curve is read from a walk.
#[derive(Debug, Clone, Copy)]
enum Reading {
    /// Coordinate and its sign [deg].
    Angle(&'static str, f64),
    /// Generalised force of a coordinate and its sign [N.m/kg].
    Moment(&'static str, f64),
    /// Ground force under the right foot along an axis [body weights].
    Force(usize),
}

const fn quantity(name: &'static str, table: &'static str, second: Option<&'static str>, reading: Reading) -> Quantity {
    let sheet = match reading {
        Angle(..) => Sheet::Angles,
        Moment(..) => Sheet::Moments,
        Force(_) => Sheet::Forces,
    };
    Quantity { name, sheet, table, second, reading }
}

/// Everything that is compared.
pub(super) const QUANTITIES: [Quantity; 13] = [
    quantity("hip flexion", "Hip Flex/Extension", Some("Hip Flx/Ext"), Angle("hip_flexion_r", 1.0)),
    quantity("knee flexion", "Knee Flex/Extension", Some("Knee Flx/Ext"), Angle("knee_angle_r", -1.0)),
    quantity("ankle dorsiflexion", "Ankle Dorsi/Plantarflexion", Some("Ankle Dor/Pla"), Angle("ankle_angle_r", 1.0)),
    quantity("pelvic obliquity", "Pelvic Up/Down Obliquity", Some("Pelvic Up/Dn"), Angle("pelvis_list", -1.0)),
    quantity("pelvic rotation", "Pelvic Int/External Rotation", Some("Pelvic Int/Ext"), Angle("pelvis_rotation", 1.0)),
    quantity("hip adduction", "Hip Ad/Abduction", Some("Hip Add/Abd"), Angle("hip_adduction_r", 1.0)),
    quantity("hip rotation", "Hip Int/External Rotation", Some("Hip Int/Ext"), Angle("hip_rotation_r", 1.0)),
    quantity("hip extension moment", "Hip Ext/Flexion", Some("Hip Extensor Moment"), Moment("hip_flexion_r", -1.0)),
    quantity("knee extension moment", "Knee Ext/Flexion", Some("Knee Extensor Moment"), Moment("knee_angle_r", 1.0)),
    quantity(
        "plantarflexion moment",
        "Ankle Dorsi/Plantarflexion",
        Some("Plantarflexor Moment"),
        Moment("ankle_angle_r", -1.0),
    ),
    quantity("hip abduction moment", "Hip Ab/Adduction", Some("Hip Abductor Moment"), Moment("hip_adduction_r", -1.0)),
    quantity("vertical force", "Vertical", None, Force(1)),
    quantity("fore-aft force", "Anterior/Posterior", None, Force(0)),
];

impl Quantity {
    /// Smallest standard deviation of a band, in the unit of the table.
    fn least_sd(self) -> f64 {
        match self.sheet {
            Sheet::Angles => 2.0,
            Sheet::Forces => 0.02,
            _ => 0.05,
        }
    }

    fn value(self, model: &Model, walk: &Walk, right: &[usize], at: &Sample) -> f64 {
        let id = |name: &str| model.coordinate(name).map_or(0, |id| id.index());
        match self.reading {
            Angle(name, sign) => {
                // Clinical hip flexion is relative to the pelvis, whose tilt in upright standing is not zero.
                let standing = if name == "hip_flexion_r" { walk.standing_tilt() } else { 0.0 };
                (sign * at.posture[0][id(name)] + standing).to_degrees()
            }
            Moment(name, sign) => sign * at.forces[id(name)] / model.mass(),
            Force(axis) => at.ground_force(right)[axis] / (model.mass() * model.gravity().norm()),
        }
    }
}

/// The bands of people at five speeds, moments for a leg of `leg_length`.
pub(super) fn people(leg_length: f64, their_leg: f64) -> Result<[Vec<Band>; 5], String> {
    let mut people: [Vec<Band>; 5] = Default::default();
    for quantity in QUANTITIES {
        let scale = if quantity.sheet == Sheet::Moments { leg_length / their_leg } else { 1.0 };
        for (speed, mut band) in normative::bands(quantity.sheet, quantity.table)?.into_iter().enumerate() {
            band.mean.iter_mut().for_each(|mean| *mean *= scale);
            band.sd.iter_mut().for_each(|sd| *sd = sd.max(quantity.least_sd()) * scale);
            people[speed].push(band);
        }
    }
    Ok(people)
}

/// Samples per cycle of quantities that the tables do not have; a multiple of the number in the tables.
const FINE: usize = 1000;
/// A foot is in stance above this share of body weight.
const LOADED: f64 = 0.03;

/// A cycle of the right foot.
#[derive(Debug, Clone)]
pub(super) struct Cycle {
    /// At the samples of the tables, in the order of [`QUANTITIES`].
    pub(super) curves: Vec<Vec<f64>>,
    /// Sideways force on the right foot over stance, positive to the left [body weights].
    pub(super) sideways: Vec<f64>,
    /// Sideways distance between the mean centres of pressure of both feet [m].
    pub(super) step_width: f64,
    /// Smallest flexion of the knee [deg].
    pub(super) least_knee: f64,
    /// Range of the forward slip over stance, summed from the most loaded sphere at each instant [m].
    pub(super) slip: f64,
    /// Mean vertical force of both feet, and mean fore-aft force [body weights].
    pub(super) mean_force: [f64; 2],
}

impl Cycle {
    pub(super) fn of(human: &Human, walk: &Walk, problem: &WalkProblem, solution: &Solution) -> Result<Cycle, String> {
        let times: Vec<f64> = (0..=FINE).map(|k| walk.cycle_s() * k as f64 / FINE as f64).collect();
        let samples = solution.samples(&times).map_err(|e| e.to_string())?;
        let soles = &problem.problem.soles;
        let of = |side: Side| (0..soles.len()).filter(|&k| soles[k].side == side).collect::<Vec<usize>>();
        let (right, left) = (of(Side::Right), of(Side::Left));
        let model = &human.model;
        let weight = model.mass() * model.gravity().norm();
        let coarse = || samples.iter().step_by(FINE / (SAMPLES - 1));
        let curve = |quantity: Quantity| coarse().map(|at| quantity.value(model, walk, &right, at)).collect();
        let loaded = |at: &&Sample| at.ground_force(&right).y > LOADED * weight;
        let stance: Vec<&Sample> = samples.iter().filter(loaded).collect();
        let sideways: Vec<f64> = stance.iter().map(|at| -at.ground_force(&right).z / weight).collect();
        let both: Vec<usize> = (0..soles.len()).collect();
        let mean = |axis: usize| {
            samples[..FINE].iter().map(|at| at.ground_force(&both)[axis]).sum::<f64>() / (FINE as f64 * weight)
        };
        let knee = model.coordinate("knee_angle_r").map_or(0, |id| id.index());
        let step_s = walk.cycle_s() / FINE as f64;
        Ok(Cycle {
            curves: QUANTITIES.into_iter().map(curve).collect(),
            sideways: super::sideways::resampled(&sideways),
            step_width: mean_place(&samples, &right) - mean_place(&samples, &left),
            least_knee: samples.iter().map(|at| -at.posture[0][knee].to_degrees()).fold(f64::INFINITY, f64::min),
            slip: slip(&stance, &right, step_s),
            mean_force: [mean(1), mean(0)],
        })
    }
}

/// Mean sideways position of the contacts, weighted by vertical force [m].
fn mean_place(samples: &[Sample], spheres: &[usize]) -> f64 {
    let (mut place, mut load) = (0.0, 0.0);
    for contact in samples.iter().flat_map(|at| spheres.iter().map(|&s| &at.contacts[s])) {
        place += contact.place.z * contact.force.y;
        load += contact.force.y;
    }
    place / load
}

/// Range of the forward slip over a stance, summed from the most loaded sphere at each instant [m].
fn slip(stance: &[&Sample], spheres: &[usize], step_s: f64) -> f64 {
    let (mut slipped, mut least, mut most) = (0.0_f64, 0.0_f64, 0.0_f64);
    for at in stance {
        let heaviest = spheres.iter().map(|&s| &at.contacts[s]).max_by(|a, b| a.force.y.total_cmp(&b.force.y));
        slipped += heaviest.map_or(0.0, |contact| contact.slip[0]) * step_s;
        (least, most) = (least.min(slipped), most.max(slipped));
    }
    most - least
}
