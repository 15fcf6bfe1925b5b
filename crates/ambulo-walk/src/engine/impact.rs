//! Impacts: instants at which surfaces meet. Velocities change, positions do not.
//!
//! Drives without a limit keep their rates, whatever impulse that takes; drives with a limit give way.

use super::assemble::{Span, twist};
use super::forces::{Impact, StepForces};
use super::state::WorldState;
use super::touch::{Touch, obstacle_motion};
use super::workspace::{StepSettings, StepWorkspace};
use super::world::World;
use crate::dynamics::LinkError;
use crate::findings::Findings;

/// Duration of an impact in a smooth step [s]: gravity gives 1e-8 m/s in it.
const IMPACT_S: f64 = 1e-9;

/// Computes the impact of surfaces that touch at this instant of a smooth step.
pub(super) fn impact(
    world: &World,
    state: &mut WorldState,
    settings: &StepSettings,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<(), LinkError> {
    w.step_s = IMPACT_S;
    w.prescribed.fill(world, state.time_s + IMPACT_S);
    obstacle_motion(world, state.time_s, IMPACT_S, &mut w.contact.obstacles);
    w.contact.touch.detect(world, state, &w.contact.obstacles, IMPACT_S);
    w.contact.touch.close_gaps();
    w.solve_impact(world, state, settings, findings)?;
    w.take_impact(world, state);
    state.guess.clear();
    Ok(())
}

impl StepWorkspace {
    fn solve_impact(
        &mut self,
        world: &World,
        state: &WorldState,
        settings: &StepSettings,
        findings: &mut Findings,
    ) -> Result<(), LinkError> {
        self.step_s = IMPACT_S;
        self.solve(world, state, Span::instant(IMPACT_S), settings, findings)
    }

    /// Takes over the velocities after an impact, and records its impulses.
    fn take_impact(&mut self, world: &World, state: &mut WorldState) {
        for (twist_now, motion) in state.twists.iter_mut().zip(&self.equations.solution.motions) {
            *twist_now = twist(motion);
        }
        let StepForces { mut contacts, mut efforts, .. } = self.forces(world);
        for contact in &mut contacts {
            contact.force *= IMPACT_S;
            contact.normal_force *= IMPACT_S;
        }
        efforts.iter_mut().flatten().for_each(|effort| *effort *= IMPACT_S);
        self.impacts.all.push(Impact { time_s: state.time_s, contacts, efforts });
        self.impacts.twists_after.clone_from(&state.twists);
    }

    /// Sticking impacts: every point that has come into contact since the last step loses all its velocity, one after
    /// the other in the order in which they touched. Points that separate in the meantime, or are at rest already, are
    /// skipped.
    pub(super) fn strike(
        &mut self,
        world: &World,
        state: &mut WorldState,
        settings: &StepSettings,
        findings: &mut Findings,
    ) -> Result<(), LinkError> {
        while let Some(number) = self.contact.touch.next_striker(world, state, &self.contact.obstacles) {
            let touches = self.contact.touch.touches.clone();
            self.contact.touch.touches[number].sticks = true;
            self.solve_impact(world, state, settings, findings)?;
            if self.pulls() {
                // Another point carries the impact: this one is not held back.
                self.contact.touch.touches.clone_from(&touches);
                self.solve_impact(world, state, settings, findings)?;
            }
            self.take_impact(world, state);
            self.contact.touch.touches = touches;
            self.contact.touch.touches[number].known = true;
        }
        Ok(())
    }

    /// Whether the sticking point would have to pull.
    fn pulls(&self) -> bool {
        let normal = |touch: &Touch| self.equations.solution.lambda[touch.rows.normal];
        self.contact.touch.touches.iter().any(|touch| touch.sticks && normal(touch) <= 0.0)
    }
}
