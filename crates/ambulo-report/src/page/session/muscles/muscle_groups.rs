//! Groups of muscles with a panel.

use ambulo::model::{BySide, Side};
use ambulo::muscles::emg::AnatomicalMuscle::{self, *};
use ambulo::muscles::emg::{bursts, normal_timing};
use ambulo_formats::table::Table;

/// A muscle is usually active where it is on in at least this share of persons.
const USUAL_SHARE: f64 = 0.5;
/// Intervals of a cycle in the table of normal timing.
const PERCENTS: usize = 100;

/// Muscles that share a panel.
pub(super) struct MuscleGroup {
    /// Part of the panel's id.
    pub(super) id: &'static str,
    /// Heading.
    pub(super) title: &'static str,
    /// Its muscles, and the names of several of them together.
    muscles: &'static [AnatomicalMuscle],
}

/// A column of a muscle: which it is, its name, and one value per instant.
pub(super) type MuscleColumn<'a> = (AnatomicalMuscle, &'a str, &'a [f64]);

/// The groups, from proximal to distal.
pub(super) const GROUPS: [MuscleGroup; 9] = [
    MuscleGroup { id: "hip_flexors", title: "Hip flexors", muscles: &[Iliacus, Psoas, Iliopsoas] },
    MuscleGroup { id: "gluteus_maximus", title: "Gluteus maximus", muscles: &[GluteusMaximus] },
    MuscleGroup { id: "gluteus_medius", title: "Gluteus medius", muscles: &[GluteusMedius] },
    MuscleGroup {
        id: "hamstrings",
        title: "Hamstrings",
        muscles: &[Semitendinosus, Semimembranosus, BicepsFemorisLongHead, BicepsFemoris, Hamstrings],
    },
    MuscleGroup { id: "rectus_femoris", title: "Rectus femoris", muscles: &[RectusFemoris] },
    MuscleGroup { id: "vasti", title: "Vasti", muscles: &[VastusMedialis, VastusIntermedius, VastusLateralis, Vasti] },
    MuscleGroup {
        id: "gastrocnemius",
        title: "Gastrocnemius",
        muscles: &[GastrocnemiusMedialis, GastrocnemiusLateralis, Gastrocnemius],
    },
    MuscleGroup { id: "soleus", title: "Soleus", muscles: &[Soleus] },
    MuscleGroup { id: "tibialis_anterior", title: "Tibialis anterior", muscles: &[TibialisAnterior] },
];

impl MuscleGroup {
    /// The side of a muscle of the group, and which muscle it is, by its name in a model or a recording.
    pub(super) fn known(&self, name: &str) -> Option<(Side, AnatomicalMuscle)> {
        let (muscle, side) = AnatomicalMuscle::of_name(name)?;
        self.muscles.contains(&muscle).then_some((side?, muscle))
    }

    /// The columns with this ending, of both legs.
    pub(super) fn columns<'a>(&self, table: &'a Table, ending: &str) -> BySide<Vec<MuscleColumn<'a>>> {
        let mut found: BySide<Vec<MuscleColumn<'a>>> = BySide { right: Vec::new(), left: Vec::new() };
        for (name, values) in table.columns() {
            if let Some((side, muscle)) = name.strip_suffix(ending).and_then(|muscle| self.known(muscle)) {
                found[side].push((muscle, name, values));
            }
        }
        found
    }

    /// The first muscle of the group whose usual times of activity are known, and these times [% of the cycle].
    pub(super) fn usual(&self) -> Option<(AnatomicalMuscle, Vec<[f64; 2]>)> {
        let timing = self.muscles.iter().find_map(|muscle| normal_timing(*muscle))?;
        let on = timing.is_on(USUAL_SHARE);
        (on.len() == PERCENTS).then(|| (timing.muscle, active_times(&on)))
    }
}

/// Bursts to draw, from and to [% of the cycle]: one across the foot strike is drawn at both ends of the cycle.
pub(super) fn active_times(on: &[bool]) -> Vec<[f64; 2]> {
    let parts = |[from, to]: [f64; 2]| if from < to { vec![[from, to]] } else { vec![[0.0, to], [from, 100.0]] };
    bursts(on).into_iter().flat_map(parts).filter(|[from, to]| from < to).collect()
}
