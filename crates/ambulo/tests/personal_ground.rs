//! Calibration of the predicted ground forces of a person by trials on force plates.
//!
//! | claim                                                            | tolerance and its reason                                       |
//! |------------------------------------------------------------------|----------------------------------------------------------------|
//! | a calibration on a trial lowers the errors of that trial          | by a half: what is trusted of one trial, less what curves smooth |
//! | and those of another trial of the person                          | by a fifth, of the adult with five walks                        |
//! | what is added is the stated curve                                 | rounding                                                       |
//! | another person, another activity, no plates, no stance: refused  | -                                                              |

use crate::shared_data::data;
use ambulo::findings::{Code, Findings};
use ambulo::ground::predict::{FittedParameters, PersonalErrors, PredictSettings, StanceErrors, checksum, trusted};
use ambulo::model::Side;
use ambulo::model::anthropometry::SegmentTable;
use ambulo::study::{
    self, CalibrationError, GroundSettings, LaboratoryFile, MarkerBody, MarkerSource, Outcome, QualityState, Settings,
    Source, StandingTrial, StudyError, personal_errors,
};
use std::path::Path;
use std::sync::Arc;

fn trial(folder: &Path, name: &str) -> Source {
    let read = |name: &str| {
        let bytes = std::fs::read(folder.join("motonms-unipd").join(name)).unwrap();
        LaboratoryFile::from_c3d(bytes, name, &mut Findings::default()).unwrap()
    };
    let body = MarkerBody::BuiltIn { table: SegmentTable::DeLevaMale, mass_kg: Some(82.6), height_m: None, set: None };
    let standing = Some(Arc::new(StandingTrial::new(read("Static1.c3d"))));
    Source::markers(MarkerSource { trial: read(name), standing, body, plates: Vec::new() })
}

fn predicted(source: &Source, person: Option<PersonalErrors>) -> Result<Outcome, StudyError> {
    let prediction = PredictSettings { person, ..PredictSettings::default() };
    let settings = Settings { ground: GroundSettings::Predicted, prediction, ..Settings::default() };
    study::run(source.clone(), &settings, &mut Findings::default())
}

/// Root mean squares of the vertical and the fore-aft error [% of body weight] and, per foot, the number of stances.
fn errors(outcome: &Outcome) -> [f64; 2] {
    let agreement = outcome.prediction.as_ref().unwrap().agreement.as_ref().unwrap();
    let mean = |of: &dyn Fn(&ambulo::analysis::FootAgreement) -> f64| {
        100.0 * agreement.feet.iter().map(of).sum::<f64>() / agreement.feet.len() as f64
    };
    [mean(&|foot| foot.vertical.rmse_bw), mean(&|foot| foot.fore_aft.rmse_bw)]
}

#[test]
fn a_trial_on_plates_corrects_the_other_trials_of_the_person() {
    let Some(folder) = data() else { return };
    let (first, second) = (trial(&folder, "Walking1.c3d"), trial(&folder, "Walking4.c3d"));
    let raw = predicted(&first, None).unwrap();
    let person = personal_errors(std::slice::from_ref(&raw)).unwrap();
    assert_eq!((person.stances.right, person.stances.left), (1, 1));
    assert_eq!(PersonalErrors::from_toml(&person.to_toml()).unwrap().stances, person.stances);
    let own = errors(&predicted(&first, Some(person.clone())).unwrap());
    let (before, after) = (predicted(&second, None).unwrap(), predicted(&second, Some(person.clone())).unwrap());
    println!("own trial {:?} -> {own:?}, another one {:?} -> {:?} %BW", errors(&raw), errors(&before), errors(&after));
    for axis in 0..2 {
        assert!(own[axis] < 0.5 * errors(&raw)[axis], "{axis}");
        assert!(errors(&after)[axis] < 0.8 * errors(&before)[axis], "{axis}");
    }
    // The standard deviations shrink to what remains.
    let largest = |outcome: &Outcome| {
        let deviations = &outcome.prediction.as_ref().unwrap().prediction.deviations;
        deviations.iter().flat_map(|foot| &foot.force).map(|force| force.y).fold(0.0, f64::max)
    };
    let remains = (1.0 - ambulo::ground::predict::REPEATS * trusted(1)).sqrt();
    assert!((largest(&after) / largest(&before) - remains).abs() < 1e-9);

    let heavier = PersonalErrors { mass_kg: 1.07 * person.mass_kg, ..person.clone() };
    let refused = predicted(&second, Some(heavier)).unwrap_err().to_string();
    assert!(refused.contains("mass") && refused.contains("5 %"), "{refused}");

    let older = PersonalErrors { estimator: person.estimator ^ 1, ..person.clone() };
    let refused = predicted(&second, Some(older)).unwrap_err().to_string();
    assert!(refused.contains("another estimate"), "{refused}");

    let mut without_plates = raw.clone();
    without_plates.prediction.as_mut().unwrap().measured = None;
    let mut without_stance = raw.clone();
    let coverage = &mut without_stance.prediction.as_mut().unwrap().coverage;
    coverage.as_mut().unwrap().stances.clear();
    let mut standing = raw.clone();
    standing.activity.kind = ambulo::analysis::activity::ActivityKind::Stand;
    assert_eq!(personal_errors(&[]).unwrap_err(), CalibrationError::NoTrial);
    let second_is = |outcome: Outcome| personal_errors(&[raw.clone(), outcome]).unwrap_err();
    assert_eq!(second_is(without_plates), CalibrationError::NoPlates { trial: 1 });
    assert_eq!(second_is(without_stance), CalibrationError::NoStance { trial: 1 });
    assert!(matches!(second_is(standing), CalibrationError::NotWalking { trial: 1, .. }));
    let mut bad = raw.clone();
    bad.quality.state = QualityState::Bad;
    assert!(matches!(second_is(bad), CalibrationError::BadTrial { trial: 1, .. }));
    let named = |name: &str| {
        let mut outcome = raw.clone();
        outcome.subject = Some(checksum(name));
        outcome
    };
    let others = personal_errors(&[named("anna"), named("berta")]).unwrap_err();
    assert_eq!(others, CalibrationError::OtherName { trial: 1 });
    assert!(!person.is_unusual(), "{}", person.excess);
    calibrations_that_do_not_fit_are_reported(&second, &person);
}

/// A calibration of another person, one with unusual errors, and one that the plates of the recording contradict.
fn calibrations_that_do_not_fit_are_reported(trial: &Source, person: &PersonalErrors) {
    let reported = |person: PersonalErrors| {
        let prediction = PredictSettings { person: Some(person), ..PredictSettings::default() };
        let settings = Settings { ground: GroundSettings::Predicted, prediction, ..Settings::default() };
        let mut findings = Findings::default();
        study::run(trial.clone(), &settings, &mut findings).unwrap();
        let codes = [Code::PredictionOtherPerson, Code::PredictionCalibrationUnusual, Code::PredictionCalibrationWorse];
        codes.map(|code| findings.has(code))
    };
    assert_eq!(reported(person.clone()), [false; 3]);
    let mut wrong = PersonalErrors { excess: 3.5, subject: Some(1), ..person.clone() };
    for foot in [&mut wrong.errors.right, &mut wrong.errors.left] {
        foot.force[1].0.iter_mut().for_each(|error| *error = 0.3);
    }
    // The file of this recording names nobody, or somebody else than the checksum says.
    let [_, is_unusual, is_worse] = reported(wrong);
    assert!(is_unusual && is_worse);
}

#[test]
fn what_is_added_is_the_mean_error_times_its_trust() {
    use super::ground_agreement::WALK;
    use ambulo::analysis::feasibility::Person;
    use ambulo::ground::predict::predict;
    let model = &WALK.human.model;
    let soles = Person::of_human(&WALK.human).soles;
    let ground = |person: Option<PersonalErrors>| {
        let settings = PredictSettings { person, ..PredictSettings::default() };
        predict(model, &WALK.trajectory, &soles, &settings, &mut Findings::default()).unwrap()
    };
    let mut curves = StanceErrors::default();
    curves.force[1].0.fill(0.02);
    let stature = model.stature();
    let person = PersonalErrors {
        mass_kg: model.mass(),
        stature_m: stature.height_m,
        leg_length_m: stature.leg_length_m,
        stances: ambulo::model::BySide { right: 3, left: 0 },
        errors: ambulo::model::BySide { right: curves, left: StanceErrors::default() },
        estimator: FittedParameters::default().fingerprint(),
        subject: None,
        excess: 0.0,
    };
    let (without, with) = (ground(None), ground(Some(person)));
    let weight = model.mass() * model.gravity().norm();
    let mut compared = 0;
    for (side, other) in [(Side::Right, Side::Left), (Side::Left, Side::Right)] {
        let [own, own_with] = [&without, &with].map(|of| &of.foot(side).0.force);
        // A foot in swing has no deviation, and takes nothing from the other one.
        let is_alone = |i: usize| without.foot(other).1.force[i].y < 1e-12 && own[i].y > 0.2 * weight;
        for i in (0..own.len()).filter(|&i| is_alone(i)) {
            let added = own_with[i].y - own[i].y;
            assert!((added - trusted(3) * 0.02 * weight).abs() < 1e-9 * weight, "{added}");
            compared += 1;
        }
    }
    assert!(compared > 50, "{compared}");
}
