//! Times and distances of an invented walk: identities, and the same walk on a belt and round a bend.

use crate::common::assert_near;
use ambulo::analysis::{Analysis, StrideQuantity, TimesAndDistances, times_and_distances};
use ambulo::findings::Findings;
use ambulo::kinematics::Trajectory;
use ambulo::model::Model;
use ambulo::motion::{Smoother, coordinates_from_table, force_recordings};
use ambulo::study::{self, ForceFilter, MeasuredForces, Settings, Source};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;
use std::path::Path;
use std::sync::Arc;

/// The body and the analysis of an invented walk of two strides.
fn walk() -> (Model, Analysis) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../ambulo-cli/tests/recording");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let mut findings = Findings::default();
    let model = Model::from_osim(&read("figure.osim"), &mut findings).unwrap();
    let table = |name: &str| Table::read_storage(&read(name)).unwrap().0;
    let motion = coordinates_from_table(&model, &table("walk.mot"), "walk.mot", &mut findings).unwrap();
    let loads = ExternalLoads::read(&read("walk_grf.xml")).unwrap().0;
    let plates = force_recordings(&model, &loads, &table("walk_grf.mot"), &mut findings).unwrap();
    let source = Source::coordinates(model, motion).with_forces(MeasuredForces::OnBodies(plates));
    let settings = Settings { smoother: Smoother::Off, force_filter: ForceFilter::Off, ..Settings::default() };
    let outcome = study::run(source, &settings, &mut findings).unwrap();
    (outcome.body, outcome.analysis)
}

fn found(model: &Model, analysis: &Analysis) -> TimesAndDistances {
    times_and_distances(model, &model.anatomy().soles(model.stature().height_m), analysis)
}

fn mean(found: &TimesAndDistances, quantity: StrideQuantity) -> f64 {
    found.spread(quantity, None).unwrap().mean
}

/// Replaces values and rates of coordinates: `change` has the name, the instant, and value and rate of any coordinate
/// at that instant.
fn changed(
    model: &Model,
    analysis: &mut Analysis,
    change: impl Fn(&str, usize, &dyn Fn(&str) -> [f64; 2]) -> Option<[f64; 2]>,
) {
    let old = &analysis.trajectory;
    let column = |name: &str, frame: usize| {
        let id = model.coordinate(name).unwrap();
        [old.values(id)[frame], old.rates(id)[frame]]
    };
    let columns = model.coordinate_ids().map(|id| {
        let name = &model.coordinates()[id.index()].name;
        let pairs = (0..old.grid().frames).map(|frame| {
            let at = |name: &str| column(name, frame);
            change(name, frame, &at).unwrap_or_else(|| at(name))
        });
        let (values, rates): (Vec<f64>, Vec<f64>) = pairs.map(|[value, rate]| (value, rate)).unzip();
        [values, rates, old.accelerations(id).to_vec()]
    });
    analysis.trajectory = Trajectory::new(model, old.grid(), columns.collect()).unwrap();
}

#[test]
fn strides_go_as_far_as_the_body_does() {
    let (model, analysis) = walk();
    let found = found(&model, &analysis);
    let mean = |quantity| mean(&found, quantity);
    let distance = found.speed_m_s.unwrap() * mean(StrideQuantity::CycleTime);
    let stride = mean(StrideQuantity::StrideLength);
    // The invented walk slides; its speed is relative to the feet.
    assert!((stride / distance - 1.0).abs() < 0.05, "{stride} m, but the body moves {distance} m");
    assert_near(mean(StrideQuantity::StepLength), 0.5 * stride, 0.02, "a step is half a stride");
    assert!((0.05..0.3).contains(&mean(StrideQuantity::StepWidth)));
    assert_eq!(found.belt_speed_m_s, None);
    assert_eq!(found.path_speed_m_s, None, "a straight walk has one speed");
    assert!(found.turn.unwrap().to_degrees() < 5.0);
}

#[test]
fn times_add_up_to_the_cycle() {
    let (model, analysis) = walk();
    let found = found(&model, &analysis);
    let mean = |quantity| mean(&found, quantity);
    let cycle = mean(StrideQuantity::CycleTime);
    assert_near(mean(StrideQuantity::StanceTime) + mean(StrideQuantity::SwingTime), cycle, 1e-12, "stance and swing");
    assert_near(mean(StrideQuantity::Stance) + mean(StrideQuantity::Swing), 1.0, 1e-12, "shares");
    let double = mean(StrideQuantity::InitialDoubleSupport) + mean(StrideQuantity::TerminalDoubleSupport);
    assert_near(double, mean(StrideQuantity::DoubleSupport), 0.002, "both double supports");
    assert_near(mean(StrideQuantity::StepTime), 0.5 * cycle, 0.05, "a step is half a cycle");
    assert_near(mean(StrideQuantity::Cadence) * cycle, 2.0, 0.01, "two steps per cycle");
}

#[test]
fn a_belt_changes_no_step() {
    let (model, mut analysis) = walk();
    let ground = found(&model, &analysis);
    let speed = 1.2;
    let grid = analysis.trajectory.grid();
    let passed = |frame: usize| grid.time(frame) - grid.start_s;
    changed(&model, &mut analysis, |name, frame, at| {
        let [value, rate] = at(name);
        (name == "pelvis_tx").then(|| [value - speed * passed(frame), rate - speed])
    });
    for foot in Arc::make_mut(&mut analysis.ground.bodies) {
        for (frame, place) in foot.center_of_pressure.iter_mut().enumerate() {
            place.x -= speed * passed(frame);
        }
    }
    let belt = found(&model, &analysis);
    // The feet of the invented walk slide a little, so that the belt found is not exactly the one that was added.
    assert_near(belt.belt_speed_m_s.unwrap(), speed, 0.05, "belt");
    for quantity in [StrideQuantity::StepLength, StrideQuantity::StrideLength, StrideQuantity::StepWidth] {
        let (on, off) = (mean(&belt, quantity), mean(&ground, quantity));
        assert!((on - off).abs() < 0.05 * off.max(0.2), "{quantity:?}: {on} and {off} m");
    }
}

#[test]
fn a_turn_keeps_the_steps() {
    let (model, analysis) = walk();
    let straight = found(&model, &analysis);
    // The line along which the body walks becomes a circle to the right.
    let radius = 2.5;
    let mut bent = analysis.clone();
    let start = analysis.trajectory.values(model.coordinate("pelvis_tx").unwrap())[0];
    changed(&model, &mut bent, |name, _, at| {
        let [[along, rate], [across, across_rate]] = [at("pelvis_tx"), at("pelvis_tz")];
        let (angle, turning) = ((along - start) / radius, rate / radius);
        let own = radius - across;
        match name {
            "pelvis_tx" => Some([own * angle.sin(), own * angle.cos() * turning - across_rate * angle.sin()]),
            "pelvis_tz" => Some([radius - own * angle.cos(), own * angle.sin() * turning + across_rate * angle.cos()]),
            "pelvis_rotation" => {
                let [value, rate] = at(name);
                Some([value - angle, rate - turning])
            }
            _ => None,
        }
    });
    // What the ground does turns with the body.
    let [x, z] = ["pelvis_tx", "pelvis_tz"].map(|name| model.coordinate(name).unwrap());
    let moved: Vec<[f64; 2]> =
        bent.trajectory.values(x).iter().zip(bent.trajectory.values(z)).map(|(x, z)| [*x, *z]).collect();
    for foot in Arc::make_mut(&mut bent.ground.bodies) {
        for (frame, place) in foot.center_of_pressure.iter_mut().enumerate() {
            let pelvis = |of: &Analysis| [x, z].map(|id| of.trajectory.values(id)[frame]);
            let [old, new] = [pelvis(&analysis), moved[frame]];
            let (sin, cos) = ((old[0] - start) / radius).sin_cos();
            let away = [place.x - old[0], place.z - old[1]];
            place.x = new[0] + cos * away[0] - sin * away[1];
            place.z = new[1] + sin * away[0] + cos * away[1];
        }
    }
    let turning = found(&model, &bent);
    // The inner foot moves less far than the outer one, and a stride is the chord of its arc.
    for (quantity, slack) in
        [(StrideQuantity::StepLength, 0.05), (StrideQuantity::StrideLength, 0.09), (StrideQuantity::StepWidth, 0.02)]
    {
        for side in ambulo::model::Side::BOTH {
            let [on, off] = [&turning, &straight].map(|found| found.spread(quantity, Some(side)).unwrap().mean);
            assert!((on - off).abs() < slack, "{quantity:?}: {on} m in the turn, {off} m on the straight path");
        }
    }
    assert!(turning.turn.unwrap().to_degrees() > 20.0, "{:?}", turning.turn);
    // To the right of the walking direction x is z.
    let velocity = turning.pelvis_velocity.unwrap();
    assert!(velocity.x > 0.5 && velocity.z > 0.1, "{velocity:?}");
    let straight_speed = straight.pelvis_velocity.unwrap().norm();
    let along = turning.path_speed_m_s.unwrap();
    assert!((along / straight_speed - 1.0).abs() < 0.03, "{along} m/s along the arc, {straight_speed} m/s before");
}
