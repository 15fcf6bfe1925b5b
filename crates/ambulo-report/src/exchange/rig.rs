//! Writes the motion of a result folder into the skeleton of the animation file that it was computed from.

use super::folder::{ExchangeError, nothing};
use crate::stage::{FolderMotion, folder_motion};
use ambulo::findings::{Code, Findings};
use ambulo::kinematics::rig::{on_rig, segments};
use ambulo::model::Side;
use ambulo::model::marker_set::Segment;
use ambulo::motion::skeleton::{Rig, RigDifferences, RigLimits};
use ambulo_formats::bvh::Bvh;
use ambulo_results::{Folder, RunSummary};

/// The skeleton of an animation file with the motion of the result that was computed from it; `name` is its file name.
///
/// # Errors
/// A folder without a moving body, or the result of another file; an animation file without the skeleton of a person.
pub fn rig_of_folder(
    folder: &Folder<'_>,
    bvh: &Bvh,
    name: &str,
    findings: &mut Findings,
) -> Result<Vec<u8>, ExchangeError> {
    let RunSummary::Motion(summary) = folder.summary()? else {
        return Err(nothing(folder, "a scene has no skeleton; expected the result of an animation file".to_owned()));
    };
    let FolderMotion { model, trajectory, .. } = folder_motion(folder)?.map_err(|reason| nothing(folder, reason))?;
    let rig = Rig::new(bvh, name, summary.height_m, &segments(&model))?;
    let made = on_rig(&model, &trajectory, rig)?;
    report_name(&summary.input.motion, name, findings);
    report_frames(bvh, &made.bvh, findings);
    report_differences(&made.differences, findings);
    report_limits(&made.limits, findings);
    Ok(made.bvh.write())
}

fn report_name(computed_from: &str, name: &str, findings: &mut Findings) {
    let own = computed_from.rsplit(['/', '\\']).next().unwrap_or_default();
    if own != name {
        let message = format!("the result was computed from `{own}` and written into the skeleton of `{name}`");
        findings.report(Code::ConvertOtherName, message);
    }
}

fn report_frames(bvh: &Bvh, made: &Bvh, findings: &mut Findings) {
    let (all, kept) = (bvh.frames(), made.frames());
    if kept < all {
        let message = format!("not carried over: {} of {all} frames, which the result does not have", all - kept);
        findings.report(Code::ConvertLost, message);
    }
}

fn report_differences(differences: &RigDifferences, findings: &mut Findings) {
    let RigDifferences { turned_rms_rad, most_turned, most_moved_m } = differences;
    let most = most_turned
        .as_ref()
        .map_or_else(String::new, |(joint, angle)| format!(" and at most {:.2} degrees ({joint})", angle.to_degrees()));
    let message = format!(
        "the joints that the body drives were turned by {:.2} degrees (RMS){most}, and mid-hip moved by at most {:.1} \
         mm; all other joints keep their own rotation",
        turned_rms_rad.to_degrees(),
        1e3 * most_moved_m
    );
    findings.report(Code::ConvertRig, message);
}

fn report_limits(limits: &RigLimits, findings: &mut Findings) {
    let RigLimits { without_joint, few_channels, stays } = limits;
    if !without_joint.is_empty() {
        let name = |(segment, side): &(Segment, Option<Side>)| {
            let side = side.map_or_else(String::new, |side| format!("{side} "));
            format!("{side}{}", segment.word())
        };
        let names = without_joint.iter().map(name).collect::<Vec<_>>().join(", ");
        findings.report(
            Code::ConvertRigLimits,
            format!("no joint of the file turns the {names} of the body; the change there is lost"),
        );
    }
    if !few_channels.is_empty() {
        let message = format!(
            "{} have fewer than three rotation channels, so they have the nearest rotation that they can store",
            few_channels.join(", ")
        );
        findings.report(Code::ConvertRigLimits, message);
    }
    if *stays {
        let message = "no joint from the pelvis to the root has three position channels, so the place of the pelvis \
            was not changed";
        findings.report(Code::ConvertRigLimits, message);
    }
}
