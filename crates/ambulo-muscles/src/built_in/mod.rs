//! Muscles for the built-in body of any person, from the published parameters of Gait2392.
//!
//! `data/leg_muscles.toml` has the 43 muscles of a leg: path points in segment frames that joint centres define, and
//! parameters; its header has source and licence. A set for a person follows from the joint centres of the model in its
//! neutral posture:
//!
//!   p_body = o + R (s p)          path points and functions of moving points
//!   l_opt, l_slack ∝ L / L₀       fibres and tendons
//!   F ∝ (V / V₀) / (L / L₀)       greatest isometric forces
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | p | a point in the frame of its segment on the reference body | m |
//! | o, R | origin and axes of the segment frame in the body: table below | m, - |
//! | s | size of the segment over that of the reference: table below | - |
//! | L, L₀ | length of the path in the neutral posture, with the sizes of the person and of the reference | m |
//! | V, V₀ | muscle volume of both legs, 47.05 m h + 1289.6 | cm³ |
//! | m, h | body mass and stature; both statures follow from thigh and shank | kg, m |
//!
//! Axes are x forward, y up and z to the right; legs are thigh + shank, the mean of both sides.
//!
//! | segment | origin | axes | size |
//! |---|---|---|---|
//! | pelvis | hip of the side | through the markers of the iliac spines | distance between the anterior markers |
//! | thigh | hip | y from the knee to the hip, z along the axis of the knee | its length |
//! | shank | knee | y from the ankle to the knee, z along the axis of the knee | its length |
//! | foot | ankle | of the flat foot | legs |
//! | toes | joint of the toes, as far to the side as on the reference | of the flat foot | legs |
//!
//! Without markers on the spines the pelvis stands upright as the reference and has the size of the legs. Without a
//! joint of the toes their points belong to the foot. Left legs are mirror images. A force is a volume over a fibre
//! length times a specific tension, which is assumed to be that of the reference. No muscle is modelled for coordinates
//! outside hips, knees and ankles (lumbar joint, arms, toes): each has an unlimited motor. So has the subtalar joint,
//! although muscles cross it, which is what Rajagopal's `subject_walk_scaled.osim` assumes by welding it (read): the
//! Achilles tendon passes its axis at a few millimetres, on one side or the other, so that small errors of the axis or
//! of the centre of pressure would decide which muscles have to balance it.
//!
//! Sources: parameters and paths: the header of the data file. Volume: Handsfield and others 2014 (unverified), as in
//! the public script of D. Stanev with Rajagopal's rule for forces (read).
//! Not handled: knees that slide or roll; trunk and arm muscles; volumes of children (the regression is on adults). A
//! knee that extends beyond the range of its coordinate has too large arms of the quadriceps, because the patella
//! stands still there.
//! Pinned by: tests/built_in/arms.rs, tests/built_in/contact.rs, tests/built_in/persons.rs,
//! tests/built_in/write_table.rs

mod segments;
mod table;

use crate::set::{
    CoordinateActuator, Muscle, MuscleCurves, MuscleParameters, MusclePath, MuscleSet, PathPoint, PointPlace,
};
use ambulo_body::model::{BodyId, CoordinateId, CoordinateKind, Drive, Model, Movement, Side};
use ambulo_body::spatial::Vec3;
use ambulo_body::toml_reader::TomlError;
use segments::{JointAngle, Leg};
use table::{LegTable, MuscleRow, PlaceRow, PointRow};

/// Moment of a motor at control 1 [N.m, or N for a translation]: that of the motors of arms and trunk in the model of
/// Rajagopal and others 2016 (`subject_walk_scaled.osim`, read).
const MOTOR_FORCE: f64 = 50.0;
/// Moment of the motor of a subtalar joint at control 1 [N.m]: so much that it costs nothing, as where it is locked.
const SUBTALAR_FORCE: f64 = 1000.0;
/// Least and greatest activation of a muscle, OpenSim's default.
const ACTIVATION_RANGE: [f64; 2] = [0.01, 1.0];
/// Muscle volume of both legs: slope [cm³/(kg m)] and intercept [cm³] against body mass times stature.
const VOLUME: [f64; 2] = [47.05, 1289.6];

/// Why a model cannot have the built-in muscles.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuiltInError {
    /// A model without a pelvis and two legs.
    #[error("the model `{model}` has no pelvis with two legs; expected both for the built-in muscles")]
    NoLegs {
        /// Name of the model.
        model: String,
    },
    /// A leg without a coordinate for a movement.
    #[error("the {side} leg of the model `{model}` has no coordinate for {movement}; expected one")]
    NoCoordinate {
        /// Name of the model.
        model: String,
        /// The leg.
        side: Side,
        /// The movement.
        movement: &'static str,
    },
    /// A knee that is no hinge.
    #[error(
        "the {side} knee of the model `{model}` slides or has a fixed axis; expected a hinge, as in the built-in body. \
         hint: models of OpenSim bring their own muscles"
    )]
    Knee {
        /// Name of the model.
        model: String,
        /// The leg.
        side: Side,
    },
    /// Joint centres that do not define the frame of a segment.
    #[error("the {side} {segment} of the model `{model}` has no length; expected joint centres at different places")]
    Length {
        /// Name of the model.
        model: String,
        /// The leg.
        side: Side,
        /// The segment.
        segment: &'static str,
    },
    /// The built-in table cannot be read; a test reads it.
    #[error("the table of the muscles of the leg")]
    Table(#[from] TomlError),
}

/// The muscles of both legs, right leg first, and a motor at every coordinate outside the legs, for a built-in body of
/// any person or another model whose knees are hinges.
///
/// # Errors
/// A model without two legs, or without hinges at the knees: see [`BuiltInError`].
///
/// ```
/// use ambulo_body::model::anthropometry::{Build, SegmentTable};
/// use ambulo_body::model::full_body::full_body;
/// use ambulo_muscles::built_in;
///
/// let person = full_body(&Build { table: SegmentTable::DeLevaFemale, mass: 58.0, height: 1.66, toe_joint: true })?;
/// let set = built_in::muscle_set(&person.model)?;
/// assert_eq!(set.muscles.len(), 86);
/// assert!(set.muscles.iter().any(|muscle| muscle.name == "soleus_l"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn muscle_set(model: &Model) -> Result<MuscleSet, BuiltInError> {
    let table = LegTable::built_in()?;
    let legs = Leg::both(model, &table.reference)?;
    let volume = volume_ratio(model, table, &legs);
    let muscles = legs.iter().flat_map(|leg| table.muscles.iter().map(move |row| muscle(table, row, leg, volume)));
    Ok(MuscleSet { muscles: muscles.collect(), wraps: Vec::new(), actuators: motors(model) })
}

/// Muscle volume of the person over that of the reference. Both statures follow from thigh and shank by one rule.
fn volume_ratio(model: &Model, table: &LegTable, legs: &[Leg; 2]) -> f64 {
    let height = model.stature().height_m;
    let volume = |mass: f64, height: f64| VOLUME[0] * mass * height + VOLUME[1];
    volume(model.mass(), height) / volume(table.reference.mass_kg, height / legs[0].size)
}

fn muscle(table: &LegTable, row: &MuscleRow, leg: &Leg, volume: f64) -> Muscle {
    let name = format!("{}_{}", row.name, leg.side.letter());
    let longer = neutral_length(row, leg, true) / neutral_length(row, leg, false);
    let points = row.points.iter().enumerate().map(|(i, point)| path_point(format!("{name}-P{}", i + 1), point, leg));
    let path = MusclePath { points: points.collect(), wraps: Vec::new() };
    let parameters = MuscleParameters {
        max_isometric_force: row.force_n * volume / longer,
        optimal_fiber_length: row.fiber_m * longer,
        tendon_slack_length: row.tendon_m * longer,
        pennation_at_optimal: row.pennation_rad,
        max_contraction_velocity: table.max_contraction_velocity,
        max_pennation: table.max_pennation_rad,
        rigid_tendon: false,
        activation_range: ACTIVATION_RANGE,
        curves: MuscleCurves::Thelen2003(table.curves.clone()),
    };
    Muscle { name, path, parameters }
}

fn path_point(name: String, row: &PointRow, leg: &Leg) -> PathPoint {
    let frame = leg.frame(row.segment);
    let place = match &row.place {
        PlaceRow::Fixed(place) => PointPlace::Fixed(frame.place(leg.own_side(*place))),
        PlaceRow::Conditional { place, joint, range } => {
            let JointAngle { coordinate, .. } = *leg.angle(*joint);
            let place = frame.place(leg.own_side(*place));
            PointPlace::Conditional { place, coordinate, range: leg.angle(*joint).range(*range) }
        }
        PlaceRow::Moving { joint, spline } => {
            let angle = leg.angle(*joint);
            let signs = leg.own_side(Vec3::new(1.0, 1.0, 1.0)) * frame.scale;
            let axes = [0, 1, 2].map(|k| (Some(angle.coordinate), angle.function(&spline[k], signs[k])));
            PointPlace::Moving { frame: frame.body_from_segment, axes: Box::new(axes) }
        }
    };
    PathPoint { name, body: Some(frame.body), place }
}

/// Length of a path in the neutral posture [m], with the lengths of the person or of the reference.
fn neutral_length(row: &MuscleRow, leg: &Leg, is_own: bool) -> f64 {
    let places = row.points.iter().filter_map(|point| {
        let place = match &point.place {
            PlaceRow::Fixed(place) => *place,
            PlaceRow::Conditional { place, joint, range } => {
                let neutral = leg.angle(*joint).neutral;
                (range[0]..=range[1]).contains(&neutral).then_some(*place)?
            }
            PlaceRow::Moving { joint, spline } => {
                let neutral = leg.angle(*joint).neutral;
                Vec3::from([0, 1, 2].map(|k| spline[k].at(neutral)[0]))
            }
        };
        Some(leg.neutral_place(point.segment, leg.own_side(place), is_own))
    });
    let places: Vec<Vec3> = places.collect();
    places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// A motor at every free coordinate outside the root and the legs, and at the subtalar joints.
fn motors(model: &Model) -> Vec<CoordinateActuator> {
    let in_leg = |body: BodyId| {
        model.anatomy().legs().values().flatten().any(|leg| {
            let mut upwards = std::iter::successors(Some(leg.foot), |own| model.bodies()[own.index()].joint.parent);
            upwards.any(|own| own == body)
        })
    };
    let inversion = |side| Some(model.anatomy().coordinate(Movement::SubtalarInversion, Some(side))?.0);
    let subtalar: Vec<CoordinateId> = Side::BOTH.into_iter().filter_map(inversion).collect();
    let bodies = model.body_ids().filter(|body| !in_leg(*body));
    let joints = bodies.map(|body| &model.bodies()[body.index()].joint).filter(|joint| joint.parent.is_some());
    let driven = joints.flat_map(|joint| joint.coordinates()).chain(subtalar.iter().copied());
    let free = driven.filter_map(|coordinate| {
        let found = &model.coordinates()[coordinate.index()];
        let is_free = found.drive == Drive::Free && found.kind != CoordinateKind::Coupled;
        is_free.then(|| CoordinateActuator {
            name: format!("{}_motor", found.name),
            coordinate,
            optimal_force: if subtalar.contains(&coordinate) { SUBTALAR_FORCE } else { MOTOR_FORCE },
            control_range: [f64::NEG_INFINITY, f64::INFINITY],
        })
    });
    free.collect()
}
