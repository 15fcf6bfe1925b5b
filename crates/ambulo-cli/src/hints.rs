//! What the user of the command can do about an error or a finding of the library: the options that help.
//!
//! The library knows no options. Its errors and findings carry data; this table adds the hint.

use ambulo::analysis::{AnalysisError, ComparisonError};
use ambulo::findings::Code;
use ambulo::ground::predict::PredictError;
use ambulo::kinematics::TrajectoryError;
use ambulo::motion::MotionError;
use ambulo::motion::skeleton::SkeletonError;
use ambulo::study::StudyError;
use std::error::Error;

/// Cuts a part of a recording off.
const RANGE: &str = "`--from` and `--to` choose the range";

/// The hint for a finding.
pub(crate) fn of_finding(code: Code) -> Option<&'static str> {
    let hint = match code {
        Code::PlatesTwoFeet | Code::PlatesUnassigned => {
            "`--plate 1=r` states the foot on plate 1; a standing trial is for `--static`"
        }
        Code::ResidualLarge => RANGE,
        Code::LoadsGuessed => "`--right`, `--left` or `--loads` state others",
        Code::LoadsFarFromFoot => "`--right` and `--left` state the bodies, where there is no loads file",
        Code::MarkersWindow => "`--max-gap` allows longer gaps, `--from` and `--to` choose another range",
        Code::MassStandingMismatch | Code::PredictionMass => "`--mass KG` gives the mass",
        Code::MassUnverified => {
            "with markers, `--mass KG` or a standing trial on force plates (`--static`); recorded coordinates have the mass of their model"
        }
        Code::GroundPredicted => "`--grf` gives measured forces, `--no-ground` computes a motion without contact",
        Code::WalkNotConsistent => "`--mode paper` computes the gait as it is",
        _ => return None,
    };
    Some(hint)
}

/// The hint for an error, by the first of its causes that has one.
pub(crate) fn of_error(error: &anyhow::Error) -> Option<&'static str> {
    error.chain().find_map(of_cause)
}

fn of_cause(cause: &(dyn Error + 'static)) -> Option<&'static str> {
    let others = [
        cause.downcast_ref().and_then(of_study),
        cause.downcast_ref().and_then(of_analysis),
        cause.downcast_ref().and_then(of_motion),
        cause.downcast_ref().and_then(of_trajectory),
        cause.downcast_ref().and_then(of_prediction),
        cause.downcast_ref().and_then(of_skeleton),
        cause.downcast_ref().and_then(of_comparison),
    ];
    others.into_iter().flatten().next()
}

fn of_study(error: &StudyError) -> Option<&'static str> {
    match error {
        StudyError::Analysis(error) => of_analysis(error),
        StudyError::ForceTable(error) | StudyError::Device(error) => of_motion(error),
        StudyError::ForceColumns { .. } => {
            Some("`--right BODY:PREFIX` and `--left BODY:PREFIX` name the columns, or `--loads XML` describes them")
        }
        _ => None,
    }
}

fn of_analysis(error: &AnalysisError) -> Option<&'static str> {
    match error {
        AnalysisError::Motion(error) | AnalysisError::Ground(error) => of_motion(error),
        AnalysisError::Trajectory(error) => of_trajectory(error),
        AnalysisError::Prediction(error) => of_prediction(error),
        _ => None,
    }
}

fn of_motion(error: &MotionError) -> Option<&'static str> {
    match error {
        MotionError::NoColumn { .. } => Some("`--right` and `--left` name other columns"),
        MotionError::Gap { .. } | MotionError::ForceNotFinite { .. } => Some(RANGE),
        _ => None,
    }
}

fn of_trajectory(error: &TrajectoryError) -> Option<&'static str> {
    matches!(error, TrajectoryError::NotFinite { .. }).then_some(RANGE)
}

fn of_prediction(error: &PredictError) -> Option<&'static str> {
    match error {
        PredictError::NoFeet { .. } | PredictError::NoSole { .. } => {
            Some("`--no-ground` computes a motion without contact, `--grf` gives measured forces")
        }
        PredictError::NoGravity { .. } => Some("`--no-ground` computes a motion without contact"),
        PredictError::TooLarge { .. } => Some(RANGE),
        _ => None,
    }
}

fn of_skeleton(error: &SkeletonError) -> Option<&'static str> {
    matches!(error, SkeletonError::Unit { .. }).then_some("`--height M` gives the stature in metres")
}

fn of_comparison(error: &ComparisonError) -> Option<&'static str> {
    matches!(error, ComparisonError::NotFinite { .. }).then_some(RANGE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ambulo::analysis::AnalysisError;
    use anyhow::Context;

    /// As the verbs hand errors on: wrapped by the analysis, and with the file in front.
    #[test]
    fn an_error_has_the_hint_of_its_cause() {
        let gap = || MotionError::Gap { column: "a".to_owned(), from_s: 0.0, to_s: 1.0, longest_s: 0.2 };
        let of = |error: anyhow::Error| of_error(&error);
        assert_eq!(of(gap().into()), Some(RANGE));
        assert_eq!(of(AnalysisError::Motion(gap()).into()), Some(RANGE));
        let of_run = StudyError::Analysis(AnalysisError::Motion(gap()));
        assert_eq!(of(anyhow::Error::new(of_run).context("walk.mot")), Some(RANGE));
        let named: anyhow::Result<()> = Err(AnalysisError::Ground(gap())).context("walk.mot");
        assert_eq!(of(named.unwrap_err()), Some(RANGE));
        let unit = SkeletonError::Unit { length: 3.0, units: "m".to_owned() };
        assert!(of(unit.into()).is_some_and(|hint| hint.contains("--height")));
        let no_feet = AnalysisError::Prediction(PredictError::NoFeet { model: "horse".to_owned() });
        assert!(of(no_feet.into()).is_some_and(|hint| hint.contains("--no-ground")));
        assert_eq!(of(SkeletonError::Up.into()), None);
    }
}
