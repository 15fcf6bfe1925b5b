//! Requirements for the simulator, and the results of this run.

use super::markdown::{small, time};
use super::stance::Standing;
use super::{Results, ladder, scaling};
use crate::simulators::{Measurement, Peer, PeerTiming, Scene};

/// Largest exponent of time over number of bodies, from 100 to 10,000 bodies.
const SLOPE: f64 = 1.05;
/// Bodies of a chain and its time [us].
const CHAINS: [(usize, f64); 2] = [(1000, 1500.0), (10_000, 15_000.0)];
/// Closed loops and the time of their ladder [us].
const LADDERS: [(usize, f64); 2] = [(100, 1000.0), (1000, 10_000.0)];
/// Largest errors of joints [m] and of loops [m].
const JOINT_M: f64 = 1e-9;
const LOOP_M: f64 = 1e-5;
/// Largest change of energy in 10 s, as a share of the largest kinetic energy.
const ENERGY: f64 = 1e-3;
/// Largest violation of the contact laws, as a share.
const LEFT: f64 = 1e-8;
/// Required ratio of MuJoCo's error on the human to ours.
const SMALLER: f64 = 10.0;
/// Largest growth of time from 100 to 1,000 loops: quadratic.
const TENFOLD: f64 = 100.0;
/// Below this height of the pelvis the human sank or fell [m].
const STANDS_M: f64 = 0.9;

/// One line of the table.
pub(super) struct Requirement {
    pub(super) what: String,
    pub(super) required: String,
    pub(super) measured: String,
    pub(super) met: bool,
    /// A time above its limit is not an error.
    pub(super) is_time: bool,
}

impl Requirement {
    /// Whether a result is less accurate than required.
    pub(super) fn wrong(&self) -> bool {
        !self.met && !self.is_time
    }

    fn time(what: String, us: f64, most_us: f64) -> Requirement {
        let required = format!("<= {}", time(most_us));
        Requirement { what, required, measured: time(us), met: us <= most_us, is_time: true }
    }

    fn growth(what: String, value: f64, most: f64) -> Requirement {
        Requirement {
            what,
            required: format!("<= {most}"),
            measured: format!("{value:.3}"),
            met: value <= most,
            is_time: true,
        }
    }

    fn error(what: &str, unit: &str, value: f64, most: f64) -> Requirement {
        let required = format!("<= {}{unit}", small(most));
        Requirement {
            what: what.to_owned(),
            required,
            measured: format!("{}{unit}", small(value)),
            met: value <= most,
            is_time: false,
        }
    }
}

/// All requirements that this run can check.
pub(super) fn all(results: &Results) -> Vec<Requirement> {
    let mut required = of_scaling(&results.scaling);
    if let Some(ladders) = results.ladders.first() {
        required.extend(of_ladders(ladders));
    }
    if let Some(standing) = &results.stance {
        required.extend(of_human(standing));
        required.extend(fastest_mujoco(&results.peers).iter().flat_map(|mujoco| against(standing, mujoco)));
    }
    let accuracy = &results.accuracy;
    let [flailing, _] = accuracy.joint_error_m;
    required.push(Requirement::error(
        "undamped chain of 20, 10 s: energy, of that turned over",
        "",
        accuracy.smooth.share(),
        ENERGY,
    ));
    required.push(Requirement::error(
        "the same with contacts possible (midpoint rule)",
        "",
        accuracy.midpoint.share(),
        ENERGY,
    ));
    required.push(Requirement::error("flailing chain of 20, 60 s: joint error", " m", flailing, JOINT_M));
    required
}

fn of_scaling(scaling: &scaling::Scaling) -> Vec<Requirement> {
    let mut required = Vec::new();
    for family in &scaling.families {
        let projection = if family.projection { "with" } else { "without" };
        let what = format!("{}, {projection} projection: slope from 100 to 10,000 bodies", family.name);
        required.push(Requirement::growth(what, family.slope(), SLOPE));
    }
    let Some(chain) = scaling.family("chain", true) else { return required };
    for (size, most_us) in CHAINS {
        let Some(run) = chain.run(size) else { continue };
        required.push(Requirement::time(format!("chain of {size}: time per step"), run.step_us.median, most_us));
        required.push(Requirement::error(&format!("chain of {size}: joint error"), " m", run.worst_m, JOINT_M));
    }
    required
}

fn of_ladders(ladders: &ladder::OfMethod) -> Vec<Requirement> {
    let mut required = Vec::new();
    for (loops, most_us) in LADDERS {
        let Some(run) = ladders.run(loops) else { continue };
        required.push(Requirement::time(
            format!("ladder of {loops} loops: time per step"),
            run.step_us.median,
            most_us,
        ));
        required.push(Requirement::error(&format!("ladder of {loops} loops: loop error"), " m", run.worst_m, LOOP_M));
    }
    if let Some(times) = ladders.last_tenfold() {
        let what = "ladder of 1,000 rungs: time with 1,000 loops over that with 100".to_owned();
        required.push(Requirement::growth(what, times, TENFOLD));
    }
    required
}

fn of_human(standing: &Standing) -> Vec<Requirement> {
    let (stance, left) = (&standing.stance, &standing.stance.left);
    let error = |what: &str, value: f64| Requirement::error(&format!("human: {what}"), "", value, LEFT);
    let stands = Requirement {
        what: "human: stands, pelvis".to_owned(),
        required: format!(">= {STANDS_M} m"),
        measured: format!("{:.3} m", stance.pelvis_height_m),
        met: stance.pelvis_height_m >= STANDS_M,
        is_time: false,
    };
    vec![
        stands,
        error("complementarity", left.complementarity),
        error("friction within its cone", left.cone),
        error("no slip", left.slip),
        error("sum of contact forces - m (a - g), by weight", left.balance),
        error("all of these, pushed over its feet", standing.pushed.left.worst()),
    ]
}

/// MuJoCo in the setting that takes the least time.
fn fastest_mujoco(peers: &[PeerTiming]) -> Option<&PeerTiming> {
    let ran = peers.iter().filter(|p| p.peer == Peer::MuJoCo && p.scene == Scene::Human);
    let us = |p: &PeerTiming| p.measurement().map_or(f64::INFINITY, |m| m.median_us);
    ran.filter(|p| p.measurement().is_some()).min_by(|a, b| us(a).total_cmp(&us(b)))
}

fn against(standing: &Standing, mujoco: &PeerTiming) -> Vec<Requirement> {
    let Some(Measurement { median_us, stance: Some(theirs), .. }) = mujoco.measurement() else { return Vec::new() };
    let name = mujoco.name();
    let mut required =
        vec![Requirement::time(format!("human: time per step against {name}"), standing.step_us.median, *median_us)];
    let ours = &standing.stance;
    for (what, unit, ours, theirs) in [
        ("penetration", " m", ours.penetration_m, theirs.penetration_m),
        ("creep of sticking contacts", " m", ours.creep_m, theirs.creep_m),
    ] {
        let what = format!("human: {what}, a tenth of that of {name}");
        required.extend(theirs.map(|theirs| Requirement::error(&what, unit, ours, theirs / SMALLER)));
    }
    required
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missed_time_is_no_error_and_an_answer_that_is_no_number_is() {
        assert!(!Requirement::time(String::new(), 2.0, 1.0).met);
        assert!(!Requirement::time(String::new(), 2.0, 1.0).wrong());
        assert!(Requirement::error("", "", f64::NAN, 1.0).wrong());
        assert!(!Requirement::error("", "", 1.0, 1.0).wrong());
    }
}
