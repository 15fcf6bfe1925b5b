//! Nine curves of a walk over the cycle of one foot, and what is read from them.

use crate::normative::{self, Band, Sheet};

/// One of the curves that walks are judged by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Angle(usize),
    Moment(usize),
    Force(usize),
}

/// All curves of the tables, in the order of the pages.
pub(super) const QUANTITIES: [Quantity; 8] = [
    Quantity::Angle(0),
    Quantity::Angle(1),
    Quantity::Angle(2),
    Quantity::Moment(0),
    Quantity::Moment(1),
    Quantity::Moment(2),
    Quantity::Force(0),
    Quantity::Force(1),
];

impl Quantity {
    pub(super) fn index(self) -> usize {
        match self {
            Quantity::Angle(i) => i,
            Quantity::Moment(i) => 3 + i,
            Quantity::Force(i) => 6 + i,
        }
    }

    /// Name on the page, with its unit and positive direction.
    pub(super) fn name(self) -> &'static str {
        const NAMES: [&str; 8] = [
            "hip angle",
            "knee angle",
            "ankle angle",
            "hip moment",
            "knee moment",
            "ankle moment",
            "vertical force",
            "fore-aft force",
        ];
        NAMES[self.index()]
    }

    /// Label of its axis.
    pub(super) fn axis(self) -> &'static str {
        const AXES: [&str; 8] = [
            "deg, flexion +",
            "deg, flexion +",
            "deg, dorsiflexion +",
            "N.m/kg, extensor +",
            "N.m/kg, extensor +",
            "N.m/kg, plantarflexor +",
            "body weights, up +",
            "body weights, forward +",
        ];
        AXES[self.index()]
    }

    fn source(self) -> (Sheet, &'static str) {
        const NAMES: [&str; 8] = [
            "Hip Flex/Extension",
            "Knee Flex/Extension",
            "Ankle Dorsi/Plantarflexion",
            "Hip Ext/Flexion",
            "Knee Ext/Flexion",
            "Ankle Dorsi/Plantarflexion",
            "Vertical",
            "Anterior/Posterior",
        ];
        let sheet = match self {
            Quantity::Angle(_) => Sheet::Angles,
            Quantity::Moment(_) => Sheet::Moments,
            Quantity::Force(_) => Sheet::Forces,
        };
        (sheet, NAMES[self.index()])
    }

    /// Least standard deviation, in the unit of the table.
    fn least_sd(self) -> f64 {
        match self {
            Quantity::Angle(_) => 2.0,
            Quantity::Moment(_) => 0.05,
            Quantity::Force(_) => 0.02,
        }
    }

    /// Least correlation at free speed.
    pub(super) fn least_r(self) -> f64 {
        if matches!(self, Quantity::Moment(0 | 1)) { 0.90 } else { 0.95 }
    }
}

/// The bands at five speeds for a leg of `leg_length`, children's moments times `leg_length` / theirs: equal moment /
/// (m g L).
pub(super) fn people(leg_length: f64, their_leg: f64) -> Result<[[Band; 8]; 5], String> {
    let mut people: [[Band; 8]; 5] = Default::default();
    for quantity in QUANTITIES {
        let (sheet, name) = quantity.source();
        let scale = if sheet == Sheet::Moments { leg_length / their_leg } else { 1.0 };
        for (speed, mut band) in normative::bands(sheet, name)?.into_iter().enumerate() {
            band.mean.iter_mut().for_each(|mean| *mean *= scale);
            band.sd.iter_mut().for_each(|sd| *sd = sd.max(quantity.least_sd()) * scale);
            people[speed][quantity.index()] = band;
        }
    }
    Ok(people)
}

/// Share of the samples within two standard deviations of the mean.
pub(super) fn inside(curve: &[f64], band: &Band) -> f64 {
    let within = |((value, mean), sd): ((&f64, &f64), &f64)| (value - mean).abs() <= 2.0 * sd;
    let count = curve.iter().zip(&band.mean).zip(&band.sd).filter(|sample| within(*sample)).count();
    count as f64 / band.mean.len() as f64
}

/// Root mean square of the difference.
pub(super) fn rms_difference(a: &[f64], b: &[f64]) -> f64 {
    let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
    f64::sqrt(square / a.len().min(b.len()) as f64)
}

/// Peaks of the curves of a cycle, for ours and normative ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Peaks {
    /// Extension in the first half of the cycle, flexion, larger of both over the whole cycle [N.m/kg].
    pub(super) hip: [f64; 3],
    /// Extension in the first half of stance [N.m/kg].
    pub(super) knee: f64,
    /// Plantarflexion [N.m/kg].
    pub(super) ankle: f64,
    /// First peak, least between the peaks, second peak [body weights].
    pub(super) vertical: [f64; 3],
    /// Largest backwards (a negative number) and largest forwards [body weights].
    pub(super) fore_aft: [f64; 2],
}

impl Peaks {
    /// From curves of any number of samples, 0 % to 100 % of the cycle, and the foot off [share of the cycle].
    pub(super) fn of(curves: [&[f64]; 8], foot_off: f64) -> Peaks {
        let [hip, knee, ankle] = [3, 4, 5].map(|i| curves[i]);
        let half = |curve: &'_ [f64]| ((curve.len() - 1) as f64 * 0.5 * foot_off) as usize;
        let flexion = -least(hip);
        Peaks {
            hip: [largest(&hip[..hip.len() / 2]), flexion, flexion.max(largest(hip))],
            knee: largest(&knee[..half(knee)]),
            ankle: largest(ankle),
            vertical: humps(curves[6], half(curves[6])),
            fore_aft: [least(curves[7]), largest(curves[7])],
        }
    }
}

/// First peak, least value between, second peak of a curve with a hump on either side of a sample.
fn humps(curve: &[f64], middle: usize) -> [f64; 3] {
    let at = |part: &[f64]| part.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(i, _)| i);
    let (first, second) = (at(&curve[..middle]), middle + at(&curve[middle..]));
    [curve[first], least(&curve[first..=second]), curve[second]]
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_humps_have_a_hollow_between_them() {
        let curve = [0.0, 0.5, 1.1, 0.9, 0.8, 0.85, 1.05, 0.4, 0.0];
        for (found, expected) in humps(&curve, 4).into_iter().zip([1.1, 0.8, 1.05]) {
            assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");
        }
    }

    #[test]
    fn a_curve_leaves_its_band_where_it_is_more_than_two_deviations_off() {
        let band = Band { mean: vec![0.0; 4], sd: vec![1.0, 1.0, 0.1, 0.1] };
        assert!((inside(&[1.9, 2.1, 0.1, -0.3], &band) - 0.5).abs() < 1e-12);
    }
}
