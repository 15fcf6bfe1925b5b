//! Curves of a walk in three dimensions over the cycle of the right foot, next to those of people.

use crate::normative::{self, Band, SAMPLES, Sheet};
use ambulo::gait::Walk;
use ambulo::model::anthropometry::Human;
use ambulo::model::{Model, Side};
use ambulo::optimal::{Sample, Solution, WalkProblem};

/// One curve: how it is read from a walk, and its place in the tables of people.
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

#[derive(Debug, Clone, Copy)]
enum Reading {
    /// Coordinate and its sign [deg].
    Angle(&'static str, f64),
    /// Generalised force of a coordinate and its sign [N.m/kg].
    Moment(&'static str, f64),
    /// Ground force under the right foot along an axis [body weights].
    Force(usize),
}

const fn angle(name: &'static str, table: &'static str, second: &'static str, coordinate: &'static str, sign: f64) -> Quantity {
    Quantity { name, sheet: Sheet::Angles, table, second: Some(second), reading: Reading::Angle(coordinate, sign) }
}

const fn moment(name: &'static str, table: &'static str, second: &'static str, coordinate: &'static str, sign: f64) -> Quantity {
    Quantity { name, sheet: Sheet::Moments, table, second: Some(second), reading: Reading::Moment(coordinate, sign) }
}

const fn force(name: &'static str, table: &'static str, axis: usize) -> Quantity {
    Quantity { name, sheet: Sheet::Forces, table, second: None, reading: Reading::Force(axis) }
}

/// Everything that is compared.
pub(super) const QUANTITIES: [Quantity; 13] = [
    angle("hip flexion", "Hip Flex/Extension", "Hip Flx/Ext", "hip_flexion_r", 1.0),
    angle("knee flexion", "Knee Flex/Extension", "Knee Flx/Ext", "knee_angle_r", -1.0),
    angle("ankle dorsiflexion", "Ankle Dorsi/Plantarflexion", "Ankle Dor/Pla", "ankle_angle_r", 1.0),
    angle("pelvic obliquity", "Pelvic Up/Down Obliquity", "Pelvic Up/Dn", "pelvis_list", -1.0),
    angle("pelvic rotation", "Pelvic Int/External Rotation", "Pelvic Int/Ext", "pelvis_rotation", 1.0),
    angle("hip adduction", "Hip Ad/Abduction", "Hip Add/Abd", "hip_adduction_r", 1.0),
    angle("hip rotation", "Hip Int/External Rotation", "Hip Int/Ext", "hip_rotation_r", 1.0),
    moment("hip extension moment", "Hip Ext/Flexion", "Hip Extensor Moment", "hip_flexion_r", -1.0),
    moment("knee extension moment", "Knee Ext/Flexion", "Knee Extensor Moment", "knee_angle_r", 1.0),
    moment("plantarflexion moment", "Ankle Dorsi/Plantarflexion", "Plantarflexor Moment", "ankle_angle_r", -1.0),
    moment("hip abduction moment", "Hip Ab/Adduction", "Hip Abductor Moment", "hip_adduction_r", -1.0),
    force("vertical force", "Vertical", 1),
    force("fore-aft force", "Anterior/Posterior", 0),
];

impl Quantity {
    /// Least standard deviation of a band, in the unit of the table.
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
            Reading::Angle(name, sign) => {
                // Clinical hip flexion is counted from the pelvis, whose tilt in upright standing is no zero.
                let standing = if name == "hip_flexion_r" { walk.standing_tilt() } else { 0.0 };
                (sign * at.posture[0][id(name)] + standing).to_degrees()
            }
            Reading::Moment(name, sign) => sign * at.forces[id(name)] / model.mass(),
            Reading::Force(axis) => at.ground_force(right)[axis] / (model.mass() * model.gravity().norm()),
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

/// A cycle of the right foot, at the samples of the tables.
#[derive(Debug, Clone)]
pub(super) struct Cycle {
    /// In the order of [`QUANTITIES`].
    pub(super) curves: Vec<Vec<f64>>,
    /// Sideways force on the right foot [body weights], to the left.
    pub(super) sideways: Vec<f64>,
    pub(super) extra: Vec<(&'static str, Vec<f64>)>,
}

impl Cycle {
    pub(super) fn of(human: &Human, walk: &Walk, problem: &WalkProblem, solution: &Solution) -> Result<Cycle, String> {
        let times: Vec<f64> = (0..SAMPLES).map(|k| walk.cycle_s() * k as f64 / (SAMPLES - 1) as f64).collect();
        let samples = solution.samples(&times).map_err(|e| e.to_string())?;
        let soles = &problem.problem.soles;
        let of = |side: Side| (0..soles.len()).filter(|&k| soles[k].side == side).collect::<Vec<usize>>();
        let right = of(Side::Right);
        let model = &human.model;
        let curve = |quantity: Quantity| samples.iter().map(|at| quantity.value(model, walk, &right, at)).collect();
        let weight = model.mass() * model.gravity().norm();
        Ok(Cycle {
            curves: QUANTITIES.into_iter().map(curve).collect(),
            sideways: samples.iter().map(|at| -at.ground_force(&right).z / weight).collect(),
            extra: extras(human, &right, &samples, soles),
        })
    }
}

fn extras(human: &Human, right: &[usize], samples: &[Sample], soles: &[ambulo::model::anthropometry::ContactSphere]) -> Vec<(&'static str, Vec<f64>)> {
    use ambulo::kinematics::{body_motion, Posture};
    let model = &human.model;
    let body = |name: &str| model.bodies().iter().position(|b| b.name == name).unwrap_or(0);
    let mut out: Vec<(&'static str, Vec<f64>)> = ["com z cm", "cop z cm", "cop x cm", "ankle z cm", "pelvis z cm", "foot prog", "trunk list", "lumbar bend", "subtalar deg", "subtalar Nm/kg", "hip rot Nm/kg", "medial share", "list resid"].map(|n| (n, Vec::new())).into();
    for at in samples {
        let motion = body_motion(model, Posture { q: &at.posture[0], qd: &at.posture[1], qdd: &at.posture[2] });
        let com = motion.iter().zip(model.bodies()).fold(ambulo::spatial::Vec3::zeros(), |s, (p, b)| s + p.center * b.inertia.mass()) * (1.0 / model.mass());
        let poses: Vec<_> = motion.iter().map(|m| m.pose).collect();
        let mut cop = ambulo::spatial::Vec3::zeros();
        let (mut load, mut medial) = (1e-9, 0.0);
        for &k in right {
            let p = &poses[soles[k].body.index()];
            let c = p.rotation * soles[k].center + p.translation;
            cop = cop + c * at.contacts[k].force.y; load += at.contacts[k].force.y;
            if soles[k].name.contains("medial") { medial += at.contacts[k].force.y; }
        }
        let foot = &poses[soles[right[0]].body.index()];
        let f = foot.rotation * ambulo::spatial::Vec3::new(1.0, 0.0, 0.0);
        let trunk = &poses[body("torso")];
        let t = trunk.rotation * ambulo::spatial::Vec3::new(0.0, 0.0, 1.0);
        let id = |n: &str| model.coordinate(n).map_or(0, |i| i.index());
        let q = |n: &str| at.posture[0][id(n)];
        let vals = [100.0 * com.z, if load > 20.0 { 100.0 * cop.z / load } else { f64::NAN }, if load > 20.0 { 100.0 * (cop.x / load - com.x) } else { f64::NAN }, 100.0 * foot.translation.z, 100.0 * q("pelvis_tz"), f.z.atan2(f.x).to_degrees(), t.y.asin().to_degrees(), q("lumbar_bending").to_degrees(), q("subtalar_angle_r").to_degrees(), at.forces[id("subtalar_angle_r")] / model.mass(), at.forces[id("hip_rotation_r")] / model.mass(), medial / load, at.forces[id("pelvis_list")]];
        for (o, v) in out.iter_mut().zip(vals) { o.1.push(v); }
    }
    out
}
