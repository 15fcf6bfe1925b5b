//! Residual reduction of whole recordings: how far it moves the body, and what it leaves as it was.
//!
//! | claim                                                                     | tolerance           |
//! |---------------------------------------------------------------------------|---------------------|
//! | no body moves, and no joint turns, by more                                | 30 mm, 30 degrees   |
//! | the force that is left at the root is below                                | 1 % of body weight  |
//! | a motion that cannot agree with the forces stays as recorded, with a finding | exact            |

use crate::plug_in_gait::{PEOPLE, Person};
use crate::shared_data::data;
use ambulo::analysis::Adjustable;
use ambulo::findings::{Code, Finding, Findings};
use ambulo::kinematics::{Trajectory, each_body_motion};
use ambulo::model::Model;
use ambulo::spatial::Vec3;
use ambulo::study::{self, Outcome, Recording, Settings};
use std::path::Path;

/// The outcome of a walk whose motion may change, with this share of the forces of the first plate.
fn reduced(person: &Person, data: &Path, share: f64) -> (Outcome, Findings) {
    let mut source = person.source(data);
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    let plate = &mut markers.trial.recording.plates[0];
    let values = plate.force.iter_mut().chain(&mut plate.moment).flatten();
    values.for_each(|value| *value *= share);
    let settings = Settings { residual_reduction: Some(Adjustable::Motion), ..Settings::default() };
    let mut findings = Findings::default();
    (study::run(source, &settings, &mut findings).unwrap(), findings)
}

/// Mass centres of all bodies in all frames [m].
fn places(model: &Model, trajectory: &Trajectory) -> Vec<Vec3> {
    let mut places = Vec::new();
    each_body_motion(model, trajectory, |_, bodies| {
        places.extend(bodies.iter().map(|body| body.center));
    });
    places
}

#[test]
fn hands_and_feet_stay_within_three_centimetres_of_the_recorded_motion() {
    let Some(data) = data() else { return };
    let mut doubted = 0;
    for person in &PEOPLE {
        let (outcome, findings) = reduced(person, &data, 1.0);
        let recorded = outcome.analysis.recorded.as_ref().unwrap();
        let done = outcome.residual_reduction.as_ref().unwrap();
        let changed = places(&outcome.body, &outcome.analysis.trajectory);
        let moved = changed.iter().zip(places(&outcome.body, recorded)).map(|(a, b)| (a - b).norm());
        let (moved_m, turned_deg) = (moved.fold(0.0, f64::max), done.largest_angle().to_degrees());
        let left = done.residual_after.force_rms_bw;
        println!("{}: {:.1} mm, {turned_deg:.1} degrees, {:.2} % left", person.name, 1e3 * moved_m, 100.0 * left);
        assert!(moved_m < 0.03 && turned_deg < 30.0, "{}", person.name);
        assert!(left < 0.01 && left < 0.2 * done.residual_before.force_rms_bw, "{}", person.name);
        doubted += usize::from(findings.has(Code::ConsistencyForcesDoubted));
        assert!(moved_m > 1e-4, "it does change");
    }
    assert!(doubted > 0 && doubted < PEOPLE.len(), "the search is repeated for some of them: {doubted}");
}

#[test]
fn a_motion_that_cannot_agree_with_the_forces_stays_as_recorded() {
    let Some(data) = data() else { return };
    // With a part of the force missing, the body would have to fall.
    for share in [0.6, 0.1] {
        let (outcome, findings) = reduced(&PEOPLE[0], &data, share);
        let is_why = |finding: &&Finding| finding.code == Code::ConsistencyMotionKept;
        let why = findings.as_slice().iter().find(is_why).map(|finding| &finding.message[..]);
        assert!(why.is_some_and(|why| why.contains("the motion was not changed")), "{:?}", findings.as_slice());
        assert!(outcome.residual_reduction.is_none() && outcome.analysis.recorded.is_none());
    }
}
