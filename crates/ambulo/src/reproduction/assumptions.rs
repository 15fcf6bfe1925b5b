//! What the paper does not give: the value taken, why, and what becomes of the claims with other values.

use super::claim::Claim;
use super::error::ReproductionError;
use super::evidence::{Evidence, Scope};
use super::mode::{Request, paper_walk_with};
use super::paper_settings::PaperSettings;
use super::{Judgement, judgements};
use crate::contact::HuntCrossley;
use crate::gait::Style;
use crate::simulation::ImpactLaw;

/// A value that the paper does not give.
#[derive(Debug, Clone, PartialEq)]
pub struct Assumption {
    /// What it is.
    pub what: &'static str,
    /// The value taken.
    pub value: &'static str,
    /// Why.
    pub why: &'static str,
    /// Other values, as they are tried.
    pub others: Vec<(&'static str, PaperSettings)>,
}

/// What other values make of the claims.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// What was changed.
    pub what: &'static str,
    /// The value tried in place of the one taken.
    pub other: &'static str,
    /// Claims with their headline numbers, or why it could not walk so.
    pub outcome: Result<Vec<Judgement>, String>,
}

impl Sensitivity {
    /// Claims that are judged otherwise than with the values taken.
    #[must_use]
    pub fn turned<'a>(&'a self, claims: &'a [Claim]) -> Vec<&'static str> {
        let judged = |id: &str| claims.iter().find(|claim| claim.id == id).map(|claim| claim.pass);
        let own = self.outcome.iter().flatten();
        own.filter(|judgement| judged(judgement.id).is_some_and(|pass| pass != judgement.pass)).map(|v| v.id).collect()
    }
}

/// Everything that the paper leaves open, with the other values that are tried.
#[must_use]
pub fn assumptions() -> Vec<Assumption> {
    let taken = PaperSettings::default();
    let softer = |factor: f64| HuntCrossley { stiffness: factor * taken.soft_shoes.stiffness, ..taken.soft_shoes };
    let degrees = |angle: f64| angle.to_radians();
    let with = |what, value, why, others| Assumption { what, value, why, others };
    vec![
        with(
            "stature",
            "1.80 m",
            "a tall man's; the paper's mass centre at 1.2 m would ask for 2.1 m",
            vec![
                ("1.70 m", PaperSettings { height: Some(1.70), ..taken }),
                ("1.90 m", PaperSettings { height: Some(1.90), ..taken }),
            ],
        ),
        with(
            "density, so radii of the cylinders",
            "1050 kg/m³",
            "that of bodies in water, nearly; the paper says uniform",
            vec![
                ("700 kg/m³", PaperSettings { thickness: 1.5, ..taken }),
                ("1600 kg/m³", PaperSettings { thickness: 0.65, ..taken }),
            ],
        ),
        with(
            "radii of the spheres under the feet",
            "35, 25 and 15 mm",
            "published foot models at that stature",
            vec![
                ("0.6 of them", PaperSettings { sole_radii: 0.6, ..taken }),
                ("1.4 of them", PaperSettings { sole_radii: 1.4, ..taken }),
            ],
        ),
        with(
            "places of the spheres under the feet",
            "heel, ball and tip of the toes",
            "the foot's length of Drillis and Contini; Table 1 gives 8.9 % of stature, which is no foot",
            vec![("heel and ball alone", PaperSettings { toe_spheres: false, ..taken })],
        ),
        with(
            "laws of the arms",
            "Boulic, Magnenat-Thalmann, Thalmann 1990",
            "of the same group's time; the paper has a natural neutral swing",
            vec![
                ("arms that hang still", PaperSettings { arm_swing: 0.0, ..taken }),
                ("1.5 times the swing", PaperSettings { arm_swing: 1.5, ..taken }),
            ],
        ),
        with(
            "Nilsson's tables: the curves of the joints",
            "extremes of Schwartz, Rozumalski, Trost 2008, joined by the paper's quintics",
            "the only public ones for all speeds; of children",
            vec![(
                "the same data with their own velocities and accelerations",
                PaperSettings { style: Some(Style::Knots), ..taken },
            )],
        ),
        with(
            "zero of the hip's angle",
            "thigh against the vertical: less the mean tilt of the pelvis",
            "the trunk is held upright",
            vec![
                ("5° more flexed", PaperSettings { hip_offset: degrees(5.0), ..taken }),
                ("5° more extended", PaperSettings { hip_offset: degrees(-5.0), ..taken }),
            ],
        ),
        with(
            "step length of the gaits",
            "0.75 m for the standard one",
            "1.5 m/s (section 4.2) at two steps a second",
            vec![
                ("0.8 of all", PaperSettings { step_length: 0.8, ..taken }),
                ("1.15 of all", PaperSettings { step_length: 1.15, ..taken }),
            ],
        ),
        with(
            "length of the short steps",
            "0.62 of the standard",
            "the standard's speed at their period of 0.62 s",
            vec![
                ("0.80 of the standard", PaperSettings { own_length: Some(("short", 0.80)), ..taken }),
                ("0.38 of the standard", PaperSettings { own_length: Some(("short", 0.38)), ..taken }),
                ("0.25 of the standard", PaperSettings { own_length: Some(("short", 0.25)), ..taken }),
            ],
        ),
        with(
            "length of the long steps",
            "1.2 of the standard",
            "about the longest with joints inside what people show",
            vec![("1.1 of the standard", PaperSettings { own_length: Some(("long", 1.1)), ..taken })],
        ),
        with(
            "step height of the gaits",
            "as the curves have it",
            "the paper scales it but gives no number",
            vec![
                ("1.5 of all", PaperSettings { step_height: 1.5, ..taken }),
                ("2.0 of all", PaperSettings { step_height: 2.0, ..taken }),
            ],
        ),
        with(
            "velocities of what strikes while other points rest",
            "the striking point loses all its velocity, the others obey Coulomb's law",
            "the paper: the relative velocity at the contact point is cancelled",
            vec![("Coulomb's law for blows too", PaperSettings { impact: ImpactLaw::Coulomb, ..taken })],
        ),
        with(
            "stiffness of the soft shoes",
            "1 MN/m², dissipation 2 s/m",
            "Falisse 2022; the paper only announces soft shoes",
            vec![
                ("0.3 MN/m²", PaperSettings { soft_shoes: softer(0.3), ..taken }),
                ("3 MN/m²", PaperSettings { soft_shoes: softer(3.0), ..taken }),
            ],
        ),
    ]
}

/// Walks and judges again with each of the other values, one after the other.
///
/// # Errors
/// A gait that is not there. A walk that cannot be walked with some value is told in its place.
pub fn sensitivities() -> Result<Vec<Sensitivity>, ReproductionError> {
    let mut all = Vec::new();
    for assumption in assumptions() {
        for (other, settings) in assumption.others {
            let mut mode = |request: &Request<'_>| paper_walk_with(&settings, request);
            let evidence = Evidence::gather(&mut mode, Scope::Brief, None);
            let outcome = evidence.map(|evidence| judgements(&evidence)).map_err(|error| error.to_string());
            all.push(Sensitivity { what: assumption.what, other, outcome });
        }
    }
    Ok(all)
}
