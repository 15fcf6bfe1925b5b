//! Finds forces with a wrong sign, direction or size.
//!
//! In every step the force of the ground leads nearly from the centre of pressure to the mass centre ([`LeverRule`]); r
//! is the agreement over the loaded frames of whole steps. In 111 clean recordings of walking and running r is 0.8 to
//! 1.0 along the walk, and across it 0.06 to 0.99 in single steps, 0.4 or more over the steps of a recording. A force
//! with the wrong sign has -r.
//!
//! Newton's law is the second witness where all feet are measured: with the right sign Σ F = m a. A direction is called
//! wrong only if the other sign does not fit the acceleration of the mass centre worse.
//!
//! A force of another size, or turned by some degrees, needs both witnesses. On 222 plates of recordings that are used
//! as clean the fore-aft force is 0.65 to 1.3 of the expected one (median 0.83) on all but 12, and turned by less than
//! 11 degrees on all but 5; why those differ is not known. No correction of them makes the residual of Newton's law as
//! small as [`FITS_BETTER`]. `cargo xtask twins` counts how many wrong ones are named.
//!
//! Pinned by: tests/quality.rs, ambulo-cli/tests/plates.rs

mod unequal;

use super::observation::{Observation, Origin};
use super::origin::ForceOrigin;
use crate::analysis::feasibility::{Check, Verdict};
use crate::findings::{Code, Findings};
use crate::ground::LeverRule;
use crate::ground::phases::contacts_from_force;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::Model;
use crate::motion::{ForceRecording, TimeGrid};
use crate::numerics::elementary::{atan2, cos, sin};
use crate::spatial::Vec3;
use std::f64::consts::PI;

/// A direction is wrong if its agreement is below this: clean recordings stay above it, most wrong signs fall below.
pub(super) const WRONG: f64 = -0.5;
/// A plate is wrong together with all others if its own agreement is below this.
const WRONG_TOGETHER: f64 = -0.2;
/// Turned forces agree with the expected ones by this when they are turned back.
const TURNED: f64 = 0.8;
/// ... and by less than this as they are.
const NOT_TURNED: f64 = 0.5;
/// Horizontal forces below this share of the weight, rms, show no direction.
const SHOWN_BW: f64 = 0.012;
/// Shortest and longest step [s]; in a longer one, of a person who walks very slowly, the body passes over the foot. A
/// person who stands with feet apart may push them sideways.
const STEP_S: [f64; 2] = [0.15, 1.5];
const SLOW_STEP_S: f64 = 4.0;
/// The mass centre passes over a foot if it travels further than a foot is long while the foot is loaded [m]; a person
/// who stands sways by a few centimetres.
const PASSES_M: f64 = 0.3;
/// Frames with less vertical load, as a share of the weight, are left out: the centre of pressure is uncertain.
const LOADED_BW: f64 = 0.1;
/// The vertical forces of all feet are complete if they fit the motion within this share of the weight.
const COMPLETE_BW: f64 = 0.15;
/// Fewer complete frames do not judge a sign.
const FEWEST_FRAMES: usize = 10;
/// Fore-aft forces of people as a share of the expected ones: least, usual and most.
const GAIN: [f64; 3] = [0.65, 0.83, 1.3];
/// Directions of the forces of people differ by at most this from the expected ones [rad].
const MOST_TURN: f64 = 10.0 * PI / 180.0;
/// The squared residual falls below this share if a wrong size is corrected, and if a wrong direction is.
const FITS_BETTER: [f64; 2] = [0.9, 0.8];
/// The squared residual may grow by this factor through errors of the motion when a wrong sign is corrected.
const NOT_WORSE: f64 = 1.2;

/// Directions of the horizontal forces that are wrong.
#[derive(Debug, Clone, Default)]
pub(super) struct ForceDirections {
    /// One sentence per wrong direction, with its agreement.
    faults: Vec<(String, f64)>,
    /// One sentence per fault of size or of some degrees, with its code.
    misfits: Vec<(Code, String)>,
}

/// The body over time.
struct Body {
    grid: TimeGrid,
    up: Vec3,
    weight_n: f64,
    /// The mass centre [m].
    center: Vec<Vec3>,
    /// What the ground must supply: m (a - g) [N].
    needed: Vec<Vec3>,
}

/// Forces of one plate, or one load of a table.
struct Sensor<'a> {
    name: &'a str,
    /// Horizontal unit vectors with the vertical down as their product: x and y of a plate, x and z of a table.
    axes: [Vec3; 2],
    is_plate: bool,
    forces: Vec<&'a ForceRecording>,
    sums: Sums,
}

/// Sums over the loaded frames of whole steps, by axis.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    lever: LeverRule,
    frames: usize,
    steps: usize,
}

/// The change of a horizontal force after which it leads to the mass centre as it does in other people.
#[derive(Debug, Clone, Copy)]
struct Correction {
    /// The fore-aft force as a share of the expected one.
    gain: f64,
    /// Factor by which the change multiplies the horizontal force.
    factor: f64,
    /// The angle by which it is turned to the left [rad].
    left: f64,
}

/// A fault in the horizontal force of a sensor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Fault {
    /// The component along an axis has the wrong sign.
    Flipped(usize),
    /// The force agrees after it is turned to the left by this number of right angles.
    Turned(usize),
    /// The components along both axes are exchanged.
    Exchanged,
}

impl ForceDirections {
    pub(super) fn of(observed: &Observation, trajectory: &Trajectory) -> ForceDirections {
        if observed.forces.is_empty() || matches!(observed.origin, Origin::Simulation { .. }) {
            return ForceDirections::default();
        }
        let body = Body::new(&observed.model, trajectory);
        let mut sensors = sensors(observed, body.up);
        for sensor in &mut sensors {
            sensor.sums = body.steps(sensor);
        }
        let turned = sensors.iter().enumerate().filter_map(|(k, sensor)| Some((k, sensor.sums.turned_fault(&body)?)));
        let mut found: Vec<(usize, Fault)> = turned.collect();
        let flipped = body.flipped(&sensors, &found);
        if body.fits_newton(&sensors, &flipped) {
            found.extend(flipped);
        }
        let mut misfits = body.misfits(&sensors, &found);
        misfits.extend(unequal::unequal(&body, &sensors));
        ForceDirections { faults: sentences(&sensors, &found), misfits }
    }

    pub(super) fn report(&self, findings: &mut Findings) {
        for (sentence, _) in &self.faults {
            findings.report(Code::PlatesMirrored, sentence.clone());
        }
        for (code, sentence) in &self.misfits {
            findings.report(*code, sentence.clone());
        }
    }

    /// The verdict, which judges the movement and not faulty data.
    pub(super) fn set_aside(&self, mut verdict: Verdict, force_origin: &ForceOrigin) -> Verdict {
        let misfit = self.misfits.first().map(|(_, sentence)| sentence.as_str());
        let fault = self.worst().map(|(sentence, _)| sentence).or(misfit);
        if let Some(sentence) = fault.filter(|_| is_used(force_origin)) {
            verdict.set_aside(|reason| reason.check != Check::Range, sentence.to_owned());
        }
        verdict
    }

    /// The worst agreement with its sentence; `None` if nothing is wrong.
    pub(super) fn worst(&self) -> Option<(&str, f64)> {
        let (sentence, agreement) = self.faults.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some((sentence, *agreement))
    }
}

/// Whether the measured forces are in the results.
pub(super) fn is_used(force_origin: &ForceOrigin) -> bool {
    !matches!(force_origin, ForceOrigin::Predicted { .. })
}

impl Body {
    fn new(model: &Model, trajectory: &Trajectory) -> Body {
        let frames = trajectory.grid().frames;
        let (mut center, mut needed) = (Vec::with_capacity(frames), Vec::with_capacity(frames));
        let mass = model.mass();
        each_body_motion(model, trajectory, |_, bodies| {
            let weighted = |of: &dyn Fn(usize) -> Vec3| -> Vec3 {
                model.bodies().iter().enumerate().map(|(i, body)| of(i) * body.inertia.mass()).sum()
            };
            center.push(weighted(&|i| bodies[i].center) / mass);
            needed.push(weighted(&|i| bodies[i].acceleration.linear) - model.gravity() * mass);
        });
        let weight_n = mass * model.gravity().norm();
        Body { grid: trajectory.grid(), up: model.up(), weight_n, center, needed }
    }

    /// The sums of a sensor over its whole steps.
    fn steps(&self, sensor: &Sensor<'_>) -> Sums {
        let mut sums = Sums::default();
        for force in &sensor.forces {
            let vertical: Vec<f64> = force.force.iter().map(|f| f.dot(&self.up)).collect();
            let (Some(&first), Some(&last)) = (force.times.first(), force.times.last()) else { continue };
            let whole = contacts_from_force(&force.times, &vertical).into_iter();
            // A step may be cut by one end of the recording; a person who stands is cut by both.
            for [from, to] in whole.filter(|c| c.strike_s.or(c.off_s).is_some()).map(|c| c.span(first, last)) {
                let inside: Vec<usize> =
                    (0..self.grid.frames).filter(|i| (from..=to).contains(&self.grid.time(*i))).collect();
                if !self.is_step(to - from, &inside) {
                    continue;
                }
                let before = sums.frames;
                inside.iter().for_each(|frame| self.add(&mut sums, force, *frame, sensor.axes));
                sums.steps += usize::from(sums.frames > before);
            }
        }
        sums
    }

    /// Whether a foot that is loaded for so long, in these frames, makes a step.
    fn is_step(&self, duration_s: f64, frames: &[usize]) -> bool {
        let passes = || {
            let ends = frames.first().zip(frames.last());
            ends.is_some_and(|(first, last)| {
                let way = self.center[*last] - self.center[*first];
                (way - self.up * self.up.dot(&way)).norm() > PASSES_M
            })
        };
        let [shortest_s, longest_s] = STEP_S;
        duration_s >= shortest_s && (duration_s <= longest_s || duration_s <= SLOW_STEP_S && passes())
    }

    fn add(&self, sums: &mut Sums, force: &ForceRecording, frame: usize, axes: [Vec3; 2]) {
        let sample = sample_at(force, self.grid.time(frame));
        let (measured, vertical) = (force.force[sample], force.force[sample].dot(&self.up));
        if vertical < LOADED_BW * self.weight_n {
            return;
        }
        let pressure = force.point[sample] + self.up.cross(&force.moment[sample]) / vertical;
        let is_added = sums.lever.add(measured, self.center[frame] - pressure, self.up, axes);
        sums.frames += usize::from(is_added);
    }

    /// Components with the wrong sign, by sensor; turned sensors are left out.
    fn flipped(&self, sensors: &[Sensor<'_>], turned: &[(usize, Fault)]) -> Vec<(usize, Fault)> {
        let is_turned = |k: usize| turned.iter().any(|(other, _)| *other == k);
        let least_n = SHOWN_BW * self.weight_n;
        let mut found = Vec::new();
        for axis in 0..2 {
            let shown = || sensors.iter().enumerate().filter(|(k, s)| !is_turned(*k) && s.sums.shows(axis, least_n));
            let together = shown().fold(Sums::default(), |sum, (_, s)| sum.with(&s.sums)).agreement(axis);
            let limit = if together < WRONG { WRONG_TOGETHER } else { WRONG };
            let wrong = shown().filter(|(_, s)| s.sums.agreement(axis) < limit);
            found.extend(wrong.map(|(k, _)| (k, Fault::Flipped(axis))));
        }
        found
    }

    /// Whether the forces fit the acceleration of the mass centre no worse with the other signs, or too few frames show
    /// it.
    fn fits_newton(&self, sensors: &[Sensor<'_>], flipped: &[(usize, Fault)]) -> bool {
        let corrected = |k: usize, force: Vec3| {
            let signs = flipped.iter().filter(|(other, _)| *other == k).filter_map(|(_, fault)| fault.axis());
            let axes = signs.map(|axis| sensors[k].axes[axis]);
            force - axes.map(|axis| axis * (2.0 * force.dot(&axis))).sum::<Vec3>()
        };
        self.residual_ratio(sensors, None, &corrected).is_none_or(|ratio| ratio < NOT_WORSE)
    }

    /// The squared residual of the level forces after a correction of each sensor's force over that before it, in
    /// complete frames, and if a sensor is given only under its load. `None` if too few frames show it.
    fn residual_ratio(
        &self,
        sensors: &[Sensor<'_>],
        loaded: Option<usize>,
        corrected: &dyn Fn(usize, Vec3) -> Vec3,
    ) -> Option<f64> {
        let (mut before, mut after, mut frames) = (0.0, 0.0, 0);
        for frame in 0..self.grid.frames {
            let forces: Vec<Vec3> = sensors.iter().map(|sensor| sensor.total_at(self.grid.time(frame))).collect();
            let residual = self.needed[frame] - forces.iter().sum::<Vec3>();
            let is_complete = residual.dot(&self.up).abs() < COMPLETE_BW * self.weight_n;
            if is_complete && loaded.is_none_or(|k| forces[k].dot(&self.up) > LOADED_BW * self.weight_n) {
                let others = forces.iter().enumerate().map(|(k, force)| corrected(k, *force)).sum::<Vec3>();
                before += self.level(residual).norm_squared();
                after += self.level(self.needed[frame] - others).norm_squared();
                frames += 1;
            }
        }
        (frames >= FEWEST_FRAMES).then_some(after / before)
    }

    fn level(&self, v: Vec3) -> Vec3 {
        v - self.up * self.up.dot(&v)
    }

    /// Horizontal forces of another size or direction than both witnesses expect; those with another fault are left
    /// out. All are corrected together, because two feet are loaded at a time.
    fn misfits(&self, sensors: &[Sensor<'_>], found: &[(usize, Fault)]) -> Vec<(Code, String)> {
        let is_open = |k: usize| found.iter().all(|(other, _)| *other != k);
        let of = |(k, sensor)| if is_open(k) { self.correction(sensor) } else { None };
        let corrections: Vec<Option<Correction>> = sensors.iter().enumerate().map(of).collect();
        let corrected = |k: usize, force: Vec3| {
            let Some(Correction { factor, left, .. }) = corrections[k] else { return force };
            let level = self.level(force);
            force - level + (level * cos(left) + self.up.cross(&level) * sin(left)) * factor
        };
        let found = |(k, correction): (usize, &Option<Correction>)| {
            let correction = correction.as_ref()?;
            let ratio = self.residual_ratio(sensors, Some(k), &corrected)?;
            (ratio < FITS_BETTER[usize::from(correction.left.abs() > 0.0)]).then(|| correction.finding(&sensors[k]))
        };
        corrections.iter().enumerate().filter_map(found).collect()
    }

    /// The change that a horizontal force needs by its direction alone; `None` if it needs none, or is too small to
    /// tell.
    fn correction(&self, sensor: &Sensor<'_>) -> Option<Correction> {
        let along = usize::from(sensor.axes[1].x.abs() > sensor.axes[0].x.abs());
        if !sensor.sums.shows(along, SHOWN_BW * self.weight_n) {
            return None;
        }
        let (gain, turn) = (sensor.sums.gain(along), sensor.sums.turn());
        let [least, usual, most] = GAIN;
        match (least..=most).contains(&gain) {
            false => Some(Correction { gain, factor: usual / gain, left: 0.0 }),
            // The product of the axes points down, so that a turn from one to the other is one to the right.
            true => (turn.abs() > MOST_TURN).then_some(Correction { gain, factor: 1.0, left: turn }),
        }
    }
}

impl Correction {
    fn finding(&self, sensor: &Sensor<'_>) -> (Code, String) {
        let Correction { gain, factor, left } = *self;
        let (name, [least, _, most]) = (names(&[sensor]), GAIN);
        if left.abs() > 0.0 {
            let place = if sensor.is_plate { "the corners of the plate in the file" } else { "the axes of the table" };
            let message = format!(
                "the horizontal force of {name} is turned to the {} by {:.0} deg: turned back it leads to the mass \
                 centre and fits its acceleration better. hint: check {place}",
                if left > 0.0 { "right" } else { "left" },
                left.abs().to_degrees()
            );
            return (Code::PlatesSkewed, message);
        }
        let message = format!(
            "the fore-aft force of {name} is {gain:.2} of the one that leads from its centre of pressure to the mass \
             centre ({least} to {most} in people), and {factor:.1} times the horizontal force fits the acceleration of \
             the mass centre better. hint: check sensitivity and calibration matrix of the channels"
        );
        (Code::PlatesShearGain, message)
    }
}

impl Fault {
    /// The axis whose sign is wrong.
    fn axis(self) -> Option<usize> {
        match self {
            Fault::Flipped(axis) => Some(axis),
            Fault::Turned(_) | Fault::Exchanged => None,
        }
    }
}

impl Sums {
    fn agreement(&self, axis: usize) -> f64 {
        self.lever.agreement(axis)
    }

    /// Agreement of both components, after the measured force is turned to the left by quarters: (Fx, Fy) to (Fy, -Fx).
    fn turned(&self, quarters: usize) -> f64 {
        let [[xx, xy], [yx, yy]] = self.lever.products;
        [xx + yy, xy - yx, -xx - yy, yx - xy][quarters % 4] / self.size()
    }

    /// Agreement of both components, after they are exchanged: (Fx, Fy) to (Fy, Fx).
    fn exchanged(&self) -> f64 {
        (self.lever.products[0][1] + self.lever.products[1][0]) / self.size()
    }

    /// What a product of both components is divided by.
    fn size(&self) -> f64 {
        (self.lever.expected.iter().sum::<f64>() * self.lever.measured.iter().sum::<f64>()).sqrt()
    }

    /// The measured component along an axis as a share of the expected one.
    fn gain(&self, axis: usize) -> f64 {
        (self.lever.measured[axis] / self.lever.expected[axis]).sqrt()
    }

    /// The angle from the expected to the measured force, from the first axis to the second [rad].
    fn turn(&self) -> f64 {
        let [[xx, xy], [yx, yy]] = self.lever.products;
        atan2(xy - yx, xx + yy)
    }

    /// The rotation of the force, if it is rotated. Half a turn counts as two wrong signs.
    fn turned_fault(&self, body: &Body) -> Option<Fault> {
        let is_shown = (0..2).any(|axis| self.shows(axis, SHOWN_BW * body.weight_n));
        if !is_shown || self.turned(0) > NOT_TURNED {
            return None;
        }
        let faults = [
            (Fault::Turned(1), self.turned(1)),
            (Fault::Turned(3), self.turned(3)),
            (Fault::Exchanged, self.exchanged()),
        ];
        let (fault, agreement) = faults.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        (agreement > TURNED).then_some(fault)
    }

    /// Whether measured and expected components are large enough to show a direction [N].
    fn shows(&self, axis: usize, least_n: f64) -> bool {
        let rms = |squares: f64| (squares / self.frames.max(1) as f64).sqrt();
        self.steps > 0 && rms(self.lever.expected[axis]) > least_n && rms(self.lever.measured[axis]) > least_n
    }

    fn with(self, other: &Sums) -> Sums {
        let lever = self.lever.with(&other.lever);
        Sums { lever, frames: self.frames + other.frames, steps: self.steps + other.steps }
    }
}

impl Sensor<'_> {
    /// The force at a time [N].
    fn total_at(&self, time_s: f64) -> Vec3 {
        let at = |force: &&ForceRecording| force.force.get(sample_at(force, time_s)).copied().unwrap_or_default();
        self.forces.iter().map(at).filter(|force| force.iter().all(|x| x.is_finite())).sum()
    }
}

/// The sample nearest to a time.
fn sample_at(force: &ForceRecording, time_s: f64) -> usize {
    let next = force.times.partition_point(|time| *time < time_s);
    let is_nearer =
        |k: usize| k > 0 && (k == force.times.len() || time_s - force.times[k - 1] < force.times[k] - time_s);
    if is_nearer(next) { next - 1 } else { next }
}

/// The forces of each plate or load.
fn sensors(observed: &Observation, up: Vec3) -> Vec<Sensor<'_>> {
    let plates = observed.origin.followed().map_or(&[][..], |followed| &followed.body.plates);
    let world = [Vec3::x(), if up.y.abs() > 0.5 { Vec3::z() } else { -Vec3::y() }];
    let mut sensors: Vec<Sensor<'_>> = Vec::new();
    for force in observed.forces.iter().filter(|force| force.force_frame.is_none() && force.point_frame.is_none()) {
        let plate =
            plates.iter().find(|plate| force.name.strip_prefix(&plate.name).is_some_and(|rest| rest.starts_with(',')));
        let name = plate.map_or(force.name.as_str(), |plate| plate.name.as_str());
        match sensors.iter_mut().find(|sensor| sensor.name == name) {
            Some(known) => known.forces.push(force),
            None => sensors.push(Sensor {
                name,
                axes: plate.and_then(|plate| plate.axes()).unwrap_or(world),
                is_plate: plate.is_some(),
                forces: vec![force],
                sums: Sums::default(),
            }),
        }
    }
    sensors
}

/// One sentence for all sensors with the same fault.
fn sentences(sensors: &[Sensor<'_>], found: &[(usize, Fault)]) -> Vec<(String, f64)> {
    let mut faults: Vec<Fault> = found.iter().map(|(_, fault)| *fault).collect();
    faults.sort_unstable();
    faults.dedup();
    let with =
        |fault: Fault| found.iter().filter(move |(_, other)| *other == fault).map(|(k, _)| &sensors[*k]).collect();
    faults.into_iter().filter_map(|fault| sentence(fault, with(fault))).collect()
}

/// The names of some sensors, as in `plates 1, 2 and 3`.
fn names(sensors: &[&Sensor<'_>]) -> String {
    let is_plates = sensors.iter().all(|sensor| sensor.is_plate);
    let short = |sensor: &&Sensor<'_>| match is_plates {
        true => sensor.name.trim_start_matches("plate ").to_owned(),
        false => format!("`{}`", sensor.name),
    };
    let mut names: Vec<String> = sensors.iter().map(short).collect();
    let kind = if is_plates { "plate" } else { "load" };
    let plural = if names.len() > 1 { "s" } else { "" };
    let last = names.pop().unwrap_or_default();
    let listed = if names.is_empty() { last } else { format!("{} and {last}", names.join(", ")) };
    format!("{}{kind}{plural} {listed}", if is_plates { "" } else { "the " })
}

fn sentence(fault: Fault, sensors: Vec<&Sensor<'_>>) -> Option<(String, f64)> {
    let first = sensors.first()?;
    let sums = sensors.iter().fold(Sums::default(), |sum, sensor| sum.with(&sensor.sums));
    let names = names(&sensors);
    let steps = format!("{} step{}", sums.steps, if sums.steps == 1 { "" } else { "s" });
    let letter = |axis: usize| if first.is_plate { ["x", "y"][axis] } else { ["x", "z"][axis] };
    let (what, agreement, word) = match fault {
        Fault::Flipped(axis) => {
            let along = first.axes[axis].x.abs();
            let kind = if along > 0.8 {
                "fore-aft "
            } else if along < 0.6 {
                "lateral "
            } else {
                ""
            };
            let what = format!("the {kind}force ({}) of {names} is mirrored: it", letter(axis));
            (what, sums.agreement(axis), format!("flip-{}", letter(axis)))
        }
        Fault::Turned(quarters) => {
            let what = format!("the horizontal force of {names} is turned by a right angle: it");
            (what, sums.turned(0), format!("turn-{}", 90 * quarters))
        }
        Fault::Exchanged => {
            let what = format!("the horizontal components of the force of {names} are exchanged: the force");
            (what, sums.turned(0), String::new())
        }
    };
    let remedy = match first.is_plate && fault != Fault::Exchanged {
        true => {
            let given: Vec<String> =
                sensors.iter().map(|sensor| format!("{}={word}", sensor.name.trim_start_matches("plate "))).collect();
            format!("state for the plates: {}", given.join(", "))
        }
        false => match fault {
            Fault::Flipped(axis) => format!("change the sign of the columns {} of these forces", letter(axis)),
            Fault::Turned(_) => "turn the axes of the table".to_owned(),
            Fault::Exchanged => "exchange their channels or columns in the file".to_owned(),
        },
    };
    let message = format!(
        "{what} does not lead from the centre of pressure towards the mass centre, as in every step (r = \
         {agreement:.2} over {steps}). hint: {remedy}"
    );
    Some((message, agreement))
}
