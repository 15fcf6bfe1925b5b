//! The changes that spoil a recording.

use super::faults::{HEELS, TOES};
use super::spoiled::Trial;
use ambulo_formats::c3d::{C3d, Channel, Platform, Point};
use std::collections::BTreeMap;

type Position = [f64; 3];

/// The plate with the largest loads shows what it showed in the first sample.
pub(super) fn plate_silent(trial: &mut Trial) -> Option<()> {
    let plate = most_loaded(&trial.moving)?;
    silence(&mut trial.moving, plate)
}

/// The plate with the largest loads.
fn most_loaded(file: &C3d) -> Option<usize> {
    let spread = |samples: &[f64]| {
        samples.iter().copied().fold(f64::MIN, f64::max) - samples.iter().copied().fold(f64::MAX, f64::min)
    };
    let largest = |plate: &Platform| {
        let channels = plate.channels.iter().flatten().filter_map(|index| file.channels.get(*index));
        channels.map(|channel| spread(&channel.samples)).fold(0.0, f64::max)
    };
    let platforms = file.platforms().ok()?;
    let loads = platforms.iter().map(largest).enumerate();
    loads.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(plate, _)| plate)
}

/// A plate shows what it showed in the first sample.
pub(super) fn silence(file: &mut C3d, plate: usize) -> Option<()> {
    let channels = file.platforms().ok()?.into_iter().nth(plate)?.channels;
    for index in channels.into_iter().flatten() {
        let samples = &mut file.channels.get_mut(index)?.samples;
        let first = *samples.first()?;
        samples.fill(first);
    }
    Some(())
}

/// Every plate also shows this share of what the plate before it measures, channel by channel.
pub(super) fn cross_talk(trial: &mut Trial, share: f64) -> Option<()> {
    let platforms = trial.moving.platforms().ok()?;
    let recorded = trial.moving.channels.clone();
    let mut pairs = 0;
    for plates in platforms.windows(2).filter(|plates| plates[0].kind == plates[1].kind) {
        for (from, to) in plates[0].channels.iter().flatten().zip(plates[1].channels.iter().flatten()) {
            let source = &recorded.get(*from)?.samples;
            let unloaded = *source.first()?;
            let samples = &mut trial.moving.channels.get_mut(*to)?.samples;
            samples.iter_mut().zip(source).for_each(|(sample, other)| *sample += share * (other - unloaded));
        }
        pairs += 1;
    }
    (pairs > 0).then_some(())
}

/// All channels this much later [s].
pub(super) fn delayed(trial: &mut Trial, delay_s: f64) -> Option<()> {
    let shift = (delay_s.abs() * trial.moving.analog_rate_hz).round() as usize;
    for Channel { samples, .. } in &mut trial.moving.channels {
        let (first, last, count) = (*samples.first()?, *samples.last()?, samples.len());
        let shift = shift.min(count);
        if delay_s > 0.0 {
            samples.rotate_right(shift);
            samples[..shift].fill(first);
        } else {
            samples.rotate_left(shift);
            samples[count - shift..].fill(last);
        }
    }
    Some(())
}

/// All markers show an earlier frame.
pub(super) fn held(trial: &mut Trial, shown: fn(usize) -> usize) -> Option<()> {
    for point in &mut trial.moving.points {
        let whole = point.clone();
        for frame in 0..whole.positions.len() {
            point.positions[frame] = whole.positions[shown(frame)];
            point.residuals[frame] = whole.residuals[shown(frame)];
        }
    }
    Some(())
}

/// All markers stand still from the middle of the walk on.
pub(super) fn frozen(trial: &mut Trial) -> Option<()> {
    let half = trial.moving.frames() / 2;
    for Point { positions, residuals, .. } in &mut trial.moving.points {
        let (position, residual) = (positions[half], residuals[half]);
        positions[half..].fill(position);
        residuals[half..].fill(residual);
    }
    Some(())
}

/// The file states rates that are this many times too high.
pub(super) fn clock(trial: &mut Trial, factor: f64) -> Option<()> {
    let file = &mut trial.moving;
    file.point_rate_hz *= factor;
    file.analog_rate_hz *= factor;
    Some(())
}

/// The corners of all plates in another order.
pub(super) fn corners(trial: &mut Trial, order: fn([Position; 4]) -> [Position; 4]) -> Option<()> {
    each_platform(&mut trial.moving, |plate| plate.corners = order(plate.corners))
}

fn each_platform(file: &mut C3d, change: impl FnMut(&mut Platform)) -> Option<()> {
    let mut platforms = file.platforms().ok().filter(|platforms| !platforms.is_empty())?;
    platforms.iter_mut().for_each(change);
    file.set_platforms(&platforms);
    Some(())
}

/// All channels of plates that measure forces and moments, times a factor.
pub(super) fn scaled(trial: &mut Trial, factor: f64) -> Option<()> {
    let platforms = trial.moving.platforms().ok()?;
    let channels: Vec<usize> = platforms.iter().flat_map(|plate| plate.channels.iter().copied().flatten()).collect();
    let is_volt = |index: &usize| trial.moving.channels.get(*index).is_none_or(|channel| channel.unit.starts_with('V'));
    if channels.is_empty() || channels.iter().any(is_volt) {
        return None;
    }
    for index in channels {
        trial.moving.channels.get_mut(index)?.samples.iter_mut().for_each(|sample| *sample *= factor);
    }
    Some(())
}

/// All channels of the plate with the largest loads times a factor.
pub(super) fn one_scaled(trial: &mut Trial, factor: f64) -> Option<()> {
    let platforms = trial.moving.platforms().ok().filter(|platforms| platforms.len() > 1)?;
    for index in platforms[most_loaded(&trial.moving)?].channels.iter().copied().flatten() {
        trial.moving.channels.get_mut(index)?.samples.iter_mut().for_each(|sample| *sample *= factor);
    }
    Some(())
}

/// A horizontal force of all plates with the wrong sign: along the walk, or across it.
pub(super) fn mirrored_force(trial: &mut Trial, is_along: bool) -> Option<()> {
    let walks_along = walked_axis(&trial.moving)?;
    multiplied(trial, -1.0, |plate| {
        let [a, b, ..] = plate.corners;
        let x_axis = usize::from((a[1] - b[1]).abs() > (a[0] - b[0]).abs());
        vec![usize::from((x_axis == walks_along) != is_along)]
    })
}

/// The horizontal forces of all plates times a factor.
pub(super) fn shear_scaled(trial: &mut Trial, factor: f64) -> Option<()> {
    multiplied(trial, factor, |_| vec![0, 1])
}

/// Horizontal forces times a factor, along the axes of each plate that `axes` names.
fn multiplied(trial: &mut Trial, factor: f64, axes: impl Fn(&Platform) -> Vec<usize>) -> Option<()> {
    let mut count = 0;
    for plate in trial.moving.platforms().ok()? {
        for axis in axes(&plate) {
            // Type 3 has two channels for each horizontal force.
            let channels = match plate.kind {
                2 | 4 => axis..axis + 1,
                3 => 2 * axis..2 * axis + 2,
                _ => continue,
            };
            for index in plate.channels.get(channels)?.iter().copied().flatten() {
                trial.moving.channels.get_mut(index)?.samples.iter_mut().for_each(|sample| *sample *= factor);
                count += 1;
            }
        }
    }
    (count > 0).then_some(())
}

/// All plates turned about their middles [deg].
pub(super) fn plates_turned(trial: &mut Trial, degrees: f64) -> Option<()> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    each_platform(&mut trial.moving, |plate| {
        let middle = [0, 1].map(|axis| plate.corners.iter().map(|corner| corner[axis]).sum::<f64>() / 4.0);
        for corner in &mut plate.corners {
            let [x, y] = [0, 1].map(|axis| corner[axis] - middle[axis]);
            (corner[0], corner[1]) = (middle[0] + x * cos - y * sin, middle[1] + x * sin + y * cos);
        }
    })
}

/// The axis of the laboratory, 0 or 1, along which the markers travel most.
fn walked_axis(file: &C3d) -> Option<usize> {
    let way = |axis: usize| {
        let travelled = |point: &Point| {
            let mut seen =
                point.positions.iter().filter(|place| place.iter().all(|value| value.is_finite() && value.abs() > 0.0));
            Some((seen.next_back()?[axis] - seen.next()?[axis]).abs())
        };
        let mut ways: Vec<f64> = file.points.iter().filter_map(travelled).collect();
        ways.sort_by(f64::total_cmp);
        ways.get(ways.len() / 2).copied()
    };
    Some(usize::from(way(1)? > way(0)?))
}

/// All labels of the left side on the right one, and the other way round.
pub(super) fn exchanged(file: &mut C3d) -> Option<()> {
    let names: Vec<String> = file.points.iter().map(|point| point.name.clone()).collect();
    let mut count = 0;
    for point in &mut file.points {
        if let Some(other) = mirror(&point.name).filter(|other| names.contains(other)) {
            point.name = other;
            count += 1;
        }
    }
    (count > 0).then_some(())
}

/// The same name on the other side.
fn mirror(name: &str) -> Option<String> {
    let (prefix, label) = name.rsplit_once(':').map_or(("", name), |(prefix, _)| name.split_at(prefix.len() + 1));
    let swapped = match label.as_bytes().first()? {
        b'L' => 'R',
        b'R' => 'L',
        b'l' => 'r',
        b'r' => 'l',
        _ => return None,
    };
    Some(format!("{prefix}{swapped}{}", &label[1..]))
}

/// Left-handed axes: the coordinate across the walk with the other sign, in markers and corners of both files.
pub(super) fn left_handed(trial: &mut Trial) -> Option<()> {
    let axis = 1 - walked_axis(&trial.moving)?;
    for file in trial.standing.iter_mut().chain([&mut trial.moving]) {
        for point in &mut file.points {
            point.positions.iter_mut().for_each(|position| position[axis] = -position[axis]);
        }
    }
    each_platform(&mut trial.moving, |plate| plate.corners.iter_mut().for_each(|corner| corner[axis] = -corner[axis]))
}

/// The first of these markers that is there, exchanged with its counterpart in the whole walk.
pub(super) fn pair(trial: &mut Trial, lefts: &[&str]) -> Option<()> {
    let points = &mut trial.moving.points;
    let place = |name: &str, points: &[Point]| points.iter().position(|point| bare(&point.name) == name);
    let left = lefts.iter().find_map(|name| place(name, points))?;
    let right = place(bare(&mirror(&points[left].name)?), points)?;
    let name = std::mem::take(&mut points[left].name);
    points[left].name = std::mem::replace(&mut points[right].name, name);
    Some(())
}

pub(super) fn bare(name: &str) -> &str {
    name.rsplit_once(':').map_or(name, |(_, label)| label)
}

/// A direction on the body: along the foot, from heel to toe, or away from another marker.
pub(super) enum Way<'a> {
    Forward,
    Backward,
    AwayFrom(&'a [&'a str]),
}

/// A marker sits this far from its place in the whole walk [mm].
pub(super) fn moved(trial: &mut Trial, names: &[&str], way: Way<'_>, distance_mm: f64) -> Option<()> {
    trial.standing.as_ref()?;
    let units = distance_mm * 1e-3 / trial.moving.metres_per_unit()?;
    let points = &trial.moving.points;
    let of = |names: &[&str]| points.iter().position(|point| names.contains(&bare(&point.name)));
    let path = |names: &[&str]| Some(points[of(names)?].positions.clone());
    let own = of(names)?;
    let [from, to] = match way {
        Way::Forward => [path(HEELS)?, path(TOES)?],
        Way::Backward => [path(TOES)?, path(HEELS)?],
        Way::AwayFrom(other) => [path(other)?, points[own].positions.clone()],
    };
    for (position, (from, to)) in trial.moving.points[own].positions.iter_mut().zip(from.into_iter().zip(to)) {
        let way = [0, 1, 2].map(|axis| to[axis] - from[axis]);
        let length = way.iter().map(|part| part * part).sum::<f64>().sqrt();
        for (value, part) in position.iter_mut().zip(way) {
            *value += units * part / length;
        }
    }
    Some(())
}

/// Somebody else's standing trial with the same markers.
pub(super) fn other_stands(trial: &mut Trial) -> Option<()> {
    let (own, other) = (trial.standing.as_ref()?, trial.other.standing.clone()?);
    let has = |point: &&Point| other.points.iter().any(|known| bare(&known.name) == bare(&point.name));
    // Markers of another laboratory are refused with their names.
    let are_same = 2 * own.points.iter().filter(has).count() > own.points.len();
    trial.standing = Some(other);
    are_same.then_some(())
}

/// Another person's walk beside this one's.
pub(super) fn two_people(trial: &mut Trial) -> Option<()> {
    let (frames, other) = (trial.moving.frames(), trial.other.moving.clone());
    if trial.moving.point_unit != other.point_unit {
        return None;
    }
    for point in &mut trial.moving.points {
        point.name = format!("Anna:{}", bare(&point.name));
    }
    let side_m = 2.0 / other.metres_per_unit()?;
    let beside = |position: &Position| [position[0] + side_m, position[1] + side_m, position[2]];
    let other_points: BTreeMap<_, _> = other.points.iter().map(|point| (bare(&point.name), point)).collect();
    for (name, point) in other_points {
        let last = point.positions.last()?;
        let shown = |frame: usize| beside(point.positions.get(frame).unwrap_or(last));
        trial.moving.points.push(Point::new(&format!("Berta:{name}"), (0..frames).map(shown).collect()));
    }
    Some(())
}

/// The first of these markers that is there is taken away.
pub(super) fn without(file: &mut C3d, names: &[&str]) -> Option<()> {
    let index = file.points.iter().position(|point| names.contains(&bare(&point.name)))?;
    file.points.remove(index);
    Some(())
}

/// The first of these markers on a straight line at constant speed, for a fifth of the recording from 40 % of it on.
pub(super) fn drawn(file: &mut C3d, names: &[&str]) -> Option<()> {
    let path = &mut file.points.iter_mut().find(|point| names.contains(&bare(&point.name)))?.positions;
    let (from, frames) = (2 * path.len() / 5, path.len() / 5);
    let [first, last] = [*path.get(from)?, *path.get(from + frames)?];
    for (i, place) in path[from..from + frames].iter_mut().enumerate() {
        *place = [0, 1, 2].map(|axis| first[axis] + (last[axis] - first[axis]) * i as f64 / frames as f64);
    }
    // A gap at one end was not filled.
    first.iter().chain(&last).all(|value| value.is_finite() && value.abs() > 0.0).then_some(())
}

/// All plates this far elsewhere, along the walk or across it [mm].
pub(super) fn plates_moved(trial: &mut Trial, is_along: bool, distance_mm: f64) -> Option<()> {
    let along = walked_axis(&trial.moving)?;
    let axis = if is_along { along } else { 1 - along };
    let units = distance_mm * 1e-3 / trial.moving.metres_per_unit()?;
    each_platform(&mut trial.moving, |plate| plate.corners.iter_mut().for_each(|corner| corner[axis] += units))
}

/// The first of these pairs of markers of one limb that is there has exchanged labels.
pub(super) fn along_limb(file: &mut C3d, pairs: &[[&str; 2]]) -> Option<()> {
    let number = |name: &str| file.points.iter().position(|point| bare(&point.name) == name);
    let [a, b] = pairs.iter().find_map(|[a, b]| Some([number(a)?, number(b)?]))?;
    let name = std::mem::take(&mut file.points[a].name);
    file.points[a].name = std::mem::replace(&mut file.points[b].name, name);
    Some(())
}

/// The corners of the first plate alone in another order.
pub(super) fn corners_of_one(trial: &mut Trial, order: fn([Position; 4]) -> [Position; 4]) -> Option<()> {
    let mut count = 0;
    each_platform(&mut trial.moving, |plate| {
        if count == 0 {
            plate.corners = order(plate.corners);
        }
        count += 1;
    })
}
