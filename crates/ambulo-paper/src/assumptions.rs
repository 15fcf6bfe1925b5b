//! Values that the paper does not give: the value used, the reason, and the effect of other values on the claims.

use super::claim::{Claim, Judgement};
use super::error::ReproductionError;
use super::evidence::{Evidence, Scope};
use super::mode::{TrialSettings, paper_walk_with};
use super::paper_human::TABLE_FOOT;
use super::paper_settings::PaperSettings;
use super::statements::judgements;
use ambulo_body::contact::HuntCrossley;
use ambulo_walk::engine::ImpactLaw;
use ambulo_walk::gait::Style;

/// A value that the paper does not give.
#[derive(Debug, Clone, PartialEq)]
pub struct Assumption {
    /// Quantity.
    pub what: &'static str,
    /// The value used.
    pub value: &'static str,
    /// Reason.
    pub why: &'static str,
    /// Other values with their settings.
    pub others: Vec<(&'static str, PaperSettings)>,
}

/// The effect of another value on the claims.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// Quantity that was changed.
    pub what: &'static str,
    /// The other value.
    pub other: &'static str,
    /// The claims with their most important numbers, or the reason why the walk could not be simulated.
    pub outcome: Result<Vec<Judgement>, String>,
}

impl Sensitivity {
    /// Claims whose judgement is the reverse of that with the values used.
    #[must_use]
    pub fn reversed<'a>(&'a self, claims: &'a [Claim]) -> Vec<&'static str> {
        let judged = |id: &str| claims.iter().find(|claim| claim.id == id).map(|claim| claim.pass);
        let own = self.outcome.iter().flatten();
        own.filter(|judgement| judged(judgement.id).is_some_and(|pass| pass != judgement.pass)).map(|v| v.id).collect()
    }
}

/// All values that the paper does not give, with other values to try.
#[must_use]
pub fn assumptions() -> Vec<Assumption> {
    [about_the_figure(), about_the_gait(), about_step_heights(), about_the_ground()].concat()
}

fn assumption(
    what: &'static str,
    value: &'static str,
    why: &'static str,
    others: Vec<(&'static str, PaperSettings)>,
) -> Assumption {
    Assumption { what, value, why, others }
}

/// Size, mass, soles and arms of the figure.
fn about_the_figure() -> Vec<Assumption> {
    let (taken, with) = (PaperSettings::default(), assumption);
    vec![
        with(
            "stature",
            "1.80 m",
            "stature of a tall man; the centre of mass at 1.2 m in the paper would require 2.1 m",
            vec![
                ("1.70 m", PaperSettings { height: Some(1.70), ..taken }),
                ("1.90 m", PaperSettings { height: Some(1.90), ..taken }),
            ],
        ),
        with(
            "density, which determines the radii of the cylinders",
            "1050 kg/m³",
            "approximate density of the human body; the paper says uniform",
            vec![
                ("700 kg/m³", PaperSettings { thickness: 1.5, ..taken }),
                ("1600 kg/m³", PaperSettings { thickness: 0.65, ..taken }),
            ],
        ),
        with(
            "radii of the spheres under the feet",
            "35, 25 and 15 mm",
            "published foot models for this stature",
            vec![
                ("0.6 times these radii", PaperSettings { sole_radii: 0.6, ..taken }),
                ("1.4 times these radii", PaperSettings { sole_radii: 1.4, ..taken }),
            ],
        ),
        with(
            "positions of the spheres under the feet",
            "heel, ball and tip of the toes",
            "the foot of a person stands on these",
            vec![("heel and ball only", PaperSettings { toe_spheres: false, ..taken })],
        ),
        with(
            "foot of 8.9 % of stature in Table 1",
            "the length of its cylinder; the foot has the 15.2 % of Drillis and Contini",
            "16 cm are too short for a foot",
            vec![("from the ankle to the tip of the toes", PaperSettings { toe_reach: Some(TABLE_FOOT), ..taken })],
        ),
        with(
            "laws of the arms",
            "Boulic, Magnenat-Thalmann, Thalmann 1990",
            "published at the time of the paper, which has a natural neutral swing",
            vec![
                ("no arm swing", PaperSettings { arm_swing: 0.0, ..taken }),
                ("1.5 times the swing", PaperSettings { arm_swing: 1.5, ..taken }),
            ],
        ),
    ]
}

/// Joint curves and step lengths.
fn about_the_gait() -> Vec<Assumption> {
    let (taken, with) = (PaperSettings::default(), assumption);
    vec![
        with(
            "Nilsson's tables: the curves of the joints",
            "extremes of Schwartz, Rozumalski, Trost 2008, joined by the paper's quintics",
            "the only public data for all speeds; they are of children",
            vec![(
                "the same data with their own velocities and accelerations",
                PaperSettings { style: Some(Style::Knots), ..taken },
            )],
        ),
        with(
            "zero of the hip angle",
            "thigh relative to the vertical: reduced by the mean pelvic tilt",
            "the trunk is held upright",
            vec![
                ("5° more flexed", PaperSettings { hip_offset: 5.0_f64.to_radians(), ..taken }),
                ("5° more extended", PaperSettings { hip_offset: (-5.0_f64).to_radians(), ..taken }),
            ],
        ),
        with(
            "step length of the gaits",
            "0.75 m for the standard gait",
            "1.5 m/s (section 4.2) at two steps per second",
            vec![
                ("0.8 times all lengths", PaperSettings { step_length: 0.8, ..taken }),
                ("1.15 times all lengths", PaperSettings { step_length: 1.15, ..taken }),
            ],
        ),
        with(
            "length of the short steps",
            "0.62 of the standard length",
            "the speed of the standard gait at their period of 0.62 s",
            vec![
                ("0.80 of the standard length", PaperSettings { own_length: Some(("short", 0.80)), ..taken }),
                ("0.38 of the standard length", PaperSettings { own_length: Some(("short", 0.38)), ..taken }),
                ("0.25 of the standard length", PaperSettings { own_length: Some(("short", 0.25)), ..taken }),
            ],
        ),
        with(
            "length of the long steps",
            "1.2 of the standard length",
            "about the longest for which joint angles stay in the measured range",
            vec![("1.1 of the standard length", PaperSettings { own_length: Some(("long", 1.1)), ..taken })],
        ),
    ]
}

/// Step heights.
fn about_step_heights() -> Vec<Assumption> {
    let (taken, with) = (PaperSettings::default(), assumption);
    vec![
        with(
            "goose steps",
            "1.5 times the standard height, of the standard length",
            "section 2.2 makes gaits from step length, frequency and height; the paper gives the period alone",
            vec![
                ("1.25 times the standard height", PaperSettings { own_height: Some(("goose", 1.25)), ..taken }),
                ("2.0 times the standard height", PaperSettings { own_height: Some(("goose", 2.0)), ..taken }),
                ("1.2 times the standard length", PaperSettings { own_length: Some(("goose", 1.2)), ..taken }),
            ],
        ),
        with(
            "recipe of the gaits",
            "`standard`: 1.5 m/s at 1.0 s; `long`: 1.2 times its steps at 1.0 s; `short`: 0.62 times its steps at 0.62 \
             s; `goose`: its steps 1.5 times as high at 0.82 s; `parade` (ours, not the paper's): 0.7 times its steps \
             at 1.67 s, knees times 0.2, hip flexion times 2 and 10 % earlier",
            "periods from section 4.5; lengths and heights as in the rows above; straight knees are no step height, so \
             `parade` is no gait of the paper",
            vec![("`goose` walked as `parade`, at its own period", PaperSettings { straight_goose: true, ..taken })],
        ),
        with(
            "step height of the gaits",
            "as in the curves; goose steps as above",
            "the paper scales it but gives no number",
            vec![
                ("1.5 times all heights", PaperSettings { step_height: 1.5, ..taken }),
                ("2.0 times all heights", PaperSettings { step_height: 2.0, ..taken }),
            ],
        ),
    ]
}

/// Impacts and soft shoes.
fn about_the_ground() -> Vec<Assumption> {
    let (taken, with) = (PaperSettings::default(), assumption);
    let softer = |factor: f64| HuntCrossley { stiffness: factor * taken.soft_shoes.stiffness, ..taken.soft_shoes };
    vec![
        with(
            "velocities after an impact while other points are at rest",
            "the striking point loses all its velocity, the others obey Coulomb's law",
            "the paper: the relative velocity at the contact point is cancelled",
            vec![("Coulomb's law also for the impact", PaperSettings { impact: ImpactLaw::Coulomb, ..taken })],
        ),
        with(
            "stiffness of the soft shoes",
            "1 MN/m², dissipation 2 s/m",
            "Falisse 2022; the paper only mentions soft shoes as future work",
            vec![
                ("0.3 MN/m²", PaperSettings { soft_shoes: softer(0.3), ..taken }),
                ("3 MN/m²", PaperSettings { soft_shoes: softer(3.0), ..taken }),
            ],
        ),
    ]
}

/// Simulates the walks and judges the claims again with each of the other values, one after the other. If a walk cannot
/// be simulated with a value, [`Sensitivity::outcome`] has the reason.
///
/// # Errors
/// None is known.
pub fn sensitivities() -> Result<Vec<Sensitivity>, ReproductionError> {
    let mut all = Vec::new();
    for assumption in assumptions() {
        for (other, settings) in assumption.others {
            let mut mode = |trial: &TrialSettings<'_>| paper_walk_with(&settings, trial);
            let evidence = Evidence::gather(&mut mode, Scope::Brief, None);
            let outcome = evidence.map(|evidence| judgements(&evidence)).map_err(|error| error.to_string());
            all.push(Sensitivity { what: assumption.what, other, outcome });
        }
    }
    Ok(all)
}
