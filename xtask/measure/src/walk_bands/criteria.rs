//! Criteria for a synthetic walk at free speed, with their results.

use super::curve::{QUANTITIES, Quantity, inside, rms_difference};
use super::cycle::Cycle;
use crate::normative::Band;
use ambulo::numerics::correlation;

/// Peak-to-peak forward speed of the centre of mass of healthy people over its mean, very slow to very fast.
pub(super) const SPEED_RANGES: [f64; 5] = [0.26, 0.19, 0.16, 0.135, 0.10];
/// Allowed difference from it.
pub(super) const SPEED_RANGE_MISS: f64 = 0.04;
/// Share of the cycle inside the band.
const INSIDE: f64 = 0.95;
/// Slip of a foot in stance [m].
pub(super) const SLIP: f64 = 2e-3;
/// Torque that holds the trunk [N.m]: root mean square, largest.
pub(super) const TRUNK: [f64; 2] = [3.0, 10.0];

/// One criterion: a row of the table.
#[derive(Debug, Clone)]
pub(super) struct Criterion {
    pub(super) what: String,
    pub(super) limit: String,
    pub(super) result: String,
    pub(super) met: bool,
}

/// A range by its ends, or one end.
#[derive(Debug, Clone, Copy)]
enum Limit {
    Within(f64, f64),
    AtLeast(f64),
    Below(f64),
}

impl Limit {
    fn holds(self, value: f64) -> bool {
        match self {
            Limit::Within(least, most) => (least..=most).contains(&value),
            Limit::AtLeast(least) => value >= least,
            Limit::Below(most) => value < most,
        }
    }
}

/// A number with its unit, judged.
fn criterion(what: &str, value: f64, limit: Limit, digits: usize, unit: &str) -> Criterion {
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let limit_text = match limit {
        Limit::Within(least, most) => format!("{least:.digits$} .. {most:.digits$}{unit}"),
        Limit::AtLeast(least) => format!(">= {least:.digits$}{unit}"),
        Limit::Below(most) => format!("< {most:.digits$}{unit}"),
    };
    Criterion {
        what: what.to_owned(),
        limit: limit_text,
        result: format!("{}{unit}", rounded(value, digits)),
        met: limit.holds(value),
    }
}

/// A number without a minus before zero.
fn rounded(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    if text.trim_start_matches('-').parse() == Ok(0.0) { text.trim_start_matches('-').to_owned() } else { text }
}

/// All criteria for a cycle at the speed with index `speed`; free walking is 2.
pub(super) fn all(cycle: &Cycle, people: &[Band; 8], speed: usize) -> Vec<Criterion> {
    let mut list: Vec<Criterion> = QUANTITIES
        .into_iter()
        .filter(|quantity| !matches!(quantity, Quantity::Force(_)))
        .flat_map(|quantity| shape(quantity, cycle, &people[quantity.index()]))
        .collect();
    list.extend(moments(cycle));
    list.extend(forces(cycle));
    list.extend(motion(cycle, speed));
    list
}

/// Band and correlation of a curve.
fn shape(quantity: Quantity, cycle: &Cycle, band: &Band) -> [Criterion; 2] {
    let (curve, name) = (cycle.at_samples(quantity.index()), quantity.name());
    let rms = rms_difference(&curve, &band.mean);
    let unit = if matches!(quantity, Quantity::Angle(_)) { "deg" } else { "N.m/kg" };
    let within = 100.0 * inside(&curve, band);
    let mut band_line =
        criterion(&format!("{name} inside the band"), within, Limit::AtLeast(100.0 * INSIDE), 0, "% of the cycle");
    band_line.result.push_str(&format!(" (RMS {rms:.2} {unit})"));
    let r = correlation(&curve, &band.mean);
    [band_line, criterion(&format!("{name}, r"), r, Limit::AtLeast(quantity.least_r()), 3, "")]
}

fn moments(cycle: &Cycle) -> [Criterion; 2] {
    let (ankle, hip) = (cycle.peaks.ankle, cycle.peaks.hip[2]);
    [
        criterion("ankle moment, peak", ankle, Limit::Within(1.2, 1.6), 2, "N.m/kg"),
        Criterion {
            what: "ankle peak above the hip's".to_owned(),
            limit: "ankle > hip".to_owned(),
            result: format!("{ankle:.2} and {hip:.2} N.m/kg"),
            met: ankle > hip,
        },
    ]
}

fn forces(cycle: &Cycle) -> [Criterion; 8] {
    let ([first, hollow, second], [back, forth]) = (cycle.peaks.vertical, cycle.peaks.fore_aft);
    let [up, net] = cycle.mean_force;
    [
        criterion("vertical force, first peak", first, Limit::Within(1.05, 1.20), 2, "BW"),
        criterion("vertical force, second peak", second, Limit::Within(1.05, 1.20), 2, "BW"),
        criterion("vertical force, least between", hollow, Limit::Within(0.70, 0.85), 2, "BW"),
        criterion("fore-aft force, braking", back, Limit::Within(-0.22, -0.15), 2, "BW"),
        criterion("fore-aft force, propulsion", forth, Limit::Within(0.16, 0.24), 2, "BW"),
        criterion("mean vertical force of both feet", up, Limit::Within(0.995, 1.005), 4, "BW"),
        criterion("net fore-aft impulse", 100.0 * net, Limit::Within(-1.0, 1.0), 2, "% of body weight x cycle"),
        criterion("the same over the propulsive impulse", 100.0 * cycle.net_share, Limit::Within(-1.0, 1.0), 2, "%"),
    ]
}

fn motion(cycle: &Cycle, speed: usize) -> [Criterion; 5] {
    let people = 100.0 * SPEED_RANGES[speed];
    let miss = 100.0 * SPEED_RANGE_MISS;
    let range = Limit::Within(people - miss, people + miss);
    let mut slip = criterion("slip of a foot in stance", 1e3 * cycle.slip.excursion, Limit::Below(1e3 * SLIP), 2, "mm");
    slip.result.push_str(&format!(" (path {:.2} mm)", 1e3 * cycle.slip.path));
    [
        criterion(
            "forward speed of the centre of mass, peak to peak",
            100.0 * cycle.speed_range,
            range,
            1,
            "% of its mean",
        ),
        slip,
        Criterion {
            what: "flight".to_owned(),
            limit: "none".to_owned(),
            result: format!("{:.0} ms of the cycle", 1e3 * cycle.flight_s),
            met: cycle.flight_s <= 0.0,
        },
        criterion("torque that holds the trunk, RMS", cycle.trunk[0], Limit::Below(TRUNK[0]), 2, "N.m"),
        criterion("torque that holds the trunk, largest", cycle.trunk[1], Limit::Below(TRUNK[1]), 2, "N.m"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_missed_and_zero_has_no_sign() {
        assert!(!criterion("slip", f64::NAN, Limit::Below(2.0), 2, "mm").met);
        let net = criterion("net", -0.001, Limit::Within(-1.0, 1.0), 2, "%");
        assert!(net.met && net.result == "0.00 %", "{}", net.result);
        assert!(
            !criterion("r", 0.897, Limit::AtLeast(0.9), 2, "").met,
            "a value that rounds to the limit is still below it"
        );
    }
}
