//! Recordings that are played back, so that the person walks backwards: the laws of mechanics do not know the direction
//! of time, so the same plates carry the same feet, and the same forces are predicted.
//!
//! | claim | tolerance |
//! |---|---|
//! | each plate carries the same foot, and as cleanly, as forwards | exact |
//! | with the stances given, the predicted forces are those of the walk forwards | 1e-9 of them |
//! | on a treadmill the stances are those forwards, and the belt moves the other way | 1e-9 s and m/s |
//! | with the stances found, the vertical force differs from the plates by | at most a tenth more, mean of all feet |

use crate::footfall_trials::everything;
use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::findings::{Code, Findings};
use ambulo::ground::footfalls::{Footfall, Footfalls, footfalls};
use ambulo::ground::plates::ContactQuality;
use ambulo::ground::predict::{PredictSettings, Prescribed, predict};
use ambulo::kinematics::Trajectory;
use ambulo::model::{Model, Side};
use ambulo::study::{self, GroundSettings, Outcome, Recording, Settings, Source, Tracking};
use std::collections::BTreeSet;

/// The motion from its end to its beginning.
pub(crate) fn reversed(model: &Model, trajectory: &Trajectory) -> Trajectory {
    let back = |column: &[Vec<f64>; 3]| {
        let [mut q, mut qd, mut qdd] = column.clone();
        [&mut q, &mut qd, &mut qdd].into_iter().for_each(|values| values.reverse());
        qd.iter_mut().for_each(|rate| *rate = -*rate);
        [q, qd, qdd]
    };
    Trajectory::new(model, trajectory.grid(), trajectory.columns().iter().map(back).collect()).unwrap()
}

/// The recording from its end to its beginning.
fn played_back(mut source: Source) -> Source {
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    let recording = &mut markers.trial.recording;
    let times = &recording.markers.times;
    let ends_s = times[0] + times[times.len() - 1];
    let back = |times: &mut Vec<f64>| {
        times.iter_mut().for_each(|time| *time = ends_s - *time);
        times.reverse();
    };
    back(&mut recording.markers.times);
    recording.markers.markers.iter_mut().for_each(|marker| marker.positions.reverse());
    for plate in &mut recording.plates {
        back(&mut plate.times);
        plate.force.reverse();
        plate.moment.reverse();
    }
    markers.trial.events.clear();
    source
}

fn run(source: Source, settings: &Settings) -> (Outcome, Findings) {
    let mut findings = Findings::default();
    let outcome = study::run(source, settings, &mut findings).unwrap();
    (outcome, findings)
}

/// Plate and foot of all contacts that one foot has alone.
fn clean_contacts(outcome: &Outcome) -> BTreeSet<(usize, Side)> {
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no markers") };
    let clean = tracked.body.on_plates.contacts.iter().filter(|contact| contact.quality == ContactQuality::Clean);
    clean.map(|contact| (contact.plate, contact.side.unwrap())).collect()
}

#[test]
fn the_same_plates_carry_the_same_feet() {
    let Some(data) = data() else { return };
    for person in &PEOPLE {
        let (forwards, _) = person.computed(&data);
        let (backwards, findings) = run(played_back(person.source(&data)), &Settings::default());
        assert!(findings.has(Code::LaboratoryBackwards), "{}", person.name);
        let expected = clean_contacts(forwards);
        assert!(!expected.is_empty(), "{}", person.name);
        assert_eq!(clean_contacts(&backwards), expected, "{}: {:?}", person.name, findings.as_slice());
    }
}

#[test]
fn with_known_stances_the_predicted_forces_are_those_of_the_walk_forwards() {
    let Some(data) = data() else { return };
    let (outcome, _) = PEOPLE[0].computed(&data);
    let (model, soles, trajectory) = (&outcome.body, &outcome.person.soles, &outcome.analysis.trajectory);
    let settings = PredictSettings::default();
    let ignored = &mut Findings::default();
    let forwards = predict(model, trajectory, soles, &settings, ignored).unwrap();
    let grid = trajectory.grid();
    let reversed = reversed(model, trajectory);
    let at = |time_s: f64| grid.start_s + grid.end_s() - time_s;
    let turned = |fall: &Footfall| Footfall { strike_s: fall.off_s.map(at), off_s: fall.strike_s.map(at), ..*fall };
    let falls = forwards.footfalls.falls.iter().rev().map(turned).collect();
    let footfalls = Some(Footfalls { falls, ..forwards.footfalls.clone() });
    let settings = PredictSettings { prescribed: Prescribed { footfalls, ..Prescribed::default() }, ..settings };
    let backwards = predict(model, &reversed, soles, &settings, ignored).unwrap();
    let weight_n = model.mass() * model.gravity().norm();
    for side in Side::BOTH {
        let (own, own_deviation) = backwards.foot(side);
        let (other, other_deviation) = forwards.foot(side);
        for frame in 0..grid.frames {
            let same = grid.frames - 1 - frame;
            assert!((own.force[frame] - other.force[same]).norm() < 1e-9 * weight_n, "{side} {frame}");
            assert!((own.moment[frame] - other.moment[same]).norm() < 1e-9 * weight_n, "{side} {frame}");
            let deviation = own_deviation.force[frame] - other_deviation.force[same];
            assert!(deviation.norm() < 1e-9 * weight_n, "{side} {frame}");
        }
    }
}

#[test]
fn on_a_treadmill_the_belt_moves_the_other_way() {
    if data().is_none() {
        return;
    }
    let on_belt: Vec<_> = everything().iter().filter(|recorded| recorded.name.starts_with("gait2392")).collect();
    assert!(!on_belt.is_empty());
    for recorded in on_belt {
        let (model, trajectory) = (&recorded.model, recorded.trajectory(6.0));
        let found = |trajectory| footfalls(model, trajectory, &recorded.soles, &mut Findings::default());
        let (forwards, backwards) = (found(&trajectory), found(&reversed(model, &trajectory)));
        assert!(forwards.floor_velocity.norm() > 1.0, "{}", recorded.name);
        assert!((forwards.floor_velocity + backwards.floor_velocity).norm() < 1e-9, "{}", recorded.name);
        let grid = trajectory.grid();
        let at = |time_s: f64| grid.start_s + grid.end_s() - time_s;
        assert_eq!(forwards.falls.len(), backwards.falls.len(), "{}", recorded.name);
        for fall in &forwards.falls {
            let is_same = |other: &&Footfall| {
                let is_near = |own: Option<f64>, other: Option<f64>| match (own, other) {
                    (Some(own), Some(other)) => (own - at(other)).abs() < 1e-9,
                    (own, other) => own.is_none() && other.is_none(),
                };
                other.side == fall.side && is_near(other.strike_s, fall.off_s) && is_near(other.off_s, fall.strike_s)
            };
            assert_eq!(backwards.falls.iter().filter(is_same).count(), 1, "{}: {fall:?}", recorded.name);
        }
    }
}

/// RMS error of the predicted vertical force of each foot on plates [body weights].
fn errors(outcome: &Outcome) -> Vec<f64> {
    let agreement = outcome.prediction.as_ref().unwrap().agreement.as_ref().unwrap();
    agreement.feet.iter().map(|foot| foot.vertical.rmse_bw).collect()
}

#[test]
fn predicted_forces_are_as_good_as_forwards() {
    let Some(data) = data() else { return };
    let predicted = Settings { ground: GroundSettings::Predicted, ..Settings::default() };
    let (mut forwards, mut backwards) = (Vec::new(), Vec::new());
    for person in &PEOPLE {
        forwards.extend(errors(&run(person.source(&data), &predicted).0));
        backwards.extend(errors(&run(played_back(person.source(&data)), &predicted).0));
    }
    let mean = |list: &[f64]| list.iter().sum::<f64>() / list.len() as f64;
    println!("vertical force: {:.4} BW forwards, {:.4} BW backwards", mean(&forwards), mean(&backwards));
    assert!(mean(&backwards) < 1.1 * mean(&forwards), "{backwards:?} {forwards:?}");
}
