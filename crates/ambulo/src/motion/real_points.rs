//! Selects the points of a C3D file that are recorded markers.

use ambulo_formats::c3d::{C3d, Point};

/// Parameters of POINT that list points which are not positions (Vicon's type groups), or are computed.
const TYPE_GROUPS: [&str; 7] = ["ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS", "MODELED_MARKERS", "REACTIONS"];

/// Segments whose axes are written by Plug-in Gait and the Oxford foot model as four points: origin O, anterior A, lateral L,
/// proximal P, as in `LFEO`, `LFEA`, `LFEL`, `LFEP`.
const AXES: [&str; 11] = ["PEL", "HED", "TRX", "FE", "TI", "FO", "TO", "CL", "HU", "RA", "HN"];

/// The points that are markers: with a name, not in a type group, not a computed axis.
pub(super) fn real_points(file: &C3d) -> Vec<&Point> {
    let listed: Vec<&str> = TYPE_GROUPS.iter().flat_map(|group| file.parameters.texts("POINT", group)).collect();
    let names: Vec<&str> = file.points.iter().map(|p| p.name.as_str()).collect();
    let is_real = |point: &&Point| {
        let name = point.name.trim();
        let plain = name.rsplit(':').next().unwrap_or(name);
        let is_listed = listed.iter().any(|l| *l == name || *l == plain);
        !plain.is_empty() && !plain.starts_with('*') && !is_listed && !is_axis(name, &names)
    };
    file.points.iter().filter(is_real).collect()
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
