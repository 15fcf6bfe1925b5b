//! Writes a synthetic walk as a laboratory recording: a C3D file with Plug-in-Gait markers and a force plate under
//! every step.
//!
//! Laboratory: millimetres, x to the right, y along the walk, z up. A plate is of type 2: forces on the foot [N] and
//! moments about a sensor [N.mm] below the middle of its surface, in its own axes that look down: x_p = -x, y_p = y,
//! z_p = -z. With o from the sensor to the surface's middle the sensor's moment is M - F × o, M being that about the
//! middle. The data are synthetic, without noise.
//! Pinned by: ambulo-cli/tests/exchange.rs of the command

use super::folder::ExchangeError;
use ambulo::kinematics::{Trajectory, each_body_motion};
use ambulo::model::anthropometry::Human;
use ambulo::model::marker_set::MarkerSet;
use ambulo::model::{Marker, Model, Side};
use ambulo::motion::{ForceRecording, MarkerPath, MarkerRecording, TimeGrid, interpolate};
use ambulo::numerics::Order;
use ambulo::spatial::{Mat3, Vec3};
use ambulo_formats::c3d::{C3d, Channel, Event, Parameter, Platform, Point, Values};

/// Analog samples in a frame.
const SAMPLES: usize = 10;
/// Breadth across the walk and length along it [m].
const PLATE: [f64; 2] = [0.5, 0.6];
/// The sensor below the surface [m].
const SENSOR_DEPTH: f64 = 0.04;
/// A foot is on the ground above this load [N].
const LOADED_N: f64 = 20.0;
/// Shorter loads are not steps [s].
const SHORTEST: f64 = 0.1;
const MILLIMETRES: f64 = 1000.0;

/// The recording of a walk: markers of the figure, forces on its feet (world axes, about given points), one plate per
/// contact.
///
/// # Errors
/// A built-in marker set that cannot be read, which a test rules out.
pub fn laboratory_recording(
    human: &Human,
    trajectory: &Trajectory,
    loads: &[ForceRecording],
) -> Result<C3d, ExchangeError> {
    let mut c3d = recording(human, trajectory)?;
    let times = analog_times(trajectory.grid());
    let mut platforms = Vec::new();
    for side in Side::BOTH {
        let is_own = |load: &&ForceRecording| human.model.anatomy().body_side(load.body) == Some(side);
        // Rear foot and toes are on one plate.
        let load = Load::sum(loads.iter().filter(is_own).map(|load| Load::on(load, &times)), times.len());
        for [from, to] in load.contacts(&times) {
            let middle = load.mean_place(from, to);
            platforms.push(plate(&mut c3d, &load, middle, from, to));
            add_events(&mut c3d, side, &times, from, to);
        }
    }
    c3d.events.sort_by_number(|event| event.time_s);
    c3d.set_platforms(&platforms);
    Ok(c3d)
}

/// The figure standing upright and still for half a second, both feet on one plate.
///
/// # Errors
/// A built-in marker set that cannot be read, which a test rules out.
pub fn standing_recording(human: &Human, rate_hz: f64) -> Result<C3d, ExchangeError> {
    let frames = (0.5 * rate_hz).ceil().max(2.0) as usize;
    let grid = TimeGrid { start_s: 0.0, step_s: 1.0 / rate_hz, frames };
    let still = |value: f64| [vec![value; frames], vec![0.0; frames], vec![0.0; frames]];
    let columns = human.model.coordinates().iter().map(|coordinate| still(coordinate.default_value)).collect();
    let trajectory = Trajectory::new(&human.model, grid, columns)?;
    let mut c3d = recording(human, &trajectory)?;
    let mut center = Vec3::zeros();
    each_body_motion(&human.model, &trajectory, |_, bodies| {
        let weighed = human.model.bodies().iter().zip(bodies).map(|(body, motion)| motion.center * body.inertia.mass());
        center = weighed.sum::<Vec3>() / human.model.mass();
    });
    let samples = analog_times(grid).len();
    let place = Vec3::new(center.x, 0.0, center.z);
    let force = vec![-human.model.gravity() * human.model.mass(); samples];
    let moment = force.iter().map(|force| place.cross(force)).collect();
    let platform = plate(&mut c3d, &Load { force, moment }, place, 0, samples);
    c3d.set_platforms(&[platform]);
    Ok(c3d)
}

/// Markers, body mass and stature.
fn recording(human: &Human, trajectory: &Trajectory) -> Result<C3d, ExchangeError> {
    let grid = trajectory.grid();
    let rate_hz = 1.0 / grid.step_s;
    let markers = MarkerSet::named("plug-in-gait")?.on(human);
    let mut c3d = C3d::new(rate_hz, "mm");
    c3d.first_frame = (grid.start_s * rate_hz).round() as i64 + 1;
    c3d.points = points(human, trajectory, &markers);
    c3d.analog_rate_hz = rate_hz * SAMPLES as f64;
    let number = |value: f64| Values::Reals(vec![value as f32]);
    c3d.parameters.set("PROCESSING", Parameter::single("Bodymass", number(human.build.mass)));
    c3d.parameters.set("PROCESSING", Parameter::single("Height", number(human.build.height * MILLIMETRES)));
    let software = Values::Texts(vec!["Ambulo (synthetic)".to_owned()]);
    c3d.parameters.set("MANUFACTURER", Parameter::single("SOFTWARE", software));
    Ok(c3d)
}

fn points(human: &Human, trajectory: &Trajectory, markers: &[Marker]) -> Vec<Point> {
    let turn = in_laboratory() * MILLIMETRES;
    let paths = marker_paths(&human.model, trajectory, markers).rotated(&turn).markers;
    let point = |path: MarkerPath| Point::new(&path.name, path.positions.into_iter().map(Into::into).collect());
    paths.into_iter().map(point).collect()
}

/// Marker trajectories of a moving model, in world axes.
#[must_use]
pub fn marker_paths(model: &Model, trajectory: &Trajectory, markers: &[Marker]) -> MarkerRecording {
    let grid = trajectory.grid();
    let empty = |marker: &Marker| MarkerPath { name: marker.name.clone(), positions: Vec::with_capacity(grid.frames) };
    let mut paths: Vec<MarkerPath> = markers.iter().map(empty).collect();
    each_body_motion(model, trajectory, |_, bodies| {
        for (marker, path) in markers.iter().zip(&mut paths) {
            let pose = marker.body.map(|body| bodies[body.index()].pose);
            path.positions.push(pose.map_or(marker.location, |pose| pose.place(marker.location)));
        }
    });
    let name = model.name().to_owned();
    MarkerRecording { name, rate_hz: 1.0 / grid.step_s, times: grid.times(), markers: paths }
}

/// x to the right, y forward, z up.
fn in_laboratory() -> Mat3 {
    Mat3::from_rows(&[Vec3::z().transpose(), Vec3::x().transpose(), Vec3::y().transpose()])
}

fn analog_times(grid: TimeGrid) -> Vec<f64> {
    let step = grid.step_s / SAMPLES as f64;
    (0..grid.frames * SAMPLES).map(|sample| grid.start_s + sample as f64 * step).collect()
}

/// A load at the analog samples: force, and its moment about the world's origin.
struct Load {
    force: Vec<Vec3>,
    moment: Vec<Vec3>,
}

impl Load {
    fn on(recording: &ForceRecording, times: &[f64]) -> Load {
        let about_origin: Vec<Vec3> = recording
            .force
            .iter()
            .zip(&recording.point)
            .zip(&recording.moment)
            .map(|((force, point), moment)| moment + finite(point).cross(force))
            .collect();
        let series = |vectors: &[Vec3]| {
            let axis = |axis: usize| vectors.iter().map(|v| v[axis]).collect::<Vec<f64>>();
            let axes = [axis(0), axis(1), axis(2)];
            let at = |time: f64| Vec3::from(axes.each_ref().map(|values| interpolate(&recording.times, values, time)));
            times.iter().map(|&time| finite(&at(time))).collect()
        };
        Load { force: series(&recording.force), moment: series(&about_origin) }
    }

    fn sum(parts: impl Iterator<Item = Load>, samples: usize) -> Load {
        let mut whole = Load { force: vec![Vec3::zeros(); samples], moment: vec![Vec3::zeros(); samples] };
        for part in parts {
            whole.force.iter_mut().zip(&part.force).for_each(|(sum, force)| *sum += force);
            whole.moment.iter_mut().zip(&part.moment).for_each(|(sum, moment)| *sum += moment);
        }
        whole
    }

    /// Half-open ranges of samples in which the foot is on the ground.
    fn contacts(&self, times: &[f64]) -> Vec<[usize; 2]> {
        let mut contacts: Vec<[usize; 2]> = Vec::new();
        for sample in (0..times.len()).filter(|&sample| self.force[sample].y > LOADED_N) {
            match contacts.last_mut() {
                Some(contact) if contact[1] == sample => contact[1] = sample + 1,
                _ => contacts.push([sample, sample + 1]),
            }
        }
        contacts.retain(|&[from, to]| times[to - 1] - times[from] > SHORTEST);
        contacts
    }

    /// Middle between the furthest places of the centre of pressure on the ground y = 0.
    fn mean_place(&self, from: usize, to: usize) -> Vec3 {
        let place = |sample: usize| {
            let (force, moment) = (self.force[sample], self.moment[sample]);
            Vec3::new(moment.z / force.y, 0.0, -moment.x / force.y)
        };
        let places = || (from..to).map(place);
        let low = places().fold(Vec3::repeat(f64::INFINITY), |a, b| a.inf(&b));
        let high = places().fold(Vec3::repeat(f64::NEG_INFINITY), |a, b| a.sup(&b));
        (low + high) / 2.0
    }
}

/// Replaces NaN by zero.
fn finite(v: &Vec3) -> Vec3 {
    v.map(|x| if x.is_finite() { x } else { 0.0 })
}

/// A plate around a point, with six channels that are zero except from sample `from` to `to`, including the edges of
/// the load.
fn plate(c3d: &mut C3d, load: &Load, middle: Vec3, from: usize, to: usize) -> Platform {
    let plate_from_lab = Mat3::from_diagonal(&Vec3::new(-1.0, 1.0, -1.0));
    let to_surface = -Vec3::z() * SENSOR_DEPTH;
    let edge = |sample: usize, near: usize| sample.abs_diff(near) <= SAMPLES;
    let mut channels = vec![vec![0.0; load.force.len()]; 6];
    for sample in 0..load.force.len() {
        let inside = (from..to).contains(&sample) || edge(sample, from) || edge(sample, to);
        if !inside {
            continue;
        }
        let about_middle = load.moment[sample] - middle.cross(&load.force[sample]);
        let force = plate_from_lab * in_laboratory() * load.force[sample];
        let moment = plate_from_lab * in_laboratory() * about_middle - force.cross(&to_surface);
        for (channel, value) in channels.iter_mut().zip(force.iter().chain((moment * MILLIMETRES).iter())) {
            channel[sample] = *value;
        }
    }
    let first = c3d.channels.len();
    let number = first / 6 + 1;
    for (name, (unit, samples)) in ["Fx", "Fy", "Fz", "Mx", "My", "Mz"]
        .into_iter()
        .zip(["N", "N", "N", "Nmm", "Nmm", "Nmm"].into_iter().zip(channels))
    {
        c3d.channels.push(Channel::new(&format!("{name}{number}"), unit, samples));
    }
    let center = in_laboratory() * middle;
    let corner = |x: f64, y: f64| ((center + Vec3::new(x * PLATE[0], y * PLATE[1], 0.0) / 2.0) * MILLIMETRES).into();
    Platform {
        kind: 2,
        corners: [corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)],
        origin: (to_surface * MILLIMETRES).into(),
        channels: (first..first + 6).map(Some).collect(),
        calibration: Vec::new(),
        zero_frames: None,
    }
}

fn add_events(c3d: &mut C3d, side: Side, times: &[f64], from: usize, to: usize) {
    let context = match side {
        Side::Right => "Right",
        Side::Left => "Left",
    };
    // A foot on the ground at an end of the recording has no foot strike or foot off there.
    if from > 0 {
        c3d.events.push(Event::new("Foot Strike", context, times[from]));
    }
    if to < times.len() {
        c3d.events.push(Event::new("Foot Off", context, times[to]));
    }
}
