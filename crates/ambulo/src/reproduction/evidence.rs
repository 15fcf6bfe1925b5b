//! The walks that the claims are judged by.

use super::error::ReproductionError;
use super::figures_of_mass::{denser, of_mass};
use super::mode::{Footwear, Mode, Request, Run};
use crate::gait::Gait;
use crate::model::anthropometry::{Build, Human, SegmentTable};

/// Mass of the paper's figure [kg].
pub const MASS: f64 = 80.0;
/// Its stature, which the paper does not give [m].
pub const HEIGHT: f64 = 1.80;
/// Friction that the paper names as high.
pub const FRICTION: f64 = 1.0;
/// Rate at which claims are judged [Hz].
pub const RATE_HZ: f64 = 1000.0;
/// Rates of the convergence [Hz]; the paper shows 30 Hz.
pub const RATES_HZ: [f64; 4] = [30.0, 60.0, 120.0, 1000.0];
/// What they are compared with [Hz].
pub const REFERENCE_HZ: f64 = 8000.0;
/// Cycles of each walk; the last six count.
pub const CYCLES: usize = 14;
/// The paper's gaits.
pub const GAITS: [&str; 4] = ["standard", "long", "short", "goose"];
/// The paper's masses [kg].
pub const MASSES: [f64; 3] = [60.0, 80.0, 100.0];
/// Frictions at which sliding is looked at.
pub const FRICTIONS: [f64; 10] = [0.4, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 1000.0];

/// How many walks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// All.
    Full,
    /// The gaits, and the standard one in both shoes: enough for the claims of [`judgements`](super::judgements).
    Brief,
}

/// All walks of one mode.
#[derive(Debug)]
pub struct Evidence {
    /// The standard gait at [`RATES_HZ`], then at [`REFERENCE_HZ`]; none where it was to be brief, as with the next four.
    pub rates: Vec<Run>,
    /// [`GAITS`].
    pub gaits: Vec<Run>,
    /// The standard gait with [`MASSES`], all lengths and radii alike.
    pub masses: Vec<Run>,
    /// The same in soft shoes.
    pub soft_masses: Vec<Run>,
    /// The same with radii of segments and soles that keep the density.
    pub dense_masses: Vec<Run>,
    /// The standard gait in rigid and in soft shoes.
    pub shoes: [Run; 2],
    /// The standard gait at [`FRICTIONS`], in rigid shoes.
    pub frictions: Vec<(f64, Run)>,
    /// Steps of the simulator in a second of the clock; zero if nobody held it.
    pub steps_per_s: f64,
}

impl Evidence {
    /// Walks all of them. `clock` tells seconds; without one nothing is said about speed.
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
        let request = Request {
            gait: &standard,
            human: &human,
            shoes: Footwear::Own,
            friction: FRICTION,
            rate_hz: RATE_HZ,
            cycles: CYCLES,
        };
        let steps_per_s = speed(mode, &request, clock)?;
        let mut gaits = Vec::new();
        for name in GAITS {
            gaits.push(mode(&Request { gait: &Gait::named(name)?, ..request })?);
        }
        let mut in_shoes = |shoes: Footwear| mode(&Request { shoes, ..request });
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
            evidence.gather_rest(mode, &request)?;
        }
        Ok(evidence)
    }

    fn gather_rest(&mut self, mode: &mut Mode<'_>, request: &Request<'_>) -> Result<(), ReproductionError> {
        for rate_hz in RATES_HZ.into_iter().chain([REFERENCE_HZ]) {
            self.rates.push(mode(&Request { rate_hz, ..*request })?);
        }
        for mass in MASSES {
            let figure = of_mass(mass)?;
            self.masses.push(mode(&Request { human: &figure, ..*request })?);
            self.soft_masses.push(mode(&Request { human: &figure, shoes: Footwear::Soft, ..*request })?);
            self.dense_masses.push(mode(&Request { human: &denser(&figure)?, ..*request })?);
        }
        for friction in FRICTIONS {
            self.frictions.push((friction, mode(&Request { friction, shoes: Footwear::Rigid, ..*request })?));
        }
        Ok(())
    }

    /// The standard gait at [`RATE_HZ`].
    #[must_use]
    pub fn standard(&self) -> &Run {
        &self.gaits[0]
    }
}

/// The paper's figure: Table 1, 80 kg.
///
/// # Errors
/// None that is known.
pub fn paper_human() -> Result<Human, ReproductionError> {
    let build = Build { table: SegmentTable::Faure1997, mass: MASS, height: HEIGHT, toe_joint: false };
    Ok(build.human()?)
}

fn speed(
    mode: &mut Mode<'_>,
    request: &Request<'_>,
    clock: Option<&dyn Fn() -> f64>,
) -> Result<f64, ReproductionError> {
    let Some(clock) = clock else { return Ok(0.0) };
    // The second walk has what the first one had to prepare.
    mode(request)?;
    let start = clock();
    let run = mode(request)?;
    Ok(run.recording.grid().frames as f64 / (clock() - start).max(1e-9))
}
