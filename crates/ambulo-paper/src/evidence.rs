//! The walks that are needed to judge the claims.

use super::error::ReproductionError;
use super::mode::{Footwear, Mode, Run, TrialSettings};
use super::paper_human::{denser, of_mass, paper_human};
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
pub const CYCLES: usize = 14;
/// The paper's gaits.
pub const GAITS: [&str; 4] = ["standard", "long", "short", "goose"];
/// The paper's masses [kg].
pub const MASSES: [f64; 3] = [60.0, 80.0, 100.0];
/// Coefficients of friction at which sliding is measured.
pub const FRICTIONS: [f64; 10] = [0.4, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 1000.0];

/// Which walks are simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// All.
    Full,
    /// The gaits, and the standard gait in both shoes: sufficient for the claims of [`judgements`](super::judgements).
    Brief,
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
    /// The same in soft shoes.
    pub soft_masses: Vec<Run>,
    /// The same with radii of segments and soles for the same density.
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
        let human = paper_human()?;
        let standard = Gait::named("standard")?;
        let trial = TrialSettings {
            gait: &standard,
            human: &human,
            shoes: Footwear::Own,
            friction: FRICTION,
            rate_hz: RATE_HZ,
            cycles: CYCLES,
        };
        let steps_per_s = speed(mode, &trial, clock)?;
        let mut gaits = Vec::new();
        for name in GAITS {
            gaits.push(mode(&TrialSettings { gait: &Gait::named(name)?, ..trial })?);
        }
        let mut in_shoes = |shoes: Footwear| mode(&TrialSettings { shoes, ..trial });
        let shoes = [in_shoes(Footwear::Rigid)?, in_shoes(Footwear::Soft)?];
        let mut evidence = Evidence {
            rates: Vec::new(),
            gaits,
            masses: Vec::new(),
            soft_masses: Vec::new(),
            dense_masses: Vec::new(),
            shoes,
            frictions: Vec::new(),
            steps_per_s,
        };
        if scope == Scope::Full {
            evidence.gather_rest(mode, &trial)?;
        }
        Ok(evidence)
    }

    fn gather_rest(&mut self, mode: &mut Mode<'_>, trial: &TrialSettings<'_>) -> Result<(), ReproductionError> {
        for rate_hz in RATES_HZ.into_iter().chain([REFERENCE_HZ]) {
            self.rates.push(mode(&TrialSettings { rate_hz, ..*trial })?);
        }
        for mass in MASSES {
            let figure = of_mass(mass)?;
            self.masses.push(mode(&TrialSettings { human: &figure, ..*trial })?);
            self.soft_masses.push(mode(&TrialSettings { human: &figure, shoes: Footwear::Soft, ..*trial })?);
            self.dense_masses.push(mode(&TrialSettings { human: &denser(&figure)?, ..*trial })?);
        }
        for friction in FRICTIONS {
            self.frictions.push((friction, mode(&TrialSettings { friction, shoes: Footwear::Rigid, ..*trial })?));
        }
        Ok(())
    }

    /// The standard gait at [`RATE_HZ`].
    #[must_use]
    pub fn standard(&self) -> &Run {
        &self.gaits[0]
    }
}

fn speed(
    mode: &mut Mode<'_>,
    trial: &TrialSettings<'_>,
    clock: Option<&dyn Fn() -> f64>,
) -> Result<f64, ReproductionError> {
    let Some(clock) = clock else { return Ok(0.0) };
    // The first walk prepares data that the second one uses.
    mode(trial)?;
    let start = clock();
    let run = mode(trial)?;
    Ok(run.recording.grid().frames as f64 / (clock() - start).max(1e-9))
}
