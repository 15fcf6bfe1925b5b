//! A figure as a model of MuJoCo (MJCF).
//!
//! Bodies, masses, mass centres, inertias and joints are those of the [`Model`]. Every coordinate is a slide or a
//! separate hinge, with the name and the sense of the coordinate. Slides come before hinges, because a slide of MuJoCo
//! turns with the joints in front of it; the text `coordinates` lists the names in the order of the model. Every joint
//! that is not of the root has a motor with the name of its coordinate. Spheres under the soles touch only the ground.
//!
//! Contact is MuJoCo's own. With depth r, impedance d(r), its largest value D, and the inverse mass A of a body
//! (`body_invweight0`), MuJoCo's static force and damping are
//!
//!   F = d²/(1-d) s r / (D² A)        B = d/(1-d) b / (D A)
//!
//! with s and b of `solref`. [`IMPEDANCE`] is fitted so that F rises with depth as the force of the shoes of the plan
//! does (`HuntCrossley`), and s and b are chosen so that F and B are those of the shoes at [`MATCHED_M`]. The attribute
//! `user` of a sphere has s/A, b/A and its side: the program that reads the model knows A.
//!
//! Source: MuJoCo documentation, "Solver parameters" (unverified; the forces follow from a¹ + d (b v + k r) = (1-d)
//! a⁰). Pinned by: the tests below; every run compares mass matrix and bias forces ([`Dynamics::difference`]).

use ambulo::contact::HuntCrossley;
use ambulo::dynamics::{Workspace, inverse_frame};
use ambulo::kinematics::Posture;
use ambulo::model::anthropometry::{ContactSphere, Human};
use ambulo::model::{Body, BodyId, Displacement, Drive, Joint, JointAxis, Model, Side};
use ambulo::spatial::Vec3;
use std::fmt::Write as _;

/// `solimp` of the spheres: smallest and largest impedance, depth of the largest [m], middle and power of the curve
/// between.
const IMPEDANCE: [f64; 5] = [0.326, 0.6, 0.03, 0.007, 4.3];
/// Depth at which force and damping are those of the shoes [m]: that of a third of the weight on one sphere.
const MATCHED_M: f64 = 0.01;
/// Tolerance for rounding of slopes.
const SLACK: f64 = 1e-9;

/// The model as text, for time steps of `step_s`.
pub(super) fn mjcf(human: &Human, shoes: &HuntCrossley, step_s: f64) -> Result<String, String> {
    let model = &human.model;
    let gravity = vector(&model.gravity());
    let names: Vec<&str> = model.coordinates().iter().map(|coordinate| coordinate.name.as_str()).collect();
    let mut text = format!(
        "<mujoco model=\"{}\">\n<compiler angle=\"radian\"/>\n\
         <option timestep=\"{step_s}\" gravity=\"{gravity}\" integrator=\"implicitfast\" cone=\"elliptic\" \
         impratio=\"{}\">\
         <flag autoreset=\"disable\"/></option>\n\
         <custom><text name=\"coordinates\" data=\"{}\"/></custom>\n<worldbody>\n\
         <geom name=\"ground\" type=\"plane\" size=\"0 0 1\" zaxis=\"0 1 0\" contype=\"0\" conaffinity=\"1\"/>\n",
        model.name(),
        friction_ratio(shoes),
        names.join(" "),
    );
    for body in model.body_ids().filter(|id| model.bodies()[id.index()].joint.parent.is_none()) {
        add_body(&mut text, &Tree { human, shoes }, body)?;
    }
    text += "</worldbody>\n<actuator>\n";
    for body in model.bodies().iter().filter(|body| body.joint.parent.is_some()) {
        for id in body.joint.coordinates() {
            let name = names[id.index()];
            let _ = writeln!(
                text,
                "<general name=\"{name}\" joint=\"{name}\" gaintype=\"fixed\" biastype=\"affine\" \
                 forcelimited=\"true\" forcerange=\"-1 1\"/>"
            );
        }
    }
    Ok(text + "</actuator>\n</mujoco>\n")
}

struct Tree<'a> {
    human: &'a Human,
    shoes: &'a HuntCrossley,
}

/// Damping of friction over that of the normal force (`impratio`): μ F/v_t over 3/2 c F.
fn friction_ratio(shoes: &HuntCrossley) -> f64 {
    shoes.dynamic_friction / (shoes.transition_velocity * 1.5 * shoes.dissipation)
}

/// A body with those that it carries.
fn add_body(text: &mut String, tree: &Tree<'_>, id: BodyId) -> Result<(), String> {
    let model = &tree.human.model;
    let body = &model.bodies()[id.index()];
    // With all coordinates zero, the joint frames on parent and child coincide.
    let pose = body.joint.parent_from_joint * body.joint.child_from_joint.inverse();
    let (x, y) = (pose.rotation.column(0).into(), pose.rotation.column(1).into());
    let _ = writeln!(
        text,
        "<body name=\"{}\" pos=\"{}\" xyaxes=\"{} {}\">",
        body.name,
        vector(&pose.translation),
        vector(&x),
        vector(&y)
    );
    text.push_str(&inertial(body));
    for (axis, kind) in body.joint.translations.iter().map(|axis| (axis, "slide")) {
        text.push_str(&coordinate(model, &body.joint, axis, kind)?);
    }
    for (axis, kind) in body.joint.rotations.iter().map(|axis| (axis, "hinge")) {
        text.push_str(&coordinate(model, &body.joint, axis, kind)?);
    }
    for sole in tree.human.soles.iter().filter(|sole| sole.body == id) {
        text.push_str(&sphere(sole, tree.shoes));
    }
    for child in model.body_ids().filter(|child| model.bodies()[child.index()].joint.parent == Some(id)) {
        add_body(text, tree, child)?;
    }
    text.push_str("</body>\n");
    Ok(())
}

fn inertial(body: &Body) -> String {
    let i = body.inertia.about_center();
    let (diagonal, products) = (Vec3::new(i[(0, 0)], i[(1, 1)], i[(2, 2)]), Vec3::new(i[(0, 1)], i[(0, 2)], i[(1, 2)]));
    format!(
        "<inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{} {}\"/>\n",
        vector(&body.inertia.center()),
        body.inertia.mass(),
        vector(&diagonal),
        vector(&products)
    )
}

/// The slide or hinge of a coordinate, in the frame of the child.
fn coordinate(model: &Model, joint: &Joint, axis: &JointAxis, kind: &str) -> Result<String, String> {
    let wrong = |found: &str| {
        Err(format!(
            "joint `{}`: found {found}; expected axes that free coordinates move by their own value",
            joint.name
        ))
    };
    let Displacement::Follows(id, function) = &axis.displacement else { return wrong("an axis with a fixed value") };
    let slope = match function.as_linear() {
        Some((slope, offset)) if (slope.abs() - 1.0).abs() <= SLACK && offset.abs() <= SLACK => slope.signum(),
        _ => return wrong("an axis that is a curved function of its coordinate"),
    };
    let coordinate = &model.coordinates()[id.index()];
    if !matches!(coordinate.drive, Drive::Free) {
        return wrong("a coordinate that is locked, prescribed or coupled");
    }
    let in_child = joint.child_from_joint.rotation * axis.direction * slope;
    let place = vector(&joint.child_from_joint.translation);
    Ok(format!(
        "<joint name=\"{}\" type=\"{kind}\" axis=\"{}\" pos=\"{place}\"/>\n",
        coordinate.name,
        vector(&in_child)
    ))
}

fn sphere(sole: &ContactSphere, shoes: &HuntCrossley) -> String {
    let [stiffness, damping] = of_mass(shoes, sole.radius);
    format!(
        "<geom name=\"{}\" type=\"sphere\" size=\"{}\" pos=\"{}\" mass=\"0\" contype=\"1\" conaffinity=\"0\" \
         condim=\"3\" priority=\"1\" \
         friction=\"{} 0 0\" solimp=\"{}\" user=\"{stiffness} {damping} {}\"/>\n",
        sole.name,
        sole.radius,
        vector(&sole.center),
        shoes.dynamic_friction,
        IMPEDANCE.map(|x| x.to_string()).join(" "),
        u8::from(sole.side == Side::Left)
    )
}

/// Mass matrix by columns, and the generalised forces that keep the rates constant without contact.
pub(super) struct Dynamics {
    pub(super) inertia: Vec<f64>,
    pub(super) bias: Vec<f64>,
}

impl Dynamics {
    /// Those of a model in a state, by inverse dynamics.
    pub(super) fn of(model: &Model, [q, qd]: &[Vec<f64>; 2]) -> Dynamics {
        let mut workspace = Workspace::new(model);
        let mut forces =
            |qd: &[f64], qdd: &[f64]| inverse_frame(&mut workspace, Posture { q, qd, qdd }, &[]).generalized().to_vec();
        let still = vec![0.0; q.len()];
        let weight = forces(&still, &still);
        let mut inertia = Vec::with_capacity(q.len() * q.len());
        for c in 0..q.len() {
            let mut qdd = still.clone();
            qdd[c] = 1.0;
            inertia.extend(forces(&still, &qdd).iter().zip(&weight).map(|(force, weight)| force - weight));
        }
        Dynamics { inertia, bias: forces(qd, &still) }
    }

    /// The largest difference, as a share of the largest entry; infinite if a number is not finite.
    pub(super) fn difference(&self, other: &Dynamics) -> f64 {
        let apart = |ours: &[f64], theirs: &[f64]| {
            if ours.len() != theirs.len() || theirs.iter().any(|x| !x.is_finite()) {
                return f64::INFINITY;
            }
            let largest = ours.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            ours.iter().zip(theirs).map(|(a, b)| (a - b).abs() / largest).fold(0.0, f64::max)
        };
        apart(&self.inertia, &other.inertia).max(apart(&self.bias, &other.bias))
    }
}

/// `solref` times the mass 1/A that MuJoCo gives to the contact: stiffness [N/m] and damping [N.s/m].
fn of_mass(shoes: &HuntCrossley, radius: f64) -> [f64; 2] {
    let (force, _) = shoes.force(radius, MATCHED_M, 0.0, Vec3::zeros());
    let (d, most) = (impedance(MATCHED_M), IMPEDANCE[1]);
    let damping = 1.5 * shoes.dissipation * force;
    [force / MATCHED_M * (1.0 - d) * (most / d).powi(2), damping * (1.0 - d) * most / d]
}

/// MuJoCo's impedance d at a depth [m].
fn impedance(depth: f64) -> f64 {
    let [least, most, width, middle, power] = IMPEDANCE;
    let x = (depth / width).min(1.0);
    let share = if x <= middle {
        x.powf(power) / middle.powf(power - 1.0)
    } else {
        1.0 - (1.0 - x).powf(power) / (1.0 - middle).powf(power - 1.0)
    };
    least + (most - least) * share
}

fn vector(v: &Vec3) -> String {
    format!("{} {} {}", v.x, v.y, v.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ambulo::model::anthropometry::Build;

    fn man() -> Human {
        super::super::MAN.human().unwrap()
    }

    fn text(human: &Human) -> String {
        mjcf(human, &HuntCrossley::SOFT_SHOES, 0.001).unwrap()
    }

    #[test]
    fn every_coordinate_is_a_joint_and_all_but_the_root_have_motors() {
        let human = man();
        let text = text(&human);
        let parsed = roxmltree::Document::parse(&text).unwrap();
        let all = |tag: &str| parsed.descendants().filter(|node| node.has_tag_name(tag)).count();
        assert_eq!(all("joint"), human.model.coordinates().len());
        assert_eq!(all("general"), human.model.coordinates().len() - 3);
        assert_eq!(all("body"), human.model.bodies().len());
        assert_eq!(all("geom"), human.soles.len() + 1);
        let masses = parsed.descendants().filter_map(|node| node.attribute("mass")?.parse::<f64>().ok());
        assert!((masses.sum::<f64>() - human.model.mass()).abs() < 1e-9);
    }

    /// The fit is within 8 % from 3 to 18 mm; a linear spring of the same force at 10 mm is not.
    #[test]
    fn static_forces_of_spheres_are_those_of_the_shoes() {
        let (shoes, radius) = (HuntCrossley::SOFT_SHOES, 0.03);
        let [stiffness, _] = of_mass(&shoes, radius);
        for mm in 3..=18 {
            let depth = 1e-3 * f64::from(mm);
            let (expected, _) = shoes.force(radius, depth, 0.0, Vec3::zeros());
            let d = impedance(depth);
            let found = d * d / (1.0 - d) * stiffness * depth / IMPEDANCE[1].powi(2);
            assert!((found / expected - 1.0).abs() < 0.08, "{mm} mm: {found} instead of {expected} N");
        }
        let (at_half, _) = shoes.force(radius, 0.5 * MATCHED_M, 0.0, Vec3::zeros());
        let (matched, _) = shoes.force(radius, MATCHED_M, 0.0, Vec3::zeros());
        assert!(0.5 * matched > 1.3 * at_half);
    }

    #[test]
    fn another_figure_differs() {
        let heavier = Build { mass: 76.0, ..super::super::MAN }.human().unwrap();
        let human = man();
        let size = human.model.coordinates().len();
        let start = [vec![0.1; size], vec![0.2; size]];
        let of = |human: &Human| Dynamics::of(&human.model, &start);
        assert!(of(&human).difference(&of(&human)) <= 0.0);
        assert!(of(&human).difference(&of(&heavier)) > 0.01);
        let mut broken = of(&human);
        broken.bias[3] = f64::NAN;
        assert!(of(&human).difference(&broken).is_infinite());
    }
}
