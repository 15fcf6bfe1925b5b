//! How often claims hold over values that the paper does not give, sampled jointly, and the setting that meets most of
//! them.
//!
//! The samples take minutes, so `cargo xtask claim-shares` stores the results in `data/shares.csv`.

use super::claim::{Claim, ClaimKind, Judgement};
use super::error::ReproductionError;
use super::evidence::{Evidence, Scope};
use super::mode::{TrialSettings, paper_walk_with};
use super::paper_settings::PaperSettings;
use super::statements::judgements;
use ambulo_body::contact::HuntCrossley;
use ambulo_body::numerics::Random;
use ambulo_body::numerics::elementary::powf;
use ambulo_walk::engine::ImpactLaw;
use ambulo_walk::gait::Style;
use std::sync::LazyLock;

const STORED: &str = include_str!("../data/shares.csv");

/// The range from which a value is drawn.
pub struct Open {
    /// What is open.
    pub name: &'static str,
    /// Least and largest value.
    pub range: [f64; 2],
}

/// Ranges of what is open, wide enough for other readings of the paper: a switch is on above 0.5.
pub const OPEN: [Open; 15] = [
    // Two standard deviations of the stature of European men.
    Open { name: "stature_m", range: [1.65, 1.95] },
    // 1600 to 700 kg/m³.
    Open { name: "cross_section_factor", range: [0.65, 1.5] },
    Open { name: "sole_radius_factor", range: [0.6, 1.4] },
    Open { name: "toe_spheres", range: [0.0, 1.0] },
    Open { name: "toes_at_the_foot_of_table_1", range: [0.0, 1.0] },
    Open { name: "arm_swing_factor", range: [0.0, 1.5] },
    Open { name: "hip_offset_deg", range: [-8.0, 8.0] },
    // The paper describes its quintics, but not what Nilsson's bounds are: a quarter of the settings has the data's own
    // velocities.
    Open { name: "style_1997", range: [0.0, 2.0] },
    Open { name: "step_length_factor", range: [0.85, 1.15] },
    Open { name: "step_height_factor", range: [0.8, 2.0] },
    Open { name: "short_step_length", range: [0.25, 0.8] },
    Open { name: "long_step_length", range: [1.05, 1.3] },
    Open { name: "goose_step_height", range: [1.2, 2.0] },
    // The paper cancels the velocity at an impact; a quarter of the settings applies Coulomb's law to it.
    Open { name: "impact_cancels_all_velocity", range: [0.0, 2.0] },
    Open { name: "soft_shoe_stiffness_log10_factor", range: [-0.5, 0.5] },
];

/// One joint choice of all values that the paper does not give.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenValues(Vec<f64>);

impl OpenValues {
    /// Values drawn from their ranges; equal seeds and numbers give equal values.
    #[must_use]
    pub fn drawn(seed: u64, number: u64) -> OpenValues {
        let mut random = Random::new(seed, number);
        OpenValues(OPEN.iter().map(|open| open.range[0] + random.share() * (open.range[1] - open.range[0])).collect())
    }

    /// Values near these: each third of them, on average, is moved by up to a fifth of its range.
    #[must_use]
    pub fn near(&self, seed: u64, number: u64) -> OpenValues {
        let mut random = Random::new(seed, number);
        let moved = |(open, value): (&Open, &f64)| {
            let [least, most] = open.range;
            let (chance, step) = (random.share(), 0.4 * (random.share() - 0.5) * (most - least));
            if chance < 1.0 / 3.0 { (value + step).clamp(least, most) } else { *value }
        };
        OpenValues(OPEN.iter().zip(&self.0).map(moved).collect())
    }

    /// Names and values.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        OPEN.iter().map(|open| open.name).zip(self.0.iter().copied())
    }

    /// As settings of the paper's mode.
    #[must_use]
    pub fn settings(&self) -> PaperSettings {
        let of = |name: &str| self.named().find(|(own, _)| *own == name).map_or(f64::NAN, |(_, value)| value);
        let on = |name: &str| of(name) > 0.5;
        let shoes = HuntCrossley::FALISSE_2022;
        let stiffness = shoes.stiffness * powf(10.0_f64, of("soft_shoe_stiffness_log10_factor"));
        PaperSettings {
            height: Some(of("stature_m")),
            thickness: of("cross_section_factor"),
            sole_radii: of("sole_radius_factor"),
            toe_spheres: on("toe_spheres"),
            toe_reach: on("toes_at_the_foot_of_table_1").then_some(super::paper_human::TABLE_FOOT),
            arm_swing: of("arm_swing_factor"),
            hip_offset: of("hip_offset_deg").to_radians(),
            style: (!on("style_1997")).then_some(Style::Knots),
            step_length: of("step_length_factor"),
            step_height: of("step_height_factor"),
            own_length: None,
            short_length: Some(of("short_step_length")),
            long_length: Some(of("long_step_length")),
            own_height: Some(("goose", of("goose_step_height"))),
            straight_goose: false,
            impact: if on("impact_cancels_all_velocity") { ImpactLaw::Sticking } else { ImpactLaw::Coulomb },
            soft_shoes: HuntCrossley { stiffness, ..shoes },
        }
    }

    /// All walks of the paper's mode with these values.
    ///
    /// # Errors
    /// A walk that cannot be simulated with these values.
    pub fn evidence(&self) -> Result<Evidence, ReproductionError> {
        let settings = self.settings();
        let mut mode = |trial: &TrialSettings<'_>| paper_walk_with(&settings, trial);
        Evidence::gather(&mut mode, Scope::Full, None)
    }

    /// The judgements of the claims for which brief evidence is sufficient.
    ///
    /// # Errors
    /// A walk that cannot be simulated with these values.
    pub fn judged(&self) -> Result<Vec<Judgement>, ReproductionError> {
        let settings = self.settings();
        let mut mode = |trial: &TrialSettings<'_>| paper_walk_with(&settings, trial);
        Ok(judgements(&Evidence::gather(&mut mode, Scope::Brief, None)?))
    }
}

/// The stored results.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredShares {
    /// Version of Ambulo that computed them.
    pub version: String,
    /// Seed of the samples.
    pub seed: u64,
    /// Number of settings that were drawn.
    pub drawn: usize,
    /// Number of these settings that could be simulated.
    pub settings: usize,
    /// Share of these settings in which each claim holds.
    pub held: Vec<(String, f64)>,
    /// Claims of the paper that could fail and that were judged, and how many of them the best setting meets.
    pub best_held: [usize; 2],
    /// The setting that meets most of these claims.
    pub best: OpenValues,
}

impl StoredShares {
    /// Share of the settings in which a claim holds; `None` if it was not judged with other settings.
    #[must_use]
    pub fn of(&self, claim: &str) -> Option<f64> {
        self.held.iter().find(|(id, _)| id == claim).map(|(_, share)| *share)
    }

    /// Whether a claim of the paper holds in no setting: then it contradicts the paper's own model.
    #[must_use]
    pub fn contradicts(&self, claim: &Claim) -> bool {
        claim.kind == ClaimKind::Paper && self.of(claim.id).is_some_and(|share| share <= 0.0)
    }

    /// Judgement of a claim over all settings, in words.
    #[must_use]
    pub fn words(&self, claim: &Claim) -> String {
        match self.of(claim.id) {
            None => "not sampled".to_owned(),
            Some(_) if self.contradicts(claim) => "0 %: contradicts its own model".to_owned(),
            Some(share) => format!("{:.0} %", 100.0 * share),
        }
    }
}

/// The shares that are stored with the program.
#[must_use]
pub fn stored_shares() -> &'static StoredShares {
    static SHARES: LazyLock<StoredShares> = LazyLock::new(|| read_shares(STORED));
    &SHARES
}

/// Results from the text of [`shares_csv`]; what is missing is zero, or not a number.
#[must_use]
pub fn read_shares(text: &str) -> StoredShares {
    let rows: Vec<(&str, &str)> = text.lines().skip(1).filter_map(|line| line.split_once(',')).collect();
    let text_of = |name: &str| rows.iter().find(|(own, _)| *own == name).map_or("", |(_, value)| *value);
    let count = |name: &str| text_of(name).parse().unwrap_or(0);
    let number = |value: &str| value.parse().unwrap_or(f64::NAN);
    let held = rows.iter().filter_map(|(name, value)| Some((name.strip_prefix("share.")?.to_owned(), number(value))));
    StoredShares {
        version: text_of("version").to_owned(),
        seed: text_of("seed").parse().unwrap_or(0),
        drawn: count("drawn"),
        settings: count("settings"),
        held: held.collect(),
        best_held: [count("best_held"), count("best_judged")],
        best: OpenValues(OPEN.iter().map(|open| number(text_of(&format!("best.{}", open.name)))).collect()),
    }
}

/// The stored results as text, for the data file.
#[must_use]
pub fn shares_csv(shares: &StoredShares) -> String {
    use std::fmt::Write;
    let [held, judged] = shares.best_held;
    let mut text = String::from("name,value\n");
    let _ = writeln!(text, "version,{}\nseed,{}", shares.version, shares.seed);
    let _ = writeln!(text, "drawn,{}\nsettings,{}", shares.drawn, shares.settings);
    for (id, share) in &shares.held {
        let _ = writeln!(text, "share.{id},{share:.4}");
    }
    let _ = writeln!(text, "best_held,{held}\nbest_judged,{judged}");
    for (name, value) in shares.best.named() {
        let _ = writeln!(text, "best.{name},{value:.6}");
    }
    text
}

/// Number of the paper's claims that could fail among judgements: those that hold, and all.
#[must_use]
pub fn judged_of_the_paper(judgements: &[Judgement]) -> [usize; 2] {
    let own = || judgements.iter().filter(|judgement| judgement.kind == ClaimKind::Paper);
    [own().filter(|judgement| judgement.pass).count(), own().count()]
}
