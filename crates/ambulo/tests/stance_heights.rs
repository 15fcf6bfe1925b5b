//! Feet that sink into a level floor in one stance: a synthetic walk whose stances have one height, and copies of it.

use crate::walks;
use ambulo::analysis::feasibility::Person;
use ambulo::findings::Findings;
use ambulo::ground::footfalls::footfalls;
use ambulo::model::Side;
use ambulo::motion::Motion;
use ambulo::simulation::synthetic::SyntheticWalk;
use ambulo::study::{self, Measure, QualityReason, Settings, Source};
use std::f64::consts::TAU;

fn walk() -> &'static SyntheticWalk {
    walks::corrected(walks::MAN, 6)
}

/// Start and end of the third whole stance of the right foot [s].
fn stance() -> [f64; 2] {
    let SyntheticWalk { human, trajectory, .. } = walk();
    let soles = Person::of_human(human).soles;
    let falls = footfalls(&human.model, trajectory, &soles, &mut Findings::default());
    let whole: Vec<[f64; 2]> = falls.of(Side::Right).filter_map(|fall| Some([fall.strike_s?, fall.off_s?])).collect();
    whole[2]
}

/// Adds a smooth bump of this size to one coordinate during one stance [rad or m], and returns the reason that the
/// quality gives for heights of stances.
fn found(name: &str, larger: f64) -> Option<QualityReason> {
    let SyntheticWalk { human, trajectory, .. } = walk();
    let (model, grid, [from_s, to_s]) = (&human.model, trajectory.grid(), stance());
    let mut columns: Vec<Option<Vec<f64>>> =
        model.coordinate_ids().map(|id| Some(trajectory.values(id).to_vec())).collect();
    let changed = columns[model.coordinate(name).unwrap().index()].as_mut().unwrap();
    for (value, time_s) in changed.iter_mut().zip(grid.times()) {
        // Rises from zero before the stance and falls back to it afterwards, smoothly.
        let share = (time_s - from_s + 0.1) / (to_s - from_s + 0.2);
        if (0.0..=1.0).contains(&share) {
            *value += larger * (1.0 - (TAU * share).cos()).min(1.0);
        }
    }
    let motion = Motion { origin: "copied".to_owned(), times: grid.times(), columns };
    let source = Source::coordinates(model.clone(), motion);
    let quality = study::run(source, &Settings::default(), &mut Findings::default()).unwrap().quality;
    quality.reasons.into_iter().find(|reason| reason.measure == Measure::StanceHeight)
}

#[test]
fn the_stances_of_a_level_walk_have_one_height() {
    assert_eq!(found("ankle_angle_r", 0.0), None);
}

/// The toes are some 0.15 m in front of the ankle, so a quarter of a radian lowers them by some 4 cm.
#[test]
fn a_foot_that_sinks_in_one_stance_is_found_with_its_time() {
    let reason = found("ankle_angle_r", -0.25).unwrap();
    let [from_s, to_s] = stance();
    let middle = format!("the right foot sinks: in the stance at {:.1}", 0.5 * (from_s + to_s));
    assert!(reason.message.starts_with(&middle), "{}", reason.message);
    assert!((0.02..0.06).contains(&reason.value), "{}", reason.message);
}

/// On a kerb the pelvis rises with the foot.
#[test]
fn a_stance_with_a_higher_pelvis_is_not_held_against_the_foot() {
    assert_eq!(found("pelvis_ty", 0.05), None);
}
