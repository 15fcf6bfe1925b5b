//! Stature and leg length of the person, and the dimensionless walking speed.

use super::results::Results;
use crate::normative::dimensionless_speed;
use ambulo::analysis::StrideQuantity;

/// A length with its source.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SourcedLength {
    /// [m].
    pub(super) metres: f64,
    pub(super) source: String,
}

/// Stature, leg length and walking speed, as far as the files contain them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct BodySize {
    pub(super) stature: Option<SourcedLength>,
    /// Hip to floor in standing.
    pub(super) leg: Option<SourcedLength>,
    /// V / sqrt(g L).
    pub(super) speed_dimensionless: Option<f64>,
    /// Whether stance is too short for double support, as in running: normative data do not apply.
    pub(super) runs: bool,
    /// Turn of the path: normative data apply to straight walking only.
    pub(super) turn: Option<Turn>,
}

/// Reason why normative data do not apply to running, and to walks without double support.
pub(super) const NO_DOUBLE_SUPPORT: &str =
    "they apply to walking with double support, and stance lasts less than half of the cycle";
/// With a shorter stance a foot leaves the ground before the other one strikes [% of the cycle].
const RUNNING_STANCE: f64 = 50.0;
/// A path whose strides differ by more in direction is not straight [deg].
const STRAIGHT_DEG: f64 = 20.0;

/// A path that is not straight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turn {
    /// Largest angle between two strides [deg]; `None` if only the markers show the turn.
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

    /// The dimensionless speed to compare with normative data; `None` for running and for paths that turn.
    pub(super) fn walking_speed(&self) -> Option<f64> {
        self.speed_dimensionless.filter(|_| !self.runs && self.turn.is_none())
    }

    /// Why normative data do not apply; `None` if they do.
    pub(super) fn why_no_norm(&self) -> Option<&'static str> {
        match self.walking_speed() {
            Some(_) => None,
            None if self.runs => Some(NO_DOUBLE_SUPPORT),
            None if self.turn.is_some() => Some("they apply to straight walking, and the path turns"),
            None => Some("the speed or the leg length is not known"),
        }
    }
}

/// The turn of the path, detected from the strides or from the markers.
fn turn(results: &Results) -> Option<Turn> {
    let degrees = results.summary.times_and_distances.turn_deg.filter(|degrees| *degrees > STRAIGHT_DEG);
    let of_markers = results.summary.subject.as_ref().and_then(|subject| subject.turn_deg);
    (degrees.is_some() || of_markers.is_some()).then_some(Turn { degrees })
}

fn stature(results: &Results) -> Option<SourcedLength> {
    let given = results.summary.height_m.map(|metres| (metres, "given"));
    let estimated = || Some((results.summary.verdict.as_ref()?.height_m, "estimated from the model's thigh and shank"));
    let (metres, source) = given.or_else(estimated)?;
    Some(SourcedLength { metres, source: source.to_owned() })
}

/// Leg length of the synthetic figure, otherwise from the joints of the model.
fn leg_length(results: &Results) -> Option<SourcedLength> {
    if let Some(walk) = &results.summary.walk {
        return Some(SourcedLength { metres: walk.leg_length_m, source: "hip to floor of the figure".to_owned() });
    }
    let (file, model) = results.body.as_ref()?;
    let has_legs = model.anatomy().legs().values().any(Option::is_some);
    has_legs.then(|| SourcedLength {
        metres: model.stature().leg_length_m,
        source: format!("hip to ankle in {file}, plus the height of the ankle"),
    })
}
