//! Reads the force plates of a C3D file.

use super::body_weight::ForceUnit;
use super::decode::{PlateSource, decode, origin_was_reversed};
use super::kind::Units;
use super::{PlateRecording, PlateSettings, units};
use crate::findings::{Code, Findings};
use crate::motion::guessed_unit::metres_per_unit;
use crate::motion::subject_parameters::subject_from_c3d;
use crate::numerics::{Shown, median, quantiles, sort_numbers};
use crate::spatial::{STANDARD_GRAVITY, Vec3};
use ambulo_formats::c3d::{C3d, Channel, Platform};
use std::ops::Range;

/// Plausible edges of plates: from a step to a treadmill [m].
const EDGE_M: [f64; 2] = [0.1, 10.0];
/// Factors of wrong units.
const UNIT_FACTORS: [f64; 6] = [0.001, 0.01, 0.1, 10.0, 100.0, 1000.0];

/// Why no plate can be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlateError {
    /// The parameters of the plates are not valid.
    #[error("the force plates cannot be read")]
    Parameters(#[from] ambulo_formats::Error),
    /// Lengths without a unit.
    #[error(
        "the force plates cannot be read: POINT:UNITS is `{found}`, and neither markers nor plates have the size of a \
         person or a plate in mm, cm or m; expected a unit of length such as mm. hint: set POINT:UNITS in the file"
    )]
    Unit {
        /// The unit in the file.
        found: String,
    },
}

/// Reads the force plates of a C3D file, in the axes of the laboratory; empty if there are none. A plate that cannot be
/// read is left out, with a warning.
///
/// # Errors
/// Invalid parameters of the plates, a file without unit of length.
pub fn plates_from_c3d(
    file: &C3d,
    settings: PlateSettings,
    findings: &mut Findings,
) -> Result<Vec<PlateRecording>, PlateError> {
    let described = described(file, findings)?;
    let platforms: Vec<Platform> = described.iter().map(|(_, platform)| platform.clone()).collect();
    if platforms.is_empty() {
        return Ok(Vec::new());
    }
    let unit_m = metres_per_unit(file, findings).ok_or_else(|| PlateError::Unit { found: file.point_unit.clone() })?;
    let unit_m = plausible_unit(&platforms, unit_m, findings);
    report_polynomial(file, findings);
    let body = mean_marker(file).map(|p| p * unit_m);
    let mut turned = Vec::new();
    let mut sources = Vec::new();
    for (number, platform) in &described {
        let name = format!("plate {number}");
        report_volts(file, platform, &name, findings);
        let source = source(file, platform, unit_m, body, name.clone());
        if source.as_ref().is_ok_and(origin_was_reversed) {
            turned.push(*number);
        }
        sources.push((name, source));
    }
    assume_unit(file, unit_m, &mut sources, findings);
    let mut plates = Vec::new();
    for (name, source) in sources {
        match source.and_then(|source| decode(&source, settings, findings)) {
            Ok(plate) => plates.push(plate),
            Err(reason) => findings.report(Code::PlatesUnusable, format!("{name} was left out: {reason}")),
        }
    }
    report_reversed(&turned, platforms.len(), findings);
    Ok(plates)
}

/// The platforms with their numbers, counted from 1. One whose description is incomplete is left out, with a warning,
/// unless no other is left.
fn described(file: &C3d, findings: &mut Findings) -> Result<Vec<(usize, Platform)>, PlateError> {
    let all = file.each_platform();
    if all.iter().all(Result::is_err) {
        return Ok(all.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().map(|platform| (1, platform)).collect());
    }
    let mut found = Vec::new();
    for (i, platform) in all.into_iter().enumerate() {
        match platform {
            Ok(platform) => found.push((i + 1, platform)),
            Err(reason) => {
                let message = format!("plate {} was left out, because its description is incomplete: {reason}", i + 1);
                findings.report(Code::PlatesUnusable, message);
            }
        }
    }
    Ok(found)
}

/// Weight of a step in body weights, within the error of a single step.
const BODY_WEIGHT: std::ops::RangeInclusive<f64> = 0.8..=1.25;
/// A free moment of a foot has about this lever [m]: some newton metres under the weight of a person.
const FREE_LEVER_M: f64 = 0.005;

/// Assumes another unit of the forces where the file's unit cannot be right, because no step of a person weighs so much
/// or so little.
fn assume_unit(
    file: &C3d,
    unit_m: f64,
    sources: &mut [(String, Result<PlateSource, String>)],
    findings: &mut Findings,
) {
    let weight_n = subject_from_c3d(file).mass_kg.map(|kg| kg * STANDARD_GRAVITY);
    let known = || sources.iter().filter_map(|(_, source)| source.as_ref().ok());
    let stepped = median(known().filter_map(|source| Some(source.stepped_weight()? * source.units.force_n)));
    let (who, found) = match stepped {
        Some(stepped) => ("a step", Some(stepped)),
        None if stands_still(file, unit_m) => ("the person who stands", standing_weight(&known().collect::<Vec<_>>())),
        None => return,
    };
    let unit = found.and_then(|found| Some((found, ForceUnit::of_steps(found, weight_n)?)));
    let Some((found, unit)) = unit else { return };
    let Some(newtons) = unit.newtons(weight_n) else { return };
    for source in sources.iter_mut().filter_map(|(_, source)| source.as_mut().ok()) {
        // With its force alone multiplied, a free moment has a lever that is shorter by the same factor.
        let is_off = |lever_m: f64| (lever_m / FREE_LEVER_M).max(FREE_LEVER_M / lever_m);
        let keeps_moment = source.free_lever_m().is_some_and(|lever_m| is_off(lever_m / newtons) < is_off(lever_m));
        let factor = if keeps_moment { 1.0 } else { newtons };
        source.assumed = Some([newtons, factor]);
        source.units.force_n *= newtons;
        source.units.moment_nm *= factor;
    }
    let is_unsure = weight_n.is_none() && unit == ForceUnit::Kilonewtons && BODY_WEIGHT.contains(&found);
    let or_else = if is_unsure { ", or in body weights, which the mass of the person would show" } else { "" };
    let message = format!(
        "{who} on the force plates weighs {} N by the unit in the file, which no person does; the forces are in {}, so \
         that {who} weighs {:.0} N{or_else}, and were read so. hint: correct ANALOG:UNITS, ANALOG:SCALE or the \
         calibration",
        Shown((1e4 * found).round() / 1e4),
        unit.name(),
        found * newtons
    );
    findings.report(Code::PlatesUnitByWeight, message);
}

/// The load of somebody who stands still changes by less than this share.
const STEADY: f64 = 0.1;
/// A marker of somebody who stands still stays within this distance [m].
const STILL_M: f64 = 0.1;

/// Whether most markers stay in place.
fn stands_still(file: &C3d, unit_m: f64) -> bool {
    let markers = crate::motion::real_points::real_points(file);
    let ranges = markers.iter().filter_map(|point| {
        let seen = || point.positions.iter().filter(|p| p.iter().all(|x| x.is_finite())).map(|p| Vec3::from(*p));
        let first = seen().next()?;
        Some(unit_m * seen().map(|position| (position - first).norm()).fold(0.0, f64::max))
    });
    median(ranges).is_some_and(|range_m| range_m < STILL_M)
}

/// The weight of a person who stands still on the plates by the units in the file [N]; `None` if the load of all plates
/// together changes, as that of a step, and the noise of an unloaded plate do, or if the markers are not above it.
fn standing_weight(plates: &[&PlateSource]) -> Option<f64> {
    let loads: Vec<(&PlateSource, Vec<f64>)> =
        plates.iter().filter_map(|plate| Some((*plate, plate.load()?))).collect();
    let samples = loads.iter().map(|(_, load)| load.len()).min()?;
    let total = |i: usize| loads.iter().map(|(plate, load)| load[i] * plate.units.force_n).sum::<f64>();
    let [low, middle, high] = quantiles((0..samples).map(total), [0.05, 0.5, 0.95])?;
    let is_steady = middle > 0.0 && high - low < STEADY * middle;
    (is_steady && is_above(&loads)).then_some(middle)
}

/// Whether the markers are above the loaded plates.
fn is_above(loads: &[(&PlateSource, Vec<f64>)]) -> bool {
    let (mut moment, mut sum, mut reach_m) = (Vec3::zeros(), 0.0, 0.0_f64);
    for (plate, load) in loads {
        let Some(((center, half_m), load)) = plate.extent().zip(median(load.iter().copied())) else { continue };
        let newtons = load.max(0.0) * plate.units.force_n;
        moment += center * newtons;
        sum += newtons;
        reach_m = reach_m.max(half_m);
    }
    let Some(((plate, _), body)) = loads.first().and_then(|first| Some((first, first.0.body?))) else { return false };
    let away = body - moment / sum;
    plate.level_part(away).is_some_and(|level| level.norm() <= reach_m)
}

/// Reports reversed ORIGINs in one note for all plates: nearly every file of Vicon's programs has them.
fn report_reversed(turned: &[usize], plates: usize, findings: &mut Findings) {
    let which = match turned {
        [] => return,
        all if all.len() == plates => "every plate".to_owned(),
        [one] => format!("plate {one}"),
        some => format!("plates {}", some.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
    };
    let message = format!(
        "ORIGIN of {which} points from the surface down to the sensors, as many programs write it; it was reversed"
    );
    findings.report(Code::PlatesOriginTurned, message);
}

fn source(
    file: &C3d,
    platform: &Platform,
    unit_m: f64,
    body: Option<Vec3>,
    name: String,
) -> Result<PlateSource, String> {
    let channels = channels(file, platform)?;
    let samples = channels.first().map_or(0, |c| c.samples.len());
    if samples == 0 {
        return Err("it has no samples".to_owned());
    }
    if let Some(odd) = channels.iter().find(|c| c.samples.len() != file.analog_times().len()) {
        return Err(format!("its channel `{}` has {} samples, others {samples}", odd.name, odd.samples.len()));
    }
    if !(file.analog_rate_hz.is_finite() && file.analog_rate_hz > 0.0) {
        return Err(format!("its rate is {} Hz; expected a number above zero", file.analog_rate_hz));
    }
    Ok(PlateSource {
        name,
        number: platform.kind,
        corners: platform.corners.map(|c| Vec3::from(c) * unit_m),
        origin: Vec3::from(platform.origin) * unit_m,
        units: units_of(platform, &channels, unit_m),
        channels: channels.iter().map(|c| c.samples.clone()).collect(),
        calibration: platform.calibration.clone(),
        zero: platform.zero_frames.map(|frames| zero_samples(file, frames)),
        times: file.analog_times(),
        rate_hz: file.analog_rate_hz,
        assumed: None,
        body,
    })
}

/// The unit of length, corrected if the edges of the plates are implausible.
fn plausible_unit(platforms: &[Platform], stated_m: f64, findings: &mut Findings) -> f64 {
    let edge = |p: &Platform| (Vec3::from(p.corners[0]) - Vec3::from(p.corners[1])).norm();
    let mut edges: Vec<f64> = platforms.iter().map(edge).filter(|e| e.is_finite() && *e > 0.0).collect();
    sort_numbers(&mut edges);
    let Some(middle) = edges.get(edges.len() / 2) else { return stated_m };
    let fits = |unit_m: f64| (EDGE_M[0]..=EDGE_M[1]).contains(&(middle * unit_m));
    if fits(stated_m) {
        return stated_m;
    }
    let Some(factor) = UNIT_FACTORS.into_iter().find(|f| fits(stated_m * f)) else { return stated_m };
    let message = format!(
        "the force plates have edges of {:.4} m by the file's unit; lengths of plates were multiplied by {factor}",
        middle * stated_m
    );
    findings.report(Code::PlatesUnitChanged, message);
    stated_m * factor
}

/// Reports a Kistler polynomial, which would correct the centre of pressure by millimetres.
fn report_polynomial(file: &C3d, findings: &mut Findings) {
    if file.parameters.numbers("FORCE_PLATFORM", "FPCOPPOLY").iter().any(|x| x.abs() > 0.0) {
        let message = "the file has a polynomial that corrects the centre of pressure (FPCOPPOLY); it was not used";
        findings.report(Code::PlatesPolynomial, message);
    }
}

/// Reports forces in an unknown unit such as volts without a calibration matrix.
fn report_volts(file: &C3d, platform: &Platform, name: &str, findings: &mut Findings) {
    let unit = platform.channels.first().copied().flatten().and_then(|i| file.channels.get(i)).map(|c| c.unit.trim());
    let known = unit.is_none_or(|u| u.is_empty() || units::force_n(u).is_some());
    if !known && platform.calibration.is_empty() {
        let message = format!("the force of {name} is in `{}`; it was read as newtons", unit.unwrap_or_default());
        findings.report(Code::PlatesUnitUnknown, message);
    }
}

/// The channels of a plate, up to the first missing one.
fn channels<'a>(file: &'a C3d, platform: &Platform) -> Result<Vec<&'a Channel>, String> {
    let indices = platform.channels.iter().map_while(|i| *i);
    let find = |i: usize| file.channels.get(i).ok_or_else(|| format!("the file has no channel {}", i + 1));
    indices.map(find).collect()
}

/// The ZERO frames as samples, counted from the first frame of the file (unverified: the guide of the format states
/// `frames`, and trimmed files do not agree); a range with a loaded plate is not used in any case.
fn zero_samples(file: &C3d, [first, last]: [i64; 2]) -> Range<usize> {
    let frame = |n: i64| usize::try_from(n).unwrap_or(0) * file.samples_per_frame();
    frame(first - 1)..frame(last)
}

/// Units of the channels; without one, the unit of the moment follows from the unit of the points.
///
/// A calibration matrix converts volts to the units of the file, so the units of the channels are then not used for
/// the moment.
fn units_of(platform: &Platform, channels: &[&Channel], unit_m: f64) -> Units {
    let word = |i: usize| channels.get(i).map_or("", |c| c.unit.as_str());
    let force_n = units::force_n(word(0)).unwrap_or(1.0);
    let moment_channel = if platform.kind == 1 { 5 } else { 3 };
    let moment_nm = units::moment_nm(word(moment_channel)).unwrap_or(force_n * unit_m);
    let length_m = units::length_m(word(3)).unwrap_or(unit_m);
    Units { force_n, moment_nm, length_m }
}

/// Mean position of all visible markers, which are above the floor.
fn mean_marker(file: &C3d) -> Option<Vec3> {
    let markers = crate::motion::real_points::real_points(file);
    let seen = markers.iter().flat_map(|p| &p.positions).filter(|p| p.iter().all(|x| x.is_finite()));
    let (sum, count) = seen.fold((Vec3::zeros(), 0.0), |(s, n), p| (s + Vec3::from(*p), n + 1.0));
    (count > 0.0).then(|| sum / count)
}
