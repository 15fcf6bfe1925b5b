//! Compares the change of peaks with speed to that of the normative curves.

use super::Results;
use super::curve::Peaks;
use ambulo::numerics::correlation;

/// Smallest correlation over the five speeds for which peaks follow the normative ones.
pub(super) const LEAST_R: f64 = 0.90;

/// One peak at five speeds.
#[derive(Debug, Clone)]
pub(super) struct Trend {
    pub(super) what: &'static str,
    pub(super) ours: [f64; 5],
    pub(super) people: [f64; 5],
}

impl Trend {
    /// Correlation of ours with theirs over the speeds.
    pub(super) fn r(&self) -> f64 {
        correlation(&self.ours, &self.people)
    }

    /// Whether ours follow the normative ones: r, and the same sign of the change from very slow to very fast.
    pub(super) fn follows(&self) -> bool {
        let change = |peaks: &[f64; 5]| peaks[4] - peaks[0];
        self.r() >= LEAST_R && change(&self.ours) * change(&self.people) > 0.0
    }
}

type Part = fn(&Peaks) -> f64;

const PARTS: [(&str, Part); 9] = [
    ("hip extension moment [N.m/kg]", |peaks| peaks.hip[0]),
    ("hip flexion moment [N.m/kg]", |peaks| peaks.hip[1]),
    ("knee extension moment [N.m/kg]", |peaks| peaks.knee),
    ("ankle plantarflexion moment [N.m/kg]", |peaks| peaks.ankle),
    ("vertical force, first peak [BW]", |peaks| peaks.vertical[0]),
    ("vertical force, least between [BW]", |peaks| peaks.vertical[1]),
    ("vertical force, second peak [BW]", |peaks| peaks.vertical[2]),
    ("braking [BW]", |peaks| peaks.fore_aft[0]),
    ("propulsion [BW]", |peaks| peaks.fore_aft[1]),
];

/// All peaks.
pub(super) fn trends(results: &Results) -> Vec<Trend> {
    let people: Vec<Peaks> = results
        .people
        .iter()
        .zip(results.foot_off)
        .map(|(bands, foot_off)| Peaks::of(bands.each_ref().map(|band| band.mean.as_slice()), foot_off))
        .collect();
    let trend = |(what, part): (&'static str, Part)| Trend {
        what,
        ours: results.man.each_ref().map(|cycle| part(&cycle.peaks)),
        people: std::array::from_fn(|speed| part(&people[speed])),
    };
    PARTS.map(trend).into()
}
