//! How large the person is, and how fast for that size.

use super::results::Results;
use crate::normative::dimensionless_speed;
use ambulo::analysis::StrideQuantity;

/// A length with where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Known {
    /// [m].
    pub(super) metres: f64,
    pub(super) source: String,
}

/// Stature and length of the legs, as far as the files tell.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct BodySize {
    pub(super) stature: Option<Known>,
    /// Hip to floor, standing.
    pub(super) leg: Option<Known>,
    /// V / sqrt(g L).
    pub(super) speed_dimensionless: Option<f64>,
    /// Whether the feet never stand together; norms are those of walking.
    pub(super) runs: bool,
    /// A path that is not straight; norms are those of straight walking.
    pub(super) turn: Option<Turn>,
}

/// A foot whose stance is a smaller share of its cycle leaves the ground before the other one strikes [%].
const RUNNING_STANCE: f64 = 50.0;
/// A path whose strides differ by more in direction is no straight walk [deg].
const STRAIGHT_DEG: f64 = 20.0;

/// A path that is not straight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turn {
    /// Largest angle between two strides, where the strides show it [deg].
    pub(super) degrees: Option<f64>,
}

impl BodySize {
    pub(super) fn of(results: &Results) -> BodySize {
        let leg = leg_length(results);
        let speed = results.summary.speed_m_s.zip(leg.as_ref());
        let stance = results.summary.times_and_distances.quantity(StrideQuantity::Stance);
        BodySize {
            runs: stance.and_then(|stance| stance.both).is_some_and(|stance| stance.mean < RUNNING_STANCE),
            turn: turn(results),
            stature: stature(results),
            speed_dimensionless: speed
                .and_then(|(speed, leg)| dimensionless_speed(speed, results.gravity(), leg.metres)),
            leg,
        }
    }

    /// The speed at which healthy people walk likewise; none for running and for paths that turn.
    pub(super) fn walking_speed(&self) -> Option<f64> {
        self.speed_dimensionless.filter(|_| !self.runs && self.turn.is_none())
    }
}

/// Whether the path turns, by the strides or by the markers.
fn turn(results: &Results) -> Option<Turn> {
    let degrees = results.summary.times_and_distances.turn_deg.filter(|degrees| *degrees > STRAIGHT_DEG);
    let of_markers = results.summary.subject.as_ref().and_then(|subject| subject.turn_deg);
    (degrees.is_some() || of_markers.is_some()).then_some(Turn { degrees })
}

fn stature(results: &Results) -> Option<Known> {
    let given = results.summary.height_m.map(|metres| (metres, "given"));
    let estimated = || Some((results.summary.verdict.as_ref()?.height_m, "estimated from the model's thigh and shank"));
    let (metres, source) = given.or_else(estimated)?;
    Some(Known { metres, source: source.to_owned() })
}

/// Of the figure that walks, else of the model's joints.
fn leg_length(results: &Results) -> Option<Known> {
    if let Some(walk) = &results.summary.walk {
        return Some(Known { metres: walk.leg_length_m, source: "hip to floor of the figure".to_owned() });
    }
    let (file, model) = results.body.as_ref()?;
    let has_legs = model.anatomy().legs().values().any(Option::is_some);
    has_legs.then(|| Known {
        metres: model.stature().leg_length_m,
        source: format!("hip to ankle in {file}, and the height of the ankle"),
    })
}
