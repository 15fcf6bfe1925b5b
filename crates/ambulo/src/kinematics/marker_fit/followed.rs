//! The markers as the body followed them: whoever looks for footsteps or plates under the feet loses no foot with its toe marker.

use super::frames::Frames;
use super::gaps::State;
use super::problem::Problem;
use crate::motion::MarkerRecording;
use crate::spatial::Vec3;

/// The recording with exchanged labels put back, without what was not believed, and with missing markers where the fitted body has
/// them at their offsets. Where too little is known of the posture they stay missing. Markers that the body does not have stay.
pub(super) fn followed(
    recording: &MarkerRecording,
    problem: &mut Problem<'_>,
    frames: &Frames,
    states: &[State],
) -> MarkerRecording {
    let mut out = recording.clone();
    let numbers: Vec<Option<usize>> =
        problem.paths.iter().map(|path| recording.markers.iter().position(|m| m.name == path.name)).collect();
    let unknowns = problem.tree.unknowns();
    for frame in 0..frames.count() {
        let own = &states[frame * unknowns..(frame + 1) * unknowns];
        let is_posed = frames.outcomes[frame].is_some() && !own.contains(&State::Gap);
        let lacks = |i: usize| !frames.is_used(frame, i);
        if is_posed && (0..frames.markers()).any(lacks) {
            frames.load(frame, problem);
            problem.pose_at(frames.posture(frame));
        }
        for (i, number) in numbers.iter().enumerate() {
            let Some(number) = *number else { continue };
            out.markers[number].positions[frame] = match frames.targets(frame)[i] {
                _ if !lacks(i) => problem.paths[frames.path(frame, i)].positions[frame],
                offset if is_posed && offset.iter().all(|x| x.is_finite()) => problem.place(i, &offset),
                _ => Vec3::repeat(f64::NAN),
            };
        }
    }
    out
}
