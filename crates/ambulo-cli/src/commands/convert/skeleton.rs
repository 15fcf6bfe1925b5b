//! Conversion of skeletons: from BVH, and from a model's coordinates to BVH or glTF.

use super::{Converted, report_lost};
use crate::args::ConvertArgs;
use crate::files;
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::Trajectory;
use ambulo::model::from_osim;
use ambulo::motion::skeleton::{joint_paths, skeleton_from_bvh};
use ambulo::motion::{MarkerRecording, SmoothSettings, Smoother, Window, coordinates_from_table, smooth};
use ambulo_formats::bvh::Bvh;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use ambulo_report::{glb_of_motion, skeleton_of, trc_of_markers};
use anyhow::{Context, Result};

pub(super) fn convert(args: &ConvertArgs, bytes: &[u8], to: &str) -> Result<Converted> {
    let shown = args.input.display().to_string();
    let (bvh, remarks) = Bvh::read(bytes).with_context(|| shown.clone())?;
    let mut findings = Findings::default();
    files::note_remarks(&shown, &remarks, &mut findings);
    let bytes = match to {
        "csv" => {
            report_lost(&mut findings, &["offsets of the joints".to_owned(), "end sites".to_owned()]);
            channel_table(&bvh).with_context(|| shown.clone())?.write_csv()
        }
        _ => {
            report_lost(&mut findings, &["rotations of the joints".to_owned(), "hierarchy of the joints".to_owned()]);
            let markers = joint_markers(args, &bvh, &mut findings).with_context(|| shown.clone())?;
            trc_of_markers(&markers).with_context(|| shown.clone())?.write()
        }
    };
    Ok(Converted { files: vec![(args.output.clone(), bytes)], findings })
}

/// The centres of all joints in metres; the unit of length is inferred from the length of the legs.
fn joint_markers(args: &ConvertArgs, bvh: &Bvh, findings: &mut Findings) -> Result<MarkerRecording> {
    const CENTIMETRE: f64 = 0.01;
    let name = args.input.file_name().unwrap_or_default().to_string_lossy();
    match skeleton_from_bvh(bvh, &name, None, &mut Findings::default()) {
        Ok(skeleton) => {
            findings.report(Code::BvhAxes, skeleton.statement.clone());
            let paths = joint_paths(bvh, &name, skeleton.metres_per_unit)?;
            Ok(if args.world { paths.rotated(&skeleton.world_from_file) } else { paths })
        }
        Err(error) if args.world => Err(error).context("--world needs a person's skeleton"),
        Err(error) => {
            findings.report(
                Code::BvhUnit,
                format!("lengths were read as centimetres, because this is not the skeleton of a person: {error}"),
            );
            Ok(joint_paths(bvh, &name, CENTIMETRE)?)
        }
    }
}

/// `time` and `<joint>.<channel>`, with the numbers of the file.
fn channel_table(bvh: &Bvh) -> Result<Table> {
    let times = (0..bvh.frames()).map(|frame| frame as f64 * bvh.frame_time_s()).collect();
    let mut columns = vec![("time".to_owned(), times)];
    for (joint, range) in bvh.joints().iter().zip(bvh.channel_ranges()) {
        for (channel, column) in joint.channels.iter().zip(range) {
            let values = (0..bvh.frames()).filter_map(|frame| bvh.frame(frame)?.get(column).copied());
            columns.push((format!("{}.{}", joint.name, channel.word()), values.collect()));
        }
    }
    Ok(Table::new("channels", columns)?)
}

/// Converts a model's coordinates to a skeleton or an animation.
pub(super) fn make(args: &ConvertArgs, bytes: &[u8], to: &str) -> Result<Converted> {
    let shown = args.input.display().to_string();
    let mut findings = Findings::default();
    let model_path = args.model.clone().unwrap_or_default();
    let document = OsimModel::read(&files::read(&model_path)?).with_context(|| model_path.display().to_string())?;
    let model = from_osim(&document, &mut findings).with_context(|| model_path.display().to_string())?;
    let (table, remarks) = Table::read_storage(bytes).with_context(|| shown.clone())?;
    files::note_remarks(&shown, &remarks, &mut findings);
    let motion = coordinates_from_table(&model, &table, &shown, &mut findings).with_context(|| shown.clone())?;
    let window = Window { from_s: None, to_s: None };
    let settings = SmoothSettings { smoother: Smoother::Off, window, rate_hz: None };
    let smoothed = smooth(&model, &motion, settings, &mut findings).with_context(|| shown.clone())?;
    let trajectory = Trajectory::complete(&model, smoothed, &mut findings).with_context(|| shown.clone())?;
    if to == "glb" {
        report_lost(&mut findings, &["masses and inertias".to_owned()]);
        findings.report(Code::ConvertAxes, "lengths are in metres; x forward, y up, z right");
        let bytes = glb_of_motion(&model, &trajectory).with_context(|| shown.clone())?;
        return Ok(Converted { files: vec![(args.output.clone(), bytes)], findings });
    }
    let bvh = skeleton_of(&model, &trajectory).with_context(|| shown.clone())?;
    let masses =
        ["masses and inertias".to_owned(), "ranges of the joints".to_owned(), "the time of the first frame".to_owned()];
    report_lost(&mut findings, &masses);
    findings.report(Code::ConvertAxes, "lengths are in centimetres; x forward, y up, z right");
    Ok(Converted { files: vec![(args.output.clone(), bvh.write())], findings })
}
