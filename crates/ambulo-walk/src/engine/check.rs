//! Checks of a world's description before it is simulated.

use super::world::{Owner, TreeJoint, World};
use crate::spatial::{Inertia, Mat3, Pose, Vec3};

/// Largest departure of a frame's axes from an orthonormal set that counts as rounding.
const SKEW: f64 = 1e-9;

/// An error in the description of a world.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[error("{what} `{name}`: {problem}")]
pub struct WorldError {
    /// Kind of part: body, joint, closure or surface.
    pub what: &'static str,
    /// Name of the part, or its number.
    pub name: String,
    /// Found and expected value.
    pub problem: String,
}

impl World {
    /// Checks masses, inertias, frames and references.
    ///
    /// # Errors
    /// The first error found.
    pub fn check(&self) -> Result<(), WorldError> {
        self.check_bodies()?;
        self.joints.iter().try_for_each(|joint| self.check_joint(joint))?;
        let last = self.joint_of_body();
        for (number, joint) in self.joints.iter().enumerate() {
            if let Some(other) = last[joint.child].filter(|other| *other != number) {
                let (child, other) = (&self.bodies[joint.child].name, &self.joints[other].name);
                let problem = format!("carries `{child}`, which `{other}` already carries; close loops by closures");
                return Err(WorldError { what: "joint", name: joint.name.clone(), problem });
            }
        }
        for closure in &self.closures {
            let wrong = |problem| WorldError { what: "closure", name: closure.name.clone(), problem };
            self.known(closure.first).map_err(wrong)?;
            closure.second.map_or(Ok(()), |second| self.known(second)).map_err(wrong)?;
            frame(&closure.first_from_joint).and_then(|()| frame(&closure.second_from_joint)).map_err(wrong)?;
        }
        for (number, surface) in self.surfaces.iter().enumerate() {
            let wrong = |problem| WorldError { what: "surface", name: number.to_string(), problem };
            match surface.owner {
                Owner::Body(body) => self.known(body).map_err(wrong)?,
                Owner::Obstacle(obstacle) if obstacle >= self.obstacles.len() => {
                    return Err(wrong(format!("names obstacle {obstacle} of {}", self.obstacles.len())));
                }
                Owner::Obstacle(_) => {}
            }
            frame(&surface.owner_from_shape).map_err(wrong)?;
            if surface.material >= self.materials.len() {
                return Err(wrong(format!("names material {} of {}", surface.material, self.materials.len())));
            }
        }
        Ok(())
    }

    fn check_bodies(&self) -> Result<(), WorldError> {
        for body in &self.bodies {
            let wrong = |problem| WorldError { what: "body", name: body.name.clone(), problem };
            let inertia =
                Inertia::new(body.mass, Vec3::zeros(), body.inertia).map_err(|error| wrong(error.to_string()))?;
            if let Some(defect) = inertia.defect() {
                return Err(wrong(format!("no rigid body has this inertia: {defect}")));
            }
            frame(&body.pose).map_err(wrong)?;
            if !body.twist.angular.iter().chain(body.twist.linear.iter()).all(|x| x.is_finite()) {
                return Err(wrong("its velocity is not finite".to_owned()));
            }
        }
        Ok(())
    }

    fn check_joint(&self, joint: &TreeJoint) -> Result<(), WorldError> {
        let wrong = |problem| WorldError { what: "joint", name: joint.name.clone(), problem };
        self.known(joint.child).map_err(wrong)?;
        joint.parent.map_or(Ok(()), |parent| self.known(parent)).map_err(wrong)?;
        frame(&joint.parent_from_joint).and_then(|()| frame(&joint.child_from_joint)).map_err(wrong)?;
        let (found, expected) = (joint.coordinates.len(), joint.kind.freedom());
        if found != expected {
            return Err(wrong(format!("has {found} coordinates; expected {expected} for its kind")));
        }
        match joint.follows {
            Some(follows) if follows.figure >= self.figures.len() => {
                Err(wrong(format!("follows figure {} of {}", follows.figure, self.figures.len())))
            }
            _ => Ok(()),
        }
    }

    fn known(&self, body: usize) -> Result<(), String> {
        if body < self.bodies.len() { Ok(()) } else { Err(format!("names body {body} of {}", self.bodies.len())) }
    }
}

/// Finite, orthonormal and right-handed.
fn frame(pose: &Pose) -> Result<(), String> {
    let r = &pose.rotation;
    if !r.iter().chain(pose.translation.iter()).all(|x| x.is_finite()) {
        return Err("a frame with a number that is not finite".to_owned());
    }
    if (r.transpose() * r - Mat3::identity()).amax() > SKEW {
        return Err("a frame whose axes are not orthonormal".to_owned());
    }
    if r.determinant() < 0.0 {
        return Err("a left-handed frame".to_owned());
    }
    Ok(())
}
