//! Selects the points of a C3D file that are recorded markers.

use ambulo_formats::c3d::{C3d, Parameters, Point};
use std::collections::BTreeSet;

/// Parameters of POINT that list points which are not positions (Vicon's type groups), or are computed.
const TYPE_GROUPS: [&str; 7] = ["ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS", "MODELED_MARKERS", "REACTIONS"];

/// Segments whose axes are written by Plug-in Gait and the Oxford foot model as four points: origin O, anterior A,
/// lateral L, proximal P, as in `LFEO`, `LFEA`, `LFEL`, `LFEP`.
const AXES: [&str; 11] = ["PEL", "HED", "TRX", "FE", "TI", "FO", "TO", "CL", "HU", "RA", "HN"];

/// The points that are markers.
pub(super) fn real_points(file: &C3d) -> Vec<&Point> {
    let names: Vec<&str> = file.points.iter().map(|point| point.name.as_str()).collect();
    let is_marker = are_markers(&names, &file.parameters);
    file.points.iter().zip(is_marker).filter(|(_, is_marker)| *is_marker).map(|(point, _)| point).collect()
}

/// Which points are markers, by all their names: those with a name, not in a type group, not a computed axis.
pub fn are_markers(names: &[&str], parameters: &Parameters) -> Vec<bool> {
    let listed: BTreeSet<&str> = TYPE_GROUPS.iter().flat_map(|group| parameters.texts("POINT", group)).collect();
    let is_marker = |name: &&str| {
        let name = name.trim();
        let plain = name.rsplit(':').next().unwrap_or(name);
        let is_listed = listed.contains(name) || listed.contains(plain);
        !plain.is_empty() && !plain.starts_with('*') && !is_listed && !is_axis(name, names)
    };
    names.iter().map(is_marker).collect()
}

/// Whether a name is one of the four points of the axes of a segment.
fn is_axis(name: &str, all: &[&str]) -> bool {
    const ENDS: [char; 4] = ['O', 'A', 'L', 'P'];
    let Some(axes) = name.strip_suffix(ENDS) else { return false };
    let stem = axes.rsplit(':').next().unwrap_or(axes);
    let is_segment = AXES.iter().any(|s| stem == *s || stem.strip_prefix(['L', 'R']) == Some(s));
    let has = |end: char| all.iter().any(|other| other.trim().strip_suffix(end) == Some(axes));
    is_segment && ENDS.into_iter().all(has)
}

/// Length of the prefix up to a colon that all names share; zero if there is none.
pub(super) fn shared_prefix(names: &[&str]) -> usize {
    let Some(end) = names.first().and_then(|n| n.find(':')).map(|i| i + 1) else { return 0 };
    let prefix = &names[0][..end];
    if names.iter().all(|n| n.len() > end && n.starts_with(prefix)) { end } else { 0 }
}
