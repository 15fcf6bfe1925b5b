//! Predicted centres of pressure of people who stand: against force plates, and where the mass centre is known.

use crate::activity::{Places, man, moving};
use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::findings::Findings;
use ambulo::ground::predict::{PredictSettings, Prediction, predict};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{BySide, Side};
use ambulo::spatial::Vec3;
use ambulo::study::{self, GroundSettings, LaboratoryFile, Outcome, Recording, Settings, Source, Tracking};

/// The standing trial of a person, analysed as a motion.
fn standing(source: &Source) -> Option<Outcome> {
    let mut source = source.clone();
    let Recording::Markers(markers) = &mut source.recording else { panic!("no markers") };
    markers.trial = LaboratoryFile::clone(markers.standing.as_ref()?);
    let settings = Settings { ground: GroundSettings::Predicted, ..Settings::default() };
    study::run(source, &settings, &mut Findings::default()).ok()
}

/// Centre of pressure of the feet together, and of the plates together, averaged over the recording.
fn centers(outcome: &Outcome) -> Option<[Vec3; 2]> {
    let up = outcome.body.up();
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no markers") };
    let weighted = |points: Vec<(f64, Vec3)>| {
        let load: f64 = points.iter().map(|(load, _)| load).sum();
        (load > 0.0).then(|| points.iter().map(|(load, point)| *point * *load).sum::<Vec3>() / load)
    };
    let grid = outcome.analysis.trajectory.grid();
    let feet = outcome.analysis.ground.bodies.iter().flat_map(|foot| {
        (0..grid.frames).map(|i| (foot.force[i].dot(&up), foot.center_of_pressure[i])).filter(|(load, _)| *load > 20.0)
    });
    let plates = tracked.body.plates.iter().flat_map(|plate| {
        let loaded = (0..plate.times.len()).filter(|i| plate.vertical(*i) > 50.0);
        loaded.map(|i| (plate.vertical(i), plate.center_of_pressure(i)))
    });
    Some([weighted(feet.collect())?, weighted(plates.collect())?])
}

#[test]
fn standing_people_have_their_centre_of_pressure_where_plates_measure_it() {
    let Some(folder) = data() else { return };
    let mut errors_mm = Vec::new();
    for person in &PEOPLE {
        let Some(outcome) = standing(&person.source(&folder)) else { continue };
        let Some([feet, plates]) = centers(&outcome) else { continue };
        let up = outcome.body.up();
        let apart = feet - plates;
        let level = apart - up * apart.dot(&up);
        println!(
            "standing: centre of pressure off by {:.0} mm (x {:.0}, z {:.0})",
            1e3 * level.norm(),
            1e3 * level.x,
            1e3 * level.z
        );
        errors_mm.push(1e3 * level.norm());
    }
    assert!(!errors_mm.is_empty());
    let mean = errors_mm.iter().sum::<f64>() / errors_mm.len() as f64;
    println!("standing: mean {mean:.0} mm over {} people", errors_mm.len());
    assert!(mean < 30.0, "{errors_mm:?}");
}

/// The prediction for a man whose pelvis and ankles move like this for four seconds, and the weight of the man [N].
fn predicted(places: Places) -> (Prediction, f64) {
    let human = man();
    let trajectory = moving(&human, places, 4.0);
    let soles = BySide::from_fn(|side| human.sole(side));
    let settings = PredictSettings::default();
    let prediction = predict(&human.model, &trajectory, &soles, &settings, &mut Findings::default()).unwrap();
    (prediction, human.model.mass() * human.model.gravity().norm())
}

/// Hips that sway forward and back by 2 cm, once a second, over feet 10 cm behind.
fn swaying(t: f64) -> [[f64; 2]; 3] {
    [[-0.05 + 0.02 * (std::f64::consts::TAU * t).sin(), 0.9], [-0.1, 0.0], [-0.1, 0.0]]
}

fn swaying_on_a_table(t: f64) -> [[f64; 2]; 3] {
    swaying(t).map(|[along, up]| [along, up + 0.75])
}

#[test]
fn who_stands_still_loads_the_middle_of_both_soles_below_the_mass_centre() {
    let still: Places = |_| [[-0.05, 0.9], [-0.1, 0.0], [-0.1, 0.0]];
    let human = man();
    let (prediction, weight) = predicted(still);
    let trajectory = moving(&human, still, 0.1);
    let model = &human.model;
    let q: Vec<f64> = model.coordinate_ids().map(|id| trajectory.values(id)[0]).collect();
    let rest = vec![0.0; q.len()];
    let bodies = body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest });
    let moments = model.bodies().iter().zip(&bodies).map(|(body, motion)| motion.center * body.inertia.mass());
    let center = moments.sum::<Vec3>() / model.mass();
    for (side, foot) in Side::BOTH.into_iter().zip(prediction.ground.bodies.iter()) {
        let sole = human.sole(side).unwrap();
        let [rear, tip] = [0, 2].map(|i| bodies[sole.points[i].body.index()].pose.place(sole.points[i].place));
        let share = (center.x - rear.x) / (tip.x - rear.x);
        assert!((0.1..0.9).contains(&share), "the mass centre is above the soles: {share}");
        let expected = rear + (tip - rear) * share;
        for frame in 50..350 {
            let (force, point) = (foot.force[frame], foot.center_of_pressure[frame]);
            assert!((force.y - 0.5 * weight).abs() < 0.002 * weight, "{side} {frame}: {force:?}");
            // Legs that lean towards each other push against each other, and nothing else.
            let both = force + prediction.foot(side.other()).0.force[frame];
            assert!((both - Vec3::y() * weight).norm() < 0.002 * weight, "{side} {frame}: {both:?}");
            let off = point - expected;
            assert!(off.x.hypot(off.z) < 0.002, "{side} {frame}: {point:?} instead of {expected:?}");
        }
    }
}

#[test]
fn who_sways_pushes_the_ground_as_newton_requires() {
    let (prediction, weight) = predicted(swaying);
    let [right, left] = &prediction.ground.bodies[..] else { panic!("two feet") };
    let required = prediction.total[50..350].iter().map(|total| total.force.x.abs()).fold(0.0, f64::max);
    assert!(required > 0.05 * weight, "{required} N");
    for frame in 50..350 {
        let missing = right.force[frame] + left.force[frame] - prediction.total[frame].force;
        assert!(missing.norm() < 0.1 * required, "frame {frame}: {missing:?} of {required} N");
    }
}

#[test]
fn who_sways_on_a_table_needs_the_forces_of_the_floor() {
    let [(floor, weight), (table, _)] = [predicted(swaying), predicted(swaying_on_a_table)];
    for (low, high) in floor.ground.bodies.iter().zip(table.ground.bodies.iter()) {
        for frame in 50..350 {
            assert!((low.force[frame] - high.force[frame]).norm() < 1e-6 * weight, "frame {frame}");
            let raised = high.center_of_pressure[frame] - low.center_of_pressure[frame];
            assert!((raised - Vec3::y() * 0.75).norm() < 1e-6, "frame {frame}: {raised:?}");
            assert!((low.free_moment[frame] - high.free_moment[frame]).norm() < 1e-6 * weight, "frame {frame}");
        }
    }
}
