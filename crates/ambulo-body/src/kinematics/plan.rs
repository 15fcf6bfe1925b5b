//! A model prepared for fast sweeps: constant offsets are multiplied out, principal axes are recognised.
//!
//! The sweeps use only the joint frames M on the children: inertia, mass centre and the joints of the children are
//! given in the axes of M, so that an offset on the child costs nothing per frame.

use crate::model::{Bushing, Displacement, Function, Joint, JointAxis, JointSpeeds, Model, Resistance};
use crate::spatial::{Inertia, Mat3, Pose, Vec3};
use std::ops::Range;

/// A rotation closer to the identity than this is treated as the identity.
const IDENTITY_TOLERANCE: f64 = 1e-15;

/// A model prepared for the sweeps.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    pub(crate) gravity: Vec3,
    pub(crate) coordinates: usize,
    pub(crate) segments: Vec<Segment>,
    /// Segments by their depth in the tree. A child directly after its parent would wait for the results of the parent;
    /// siblings and cousins in between keep the processor busy.
    pub(crate) outwards: Vec<usize>,
    pub(crate) axes: Vec<Axis>,
    pub(crate) bushings: Vec<PlannedBushing>,
}

/// A bushing between two bodies.
#[derive(Debug, Clone)]
pub(crate) struct PlannedBushing {
    pub(crate) ends: [PlannedEnd; 2],
    pub(crate) stiffness: Resistance,
    pub(crate) damping: Resistance,
}

/// A frame of a bushing.
#[derive(Debug, Clone)]
pub(crate) struct PlannedEnd {
    /// State of the body: 0 is ground, i + 1 is body i.
    pub(crate) state: usize,
    /// Rotation from the axes of the frame to the axes of M.
    pub(crate) axes: Mat3,
    /// Vector from the mass centre to the origin of the frame, in M axes [m].
    pub(crate) from_center: Vec3,
}

/// One body and its joint.
#[derive(Debug, Clone)]
pub(crate) struct Segment {
    /// State of the parent: 0 is ground, i + 1 is body i.
    pub(crate) parent: usize,
    /// Vector from the parent's mass centre to F's origin, in the parent's M axes [m].
    pub(crate) to_joint: Vec3,
    /// F's axes in the parent's M axes, unless they are the same.
    pub(crate) offset: Option<Mat3>,
    /// Rotations, then translations, in [`Plan::axes`].
    pub(crate) rotations: Range<usize>,
    pub(crate) translations: Range<usize>,
    /// For ball-like joints, whose generalised forces are moments about the axes of F.
    pub(crate) spherical: Option<Spherical>,
    /// Length of the arc at whose end the origin of M is [m].
    pub(crate) arc: Option<f64>,
    /// Vector from M's origin to the mass centre, in M axes [m].
    pub(crate) to_center: Vec3,
    pub(crate) mass: f64,
    /// Inertia about the mass centre in M axes [kg.m²].
    pub(crate) inertia: Mat3,
    pub(crate) diagonal: bool,
    /// Pose of the body's own frame in M.
    pub(crate) joint_from_body: Pose,
}

/// A joint with [`JointSpeeds::AngularVelocity`] or [`JointSpeeds::Ellipsoid`].
#[derive(Debug, Clone)]
pub(crate) struct Spherical {
    /// Coordinates of the three rotations.
    pub(crate) coordinates: [usize; 3],
    /// Half axes of the ellipsoid on which the origin of M slides [m].
    pub(crate) radii: Option<Vec3>,
}

/// One rotation or translation axis of a joint.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    pub(crate) direction: Direction,
    pub(crate) source: Source,
}

/// Direction of an axis in the joint frame.
#[derive(Debug, Clone)]
pub(crate) enum Direction {
    /// Along x, y or z.
    Principal(usize),
    /// Any other unit vector.
    General(Vec3),
}

/// The angle or displacement along an axis: a constant, or a function of one coordinate.
#[derive(Debug, Clone)]
pub(crate) enum Source {
    Fixed(f64),
    Line { coordinate: usize, slope: f64, intercept: f64 },
    Curve { coordinate: usize, function: Function },
}

impl Plan {
    pub(crate) fn new(model: &Model) -> Plan {
        let mut plan = Plan {
            gravity: model.gravity(),
            coordinates: model.coordinates().len(),
            segments: Vec::new(),
            outwards: Vec::new(),
            axes: Vec::new(),
            bushings: Vec::new(),
        };
        for body in model.bodies() {
            let joint_from_body = body.joint.child_from_joint.inverse();
            let inertia = body.inertia.seen_from(&joint_from_body);
            plan.push(&body.joint, joint_from_body, &inertia);
        }
        plan.outwards = plan.by_depth();
        plan.bushings = model.bushings().iter().map(|bushing| plan.bushing(bushing)).collect();
        plan
    }

    fn bushing(&self, bushing: &Bushing) -> PlannedBushing {
        let ends = bushing.ends.map(|end| match end.body {
            None => PlannedEnd { state: 0, axes: end.frame.rotation, from_center: end.frame.translation },
            Some(id) => {
                let segment = &self.segments[id.index()];
                let frame = segment.joint_from_body * end.frame;
                let from_center = frame.translation - segment.to_center;
                PlannedEnd { state: id.index() + 1, axes: frame.rotation, from_center }
            }
        });
        PlannedBushing { ends, stiffness: bushing.stiffness, damping: bushing.damping }
    }

    fn push(&mut self, joint: &Joint, joint_from_body: Pose, inertia: &Inertia) {
        let (parent, parent_m_from_joint, parent_center) = match joint.parent {
            None => (0, joint.parent_from_joint, Vec3::zeros()),
            Some(id) => {
                let parent = &self.segments[id.index()];
                (id.index() + 1, parent.joint_from_body * joint.parent_from_joint, parent.to_center)
            }
        };
        let (turn, about_center) = (parent_m_from_joint.rotation, inertia.about_center());
        let rotations = self.push_axes(&joint.rotations);
        let translations = self.push_axes(&joint.translations);
        self.segments.push(Segment {
            parent,
            to_joint: parent_m_from_joint.translation - parent_center,
            offset: ((turn - Mat3::identity()).amax() > IDENTITY_TOLERANCE).then_some(turn),
            rotations,
            translations,
            spherical: spherical(joint),
            arc: match joint.speeds {
                JointSpeeds::Arc(length) => Some(length),
                _ => None,
            },
            to_center: inertia.center(),
            mass: inertia.mass(),
            inertia: about_center,
            diagonal: (about_center - Mat3::from_diagonal(&about_center.diagonal())).amax() < f64::MIN_POSITIVE,
            joint_from_body,
        });
    }

    fn by_depth(&self) -> Vec<usize> {
        let mut depth = vec![0; self.segments.len() + 1];
        for (i, segment) in self.segments.iter().enumerate() {
            depth[i + 1] = depth[segment.parent] + 1;
        }
        let mut order: Vec<usize> = (0..self.segments.len()).collect();
        order.sort_by_key(|&i| depth[i + 1]);
        order
    }

    fn push_axes(&mut self, axes: &[JointAxis]) -> Range<usize> {
        let start = self.axes.len();
        let stays =
            |axis: &&JointAxis| matches!(axis.displacement, Displacement::Fixed(v) if v.abs() < f64::MIN_POSITIVE);
        self.axes.extend(axes.iter().filter(|a| !stays(a)).map(Axis::new));
        start..self.axes.len()
    }
}

fn spherical(joint: &Joint) -> Option<Spherical> {
    let radii = match joint.speeds {
        JointSpeeds::Rates | JointSpeeds::Arc(_) => return None,
        JointSpeeds::AngularVelocity => None,
        JointSpeeds::Ellipsoid(radii) => Some(radii),
    };
    let coordinates: Vec<usize> = joint.coordinates().iter().map(|c| c.index()).take(3).collect();
    Some(Spherical { coordinates: coordinates.try_into().ok()?, radii })
}

impl Axis {
    fn new(axis: &JointAxis) -> Axis {
        let (direction, sign) = principal(&axis.direction);
        let source = Source::new(&axis.displacement, sign);
        Axis { direction, source }
    }
}

impl Source {
    /// `sign` (1 or -1) times the displacement of a joint axis.
    pub(crate) fn new(displacement: &Displacement, sign: f64) -> Source {
        match displacement {
            Displacement::Fixed(value) => Source::Fixed(sign * value),
            Displacement::Follows(id, function) => match function.as_linear() {
                Some((slope, intercept)) => {
                    Source::Line { coordinate: id.index(), slope: sign * slope, intercept: sign * intercept }
                }
                None if sign < 0.0 => Source::Curve {
                    coordinate: id.index(),
                    function: Function::Scaled(sign, Box::new(function.clone())),
                },
                None => Source::Curve { coordinate: id.index(), function: function.clone() },
            },
        }
    }

    /// The coordinate that moves the axis.
    #[inline(always)]
    pub(crate) fn coordinate(&self) -> Option<usize> {
        match self {
            Source::Fixed(_) => None,
            Source::Line { coordinate, .. } | Source::Curve { coordinate, .. } => Some(*coordinate),
        }
    }
}

/// A principal direction with the sign of the vector along it; any other direction unchanged.
fn principal(direction: &Vec3) -> (Direction, f64) {
    for k in 0..3 {
        let along = direction[k];
        if (direction - Vec3::ith(k, along)).amax() < IDENTITY_TOLERANCE {
            return (Direction::Principal(k), along.signum());
        }
    }
    (Direction::General(*direction), 1.0)
}
