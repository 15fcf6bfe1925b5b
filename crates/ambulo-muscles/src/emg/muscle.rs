//! Names of muscles: which muscle a channel of an EMG recording, or a muscle of a model, is.
//!
//! A name is divided into words. Words for a side (`r`, `right`, `L`) give the side; words that say nothing
//! (`Voltage`, `EMG`, `activation`), units in brackets and digits are dropped; what remains must be the full name of
//! the muscle or a row of the table [`super::SPELLINGS`]. Other names are unknown: nothing is guessed.
//!
//! Pinned by: tests/emg_names.rs

use super::anatomical::AnatomicalMuscle;
use super::spellings::SPELLINGS;
use ambulo_body::model::Side;
use std::fmt;

use AnatomicalMuscle as M;

/// Full names.
const NAMES: [(M, &str); 45] = [
    (M::GluteusMaximus, "gluteus maximus"),
    (M::GluteusMedius, "gluteus medius"),
    (M::GluteusMinimus, "gluteus minimus"),
    (M::TensorFasciaeLatae, "tensor fasciae latae"),
    (M::Sartorius, "sartorius"),
    (M::Gracilis, "gracilis"),
    (M::AdductorLongus, "adductor longus"),
    (M::AdductorBrevis, "adductor brevis"),
    (M::AdductorMagnus, "adductor magnus"),
    (M::Pectineus, "pectineus"),
    (M::Iliacus, "iliacus"),
    (M::Psoas, "psoas"),
    (M::Iliopsoas, "iliopsoas"),
    (M::QuadratusFemoris, "quadratus femoris"),
    (M::Gemelli, "gemelli"),
    (M::Piriformis, "piriformis"),
    (M::RectusFemoris, "rectus femoris"),
    (M::VastusMedialis, "vastus medialis"),
    (M::VastusIntermedius, "vastus intermedius"),
    (M::VastusLateralis, "vastus lateralis"),
    (M::Vasti, "vasti"),
    (M::Semimembranosus, "semimembranosus"),
    (M::Semitendinosus, "semitendinosus"),
    (M::BicepsFemorisLongHead, "biceps femoris long head"),
    (M::BicepsFemorisShortHead, "biceps femoris short head"),
    (M::BicepsFemoris, "biceps femoris"),
    (M::Hamstrings, "hamstrings"),
    (M::GastrocnemiusMedialis, "gastrocnemius medialis"),
    (M::GastrocnemiusLateralis, "gastrocnemius lateralis"),
    (M::Gastrocnemius, "gastrocnemius"),
    (M::Soleus, "soleus"),
    (M::TibialisAnterior, "tibialis anterior"),
    (M::TibialisPosterior, "tibialis posterior"),
    (M::PeroneusLongus, "peroneus longus"),
    (M::PeroneusBrevis, "peroneus brevis"),
    (M::PeroneusTertius, "peroneus tertius"),
    (M::Peroneus, "peroneus"),
    (M::ExtensorDigitorumLongus, "extensor digitorum longus"),
    (M::ExtensorHallucisLongus, "extensor hallucis longus"),
    (M::FlexorDigitorumLongus, "flexor digitorum longus"),
    (M::FlexorHallucisLongus, "flexor hallucis longus"),
    (M::ErectorSpinae, "erector spinae"),
    (M::RectusAbdominis, "rectus abdominis"),
    (M::InternalOblique, "internal oblique"),
    (M::ExternalOblique, "external oblique"),
];

/// Words of names that say nothing about the muscle.
const EMPTY_WORDS: [&str; 4] = ["voltage", "emg", "activation", "ele"];
const RIGHT: [&str; 3] = ["r", "rt", "right"];
const LEFT: [&str; 3] = ["l", "lt", "left"];

impl AnatomicalMuscle {
    /// The muscle with this name in a recording or a model, and its side if the name has one: `R_tibialis_anterior`,
    /// `Voltage.R Rect`, `RTTI`, `vas_med_r`, `vasmed_r`. `None` for names that are not in the table of spellings.
    #[must_use]
    pub fn of_name(name: &str) -> Option<(AnatomicalMuscle, Option<Side>)> {
        let (spelled, side) = spelled(name)?;
        if let Some((muscle, _)) = NAMES.iter().find(|(_, full)| *full == spelled) {
            return Some((*muscle, side));
        }
        let known = SPELLINGS.iter().find(|spelling| spelling.name == spelled)?;
        match (known.side, side) {
            (Some(own), Some(other)) if own != other => None,
            (own, other) => Some((known.muscle, own.or(other))),
        }
    }

    /// The muscles of a group; of a muscle alone, the muscle.
    #[must_use]
    pub fn parts(&self) -> &[AnatomicalMuscle] {
        match self {
            M::Iliopsoas => &[M::Iliacus, M::Psoas],
            M::Vasti => &[M::VastusMedialis, M::VastusIntermedius, M::VastusLateralis],
            M::BicepsFemoris => &[M::BicepsFemorisLongHead, M::BicepsFemorisShortHead],
            M::Hamstrings => &[M::Semimembranosus, M::Semitendinosus, M::BicepsFemorisLongHead],
            M::Gastrocnemius => &[M::GastrocnemiusMedialis, M::GastrocnemiusLateralis],
            M::Peroneus => &[M::PeroneusLongus, M::PeroneusBrevis, M::PeroneusTertius],
            single => std::slice::from_ref(single),
        }
    }

    /// Whether both names can mean the same fibres: the same muscle, or a group and one of its parts.
    #[must_use]
    pub fn shares_fibres_with(self, other: AnatomicalMuscle) -> bool {
        self.parts().iter().any(|part| other.parts().contains(part))
    }

    /// All muscles and groups.
    pub fn all() -> impl Iterator<Item = AnatomicalMuscle> {
        NAMES.iter().map(|(muscle, _)| *muscle)
    }
}

impl fmt::Display for AnatomicalMuscle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(NAMES.iter().find(|(muscle, _)| muscle == self).map_or("", |(_, name)| name))
    }
}

/// The name without side, in small letters, its words separated by spaces; and the side. `None` if both sides occur.
fn spelled(name: &str) -> Option<(String, Option<Side>)> {
    let without_unit = name.split(['(', '[']).next().unwrap_or(name).to_lowercase();
    let words = without_unit.split(|c: char| !c.is_alphanumeric());
    let words = words.map(|word| word.trim_matches(|c: char| c.is_ascii_digit()));
    let (mut rest, mut side) = (Vec::new(), None);
    for word in words.filter(|word| !word.is_empty() && !EMPTY_WORDS.contains(word)) {
        let own = match word {
            word if RIGHT.contains(&word) => Side::Right,
            word if LEFT.contains(&word) => Side::Left,
            word => {
                rest.push(word);
                continue;
            }
        };
        if side.is_some_and(|other| other != own) {
            return None;
        }
        side = Some(own);
    }
    Some((rest.join(" "), side))
}
