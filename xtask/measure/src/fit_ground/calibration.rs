//! Factors and floors of the standard deviations, so that a 90 % band contains 90 % of the measured samples.
//!
//! Samples of a stance are not independent, and people of a laboratory resemble each other: shares are means over
//! stances, then over subjects, then over laboratories. For each floor the factor follows from the share; of these
//! pairs the one with the narrowest band is used. This is split conformal calibration with laboratories left out: every
//! error is one of a prediction whose parameters do not know the laboratory.

use super::cases::{Case, OF_CENTER_MISFIT, OF_MISFIT, OF_SIDEWAYS, Sample, StanceSamples, WIDENING, mean};
use super::numbers::three_digits;
use ambulo::ground::predict::{DeviationCalibration, DeviationScaling, FittedParameters, scaling_at};
use std::ops::Range;

/// Standard deviations on either side that contain 90 % of a normal distribution.
const BAND_90: f64 = 1.645;
/// Share of samples that the band should contain.
const HELD: f64 = 0.9;
/// Floors that are tried, as shares of the RMSE.
const FLOORS: [f64; 8] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9];
/// Smallest and largest factor on the estimator's standard deviation: a band must still be wider where the motion is
/// less informative.
const FACTORS: [f64; 2] = [0.3, 30.0];

/// Coverage and width of a band for a subject, or for several.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Band {
    /// Share of the samples inside it.
    pub(super) holds: f64,
    /// Mean half-width over the RMSE.
    pub(super) half_width_over_rmse: f64,
}

/// Bands of whole stances, then of fifths; one entry per component, `None` where the subject is not judged on it.
pub(super) type Bands = [[Option<Band>; 6]; 6];

/// Stances of subjects.
pub(super) struct Judged {
    /// One entry a subject.
    subjects: Vec<JudgedSubject>,
}

/// Stances of a subject.
struct JudgedSubject {
    subject: &'static str,
    laboratory: &'static str,
    stances: Vec<StanceSamples>,
}

/// Stances of a component with the weight of their subject.
type Weighted = (f64, Vec<Vec<Sample>>);

/// Factors and floors of a component in each fifth of a stance.
pub(super) type Fifths = [DeviationScaling; 5];

impl Judged {
    /// The straight walks of all subjects, each predicted with the parameters that `of` gives for its laboratory and
    /// the deviations of the equations unchanged.
    pub(super) fn new<'a>(
        cases: impl Iterator<Item = &'a Case>,
        of: &dyn Fn(&str) -> Option<&'a FittedParameters>,
    ) -> Judged {
        let mut subjects: Vec<JudgedSubject> = Vec::new();
        for case in cases.filter(|case| case.is_straight()) {
            let Some(parameters) = of(case.laboratory) else { continue };
            let samples = case.samples(parameters);
            match subjects.iter_mut().find(|known| known.subject == case.subject) {
                Some(known) => known.stances.extend(samples),
                None => {
                    let (subject, laboratory) = (case.subject, case.laboratory);
                    subjects.push(JudgedSubject { subject, laboratory, stances: samples });
                }
            }
        }
        Judged { subjects }
    }

    /// Subjects and their laboratories.
    pub(super) fn people(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        self.subjects.iter().map(|one| (one.subject, one.laboratory))
    }

    /// Stances of a component, subject by subject, within some fifths; subjects that are not judged on it are left out.
    fn of_component(
        &self,
        component: usize,
        fifths: Range<usize>,
        only: impl Fn(&JudgedSubject) -> bool,
    ) -> Vec<Weighted> {
        let within = |s: &&Sample| fifths.contains(&((5.0 * s.phase) as usize).min(4));
        let lists = self.subjects.iter().filter(|one| only(one)).map(|one| {
            let own = one.stances.iter().map(|stance| stance[component].iter().filter(within).copied().collect());
            (one.laboratory, own.filter(|samples: &Vec<Sample>| !samples.is_empty()).collect::<Vec<_>>())
        });
        let lists: Vec<(&str, Vec<Vec<Sample>>)> = lists.filter(|(_, stances)| !stances.is_empty()).collect();
        let laboratories: Vec<&str> = lists.iter().map(|(laboratory, _)| *laboratory).collect();
        let weight = |own: &str| 1.0 / laboratories.iter().filter(|other| **other == own).count() as f64;
        lists.into_iter().map(|(laboratory, stances)| (weight(laboratory), stances)).collect()
    }

    /// Factors and floors without a laboratory, if one is named.
    pub(super) fn calibration(&self, left_out: Option<&str>) -> DeviationCalibration {
        let only = |one: &JudgedSubject| Some(one.laboratory) != left_out;
        let whole = |component: usize| fitted(&self.of_component(component, 0..5, only));
        let of_fifth =
            |component: usize| std::array::from_fn(|k| fitted(&self.of_component(component, k..k + 1, only)));
        DeviationCalibration {
            force: std::array::from_fn(of_fifth),
            center: std::array::from_fn(|i| whole(3 + i)),
            free_moment: whole(5),
            of_misfit: OF_MISFIT,
            of_center_misfit: OF_CENTER_MISFIT,
            of_sideways: OF_SIDEWAYS,
            ..WIDENING
        }
    }

    /// Bands on a subject of whole stances and of each fifth.
    pub(super) fn bands(&self, subject: &str, calibration: &DeviationCalibration) -> Bands {
        let fifths = |k: usize| if k == 0 { 0..5 } else { k - 1..k };
        std::array::from_fn(|k| std::array::from_fn(|c| self.band(c, fifths(k), subject, calibration)))
    }

    /// How a band does on a subject within some fifths; `None` where the subject is not judged on that component.
    fn band(
        &self,
        component: usize,
        fifths: Range<usize>,
        subject: &str,
        calibration: &DeviationCalibration,
    ) -> Option<Band> {
        let stances = self.of_component(component, fifths, |one| one.subject == subject);
        (!stances.is_empty()).then(|| band(&stances, &spread(calibration, component)))
    }
}

/// The spread of one of [`super::cases::COMPONENTS`].
pub(super) fn spread(calibration: &DeviationCalibration, component: usize) -> Fifths {
    match component {
        0..3 => calibration.force[component],
        3 | 4 => [calibration.center[component - 3]; 5],
        _ => [calibration.free_moment; 5],
    }
}

/// Where nothing was predicted there is no band.
fn half_width(sample: &Sample, spread: &Fifths) -> f64 {
    let scaling = scaling_at(spread, sample.phase);
    let variance = scaling.variance(sample.deviation.powi(2), sample.unit) + sample.of_trial.powi(2);
    if sample.deviation > 0.0 { BAND_90 * sample.wider * variance.sqrt() } else { 0.0 }
}

fn band(subjects: &[Weighted], spread: &Fifths) -> Band {
    let holds =
        |stance: &Vec<Sample>| mean(stance.iter().map(|s| f64::from(u8::from(s.error.abs() <= half_width(s, spread)))));
    let width = |stances: &Vec<Vec<Sample>>| {
        let all = || stances.iter().flatten();
        mean(all().map(|s| half_width(s, spread))) / mean(all().map(|s| s.error.powi(2))).sqrt()
    };
    Band {
        holds: weighted(subjects, &|stances| mean(stances.iter().map(holds))),
        half_width_over_rmse: weighted(subjects, &width),
    }
}

/// Mean over the subjects with their weights.
fn weighted(subjects: &[Weighted], of: &dyn Fn(&Vec<Vec<Sample>>) -> f64) -> f64 {
    let all: f64 = subjects.iter().map(|(weight, _)| weight).sum();
    subjects.iter().map(|(weight, stances)| weight * of(stances)).sum::<f64>() / all
}

/// The sharpest pair of factor and floor that holds enough.
fn fitted(subjects: &[Weighted]) -> DeviationScaling {
    let rmse = weighted(subjects, &|stances| mean(stances.iter().flatten().map(|s| (s.error / s.unit).powi(2))).sqrt());
    let pairs = FLOORS.map(|share| {
        let spread = DeviationScaling { factor: factor(subjects, share * rmse), floor: share * rmse };
        DeviationScaling { factor: three_digits(spread.factor), floor: three_digits(spread.floor) }
    });
    let rated = pairs.map(|spread| (spread, band(subjects, &[spread; 5])));
    let enough = |band: &Band| band.holds >= HELD - 0.01;
    let sharpest = rated
        .iter()
        .filter(|(_, band)| enough(band))
        .min_by(|a, b| a.1.half_width_over_rmse.total_cmp(&b.1.half_width_over_rmse));
    let widest = || rated.iter().max_by(|a, b| a.1.holds.total_cmp(&b.1.holds));
    sharpest.or_else(widest).map_or(DeviationScaling::UNSCALED, |(spread, _)| *spread)
}

/// The factor that gives the required share with a floor, by bisection on a logarithmic scale: the share grows with the
/// factor.
fn factor(subjects: &[Weighted], floor: f64) -> f64 {
    let [mut low, mut high] = FACTORS;
    for _ in 0..30 {
        let factor = (low * high).sqrt();
        if band(subjects, &[DeviationScaling { factor, floor }; 5]).holds < HELD { low = factor } else { high = factor }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;
    use ambulo::numerics::Random;

    /// Stances whose errors are normal with `true_factor` times what the equations say, and a floor.
    fn stances(seed: u64, true_factor: f64, floor: f64) -> Vec<Vec<Sample>> {
        let mut random = Random::seeded(seed);
        let mut sample = |i: usize| {
            let deviation = 1.0 + (i % 7) as f64;
            let truth = (true_factor * deviation).hypot(floor);
            Sample {
                phase: (i % 100) as f64 / 100.0,
                error: truth * random.normal(),
                deviation,
                unit: 1.0,
                of_trial: 0.0,
                wider: 1.0,
            }
        };
        (0..20).map(|_| (0..100).map(&mut sample).collect()).collect()
    }

    #[test]
    fn a_band_of_normal_errors_holds_nine_in_ten_and_so_it_does_on_others() {
        for (factor, floor) in [(1.0, 0.0), (2.5, 0.0), (0.5, 3.0)] {
            let (own, others) = (stances(1, factor, floor), stances(2, factor, floor));
            let found = fitted(&[(1.0, own)]);
            let band = band(&[(1.0, others)], &[found; 5]);
            assert!((band.holds - 0.9).abs() < 0.03, "{factor}, {floor}: {found:?} gives {band:?}");
            assert!(band.half_width_over_rmse < 1.7, "{band:?}");
        }
    }

    #[test]
    fn a_factor_is_found_again() {
        let own = stances(3, 2.0, 0.0);
        let found = factor(&[(1.0, own)], 0.0);
        assert!((found - 2.0).abs() < 0.1, "{found}");
    }

    #[test]
    fn a_laboratory_of_many_counts_like_a_laboratory_of_one() {
        let of = |laboratory, factor: f64, seed| {
            let stances =
                stances(seed, factor, 0.0).into_iter().map(|samples| std::array::from_fn(|_| samples.clone()));
            JudgedSubject { subject: laboratory, laboratory, stances: stances.collect() }
        };
        let alone = Judged { subjects: vec![of("a", 1.0, 4), of("b", 3.0, 5)] };
        let many = Judged { subjects: vec![of("a", 1.0, 4), of("a", 1.0, 4), of("a", 1.0, 4), of("b", 3.0, 5)] };
        let [alone, many] = [alone, many].map(|judged| judged.calibration(None).force[0][2]);
        assert_eq!(alone, many);
    }

    #[test]
    fn where_nothing_was_predicted_nothing_is_held() {
        let sample = Sample { phase: 0.5, error: 0.1, deviation: 0.0, unit: 1.0, of_trial: 1.0, wider: 1.0 };
        assert!(half_width(&sample, &[DeviationScaling { factor: 5.0, floor: 9.0 }; 5]).abs() < 1e-12);
    }
}
