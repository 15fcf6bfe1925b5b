//! Groups of muscles with a panel, and the names that their parts have in models and recordings.
//!
//! Names of models: Gait2392 (`vas_med_r`, `glut_max1_r`), Rajagopal 2016 (`vasmed_r`, `glmax1_r`), Gait10dof18musc
//! (`vasti_r`, `glut_max_r`). Names of electromyograms: the anatomical ones (`vastus_medialis_r`). Only letters count:
//! several lines of action of one muscle differ by a number.

use ambulo::model::Side;

/// Muscles that share a panel.
pub(super) struct MuscleGroup {
    /// Part of the panel's id.
    pub(super) id: &'static str,
    /// Heading.
    pub(super) title: &'static str,
    /// Its muscles.
    pub(super) parts: &'static [Part],
}

/// An anatomical muscle, or muscles that a model joins into one.
pub(super) struct Part {
    /// Anatomical name.
    pub(super) words: &'static str,
    /// Names in models, of letters only; the anatomical name is known without being listed.
    names: &'static [&'static str],
}

const fn part(words: &'static str, names: &'static [&'static str]) -> Part {
    Part { words, names }
}

/// The groups, from proximal to distal.
pub(super) const GROUPS: [MuscleGroup; 9] = [
    MuscleGroup {
        id: "hip_flexors",
        title: "Hip flexors",
        parts: &[part("iliacus", &[]), part("psoas", &["psoasmajor"]), part("iliopsoas", &[])],
    },
    MuscleGroup {
        id: "gluteus_maximus",
        title: "Gluteus maximus",
        parts: &[part("gluteus maximus", &["glutmax", "glmax"])],
    },
    MuscleGroup {
        id: "gluteus_medius",
        title: "Gluteus medius",
        parts: &[part("gluteus medius", &["glutmed", "glmed"])],
    },
    MuscleGroup {
        id: "hamstrings",
        title: "Hamstrings",
        parts: &[
            part("semitendinosus", &["semiten"]),
            part("semimembranosus", &["semimem"]),
            part("biceps femoris", &["bifemlh", "bflh", "bicepsfemorislonghead"]),
            part("hamstrings", &["medialhamstrings", "lateralhamstrings"]),
        ],
    },
    MuscleGroup {
        id: "rectus_femoris",
        title: "Rectus femoris",
        parts: &[part("rectus femoris", &["rectfem", "recfem"])],
    },
    MuscleGroup {
        id: "vasti",
        title: "Vasti",
        parts: &[
            part("vastus medialis", &["vasmed"]),
            part("vastus intermedius", &["vasint"]),
            part("vastus lateralis", &["vaslat"]),
            part("vasti", &[]),
        ],
    },
    MuscleGroup {
        id: "gastrocnemius",
        title: "Gastrocnemius",
        parts: &[
            part("gastrocnemius medialis", &["medgas", "gasmed", "medialgastrocnemius"]),
            part("gastrocnemius lateralis", &["latgas", "gaslat", "lateralgastrocnemius"]),
            part("gastrocnemius", &["gastroc"]),
        ],
    },
    MuscleGroup { id: "soleus", title: "Soleus", parts: &[part("soleus", &[])] },
    MuscleGroup {
        id: "tibialis_anterior",
        title: "Tibialis anterior",
        parts: &[part("tibialis anterior", &["tibant"])],
    },
];

/// The side and the part of a group that a muscle of a model or of a recording is; `None` for other muscles.
pub(super) fn known(group: &'static MuscleGroup, muscle: &str) -> Option<(Side, &'static Part)> {
    let (side, stem) = Side::split_name(muscle)?;
    let name = letters(&stem);
    let part = group.parts.iter().find(|part| letters(part.words) == name || part.names.contains(&name.as_str()))?;
    Some((side, part))
}

/// The small letters of a name.
fn letters(name: &str) -> String {
    name.chars().filter(char::is_ascii_alphabetic).map(|letter| letter.to_ascii_lowercase()).collect()
}
