//! Muscles as part of an OpenSim document.
//!
//! Pinned by: tests/round_trip.rs

use crate::set::{
    CoordinateActuator, Muscle, MuscleCurves, MuscleSet, PathPoint, PathWrap, PointPlace, Quadrant, WrapMethod,
    WrapObject, WrapShape,
};
use ambulo_body::model::osim_frame::frame;
use ambulo_body::model::{BodyId, CoordinateId, Model, osim_function};
use ambulo_body::spatial::Pose;
use ambulo_formats::osim::{
    OsimCoordinateActuator, OsimModel, OsimMuscle, OsimMuscleCurves, OsimMuscleKind, OsimMuscleParameters, OsimMuscles,
    OsimPath, OsimPathPoint, OsimPathWrap, OsimPointPlace, OsimWrapObject, OsimWrapShape,
};

impl MuscleSet {
    /// Puts the muscles, surfaces and motors into the document of their model, as
    /// [`to_osim`](ambulo_body::model::to_osim) makes it. Reading it again gives the same set, except that orientations
    /// of surfaces are written as angles and read back to rounding.
    pub fn write_into(&self, model: &Model, document: &mut OsimModel) {
        document.muscles = Ok(OsimMuscles {
            muscles: self.muscles.iter().map(|m| muscle(self, model, m)).collect(),
            wrap_objects: self.wraps.iter().map(|w| wrap_object(model, w)).collect(),
            actuators: self.actuators.iter().map(|a| actuator(model, a)).collect(),
        });
    }
}

fn body_name(model: &Model, body: Option<BodyId>) -> String {
    body.map_or("ground", |id| model.bodies()[id.index()].name.as_str()).to_owned()
}

fn coordinate_name(model: &Model, id: CoordinateId) -> String {
    model.coordinates()[id.index()].name.clone()
}

fn muscle(set: &MuscleSet, model: &Model, muscle: &Muscle) -> OsimMuscle {
    let parameters = &muscle.parameters;
    let kind = OsimMuscleParameters {
        path: OsimPath {
            points: muscle.path.points.iter().map(|p| point(model, p)).collect(),
            wraps: muscle.path.wraps.iter().map(|w| path_wrap(set, w)).collect(),
        },
        control_range: parameters.activation_range,
        max_isometric_force: parameters.max_isometric_force,
        optimal_fiber_length: parameters.optimal_fiber_length,
        tendon_slack_length: parameters.tendon_slack_length,
        pennation_angle_at_optimal: parameters.pennation_at_optimal,
        max_contraction_velocity: parameters.max_contraction_velocity,
        maximum_pennation_angle: parameters.max_pennation,
        ignore_tendon_compliance: parameters.rigid_tendon,
        curves: curves(&parameters.curves),
    };
    OsimMuscle { name: muscle.name.clone(), line: 0, applies_force: true, kind: OsimMuscleKind::Known(Box::new(kind)) }
}

fn curves(curves: &MuscleCurves) -> OsimMuscleCurves {
    match curves {
        MuscleCurves::Thelen2003(c) => OsimMuscleCurves::Thelen2003([
            c.tendon_strain_at_max,
            c.fiber_strain_at_max,
            c.active_shape,
            c.passive_shape,
            c.velocity_shape,
            c.lengthening_force,
            c.straight_from,
        ]),
        MuscleCurves::Millard2012(c) => OsimMuscleCurves::Millard2012 {
            active_force_length: c.active,
            force_velocity: c.velocity,
            fiber_force_length: c.passive,
            tendon_force_length: c.tendon,
            fiber_damping: c.fiber_damping,
        },
    }
}

fn point(model: &Model, point: &PathPoint) -> OsimPathPoint {
    let body = body_name(model, point.body);
    let (pose, place) = match &point.place {
        PointPlace::Fixed(place) => (Pose::IDENTITY, OsimPointPlace::Fixed((*place).into())),
        PointPlace::Conditional { place, coordinate, range } => {
            let coordinate = Some(coordinate_name(model, *coordinate));
            let place = OsimPointPlace::Conditional { location_m: (*place).into(), coordinate, range: *range };
            (Pose::IDENTITY, place)
        }
        PointPlace::Moving { frame, axes } => {
            let axes = axes.each_ref().map(|(coordinate, function)| {
                (coordinate.map(|id| coordinate_name(model, id)), osim_function::write(function))
            });
            (*frame, OsimPointPlace::Moving(Box::new(axes)))
        }
    };
    OsimPathPoint { name: point.name.clone(), frame: frame(body, &pose), place }
}

fn path_wrap(set: &MuscleSet, wrap: &PathWrap) -> OsimPathWrap {
    let number = |index: Option<usize>| index.and_then(|i| i32::try_from(i + 1).ok()).unwrap_or(-1);
    let method = match wrap.method {
        WrapMethod::Hybrid => "hybrid",
        WrapMethod::Midpoint => "midpoint",
        WrapMethod::Axial => "axial",
    };
    OsimPathWrap {
        object: set.wraps[wrap.object].name.clone(),
        method: method.to_owned(),
        range: [number(wrap.first), number(wrap.last)],
    }
}

fn wrap_object(model: &Model, wrap: &WrapObject) -> OsimWrapObject {
    OsimWrapObject {
        name: wrap.name.clone(),
        line: 0,
        frame: frame(body_name(model, wrap.body), &wrap.pose),
        shape: match wrap.shape {
            WrapShape::Cylinder { radius, length } => OsimWrapShape::Cylinder { radius, length },
            WrapShape::Sphere { radius } => OsimWrapShape::Sphere { radius },
        },
        quadrant: wrap.quadrant.map_or("all", quadrant),
        active: wrap.active,
    }
}

fn quadrant(side: Quadrant) -> &'static str {
    match (side.axis, side.positive) {
        (0, true) => "x",
        (0, false) => "-x",
        (1, true) => "y",
        (1, false) => "-y",
        (_, true) => "z",
        (_, false) => "-z",
    }
}

fn actuator(model: &Model, actuator: &CoordinateActuator) -> OsimCoordinateActuator {
    OsimCoordinateActuator {
        name: actuator.name.clone(),
        line: 0,
        coordinate: coordinate_name(model, actuator.coordinate),
        optimal_force: actuator.optimal_force,
        control_range: actuator.control_range,
    }
}
