//! Recognises the joints of a skeleton by their names: crates/ambulo-body/data/bvh_names.toml.

use super::error::SkeletonError;
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::toml_reader::{Source, Table, TomlError};
use ambulo_formats::bvh::Joint;

const NAMES: &str = include_str!("../../../data/bvh_names.toml");

/// A joint of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BodyJoint {
    Hip,
    Knee,
    Ankle,
    Toe,
    Shoulder,
    Elbow,
    Wrist,
}

impl BodyJoint {
    pub(super) const ALL: [BodyJoint; 7] = [
        BodyJoint::Hip,
        BodyJoint::Knee,
        BodyJoint::Ankle,
        BodyJoint::Toe,
        BodyJoint::Shoulder,
        BodyJoint::Elbow,
        BodyJoint::Wrist,
    ];

    /// Name in the table of names; also the marker name without its side.
    pub(super) fn name(self) -> &'static str {
        match self {
            BodyJoint::Hip => "hip",
            BodyJoint::Knee => "knee",
            BodyJoint::Ankle => "ankle",
            BodyJoint::Toe => "toe",
            BodyJoint::Shoulder => "shoulder",
            BodyJoint::Elbow => "elbow",
            BodyJoint::Wrist => "wrist",
        }
    }

    fn is_needed(self) -> bool {
        matches!(self, BodyJoint::Hip | BodyJoint::Knee | BodyJoint::Ankle)
    }
}

/// The recognised joints, by their index in the file.
#[derive(Debug)]
pub(super) struct BodyJoints {
    found: Vec<(BodyJoint, Side, usize)>,
}

impl BodyJoints {
    pub(super) fn get(&self, body_joint: BodyJoint, side: Side) -> Option<usize> {
        self.found.iter().find(|(l, s, _)| (*l, *s) == (body_joint, side)).map(|(.., joint)| *joint)
    }

    /// The hips, right and left, which every recognised skeleton has.
    pub(super) fn hips(&self) -> [usize; 2] {
        Side::BOTH.map(|side| self.get(BodyJoint::Hip, side).unwrap_or_default())
    }

    pub(super) fn find(joints: &[Joint], findings: &mut Findings) -> Result<BodyJoints, SkeletonError> {
        let aliases = built_in_aliases()?;
        let names = sided_names(joints);
        let mut body_joints = BodyJoints { found: Vec::new() };
        let mut missing = Vec::new();
        for body_joint in BodyJoint::ALL {
            let known = aliases.iter().filter(|(name, _)| name == body_joint.name()).flat_map(|(_, aliases)| aliases);
            for side in Side::BOTH {
                let is_free = |joint: &usize| body_joints.found.iter().all(|(.., taken)| taken != joint);
                let is_sure =
                    |alias: &&String| !(body_joint == BodyJoint::Hip && *alias == LEG) || has_shin(&names, side);
                let joint = known.clone().filter(is_sure).find_map(|alias| {
                    let is = |(s, stem): &(Side, String)| *s == side && stem == alias;
                    (0..names.len()).find(|joint| names[*joint].iter().any(is) && is_free(joint))
                });
                match joint {
                    Some(joint) => body_joints.found.push((body_joint, side, joint)),
                    None => missing.push((body_joint, side)),
                }
            }
        }
        body_joints.report(&missing, joints, findings)?;
        Ok(body_joints)
    }

    fn report(
        &self,
        missing: &[(BodyJoint, Side)],
        joints: &[Joint],
        findings: &mut Findings,
    ) -> Result<(), SkeletonError> {
        let listed = |wanted: bool| {
            let of_kind = missing.iter().filter(|(body_joint, _)| body_joint.is_needed() == wanted);
            of_kind.map(|(body_joint, side)| format!("{side} {}", body_joint.name())).collect::<Vec<_>>().join(", ")
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

/// The name of a thigh or of a shank.
const LEG: &str = "leg";
/// Names that only a shank has.
const SHINS: [&str; 5] = ["shin", "calf", "lowleg", "lowerleg", "tibia"];

/// Whether a joint of this side can only be a knee, so that its `leg` is the thigh.
fn has_shin(names: &[Vec<(Side, String)>], side: Side) -> bool {
    names.iter().flatten().any(|(own, stem)| *own == side && SHINS.contains(&stem.as_str()))
}

/// The joint names of a file for a message.
fn shown(joints: &[Joint]) -> String {
    const MOST: usize = 60;
    let mut names: Vec<&str> = joints.iter().take(MOST).map(|joint| joint.name.as_str()).collect();
    if joints.len() > MOST {
        names.push("...");
    }
    names.join(", ")
}

/// Name of each joint of the body with its aliases, best first.
fn built_in_aliases() -> Result<Vec<(String, Vec<String>)>, TomlError> {
    let source = Source::new(NAMES, "crates/ambulo-body/data/bvh_names.toml");
    let parsed = source.parse()?;
    let root = Table::root(&source, &parsed);
    let body_joint = |table: &Table<'_>| {
        let name = table.need("name", "the joint of the body")?.filled_text()?;
        let aliases = table.need("aliases", "names of that joint")?.list("a list of names")?;
        Ok((name, aliases.iter().map(|alias| alias.filled_text()).collect::<Result<_, TomlError>>()?))
    };
    root.tables("landmark")?.iter().map(body_joint).collect()
}

/// For each joint, the possible sides in its name, with the rest of the name.
fn sided_names(joints: &[Joint]) -> Vec<Vec<(Side, String)>> {
    let shared = shared_beginning(joints);
    joints.iter().map(|joint| sides_of(&plain(&joint.name[shared..]))).collect()
}

/// Length of the common prefix of all names that does not end with a letter, such as `Bip01 `; zero for a single joint.
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

/// Letters and digits after the last colon, in lower case, without what a rig puts around the name of a bone.
fn plain(name: &str) -> String {
    let last = name.rsplit(':').next().unwrap_or(name);
    let last = RIG_BEGINNINGS.iter().find_map(|beginning| last.strip_prefix(beginning)).unwrap_or(last);
    let last = last.replace("_fk", "");
    last.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Prefixes of bone names in rigs: Rigify's kinds of bones, and Mixamo's namespace without its colon.
const RIG_BEGINNINGS: [&str; 5] = ["DEF-", "ORG-", "MCH-", "mixamorig_", "mixamorig"];

fn sides_of(plain: &str) -> Vec<(Side, String)> {
    let words = [("left", Side::Left), ("right", Side::Right), ("l", Side::Left), ("r", Side::Right)];
    let taken_off = |(word, side): (&str, Side)| {
        let stems = [plain.strip_prefix(word), plain.strip_suffix(word)];
        stems.into_iter().flatten().map(move |stem| (side, stem.to_owned())).collect::<Vec<_>>()
    };
    words.into_iter().flat_map(taken_off).collect()
}
