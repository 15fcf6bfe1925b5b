//! Feasibility: strength, each check at one instant, and thresholds.

use crate::common::assert_near;
use ambulo::analysis::feasibility::{
    Check, CheckedPart, CheckedValue, FeasibilityLimits, FootFrame, Frame, Person, Thresholds, check_frame,
};
use ambulo::kinematics::{BodyMotion, Posture, body_motion};
use ambulo::model::anthropometry::{Build, Human, SegmentTable};
use ambulo::model::{BySide, Movement};
use ambulo::optimal::{Hill, StrengthCurve};
use ambulo::spatial::{Vec3, Wrench};

const DOCUMENT: &str = include_str!("../../../docs/JUDGEMENT.md");
pub(crate) const GRAVITY: f64 = 9.80665;

pub(crate) fn man() -> Human {
    Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false }.human().unwrap()
}

// ---- strength ----

#[test]
fn the_strength_of_the_reference_man_equals_the_table() {
    use Movement::{AnkleDorsiflexion, HipAdduction, HipFlexion, KneeFlexion};
    let at = |movement: Movement, angle_deg: f64, sign: f64| {
        let curve = StrengthCurve::built_in(movement, 72.6, 1.80).unwrap();
        curve.available(f64::to_radians(angle_deg), 0.0, sign, 1.4)
    };
    for (movement, angle_deg, positive, negative) in [
        (HipFlexion, 0.0, 197.2, 313.1),
        (HipAdduction, -30.0, 295.4, 189.9),
        (KneeFlexion, 60.0, 144.6, 258.7),
        (AnkleDorsiflexion, 5.0, 60.5, 292.5),
        // Linear between two angles, constant beyond the ends of the table.
        (AnkleDorsiflexion, 2.5, (61.0 + 60.5) / 2.0, (288.3 + 292.5) / 2.0),
        (KneeFlexion, -15.0, 145.3, 264.0),
        (HipFlexion, -45.0, 188.1, 235.2),
    ] {
        assert_near(at(movement, angle_deg, 1.0), positive, 1e-9, &format!("{movement:?}"));
        assert_near(at(movement, angle_deg, -1.0), negative, 1e-9, &format!("{movement:?}"));
    }
    let rows: usize = [HipFlexion, HipAdduction, KneeFlexion, AnkleDorsiflexion]
        .map(|movement| StrengthCurve::built_in(movement, 72.6, 1.8).unwrap().angles.len())
        .iter()
        .sum();
    assert_eq!(rows, 43);
    assert_eq!(StrengthCurve::built_in(Movement::TrunkLean, 72.6, 1.8), None);
    assert_eq!(StrengthCurve::built_in(Movement::SubtalarInversion, 72.6, 1.8), None);
}

#[test]
fn strength_scales_with_mass_times_height() {
    let strength = |mass, height| StrengthCurve::built_in(Movement::KneeFlexion, mass, height).unwrap().positive[3];
    assert_near(strength(145.2, 1.8) / strength(72.6, 1.8), 2.0, 1e-12, "twice the mass");
    assert_near(strength(72.6, 0.9) / strength(72.6, 1.8), 0.5, 1e-12, "half the height");
}

#[test]
fn moments_decrease_with_shortening_speed_and_increase_while_muscles_are_stretched() {
    use Movement::{AnkleDorsiflexion, HipAdduction, HipFlexion, KneeFlexion, TrunkLean};
    for movement in [HipFlexion, HipAdduction, KneeFlexion, AnkleDorsiflexion, TrunkLean] {
        let name = &format!("{movement:?}");
        for hill in Hill::of_direction(movement, 1.0) {
            let factor = |speed: f64| hill.factor(speed, 1.4);
            assert_near(factor(0.0), 1.0, 1e-12, name);
            assert_near(factor(hill.at_75), 0.75, 1e-12, name);
            assert_near(factor(hill.at_50), 0.5, 1e-12, name);
            let speeds: Vec<f64> = (-400..=400).map(|i| 0.1 * f64::from(i)).collect();
            for pair in speeds.windows(2) {
                assert!(factor(pair[0]) >= factor(pair[1]), "{name} at {} rad/s", pair[0]);
            }
            assert!(factor(40.0) >= 0.0 && factor(-40.0) < 1.4 && factor(-40.0) > 1.35, "{name}");
            // The slope is continuous at rest: central and one-sided differences, both with an error of less than h/2
            // times a curvature of at most 2 s²/rad².
            let h = 1e-5;
            let (before, after) = ((factor(0.0) - factor(-h)) / h, (factor(h) - factor(0.0)) / h);
            assert_near(before, after, 1e-4, name);
        }
    }
}

#[test]
fn strength_does_not_depend_on_the_sign_convention_of_the_knee() {
    let turned = StrengthCurve::built_in(Movement::KneeFlexion, 80.0, 1.7).unwrap();
    let curve = turned.reversed();
    for (angle, rate, sign) in [(-0.3, 2.0, 1.0), (-0.3, 2.0, -1.0), (-1.2, -4.0, 1.0), (0.0, -1.0, -1.0)] {
        let (a, b) = (curve.available(angle, rate, sign, 1.4), turned.available(-angle, -rate, -sign, 1.4));
        assert_near(a, b, 1e-9, &format!("{angle} {rate} {sign}"));
    }
    assert!(curve.available(-0.3, 0.0, 1.0, 1.4) > 1.5 * curve.available(-0.3, 0.0, -1.0, 1.4), "extensors win");
}

// ---- one instant ----

/// A man standing on both feet, with all data of one frame.
struct Standing {
    human: Human,
    q: Vec<f64>,
    qd: Vec<f64>,
    generalized: Vec<f64>,
    powers: Vec<f64>,
    feet: BySide<Option<FootFrame>>,
    residual: Wrench,
    ground_velocity: Vec3,
    walking: bool,
}

impl Standing {
    fn new() -> Standing {
        let human = man();
        let n = human.model.coordinates().len();
        let q = human.model.coordinates().iter().map(|c| c.default_value).collect();
        let foot = |side: f64| FootFrame {
            force: Vec3::new(0.0, 0.5 * 72.6 * GRAVITY, 0.0),
            center_of_pressure: Vec3::new(0.04, 0.0, side * 0.5 * human.dimensions.hip_width),
        };
        let feet = BySide { right: Some(foot(1.0)), left: Some(foot(-1.0)) };
        let zeros = vec![0.0; n];
        Standing {
            q,
            qd: zeros.clone(),
            generalized: zeros.clone(),
            powers: zeros,
            feet,
            residual: Wrench::ZERO,
            ground_velocity: Vec3::zeros(),
            walking: true,
            human,
        }
    }

    fn set(&self, name: &str) -> usize {
        self.human.model.coordinate(name).unwrap().index()
    }

    fn bodies(&self) -> Vec<BodyMotion> {
        let rest = vec![0.0; self.q.len()];
        body_motion(&self.human.model, Posture { q: &self.q, qd: &self.qd, qdd: &rest })
    }

    fn measure(&self, thresholds: &Thresholds) -> (Vec<CheckedValue>, bool) {
        let person = Person::of_human(&self.human);
        let judge = FeasibilityLimits::new(&self.human.model, &person, thresholds);
        let frame = Frame {
            q: &self.q,
            qd: &self.qd,
            generalized: &self.generalized,
            powers: &self.powers,
            bodies: &self.bodies(),
            feet: self.feet,
            residual: self.residual,
            ground_velocity: self.ground_velocity,
            ground_height: BySide { right: 0.0, left: 0.0 },
            walking: self.walking,
        };
        let mut list = Vec::new();
        let whole = check_frame(&judge, &frame, |m| list.push(m));
        (list, whole)
    }

    /// The checks that fail in this frame.
    fn failed(&self) -> Vec<Check> {
        let mut checks: Vec<Check> =
            self.measure(&Thresholds::default()).0.iter().filter(|m| m.share > 1.0).map(|m| m.check).collect();
        checks.dedup();
        checks
    }
}

#[test]
fn a_weak_joint_has_its_share_of_the_strength_and_the_other_side_all_of_it() {
    let mut standing = Standing::new();
    let (right, left) = (standing.set("ankle_angle_r"), standing.set("ankle_angle_l"));
    standing.generalized[right] = -60.0;
    standing.generalized[left] = -60.0;
    let limit = |thresholds: &Thresholds, coordinate: usize| {
        let (list, _) = standing.measure(thresholds);
        let is_it = |m: &&CheckedValue| {
            m.check == Check::Strength && matches!(m.of, CheckedPart::Coordinate(id) if id.index() == coordinate)
        };
        list.iter().find(is_it).unwrap().limit
    };
    let usual = Thresholds { strength_tolerance_nm_kg: 0.0, ..Thresholds::default() };
    let weak = Thresholds { weak: vec![("ankle_angle_r".to_owned(), 0.4)], ..usual.clone() };
    assert_near(limit(&weak, right), 0.4 * limit(&usual, right), 1e-9, "right ankle");
    assert_near(limit(&weak, left), limit(&usual, left), 1e-9, "left ankle");
    assert!(limit(&usual, right) < -100.0);
}

#[test]
fn standing_still_is_feasible_and_every_check_is_made() {
    let standing = Standing::new();
    assert_eq!(standing.failed(), []);
    let (list, whole) = standing.measure(&Thresholds::default());
    assert!(whole);
    // The ratio of accelerations belongs to a whole motion.
    for check in Check::ALL.into_iter().filter(|check| *check != Check::Acceleration) {
        assert!(list.iter().any(|m| m.check == check), "{check}");
    }
    // Eleven rotations have ranges (the root has none): lumbar, and hip, knee, ankle, shoulder, elbow on both sides.
    assert_eq!(list.iter().filter(|m| m.check == Check::Range).count(), 11);
    assert_eq!(list.iter().filter(|m| m.check == Check::Strength).count(), 6);
}

#[test]
fn each_check_detects_its_own_violation_and_no_other() {
    type Fault<'a> = &'a dyn Fn(&mut Standing);
    let faults: [(Check, Fault<'_>); 10] = [
        (Check::Strength, &|s| {
            // Plantarflexors at rest and 0 deg: 288.3 N.m, and 7.3 N.m of tolerance.
            let i = s.set("ankle_angle_r");
            s.generalized[i] = -296.0;
        }),
        (Check::Range, &|s| {
            let i = s.set("elbow_flex_l");
            s.q[i] = 171_f64.to_radians();
        }),
        (Check::Power, &|s| {
            let i = s.set("hip_flexion_l");
            s.powers[i] = 30.1 * 72.6;
        }),
        (Check::Power, &|s| {
            let i = s.set("elbow_flex_l");
            s.powers[i] = -35.1 * 72.6;
        }),
        (Check::Friction, &|s| s.feet.right.as_mut().unwrap().force.x = 0.61 * 0.5 * 72.6 * GRAVITY),
        (Check::CenterOfPressure, &|s| s.feet.left.as_mut().unwrap().center_of_pressure.z -= 0.09),
        (Check::Sliding, &|s| {
            let i = s.set("pelvis_tx");
            s.qd[i] = 0.41;
        }),
        (Check::Flight, &|s| s.feet = s.feet.map(|foot| foot.map(|f| FootFrame { force: Vec3::zeros(), ..f }))),
        (Check::Support, &|s| s.residual.force.y = 0.41 * 72.6 * GRAVITY),
        (Check::Balance, &|s| s.residual.moment.z = -1.51 * 72.6),
    ];
    for (check, fault) in faults {
        let mut standing = Standing::new();
        fault(&mut standing);
        assert_eq!(standing.failed(), [check]);
    }
}

#[test]
fn values_just_inside_their_limits_are_feasible() {
    let mut standing = Standing::new();
    let (ankle, elbow, hip, forward) = (
        standing.set("ankle_angle_r"),
        standing.set("elbow_flex_l"),
        standing.set("hip_flexion_l"),
        standing.set("pelvis_tx"),
    );
    standing.generalized[ankle] = -295.0;
    standing.q[elbow] = 169_f64.to_radians();
    standing.powers[hip] = 29.9 * 72.6;
    standing.feet.right.as_mut().unwrap().force.x = 0.59 * 0.5 * 72.6 * GRAVITY;
    standing.feet.left.as_mut().unwrap().center_of_pressure.z -= 0.07;
    standing.qd[forward] = 0.39;
    standing.residual.force.x = 0.39 * 72.6 * GRAVITY;
    standing.residual.moment.z = 1.49 * 72.6;
    assert_eq!(standing.failed(), []);
}

#[test]
fn a_foot_that_moves_with_the_belt_does_not_slide() {
    let mut standing = Standing::new();
    let i = standing.set("pelvis_tx");
    standing.qd[i] = -1.2;
    assert_eq!(standing.failed(), [Check::Sliding]);
    standing.ground_velocity = Vec3::new(-1.2, 0.0, 0.0);
    assert_eq!(standing.failed(), []);
    // A foot that carries little may slide.
    standing.ground_velocity = Vec3::zeros();
    standing.feet = standing.feet.map(|foot| foot.map(|f| FootFrame { force: f.force * 0.9, ..f }));
    assert_eq!(standing.failed(), []);
}

#[test]
fn the_sole_has_the_size_of_the_foot_with_a_margin_of_three_centimetres() {
    let standing = Standing::new();
    let d = standing.human.dimensions;
    let outside = |x: f64, z: f64| {
        let mut standing = Standing::new();
        let foot = standing.feet.right.as_mut().unwrap();
        foot.center_of_pressure.x = x;
        foot.center_of_pressure.z += z;
        let (list, _) = standing.measure(&Thresholds::default());
        list.iter().find(|m| m.check == Check::CenterOfPressure).unwrap().value
    };
    let (heel, toe) = (-d.heel_to_ankle, d.ankle_to_ball + d.ball_to_toe);
    assert_near(outside(heel, 0.0), 0.0, 1e-9, "at the heel");
    assert_near(outside(toe, 0.0), 0.0, 1e-9, "at the tip");
    assert_near(outside(heel - 0.05, 0.0), 0.05, 1e-9, "behind the heel");
    assert_near(outside(toe + 0.02, 0.0), 0.02, 1e-9, "in front of the tip");
    assert_near(outside(0.05, 0.5 * d.foot_width + 0.01), 0.01, 1e-9, "lateral of the foot");
}

#[test]
fn flight_is_allowed_in_running() {
    let mut standing = Standing::new();
    standing.feet = standing.feet.map(|foot| foot.map(|f| FootFrame { force: Vec3::zeros(), ..f }));
    standing.walking = false;
    assert_eq!(standing.failed(), []);
}

#[test]
fn an_unloaded_foot_at_rest_on_the_ground_means_missing_forces() {
    let mut standing = Standing::new();
    standing.feet.left.as_mut().unwrap().force = Vec3::zeros();
    standing.residual.force.y = 0.9 * 72.6 * GRAVITY;
    let ankle = standing.set("ankle_angle_r");
    standing.generalized[ankle] = -1000.0;
    let (list, whole) = standing.measure(&Thresholds::default());
    assert!(!whole);
    assert!(!list.iter().any(|m| matches!(m.check, Check::Support | Check::Strength | Check::Flight)));
    // In the air it certainly carries nothing.
    let (hip, knee) = (standing.set("hip_flexion_l"), standing.set("knee_angle_l"));
    (standing.q[hip], standing.q[knee]) = (0.8, -1.4);
    assert_eq!(standing.failed(), [Check::Strength, Check::Support]);
}

#[test]
fn a_checked_value_has_value_and_limit_in_the_unit_of_its_check() {
    let mut standing = Standing::new();
    let knee = standing.set("knee_angle_r");
    standing.q[knee] = -163_f64.to_radians();
    let (list, _) = standing.measure(&Thresholds::default());
    let id = standing.human.model.coordinate("knee_angle_r").unwrap();
    let m = list.iter().find(|m| m.check == Check::Range && m.of == CheckedPart::Coordinate(id)).unwrap();
    assert_near(m.value, -163.0, 1e-9, "angle [deg]");
    assert_near(m.limit, -160.0, 1e-9, "limit [deg]");
    assert!(m.share > 1.0);
}

#[test]
fn the_ground_cannot_pull() {
    let mut standing = Standing::new();
    standing.feet = standing.feet.map(|foot| foot.map(|f| FootFrame { force: Vec3::zeros(), ..f }));
    standing.walking = false;
    standing.residual.force.y = -0.29 * 72.6 * GRAVITY;
    assert_eq!(standing.failed(), []);
    standing.residual.force.y = -0.31 * 72.6 * GRAVITY;
    assert_eq!(standing.failed(), [Check::Pull]);
}

// ---- thresholds ----

#[test]
fn the_file_in_the_documentation_has_the_defaults() {
    let block = DOCUMENT.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    assert_eq!(Thresholds::from_toml(block), Ok(Thresholds::default()));
    assert_eq!(Thresholds::from_toml(""), Ok(Thresholds::default()));
}

#[test]
fn every_key_changes_its_threshold() {
    let text = r#"
shortest_s = 0.1
skip = ["flight", "center_of_pressure"]
[person]
mass_kg = 60
height_m = 1.65
[strength]
share = 0.8
tolerance_nm_kg = 0.05
eccentric = 1.2
[[strength.table]]
coordinate = "lumbar_extension"
angle_deg = [-30, 30]
positive_nm = [200, 250]
negative_nm = [100, 120.5]
[friction]
available = 0.3
least_load_bw = 0.2
[center_of_pressure]
margin_m = 0.01
least_load_bw = 0.3
[flight]
longest_s = 0.05
[sliding]
speed_m_s = 0.1
least_load_bw = 0.6
[range]
slack_deg = 5
[power]
generation_w_kg = 8
absorption_w_kg = 9
[support]
force_bw = 0.2
moment_nm_kg = 0.7
pull_bw = 0.1
acceleration_ratio = 1.2
"#;
    let t = Thresholds::from_toml(text).unwrap();
    let (name, curve) = t.tables[0].clone();
    assert_eq!(name, "lumbar_extension");
    assert_near(curve.available(0.0, 0.0, 1.0, 1.4), 225.0, 1e-9, "own table");
    assert_near(curve.available(1.0, 0.0, -1.0, 1.4), 120.5, 1e-9, "end of the user's table");
    let expected = Thresholds {
        shortest_s: 0.1,
        skip: vec![Check::Flight, Check::CenterOfPressure],
        mass_kg: Some(60.0),
        height_m: Some(1.65),
        strength_share: 0.8,
        weak: Vec::new(),
        strength_tolerance_nm_kg: 0.05,
        eccentric: 1.2,
        tables: t.tables.clone(),
        friction: 0.3,
        friction_load_bw: 0.2,
        sole_margin_m: 0.01,
        sole_load_bw: 0.3,
        flight_s: 0.05,
        sliding_m_s: 0.1,
        sliding_load_bw: 0.6,
        range_slack_rad: 5_f64.to_radians(),
        generation_w_kg: 8.0,
        absorption_w_kg: 9.0,
        support_bw: 0.2,
        balance_nm_kg: 0.7,
        pull_bw: 0.1,
        acceleration_ratio: 1.2,
    };
    assert_eq!(t, expected);
}

#[test]
fn an_invalid_thresholds_file_is_rejected_with_line_and_key() {
    for (text, message) in [
        ("[friction]\navailable = -0.1\n", "line 2, `friction.available`: found -0.1; expected a number from 0 to 5"),
        (
            "[friction]\n\navailable = nan\n",
            "line 3, `friction.available`: found nan; expected a number from 0 to 5. hint: numbers are finite and at \
             most 1e15 in size",
        ),
        (
            "[friction]\navailabel = 0.5\n",
            "line 2, `friction.availabel`: unknown key; expected `available`, `least_load_bw`. hint: did you mean \
             `available`?",
        ),
        ("friction = 0.5\n", "line 1, `friction`: found 0.5; expected a table under the header [friction]"),
        ("[person]\nmass_kg = 1000\n", "line 2, `person.mass_kg`: found 1000; expected a number from 2 to 300"),
        (
            "[[strength.table]]\ncoordinate = \"x\"\nangle_deg = [10, 0]\n",
            "line 3, `strength.table[1].angle_deg`: found [10, 0]; expected a list of one or more increasing angles",
        ),
        (
            "[[strength.table]]\ncoordinate = \"x\"\nangle_deg = [0, 10]\npositive_nm = [1]\nnegative_nm = [1, 2]\n",
            "line 4, `strength.table[1].positive_nm`: found [1]; expected a list of 2 moments [N.m], zero or more, one \
             per angle",
        ),
    ] {
        assert_eq!(Thresholds::from_toml(text).unwrap_err().to_string(), message);
    }
    let error = Thresholds::from_toml("skip = [\"slidng\"]").unwrap_err().to_string();
    assert!(
        error.starts_with("line 1, `skip[1]`: found \"slidng\"; expected one of \"strength\", \"range\""),
        "{error}"
    );
    assert!(error.ends_with("hint: did you mean \"sliding\"?"), "{error}");
    let error = Thresholds::from_toml("[friction\n").unwrap_err().to_string();
    assert!(error.contains("this is not TOML") && error.contains("docs/JUDGEMENT.md"), "{error}");
}

#[test]
fn a_strength_table_of_the_user_is_used() {
    let mut standing = Standing::new();
    let lumbar = standing.set("lumbar_extension");
    standing.generalized[lumbar] = 150.0;
    let text = "[[strength.table]]\ncoordinate = \"lumbar_extension\"\nangle_deg = [0]\npositive_nm = \
        [100]\nnegative_nm = [50]\n";
    let own = Thresholds::from_toml(text).unwrap();
    assert_eq!(standing.failed(), []);
    let (list, _) = standing.measure(&own);
    let found: Vec<_> = list.iter().filter(|m| m.share > 1.0).collect();
    assert_eq!(found.len(), 1);
    assert_near(found[0].limit, 100.0 + 0.1 * 72.6, 1e-9, "own strength and tolerance");
}
