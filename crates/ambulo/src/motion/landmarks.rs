//! Finds the markers on heels, toes, ankles and pelvis by the names that laboratories use.
//!
//! Names are compared without case, points and underscores, with the side at the beginning (`R.Heel`, `RHEE`, `right_heel`) or
//! at the end (`heel_r`). Of several names for one landmark the first in its list is used.
//!
//! | set | heel | toe | ankle | pelvis |
//! |---|---|---|---|---|
//! | Plug-in Gait, Oxford foot | HEE | TOE, HLX | ANK | ASI, PSI, SACR |
//! | OpenSim Gait2392 | Heel | Toe.Tip | Ankle.Lat | ASIS, V.Sacral |
//! | OpenSim Rajagopal | Heel, CAL | Toe, TOE | Ankle, LMAL | ASIS, PSIS |
//! | OpenCap, HRNet | Heel, calc_study | BigToe, toe_study | Ankle, ankle_study | ASIS_study, Hip |
//! | CAST (Cappozzo 1995, unverified) | FCC, CA | SM, FM, IIT, IMH | LM | ASIS, PSIS |

use super::marker_recording::MarkerRecording;
use crate::model::Side;

const HEEL: [&str; 8] = ["heel", "hee", "cal", "calc", "calcaneus", "fcc", "ca", "heelback"];
const TOE: [&str; 16] = [
    "toetip", "toe", "hlx", "bigtoe", "hallux", "mt2", "mth2", "sm", "fm2", "toemed", "mt1", "fm", "fm1", "toelat",
    "iit", "imh",
];
const SIDE_OF_FOOT: [&str; 11] =
    ["mt5", "mth5", "d5m", "vm", "fm5", "smalltoe", "5meta", "midfootlat", "toelat", "p5m", "vmh"];
const ANKLE: [&str; 10] = ["ank", "ankle", "anklelat", "lmal", "lma", "lm", "fal", "malleolus", "midfootsup", "ajc"];
const ASIS: [&str; 5] = ["asi", "asis", "ias", "hip", "hjc"];
const PSIS: [&str; 4] = ["psi", "psis", "ips", "sacr"];
const SACRUM: [&str; 10] = ["sacr", "sacrum", "sac", "vsac", "vsacral", "s1", "s2", "midpsis", "midhip", "mpsis"];
const HEAD: [&str; 9] = ["fhd", "bhd", "temple", "tophead", "head", "vertex", "ear", "nose", "glab"];

/// The markers of one foot, as indices into [`MarkerRecording::markers`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FootMarkers {
    /// Back of the heel.
    pub heel: Option<usize>,
    /// Tip of the foot, or a medial metatarsal head.
    pub toe: Option<usize>,
    /// Lateral side of the forefoot.
    pub side: Option<usize>,
    /// Ankle.
    pub ankle: Option<usize>,
}

impl FootMarkers {
    /// All markers of the foot.
    pub fn all(&self) -> impl Iterator<Item = usize> + use<> {
        [self.heel, self.toe, self.side, self.ankle].into_iter().flatten()
    }
}

/// Markers that show the position and the facing direction of the body, as indices into [`MarkerRecording::markers`].
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Landmarks {
    /// Right foot.
    pub right: FootMarkers,
    /// Left foot.
    pub left: FootMarkers,
    /// Right anterior superior iliac spine.
    pub asis_r: Option<usize>,
    /// Left anterior superior iliac spine.
    pub asis_l: Option<usize>,
    /// Back of the pelvis: both posterior spines, or the sacrum.
    pub back_of_pelvis: Vec<usize>,
    /// Head.
    pub head: Vec<usize>,
}

impl Landmarks {
    /// Finds the landmarks of a recording by the names of its markers.
    #[must_use]
    pub fn find(recording: &MarkerRecording) -> Landmarks {
        let names: Vec<PlainName> = recording.markers.iter().map(|m| PlainName::of(&m.name)).collect();
        let foot = |side: Side| FootMarkers {
            heel: with_side(&names, side, &HEEL),
            toe: with_side(&names, side, &TOE),
            side: with_side(&names, side, &SIDE_OF_FOOT),
            ankle: with_side(&names, side, &ANKLE),
        };
        let psis = [with_side(&names, Side::Right, &PSIS), with_side(&names, Side::Left, &PSIS)];
        let back_of_pelvis = match psis {
            [Some(right), Some(left)] => vec![right, left],
            _ => SACRUM.iter().find_map(|stem| names.iter().position(|n| n.plain == *stem)).into_iter().collect(),
        };
        let is_head =
            |n: &PlainName| HEAD.iter().any(|stem| n.plain == *stem || n.without_side().any(|(_, rest)| rest == *stem));
        Landmarks {
            right: foot(Side::Right),
            left: foot(Side::Left),
            asis_r: with_side(&names, Side::Right, &ASIS),
            asis_l: with_side(&names, Side::Left, &ASIS),
            back_of_pelvis,
            head: (0..names.len()).filter(|&i| is_head(&names[i])).collect(),
        }
    }

    /// The markers of one foot.
    #[must_use]
    pub fn foot(&self, side: Side) -> &FootMarkers {
        match side {
            Side::Right => &self.right,
            Side::Left => &self.left,
        }
    }

    /// All markers of the pelvis.
    #[must_use]
    pub fn pelvis(&self) -> Vec<usize> {
        [self.asis_r, self.asis_l].into_iter().flatten().chain(self.back_of_pelvis.iter().copied()).collect()
    }
}

/// A name in lower case, letters and digits only.
pub(super) struct PlainName {
    pub(super) plain: String,
}

impl PlainName {
    fn of(name: &str) -> PlainName {
        PlainName::without_ending(name, "study")
    }

    /// A name without an ending that says nothing about the place.
    pub(super) fn without_ending(name: &str, ending: &str) -> PlainName {
        let plain: String = name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect();
        let plain = plain.strip_suffix(ending).unwrap_or(&plain).to_owned();
        PlainName { plain }
    }

    /// Every possible side in the name, with the rest of the name.
    pub(super) fn without_side(&self) -> impl Iterator<Item = (Side, &str)> {
        let words = [("right", Side::Right), ("left", Side::Left), ("r", Side::Right), ("l", Side::Left)];
        let front = words.into_iter().filter_map(|(word, side)| Some((side, self.plain.strip_prefix(word)?)));
        let back = words.into_iter().filter_map(|(word, side)| Some((side, self.plain.strip_suffix(word)?)));
        front.chain(back)
    }
}

fn with_side(names: &[PlainName], side: Side, stems: &[&str]) -> Option<usize> {
    let is = |name: &PlainName, stem: &str| name.without_side().any(|(found, rest)| found == side && rest == stem);
    stems.iter().find_map(|stem| names.iter().position(|name| is(name, stem)))
}
