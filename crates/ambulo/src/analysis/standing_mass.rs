//! Body mass from plates under a person who stands still: m = median of the total vertical force / g.

use super::recording::{Analysis, Mass, MassSource, WHOLE_BODY_SHARE};
use crate::motion::force_plate::PlateRecording;
use crate::motion::interpolate;

/// Standard gravity [m/s²]: CGPM 1901.
const STANDARD_GRAVITY: f64 = 9.806_65;
/// Less than this is no person [N].
const LEAST_WEIGHT_N: f64 = 20.0;
/// Nine tenths of the samples lie within this share of the median while a person stands still.
const SWAY: f64 = 0.05;

/// The mass that stands on the plates [kg]; `None` if nobody stands still on them all the time.
#[must_use]
pub fn standing_mass(plates: &[PlateRecording]) -> Option<f64> {
    let first = plates.iter().max_by_key(|plate| plate.times.len())?;
    let mut total = vec![0.0; first.times.len()];
    for plate in plates {
        let vertical: Vec<f64> = (0..plate.times.len()).map(|i| plate.vertical(i)).collect();
        for (sum, &t) in total.iter_mut().zip(&first.times) {
            *sum += interpolate(&plate.times, &vertical, t);
        }
    }
    total.sort_by(f64::total_cmp);
    let at = |share: f64| total.get((share * total.len() as f64) as usize).copied();
    let (low, median, high) = (at(0.05)?, at(0.5)?, at(0.95)?);
    let steady = high - median <= SWAY * median && median - low <= SWAY * median;
    (steady && median > LEAST_WEIGHT_N).then_some(median / STANDARD_GRAVITY)
}

impl Analysis {
    /// Takes what plates carried in a standing trial [kg] for the body's mass, where no whole gait cycle says it better. A mass more
    /// than 5 % beside the model's is not the whole body's, or not this person's.
    pub fn weigh_standing(&mut self, standing_kg: f64) {
        if self.mass.source == MassSource::Model && (standing_kg / self.mass.kg - 1.0).abs() <= WHOLE_BODY_SHARE {
            self.mass = Mass { kg: standing_kg, source: MassSource::Standing };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spatial::Vec3;

    fn plate(vertical: impl Fn(usize) -> f64) -> PlateRecording {
        let samples = 200;
        PlateRecording {
            name: "plate 1".into(),
            kind: 2,
            times: (0..samples).map(|i| i as f64 * 0.01).collect(),
            force: (0..samples).map(|i| Vec3::new(1.0, vertical(i), -2.0)).collect(),
            moment: vec![Vec3::zeros(); samples],
            corners: [Vec3::zeros(), Vec3::x(), Vec3::x() + Vec3::z(), Vec3::z()],
            up: Vec3::y(),
            baseline_n: None,
            clipped: Vec::new(),
        }
    }

    #[test]
    fn feet_on_two_plates_are_one_mass() {
        let sway = |i: usize| 10.0 * (i as f64 * 0.1).sin();
        let plates = [plate(|i| 300.0 + sway(i)), plate(|i| 400.0 - sway(i))];
        let mass = standing_mass(&plates).unwrap_or(f64::NAN);
        assert!((mass - 700.0 / STANDARD_GRAVITY).abs() < 1e-9, "{mass} kg");
    }

    #[test]
    fn who_walks_or_is_not_there_has_no_mass() {
        assert_eq!(standing_mass(&[plate(|i| if i < 100 { 0.0 } else { 700.0 })]), None);
        assert_eq!(standing_mass(&[plate(|_| 3.0)]), None);
        assert_eq!(standing_mass(&[]), None);
    }
}
