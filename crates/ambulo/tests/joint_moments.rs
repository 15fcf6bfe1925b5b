//! Moments of three planes from the reactions in hip, knee and ankle.
//!
//! Identities: where a joint has coordinates about the axes, the moments are their generalised forces; frames of
//! bodies, axes of the world and the other side change nothing. A closed form: the moment of a vertical force beside
//! the knee. The comparison with Plug-in-Gait is in plug_in_gait_planes.rs.

use crate::anatomy_models;
use crate::common::random::{Random, load_on, state};
use crate::common::{State, assert_near, load_series, trajectory, turn};
use ambulo::analysis::stance_load;
use ambulo::dynamics::{self, BodyLoad, Forces, JointMoments, Workspace};
use ambulo::model::anatomy::Movement::{self, *};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{BodyId, Coordinate, CoordinateId, Displacement, Function, Joint, JointAxis, Model, Side};
use ambulo::spatial::{Mat3, Pose, Vec3, Wrench};

/// Sums over a leg of four bodies, relative to the largest moment: as in identities.rs.
const RELATIVE: f64 = 1e-12;
/// All movements of hip, knee and ankle.
const ALL: [Movement; 9] = [
    HipFlexion,
    HipAdduction,
    HipRotation,
    KneeFlexion,
    KneeAdduction,
    KneeRotation,
    AnkleDorsiflexion,
    SubtalarInversion,
    FootRotation,
];

fn figure() -> Model {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: true };
    full_body(&build).unwrap().model
}

/// Random loads on both feet.
fn loads(r: &mut Random, model: &Model) -> Vec<BodyLoad> {
    let feet = model.anatomy().feet().unwrap();
    [feet.right, feet.left].map(|foot| load_on(r, foot)).to_vec()
}

/// The moments of one frame, by side and movement; `None` for legs without moments of three planes.
fn moments(model: &Model, state: &State, loads: &[BodyLoad]) -> Option<[[f64; 9]; 2]> {
    let path = trajectory(model, std::slice::from_ref(state));
    let found = JointMoments::new(model, &path, load_series(&[loads.to_vec()]));
    found.at(KneeAdduction, Side::Right, 0)?;
    Some(Side::BOTH.map(|side| ALL.map(|movement| found.at(movement, side, 0).unwrap())))
}

fn largest(moments: &[[f64; 9]; 2]) -> f64 {
    moments.iter().flatten().fold(1.0, |most, moment| most.max(moment.abs()))
}

fn generalized(model: &Model, state: &State, loads: &[BodyLoad]) -> Forces {
    let path = trajectory(model, std::slice::from_ref(state));
    dynamics::inverse(&mut Workspace::new(model), &path, &load_series(&[loads.to_vec()]))
}

/// The generalised force that drives a movement, if a coordinate measures it.
fn of_coordinate(model: &Model, forces: &Forces, movement: Movement, side: Side) -> Option<f64> {
    let (id, sign) = model.anatomy().coordinate(movement, Some(side))?;
    Some(sign * forces.generalized[id.index()][0])
}

/// The figure with knees that also turn about a floating and a long axis.
fn free_knees() -> Model {
    let model = figure();
    let (mut bodies, mut coordinates) = (model.bodies().to_vec(), model.coordinates().to_vec());
    for side in Side::BOTH {
        let knee = model.anatomy().legs()[side].unwrap().knee;
        let sign = if side == Side::Right { 1.0 } else { -1.0 };
        for (stem, direction) in [("knee_adduction", Vec3::x()), ("knee_rotation", Vec3::y())] {
            let id = CoordinateId(coordinates.len());
            coordinates.push(Coordinate { name: format!("{stem}_{}", side.letter()), ..coordinates[8].clone() });
            let linear = Function::Linear { slope: 1.0, intercept: 0.0 };
            let axis = JointAxis { direction: direction * sign, displacement: Displacement::Follows(id, linear) };
            bodies[knee.index()].joint.rotations.push(axis);
        }
    }
    Model::new("free knees", model.gravity(), bodies, coordinates, Vec::new()).unwrap()
}

#[test]
fn on_free_axes_the_reaction_is_the_generalised_force() {
    // The sagittal axis of each joint is its own; the hip and a free knee have all three.
    let own = [HipFlexion, HipAdduction, HipRotation, KneeFlexion, AnkleDorsiflexion];
    let free = [HipFlexion, HipAdduction, HipRotation, KneeFlexion, KneeAdduction, KneeRotation, AnkleDorsiflexion];
    let mut cases = vec![(figure(), &own[..]), (free_knees(), &free[..])];
    // Knees of published models slide while they flex, so that their generalised forces contain forces.
    let hips = [HipFlexion, HipAdduction, HipRotation, AnkleDorsiflexion];
    cases.extend(anatomy_models::gait2392().into_iter().chain(anatomy_models::rajagopal()).map(|m| (m, &hips[..])));
    for (model, movements) in &cases {
        for seed in 0..20 {
            let mut r = Random::new(seed);
            let (state, loads) = (state(&mut r, model), loads(&mut r, model));
            let (found, forces) = (moments(model, &state, &loads).unwrap(), generalized(model, &state, &loads));
            for (side, found) in Side::BOTH.into_iter().zip(&found) {
                for movement in *movements {
                    let expected = of_coordinate(model, &forces, *movement, side).unwrap();
                    let moment = found[ALL.iter().position(|known| known == movement).unwrap()];
                    let what = format!("{} {movement:?} {side}, seed {seed}", model.name());
                    assert_near(moment, expected, RELATIVE * largest(&[*found; 2]), &what);
                }
            }
        }
    }
}

#[test]
fn a_hinge_carries_what_free_axes_would_have_to_drive() {
    let (hinged, free) = (figure(), free_knees());
    for seed in 0..20 {
        let mut r = Random::new(seed);
        let (state, loads) = (state(&mut r, &hinged), loads(&mut r, &hinged));
        let extended = |values: &[f64]| [values, &[0.0; 4]].concat();
        let at_rest = State { q: extended(&state.q), qd: extended(&state.qd), qdd: extended(&state.qdd) };
        let found = moments(&hinged, &state, &loads).unwrap();
        let forces = generalized(&free, &at_rest, &loads);
        for (side, found) in Side::BOTH.into_iter().zip(&found) {
            for (k, movement) in [(4, KneeAdduction), (5, KneeRotation)] {
                let expected = of_coordinate(&free, &forces, movement, side).unwrap();
                assert_near(found[k], expected, RELATIVE * largest(&[*found; 2]), &format!("{movement:?} {side}"));
                assert!((found[k] + expected).abs() > 1e-3 * largest(&[*found; 2]), "the other sign is seen");
            }
        }
    }
}

#[test]
fn frames_of_bodies_and_of_the_world_change_nothing() {
    for (number, model) in [Some(figure()), anatomy_models::gait2392()].into_iter().flatten().enumerate() {
        let mut r = Random::new(number as u64);
        let (state, loads) = (state(&mut r, &model), loads(&mut r, &model));
        let expected = moments(&model, &state, &loads).unwrap();
        let other_frames = anatomy_models::reframed(&model, || r.pose());
        let found = moments(&other_frames, &state, &loads).unwrap();
        assert_same(&found, &expected, 1e-10 * largest(&expected));
        let (axis, angle) = (Vec3::new(1.0, 2.0, -0.5), 1.3);
        let turned = turn(axis, angle);
        let place = |point: Vec3| turned * point + Vec3::new(0.3, -2.0, 7.0);
        let moved = |load: &BodyLoad| {
            let wrench = Wrench { moment: turned * load.wrench.moment, force: turned * load.wrench.force };
            BodyLoad { point: place(load.point), wrench, ..*load }
        };
        let in_other_world: Vec<BodyLoad> = loads.iter().map(moved).collect();
        let found = moments(&anatomy_models::turned(&model, &turned), &state, &in_other_world).unwrap();
        assert_same(&found, &expected, 1e-10 * largest(&expected));
        // Loads that stay behind are seen.
        let wrong = moments(&anatomy_models::turned(&model, &turned), &state, &loads).unwrap();
        assert!(far(&wrong, &expected) > 1e-3 * largest(&expected));
    }
}

#[test]
fn a_mirrored_person_has_mirrored_moments() {
    for (number, model) in [Some(figure()), anatomy_models::gait2392()].into_iter().flatten().enumerate() {
        let mut r = Random::new(7 + number as u64);
        let (state, loads) = (state(&mut r, &model), loads(&mut r, &model));
        let expected = moments(&model, &state, &loads).unwrap();
        let m = Mat3::from_diagonal(&Vec3::new(1.0, 1.0, -1.0));
        let image = |load: &BodyLoad| BodyLoad {
            point: m * load.point,
            wrench: Wrench { moment: -(m * load.wrench.moment), force: m * load.wrench.force },
            ..*load
        };
        let mirrored: Vec<BodyLoad> = loads.iter().map(image).collect();
        let [left, right] = moments(&anatomy_models::mirrored(&model), &state, &mirrored).unwrap();
        assert_same(&[right, left], &expected, 1e-10 * largest(&expected));
        assert!(far(&[left, right], &expected) > 1e-3 * largest(&expected), "sides are told apart");
    }
}

fn far(a: &[[f64; 9]; 2], b: &[[f64; 9]; 2]) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

#[track_caller]
fn assert_same(found: &[[f64; 9]; 2], expected: &[[f64; 9]; 2], allowed: f64) {
    assert!(far(found, expected) <= allowed, "{found:?}, expected {expected:?}");
}

/// The figure without weight.
fn weightless() -> Model {
    let model = figure();
    Model::new("weightless", Vec3::zeros(), model.bodies().to_vec(), model.coordinates().to_vec(), Vec::new()).unwrap()
}

/// In upright standing, F upwards at a distance d towards the middle from the knee: the muscles must abduct with d F.
#[test]
fn a_vertical_force_beside_the_knee_adducts_it_by_force_times_distance() {
    let (model, force, inwards, ahead) = (weightless(), 600.0, 0.04, 0.05);
    let rest = State::rest(&model);
    let poses = model.poses(&rest.q);
    for (k, side) in Side::BOTH.into_iter().enumerate() {
        let leg = model.anatomy().legs()[side].unwrap();
        let center = |joint: BodyId| {
            let Joint { child_from_joint: Pose { translation, .. }, .. } = model.bodies()[joint.index()].joint;
            poses[joint.index()].place(translation)
        };
        let sign = if side == Side::Right { 1.0 } else { -1.0 };
        let knee = center(leg.knee);
        let point = Vec3::new(knee.x + ahead, 0.0, knee.z - sign * inwards);
        let wrench = Wrench { moment: Vec3::new(0.0, 3.0, 0.0), force: Vec3::new(0.0, force, 0.0) };
        let found = moments(&model, &rest, &[BodyLoad { body: leg.foot, point, wrench }]).unwrap()[k];
        let of = |movement: Movement| found[ALL.iter().position(|known| *known == movement).unwrap()];
        assert_near(of(KneeAdduction), -inwards * force, 1e-9, "adduction");
        // The force passes in front of the knee and extends it: the muscles flex.
        assert_near(of(KneeFlexion), ahead * force, 1e-9, "flexion");
        // A free moment that turns the foot to the left turns the right one inwards.
        assert_near(of(KneeRotation), -sign * 3.0, 1e-9, "rotation");
        let ankle = center(leg.ankle);
        assert_near(of(SubtalarInversion), -sign * (ankle.z - point.z) * force, 1e-9, "inversion");
        assert_near(of(FootRotation), -sign * 3.0, 1e-9, "rotation of the foot");
        let hip = center(leg.hip);
        assert_near(of(HipAdduction), -sign * (hip.z - point.z) * force, 1e-9, "hip adduction");
        // The other leg is free.
        let other = moments(&model, &rest, &[BodyLoad { body: leg.foot, point, wrench }]).unwrap()[1 - k];
        assert!(other.iter().all(|moment| moment.abs() < 1e-9), "{other:?}");
    }
}

#[test]
fn a_body_that_moves_in_a_plane_has_no_moments_of_the_other_planes() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: 1.75, toe_joint: true };
    let planar = build.human().unwrap().model;
    assert!(moments(&planar, &State::rest(&planar), &[]).is_none());
}

/// M = sin π t / T: both peaks are 1, the impulse is 2 T / π.
#[test]
fn peaks_and_impulse_of_half_a_sine() {
    let sine = |k: usize| (std::f64::consts::PI * k as f64 / 100.0).sin();
    let curve: Vec<f64> = (0..=100).map(sine).collect();
    let [early, late, impulse] = stance_load(&curve, 0.6).unwrap();
    // The trapezium rule misses (π/100)²/12 of the area.
    let allowed = 0.6 * 1e-4;
    assert!((early - 1.0).abs() < 1e-12 && (late - 1.0).abs() < 1e-12, "{early} {late}");
    assert!((impulse - 0.6 * std::f64::consts::FRAC_2_PI).abs() < allowed, "{impulse}");
    // What unloads the medial side counts for nothing, a gap makes the stance unknown.
    let lowered: Vec<f64> = curve.iter().map(|x| -x).collect();
    assert!(stance_load(&lowered, 0.6).unwrap()[2].abs() < f64::EPSILON);
    assert_eq!(stance_load(&[0.1, f64::NAN, 0.3], 0.6), None);
    assert_eq!(stance_load(&[0.1], 0.6), None);
    // Peaks belong to their halves.
    assert_eq!(stance_load(&[0.0, 0.5, 0.2, 0.4, 0.0], 1.0).unwrap()[..2], [0.5, 0.4]);
}
