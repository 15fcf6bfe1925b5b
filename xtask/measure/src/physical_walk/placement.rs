//! The other law of balance: foot placement instead of the feedback of the whole state.

use super::{AFTER_PUSH, Figure, PHASES, PUSHES, Walked, controller, pushes_survived, walked, with_controller};
use ambulo::simulation::control::{Balance, ControlSettings, FootPlacement};
use ambulo::spatial::Vec3;
use ambulo::study::validation::TextTable as Table;

/// Gains that are tried, each with each.
const DISTANCES: [f64; 5] = [0.0, 0.25, 0.5, 1.0, 2.0];
const VELOCITIES: [f64; 5] = [0.0, 0.1, 0.2, 0.4, 0.8];
const TRUNKS: [f64; 3] = [150.0, 300.0, 600.0];
/// Damping of the trunk over its stiffness [s].
const TRUNK_DAMPING_S: f64 = 0.1;
/// Steps that are asked for.
const STEPS: usize = 100;

/// The best gains on the pushes.
pub(super) struct Results {
    tried: usize,
    /// Gains with which all steps were walked.
    walked_on: usize,
    best: FootPlacement,
    walked: Walked,
    /// Force [N] and how many pushes were survived.
    pushes: Vec<(f64, usize)>,
}

/// The gains that walk furthest and, among those, nearest to the plan.
pub(super) fn measure(figure: &Figure, settings: &ControlSettings) -> Result<Results, String> {
    let with = |law: FootPlacement| {
        controller(figure, &ControlSettings { balance: Balance::FootPlacement(law), ..settings.clone() })
    };
    let (mut tried, mut walked_on) = (0, 0);
    let mut best: Option<(FootPlacement, Walked)> = None;
    for distance in DISTANCES {
        for velocity in VELOCITIES {
            for trunk in TRUNKS {
                let law = FootPlacement { distance, velocity, trunk: [trunk, TRUNK_DAMPING_S * trunk] };
                let found = walked(with_controller(figure, &with(law)?)?, figure, STEPS)?;
                tried += 1;
                walked_on += usize::from(!found.fell);
                let is_better = |known: &Walked| (found.steps, -found.apart) > (known.steps, -known.apart);
                if best.as_ref().is_none_or(|(_, known)| is_better(known)) {
                    best = Some((law, found));
                }
            }
        }
    }
    let (law, walked) = best.ok_or("no gains of foot placement")?;
    let own = with(law)?;
    let pushes = PUSHES
        .iter()
        .map(|force| Ok((*force, pushes_survived(figure, &own, Vec3::x() * *force)?)))
        .collect::<Result<_, String>>()?;
    Ok(Results { tried, walked_on, best: law, walked, pushes })
}

impl Results {
    /// The section of the page.
    pub(super) fn section(&self) -> String {
        let Results { tried, walked_on, best, walked, pushes } = self;
        let mut table = Table::new(&["push [N]", "survived"]);
        for (force, survived) in pushes {
            table.row([format!("{force:.0}"), format!("{survived} of {PHASES}")]);
        }
        format!(
            "## Foot placement instead of feedback\n\nThe law of Yin, Loken, van de Panne 2007: the swing hip turns \
             further with distance and velocity of the mass \
             centre, and the stance hip keeps the pelvis upright, with the same plan, impedances and phase. Of {tried} \
             sets of gains, {walked_on} walk {STEPS} steps in the plane. \
             The best ({} rad/m, {} rad.s/m, trunk {} N.m/rad and {} N.m.s/rad) walks {} steps at {:.2} m/s, {:.2} deg \
             from the plan (RMS). Pushes with these gains, survived for \
             {AFTER_PUSH} steps:\n\n{}\n",
            best.distance,
            best.velocity,
            best.trunk[0],
            best.trunk[1],
            walked.steps,
            walked.speed,
            walked.apart.to_degrees(),
            table.text()
        )
    }
}
