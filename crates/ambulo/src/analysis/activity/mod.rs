//! Recognises the activity of a person in a recording: walks, runs, stands, squats, jumps, rises from a seat, climbs
//! stairs, turns.
//!
//! Only the motion, its stances and the laws of mechanics are used, no names and nothing fitted to recordings. Lengths
//! are relative to the length L of the leg, times to √(L/g). In this order:
//!
//! | kind | what decides |
//! |---|---|
//! | `jump` | both feet leave the ground at nearly the same time and the body flies for at least √(L/g)/4: the mass centre rises by more than g t²/8 |
//! | `run` | steps with duty factor below one half, so that the stances of the two feet do not overlap (Alexander 1989), faster than 0.3 √(g L); slower ones with a flight are a `jump` |
//! | `stairs_up`, `stairs_down` | steps that rise or fall by more than 0.08 m each, on average |
//! | `turn` | steps while the pelvis turns by more than 45 degrees |
//! | `walk` | steps that carry the body further than L/2 over the floor, with strides longer than 0.3 L and without a flight, or over the belt of a treadmill; in a recording of a part of a stride, a pelvis that travels faster than 0.15 √(g L) at an even height |
//! | `sit_to_stand` | the pelvis rises or falls by a quarter of L, and at its lowest the mass centre is behind both feet: a seat carries it |
//! | `squat` | the pelvis falls by a tenth of L while the knees bend by more than 30 degrees, with the mass centre over the feet |
//! | `stand` | the pelvis stays within a tenth of L in height, and does not travel |
//! | `other` | everything else, and bodies without feet |
//!
//! Sources: Alexander, "Optimization and gaits in the locomotion of vertebrates", Physiol Rev 69:1199, 1989 (duty
//! factor); ISO 21542 and building codes (risers of 0.10 to 0.22 m). A recording with several activities gets the first
//! of this order. Pinned by: tests/activity.rs

mod evidence;

use crate::ground::footfalls::Footfalls;
use crate::kinematics::Trajectory;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model};
use evidence::Evidence;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The body flies at least this share of √(L/g) in a jump: 0.08 s and 8 mm for an adult; less is a hop of the heels.
const LEAST_FLIGHT: f64 = 0.25;
/// In running each foot is on the ground for a share of its cycle in this range; a smaller one comes from stances that
/// were missed.
const RUNNING_DUTY_FACTOR: [f64; 2] = [0.1, 0.5];
/// Stances on stairs differ in height by at least this per step [m]: the lowest riser of building codes is 0.10 m.
const LEAST_RISER_M: f64 = 0.08;
/// A person who turns the pelvis by more than this does not walk straight [rad]: 45 degrees. In a stride the pelvis
/// rotates by less than 30.
const TURN_RAD: f64 = std::f64::consts::FRAC_PI_4;
/// A person who walks moves further than this share of the leg length.
const LEAST_PATH: f64 = 0.5;
/// The pelvis of a person who walks travels faster than this share of √(g L), 0.45 m/s for an adult: the slowest group
/// of Schwartz 2008 walks at 0.17.
const LEAST_SPEED: f64 = 0.15;
/// From one stance of a foot to its next one it moves further than this share of the leg length in a walk: two steps of
/// 0.15 L, 0.13 m of an adult. Feet that only lose and take load do not move.
const LEAST_STRIDE: f64 = 0.3;
/// Slower than this share of √(g L), 0.9 m/s for an adult, nobody runs: people jog from 1.5 m/s on. Leaps and landings
/// are slower.
const SLOWEST_RUN: f64 = 0.3;
/// Transition from walking to running, as a share of √(g L): Froude number one half (Alexander 1989).
const RUNNING_SPEED: f64 = 0.7;
/// The pelvis of a person who stands stays within this share of the leg length.
const STANDING: f64 = 0.1;
/// From the height of a seat the pelvis rises by at least this share of the leg length: the thigh is half of it and
/// becomes vertical.
const FROM_A_SEAT: f64 = 0.25;
/// Knees that bend by more carry a squat [rad]: 30 degrees.
const SQUATTING_RAD: f64 = std::f64::consts::FRAC_PI_6;

/// A kind of activity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ActivityKind {
    /// Walks.
    Walk,
    /// Runs.
    Run,
    /// Stands.
    Stand,
    /// Bends the knees and straightens them.
    Squat,
    /// Leaves the ground with both feet and lands.
    Jump,
    /// Rises from a seat, or sits down.
    SitToStand,
    /// Climbs stairs.
    StairsUp,
    /// Descends stairs.
    StairsDown,
    /// Turns while walking or on the spot.
    Turn,
    /// Something else.
    Other,
}

impl ActivityKind {
    /// All kinds.
    pub const ALL: [ActivityKind; 10] = [
        ActivityKind::Walk,
        ActivityKind::Run,
        ActivityKind::Stand,
        ActivityKind::Squat,
        ActivityKind::Jump,
        ActivityKind::SitToStand,
        ActivityKind::StairsUp,
        ActivityKind::StairsDown,
        ActivityKind::Turn,
        ActivityKind::Other,
    ];

    /// The words of reports.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            ActivityKind::Walk => "walk",
            ActivityKind::Run => "run",
            ActivityKind::Stand => "stand",
            ActivityKind::Squat => "squat",
            ActivityKind::Jump => "jump and landing",
            ActivityKind::SitToStand => "sit-to-stand",
            ActivityKind::StairsUp => "stairs up",
            ActivityKind::StairsDown => "stairs down",
            ActivityKind::Turn => "turn",
            ActivityKind::Other => "not recognised",
        }
    }

    /// Whether predicted ground forces of this activity were compared with force plates (docs/measured/VALIDATION.md;
    /// of standing in tests/standing_ground.rs).
    #[must_use]
    pub(crate) fn has_validated_prediction(self) -> bool {
        matches!(self, ActivityKind::Walk | ActivityKind::Run | ActivityKind::Turn | ActivityKind::Stand)
    }

    /// Whether at least one foot is on the ground at all times. Running and jumping have flights; an unknown activity
    /// may have some.
    #[must_use]
    pub(crate) fn keeps_a_foot_down(self) -> bool {
        !matches!(self, ActivityKind::Run | ActivityKind::Jump | ActivityKind::Other)
    }
}

impl fmt::Display for ActivityKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words())
    }
}

/// The recognised activity of a recording, with the quantities that it was recognised by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Activity {
    /// The activity.
    pub kind: ActivityKind,
    /// Whether the floor moves under the feet, as on a treadmill.
    pub treadmill: bool,
    /// Number of foot strikes.
    pub steps: usize,
    /// Path of the pelvis over the floor or belt [m].
    pub path_m: f64,
    /// Share of a cycle in which a foot is on the ground, median; `None` without a whole cycle.
    pub duty_factor: Option<f64>,
    /// Longest flight [s].
    pub flight_s: f64,
    /// Change of the height of the floor under the feet, per step [m].
    pub rise_per_step_m: f64,
    /// Range of the heading of the pelvis [deg].
    pub turn_deg: f64,
    /// Range of the height of the pelvis [m].
    pub pelvis_range_m: f64,
    /// Largest range of the flexion of a knee [deg].
    pub knee_range_deg: f64,
}

impl Activity {
    /// The words of reports, such as "walk on a treadmill".
    #[must_use]
    pub fn words(&self) -> String {
        if self.treadmill { format!("{} on a treadmill", self.kind) } else { self.kind.to_string() }
    }
}

/// Recognises the activity of a motion with its stances. `leg_m` is the length from hip to ground.
#[must_use]
pub fn activity(
    model: &Model,
    trajectory: &Trajectory,
    soles: &BySide<Option<Sole>>,
    leg_m: f64,
    footfalls: &Footfalls,
) -> Activity {
    let evidence = Evidence::of(model, trajectory, soles, footfalls);
    let kind = evidence.as_ref().map_or(ActivityKind::Other, |found| kind(found, leg_m, model.gravity().norm()));
    let evidence = evidence.unwrap_or_default();
    Activity {
        kind,
        treadmill: footfalls.floor_velocity.norm() > 0.0,
        steps: evidence.steps,
        path_m: evidence.path_m,
        duty_factor: evidence.duty_factor,
        flight_s: evidence.flight_s,
        rise_per_step_m: evidence.rise_per_step_m,
        turn_deg: evidence.turn_rad.to_degrees(),
        pelvis_range_m: evidence.pelvis_range_m,
        knee_range_deg: evidence.knee_range_rad.to_degrees(),
    }
}

fn kind(found: &Evidence, leg_m: f64, gravity: f64) -> ActivityKind {
    let flies = found.flight_s > LEAST_FLIGHT * (leg_m / gravity).sqrt();
    let lowers = found.pelvis_range_m > STANDING * leg_m;
    let travels = found.speed_m_s > LEAST_SPEED * (leg_m * gravity).sqrt();
    let part_of_a_stride = found.steps < 2 && travels && !lowers && !flies;
    // The person does not advance while both feet stay in place, however the pelvis sways.
    let advances = found.stride_m.is_none_or(|stride_m| stride_m > LEAST_STRIDE * leg_m);
    let steps = found.steps >= 2 && advances && found.path_m > LEAST_PATH * leg_m || part_of_a_stride;
    if steps {
        let is_faster_than = |share: f64| found.speed_m_s > share * (leg_m * gravity).sqrt();
        let stances_are_apart =
            found.duty_factor.map_or(flies || part_of_a_stride && is_faster_than(RUNNING_SPEED), |share| {
                (RUNNING_DUTY_FACTOR[0]..RUNNING_DUTY_FACTOR[1]).contains(&share)
            });
        return match found {
            _ if flies && found.leaves_with_both_feet => ActivityKind::Jump,
            _ if stances_are_apart && is_faster_than(SLOWEST_RUN) => ActivityKind::Run,
            // Walking has no flight: a landing, or a leap from one foot.
            _ if flies => ActivityKind::Jump,
            _ if stances_are_apart => ActivityKind::Other,
            _ if found.rise_per_step_m > LEAST_RISER_M => ActivityKind::StairsUp,
            _ if found.rise_per_step_m < -LEAST_RISER_M => ActivityKind::StairsDown,
            _ if found.turn_rad > TURN_RAD => ActivityKind::Turn,
            _ => ActivityKind::Walk,
        };
    }
    match found {
        _ if flies => ActivityKind::Jump,
        _ if found.steps >= 2 && found.turn_rad > TURN_RAD => ActivityKind::Turn,
        _ if found.pelvis_range_m > FROM_A_SEAT * leg_m && found.behind_feet_when_low => ActivityKind::SitToStand,
        _ if lowers && found.knee_range_rad > SQUATTING_RAD => ActivityKind::Squat,
        _ if !lowers && found.steps < 2 && found.path_m < LEAST_PATH * leg_m => ActivityKind::Stand,
        _ => ActivityKind::Other,
    }
}
