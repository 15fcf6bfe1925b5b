//! Points of a recording that no camera saw: joint centres, ends of axes and the mass centre, which programs compute
//! from the markers and store beside them.
//!
//! Skin slides and cameras have noise, so that the distance between two markers varies by a tenth of a millimetre at
//! the least, even on a stiff plate after a low-pass of 6 Hz. Computed points often keep theirs: an axis has a constant
//! length, and a joint centre a constant distance from its marker. Others have names that say what they are.

use super::segment_motion::sample;
use crate::model::marker_set::NamedMarker;
use crate::motion::{MarkerPath, MarkerRecording};

/// Two points whose distance varies less than this are a marker and a computed point, or two of these: standard
/// deviation [m].
const CONSTANT_M: f64 = 2e-5;
/// Smallest number of frames in which a distance is seen.
const LEAST_FRAMES: usize = 10;
/// What the names of computed points contain, or how they end, in lower case.
const CONTAINED: [&str; 8] =
    ["centreofmass", "centerofmass", "ground", "floor", "virtual", "jointcent", "centerofgravity", "centreofgravity"];
const ENDINGS: [&str; 3] = ["jc", "joint", "com"];

/// Names of the points of a recording that are computed. Points with a known name are not: what they mean is known.
#[must_use]
pub fn computed_points<'r>(recording: &'r MarkerRecording, named: &[NamedMarker]) -> Vec<&'r str> {
    let sample = sample(recording, super::FRAMES);
    let is_named = |name: &str| named.iter().any(|known| known.name == name);
    let (known, unknown): (Vec<_>, Vec<_>) = sample.markers.iter().partition(|path| is_named(&path.name));
    // In a recording that was made by a program all markers keep their distances.
    let is_made = known.iter().enumerate().any(|(i, path)| known[i + 1..].iter().any(|other| is_constant(path, other)));
    let is_computed = |path: &MarkerPath| {
        let others = || sample.markers.iter().filter(|other| other.name != path.name);
        says_computed(&path.name) || !is_made && others().any(|other| is_constant(path, other))
    };
    let names: Vec<String> = unknown.into_iter().filter(|path| is_computed(path)).map(|p| p.name.clone()).collect();
    recording.markers.iter().map(|path| path.name.as_str()).filter(|name| names.iter().any(|own| own == name)).collect()
}

fn says_computed(name: &str) -> bool {
    let bare: String = name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
    CONTAINED.iter().any(|part| bare.contains(part)) || ENDINGS.iter().any(|end| bare.ends_with(end))
}

/// Whether two points keep their distance. Two distances of n that differ by d give a variance of d² / (2 n) at the
/// least, so that most pairs are known to move after a few frames.
fn is_constant(a: &MarkerPath, b: &MarkerPath) -> bool {
    let frames = a.positions.len();
    let most_m = CONSTANT_M * (2.0 * frames as f64).sqrt();
    let (mut distances, [mut least_m, mut largest_m]) = (Vec::new(), [f64::INFINITY, f64::NEG_INFINITY]);
    for frame in (0..frames).filter(|frame| a.is_seen(*frame) && b.is_seen(*frame)) {
        let distance_m = (a.positions[frame] - b.positions[frame]).norm();
        (least_m, largest_m) = (least_m.min(distance_m), largest_m.max(distance_m));
        if largest_m - least_m > most_m {
            return false;
        }
        distances.push(distance_m);
    }
    let count = distances.len() as f64;
    let mean = distances.iter().sum::<f64>() / count;
    let variance = distances.iter().map(|distance| (distance - mean).powi(2)).sum::<f64>() / count;
    distances.len() >= LEAST_FRAMES && variance.sqrt() < CONSTANT_M
}
