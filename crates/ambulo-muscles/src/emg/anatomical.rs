//! Muscles by their names in anatomy.

use serde::{Deserialize, Serialize};

/// A muscle of the human leg or trunk, or a group of them that an electrode or a model does not tell apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the variants are the names of anatomy")]
#[non_exhaustive]
pub enum AnatomicalMuscle {
    GluteusMaximus,
    GluteusMedius,
    GluteusMinimus,
    TensorFasciaeLatae,
    Sartorius,
    Gracilis,
    AdductorLongus,
    AdductorBrevis,
    AdductorMagnus,
    Pectineus,
    Iliacus,
    Psoas,
    /// Iliacus and psoas.
    Iliopsoas,
    QuadratusFemoris,
    Gemelli,
    Piriformis,
    RectusFemoris,
    VastusMedialis,
    VastusIntermedius,
    VastusLateralis,
    /// The three vasti.
    Vasti,
    Semimembranosus,
    Semitendinosus,
    BicepsFemorisLongHead,
    BicepsFemorisShortHead,
    /// Biceps femoris, its head not stated.
    BicepsFemoris,
    /// Semimembranosus, semitendinosus and the long head of biceps femoris.
    Hamstrings,
    GastrocnemiusMedialis,
    GastrocnemiusLateralis,
    /// Gastrocnemius, its head not stated.
    Gastrocnemius,
    Soleus,
    TibialisAnterior,
    TibialisPosterior,
    PeroneusLongus,
    PeroneusBrevis,
    PeroneusTertius,
    /// Peroneus, which one is not stated.
    Peroneus,
    ExtensorDigitorumLongus,
    ExtensorHallucisLongus,
    FlexorDigitorumLongus,
    FlexorHallucisLongus,
    ErectorSpinae,
    RectusAbdominis,
    InternalOblique,
    ExternalOblique,
}
