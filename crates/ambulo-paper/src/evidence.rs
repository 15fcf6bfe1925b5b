//! The walks that are needed to judge the claims.

use super::error::ReproductionError;
use super::mode::{Footwear, Mode, Run, TrialSettings};
use super::open_values::GAITS;
use super::paper_human::{MASS, denser, of_mass, paper_human};
use ambulo_body::model::anthropometry::Human;
use ambulo_walk::gait::Gait;

/// The coefficient of friction that the paper calls high.
pub const FRICTION: f64 = 1.0;
/// Time steps per second at which claims are judged [Hz].
pub const RATE_HZ: f64 = 1000.0;
/// Rates of the convergence [Hz]; the paper shows 30 Hz.
pub const RATES_HZ: [f64; 4] = [30.0, 60.0, 120.0, 1000.0];
/// Rate of the reference for the convergence [Hz].
pub const REFERENCE_HZ: f64 = 8000.0;
/// Cycles of each walk; the last six are evaluated.
pub const CYCLES: usize = 10;
/// Cycles of each walk of smaller scopes, whose walk is as steady after three cycles as after four (claim b).
pub const BRIEF_CYCLES: usize = 9;
/// Cycles of the walks whose convergence is measured, and of their reference, in whose last cycle they are compared.
const RATE_CYCLES: [usize; 2] = [8, 3];
/// The paper's masses [kg].
pub const MASSES: [f64; 3] = [60.0, 80.0, 100.0];
/// Coefficients of friction at which sliding is measured.
pub const FRICTIONS: [f64; 6] = [0.4, 0.8, 1.0, 2.0, 5.0, 1000.0];
/// Frictions at which the corrected mode is simulated, for comparison.
const COMPARED_FRICTIONS: [f64; 2] = [1.0, 1000.0];

/// Which walks are simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Scope {
    /// The gaits, and the standard gait in both shoes: sufficient for most claims.
    Brief,
    /// Also figures of other masses with the same density: all claims except those about convergence and other bodies.
    Sampled,
    /// All.
    Full,
}

/// All walks of one mode.
#[derive(Debug)]
pub struct Evidence {
    /// The standard gait at [`RATES_HZ`], then at [`REFERENCE_HZ`]. Empty if the scope is brief, as are the masses and
    /// frictions below.
    pub rates: Vec<Run>,
    /// [`GAITS`].
    pub gaits: Vec<Run>,
    /// The standard gait with [`MASSES`] and the same lengths and radii.
    pub masses: Vec<Run>,
    /// The three masses in soft shoes.
    pub soft_masses: Vec<Run>,
    /// The three masses with radii of segments and soles for the same density.
    pub dense_masses: Vec<Run>,
    /// The standard gait in rigid and in soft shoes.
    pub shoes: [Run; 2],
    /// The standard gait at [`FRICTIONS`], in rigid shoes.
    pub frictions: Vec<(f64, Run)>,
    /// Time steps of the simulator per second of computing time; zero if it was not measured.
    pub steps_per_s: f64,
}

impl Evidence {
    /// Simulates all walks. `clock` returns seconds; without it the computing time is not measured.
    ///
    /// # Errors
    /// The first walk that fails.
    pub fn gather(
        mode: &mut Mode<'_>,
        scope: Scope,
        clock: Option<&dyn Fn() -> f64>,
    ) -> Result<Evidence, ReproductionError> {
        let (human, standard) = (paper_human()?, Gait::named("standard")?);
        let trial = trial_of(&standard, &human, scope);
        // The first walk prepares data that the second one uses, whose time is measured.
        let soft = mode(&TrialSettings { shoes: Footwear::Soft, ..trial })?;
        let start = clock.map(|clock| clock());
        let own = mode(&trial)?;
        let seconds = clock.zip(start).map_or(0.0, |(clock, start)| clock() - start);
        let steps_per_s = if seconds > 0.0 { own.recording.grid().frames as f64 / seconds } else { 0.0 };
        let rigid = if own.shoes == Footwear::Rigid {
            own.clone()
        } else {
            mode(&TrialSettings { shoes: Footwear::Rigid, ..trial })?
        };
        let mut gaits = vec![own];
        for name in &GAITS[1..] {
            gaits.push(mode(&TrialSettings { gait: &Gait::named(name)?, ..trial })?);
        }
        let mut evidence = Evidence {
            rates: Vec::new(),
            gaits,
            masses: Vec::new(),
            soft_masses: Vec::new(),
            dense_masses: Vec::new(),
            shoes: [rigid, soft],
            frictions: Vec::new(),
            steps_per_s,
        };
        if scope >= Scope::Sampled {
            evidence.gather_dense(mode, &trial)?;
        }
        if scope == Scope::Full {
            evidence.gather_rest(mode, &trial)?;
        }
        Ok(evidence)
    }

    fn gather_dense(&mut self, mode: &mut Mode<'_>, trial: &TrialSettings<'_>) -> Result<(), ReproductionError> {
        for mass in MASSES {
            let run = if (mass - MASS).abs() < f64::EPSILON {
                self.standard().clone()
            } else {
                mode(&TrialSettings { human: &denser(&of_mass(mass)?)?, ..*trial })?
            };
            self.dense_masses.push(run);
        }
        Ok(())
    }

    fn gather_rest(&mut self, mode: &mut Mode<'_>, trial: &TrialSettings<'_>) -> Result<(), ReproductionError> {
        let [cycles, of_reference] = RATE_CYCLES;
        for rate_hz in RATES_HZ {
            self.rates.push(mode(&TrialSettings { rate_hz, cycles, ..*trial })?);
        }
        self.rates.push(mode(&TrialSettings { rate_hz: REFERENCE_HZ, cycles: of_reference, ..*trial })?);
        let is_soft = self.standard().shoes == Footwear::Soft;
        for mass in MASSES {
            if (mass - MASS).abs() < f64::EPSILON {
                self.masses.push(self.standard().clone());
                self.soft_masses.push(self.shoes[1].clone());
                continue;
            }
            let figure = of_mass(mass)?;
            self.masses.push(mode(&TrialSettings { human: &figure, ..*trial })?);
            let soft = match self.masses.last() {
                Some(own) if is_soft => own.clone(),
                _ => mode(&TrialSettings { human: &figure, shoes: Footwear::Soft, ..*trial })?,
            };
            self.soft_masses.push(soft);
        }
        let frictions = if is_soft { &COMPARED_FRICTIONS[..] } else { &FRICTIONS[..] };
        for &friction in frictions {
            let run = if (friction - FRICTION).abs() < f64::EPSILON {
                self.shoes[0].clone()
            } else {
                mode(&TrialSettings { friction, shoes: Footwear::Rigid, ..*trial })?
            };
            self.frictions.push((friction, run));
        }
        Ok(())
    }

    /// The walks of [`Scope::Brief`], without walking again, with one of [`GAITS`] walked by a mode.
    pub(super) fn with_gait(&self, gait: usize, mode: &mut Mode<'_>) -> Result<Evidence, ReproductionError> {
        let (human, named) = (paper_human()?, Gait::named(GAITS[gait])?);
        let run = mode(&trial_of(&named, &human, Scope::Brief))?;
        let mut near = self.brief();
        near.gaits[gait] = run;
        Ok(near)
    }

    /// The same with the walk in soft shoes.
    pub(super) fn with_soft_shoes(&self, mode: &mut Mode<'_>) -> Result<Evidence, ReproductionError> {
        let (human, named) = (paper_human()?, Gait::named(GAITS[0])?);
        let run = mode(&TrialSettings { shoes: Footwear::Soft, ..trial_of(&named, &human, Scope::Brief) })?;
        let mut near = self.brief();
        near.shoes[1] = run;
        Ok(near)
    }

    fn brief(&self) -> Evidence {
        Evidence {
            rates: Vec::new(),
            gaits: self.gaits.clone(),
            masses: Vec::new(),
            soft_masses: Vec::new(),
            dense_masses: Vec::new(),
            shoes: self.shoes.clone(),
            frictions: Vec::new(),
            steps_per_s: self.steps_per_s,
        }
    }

    /// The standard gait at [`RATE_HZ`].
    #[must_use]
    pub fn standard(&self) -> &Run {
        &self.gaits[0]
    }
}

/// The standard gait of the paper at the rate and over the cycles at which claims are judged.
fn trial_of<'a>(gait: &'a Gait, human: &'a Human, scope: Scope) -> TrialSettings<'a> {
    let cycles = if scope == Scope::Full { CYCLES } else { BRIEF_CYCLES };
    TrialSettings { gait, human, shoes: Footwear::Own, friction: FRICTION, rate_hz: RATE_HZ, cycles }
}
