//! The corrected mode: the same gaits on the same figure, put right.
//!
//! Against the paper's mode: joint curves whose knots carry velocity and acceleration, a pelvis and trunk that move, a toe joint,
//! soft shoes, and the motion made consistent ([`crate::simulation::consistent_walk`]): its forces come from the ground alone.

use super::error::ReproductionError;
use super::mode::{Footwear, Request, Run};
use crate::findings::Findings;
use crate::gait::{Gait, Style, Walk};
use crate::model::anthropometry::{Build, Human};
use crate::simulation::consistent_walk::{ConsistentWalk, ConsistentWalkSettings, make_consistent_walk};
use crate::simulation::walking::{Ground, Shoes};
use crate::simulation::{ImpactLaw, Integrator, StepSettings};

/// The corrected mode. A walk is made consistent once and kept for the requests that differ in shoes, rate or friction.
#[derive(Debug, Default)]
pub struct Corrected {
    settings: ConsistentWalkSettings,
    kept: Vec<Kept>,
}

#[derive(Debug)]
struct Kept {
    gait: Gait,
    /// Bits of mass, stature and the soles' radii, which tell figures apart.
    figure: [u64; 3],
    human: Human,
    walk: ConsistentWalk,
}

impl Corrected {
    /// Makes the figure walk.
    ///
    /// # Errors
    /// A gait that the figure cannot have, or a walk that cannot be simulated.
    pub fn walk(&mut self, request: &Request<'_>) -> Result<Run, ReproductionError> {
        let number = self.find_or_make(request)?;
        let Kept { human, walk, .. } = &self.kept[number];
        let ground = match request.shoes {
            Footwear::Own | Footwear::Soft => Ground {
                friction: self.settings.shoes.dynamic_friction,
                shoes: Shoes::HuntCrossley(self.settings.shoes),
                impact: ImpactLaw::Coulomb,
            },
            Footwear::Rigid => Ground { friction: request.friction, shoes: Shoes::Rigid, impact: ImpactLaw::Sticking },
        };
        let steps =
            StepSettings { step_s: 1.0 / request.rate_hz, integrator: Integrator::Impulse, ..StepSettings::default() };
        let gait = walk.walk();
        let duration_s = gait.cycle_s() * request.cycles as f64;
        let recording = walk.walker(human, &ground)?.walk(&steps, duration_s, &mut Findings::default())?;
        Ok(Run {
            recording,
            gait: gait.name().to_owned(),
            soles: human.soles.clone(),
            cycle_s: gait.cycle_s(),
            speed: gait.speed(),
            step_length: gait.step_length(),
            foot_off: gait.phases(&gait.clock(0.0)).foot_off,
        })
    }

    fn find_or_make(&mut self, request: &Request<'_>) -> Result<usize, ReproductionError> {
        let figure =
            [request.human.model.mass(), request.human.build.height, thickness(request.human)].map(f64::to_bits);
        if let Some(number) = self.kept.iter().position(|k| k.gait == *request.gait && k.figure == figure) {
            return Ok(number);
        }
        let human = with_toes(request.human)?;
        // The same speed, steps and changes, by curves that carry velocity and acceleration.
        let gait = request.gait.clone().in_style(Style::Knots);
        let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default())?;
        let walk = make_consistent_walk(&human, &walk, &self.settings)
            .map_err(|e| ReproductionError::Mode { gait: gait.name.clone(), reason: e.to_string() })?;
        self.kept.push(Kept { gait: request.gait.clone(), figure, human, walk });
        Ok(self.kept.len() - 1)
    }
}

/// Sum of the soles' radii [m].
fn thickness(human: &Human) -> f64 {
    human.soles.iter().map(|sole| sole.radius).sum()
}

/// The same figure with a toe joint, and its soles' radii kept.
fn with_toes(human: &Human) -> Result<Human, ReproductionError> {
    let mut figure = Build { toe_joint: true, ..human.build }.human()?;
    let (old, new) = (thickness(human), thickness(&figure));
    for sole in &mut figure.soles {
        sole.center.y += sole.radius * (old / new - 1.0);
        sole.radius *= old / new;
    }
    Ok(figure)
}
