//! The paper's mode: joints as the gait has them, the trunk held upright, rigid soles whose impacts cancel the whole velocity.

use super::order::SyntheticWalkSettings;
use super::steady::{simulated_cycles, steady};
use super::{SyntheticError, SyntheticWalk};
use crate::findings::Findings;
use crate::gait::{Gait, Pelvis, Walk};
use crate::model::anthropometry::Human;
use crate::simulation::walking::{Ground, Shoes, Walker, gait_signals};
use crate::simulation::{ImpactLaw, StepSettings};

/// Cycles until the walk repeats.
const LEFT_OUT: usize = 2;
/// The paper's coefficient of friction (section 4.3).
const FRICTION: f64 = 1.0;

pub(super) fn walk(
    order: &SyntheticWalkSettings<'_>,
    human: Human,
    findings: &mut Findings,
) -> Result<SyntheticWalk, SyntheticError> {
    let gait = Gait { pelvis: Pelvis::Vertical, ..order.gait.clone() };
    let walk = Walk::new(&gait, human.dimensions.leg_length, findings)?;
    let ground = Ground { friction: FRICTION, shoes: Shoes::Rigid, impact: ImpactLaw::Sticking };
    let walker = Walker::new(&human, gait_signals(&walk, &human.model), &ground, walk.speed())?;
    let step = StepSettings { step_s: order.step_s(), ..StepSettings::default() };
    let recording = walker.walk(&step, simulated_cycles(order, LEFT_OUT) * walk.cycle_s(), findings)?;
    steady(order, LEFT_OUT, human, walk, &recording, None)
}
