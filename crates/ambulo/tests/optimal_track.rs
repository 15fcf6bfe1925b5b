//! Tracking of recorded motions by feet on soft ground: a synthetic walk with known forces, and a person on force
//! plates.

use crate::shared_data;
use crate::walks;
use ambulo::analysis::feasibility::Person;
use ambulo::analysis::{Analysis, PredictionInput, analyse_predicted_trajectory, track};
use ambulo::findings::Findings;
use ambulo::ground::feet;
use ambulo::ground::predict::{PredictSettings, Prediction};
use ambulo::kinematics::Trajectory;
use ambulo::model::anatomy::Sole;
use ambulo::model::{Bushing, BushingEnd, BySide, CoordinateKind, Drive, Model, Movement, Resistance, Side, from_osim};
use ambulo::motion::{Window, coordinates_from_table};
use ambulo::optimal::{NO_ROOT_FORCE, TrackError, TrackSettings, TrackedMotion};
use ambulo::simulation::synthetic::SyntheticWalk;
use ambulo::spatial::{Pose, Vec3};
use ambulo::study::{self, ForceTable, GroundSettings, MeasuredForces, Outcome, Settings, Source};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use std::sync::LazyLock;

/// A walk that needs no forces but those of its feet: one of the built-in plans.
static WALK: LazyLock<&SyntheticWalk> = LazyLock::new(|| walks::optimal(walks::MAN, 1));

/// The walk with errors as those of a recording: waves of 0.4 degrees and 2 mm, other ones for each coordinate, on a
/// floor of velocity `belt`.
fn recorded(belt: Vec3) -> Trajectory {
    let model = &WALK.human.model;
    let grid = WALK.trajectory.grid();
    let column = |c: usize| {
        let coordinate = &model.coordinates()[c];
        let id = model.coordinate(&coordinate.name).unwrap();
        let size = if coordinate.kind == CoordinateKind::Rotation { 0.4_f64.to_radians() } else { 0.002 };
        let omega = std::f64::consts::TAU * (1.0 + 0.37 * (c % 6) as f64);
        let moved = match model.anatomy().meaning(id).map(|meaning| meaning.movement) {
            Some(Movement::PelvisForward) => belt.x,
            _ => 0.0,
        };
        let wave = |k: usize, turn: f64| (omega * grid.time(k) + 1.3 * c as f64 + turn).sin();
        let [q, qd, qdd] = [WALK.trajectory.values(id), WALK.trajectory.rates(id), WALK.trajectory.accelerations(id)];
        let quarter = std::f64::consts::FRAC_PI_2;
        [
            (0..grid.frames).map(|k| q[k] + size * wave(k, 0.0) + moved * grid.step_s * k as f64).collect(),
            (0..grid.frames).map(|k| qd[k] + size * omega * wave(k, quarter) + moved).collect(),
            (0..grid.frames).map(|k| qdd[k] - size * omega * omega * wave(k, 0.0)).collect(),
        ]
    };
    Trajectory::new(model, grid, (0..model.coordinates().len()).map(column).collect()).unwrap()
}

fn predicted(trajectory: Trajectory, soles: &BySide<Option<Sole>>) -> (Analysis, Prediction) {
    let input = PredictionInput { soles, settings: &PredictSettings::default(), plates_filter: None };
    let findings = &mut Findings::default();
    let found = analyse_predicted_trajectory(&WALK.human.model, trajectory, &[], None, &input, findings).unwrap();
    (found.analysis, found.prediction)
}

fn tracked(belt: Vec3) -> (Analysis, Analysis, TrackedMotion) {
    let soles = Person::of_human(&WALK.human).soles;
    let (analysis, prediction) = predicted(recorded(belt), &soles);
    let settings = TrackSettings::default();
    let (found, motion) = track(&WALK.human.model, &analysis, &prediction, &soles, &settings).unwrap();
    (analysis, found, motion)
}

static AT_REST: LazyLock<(Analysis, Analysis, TrackedMotion)> = LazyLock::new(|| tracked(Vec3::zeros()));

fn weight_n() -> f64 {
    WALK.human.model.mass() * WALK.human.model.gravity().norm()
}

/// Root mean square of the error of the total ground force along an axis [body weights], without the ends of the
/// motion.
fn error_of_total(analysis: &Analysis, axis: usize) -> f64 {
    let truth = |time_s: f64| -> f64 {
        let of = |load: &ambulo::motion::ForceRecording| {
            let k = load.times.partition_point(|t| *t < time_s - 1e-6).min(load.times.len() - 1);
            load.force[k][axis]
        };
        WALK.loads.iter().map(of).sum()
    };
    let grid = analysis.trajectory.grid();
    let feet = feet(&WALK.human.model, &analysis.ground);
    let error = |k: usize| feet.iter().map(|(_, foot)| foot.force[k][axis]).sum::<f64>() - truth(grid.time(k));
    let inside: Vec<f64> = (10..grid.frames - 10).map(error).collect();
    (inside.iter().map(|e| e * e).sum::<f64>() / inside.len() as f64).sqrt() / weight_n()
}

/// Waves of 2 mm at 1 to 2.9 Hz accelerate the body by up to 0.6 m/s², 5 % of body weight rms. Tracking does not know
/// them from the walk, so errors of this size remain; it must not add its own.
#[test]
fn tracking_recovers_the_forces_of_a_walk_with_errors() {
    let (before, after, motion) = &*AT_REST;
    let errors = [before, after].map(|analysis| [0, 1, 2].map(|axis| error_of_total(analysis, axis)));
    println!("{errors:?}, {:?} {:?}", motion.residual, motion.moved);
    for (was, is) in errors[0].iter().zip(errors[1]) {
        assert!(is < 1.1 * was && is < 0.08, "{errors:?}");
    }
    for (side, foot) in feet(&WALK.human.model, &after.ground) {
        let (_, expected) = feet(&WALK.human.model, &before.ground).into_iter().find(|(of, _)| *of == side).unwrap();
        let apart = foot.force.iter().zip(&expected.force).map(|(a, b)| (a - b).norm_squared()).sum::<f64>();
        let rms = (apart / foot.force.len() as f64).sqrt() / weight_n();
        assert!(rms < 0.1, "{side:?}: {rms} body weights from the prediction");
    }
}

#[test]
fn feet_on_the_ground_supply_all_external_forces_of_a_tracked_motion() {
    let (before, after, motion) = &*AT_REST;
    // In the mean; the largest one, at a strike, is limited below.
    assert!(motion.residual.0 <= NO_ROOT_FORCE, "{:?}", motion.residual);
    // Inverse dynamics of the results, which knows nothing of the solver, agrees.
    let [was, is] = [before, after].map(|analysis| analysis.residual.unwrap());
    assert!(is.force_peak_n < 1e-3 * weight_n() && was.force_peak_n > 10.0 * is.force_peak_n, "{was:?} {is:?}");
    assert!(is.moment_peak_nm < 1e-3 * weight_n(), "{is:?}");
    assert!(motion.moved[0] < 3_f64.to_radians() && motion.moved[1] < 0.01, "{:?}", motion.moved);
}

/// The same motion on a treadmill: forces are the same, up to rounding and the detected velocity of the belt.
#[test]
fn a_belt_changes_no_force() {
    let soles = Person::of_human(&WALK.human).soles;
    let velocity = Vec3::new(-1.2, 0.0, 0.0);
    let (resting, mut prediction) = predicted(recorded(Vec3::zeros()), &soles);
    let (moving, _) = predicted(recorded(velocity), &soles);
    for fall in &mut prediction.footfalls.falls {
        fall.floor_velocity = velocity;
    }
    let step_s = resting.trajectory.grid().step_s;
    let feet_of = prediction.ground.bodies.iter().cloned().map(|mut foot| {
        for (k, center) in foot.center_of_pressure.iter_mut().enumerate() {
            *center += velocity * (step_s * k as f64);
        }
        foot
    });
    prediction.ground.bodies = feet_of.collect();
    let moving = Analysis { trajectory: moving.trajectory, ..resting.clone() };
    let settings = TrackSettings::default();
    let (_, found) = track(&WALK.human.model, &moving, &prediction, &soles, &settings).unwrap();
    let (_, _, still) = &*AT_REST;
    for (a, b) in found.feet.iter().zip(&still.feet) {
        for (a, b) in a.force.iter().zip(&b.force) {
            assert!((a - b).norm() < 0.01 * weight_n(), "{a:?} {b:?}");
        }
    }
}

#[test]
fn what_cannot_be_tracked_is_refused() {
    let soles = Person::of_human(&WALK.human).soles;
    let (analysis, prediction) = predicted(recorded(Vec3::zeros()), &soles);
    let settings = TrackSettings::default();
    let refused = |change: &dyn Fn(&mut Prediction)| {
        let mut changed = prediction.clone();
        change(&mut changed);
        track(&WALK.human.model, &analysis, &changed, &soles, &settings).unwrap_err()
    };
    let stairs = refused(&|prediction| prediction.footfalls.falls[0].floor_height_m += 0.2);
    assert!(matches!(stairs, TrackError::UnevenFloor { what: "height", .. }), "{stairs}");
    let belts = refused(&|prediction| prediction.footfalls.falls[0].floor_velocity = Vec3::x());
    assert!(matches!(belts, TrackError::UnevenFloor { what: "velocity", .. }), "{belts}");
    let flight = refused(&|prediction| prediction.footfalls.falls.clear());
    assert!(matches!(flight, TrackError::NoStance), "{flight}");
    let high = refused(&|prediction| {
        prediction.footfalls.falls.iter_mut().for_each(|fall| fall.floor_height_m += 0.5);
    });
    assert!(matches!(high, TrackError::SoleOffFloor { .. }), "{high}");
    let nobody = track(&WALK.human.model, &analysis, &prediction, &BySide::default(), &settings).unwrap_err();
    assert!(matches!(nobody, TrackError::NoFeet { .. }), "{nobody}");
    let end = BushingEnd { body: None, frame: Pose::IDENTITY };
    let none = Resistance { angular: Vec3::zeros(), linear: Vec3::zeros() };
    let strap = Bushing { name: "strap".into(), ends: [end; 2], stiffness: none, damping: none, groups: Vec::new() };
    let strapped = WALK.human.model.clone().with_bushings(vec![strap]).unwrap();
    let held = track(&strapped, &analysis, &prediction, &soles, &settings).unwrap_err();
    assert!(matches!(held, TrackError::Bushing { ref bushing, .. } if bushing == "strap"), "{held}");
}

/// Gait2392's walk on a treadmill with force plates: the published coordinates, from which the plates know nothing.
fn person() -> Option<(Model, Outcome)> {
    let folder = shared_data::data()?.join("opensim-gait2392-subject01");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let findings = &mut Findings::default();
    let document = OsimModel::read(&read("subject01_simbody.osim")).unwrap();
    let model = from_osim(&document, findings).unwrap();
    let (table, _) = Table::read_storage(&read("subject01_walk1_ik.mot")).unwrap();
    let motion = coordinates_from_table(&model, &table, "the walk", findings).unwrap();
    let (table, _) = Table::read_storage(&read("core-id-test/subject01_walk1_grf.mot")).unwrap();
    let forces = vec![
        ExternalForce::with_prefix("right", "calcn_r", "ground_force_"),
        ExternalForce::with_prefix("left", "calcn_l", "l_ground_force_"),
    ];
    let loads = Some(ExternalLoads { name: "feet".into(), datafile: None, forces });
    let source =
        Source::coordinates(model.clone(), motion).with_forces(MeasuredForces::Table(ForceTable { table, loads }));
    let window = Window { from_s: Some(0.6), to_s: Some(2.4) };
    let settings = Settings { ground: GroundSettings::Tracked, window, ..Settings::default() };
    Some((model, study::run(source, &settings, findings).unwrap()))
}

/// Limits: about 1.5 times what was found, RMSE 4.5 %, 1.6 %, 1.1 % of body weight (docs/measured/VALIDATION.md).
#[test]
fn the_forces_of_a_person_are_near_those_of_force_plates() {
    let Some((model, outcome)) = person() else { return };
    let found = outcome.prediction.as_ref().unwrap();
    let (tracked, agreement) = (found.tracked.as_ref().unwrap(), found.agreement.as_ref().unwrap());
    for foot in &agreement.feet {
        let found = [foot.vertical, foot.fore_aft, foot.lateral].map(|force| [force.rmse_bw, force.r]);
        println!("{} {found:?}", foot.side.letter());
        assert!(found[0][0] < 0.07 && found[0][1] > 0.98, "{found:?}");
        assert!(found[1][0] < 0.03 && found[1][1] > 0.96, "{found:?}");
        assert!(found[2][0] < 0.02, "{found:?}");
    }
    assert!(tracked.residual.1 <= 2e-3, "{tracked:?}");
    // The knees of this model roll along curves; locked coordinates keep their values.
    for (id, coordinate) in model.coordinate_ids().zip(model.coordinates()) {
        if matches!(coordinate.drive, Drive::Locked) {
            let values = outcome.analysis.trajectory.values(id);
            assert!(values.iter().all(|q| (q - coordinate.default_value).abs() < 1e-9), "{}", coordinate.name);
        }
    }
    assert!(agreement.feet.iter().any(|foot| foot.side == Side::Right));
}
