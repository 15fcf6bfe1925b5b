//! Reads a skeleton in motion (`.bvh`), or a motion of the SMPL family (`.npz`), for the built-in body. Neither has
//! forces or a mass.

use super::error::{At, Field, JobError};
use super::files::{ending, note_remarks, read as read_file};
use super::{Job, Reading};
use crate::model::anthropometry::Build;
use crate::motion::skeleton::{SkeletonRecording, skeleton_from_bvh};
use crate::motion::{SmplBody, SmplError, SmplMotion};
use crate::study::{Recording, Source};
use ambulo_formats::bvh::Bvh;
use ambulo_formats::npz::Npz;

pub(super) fn read(job: &Job, reading: &mut Reading<'_>) -> Result<Source, JobError> {
    let shown = job.shown();
    let mass_kg = mass(job, "a BVH")?;
    let (bvh, remarks) = Bvh::read(&read_file(reading.files, job.recording())?).at(shown.clone())?;
    note_remarks(&shown, &remarks, reading.findings);
    (reading.progress)("read_skeleton");
    let skeleton = skeleton_from_bvh(&bvh, &shown, job.size.height_m, reading.findings).at(shown)?;
    Ok(source(job, skeleton, mass_kg))
}

/// Reads a motion of the SMPL family.
pub(super) fn read_smpl(job: &Job, reading: &mut Reading<'_>) -> Result<Source, JobError> {
    let shown = job.shown();
    let mass_kg = mass(job, "a motion of the SMPL family")?;
    let bytes = read_file(reading.files, job.recording())?;
    SmplMotion::check_shapes(&Npz::shapes(&bytes).at(shown.clone())?).at(shown.clone())?;
    let npz = Npz::read_named(&bytes, SmplMotion::is_array).at(shown.clone())?;
    drop(bytes);
    let motion = SmplMotion::from_npz(&npz).at(shown.clone())?;
    drop(npz);
    (reading.progress)("read_skeleton");
    let body = smpl_body(job, &motion, mass_kg, reading)?;
    let skeleton = motion.skeleton(&body, &shown, job.size.height_m, reading.findings).at(shown)?;
    Ok(source(job, skeleton, mass_kg))
}

/// The segment lengths: from the user's model, or from the built-in body of the stated stature.
fn smpl_body(job: &Job, motion: &SmplMotion, mass_kg: f64, reading: &mut Reading<'_>) -> Result<SmplBody, JobError> {
    let build = |height: f64| Build { table: job.segments, mass: mass_kg, height, toe_joint: true };
    let Some(path) = &job.smpl else {
        let height = job.size.height_m.ok_or(SmplError::NoLengths);
        return height.and_then(|height| SmplBody::of_stature(&build(height))).in_file(job.recording());
    };
    reading.read.push(path.clone());
    let npz = Npz::read_named(&read_file(reading.files, path)?, SmplBody::is_array).in_file(path)?;
    // Of the table only the shape of the foot is used, which does not depend on the stature.
    let sizes = build(job.size.height_m.unwrap_or(ANY_STATURE_M)).human().in_file(path)?.dimensions;
    SmplBody::of_model(&npz, &motion.betas, &sizes).in_file(path)
}

/// A stature for proportions [m].
const ANY_STATURE_M: f64 = 1.7;

/// The body mass, which the file does not contain.
fn mass(job: &Job, what: &str) -> Result<f64, JobError> {
    reject_unused_fields(job)?;
    job.size.mass_kg.ok_or_else(|| {
        JobError::new(&[Field::Mass], format!("{what} contains no body mass; expected one in kg")).within(job.shown())
    })
}

fn source(job: &Job, skeleton: SkeletonRecording, mass_kg: f64) -> Source {
    let source = Source::new(Recording::Skeleton { skeleton, table: job.segments, mass_kg });
    Source { added_mass: job.added_mass.clone(), ..source }
}

fn reject_unused_fields(job: &Job) -> Result<(), JobError> {
    let given = [
        (Field::Model, job.model_file().is_some()),
        (Field::ForceTable, job.forces.table.is_some()),
        (Field::Loads, job.forces.loads.is_some()),
        (Field::Standing, job.standing.is_some()),
        (Field::Markers, job.markers.is_some()),
        (Field::MarkerSet, job.marker_set.is_some()),
        (Field::Plates, !job.plates.is_empty()),
    ];
    let Some((field, _)) = given.into_iter().chain(job.of_joints()).find(|(_, given)| *given) else { return Ok(()) };
    let what = format!(
        "the {} has no effect for a .{}, which is fitted with the built-in body and has no measured forces; expected \
         body mass and height",
        field.name(),
        ending(job.recording())
    );
    Err(JobError::new(&[field, Field::Mass, Field::Height], what).within(job.shown()))
}
