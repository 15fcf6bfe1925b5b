//! Which joint is which, by its name: crates/ambulo/data/bvh_names.toml.

use super::error::SkeletonError;
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::toml_reader::{Source, Table, TomlError};
use ambulo_formats::bvh::Joint;

const NAMES: &str = include_str!("../../../data/bvh_names.toml");

/// A joint of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Landmark {
    Hip,
    Knee,
    Ankle,
    Toe,
    Shoulder,
    Elbow,
    Wrist,
}

impl Landmark {
    pub(super) const ALL: [Landmark; 7] = [
        Landmark::Hip,
        Landmark::Knee,
        Landmark::Ankle,
        Landmark::Toe,
        Landmark::Shoulder,
        Landmark::Elbow,
        Landmark::Wrist,
    ];

    /// As the table of names calls it, and markers without their side.
    pub(super) fn name(self) -> &'static str {
        match self {
            Landmark::Hip => "hip",
            Landmark::Knee => "knee",
            Landmark::Ankle => "ankle",
            Landmark::Toe => "toe",
            Landmark::Shoulder => "shoulder",
            Landmark::Elbow => "elbow",
            Landmark::Wrist => "wrist",
        }
    }

    fn is_needed(self) -> bool {
        matches!(self, Landmark::Hip | Landmark::Knee | Landmark::Ankle)
    }
}

/// The joints that were recognised, by their place among the file's.
#[derive(Debug)]
pub(super) struct Landmarks {
    found: Vec<(Landmark, Side, usize)>,
}

impl Landmarks {
    pub(super) fn get(&self, landmark: Landmark, side: Side) -> Option<usize> {
        self.found.iter().find(|(l, s, _)| (*l, *s) == (landmark, side)).map(|(.., joint)| *joint)
    }

    pub(super) fn find(joints: &[Joint], findings: &mut Findings) -> Result<Landmarks, SkeletonError> {
        let aliases = built_in_aliases()?;
        let names = sided_names(joints);
        let mut landmarks = Landmarks { found: Vec::new() };
        let mut missing = Vec::new();
        for landmark in Landmark::ALL {
            let known = aliases.iter().filter(|(name, _)| name == landmark.name()).flat_map(|(_, aliases)| aliases);
            for side in Side::BOTH {
                let is_free = |joint: &usize| landmarks.found.iter().all(|(.., taken)| taken != joint);
                let joint = known.clone().find_map(|alias| {
                    let is = |(s, stem): &(Side, String)| *s == side && stem == alias;
                    (0..names.len()).find(|joint| names[*joint].iter().any(is) && is_free(joint))
                });
                match joint {
                    Some(joint) => landmarks.found.push((landmark, side, joint)),
                    None => missing.push((landmark, side)),
                }
            }
        }
        landmarks.report(&missing, joints, findings)?;
        Ok(landmarks)
    }

    fn report(
        &self,
        missing: &[(Landmark, Side)],
        joints: &[Joint],
        findings: &mut Findings,
    ) -> Result<(), SkeletonError> {
        let listed = |wanted: bool| {
            let of_kind = missing.iter().filter(|(landmark, _)| landmark.is_needed() == wanted);
            of_kind.map(|(landmark, side)| format!("{side} {}", landmark.name())).collect::<Vec<_>>().join(", ")
        };
        let (needed, useful) = (listed(true), listed(false));
        if !needed.is_empty() {
            return Err(SkeletonError::Names { missing: needed, found: shown(joints) });
        }
        if !useful.is_empty() {
            findings.report(
                Code::BvhJointsMissing,
                format!("no joint was recognised as {useful}; found: {}", shown(joints)),
            );
        }
        Ok(())
    }
}

/// The names of a file, for a message.
fn shown(joints: &[Joint]) -> String {
    const MOST: usize = 60;
    let mut names: Vec<&str> = joints.iter().take(MOST).map(|joint| joint.name.as_str()).collect();
    if joints.len() > MOST {
        names.push("...");
    }
    names.join(", ")
}

/// Name of each landmark with its aliases, best first.
fn built_in_aliases() -> Result<Vec<(String, Vec<String>)>, TomlError> {
    let source = Source::new(NAMES, "crates/ambulo/data/bvh_names.toml");
    let parsed = source.parse()?;
    let root = Table::root(&source, &parsed);
    let landmark = |table: &Table<'_>| {
        let name = table.need("name", "the joint of the body")?.filled_text()?;
        let aliases = table.need("aliases", "names of that joint")?.list("a list of names")?;
        Ok((name, aliases.iter().map(|alias| alias.filled_text()).collect::<Result<_, TomlError>>()?))
    };
    root.tables("landmark")?.iter().map(landmark).collect()
}

/// For each joint, the sides and names without side that its name may mean.
fn sided_names(joints: &[Joint]) -> Vec<Vec<(Side, String)>> {
    let shared = shared_beginning(joints);
    joints.iter().map(|joint| sides_of(&plain(&joint.name[shared..]))).collect()
}

/// Length of what all names begin with and what ends with no letter, such as `Bip01 `; of one joint alone nothing.
fn shared_beginning(joints: &[Joint]) -> usize {
    let [first, others @ ..] = joints else { return 0 };
    if others.is_empty() {
        return 0;
    }
    let same = |name: &str| first.name.bytes().zip(name.bytes()).take_while(|(a, b)| a == b).count();
    let length = others.iter().map(|other| same(&other.name)).min().unwrap_or(0);
    let ends = first.name.char_indices().map(|(at, c)| (at + c.len_utf8(), c));
    ends.filter(|(end, c)| *end <= length && !c.is_alphabetic()).map(|(end, _)| end).next_back().unwrap_or(0)
}

/// Letters and digits in lower case, behind the last colon.
fn plain(name: &str) -> String {
    let last = name.rsplit(':').next().unwrap_or(name);
    last.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

fn sides_of(plain: &str) -> Vec<(Side, String)> {
    let words = [("left", Side::Left), ("right", Side::Right), ("l", Side::Left), ("r", Side::Right)];
    let taken_off = |(word, side): (&str, Side)| {
        let stems = [plain.strip_prefix(word), plain.strip_suffix(word)];
        stems.into_iter().flatten().map(move |stem| (side, stem.to_owned())).collect::<Vec<_>>()
    };
    words.into_iter().flat_map(taken_off).collect()
}
