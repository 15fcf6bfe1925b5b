//! Forces from force plates or other sensors: force, point of application and moment about it.
//! Pinned by: tests/force_tables.rs

use super::glitches::{self, RINGING, STEP_N, Sensor};
use super::import::rows_with_clock;
use super::recording::MotionError;
use crate::findings::{Code, Findings, and_more_times};
use crate::model::{BodyId, Model};
use crate::numerics::{counted, extremes, median};
use crate::spatial::{Mat3, Vec3};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;
use std::ops::Range;

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

/// Rows with solid loads, without others between them.
struct SolidRun {
    rows: Range<usize>,
    /// Smallest and largest coordinates of their points [m].
    bounds: [(f64, f64); 3],
}

impl ForceRecording {
    /// Range of the force, without its rarest values.
    fn load(&self) -> Option<f64> {
        glitches::range(&self.force.iter().map(|force| force.norm()).collect::<Vec<_>>())
    }

    /// A component of the force where it is loaded. Without a load a table may have anything that is small.
    fn under_load(&self, axis: usize) -> Vec<f64> {
        self.force.iter().filter(|force| force.norm() > LOADED_N).map(|force| force[axis] + 0.0).collect()
    }

    /// Smallest solid load [N].
    fn solid_n(&self) -> f64 {
        let largest = self.force.iter().map(|force| force.norm()).filter(|x| x.is_finite()).fold(0.0, f64::max);
        LOADED_N.max(SOLID_SHARE * largest)
    }

    /// Distance of the points of solid loads from the origin [m]; 0 without any.
    fn usual_distance_m(&self) -> f64 {
        let solid_n = self.solid_n();
        let solid = self.force.iter().zip(&self.point).filter(|(f, p)| f.norm() > solid_n && p.norm().is_finite());
        median(solid.map(|(_, p)| p.norm())).unwrap_or(0.0)
    }

    /// Runs of rows with solid loads, each with the box around its points.
    fn solid_runs(&self) -> Vec<SolidRun> {
        let solid_n = self.solid_n();
        let is_solid = |i: &usize| self.force[*i].norm() > solid_n;
        let (mut runs, mut start) = (Vec::new(), 0);
        while start < self.times.len() {
            let length = (start..self.times.len()).take_while(is_solid).count();
            let rows = start..start + length;
            let along = |axis: usize| extremes(&self.point[rows.clone()].iter().map(|p| p[axis]).collect::<Vec<_>>());
            let bounds = [along(0), along(1), along(2)];
            if length > 0 && bounds.iter().all(|(low, high)| low.is_finite() && high.is_finite() && low <= high) {
                runs.push(SolidRun { rows, bounds });
            }
            start += length + 1;
        }
        runs
    }

    /// Reads rows without a force as unloaded if the table leaves out all light loads. It does if hardly any other row
    /// is unloaded, and if the loads before and after the empty rows are small.
    fn unload_empty_rows(&mut self, findings: &mut Findings) {
        let norms: Vec<f64> = self.force.iter().map(|force| force.norm()).collect();
        let light_n = EMPTY_SHARE * norms.iter().copied().filter(|n| n.is_finite()).fold(0.0, f64::max);
        let known: Vec<usize> = (0..norms.len()).filter(|i| norms[*i].is_finite()).collect();
        let empty: Vec<usize> = (0..norms.len()).filter(|i| !norms[*i].is_finite()).collect();
        let (Some(&first), Some(&last)) = (known.first(), known.last()) else { return };
        let is_light = |i: usize| norms[i] < light_n;
        let between = known.windows(2).all(|pair| pair[0] + 1 == pair[1] || pair.iter().all(|i| is_light(*i)));
        let ends = (first == 0 || is_light(first)) && (last + 1 == norms.len() || is_light(last));
        let unloaded = norms.iter().filter(|norm| **norm < UNLOADED_N).count();
        if empty.is_empty() || !between || !ends || UNLOADED_ROWS * unloaded > empty.len() {
            return;
        }
        let message = format!(
            "the load `{}` has no force in {}, beside loads of less than {light_n:.0} N; read as no load",
            self.name,
            counted(empty.len(), "row")
        );
        findings.report(Code::LoadsPointUndefined, message);
        for i in empty {
            (self.force[i], self.moment[i]) = (Vec3::zeros(), Vec3::zeros());
        }
    }

    /// Holds points of light loads at those of the nearest solid loads. A force that was filtered after its point was
    /// computed, or a number that stands for "no point", leaves them anywhere, where their moments are large.
    fn hold_light_points(&mut self, findings: &mut Findings) {
        let runs = if self.usual_distance_m() > FARTHEST_PLAUSIBLE_POINT_M { Vec::new() } else { self.solid_runs() };
        let (mut held, mut farthest_m) = (0, 0.0_f64);
        for i in 0..self.times.len() {
            let next = runs.partition_point(|run| run.rows.end <= i);
            let around = [next.checked_sub(1), Some(next)].into_iter().flatten().filter_map(|k| runs.get(k));
            let apart = |run: &&SolidRun| run.rows.start.saturating_sub(i).max((i + 1).saturating_sub(run.rows.end));
            let Some(SolidRun { rows, bounds }) = around.min_by_key(apart) else { return };
            let point = self.point[i];
            let nearest = Vec3::from_fn(|axis, _| point[axis].clamp(bounds[axis].0, bounds[axis].1));
            let off_m = (point - nearest).norm();
            let is_far = off_m > FARTHEST_LIGHT_POINT_M && off_m * self.force[i].norm() > HARMLESS_NM;
            if is_far && !rows.contains(&i) {
                (held, farthest_m) = (held + 1, farthest_m.max(off_m));
                self.point[i] = nearest;
            }
        }
        if held > 0 {
            let message = format!(
                "points of the load `{}` lie up to {farthest_m:.1} m from the foot under less than {:.0} N ({}): \
                 a force that was filtered after its points were computed, or numbers for no point; they were held at \
                 the nearest point of a solid load. hint: filter forces and moments first, and compute points then",
                self.name,
                self.solid_n(),
                counted(held, "row")
            );
            findings.report(Code::LoadsLightPoint, message);
        }
    }

    /// Reports times without rows under a load.
    fn report_missing_rows(&self, step_s: f64, findings: &mut Findings) {
        let is_hole = |i: &usize| {
            let is_loaded = |i: usize| self.force[i].norm() > LOADED_N;
            self.times[i + 1] - self.times[*i] > SHORTEST_HOLE_S.max(3.0 * step_s)
                && (is_loaded(*i) || is_loaded(i + 1))
        };
        let holes: Vec<usize> = (0..self.times.len().saturating_sub(1)).filter(is_hole).collect();
        let Some(first) = holes.first() else { return };
        let message = format!(
            "the force `{}` has no rows from {:.3} to {:.3} s{}, under a load: straight lines were drawn instead, and \
             the force there is not known. hint: keep all rows of the table",
            self.name,
            self.times[*first],
            self.times[first + 1],
            and_more_times(holes.len())
        );
        findings.report(Code::PlatesLost, message);
    }

    /// Mends what no load does to the force; the point and the moment, which were computed from it, follow.
    fn mend(&mut self, findings: &mut Findings) {
        let Some(load) = self.load().filter(|load| *load > STEP_N) else { return };
        let steps = self.times.windows(2).map(|pair| pair[1] - pair[0]);
        let Some(step_s) = median(steps) else { return };
        self.report_missing_rows(step_s, findings);
        let name = format!("the force `{}`", self.name);
        let mut signals: Vec<Vec<f64>> =
            [&self.force, &self.point, &self.moment].into_iter().flat_map(|vectors| columns(vectors)).collect();
        let sensor = Sensor {
            name: &name,
            names: AXES.map(|axis| format!("{name} along {axis}")).to_vec(),
            least: vec![RINGING * load; AXES.len()],
            times: &self.times,
            rate_hz: 1.0 / step_s,
        };
        sensor.mend(&mut signals, findings);
        for (axis, signal) in signals.iter().enumerate() {
            let part = [&mut self.force, &mut self.point, &mut self.moment];
            let values = part.into_iter().nth(axis / 3).into_iter().flatten();
            values.zip(signal).for_each(|(value, x)| value[axis % 3] = *x);
        }
    }
}

/// The components of vectors.
fn columns(vectors: &[Vec3]) -> [Vec<f64>; 3] {
    std::array::from_fn(|axis| vectors.iter().map(|vector| vector[axis]).collect())
}

/// Reports components of forces that have one value at all times under a load. A table of a plane has no force across
/// it, so that a component of zeros must be there in another load of the table.
fn report_still(recordings: &[ForceRecording], findings: &mut Findings) {
    let is_still = |recording: &ForceRecording, axis: usize| glitches::is_still(&recording.under_load(axis));
    for (axis, name) in AXES.into_iter().enumerate() {
        let is_moving = recordings.iter().any(|recording| !is_still(recording, axis));
        let is_set = |own: &ForceRecording| own.under_load(axis).first().is_some_and(|force| force.abs() > 0.0);
        for recording in recordings.iter().filter(|recording| is_still(recording, axis)) {
            let Some(load_n) = recording.load().filter(|load| *load > STEP_N) else { continue };
            if is_moving || is_set(recording) {
                let message = format!(
                    "the force `{}` carries a load of {load_n:.0} N, but has one value along {name} under it: this \
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
/// Smallest load for this test, and for holes and values that never move [N].
const LOADED_N: f64 = 20.0;
/// Shortest time without rows that is reported [s].
const SHORTEST_HOLE_S: f64 = 0.05;
/// Rows without a force count as unloaded if the loads before and after them are below this share of the largest one.
const EMPTY_SHARE: f64 = 0.1;
/// A force below this is no load [N]; a table with more than one such row in so many rows without a force writes it.
const UNLOADED_N: f64 = 1.0;
const UNLOADED_ROWS: usize = 10;
/// A load is solid above this share of its largest value.
const SOLID_SHARE: f64 = 0.2;
/// A point of a light load lies at most this far beyond those of the solid loads of the same contact [m]: about the
/// length of a foot.
const FARTHEST_LIGHT_POINT_M: f64 = 0.3;
/// Error of a moment that needs no mending [N.m].
const HARMLESS_NM: f64 = 5.0;

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
        recordings.push(recording);
    }
    for recording in &mut recordings {
        recording.unload_empty_rows(findings);
        report_millimetres(recording, findings);
    }
    report_still(&recordings, findings);
    for recording in &mut recordings {
        recording.mend(findings);
        recording.hold_light_points(findings);
    }
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
    let usual = recording.usual_distance_m();
    if usual > FARTHEST_PLAUSIBLE_POINT_M {
        let message = format!(
            "the load `{}` acts about {usual:.0} m from the origin; its points look like millimetres. hint: divide the \
             points by 1000, and the moments too if they are N.mm",
            recording.name
        );
        findings.report(Code::LoadsMillimetres, message);
    }
}
