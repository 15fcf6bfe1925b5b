//! Forces from force plates or other sensors: force, point of application and moment about it.
//! Pinned by: tests/force_tables.rs

use super::glitches::{self, RINGING, STEP_N};
use super::import::rows_with_clock;
use super::recording::MotionError;
use crate::findings::{Code, Findings};
use crate::model::{BodyId, Model};
use crate::spatial::{Mat3, Vec3};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;

/// A recorded load on one body.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceRecording {
    /// Name of the load.
    pub name: String,
    /// The body that the load acts on.
    pub body: BodyId,
    /// The body in whose axes force and moment are given; `None` is the world.
    pub force_frame: Option<BodyId>,
    /// The body in whose frame the point is given; `None` is the world.
    pub point_frame: Option<BodyId>,
    /// Times [s], strictly increasing.
    pub times: Vec<f64>,
    /// Force [N], one entry per time.
    pub force: Vec<Vec3>,
    /// Point of application [m]; not a number where it is not measured.
    pub point: Vec<Vec3>,
    /// Moment about the point [N.m].
    pub moment: Vec<Vec3>,
}

impl ForceRecording {
    /// Rotates the world axes, `rotation * v`; vectors in the axes of a body do not change.
    pub fn rotate(&mut self, rotation: &Mat3) {
        if self.force_frame.is_none() {
            self.force.iter_mut().chain(&mut self.moment).for_each(|v| *v = rotation * *v);
        }
        if self.point_frame.is_none() {
            self.point.iter_mut().for_each(|p| *p = rotation * *p);
        }
    }
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl ForceRecording {
    /// Range of the force, without its rarest values.
    fn load(&self) -> Option<f64> {
        glitches::range(&self.force.iter().map(|force| force.norm()).collect::<Vec<_>>())
    }

    /// A component of the force.
    fn component(&self, axis: usize) -> Vec<f64> {
        self.force.iter().map(|force| force[axis]).collect()
    }

    /// Replaces excursions of the force that no load makes by straight lines, and the point and the moment at the same
    /// times, which were computed from the force.
    fn bridge_excursions(&mut self, findings: &mut Findings) {
        let Some(load) = self.load().filter(|load| *load > STEP_N) else { return };
        let [Some(first), Some(last)] = [self.times.first(), self.times.last()] else { return };
        let rate_hz = (self.times.len() - 1) as f64 / (last - first);
        for (axis, name) in AXES.into_iter().enumerate() {
            let spans = glitches::excursions(&self.component(axis), rate_hz, RINGING * load);
            for span in &spans {
                for values in [&mut self.force, &mut self.point, &mut self.moment] {
                    glitches::bridge(values, span);
                }
            }
            let what = format!("the force `{}` along {name}", self.name);
            glitches::report(&what, &spans, (&self.times, rate_hz), findings);
        }
    }
}

/// Reports components of loaded forces that have one value at all times. A table of a plane has no force across it, so
/// that a component of zeros must be there in another load of the table.
fn report_still(recordings: &[ForceRecording], findings: &mut Findings) {
    let is_still = |recording: &ForceRecording, axis: usize| glitches::is_still(&recording.component(axis));
    for (axis, name) in AXES.into_iter().enumerate() {
        let is_moving = recordings.iter().any(|recording| !is_still(recording, axis));
        let is_set = |recording: &ForceRecording| recording.force.first().is_some_and(|force| force[axis].abs() > 0.0);
        for recording in recordings.iter().filter(|recording| is_still(recording, axis)) {
            let Some(load_n) = recording.load().filter(|load| *load > STEP_N) else { continue };
            if is_moving || is_set(recording) {
                let message = format!(
                    "the force `{}` carries a load of {load_n:.0} N, but has one value along {name} all the time: this \
                     part of the force is missing, and moments that need it are wrong. hint: check the columns of the \
                     table, and the cables and the amplifier of the plate",
                    recording.name
                );
                findings.report(Code::PlatesStillChannel, message);
            }
        }
    }
}

/// Largest plausible distance of a loaded point from the origin [m]; a larger one is probably in millimetres.
const FARTHEST_PLAUSIBLE_POINT_M: f64 = 60.0;
/// Smallest load for this test [N].
const LOADED_N: f64 = 20.0;

/// Reads the loads of an external-loads document from the columns of `table`.
///
/// # Errors
/// Unknown bodies or columns, times that do not increase.
pub fn force_recordings(
    model: &Model,
    loads: &ExternalLoads,
    table: &Table,
    findings: &mut Findings,
) -> Result<Vec<ForceRecording>, MotionError> {
    let (kept, times) = rows_with_clock(table, findings)?;
    let mut recordings = Vec::new();
    for load in &loads.forces {
        if !load.enabled {
            findings.report(
                Code::LoadsSwitchedOff,
                format!("the load `{}` is switched off in its file; it was not used", load.name),
            );
            continue;
        }
        let recording = ForceRecording {
            name: load.name.clone(),
            body: find_body(model, load, &load.applied_to_body)?
                .ok_or_else(|| unknown_body(model, load, &load.applied_to_body))?,
            force_frame: find_body(model, load, &load.force_expressed_in_body)?,
            point_frame: find_body(model, load, &load.point_expressed_in_body)?,
            times: times.clone(),
            force: triple(table, &kept, load, load.force_identifier.as_deref(), "the force")?,
            point: triple(table, &kept, load, load.point_identifier.as_deref(), "the point")?,
            moment: triple(table, &kept, load, load.torque_identifier.as_deref(), "the torque")?,
        };
        report_millimetres(&recording, findings);
        recordings.push(recording);
    }
    report_still(&recordings, findings);
    recordings.iter_mut().for_each(|recording| recording.bridge_excursions(findings));
    Ok(recordings)
}

/// The body, or `None` for ground.
fn find_body(model: &Model, load: &ExternalForce, name: &str) -> Result<Option<BodyId>, MotionError> {
    if name == "ground" {
        return Ok(None);
    }
    model.body(name).map(Some).ok_or_else(|| unknown_body(model, load, name))
}

fn unknown_body(model: &Model, load: &ExternalForce, name: &str) -> MotionError {
    let known: Vec<_> = model.bodies().iter().map(|b| b.name.as_str()).collect();
    MotionError::UnknownBody { load: load.name.clone(), body: name.to_owned(), known: known.join(", ") }
}

/// Columns `<identifier>x`, `y`, `z`; zeros without an identifier.
fn triple(
    table: &Table,
    rows: &[usize],
    load: &ExternalForce,
    identifier: Option<&str>,
    what: &str,
) -> Result<Vec<Vec3>, MotionError> {
    let Some(identifier) = identifier else { return Ok(vec![Vec3::zeros(); rows.len()]) };
    let column = |axis: &str| {
        let column = format!("{identifier}{axis}");
        table.column(&column).ok_or_else(|| MotionError::NoColumn {
            column,
            purpose: format!("{what} of the load `{}`", load.name),
            found: table.names().join(", "),
        })
    };
    let (x, y, z) = (column("x")?, column("y")?, column("z")?);
    Ok(rows.iter().map(|&i| Vec3::new(x[i], y[i], z[i])).collect())
}

fn report_millimetres(recording: &ForceRecording, findings: &mut Findings) {
    let loaded =
        recording.force.iter().zip(&recording.point).filter(|(f, p)| f.norm() > LOADED_N && p.norm().is_finite());
    let farthest = loaded.map(|(_, p)| p.norm()).fold(0.0, f64::max);
    if farthest > FARTHEST_PLAUSIBLE_POINT_M {
        let message = format!(
            "the load `{}` acts up to {farthest:.0} m from the origin; its points look like millimetres. hint: divide \
             the points by 1000, and the moments too if they are N.mm",
            recording.name
        );
        findings.report(Code::LoadsMillimetres, message);
    }
}
