//! The muscles of a model as data: paths, wraps and parameters. Units are SI and radians.

use ambulo_body::model::{BodyId, CoordinateId, Function};
use ambulo_body::spatial::{Pose, Vec3};

/// The muscles of a model, the bodies over which they wrap, and motors at single coordinates.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MuscleSet {
    /// Muscles, in the order of the document.
    pub muscles: Vec<Muscle>,
    /// Surfaces over which muscles wrap.
    pub wraps: Vec<WrapObject>,
    /// Motors at single coordinates, in the order of the document.
    pub actuators: Vec<CoordinateActuator>,
}

/// A muscle: its path over the body and the parameters of its force.
#[derive(Debug, Clone, PartialEq)]
pub struct Muscle {
    /// Name of the muscle.
    pub name: String,
    /// Its path from origin to insertion.
    pub path: MusclePath,
    /// What its force depends on.
    pub parameters: MuscleParameters,
}

/// The path of a muscle: straight lines between points, and around surfaces.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MusclePath {
    /// Points from origin to insertion.
    pub points: Vec<PathPoint>,
    /// Surfaces that the path avoids, in the order of the document.
    pub wraps: Vec<PathWrap>,
}

/// A point of a path, fixed to a body or moving on it.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub struct PathPoint {
    /// Name of the point.
    pub name: String,
    /// The body; `None` is ground.
    pub body: Option<BodyId>,
    /// Where it is on the body.
    pub place: PointPlace,
}

/// Margin at both ends of the range of a conditional point, as OpenSim has it [rad or m].
pub const RANGE_MARGIN: f64 = 1e-5;

/// Where a point of a path is on its body [m].
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub enum PointPlace {
    /// Always at one place.
    Fixed(Vec3),
    /// At one place, and part of the path only while a coordinate is in a range (both ends included, with the margin
    /// [`RANGE_MARGIN`]) [rad or m].
    Conditional {
        /// The place [m].
        place: Vec3,
        /// The coordinate.
        coordinate: CoordinateId,
        /// Least and greatest value.
        range: [f64; 2],
    },
    /// At a place whose x, y and z in a frame of the body are functions of coordinates [m]. A coordinate counts up to
    /// the ends of its range; without a coordinate the function is taken at 0.
    Moving {
        /// `body_from_frame`.
        frame: Pose,
        /// Coordinate and function of x, y and z.
        axes: Box<[(Option<CoordinateId>, Function); 3]>,
    },
}

/// A surface that a path avoids between two of its points.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PathWrap {
    /// Index in [`MuscleSet::wraps`].
    pub object: usize,
    /// First point of the part of the path that may touch it, counted from 0; `None` is the first of all.
    pub first: Option<usize>,
    /// Last point of that part, counted from 0; `None` is the last of all.
    pub last: Option<usize>,
    /// How OpenSim finds the points on an ellipsoid; of no meaning for other surfaces.
    pub method: WrapMethod,
}

/// How OpenSim finds a path over an ellipsoid.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WrapMethod {
    /// Both of the others, by the place.
    #[default]
    Hybrid,
    /// From the middle between the points.
    Midpoint,
    /// Along an axis.
    Axial,
}

/// A surface fixed to a body.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub struct WrapObject {
    /// Name of the surface.
    pub name: String,
    /// The body; `None` is ground.
    pub body: Option<BodyId>,
    /// `body_from_surface`.
    pub pose: Pose,
    /// Its shape.
    pub shape: WrapShape,
    /// The side on which a path may touch it; `None` is any side.
    pub quadrant: Option<Quadrant>,
    /// Whether paths wrap over it at all.
    pub active: bool,
}

/// The shape of a surface for paths, around its own origin.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WrapShape {
    /// A cylinder about the z axis.
    Cylinder {
        /// Radius [m].
        radius: f64,
        /// Length, half of it on each side of the origin [m].
        length: f64,
    },
    /// A sphere.
    Sphere {
        /// Radius [m].
        radius: f64,
    },
}

/// One side of a surface: the half-space in which an axis of its frame is positive or negative.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quadrant {
    /// 0, 1 or 2 for x, y or z.
    pub axis: usize,
    /// Whether the positive side is meant.
    pub positive: bool,
}

/// What the force of a muscle depends on.
#[derive(Debug, Clone, PartialEq)]
pub struct MuscleParameters {
    /// Greatest isometric force [N].
    pub max_isometric_force: f64,
    /// Fibre length at which the active force is greatest [m].
    pub optimal_fiber_length: f64,
    /// Length of the tendon without load [m].
    pub tendon_slack_length: f64,
    /// Angle between fibres and tendon at the optimal fibre length [rad].
    pub pennation_at_optimal: f64,
    /// Greatest velocity of shortening [optimal fibre lengths a second].
    pub max_contraction_velocity: f64,
    /// Greatest angle between fibres and tendon, which limits how short the fibres get [rad].
    pub max_pennation: f64,
    /// Whether the tendon keeps its slack length whatever the force (OpenSim's `ignore_tendon_compliance`).
    pub rigid_tendon: bool,
    /// Least and greatest activation: in OpenSim the controls of the muscle.
    pub activation_range: [f64; 2],
    /// Curves of force against length and velocity.
    pub curves: MuscleCurves,
}

/// The curves of a muscle, by the model of OpenSim whose parameters they have.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub enum MuscleCurves {
    /// Thelen 2003, OpenSim's `Thelen2003Muscle`.
    Thelen2003(ThelenCurves),
    /// Millard and others 2013, OpenSim's `Millard2012EquilibriumMuscle`.
    Millard2012(MillardCurves),
}

/// Parameters of the curves of Thelen 2003; the defaults are those of OpenSim.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub struct ThelenCurves {
    /// Strain of the tendon at the greatest isometric force (`FmaxTendonStrain`).
    pub tendon_strain_at_max: f64,
    /// Strain of the passive fibre at the greatest isometric force (`FmaxMuscleStrain`).
    pub fiber_strain_at_max: f64,
    /// Shape of the active force against length (`KshapeActive`).
    pub active_shape: f64,
    /// Shape of the passive force against length (`KshapePassive`).
    pub passive_shape: f64,
    /// Shape of force against velocity (`Af`).
    pub velocity_shape: f64,
    /// Greatest force of a lengthening fibre, in multiples of the isometric one (`Flen`).
    pub lengthening_force: f64,
    /// Share of the greatest lengthening force from which the curve continues as a straight line
    /// (`fv_linear_extrap_threshold`).
    pub straight_from: f64,
}

/// Parameters of the curves of Millard and others 2013, in the order of OpenSim's properties and as OpenSim uses them:
/// for a damped muscle (`fiber_damping` at least 0.001) or a rigid tendon the least active value and both slopes at the
/// greatest velocities are 0, whatever the file has; otherwise they are at least .1 and half the slopes near these
/// velocities.
#[doc(hidden)]
#[derive(Debug, Clone, PartialEq)]
pub struct MillardCurves {
    /// Active force against length (`ActiveForceLengthCurve`): least, transition and greatest length [optimal fibre
    /// lengths], slope of the shallow ascending part, least value.
    pub active: [f64; 5],
    /// Force against velocity (`ForceVelocityCurve`): slope at the greatest shortening, near it, isometric, at the
    /// greatest lengthening, near it, greatest lengthening force, curviness of shortening and of lengthening.
    pub velocity: [f64; 8],
    /// Passive force against length (`FiberForceLengthCurve`): strain at zero force, strain at unit force, stiffness at
    /// low force, stiffness at unit force, curviness. The last three follow from the others where they are not stated.
    pub passive: [Option<f64>; 5],
    /// Force of the tendon against its length (`TendonForceLengthCurve`): strain at unit force, stiffness at unit
    /// force, force at the end of the toe, curviness. The last three follow from the first where they are not stated.
    pub tendon: [Option<f64>; 4],
    /// Damping of the fibre along itself (`fiber_damping`) [greatest isometric forces per greatest velocity].
    pub fiber_damping: f64,
}

impl Default for ThelenCurves {
    fn default() -> ThelenCurves {
        ThelenCurves {
            tendon_strain_at_max: 0.04,
            fiber_strain_at_max: 0.6,
            active_shape: 0.45,
            passive_shape: 5.0,
            velocity_shape: 0.25,
            lengthening_force: 1.4,
            straight_from: 0.95,
        }
    }
}

impl Default for MillardCurves {
    /// The defaults of OpenSim for a damped muscle, which it uses unless `fiber_damping` is below 0.001.
    fn default() -> MillardCurves {
        MillardCurves {
            active: [0.47 - 0.0259, 0.73, 1.8123, 0.8616, 0.0],
            velocity: [0.0, 0.25, 5.0, 0.0, 0.15, 1.4, 0.6, 0.9],
            passive: [Some(0.0), Some(0.7), None, None, None],
            tendon: [Some(0.049), None, None, None],
            fiber_damping: 0.1,
        }
    }
}

/// A motor at one coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateActuator {
    /// Name of the motor.
    pub name: String,
    /// The coordinate.
    pub coordinate: CoordinateId,
    /// Its generalised force at control 1 [N.m or N].
    pub optimal_force: f64,
    /// Least and greatest control.
    pub control_range: [f64; 2],
}
