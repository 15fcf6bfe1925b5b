//! Whose markers these are: the stage before any fit, which every recording of markers passes.
//!
//! | question | evidence | answer |
//! |---|---|---|
//! | several people in one file | two prefixes carry the same marker names | an error with the names ([`several`]) |
//! | left and right exchanged in all labels | pairs of markers against toes, heels and pelvis ([`sides`]) | exchanged back, a warning, quality not good |
//! | one pair exchanged throughout | the same, and the distances to the neighbours ([`pairs`]) | exchanged back, a warning |
//! | two markers of a limb exchanged in one recording | the limb in the other recording and on the other side, or the joints ([`along_limbs`]) | exchanged back there, a warning |
//! | a marker that the standing trial lacks | the motion has it ([`completion`], [`model_completion`]) | placed by the motion, a warning |
//! | another person's standing trial | lengths of the limbs ([`limbs`]) | a warning, quality not good |
//! | a marker that moved since the standing trial | its place on the body, by all other markers ([`moved`]) | a warning, quality not good |
//!
//! Pinned by: tests/identity.rs

mod along_limbs;
mod completion;
mod landmark_paths;
mod limbs;
mod model_completion;
mod moved;
mod pairs;
mod several;
mod sides;

pub(super) use along_limbs::{exchange_along_limbs, exchange_in_motion};
pub(super) use completion::completed;
pub(crate) use limbs::{
    Limb, OTHER as OTHER_LIMBS, OTHER_WITHOUT_TWO as OTHER_LIMBS_WITHOUT_TWO, difference as limb_difference, limbs,
};
pub(super) use model_completion::completed_for_model;
pub(super) use moved::moved;
pub(super) use several::refuse_several;
pub(crate) use several::{people_in, person_in};

use super::laboratory_recording::LaboratoryRecording;
use crate::findings::Findings;
use crate::model::marker_set::MarkerSet;
use crate::motion::MarkerRecording;
use landmark_paths::LandmarkPaths;
use std::borrow::Cow;

/// Evidence against the labels or the standing trial of a person, one sentence each.
pub(super) type Contradictions = Vec<String>;

/// Reports a standing trial of another person, and markers that moved between standing trial and motion.
///
/// One or two moved markers change the lengths of limbs too. Where some moved, the limbs that they may have changed are
/// left out.
pub(super) fn report_standing_trial(
    [moving, standing]: [&MarkerRecording; 2],
    moved: &[String],
    set: Option<&MarkerSet>,
    contradictions: &mut Contradictions,
    findings: &mut Findings,
) {
    let are_few = (1..moved::ANOTHER_PERSON).contains(&moved.len());
    let (left_out, limit) = if are_few { (2, OTHER_LIMBS_WITHOUT_TWO) } else { (0, OTHER_LIMBS) };
    let difference = limb_difference(&limbs(moving, set), &limbs(standing, set), left_out);
    if difference.is_some_and(|difference| difference > limit) {
        limbs::report_other_limbs(moving, standing, set, contradictions, findings);
    } else if !moved.is_empty() {
        moved::report_moved(moved, contradictions, findings);
    }
}

/// The recording with the labels of one person: left and right as the body shows them. `which` names it in messages.
pub(super) fn with_right_labels<'a>(
    recording: &'a LaboratoryRecording,
    which: &str,
    set: Option<&MarkerSet>,
    contradictions: &mut Contradictions,
    findings: &mut Findings,
) -> Cow<'a, LaboratoryRecording> {
    if recording.poses.is_some() {
        return Cow::Borrowed(recording);
    }
    let Some(paths) = LandmarkPaths::of(&recording.markers, set) else { return Cow::Borrowed(recording) };
    let mirrored = sides::exchanged_back(&paths, which, contradictions, findings);
    let unmirrored = mirrored.as_ref().unwrap_or(&recording.markers);
    let of_pairs = pairs::exchanged_back(&paths.with(unmirrored), which, findings);
    match of_pairs.or(mirrored) {
        Some(markers) => Cow::Owned(LaboratoryRecording { markers, ..recording.clone() }),
        None => Cow::Borrowed(recording),
    }
}
