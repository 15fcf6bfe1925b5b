//! Anatomy of a model from its joints alone: published models and built-in figures, also renamed, mirrored, rotated and
//! truncated.

use crate::anatomy_models;
use crate::anatomy_models::{change, mirrored, published, reframed, renamed, turned, without};
use crate::common::assert_near;
use crate::common::random::{self, Random, Recipe};
use crate::free_bodies;
use crate::free_bodies::{DOWN_Y, free_bodies};
use crate::shared_data;
use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::findings::Findings;
use ambulo::kinematics::Posture;
use ambulo::kinematics::retarget::retarget;
use ambulo::model::anatomy::{Anatomy, Meaning, Movement};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::model::{BodyId, BySide, Drive, Model, Side};
use ambulo::motion::skeleton::skeleton_from_bvh;
use ambulo::spatial::{Mat3, Pose, Vec3};

/// Signs of the Gait2392 family, by the name of the coordinate without its side.
const SIGNS: [(&str, Movement, f64); 21] = [
    ("pelvis_tilt", Movement::PelvicTilt, -1.0),
    ("pelvis_list", Movement::PelvicObliquity, -1.0),
    ("pelvis_rotation", Movement::PelvicRotation, 1.0),
    ("pelvis_tx", Movement::PelvisForward, 1.0),
    ("pelvis_ty", Movement::PelvisUp, 1.0),
    ("pelvis_tz", Movement::PelvisRight, 1.0),
    ("hip_flexion", Movement::HipFlexion, 1.0),
    ("hip_adduction", Movement::HipAdduction, 1.0),
    ("hip_rotation", Movement::HipRotation, 1.0),
    ("knee_angle", Movement::KneeFlexion, -1.0),
    ("ankle_angle", Movement::AnkleDorsiflexion, 1.0),
    ("subtalar_angle", Movement::SubtalarInversion, 1.0),
    ("mtp_angle", Movement::ToeExtension, 1.0),
    ("lumbar_extension", Movement::TrunkLean, -1.0),
    ("lumbar_bending", Movement::TrunkObliquity, -1.0),
    ("lumbar_rotation", Movement::TrunkRotation, 1.0),
    ("L5_S1_Flex_Ext", Movement::TrunkLean, -1.0),
    ("L5_S1_Lat_Bending", Movement::TrunkObliquity, -1.0),
    ("L5_S1_axial_rotation", Movement::TrunkRotation, 1.0),
    ("knee_adduction", Movement::KneeAdduction, 1.0),
    ("knee_rotation", Movement::KneeRotation, 1.0),
];

fn built() -> Vec<Model> {
    let build = |table, toe_joint| Build { table, mass: 72.5, height: 1.78, toe_joint };
    let planar = SegmentTable::ALL.map(|table| [true, false].map(|toes| build(table, toes).human().unwrap().model));
    let spatial = SegmentTable::ALL.map(|table| full_body(&build(table, true)).unwrap().model);
    planar.into_iter().flatten().chain(spatial).collect()
}

fn skeletons() -> Vec<Model> {
    let files = ["AV_8Walk_Meredith_HVHA_Rep1.bvh", "01_01.bvh"];
    let Some(data) = shared_data::data() else { return Vec::new() };
    let body = |file: &str| {
        let bvh = ambulo_formats::bvh::Bvh::read(&std::fs::read(data.join("bvh").join(file)).unwrap()).unwrap().0;
        let skeleton = skeleton_from_bvh(&bvh, file, None, &mut Findings::default()).unwrap();
        let build = Build { table: SegmentTable::DeLevaMale, mass: 70.0, height: skeleton.height_m, toe_joint: true };
        retarget(&build, &skeleton, &mut Findings::default()).unwrap().human.model
    };
    files.map(body).to_vec()
}

fn everyone() -> Vec<Model> {
    published().into_iter().chain(built()).chain(skeletons()).collect()
}

fn name(model: &Model, body: Option<BodyId>) -> &str {
    body.map_or("none", |body| &model.bodies()[body.index()].name)
}

fn meanings(anatomy: &Anatomy, model: &Model) -> Vec<Option<Meaning>> {
    model.coordinate_ids().map(|id| anatomy.meaning(id)).collect()
}

fn parts(anatomy: &Anatomy) -> Vec<Option<BodyId>> {
    let legs = anatomy.legs().values().flat_map(|leg| {
        let of = |part: fn(&ambulo::model::anatomy::Leg) -> BodyId| leg.as_ref().map(part);
        [of(|l| l.thigh), of(|l| l.shank), of(|l| l.foot), leg.as_ref().and_then(|l| l.toes), of(|l| l.ankle)]
    });
    [anatomy.pelvis(), anatomy.trunk()].into_iter().chain(legs).collect()
}

#[test]
fn legs_pelvis_and_trunk_of_every_model_are_found() {
    for model in everyone() {
        let anatomy = model.anatomy();
        let has_lumbar = model.body("pelvis").is_some();
        assert_eq!(name(&model, anatomy.pelvis()), if has_lumbar { "pelvis" } else { "torso" }, "{}", model.name());
        assert_eq!(name(&model, anatomy.trunk()), if has_lumbar { "torso" } else { "none" }, "{}", model.name());
        for (side, leg) in anatomy.legs().iter() {
            let leg = leg.unwrap_or_else(|| panic!("{}: no {side} leg", model.name()));
            let is = |body: BodyId, stem: &str| {
                let expected = model.body(&format!("{stem}_{}", side.letter()));
                assert_eq!(Some(body), expected, "{} of {}", stem, model.name());
            };
            is(leg.thigh, "femur");
            is(leg.shank, "tibia");
            is(leg.foot, "calcn");
            is(leg.hip, "femur");
            is(leg.knee, "tibia");
            let has_talus = model.body("talus_r").is_some();
            is(leg.ankle, if has_talus { "talus" } else { "calcn" });
            assert_eq!(leg.toes, model.body(&format!("toes_{}", side.letter())), "{}", model.name());
        }
    }
}

#[test]
fn sides_agree_with_the_names_in_every_model() {
    for model in everyone() {
        for id in model.body_ids() {
            let name = &model.bodies()[id.index()].name;
            assert_eq!(model.anatomy().body_side(id), Side::of_name(name), "{name} of {}", model.name());
        }
        for id in model.coordinate_ids() {
            let name = &model.coordinates()[id.index()].name;
            assert_eq!(model.anatomy().coordinate_side(id), Side::of_name(name), "{name} of {}", model.name());
        }
    }
}

#[test]
fn every_coordinate_of_the_lower_body_has_its_movement_and_its_sign() {
    for model in everyone() {
        let rajagopals = model.body("patella_r").is_some() || model.body("sacrum").is_some();
        for id in model.coordinate_ids() {
            let coordinate = &model.coordinates()[id.index()];
            let (side, stem) = Side::split_name(&coordinate.name)
                .map_or_else(|| (None, coordinate.name.clone()), |(side, stem)| (Some(side), stem));
            let follows = matches!(coordinate.drive, Drive::Coupled(..));
            let row = SIGNS.iter().find(|(name, ..)| *name == stem && !follows);
            let expected = row.map(|(_, movement, sign)| {
                let sign = match movement {
                    Movement::KneeFlexion => [-1.0, 1.0][usize::from(rajagopals)],
                    // The axis of the toes is reversed in Pose2Sim's models: toes down is positive.
                    Movement::ToeExtension if model.body("sacrum").is_some() => -1.0,
                    _ => *sign,
                };
                Meaning { movement: *movement, side, sign }
            });
            assert_eq!(model.anatomy().meaning(id), expected, "{} of {}", coordinate.name, model.name());
            if let Some(Meaning { movement, side, sign }) = expected {
                assert_eq!(model.anatomy().coordinate(movement, side), Some((id, sign)));
            }
        }
    }
}

/// Signs follow from geometry: meaningless names change nothing except the sides of bodies in the middle.
#[test]
fn names_without_meaning_change_nothing() {
    for model in published().into_iter().chain(skeletons()) {
        let other = renamed(&model, |i, _| format!("x{i}"));
        let (found, expected) = (other.anatomy(), model.anatomy());
        assert_eq!(meanings(found, &other), meanings(expected, &model), "{}", model.name());
        assert_eq!(parts(found), parts(expected), "{}", model.name());
        for id in model.body_ids() {
            assert_eq!(found.body_side(id), expected.body_side(id), "{} of {}", name(&model, Some(id)), model.name());
        }
        for id in model.coordinate_ids() {
            assert_eq!(found.coordinate_side(id), expected.coordinate_side(id), "{}", model.name());
        }
        assert_eq!(other.stature(), model.stature());
        assert_eq!(found.soles(1.7), expected.soles(1.7));
    }
}

/// Names with the wrong side have no effect.
#[test]
fn geometry_has_priority_over_names() {
    for model in published() {
        let exchanged = renamed(&model, |_, name| match Side::split_name(name) {
            Some((side, stem)) => format!("{stem}_{}", side.other().letter()),
            None => name.to_owned(),
        });
        assert_eq!(meanings(exchanged.anatomy(), &exchanged), meanings(model.anatomy(), &model), "{}", model.name());
    }
}

#[test]
fn a_mirrored_model_has_swapped_sides_and_the_same_signs() {
    for model in published().into_iter().chain(built()) {
        let other = mirrored(&model);
        for id in model.coordinate_ids() {
            let expected = model.anatomy().meaning(id).map(|m| {
                let central = matches!(
                    m.movement,
                    Movement::PelvicObliquity
                        | Movement::PelvicRotation
                        | Movement::PelvisRight
                        | Movement::TrunkObliquity
                        | Movement::TrunkRotation
                );
                Meaning { side: m.side.map(Side::other), sign: if central { -m.sign } else { m.sign }, ..m }
            });
            let what = &model.coordinates()[id.index()].name;
            assert_eq!(other.anatomy().meaning(id), expected, "{what} of {}", model.name());
        }
        for id in model.body_ids() {
            let expected = model.anatomy().body_side(id).map(Side::other);
            assert_eq!(other.anatomy().body_side(id), expected, "{} of {}", name(&model, Some(id)), model.name());
        }
    }
}

/// World axes and body frames are arbitrary: z up and walking along -y, and frames rotated by any angle.
#[test]
fn axes_of_world_and_bodies_do_not_matter() {
    let z_up = Mat3::new(0., 0., 1., -1., 0., 0., 0., -1., 0.).transpose();
    let mut r = Random::new(5);
    for model in published().into_iter().chain(skeletons()) {
        for other in [turned(&model, &z_up), turned(&model, &r.rotation()), reframed(&model, || r.pose())] {
            assert_eq!(meanings(other.anatomy(), &other), meanings(model.anatomy(), &model), "{}", model.name());
            assert_eq!(parts(other.anatomy()), parts(model.anatomy()), "{}", model.name());
            assert_near(other.stature().height_m, model.stature().height_m, 1e-9, model.name());
        }
    }
}

#[test]
fn a_reversed_coordinate_has_the_other_sign() {
    for model in published() {
        for (id, body) in model.coordinate_ids().filter_map(|id| {
            let moves = |body: &BodyId| model.bodies()[body.index()].joint.coordinates().contains(&id);
            Some((id, model.body_ids().find(moves)?))
        }) {
            let Some(meaning) = model.anatomy().meaning(id) else { continue };
            let other = change(&model, |i, part| {
                if i == body.index() {
                    for axis in part.joint.rotations.iter_mut().chain(&mut part.joint.translations) {
                        anatomy_models::count_backwards(axis, id);
                    }
                }
            });
            let expected = Some(Meaning { sign: -meaning.sign, ..meaning });
            assert_eq!(other.anatomy().meaning(id), expected, "{}", model.coordinates()[id.index()].name);
        }
    }
}

#[test]
fn one_leg_is_a_leg_and_there_are_no_two_feet() {
    for model in published() {
        for side in Side::BOTH {
            let gone = model.anatomy().legs()[side].unwrap().thigh;
            let below = |body: BodyId| {
                let parent = |body: BodyId| model.bodies()[body.index()].joint.parent;
                std::iter::successors(Some(body), |body| parent(*body)).any(|body| body == gone)
            };
            let one = without(&model, below);
            for one in [renamed(&one, |i, _| format!("x{i}")), one] {
                let anatomy = one.anatomy();
                assert!(anatomy.legs()[side].is_none() && anatomy.legs()[side.other()].is_some(), "{}", model.name());
                assert_eq!(anatomy.feet(), None);
                let count = |model: &Model| {
                    let of_leg = |m: &Meaning| m.side == Some(side.other());
                    meanings(model.anatomy(), model).iter().flatten().filter(|m| of_leg(m)).count()
                };
                assert_eq!(count(&one), count(&model), "{}", model.name());
            }
        }
    }
}

#[test]
fn a_model_without_legs_has_only_the_sides_in_its_names() {
    // Five rods below each other are not a leg.
    let rods = free_bodies(DOWN_Y, &["a", "b", "c", "d", "e"].map(|name| (name, 1.0)));
    let pendulum = change(&rods, |i, body| {
        body.joint.parent = i.checked_sub(1).map(|i| rods.body_ids().nth(i).unwrap());
        body.joint.parent_from_joint = Pose::at(Vec3::new(0.0, -0.4, 0.0));
        body.joint.translations.clear();
    });
    assert_eq!((pendulum.anatomy().pelvis(), pendulum.anatomy().feet()), (None, None));
    let feet = free_bodies(DOWN_Y, &[("calcn_r", 1.0), ("calcn_l", 1.0), ("stone", 1.0)]);
    let sides = feet.body_ids().map(|id| feet.anatomy().body_side(id)).collect::<Vec<_>>();
    assert_eq!(sides, [Some(Side::Right), Some(Side::Left), None]);
    assert_eq!(feet.anatomy().legs(), &BySide::default());
    assert!(meanings(feet.anatomy(), &feet).iter().all(Option::is_none));
    // Stature by the cube root of mass.
    assert_near(feet.stature().height_m, 1.8 * (3.0_f64 / 72.6).cbrt(), 1e-12, "stature");
    for seed in 0..300 {
        let model = random::model(&mut Random::new(seed), Recipe::ANY);
        let anatomy = model.anatomy();
        assert_eq!(meanings(anatomy, &model).len(), model.coordinates().len(), "seed {seed}");
    }
}

#[test]
fn markers_masses_and_sizes_do_not_change_the_anatomy() {
    for model in published() {
        let foot = model.anatomy().feet().unwrap().right;
        let factors = vec![Vec3::new(1.1, 0.9, 1.2); model.bodies().len()];
        // A load on the heel, heavier than the person, moves mass centres but does not change the anatomy.
        let loaded = model.with_point_mass(foot, 200.0, Vec3::new(-0.5, 0.0, 0.3)).unwrap();
        let light = model.with_inertia(foot, free_bodies::ball(1e-3));
        for other in [model.with_markers(Vec::new()).unwrap(), loaded, light, model.scaled(&factors, None).unwrap()] {
            assert_eq!(meanings(other.anatomy(), &other), meanings(model.anatomy(), &model));
            assert_eq!(parts(other.anatomy()), parts(model.anatomy()));
        }
        let larger = model.scaled(&vec![Vec3::repeat(1.25); model.bodies().len()], None).unwrap();
        assert_near(larger.stature().height_m, 1.25 * model.stature().height_m, 1e-9, "stature");
    }
}

/// Stature from thigh and shank, and soles below the ankles, are within the ranges of people of that stature.
#[test]
fn statures_and_soles_are_those_of_people() {
    for model in everyone() {
        let stature = model.stature();
        assert!((1.4..2.1).contains(&stature.height_m), "{}: {} m", model.name(), stature.height_m);
        assert!((0.5..0.56).contains(&(stature.leg_length_m / stature.height_m)));
        for (side, sole) in model.anatomy().soles(stature.height_m).iter() {
            let sole = sole.unwrap();
            let [rear, ball, tip] = sole.points.map(|point| point.place);
            assert_eq!(Some(sole.points[0].body), model.body(&format!("calcn_{}", side.letter())));
            // Forward in the foot's frame is x in all of these models.
            assert!(rear.x < ball.x && ball.x < tip.x && (rear.y - tip.y).abs() < 1e-12, "{}", model.name());
        }
    }
}

/// Drillis and Contini 1966: the ankle is 3.9 % of the stature above the ground. Published models carry no soles, so
/// theirs are below the ankle of the model by that share of the estimated stature, which also lengthens the leg: thigh
/// and shank are 48 % of it.
#[test]
fn soles_are_3_9_percent_of_the_stature_below_the_ankle() {
    for model in published() {
        let stature = model.stature();
        assert_near(stature.leg_length_m / stature.height_m, 0.48 + 0.039, 1e-12, model.name());
    }
    for model in published().into_iter().chain(built()) {
        let q: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
        let rest = vec![0.0; q.len()];
        let mut workspace = Workspace::new(&model);
        let standing = inverse_frame(&mut workspace, Posture { q: &q, qd: &rest, qdd: &rest }, &[]);
        let height = model.stature().height_m;
        for (leg, sole) in model.anatomy().legs().values().zip(model.anatomy().soles(height).values()) {
            let (leg, sole) = (leg.as_ref().unwrap(), sole.as_ref().unwrap());
            let ankle = standing.reaction(leg.ankle).center;
            let in_foot = standing.body_motion(leg.foot).pose.inverse().place(ankle);
            // Up in the foot's frame is y in all of these models.
            assert_near(in_foot.y - sole.points[0].place.y, 0.039 * height, 1e-9, model.name());
        }
    }
}
