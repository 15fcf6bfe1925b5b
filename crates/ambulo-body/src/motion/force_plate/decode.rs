//! Converts the channels of one plate to forces in the axes of the laboratory.

use super::super::glitches::{self, RINGING, STEP_N, Sensor};
use super::baseline::{self, Baseline};
use super::body_weight::stepped_weight;
use super::clipping;
use super::kind::{Layout, PlateKind, Units};
use super::surface::Surface;
use super::{PlateRecording, PlateSettings};
use crate::findings::{Code, Findings};
use crate::numerics::{Order, extremes, median, quantiles};
use crate::spatial::{Vec3, Wrench};
use std::ops::Range;

/// The parameters and channels of one plate in the file.
pub(super) struct PlateSource {
    pub(super) name: String,
    /// FORCE_PLATFORM:TYPE.
    pub(super) number: u8,
    /// Corners in the laboratory [m].
    pub(super) corners: [Vec3; 4],
    /// ORIGIN as stated, in the axes of the plate [m].
    pub(super) origin: Vec3,
    /// Channels in the order of the type, in the units of the file.
    pub(super) channels: Vec<Vec<f64>>,
    /// Rows of the calibration matrix; empty if the file has none.
    pub(super) calibration: Vec<Vec<f64>>,
    /// Samples in which the plate was unloaded according to the file.
    pub(super) zero: Option<Range<usize>>,
    pub(super) times: Vec<f64>,
    pub(super) rate_hz: f64,
    pub(super) units: Units,
    /// Factors by which forces and moments of the file were multiplied, because no step of a person weighs so much;
    /// `None` if the unit of the file was used.
    pub(super) assumed: Option<[f64; 2]>,
    /// Mean position of the markers, which are above the floor [m].
    pub(super) body: Option<Vec3>,
}

/// Baselines above this give a warning, smaller ones a note [N].
const LARGE_BASELINE_N: f64 = 10.0;
/// Baselines below this are not reported [N].
const SMALL_BASELINE_N: f64 = 0.5;
/// The centre of pressure may lie this far beyond the edge [m]: errors of corners and of light loads.
const EDGE_SLACK_M: f64 = 0.05;
/// Smallest load for evaluating centres of pressure, as a share of the peak.
const SOLID_LOAD: f64 = 0.2;
/// Smallest share of centres of pressure on the plate in a plausible reading, and in an accepted alternative.
const LEAST_ON_PLATE_SHARE: f64 = 0.5;
const ACCEPTED_ON_PLATE_SHARE: f64 = 0.8;
/// Smallest movement of the centre of pressure in a plausible reading [m]: bodies sway by millimetres ...
const LEAST_SPREAD_M: f64 = 0.5e-3;
/// ... and in an accepted alternative [m].
const ACCEPTED_SPREAD_M: f64 = 2e-3;

/// Interpretation of the channels.
#[derive(Clone, Copy)]
struct Reading {
    kind: PlateKind,
    origin: Vec3,
    units: Units,
    /// 1, or -1 if the file has the force of the foot on the plate.
    sign: f64,
}

impl PlateSource {
    /// Body weight from the steps on the plate, in the unit of the file; `None` without a whole step.
    pub(super) fn stepped_weight(&self) -> Option<f64> {
        stepped_weight(&self.times, &self.load()?)
    }

    /// Upward force of the plate in the unit of the file, one entry per sample, with the sign that makes it a load.
    pub(super) fn load(&self) -> Option<Vec<f64>> {
        let layout = layout(self).ok()?;
        let surface = Surface::through(&self.corners).ok()?;
        let channels = calibrated(self, layout, &mut Findings::default()).ok()?;
        let units = Units { force_n: 1.0, ..self.units };
        let reading = Reading { kind: layout.kind, origin: self.origin, units, sign: 1.0 };
        let vertical = vertical(&channels, reading, &surface, upward(&surface, self.body));
        let largest = vertical.iter().copied().fold(0.0, |most: f64, x| most.max(x.abs()));
        // The threshold of the sign is in newtons.
        let sign = load_sign(&vertical.iter().map(|x| x * 1e4 / largest).collect::<Vec<_>>());
        Some(vertical.iter().map(|x| sign * x).collect())
    }

    /// The part of a vector in the plane of the plate.
    pub(super) fn level_part(&self, vector: Vec3) -> Option<Vec3> {
        let normal = Surface::through(&self.corners).ok()?.normal();
        Some(vector - normal * vector.dot(&normal))
    }

    /// Centre of the plate, and half of its diagonal [m].
    pub(super) fn extent(&self) -> Option<(Vec3, f64)> {
        let Surface { center, size: [x, y], .. } = Surface::through(&self.corners).ok()?;
        Some((center, 0.5 * (x * x + y * y).sqrt()))
    }
}

impl PlateSource {
    /// Lever of the free moment of type 1, the only moment of its channels, by the units in the file [m].
    pub(super) fn free_lever_m(&self) -> Option<f64> {
        let is_free = Layout::of_type(self.number).is_some_and(|layout| layout.kind == PlateKind::Point);
        let (vertical, free) = (self.channels.get(2)?, self.channels.get(5)?);
        let most = vertical.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let loaded = vertical.iter().zip(free).filter(|(f, _)| f.abs() > SOLID_LOAD * most);
        let lever = loaded.map(|(f, t)| (t * self.units.moment_nm / (f * self.units.force_n)).abs());
        median(lever).filter(|_| is_free)
    }
}

/// Converts a plate to forces and moments in the axes of the laboratory.
///
/// # Errors
/// Why the plate cannot be read, in words.
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
    // A plate without a load has nothing but noise.
    let load_n = glitches::range(&vertical(&channels, reading, &surface, up));
    let lost = match load_n.filter(|load_n| *load_n > STEP_N) {
        Some(load_n) => mend(source, (layout.kind, load_n), &mut channels, findings),
        None => Vec::new(),
    };
    reading.sign = load_sign(&vertical(&channels, reading, &surface, up));
    if reading.sign < 0.0 {
        let message = format!(
            "the force of {} points down: the file has the force of the foot on the plate; all signs of this plate \
             were reversed",
            source.name
        );
        findings.report(Code::PlatesForceOnPlate, message);
    }
    let vertical = vertical(&channels, reading, &surface, up);
    report_still(source, layout.kind, &channels, &vertical, findings);
    let baseline = baseline::find(&channels, &vertical, source.rate_hz, source.zero.clone());
    let clipped = clipped(source, baseline.as_ref(), (layout, &lost), findings);
    let removed = baseline.filter(|_| settings.remove_baseline);
    if let Some(baseline) = &removed {
        remove(&mut channels, baseline, layout.kind);
        report_baseline(source, baseline, findings);
    }
    reading = corrected_reading(source, &surface, up, &channels, reading, findings);
    let mut recording = recording(source, &surface, up, &channels, reading);
    let of_reading = reading.units.moment_nm / source.units.moment_nm;
    recording.assumed_units = source.assumed.map(|[force, moment]| [force, moment * of_reading]);
    recording.baseline_n = removed.map(|b| b.vertical_n);
    recording.clipped = clipped;
    Ok(recording)
}

/// Mends what no load does, on a plate that carried a load [N]. Returns the longer times that were replaced.
fn mend(
    source: &PlateSource,
    (kind, load_n): (PlateKind, f64),
    channels: &mut [Vec<f64>],
    findings: &mut Findings,
) -> Vec<Range<usize>> {
    // The free moment of type 1 follows from the centre of pressure, which jumps under a small load.
    let judged = if kind == PlateKind::Point { 3 } else { channels.len() };
    let is_force = |i: usize| i < 3 || kind.has_four_sensors();
    let least = |i: usize| if is_force(i) { RINGING * load_n / source.units.force_n } else { 0.0 };
    let sensor = Sensor {
        name: &source.name,
        names: (0..judged).map(|i| format!("channel {} of {}", i + 1, source.name)).collect(),
        least: (0..judged).map(least).collect(),
        times: &source.times,
        rate_hz: source.rate_hz,
    };
    sensor.mend(channels, findings)
}

/// Reports channels that have one value, though the plate was stepped on.
fn report_still(
    source: &PlateSource,
    kind: PlateKind,
    channels: &[Vec<f64>],
    vertical: &[f64],
    findings: &mut Findings,
) {
    let (low, high) = extremes(vertical);
    if high - low < STEP_N {
        return;
    }
    let still: Vec<String> = channels
        .iter()
        .enumerate()
        .filter(|(i, channel)| !kind.is_coordinate(*i) && glitches::is_still(channel))
        .map(|(i, _)| (i + 1).to_string())
        .collect();
    if !still.is_empty() {
        let message = format!(
            "{} carried a load of {high:.0} N, but {} one value all the time: this part of the force is missing, and \
             moments that need it are wrong. hint: check cables, amplifier and FORCE_PLATFORM:CHANNEL",
            source.name,
            match &still[..] {
                [one] => format!("channel {one} has"),
                several => format!("channels {} have", several.join(", ")),
            }
        );
        findings.report(Code::PlatesStillChannel, message);
    }
}

fn layout(source: &PlateSource) -> Result<Layout, String> {
    let Some(layout) = Layout::of_type(source.number) else {
        return Err(format!("type {} is not documented; expected 1 to 7", source.number));
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
            "{} is of type {} but has no calibration matrix; its channels were assumed calibrated",
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

/// ORIGIN with the sign of the format: the surface is above the sensors, opposite to z of the plate.
fn origin(source: &PlateSource, kind: PlateKind, findings: &mut Findings) -> Vec3 {
    let stated = source.origin;
    let finite = stated.map(|x| if x.is_finite() { x } else { 0.0 });
    if kind.has_four_sensors() {
        // a and b are half distances without sign; only the height can be reversed.
        let origin = Vec3::new(finite.x.abs(), finite.y.abs(), -finite.z.abs());
        if origin.x <= 0.0 || origin.y <= 0.0 {
            let message = format!(
                "{} does not state the distances between its sensors (ORIGIN {} {} {}): its moments and its centre of \
                 pressure are meaningless",
                source.name, stated.x, stated.y, stated.z
            );
            findings.report(Code::PlatesNoSensorDistance, message);
        }
        return origin;
    }
    if leads_down(kind, finite) { -finite } else { finite }
}

/// Whether ORIGIN points from the surface down to the sensors, as in most of Vicon's files, contrary to the guide of
/// the format.
fn leads_down(kind: PlateKind, origin: Vec3) -> bool {
    kind == PlateKind::Wrench && origin.z > 0.0
}

/// Whether the stated ORIGIN of a plate was reversed.
pub(super) fn origin_was_reversed(source: &PlateSource) -> bool {
    Layout::of_type(source.number).is_some_and(|layout| leads_down(layout.kind, source.origin))
}

/// The unit normal on the side of the markers; opposite to z of the plate without markers.
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

/// -1 if the load acts downwards. Without a step, a constant force is either a load or an offset;
/// then only a force that is too large for an offset counts.
fn load_sign(vertical: &[f64]) -> f64 {
    let found = quantiles(vertical.iter().copied(), [0.005, 0.5, 0.995]);
    let Some([low, middle, high]) = found else { return 1.0 };
    let turned = if high - low < STEP_N { middle < -STEP_N } else { -low > high };
    if turned { -1.0 } else { 1.0 }
}

fn remove(channels: &mut [Vec<f64>], baseline: &Baseline, kind: PlateKind) {
    for (i, (channel, level)) in channels.iter_mut().zip(&baseline.levels).enumerate() {
        if !kind.is_coordinate(i) {
            channel.iter_mut().for_each(|x| *x -= level);
        }
    }
}

fn report_baseline(source: &PlateSource, baseline: &Baseline, findings: &mut Findings) {
    let offset = baseline.vertical_n;
    let evidence =
        if baseline.from_zero_frames { "the ZERO frames of the file" } else { "its quietest time without load" };
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
    (layout, lost): (Layout, &[Range<usize>]),
    findings: &mut Findings,
) -> Vec<[f64; 2]> {
    // The baseline is of the calibrated channels, which are the raw ones without a matrix.
    let level = |i: usize| baseline.filter(|_| layout.matrix_rows.is_none()).map_or(0.0, |b| b.levels[i]);
    let mut clipped = Vec::new();
    for (i, channel) in source.channels[..layout.channels].iter().enumerate() {
        if layout.kind.is_coordinate(i) {
            continue;
        }
        let is_new = |span: &Range<usize>| !lost.iter().any(|own| own.start <= span.end && span.start <= own.end);
        let spans: Vec<_> = clipping::spans(channel, level(i)).into_iter().filter(is_new).collect();
        if !spans.is_empty() {
            let message = format!(
                "channel {} of {} stays at its largest or smallest value at {:.3} s: it was clipped, and the force \
                 there is too small. hint: choose a larger range of the amplifier",
                i + 1,
                source.name,
                source.times[spans[0].start]
            );
            findings.report(Code::PlatesClipped, message);
        }
        clipped.extend(spans.into_iter().map(|s| [source.times[s.start], source.times[s.end - 1]]));
    }
    clipped.sort_by_number(|span| span[0]);
    clipped
}

/// The reading stated by the file, or an alternative with the centre of pressure on the plate.
///
/// Moments that are a thousand times too small also place it on the plate, but in its middle, where it does not move.
fn corrected_reading(
    source: &PlateSource,
    surface: &Surface,
    up: Vec3,
    channels: &[Vec<f64>],
    stated: Reading,
    findings: &mut Findings,
) -> Reading {
    let share = |reading: Reading| share_on_plate(&recording(source, surface, up, channels, reading));
    // Without ORIGIN, because the shear force would move the centre.
    let moves_m = |reading: Reading| {
        spread_m(&recording(source, surface, up, channels, Reading { origin: Vec3::zeros(), ..reading }))
    };
    let Some(found) = share(stated) else { return stated };
    if found >= LEAST_ON_PLATE_SHARE && (stated.kind.has_four_sensors() || moves_m(stated) >= LEAST_SPREAD_M) {
        return stated;
    }
    for (other, what) in alternatives(stated, source.assumed) {
        if share(other).is_some_and(|s| s >= ACCEPTED_ON_PLATE_SHARE) && moves_m(other) >= ACCEPTED_SPREAD_M {
            let message = format!(
                "the centre of pressure of {} is not plausible with the units in the file; it is with {what}, so this \
                 was assumed",
                source.name
            );
            findings.report(Code::PlatesReadingChanged, message);
            return other;
        }
    }
    if found < LEAST_ON_PLATE_SHARE {
        let message = format!(
            "the centre of pressure of {} lies on the plate only {:.0} % of the time; its CORNERS, ORIGIN, CHANNEL or \
             units may be wrong",
            source.name,
            100.0 * found
        );
        findings.report(Code::PlatesCenterOutside, message);
    }
    stated
}

fn alternatives(stated: Reading, assumed: Option<[f64; 2]>) -> Vec<(Reading, &'static str)> {
    let units = stated.units;
    match stated.kind {
        PlateKind::Wrench => {
            let moment =
                |factor: f64| Reading { units: Units { moment_nm: units.moment_nm * factor, ..units }, ..stated };
            let turned = Reading { origin: -stated.origin, ..stated };
            let of_file = assumed.map(|[_, factor]| (moment(1.0 / factor), "moments in the unit of the file"));
            let others = [
                (moment(1000.0), "moments a thousand times larger (N.m instead of N.mm)"),
                (moment(0.001), "moments a thousand times smaller (N.mm instead of N.m)"),
                (turned, "ORIGIN reversed"),
            ];
            of_file.into_iter().chain(others).collect()
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

/// Share of the well-loaded samples whose centre of pressure is on the plate; `None` without load.
fn share_on_plate(recording: &PlateRecording) -> Option<f64> {
    let centers = solid_centers(recording);
    let inside = centers.iter().filter(|c| recording.depth_inside(**c) >= -EDGE_SLACK_M).count();
    (!centers.is_empty()).then(|| inside as f64 / centers.len() as f64)
}

/// Extent of the centre of pressure [m]: the diagonal of the box with nine tenths of its values along each axis.
fn spread_m(recording: &PlateRecording) -> f64 {
    let centers = solid_centers(recording);
    let along = |axis: usize| {
        quantiles(centers.iter().map(|center| center[axis]), [0.05, 0.95]).map_or(0.0, |[low, high]| high - low)
    };
    Vec3::new(along(0), along(1), along(2)).norm()
}

/// Centres of pressure under sufficient load [m].
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
        center_from_sensors: surface.lab_from_plate * reading.kind.lever(reading.origin),
        assumed_units: None,
        baseline_n: None,
        clipped: Vec::new(),
    }
}
