//! Moments of all three planes at hip, knee and ankle, at the default settings, compared with those of Plug-in-Gait in
//! the same C3D files while each foot is on its plate.
//!
//! `cargo test -p ambulo plug_in_gait_planes -- --show-output` prints the comparison.

use crate::plug_in_gait::{Agreement, agreement};
use crate::shared_data;
use ambulo::dynamics::JointReaction;
use ambulo::findings::Findings;
use ambulo::kinematics::calibration::HipRegression;
use ambulo::model::anatomy::Movement::{self, *};
use ambulo::model::anthropometry::SegmentTable;
use ambulo::model::{BodyId, Side};
use ambulo::spatial::{Mat3, Vec3};
use ambulo::study::{
    self, LaboratoryFile, MarkerBody, MarkerSource, Outcome, Settings, Source, StandingTrial, Tracking,
};
use ambulo_formats::c3d::C3d;
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// A walk with the results of Plug-in-Gait, and its standing trial, if there is one.
struct Trial {
    walk: &'static str,
    standing: Option<&'static str>,
    mass_kg: f64,
    height_m: f64,
}

const fn trial(walk: &'static str, standing: Option<&'static str>, mass_kg: f64, height_m: f64) -> Trial {
    Trial { walk, standing, mass_kg, height_m }
}

const TRIALS: [Trial; 11] = [
    trial("biomechzoo-HC032A/HC032A03", Some("biomechzoo-HC032A/HC032A01"), 60.3, 1.58),
    trial("biomechzoo-HC002D/HC002D06", Some("biomechzoo-HC002D/HC002D02"), 32.1, 1.45),
    trial("biomechzoo-HC030A/HC030A05", Some("biomechzoo-HC030A/HC030A01"), 45.8, 1.48),
    trial("biomechzoo-HC031A/HC031A06", Some("biomechzoo-HC031A/HC031A01"), 27.7, 1.33),
    trial("biomechzoo-HC033A/HC033A10", Some("biomechzoo-HC033A/HC033A01"), 51.5, 1.605),
    trial("biomechzoo-HC036A/HC036A10", Some("biomechzoo-HC036A/HC036A01"), 33.0, 1.34),
    trial("biomechzoo-HC055A/HC055A09", Some("biomechzoo-HC055A/HC055A01"), 32.0, 1.44),
    trial("biomechzoo-HC003B/HC003B08", None, 38.5, 1.525),
    trial("biomechzoo-HC034A/HC034A07", None, 45.3, 1.54),
    trial("btkdata-pig-adult3plates/PiG_Motion3_FF", Some("btkdata-pig-adult3plates/PiG_Calibration3_FF"), 74.0, 1.76),
    trial(
        "btkdata-flatfoot-full/PiG_Motion-FlatFoot-Full",
        Some("btkdata-flatfoot-full/PiG_Calibration-FlatFoot-Full"),
        47.5,
        1.505,
    ),
];

/// The axes of a segment of Plug-in-Gait: to the left, forward (of the foot: up) and proximal (of the foot: back).
#[derive(Clone, Copy)]
enum Axis {
    Lateral,
    Anterior,
    Proximal,
}

/// A joint of Plug-in-Gait: its name, its centre, the segment whose axes its moment has, the axis of each component
/// with its sign on the right, and the movements of ours against which the components act.
struct Joint {
    name: &'static str,
    center: &'static str,
    segment: &'static str,
    axes: [(Axis, f64); 3],
    against: [Movement; 3],
}

/// The sagittal axes point to the left on both sides; the others are mirrored.
const JOINTS: [Joint; 3] = [
    Joint {
        name: "Hip",
        center: "HJC",
        segment: "FE",
        axes: [(Axis::Lateral, 1.0), (Axis::Anterior, -1.0), (Axis::Proximal, -1.0)],
        against: [HipFlexion, HipAdduction, HipRotation],
    },
    Joint {
        name: "Knee",
        center: "FEO",
        segment: "TI",
        axes: [(Axis::Lateral, -1.0), (Axis::Anterior, -1.0), (Axis::Proximal, -1.0)],
        against: [KneeFlexion, KneeAdduction, KneeRotation],
    },
    Joint {
        name: "Ankle",
        center: "TIO",
        segment: "FO",
        axes: [(Axis::Lateral, 1.0), (Axis::Proximal, 1.0), (Axis::Anterior, -1.0)],
        against: [AnkleDorsiflexion, SubtalarInversion, FootRotation],
    },
];
const PLANES: [&str; 3] = ["sagittal", "frontal", "transverse"];

/// Our moment with our axes and centres; with Plug-in-Gait's axes; with its axes about its joint centre.
const WAYS: [&str; 3] = ["own axes", "its axes", "its axes and centre"];

struct Walk {
    outcome: Outcome,
    file: C3d,
    world_from_lab: Mat3,
    start_s: f64,
    mass_kg: f64,
}

impl Trial {
    fn run(&self, folder: &Path, hip: HipRegression) -> Walk {
        let bytes = |name: &str| std::fs::read(folder.join(format!("{name}.c3d"))).unwrap();
        let read = |name: &str| LaboratoryFile::from_c3d(bytes(name), name, &mut Findings::default()).unwrap();
        let (mass_kg, height_m) = (Some(self.mass_kg), Some(self.height_m));
        let source = Source::markers(MarkerSource {
            trial: read(self.walk),
            standing: self.standing.map(|name| Arc::new(StandingTrial::new(read(name)))),
            body: MarkerBody::BuiltIn { table: SegmentTable::DeLevaMale, mass_kg, height_m, set: None },
            plates: Vec::new(),
        });
        let outcome = study::run(source, &Settings { hip, ..Settings::default() }, &mut Findings::default()).unwrap();
        let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no markers") };
        let (world_from_lab, start_s) = (tracked.body.laboratory.world_from_lab, tracked.body.plates[0].times[0]);
        let (file, _) = C3d::read(&bytes(self.walk)).unwrap();
        Walk { outcome, file, world_from_lab, start_s, mass_kg: self.mass_kg }
    }
}

impl Walk {
    /// Frames of the file in which a foot is on its plate, with the nearest frame of the results.
    fn frames(&self, side: Side) -> Vec<(usize, usize)> {
        let Some(Tracking::Markers(tracked)) = &self.outcome.tracking else { panic!("no markers") };
        let stances = tracked.body.on_plates.measured_stances(side);
        let grid = self.outcome.analysis.trajectory.grid();
        let frames = 0..self.file.points[0].positions.len();
        let pair = |frame: usize| {
            let t = self.start_s + frame as f64 / self.file.point_rate_hz;
            let own = ((t - grid.start_s) / grid.step_s).round();
            let is_meant = stances.iter().any(|[from, to]| (*from..=*to).contains(&t));
            (is_meant && own >= 0.0 && own < grid.frames as f64).then_some((frame, own as usize))
        };
        frames.filter_map(pair).collect()
    }

    fn point(&self, side: Side, name: &str, frame: usize) -> Option<Vec3> {
        let letter = if side == Side::Right { "R" } else { "L" };
        let position = self.file.point(&format!("{letter}{name}"))?.positions[frame];
        let place = self.world_from_lab * Vec3::from(position) * 1e-3;
        place.iter().all(|x| x.is_finite()).then_some(place)
    }

    /// Plug-in-Gait's moment [N.m/kg].
    fn theirs(&self, side: Side, joint: &Joint, frame: usize) -> Option<Vec3> {
        let letter = if side == Side::Right { "R" } else { "L" };
        let moment = Vec3::from(self.file.point(&format!("{letter}{}Moment", joint.name))?.positions[frame]) * 1e-3;
        (moment.iter().all(|x| x.is_finite()) && moment.norm() > 0.0).then_some(moment)
    }

    /// The axes of the three components of a joint's moment in the world.
    fn axes(&self, side: Side, joint: &Joint, frame: usize) -> Option<[Vec3; 3]> {
        let origin = self.point(side, &format!("{}O", joint.segment), frame)?;
        let mut axes = [Vec3::zeros(); 3];
        for (found, (axis, sign)) in axes.iter_mut().zip(joint.axes) {
            let (letter, mirrored) = match axis {
                Axis::Lateral => ("L", false),
                Axis::Anterior => ("A", true),
                Axis::Proximal => ("P", true),
            };
            let sign = if mirrored && side == Side::Left { -sign } else { sign };
            *found = (self.point(side, &format!("{}{letter}", joint.segment), frame)? - origin).normalize() * sign;
        }
        Some(axes)
    }

    fn joint_body(&self, side: Side, name: &str) -> BodyId {
        let leg = self.outcome.body.anatomy().legs()[side].unwrap();
        match name {
            "Hip" => leg.hip,
            "Knee" => leg.knee,
            _ => leg.ankle,
        }
    }

    /// Moments of a joint while the foot is on its plate, by way and plane: ours and Plug-in-Gait's [N.m/kg].
    fn compared(&self, side: Side, joint: &Joint) -> Compared {
        let (analysis, model) = (&self.outcome.analysis, &self.outcome.body);
        let (moments, reactions) = (analysis.joint_moments(model), analysis.reactions(model));
        let body = self.joint_body(side, joint.name);
        let mut found = Compared::default();
        for (frame, own) in self.frames(side) {
            let (theirs, axes) = (self.theirs(side, joint, frame), self.axes(side, joint, frame));
            let (Some(theirs), Some(axes)) = (theirs, axes) else { continue };
            let JointReaction { center, wrench } = reactions.at(body, own);
            // A file without the hip centres has no third way there.
            let moved =
                self.point(side, joint.center, frame).map(|at| wrench.moment + (center - at).cross(&wrench.force));
            for plane in 0..3 {
                let ours = -moments.at(joint.against[plane], side, own).unwrap();
                let ways = [Some(ours), Some(axes[plane].dot(&wrench.moment)), moved.map(|m| axes[plane].dot(&m))];
                for (list, moment) in found.iter_mut().zip(ways) {
                    list[plane].extend(moment.map(|moment| (moment / self.mass_kg, theirs[plane])));
                }
            }
        }
        found
    }
}

/// Pairs of moments by way and plane.
type Compared = [[Vec<(f64, f64)>; 3]; 3];

/// The agreement of every leg, by way.
type Legs = [Vec<Agreement>; 3];

/// Prints a joint in a plane over all legs; returns the mean of each way.
fn means(words: &str, legs: &Legs) -> [Agreement; 3] {
    let mean = |list: &[Agreement], of: fn(&Agreement) -> f64| list.iter().map(of).sum::<f64>() / list.len() as f64;
    let means = legs.each_ref().map(|list| Agreement { r: mean(list, |leg| leg.r), rms: mean(list, |leg| leg.rms) });
    for ((way, list), Agreement { r, rms }) in
        WAYS.iter().zip(legs).zip(&means).filter(|((_, list), _)| !list.is_empty())
    {
        let least = list.iter().map(|leg| leg.r).fold(1.0, f64::min);
        println!("{words:<17} {way:<20} mean r {r:.3}  RMS {rms:.3} N.m/kg, least r {least:.3}, {} legs", list.len());
    }
    means
}

/// All walks with a hip centre, computed once for all tests; `None` without data.
fn walks(hip: HipRegression) -> Option<&'static [(&'static str, Walk)]> {
    type Walks = OnceLock<Option<Vec<(&'static str, Walk)>>>;
    static OF_HIPS: [Walks; 2] = [OnceLock::new(), OnceLock::new()];
    let all = OF_HIPS[usize::from(hip != HipRegression::default())].get_or_init(|| {
        let folder = shared_data::data()?;
        Some(TRIALS.iter().map(|trial| (trial.walk, trial.run(&folder, hip))).collect())
    });
    all.as_deref()
}

/// Prints every leg, and the mean over the legs; returns the mean of each way by joint and plane.
fn table(walks: &[(&'static str, Walk)], misplaced: &[(&str, Side)]) -> Vec<[[Agreement; 3]; 3]> {
    let of_joint = |joint: &Joint| {
        let both =
            |(name, walk): &(&'static str, Walk)| Side::BOTH.map(|side| (*name, side, walk.compared(side, joint)));
        let found: Vec<(&str, Side, Compared)> = walks.iter().flat_map(both).collect();
        std::array::from_fn(|plane| {
            let mut legs = Legs::default();
            for (name, side, compared) in &found {
                let of_leg = compared.each_ref().map(|way| agreement_of(&way[plane]));
                let cell =
                    |leg: Option<Agreement>| leg.map_or("-".to_owned(), |leg| format!("r {:.3} {:.3}", leg.r, leg.rms));
                println!("  {} {} {side}: {}  {name}", joint.name, PLANES[plane], of_leg.map(cell).join(" | "));
                legs.iter_mut().zip(of_leg).for_each(|(list, leg)| list.extend(leg));
            }
            let means = means(&format!("{} {}", joint.name, PLANES[plane]), &legs);
            let well_placed = found.iter().filter(|(name, side, _)| !misplaced.contains(&(*name, *side)));
            let own = well_placed.filter_map(|(_, _, compared)| agreement_of(&compared[0][plane])).collect();
            self::means("  wands in place", &[own, Vec::new(), Vec::new()]);
            means
        })
    };
    JOINTS.iter().map(of_joint).collect()
}

/// The legs whose wands are misplaced.
fn misplaced(walks: &[(&'static str, Walk)]) -> Vec<(&'static str, Side)> {
    let sides = |(name, walk): &(&'static str, Walk)| {
        let is_turned = |side: &Side| wand_turn_deg(walk, *side).is_some_and(|turn| turn.abs() > MISPLACED_DEG);
        Side::BOTH.into_iter().filter(is_turned).map(|side| (*name, side)).collect::<Vec<_>>()
    };
    walks.iter().flat_map(sides).collect()
}

#[test]
fn moments_of_three_planes_are_those_of_plug_in_gait_in_its_axes() {
    let Some(usual) = walks(HipRegression::default()) else { return };
    let misplaced = misplaced(usual);
    println!("misplaced wands: {misplaced:?}");
    for (hip, most_at_the_hip) in [(HipRegression::default(), 0.11), (HipRegression::PlugInGait, 0.09)] {
        println!("hip centre: {hip:?}");
        let found = table(walks(hip).unwrap(), &misplaced);
        // Joint, least r and largest RMS difference [N.m/kg] of the frontal plane, about the axes of Plug-in-Gait.
        for (joint, least_r, largest_rms) in [(0, 0.97, most_at_the_hip), (1, 0.95, 0.06), (2, 0.85, 0.06)] {
            let Agreement { r, rms } = found[joint][1][1];
            assert!(r >= least_r && rms <= largest_rms, "{hip:?}, {}: r {r:.3} RMS {rms:.3}", JOINTS[joint].name);
        }
    }
}

/// A wand that turns the knee of Plug-in-Gait by more is misplaced [deg].
const MISPLACED_DEG: f64 = 15.0;

/// By how much the rotation of the knee differs from that of Plug-in-Gait on the mean [deg]: its wands turn the axes.
fn wand_turn_deg(walk: &Walk, side: Side) -> Option<f64> {
    let [_, rotation] = knee_angles(walk, side)?;
    let sum: f64 = rotation.iter().map(|(ours, theirs)| ours - theirs).sum();
    (!rotation.is_empty()).then(|| sum / rotation.len() as f64)
}

/// The agreement of a leg whose foot was on a plate.
fn agreement_of(pairs: &[(f64, f64)]) -> Option<Agreement> {
    (pairs.len() > 40).then(|| agreement(pairs))
}

/// Beside the comparison one that must fail: the moment with the sign of the other side.
#[test]
fn a_moment_with_the_sign_of_the_other_side_is_not_that_of_plug_in_gait() {
    let Some([(_, walk), ..]) = walks(HipRegression::default()) else { return };
    let [_, axes, _] = walk.compared(Side::Right, &JOINTS[1]);
    let turned: Vec<(f64, f64)> = axes[1].iter().map(|(ours, theirs)| (-ours, *theirs)).collect();
    assert!(agreement(&axes[1]).r > 0.9 && agreement(&turned).r < -0.9);
}

/// Varus and internal rotation of the knee [deg], ours and Plug-in-Gait's, while the foot is on its plate.
fn knee_angles(walk: &Walk, side: Side) -> Option<[Vec<(f64, f64)>; 2]> {
    let ours = walk.outcome.knee_angles()[side].clone()?;
    let letter = if side == Side::Right { "R" } else { "L" };
    // Some files name them LKneeAnglesV, with V the version of the model.
    let named = |ending: &str| walk.file.point(&format!("{letter}KneeAngles{ending}"));
    let theirs = named("").or_else(|| named("V"))?;
    let mut found: [Vec<(f64, f64)>; 2] = Default::default();
    for (frame, own) in walk.frames(side) {
        for (k, list) in found.iter_mut().enumerate() {
            let pair = (ours[k][own].to_degrees(), theirs.positions[frame][k + 1]);
            list.extend((pair.0.is_finite() && pair.1.is_finite() && pair.1 != 0.0).then_some(pair));
        }
    }
    Some(found)
}

/// Constant offsets are those of the axes: of wands, and of the neutral posture.
#[test]
fn varus_and_rotation_of_the_knee_move_as_those_of_plug_in_gait() {
    let Some(walks) = walks(HipRegression::default()) else { return };
    let mut legs: [Vec<Agreement>; 2] = Default::default();
    for (trial, walk) in walks {
        for side in Side::BOTH {
            let Some(found) = knee_angles(walk, side) else { continue };
            for (k, pairs) in found.iter().enumerate().filter(|(_, pairs)| pairs.len() > 40) {
                let offset = pairs.iter().map(|(ours, theirs)| ours - theirs).sum::<f64>() / pairs.len() as f64;
                let centred: Vec<(f64, f64)> = pairs.iter().map(|(ours, theirs)| (ours - offset, *theirs)).collect();
                let leg = agreement(&centred);
                let name = ["varus", "rotation"][k];
                println!(
                    "  {name:<8} {side:<5} offset {offset:+6.1} r {:6.3} RMS {:.1} deg  {}",
                    leg.r, leg.rms, trial
                );
                legs[k].push(leg);
            }
        }
    }
    for (name, legs) in ["varus", "rotation"].iter().zip(&legs) {
        let mean = |of: fn(&Agreement) -> f64| legs.iter().map(of).sum::<f64>() / legs.len() as f64;
        let (r, rms) = (mean(|leg| leg.r), mean(|leg| leg.rms));
        println!("{name}: mean r {r:.3}, RMS {rms:.1} deg about the offset, {} legs", legs.len());
        // Wands and soft tissue move Plug-in-Gait's rotation by some degrees; a hinge has r 0.
        assert!(legs.len() >= 20 && r > 0.7 && rms < 3.0, "{name}: r {r:.2}, {rms:.1} deg");
    }
}
