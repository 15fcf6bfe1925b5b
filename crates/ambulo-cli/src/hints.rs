//! Hints for errors and findings of the library: the command-line options that help.
//!
//! The library has no options. Its errors and findings carry data; this table adds the hint.

use crate::request::WrongFields;
use ambulo::analysis::{AnalysisError, ComparisonError, MarkerTrialError};
use ambulo::findings::Code;
use ambulo::ground::predict::PredictError;
use ambulo::job::{Field, JobError};
use ambulo::kinematics::TrajectoryError;
use ambulo::kinematics::calibration::CalibrationError as NoBody;
use ambulo::kinematics::sensor_fit::SensorError;
use ambulo::motion::skeleton::SkeletonError;
use ambulo::motion::{B3dError, MotionError, SmplError};
use ambulo::optimal::OptimalWalkError;
use ambulo::simulation::synthetic::SyntheticError;
use ambulo::study::{CalibrationError, StudyError};
use ambulo_results::ResultsError;
use std::error::Error;

const RANGE: &str = "`--from` and `--to` choose the time range";

/// The hint for a finding.
pub(crate) fn of_finding(code: Code) -> Option<&'static str> {
    let hint = match code {
        Code::PlatesTwoFeet | Code::PlatesUnassigned => {
            "`--plate 1=r` assigns the right foot to plate 1; give a standing trial with `--static`"
        }
        Code::PlatesMirrored | Code::PlatesCornersUnclear => {
            "`--plate 1=flip-x`, `1=flip-y`, `1=turn-90`, `1=turn-180` or `1=turn-270` correct plate 1"
        }
        Code::ResidualLarge => RANGE,
        Code::LoadsGuessed => "`--right`, `--left` or `--loads` choose other columns",
        Code::LoadsUnderOtherFoot => {
            "`--grf` alone, without `--loads`, `--right` and `--left`, assigns loads without a side by their centre of \
             pressure"
        }
        Code::LoadsUnassigned => "`--right BODY:PREFIX` and `--left BODY:PREFIX` state the columns of each foot",
        Code::LoadsFarFromFoot => "without a loads file, `--right` and `--left` choose the bodies",
        Code::ForcesDelayed => "`--force-delay S` shifts them by the delay in the message",
        Code::MarkersUnused | Code::MarkersByPlace => {
            "`ambulo info STANDING --markers mine.toml` writes the markers with their meaning; correct the file, then \
             give it with `--markers mine.toml`"
        }
        Code::MarkersWindow => "`--max-gap` allows longer gaps, `--from` and `--to` choose another time range",
        Code::B3dForceMissing => {
            "`--from` and `--to` choose another time range, `--predict` predicts the forces of the whole trial"
        }
        Code::B3dFiltered => "`--cutoff off` leaves the motion as it is",
        Code::MassStandingMismatch => {
            "check `--mass KG` and the force plates; the mass on which two of statement, standing trial and motion \
             agree is used"
        }
        Code::MassContradicted => "`--mass KG` states another mass; or correct the force plates",
        Code::B3dStatedMass | Code::B3dFormDefaults => "`--mass KG` sets the mass",
        Code::MassUnverified => "give `--mass KG` or, with markers, a standing trial on force plates (`--static`)",
        Code::GroundPredicted => "`--grf` reads measured forces, `--no-ground` computes a motion without contact",
        Code::PredictionFeetSlide => "`--refit` holds loaded feet still",
        Code::SensorsHeading => "`--heading SENSOR:AXIS` names an axis that points forward",
        Code::SensorsUnrest => "`--static FILE` is the person standing still",
        Code::WalkNotConsistent => "`--mode paper` computes the unchanged gait",
        _ => return None,
    };
    Some(hint)
}

/// The hint for an error: the hint of its first cause that has one, and the options of the fields that it is about.
pub(crate) fn of_error(error: &anyhow::Error) -> Option<String> {
    let of_cause = causes(error).find_map(of_cause).map(str::to_owned);
    let fields = error.chain().filter_map(|cause| cause.downcast_ref::<JobError>()).flat_map(JobError::fields);
    let mut options: Vec<String> = fields.filter_map(|field| option(*field)).map(str::to_owned).collect();
    let wrong = error.chain().filter_map(|cause| cause.downcast_ref::<WrongFields>());
    options.extend(wrong.flat_map(|wrong| wrong.fields).map(|field| format!("`--{}`", field.replace('_', "-"))));
    let options = (!options.is_empty()).then(|| options.join(", "));
    let hints: Vec<String> = of_cause.into_iter().chain(options).collect();
    (!hints.is_empty()).then(|| hints.join("; "))
}

/// The causes of an error, with those inside an error of a job.
pub(crate) fn causes(error: &anyhow::Error) -> impl Iterator<Item = &(dyn Error + 'static)> {
    error.chain().flat_map(|cause| {
        let of_job = cause.downcast_ref::<JobError>();
        let inner = of_job.map(|error| error.cause() as &(dyn Error + 'static));
        [Some(cause), inner].into_iter().flatten()
    })
}

/// The option that states a field of a job; the recording has none.
fn option(field: Field) -> Option<&'static str> {
    let option = match field {
        Field::Recording => return None,
        Field::Trial => "`--trial N|NAME|all`",
        Field::Standing => "`--static FILE`",
        Field::Model => "`--model FILE.osim`",
        Field::MarkerSet => "`--marker-set FILE`",
        Field::Markers => "`--markers NAME|FILE`",
        Field::Segments => "`--figure NAME`",
        Field::Mass => "`--mass KG`",
        Field::Height => "`--height M`",
        Field::Smpl => "`--smpl FILE`",
        Field::Heading => "`--heading SENSOR:AXIS`",
        Field::Earth => "`--earth X,Y,Z`",
        Field::ForceTable => "`--grf FILE`",
        Field::Loads => "`--loads FILE`",
        Field::Plates => "`--plate N=r|l|off|flip-x|flip-y|turn-90|turn-180|turn-270`",
        Field::AddedMass => "`--add-mass BODY:KG[:X,Y,Z]`",
        Field::Feet => "`--right BODY:PREFIX`, `--left BODY:PREFIX`",
        Field::From => "`--from T`",
        Field::To => "`--to T`",
        Field::Ground => {
            "`--predict`, `--track` and `--no-ground` choose the ground forces; `--predict` needs no motion that feet \
             can make"
        }
        Field::Cutoff => "`--cutoff HZ|off`",
        Field::Order => "`--order N`",
        Field::Gap => "`--max-gap S`",
        Field::ForceDelay => "`--force-delay S`",
        Field::Fit => "`--fit frames|trajectory`",
        Field::Hip => "`--hip harrington|hara|bell|plug-in-gait`",
        Field::KneeAxis => "`--knee-axis markers|least-cross-talk`",
        Field::Functional => "`--functional FILE`",
        Field::ResidualReduction => "`--consistent`",
        Field::Muscles => "`--muscles`",
        Field::Reserves => "`--reserves FILE`",
        Field::Emg => "`--emg FILE`",
        Field::Exponent => "`--exponent P`",
        Field::Condyles => "`--condyles M`",
    };
    Some(option)
}

fn of_cause(cause: &(dyn Error + 'static)) -> Option<&'static str> {
    let others = [
        cause.downcast_ref().and_then(of_study),
        cause.downcast_ref().and_then(of_analysis),
        cause.downcast_ref().and_then(of_motion),
        cause.downcast_ref().and_then(of_trajectory),
        cause.downcast_ref().and_then(of_calibration),
        cause.downcast_ref().and_then(of_prediction),
        cause.downcast_ref().and_then(of_skeleton),
        cause.downcast_ref().and_then(of_subject),
        cause.downcast_ref().and_then(of_comparison),
        cause.downcast_ref().and_then(of_results),
        cause.downcast_ref().and_then(of_walk),
        cause.downcast_ref().and_then(of_smpl),
    ];
    others.into_iter().flatten().next()
}

fn of_walk(error: &SyntheticError) -> Option<&'static str> {
    matches!(error, SyntheticError::Optimal(OptimalWalkError::NotConverged { .. } | OptimalWalkError::Ripple { .. }))
        .then_some(
            "with one of `--speed`, `--cadence` and `--step-length` the others have their usual values; \
            `--planar` walks in the sagittal plane, without slope, load or weakness",
        )
}

fn of_study(error: &StudyError) -> Option<&'static str> {
    match error {
        StudyError::Analysis(error) => of_analysis(error),
        StudyError::Sensors(error) => of_sensors(error),
        StudyError::Markers(MarkerTrialError::SeveralPeople { .. } | MarkerTrialError::NoSuchPerson { .. }) => {
            Some("`--subject NAME` chooses one of them")
        }
        StudyError::Markers(MarkerTrialError::Names(_) | MarkerTrialError::Calibration(NoBody::Markers { .. })) => {
            Some(
                "`ambulo info FILE --markers mine.toml` writes the markers with proposals for their meaning; correct \
                 the file, then give it with `--markers mine.toml`",
            )
        }
        StudyError::ForceTable(error) | StudyError::Device(error) => of_motion(error),
        StudyError::ForceColumns { .. } => Some(
            "name the columns with `--right BODY:PREFIX` and `--left BODY:PREFIX`, or describe them with `--loads XML`",
        ),
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
        MotionError::NoColumn { .. } => Some("`--right` and `--left` choose other columns"),
        MotionError::Gap { .. }
        | MotionError::NoRows { .. }
        | MotionError::ForceNotFinite { .. }
        | MotionError::Outside { .. }
        | MotionError::TooShort { .. }
        | MotionError::FarRange { .. } => Some(RANGE),
        _ => None,
    }
}

fn of_trajectory(error: &TrajectoryError) -> Option<&'static str> {
    matches!(error, TrajectoryError::NotFinite { .. }).then_some(RANGE)
}

fn of_prediction(error: &PredictError) -> Option<&'static str> {
    match error {
        PredictError::NoFeet { .. } | PredictError::NoSole { .. } => {
            Some("`--no-ground` computes a motion without contact, `--grf` reads measured forces")
        }
        PredictError::NoGravity { .. } => Some("`--no-ground` computes a motion without contact"),
        PredictError::TooLarge { .. } => Some(RANGE),
        PredictError::OtherPerson(_) | PredictError::OtherEstimator { .. } => {
            Some("`ambulo calibrate` makes the file of `--person` from trials of this person")
        }
        _ => None,
    }
}

fn of_calibration(error: &CalibrationError) -> Option<&'static str> {
    matches!(error, CalibrationError::NoPlates { .. }).then_some(
        "`--grf FILE` or `--loads FILE.xml`, once per trial, name the forces that were measured apart from it",
    )
}

fn of_smpl(error: &SmplError) -> Option<&'static str> {
    matches!(error, SmplError::NoLengths)
        .then_some("`--height M` states the stature, `--smpl MODEL.npz` gives the model")
}

fn of_sensors(error: &SensorError) -> Option<&'static str> {
    match error {
        SensorError::Heading { .. } | SensorError::NoBaseSensor { .. } | SensorError::HeadingAxis { .. } => {
            Some("`--heading pelvis_imu:x` names the axis of a sensor that points forward in the standing posture")
        }
        SensorError::NotCalibrated { .. } => Some("`--static FILE` is the standing trial"),
        _ => None,
    }
}

fn of_subject(error: &B3dError) -> Option<&'static str> {
    matches!(error, B3dError::NoPass).then_some("`--model built-in` fits the markers of the file")
}

fn of_skeleton(error: &SkeletonError) -> Option<&'static str> {
    matches!(error, SkeletonError::Unit { .. }).then_some("`--height M` sets the stature in metres")
}

fn of_results(error: &ResultsError) -> Option<&'static str> {
    matches!(error, ResultsError::Missing { .. }).then_some(
        "the run may have left it out (`--keep`); `--keep tables` writes all that a page needs, `--keep report` the \
         page itself",
    )
}

fn of_comparison(error: &ComparisonError) -> Option<&'static str> {
    matches!(error, ComparisonError::NotFinite { .. }).then_some(RANGE)
}
