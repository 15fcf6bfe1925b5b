//! What is asked of a corrected walk at free speed, and what it has.

use super::curve::{QUANTITIES, Quantity, inside, rms_difference};
use super::cycle::Cycle;
use crate::normative::Band;
use ambulo::reproduction::correlation;

/// Peak-to-peak forward speed of people's centre of mass over its mean, very slow to very fast.
pub(super) const SPEED_RANGES: [f64; 5] = [0.26, 0.19, 0.16, 0.135, 0.10];
/// How far ours may be from it.
pub(super) const SPEED_RANGE_MISS: f64 = 0.04;
/// Share of the cycle inside the band.
const INSIDE: f64 = 0.95;
/// Slip of a standing foot [m].
pub(super) const SLIP: f64 = 2e-3;
/// Torque that holds the trunk [N.m]: root mean square, largest.
pub(super) const TRUNK: [f64; 2] = [3.0, 10.0];

/// One line of the table.
#[derive(Debug, Clone)]
pub(super) struct Asked {
    pub(super) what: String,
    pub(super) asked: String,
    pub(super) got: String,
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
fn line(what: &str, value: f64, limit: Limit, digits: usize, unit: &str) -> Asked {
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let asked = match limit {
        Limit::Within(least, most) => format!("{least:.digits$} .. {most:.digits$}{unit}"),
        Limit::AtLeast(least) => format!(">= {least:.digits$}{unit}"),
        Limit::Below(most) => format!("< {most:.digits$}{unit}"),
    };
    Asked { what: what.to_owned(), asked, got: format!("{}{unit}", rounded(value, digits)), met: limit.holds(value) }
}

/// Without a minus before zero.
fn rounded(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    if text.trim_start_matches('-').parse() == Ok(0.0) { text.trim_start_matches('-').to_owned() } else { text }
}

/// All lines for a cycle at the speed with number `speed`; free walking is 2.
pub(super) fn lines(cycle: &Cycle, people: &[Band; 8], speed: usize) -> Vec<Asked> {
    let mut lines: Vec<Asked> = QUANTITIES
        .into_iter()
        .filter(|quantity| !matches!(quantity, Quantity::Force(_)))
        .flat_map(|quantity| shape(quantity, cycle, &people[quantity.index()]))
        .collect();
    lines.extend(moments(cycle));
    lines.extend(forces(cycle));
    lines.extend(motion(cycle, speed));
    lines
}

/// Band and correlation of a curve.
fn shape(quantity: Quantity, cycle: &Cycle, band: &Band) -> [Asked; 2] {
    let (curve, name) = (cycle.at_samples(quantity.index()), quantity.name());
    let rms = rms_difference(&curve, &band.mean);
    let unit = if matches!(quantity, Quantity::Angle(_)) { "deg" } else { "N.m/kg" };
    let within = 100.0 * inside(&curve, band);
    let mut band_line =
        line(&format!("{name} inside the band"), within, Limit::AtLeast(100.0 * INSIDE), 0, "% of the cycle");
    band_line.got.push_str(&format!(" (RMS {rms:.2} {unit})"));
    let r = correlation(&curve, &band.mean);
    [band_line, line(&format!("{name}, r"), r, Limit::AtLeast(quantity.least_r()), 3, "")]
}

fn moments(cycle: &Cycle) -> [Asked; 2] {
    let (ankle, hip) = (cycle.peaks.ankle, cycle.peaks.hip[2]);
    [
        line("ankle moment, peak", ankle, Limit::Within(1.2, 1.6), 2, "N.m/kg"),
        Asked {
            what: "ankle peak above the hip's".to_owned(),
            asked: "ankle > hip".to_owned(),
            got: format!("{ankle:.2} and {hip:.2} N.m/kg"),
            met: ankle > hip,
        },
    ]
}

fn forces(cycle: &Cycle) -> [Asked; 8] {
    let ([first, hollow, second], [back, forth]) = (cycle.peaks.vertical, cycle.peaks.fore_aft);
    let [up, net] = cycle.mean_force;
    [
        line("vertical force, first peak", first, Limit::Within(1.05, 1.20), 2, "BW"),
        line("vertical force, second peak", second, Limit::Within(1.05, 1.20), 2, "BW"),
        line("vertical force, least between", hollow, Limit::Within(0.70, 0.85), 2, "BW"),
        line("fore-aft force, braking", back, Limit::Within(-0.22, -0.15), 2, "BW"),
        line("fore-aft force, propulsion", forth, Limit::Within(0.16, 0.24), 2, "BW"),
        line("mean vertical force of both feet", up, Limit::Within(0.995, 1.005), 4, "BW"),
        line("net fore-aft impulse", 100.0 * net, Limit::Within(-1.0, 1.0), 2, "% of body weight x cycle"),
        line("the same over the propulsive impulse", 100.0 * cycle.net_share, Limit::Within(-1.0, 1.0), 2, "%"),
    ]
}

fn motion(cycle: &Cycle, speed: usize) -> [Asked; 5] {
    let people = 100.0 * SPEED_RANGES[speed];
    let miss = 100.0 * SPEED_RANGE_MISS;
    let range = Limit::Within(people - miss, people + miss);
    let mut slip = line("slip of a standing foot", 1e3 * cycle.slip.excursion, Limit::Below(1e3 * SLIP), 2, "mm");
    slip.got.push_str(&format!(" (path {:.2} mm)", 1e3 * cycle.slip.path));
    [
        line("forward speed of the centre of mass, peak to peak", 100.0 * cycle.speed_range, range, 1, "% of its mean"),
        slip,
        Asked {
            what: "flight".to_owned(),
            asked: "none".to_owned(),
            got: format!("{:.0} ms of the cycle", 1e3 * cycle.flight_s),
            met: cycle.flight_s <= 0.0,
        },
        line("torque that holds the trunk, RMS", cycle.trunk[0], Limit::Below(TRUNK[0]), 2, "N.m"),
        line("torque that holds the trunk, largest", cycle.trunk[1], Limit::Below(TRUNK[1]), 2, "N.m"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_missed_and_zero_has_no_sign() {
        assert!(!line("slip", f64::NAN, Limit::Below(2.0), 2, "mm").met);
        let net = line("net", -0.001, Limit::Within(-1.0, 1.0), 2, "%");
        assert!(net.met && net.got == "0.00 %", "{}", net.got);
        assert!(!line("r", 0.897, Limit::AtLeast(0.9), 2, "").met, "what rounds to the limit is below it all the same");
    }
}
