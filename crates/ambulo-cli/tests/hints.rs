//! Hints for errors of the library.

use ambulo::analysis::AnalysisError;
use ambulo::ground::predict::PredictError;
use ambulo::motion::MotionError;
use ambulo::motion::skeleton::SkeletonError;
use ambulo::study::StudyError;
use ambulo_cli::internals::hint;
use anyhow::Context;

const RANGE: &str = "`--from` and `--to` choose the time range";

/// Errors as the commands return them: wrapped by the analysis, with the file in front.
#[test]
fn an_error_has_the_hint_of_its_cause() {
    let gap = || MotionError::Gap { column: "a".to_owned(), from_s: 0.0, to_s: 1.0, longest_s: 0.2 };
    let of = |error: anyhow::Error| hint(&error);
    assert_eq!(of(gap().into()).as_deref(), Some(RANGE));
    assert_eq!(of(AnalysisError::Motion(gap()).into()).as_deref(), Some(RANGE));
    let of_run = StudyError::Analysis(AnalysisError::Motion(gap()));
    assert_eq!(of(anyhow::Error::new(of_run).context("walk.mot")).as_deref(), Some(RANGE));
    let named: anyhow::Result<()> = Err(AnalysisError::Ground(gap())).context("walk.mot");
    assert_eq!(of(named.unwrap_err()).as_deref(), Some(RANGE));
    let unit = SkeletonError::Unit { length: 3.0, units: "m".to_owned() };
    assert!(of(unit.into()).is_some_and(|hint| hint.contains("--height")));
    let no_feet = AnalysisError::Prediction(PredictError::NoFeet { model: "horse".to_owned() });
    assert!(of(no_feet.into()).is_some_and(|hint| hint.contains("--no-ground")));
    assert_eq!(of(SkeletonError::Up.into()), None);
}
