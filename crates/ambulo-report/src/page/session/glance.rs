//! The first screen: recording, source of the forces, speed, steps, asymmetry, and the largest differences from normal.

use super::curves::{shown_cycles, statistics};
use super::header::{devices, fact, forces, recording, speed_in_words};
use super::results::Results;
use super::size::BodySize;
use super::time_distance;
use crate::clinical::ClinicalQuantity;
use crate::normative::{BAND_SAMPLES, NormativeBand, band};
use crate::page::contract::{Fact, Glance, PageSource};
use ambulo::analysis::{CYCLE_SAMPLES, StrideQuantity, symmetry_index};
use ambulo::model::Side;
use ambulo::numerics::Order;

/// Number of listed differences from normal.
const DEVIATIONS: usize = 3;

/// The most important results of a recording or walk, shown first.
pub(super) fn glance(results: &Results, size: &BodySize, quantities: &[ClinicalQuantity]) -> Glance {
    let summary = &results.summary;
    let stated = |label, value: &Option<String>| value.as_ref().map(|value| fact(label, value.as_str(), None));
    let facts = [
        Some(recording(results)),
        stated("Person", &summary.input.person),
        stated("Recorded on", &summary.input.recorded_on),
        Some(Fact { note: uncertainty(results), ..forces(results) }),
        summary.activity.map(|activity| fact("Activity", activity.words(), None)),
        summary.speed_m_s.map(|speed| fact("Speed", speed_in_words(results, speed), None)),
        mean(results, StrideQuantity::Cadence).map(|mean| fact("Cadence", format!("{mean:.0} steps/min"), None)),
        mean(results, StrideQuantity::StepLength).map(|mean| fact("Step length", format!("{mean:.2} m"), None)),
        asymmetry(results),
        devices(results),
    ];
    let mut deviations: Vec<Deviation> =
        quantities.iter().filter_map(|quantity| Deviation::of(results, size, quantity)).collect();
    deviations.sort_by_number(|deviation| -deviation.in_sd);
    Glance {
        facts: facts.into_iter().flatten().collect(),
        norm: norm(size, &deviations),
        deviations: deviations.iter().take(DEVIATIONS).map(Deviation::sentence).collect(),
    }
}

fn mean(results: &Results, quantity: StrideQuantity) -> Option<f64> {
    Some(results.summary.times_and_distances.quantity(quantity)?.both?.mean)
}

/// Uncertainty of the ground forces: the standard deviation of predicted ones, the residual of measured ones.
fn uncertainty(results: &Results) -> Option<String> {
    if results.source != PageSource::Predicted {
        let residual = results.summary.residual.as_ref();
        let residual = residual
            .map(|residual| format!("residual force, RMS, {:.1} % of body weight", 100.0 * residual.force_rms_bw));
        let parts: Vec<String> = residual.into_iter().chain(results.summary.ground.shares()).collect();
        return Some(parts.join("; ")).filter(|parts| !parts.is_empty());
    }
    let table = results.deviations.as_ref()?;
    let vertical = table.names().iter().filter(|name| name.ends_with("vy_sd"));
    let loaded = vertical.filter_map(|name| table.column(name)).flatten().filter(|sd| **sd > 0.0);
    let (count, sum) = loaded.fold((0, 0.0), |(count, sum), sd| (count + 1, sum + sd));
    let percent = 100.0 * sum / f64::from(count) / results.weight_n;
    (count > 0).then(|| format!("vertical force of a foot: SD {percent:.0} % of body weight"))
}

/// The time or distance whose sides differ most.
fn asymmetry(results: &Results) -> Option<Fact> {
    let compared = time_distance::sides(&results.summary.times_and_distances).into_iter();
    let differences = compared.filter_map(|(label, _, _, [right, left])| Some((label, symmetry_index(right?, left?)?)));
    let (label, index) = differences.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    let larger = if index > 0.0 { Side::Right } else { Side::Left };
    Some(fact("Largest asymmetry", format!("{:.0} %", 100.0 * index.abs()), Some(format!("{label}, larger {larger}"))))
}

/// Distance of the mean curve of a side from normal.
pub struct Deviation<'a> {
    quantity: &'a ClinicalQuantity,
    /// Side of the curve.
    pub side: Side,
    /// Root mean square of the difference over the cycle, per root mean square of the standard deviation of healthy
    /// subjects. The ratio is not formed point by point: the standard deviation of a ground force is near zero in
    /// swing.
    pub in_sd: f64,
    /// Place of the largest distance [% of the cycle].
    pub at_percent: usize,
    /// The value there.
    pub value: f64,
    /// The normal mean there.
    pub normal: f64,
    /// Source of the normative data.
    citation: String,
}

impl Deviation<'_> {
    /// The side of a quantity that is farther from normal; `None` without cycles or normative data.
    fn of<'a>(results: &Results, size: &BodySize, quantity: &'a ClinicalQuantity) -> Option<Deviation<'a>> {
        let normal = band(quantity.id, size.walking_speed()?, results.convention())?;
        let of_side = |side| {
            let mean = statistics(&shown_cycles(results, quantity, side))?.mean;
            Deviation::between(quantity, side, &mean, &normal)
        };
        Side::BOTH.into_iter().filter_map(of_side).max_by(|a, b| a.in_sd.total_cmp(&b.in_sd))
    }

    /// Computes the deviation of the mean curve of the side; `None` if it is too short.
    pub fn between<'a>(
        quantity: &'a ClinicalQuantity,
        side: Side,
        mean: &[f64],
        normal: &NormativeBand,
    ) -> Option<Deviation<'a>> {
        const EVERY: usize = (CYCLE_SAMPLES - 1) / (BAND_SAMPLES - 1);
        let differences: Vec<f64> =
            (0..BAND_SAMPLES).map(|k| Some(mean.get(k * EVERY)? - normal.mean[k])).collect::<Option<_>>()?;
        let sum_of_squares = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
        let in_sd = (sum_of_squares(&differences) / sum_of_squares(&normal.sd)).sqrt();
        let at = (0..BAND_SAMPLES).max_by(|&a, &b| differences[a].abs().total_cmp(&differences[b].abs()))?;
        in_sd.is_finite().then(|| Deviation {
            quantity,
            side,
            in_sd,
            at_percent: 100 * at / (BAND_SAMPLES - 1),
            value: mean[at * EVERY],
            normal: normal.mean[at],
            citation: normal.citation.clone(),
        })
    }

    /// Quantity, side, size and place of the difference.
    #[must_use]
    pub fn sentence(&self) -> String {
        let Deviation { quantity, side, in_sd, at_percent, value, normal, .. } = self;
        let (title, unit) = (quantity.title, quantity.unit);
        let digits = if unit == "deg" { 0 } else { 2 };
        format!(
            "{title}, {side}: {in_sd:.1} SD from normal; most at {at_percent} % of the cycle, {value:.digits$} instead \
             of {normal:.digits$} {unit}"
        )
    }
}

/// The normative group of the comparison, or why there is none.
fn norm(size: &BodySize, deviations: &[Deviation<'_>]) -> String {
    match (size.why_no_norm(), deviations.first()) {
        (Some(why), _) => format!("No comparison with normal curves: {why}."),
        (None, None) => "No comparison with normal curves: there is no whole gait cycle.".to_owned(),
        (None, Some(largest)) => {
            format!(
                "SD: root mean square of the difference over the cycle, in standard deviations of healthy people. {}",
                largest.citation
            )
        }
    }
}
