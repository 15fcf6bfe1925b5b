//! Settings of a dynamically consistent walk, and why it could not be computed.

use crate::contact::HuntCrossley;
use crate::dynamics::CurvedJointError;
use crate::optimal::WalkCosts;
use crate::toml_reader::TomlError;

/// Settings of [`make_consistent_walk`](super::make_consistent_walk).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConsistentWalkSettings {
    /// Contact law of the soles.
    pub shoes: HuntCrossley,
    /// Resolution of the splines, and costs of deviations, at a constant pace.
    pub costs: WalkCosts,
    /// The same while the pace changes.
    pub changes: WalkCosts,
}

impl Default for ConsistentWalkSettings {
    fn default() -> Self {
        ConsistentWalkSettings {
            shoes: HuntCrossley::SOFT_SHOES,
            costs: WalkCosts::planar(),
            changes: WalkCosts::change_of_pace(),
        }
    }
}

/// Why a dynamically consistent walk could not be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConsistentWalkError {
    /// The figure has joints that are not hinges or slides.
    #[error(transparent)]
    Joint(#[from] CurvedJointError),
    /// Machines that do something else in every cycle.
    #[error(
        "the gait `{gait}`: found machines that move joints otherwise from cycle to cycle; expected the same in every \
         cycle, because one cycle is solved and repeated. hint: use the mode `paper`, in scenes `curves`"
    )]
    Machines {
        /// Name of the gait.
        gait: String,
    },
    /// A change of pace without a motion before or after it.
    #[error("found a change of pace without a motion before or after it; expected one on both sides")]
    Order,
    /// The built-in normative laws could not be read.
    #[error(transparent)]
    Laws(#[from] TomlError),
}
