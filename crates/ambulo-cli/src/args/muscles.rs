//! Options of muscles.

use super::values::{metres, number, one_of};
use ambulo::job::MuscleStatements;
use ambulo::muscles::strength::Pennation;
use ambulo::muscles::wrap::WrapRule;
use clap::Args as ClapArgs;
use std::path::PathBuf;

// Muscle forces, and what they rest on.
#[derive(Debug, Clone, ClapArgs)]
pub(crate) struct MuscleArgs {
    /// Compute muscle forces by static optimisation, and the loads that hip, knee and ankle carry with them
    /// (docs/MUSCLES.md): the muscles of --model, or those of the built-in body. Adds muscles.sto and
    /// reactions_contact.sto.
    #[arg(long)]
    pub(crate) muscles: bool,
    /// Motors that help the muscles: actuators of OpenSim (.xml) [default: the model's own, and 1 N.m at each other
    /// joint coordinate, 1000 at the pelvis].
    #[arg(long, value_name = "FILE", requires = "muscles")]
    pub(crate) reserves: Option<PathBuf>,
    /// Electromyograms of the recording: a table (.sto, .mot, .csv), raw or as envelopes [default: the analog channels
    /// of a C3D].
    #[arg(long, value_name = "FILE", requires = "muscles")]
    pub(crate) emg: Option<PathBuf>,
    /// Paths of muscles over surfaces: `exact`, the shortest; `opensim`, as OpenSim finds them.
    #[arg(long, value_name = "RULE", default_value = "exact", value_parser = one_of(&WrapRule::ALL))]
    pub(crate) wraps: WrapRule,
    /// Pennation of muscles of Millard's kind: `opensim`, as its static optimisation computes it; `exact`, the
    /// angle between fibres and tendon.
    #[arg(long, value_name = "RULE", default_value = "opensim", value_parser = one_of(&Pennation::ALL))]
    pub(crate) pennation: Pennation,
    /// Exponent of the activations in the sum that static optimisation makes least.
    #[arg(long, value_name = "P", default_value_t = MuscleStatements::EXPONENT, value_parser = number,
        allow_negative_numbers = true)]
    pub(crate) exponent: f64,
    /// Distance between the contacts of the two condyles of a knee [m], by which its load is divided [default: 0.04
    /// for a knee 0.09 m wide, in proportion to the width in the recording (KneeWidth), otherwise to stature].
    #[arg(long, value_name = "M", value_parser = metres, requires = "muscles", allow_negative_numbers = true)]
    pub(crate) condyles: Option<f64>,
}

impl MuscleArgs {
    /// The statements of the options.
    pub(super) fn statements(self) -> Option<MuscleStatements> {
        self.muscles.then(|| MuscleStatements {
            reserves: self.reserves,
            emg: self.emg,
            wraps: self.wraps,
            pennation: self.pennation,
            exponent: self.exponent,
            condyles_m: self.condyles,
            ..MuscleStatements::default()
        })
    }
}
