//! One plate, from its channels to the laboratory.

use super::baseline::{self, Baseline};
use super::clipping;
use super::kind::{Layout, PlateKind, Units};
use super::surface::Surface;
use super::{PlateRecording, PlateSettings};
use crate::findings::{Code, Findings};
use crate::spatial::{Vec3, Wrench};
use std::ops::Range;

/// What a file says about one plate.
pub(super) struct PlateSource {
    pub(super) name: String,
    /// FORCE_PLATFORM:TYPE.
    pub(super) number: u8,
    /// Corners in the laboratory [m].
    pub(super) corners: [Vec3; 4],
    /// ORIGIN as it is stated, in the plate's axes [m].
    pub(super) origin: Vec3,
    /// Channels in the order of the type, in the file's units.
    pub(super) channels: Vec<Vec<f64>>,
    /// Rows of the calibration matrix; none if the file has none.
    pub(super) calibration: Vec<Vec<f64>>,
    /// Samples in which the file says that the plate was unloaded.
    pub(super) zero: Option<Range<usize>>,
    pub(super) times: Vec<f64>,
    pub(super) rate_hz: f64,
    pub(super) units: Units,
    /// Mean place of the markers, which are above the floor [m].
    pub(super) body: Option<Vec3>,
}

/// Baselines above this are worth a warning, smaller ones a note [N].
const LARGE_BASELINE_N: f64 = 10.0;
/// Baselines below this are not worth a word [N].
const SMALL_BASELINE_N: f64 = 0.5;
/// A plate whose force varies by less than this was never stepped on [N].
const STEP_N: f64 = 50.0;
/// The centre of pressure may lie this far beyond the edge [m]: errors of corners and of light loads.
const EDGE_SLACK_M: f64 = 0.05;
/// Loads of at least this share of the peak say where the foot stood.
const SOLID_LOAD: f64 = 0.2;
/// A reading is doubted if fewer of its centres of pressure lie on the plate, and another believed if more do.
const DOUBTED_SHARE: f64 = 0.5;
const BELIEVED_SHARE: f64 = 0.8;
/// A centre of pressure that moves less than this does not tell of a person [m]: bodies sway by millimetres ...
const STILL_M: f64 = 0.5e-3;
/// ... and one that moves more than this may [m].
const MOVES_M: f64 = 2e-3;

/// How the numbers are read.
#[derive(Clone, Copy)]
struct Reading {
    kind: PlateKind,
    origin: Vec3,
    units: Units,
    /// 1, or -1 where the file holds the force of the foot on the plate.
    sign: f64,
}

/// The plate's measurements in the laboratory.
///
/// # Errors
/// Why the plate cannot be read, for people.
pub(super) fn decode(
    source: &PlateSource,
    settings: PlateSettings,
    findings: &mut Findings,
) -> Result<PlateRecording, String> {
    let layout = layout(source)?;
    let surface = Surface::through(&source.corners)?;
    let mut channels = calibrated(source, layout, findings)?;
    let origin = origin(source, layout.kind, findings);
    let up = upward(&surface, source.body);
    let mut reading = Reading { kind: layout.kind, origin, units: source.units, sign: 1.0 };
    reading.sign = load_sign(&vertical(&channels, reading, &surface, up));
    if reading.sign < 0.0 {
        let message = format!(
            "{} pulls its load down: the file holds the force of the foot on the plate; all signs of this plate were turned",
            source.name
        );
        findings.report(Code::PlatesForceOnPlate, message);
    }
    let vertical = vertical(&channels, reading, &surface, up);
    let baseline = baseline::find(&channels, &vertical, source.rate_hz, source.zero.clone());
    let clipped = clipped(source, baseline.as_ref(), layout, findings);
    let removed = baseline.filter(|_| settings.remove_baseline);
    if let Some(baseline) = &removed {
        remove(&mut channels, baseline, layout.kind);
        report_baseline(source, baseline, findings);
    }
    reading = believed(source, &surface, up, &channels, reading, findings);
    let mut recording = recording(source, &surface, up, &channels, reading);
    recording.baseline_n = removed.map(|b| b.vertical_n);
    recording.clipped = clipped;
    Ok(recording)
}

fn layout(source: &PlateSource) -> Result<Layout, String> {
    let Some(layout) = Layout::of_type(source.number) else {
        return Err(format!("type {} is not documented; known are 1 to 7", source.number));
    };
    if source.channels.len() < layout.channels {
        let (found, expected) = (source.channels.len(), layout.channels);
        return Err(format!("it has {found} channels; type {} needs {expected}", source.number));
    }
    Ok(layout)
}

/// The channels after the calibration matrix.
fn calibrated(source: &PlateSource, layout: Layout, findings: &mut Findings) -> Result<Vec<Vec<f64>>, String> {
    let raw = &source.channels[..layout.channels];
    let Some(rows) = layout.matrix_rows else { return Ok(raw.to_vec()) };
    let matrix = &source.calibration;
    let zero = matrix.iter().flatten().all(|&x| x.abs() <= 0.0);
    if zero && rows == layout.channels {
        let message = format!(
            "{} is of type {} but has no calibration matrix; its channels were taken as calibrated",
            source.name, source.number
        );
        findings.report(Code::PlatesNoCalibration, message);
        return Ok(raw.to_vec());
    }
    if matrix.len() < rows || matrix.iter().any(|row| row.len() < layout.channels) {
        let columns = matrix.first().map_or(0, Vec::len);
        return Err(format!(
            "its calibration matrix is {} x {columns}; type {} needs {rows} x {}",
            matrix.len(),
            source.number,
            layout.channels
        ));
    }
    let samples = source.times.len();
    let product = |row: &Vec<f64>| (0..samples).map(|i| row.iter().zip(raw).map(|(m, c)| m * c[i]).sum()).collect();
    Ok(matrix[..rows].iter().map(product).collect())
}

/// ORIGIN with the sign that the format asks for: the surface lies above the sensors, against the plate's z.
fn origin(source: &PlateSource, kind: PlateKind, findings: &mut Findings) -> Vec3 {
    let stated = source.origin;
    let finite = stated.map(|x| if x.is_finite() { x } else { 0.0 });
    if kind.stands_on_sensors() {
        // a and b are half distances, which have no sign; only the height can be turned.
        let origin = Vec3::new(finite.x.abs(), finite.y.abs(), -finite.z.abs());
        if origin.x <= 0.0 || origin.y <= 0.0 {
            let message = format!(
                "{} does not say how far its sensors stand apart (ORIGIN {} {} {}): its moments and its centre of pressure are meaningless",
                source.name, stated.x, stated.y, stated.z
            );
            findings.report(Code::PlatesNoSensorDistance, message);
        }
        return origin;
    }
    if leads_down(kind, finite) { -finite } else { finite }
}

/// Whether ORIGIN leads from the surface down to the sensors. Most of Vicon's files have it so, against the format's guide.
fn leads_down(kind: PlateKind, origin: Vec3) -> bool {
    kind == PlateKind::Wrench && origin.z > 0.0
}

/// Whether the stated ORIGIN of a plate was turned round.
pub(super) fn origin_was_turned(source: &PlateSource) -> bool {
    Layout::of_type(source.number).is_some_and(|layout| leads_down(layout.kind, source.origin))
}

/// The unit normal that points to where the markers are; against the plate's z without markers.
fn upward(surface: &Surface, body: Option<Vec3>) -> Vec3 {
    let down = surface.normal();
    let markers_below = body.is_some_and(|b| (b - surface.center).dot(&down) > 0.0);
    if markers_below { down } else { -down }
}

fn sample(channels: &[Vec<f64>], i: usize, into: &mut Vec<f64>) {
    into.clear();
    into.extend(channels.iter().map(|c| c[i]));
}

fn wrenches(channels: &[Vec<f64>], reading: Reading) -> Vec<Wrench> {
    let samples = channels.first().map_or(0, Vec::len);
    let mut values = Vec::with_capacity(channels.len());
    let wrench = |i: usize| {
        sample(channels, i, &mut values);
        let w = reading.kind.wrench(&values, reading.origin, reading.units);
        Wrench { force: w.force * reading.sign, moment: w.moment * reading.sign }
    };
    (0..samples).map(wrench).collect()
}

fn vertical(channels: &[Vec<f64>], reading: Reading, surface: &Surface, up: Vec3) -> Vec<f64> {
    let up_in_plate = surface.lab_from_plate.transpose() * up;
    wrenches(channels, reading).iter().map(|w| w.force.dot(&up_in_plate)).collect()
}

/// -1 if the load acts downwards. Without a step, a plate that shows a constant force is either loaded or off its zero;
/// only a load that is too large for an offset then counts.
fn load_sign(vertical: &[f64]) -> f64 {
    let mut sorted: Vec<f64> = vertical.iter().copied().filter(|x| x.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let at = |share: f64| sorted.get((share * sorted.len() as f64) as usize).copied();
    let (Some(low), Some(high), Some(middle)) = (at(0.005), at(0.995), at(0.5)) else { return 1.0 };
    let turned = if high - low < STEP_N { middle < -STEP_N } else { -low > high };
    if turned { -1.0 } else { 1.0 }
}

fn remove(channels: &mut [Vec<f64>], baseline: &Baseline, kind: PlateKind) {
    for (i, (channel, level)) in channels.iter_mut().zip(&baseline.levels).enumerate() {
        if !kind.is_place(i) {
            channel.iter_mut().for_each(|x| *x -= level);
        }
    }
}

fn report_baseline(source: &PlateSource, baseline: &Baseline, findings: &mut Findings) {
    let offset = baseline.vertical_n;
    let evidence = if baseline.from_zero_frames { "the file's ZERO frames" } else { "its quietest time without load" };
    let message = format!("{} showed {offset:.1} N without load, by {evidence}; this was removed", source.name);
    if offset.abs() > LARGE_BASELINE_N {
        findings.report(Code::PlatesLargeBaseline, message);
    } else if offset.abs() > SMALL_BASELINE_N {
        findings.report(Code::PlatesBaseline, message);
    }
}

fn clipped(
    source: &PlateSource,
    baseline: Option<&Baseline>,
    layout: Layout,
    findings: &mut Findings,
) -> Vec<[f64; 2]> {
    // The baseline is that of the calibrated channels; without a matrix they are the raw ones.
    let level = |i: usize| baseline.filter(|_| layout.matrix_rows.is_none()).map_or(0.0, |b| b.levels[i]);
    let mut clipped = Vec::new();
    for (i, channel) in source.channels[..layout.channels].iter().enumerate() {
        if layout.kind.is_place(i) {
            continue;
        }
        let spans = clipping::spans(channel, level(i));
        if !spans.is_empty() {
            let message = format!(
                "channel {} of {} stays at its largest or smallest value at {:.3} s: it was clipped, and the force there is too small. hint: choose a larger range of the amplifier",
                i + 1,
                source.name,
                source.times[spans[0].start]
            );
            findings.report(Code::PlatesClipped, message);
        }
        clipped.extend(spans.into_iter().map(|s| [source.times[s.start], source.times[s.end - 1]]));
    }
    clipped.sort_by(|a, b| a[0].total_cmp(&b[0]));
    clipped
}

/// The reading as the file states it, or the one that puts the centre of pressure on the plate.
///
/// Moments that are a thousand times too small put it on the plate as well: into its middle, where it does not move.
fn believed(
    source: &PlateSource,
    surface: &Surface,
    up: Vec3,
    channels: &[Vec<f64>],
    stated: Reading,
    findings: &mut Findings,
) -> Reading {
    let share = |reading: Reading| share_on_plate(&recording(source, surface, up, channels, reading));
    // Without ORIGIN, or the shear force would move the centre.
    let moves_m = |reading: Reading| {
        spread_m(&recording(source, surface, up, channels, Reading { origin: Vec3::zeros(), ..reading }))
    };
    let Some(found) = share(stated) else { return stated };
    if found >= DOUBTED_SHARE && (stated.kind.stands_on_sensors() || moves_m(stated) >= STILL_M) {
        return stated;
    }
    for (other, what) in alternatives(stated) {
        if share(other).is_some_and(|s| s >= BELIEVED_SHARE) && moves_m(other) >= MOVES_M {
            let message = format!(
                "the centre of pressure of {} is not that of a foot as the file states its units; with {what} it is, so this was assumed",
                source.name
            );
            findings.report(Code::PlatesReadingChanged, message);
            return other;
        }
    }
    if found < DOUBTED_SHARE {
        let message = format!(
            "the centre of pressure of {} lies on the plate only {:.0} % of the time; its CORNERS, ORIGIN, CHANNEL or units may be wrong",
            source.name,
            100.0 * found
        );
        findings.report(Code::PlatesCenterOutside, message);
    }
    stated
}

fn alternatives(stated: Reading) -> Vec<(Reading, &'static str)> {
    let units = stated.units;
    match stated.kind {
        PlateKind::Wrench => {
            let moment =
                |factor: f64| Reading { units: Units { moment_nm: units.moment_nm * factor, ..units }, ..stated };
            let turned = Reading { origin: -stated.origin, ..stated };
            vec![
                (moment(1000.0), "moments a thousand times larger (N.m instead of N.mm)"),
                (moment(0.001), "moments a thousand times smaller (N.mm instead of N.m)"),
                (turned, "ORIGIN turned round"),
            ]
        }
        PlateKind::Point => {
            let length =
                |factor: f64| Reading { units: Units { length_m: units.length_m * factor, ..units }, ..stated };
            vec![
                (length(1000.0), "points a thousand times larger (m instead of mm)"),
                (length(0.001), "points a thousand times smaller (mm instead of m)"),
            ]
        }
        PlateKind::EightForces | PlateKind::TwelveForces => Vec::new(),
    }
}

/// Share of the solidly loaded samples whose centre of pressure lies on the plate; `None` without load.
fn share_on_plate(recording: &PlateRecording) -> Option<f64> {
    let centers = solid_centers(recording);
    let inside = centers.iter().filter(|c| recording.depth_inside(**c) >= -EDGE_SLACK_M).count();
    (!centers.is_empty()).then(|| inside as f64 / centers.len() as f64)
}

/// How far the centre of pressure moves [m]: the diagonal of the box that holds nine tenths of it along each axis.
fn spread_m(recording: &PlateRecording) -> f64 {
    let centers = solid_centers(recording);
    let along = |axis: usize| {
        let mut values: Vec<f64> = centers.iter().map(|c| c[axis]).collect();
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values.get((share * values.len() as f64) as usize).copied().unwrap_or(0.0);
        at(0.95) - at(0.05)
    };
    Vec3::new(along(0), along(1), along(2)).norm()
}

/// Centres of pressure while the load is solid [m].
fn solid_centers(recording: &PlateRecording) -> Vec<Vec3> {
    let solid = SOLID_LOAD * recording.peak_n();
    let loaded = (0..recording.times.len()).filter(|&i| recording.is_loaded(i) && recording.vertical(i) >= solid);
    loaded.map(|i| recording.center_of_pressure(i)).collect()
}

fn recording(
    source: &PlateSource,
    surface: &Surface,
    up: Vec3,
    channels: &[Vec<f64>],
    reading: Reading,
) -> PlateRecording {
    let wrenches = wrenches(channels, reading);
    let force: Vec<Vec3> = wrenches.iter().map(|w| surface.lab_from_plate * w.force).collect();
    let moment = wrenches.iter().zip(&force).map(|(w, f)| surface.lab_from_plate * w.moment + surface.center.cross(f));
    PlateRecording {
        name: source.name.clone(),
        kind: source.number,
        times: source.times.clone(),
        moment: moment.collect(),
        force,
        corners: source.corners,
        up,
        baseline_n: None,
        clipped: Vec::new(),
    }
}
