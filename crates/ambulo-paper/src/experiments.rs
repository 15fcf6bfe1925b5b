//! Why claims fail: the mechanical reason, and an experiment that shows it.
//!
//! An experiment measures the same walk in another way, or changes one value and judges the claim again.

use super::assumptions::judged_with;
use super::claim::{Claim, ClaimKind, Judgement};
use super::error::ReproductionError;
use super::evidence::{Evidence, Scope};
use super::ground_force::longest_contact;
use super::open_values::open_values;
use super::setting::Setting;

/// A value that is changed, and the claims whose judgement may depend on it.
struct Trial {
    claims: &'static [&'static str],
    key: &'static str,
    value: f64,
}

const TRIALS: [Trial; 3] = [
    Trial { claims: &["c3"], key: "standard_step_m", value: 0.54 },
    Trial { claims: &["g2"], key: "short_step_length", value: 0.35 },
    Trial { claims: &["c4", "g1", "g3", "j"], key: "short_step_height", value: 1.7 },
];

/// Share of a stance in which a foot is loaded [%].
const LOADED: usize = 10;

/// Why a claim fails in the mode of the paper.
fn reason(claim: &str) -> &'static str {
    match claim {
        "c1" | "h4" => {
            "the forward speed is that of the stance hip over the foot; it stops, and the torque changes its sign, \
             only if the foot strikes while the driven joints are nearly at rest"
        }
        "c2" => "the torque holds the trunk against forces at the friction limit, and not only changes the speed",
        "c3" => "the period is one second, so the speed is that of the step length",
        "c4" | "g1" | "g3" | "j" => "a foot that touches in mid-swing sticks, stops the leg and throws the figure back",
        "e1" => {
            "each contact of a foot has a peak of its own, so a foot that lifts and touches again has one peak more; \
             and a rigid foot is loaded in an instant, where people load it over the first tenth of the stance"
        }
        "e2" | "e3" | "i" => {
            "an impact cancels the whole velocity of the point, so nothing rebounds; a foot leaves the ground only \
             where the driven leg lifts it"
        }
        "g2" => {
            "accelerations, and torques with them, are proportional to step length over period squared: at 0.62 s they \
             are lower only below 0.38 of the standard length"
        }
        "h3" | "a1" => {
            "torques jump where a sole begins to slip or leaves the ground, at an instant known to a time step"
        }
        _ => "not known",
    }
}

/// Adds the reason and the experiment to each claim of the paper that fails.
///
/// # Errors
/// None is known.
pub fn add_experiments(claims: &mut [Claim], paper: &Evidence, setting: &Setting) -> Result<(), ReproductionError> {
    let failing = |claim: &&mut Claim| claim.kind == ClaimKind::Paper && !claim.pass;
    let mut tried: Vec<(&str, Result<Vec<Judgement>, ReproductionError>)> = Vec::new();
    for claim in claims.iter_mut().filter(failing) {
        let found = match TRIALS.iter().find(|trial| trial.claims.contains(&claim.id)) {
            Some(trial) => {
                if tried.iter().all(|(key, _)| *key != trial.key) {
                    tried.push((trial.key, changed(setting, trial)));
                }
                let judged = tried.iter().find(|(key, _)| *key == trial.key).map(|(_, judged)| judged);
                judged.map(|judged| outcome(trial, claim, judged))
            }
            None if claim.id == "e1" => bounce(paper),
            None => None,
        };
        let shown = found.map_or(String::new(), |found| format!(". Experiment: {found}"));
        claim.experiment = Some(format!("{}{shown}", reason(claim.id)));
    }
    Ok(())
}

fn changed(setting: &Setting, trial: &Trial) -> Result<Vec<Judgement>, ReproductionError> {
    let place = open_values().iter().position(|open| open.key == trial.key);
    let setting = place.map_or_else(|| setting.clone(), |place| setting.with(place, trial.value));
    judged_with(&setting, Scope::Brief)
}

fn outcome(trial: &Trial, claim: &Claim, judged: &Result<Vec<Judgement>, ReproductionError>) -> String {
    let with = format!("with `{}` = {}", trial.key, trial.value);
    match judged {
        Err(error) => format!("{with} there is no walk: {error}"),
        Ok(all) => match all.iter().find(|judgement| judgement.id == claim.id) {
            None => format!("{with} the claim is not judged"),
            Some(Judgement { headline, value, pass, .. }) => {
                let holds = if *pass { "holds" } else { "still fails" };
                format!("{with} it {holds}: `{headline}` is {value:.3} instead of {:.3}", claim.value())
            }
        },
    }
}

/// The force of the same walk over the longest contact of the foot.
fn bounce(paper: &Evidence) -> Option<String> {
    let (peaks, [r, later]) = longest_contact(paper.standard(), LOADED)?;
    Some(format!(
        "over the longest contact of the foot alone, without the bounce that the paper calls an artifact, the force of \
         the same walk has {peaks} peaks and r = {r:.2} with the measured one, and r = {later:.2} from {LOADED} % of \
         this contact on"
    ))
}
