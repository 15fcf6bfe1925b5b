//! Finds the markers on heels, toes, ankles and pelvis by the names that laboratories use.
//!
//! Names are compared without case, points and underscores, with the side at the beginning (`R.Heel`, `RHEE`,
//! `right_heel`) or at the end (`heel_r`). Of several names for one landmark the first in its list is used.
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
use crate::model::marker_set::{Landmark, MarkerSet, RecognisedMarkers};

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
/// Landmarks in front of a foot, the best first.
const FRONTS: [Landmark; 5] =
    [Landmark::Hallux, Landmark::SecondToe, Landmark::FirstMetatarsal, Landmark::FifthMetatarsal, Landmark::SmallToe];
/// Landmarks of the head.
const HEADS: [Landmark; 5] = [Landmark::FrontHead, Landmark::BackHead, Landmark::Ear, Landmark::Nose, Landmark::Vertex];
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
        Landmarks::named(recording, None)
    }

    /// Finds the landmarks by a marker set, and those that it does not have by the names that laboratories use. Without
    /// a set, landmarks with other names are found by the built-in sets.
    #[must_use]
    pub fn named(recording: &MarkerRecording, set: Option<&MarkerSet>) -> Landmarks {
        let names = || recording.markers.iter().map(|m| m.name.as_str());
        let usual = Landmarks::usual(recording);
        let recognised = match set {
            None if usual.is_complete() => None,
            own => RecognisedMarkers::with(own, names()).ok(),
        };
        let Some(recognised) = recognised else { return usual };
        let found = Landmarks::recognised(&names().collect::<Vec<_>>(), &recognised);
        if set.is_some() { found.or(usual) } else { usual.or(found) }
    }

    /// Whether no landmark of feet and front of the pelvis is missing.
    fn is_complete(&self) -> bool {
        let is_foot = |foot: &FootMarkers| [foot.heel, foot.toe, foot.ankle].iter().all(Option::is_some);
        is_foot(&self.right) && is_foot(&self.left) && self.asis_r.is_some() && self.asis_l.is_some()
    }

    /// These landmarks; missing ones are taken from `other`.
    fn or(self, other: Landmarks) -> Landmarks {
        let foot = |own: FootMarkers, other: FootMarkers| FootMarkers {
            heel: own.heel.or(other.heel),
            toe: own.toe.or(other.toe),
            side: own.side.or(other.side),
            ankle: own.ankle.or(other.ankle),
        };
        let list = |own: Vec<usize>, other: Vec<usize>| if own.is_empty() { other } else { own };
        Landmarks {
            right: foot(self.right, other.right),
            left: foot(self.left, other.left),
            asis_r: self.asis_r.or(other.asis_r),
            asis_l: self.asis_l.or(other.asis_l),
            back_of_pelvis: list(self.back_of_pelvis, other.back_of_pelvis),
            head: list(self.head, other.head),
        }
    }

    /// The landmarks of recognised markers among these names.
    fn recognised(names: &[&str], recognised: &RecognisedMarkers) -> Landmarks {
        let on = |landmarks: &[Landmark], side: Option<Side>| {
            let name = landmarks.iter().find_map(|landmark| recognised.on(*landmark, side))?;
            names.iter().position(|known| *known == name)
        };
        let foot = |side: Side| FootMarkers {
            heel: on(&[Landmark::Heel], Some(side)),
            toe: on(&FRONTS, Some(side)),
            side: on(&[Landmark::FifthMetatarsal, Landmark::SmallToe, Landmark::FifthBase], Some(side)),
            ankle: on(&[Landmark::LateralMalleolus, Landmark::AnkleCentre, Landmark::MedialMalleolus], Some(side)),
        };
        let pelvis = |side: Side| on(&[Landmark::Asis, Landmark::HipCentre], Some(side));
        let psis = Side::BOTH.map(|side| on(&[Landmark::Psis], Some(side)));
        let back_of_pelvis = match psis {
            [Some(right), Some(left)] => vec![right, left],
            _ => on(&[Landmark::Sacrum, Landmark::MidHip], None).into_iter().collect(),
        };
        let sides = [None, Some(Side::Right), Some(Side::Left)];
        let head = HEADS.iter().flat_map(|landmark| sides.map(|side| on(&[*landmark], side))).flatten();
        Landmarks {
            right: foot(Side::Right),
            left: foot(Side::Left),
            asis_r: pelvis(Side::Right),
            asis_l: pelvis(Side::Left),
            back_of_pelvis,
            head: head.collect(),
        }
    }

    /// The landmarks by usual names.
    fn usual(recording: &MarkerRecording) -> Landmarks {
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

    /// A name without an ending that gives no information about the place.
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
