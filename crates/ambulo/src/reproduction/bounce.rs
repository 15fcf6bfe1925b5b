//! Claim (i): "Soft shoes and a better motion reduce the bounce"; and claim (k): interactive speed.

use super::claim::{Numbers, Statement, number};
use super::evidence::Scope;
use super::ground_force::bounce;

/// Computed frames per second in the paper, on an SGI Indigo2.
const PAPER_FRAMES_PER_S: f64 = 2.5;
/// Frames per second of the results of the paper.
const PAPER_RATE_HZ: f64 = 30.0;

pub(super) const SHOES: Statement = Statement {
    id: "i",
    paper: "soft shoes and a better starting motion are expected to reduce the bouncing and the extra flying phases",
    headline: "soft_flight_percent",
    scope: Scope::Brief,
    measure: |evidence| {
        let mut numbers = Numbers::new();
        for (shoes, run) in ["rigid", "soft"].iter().zip(&evidence.shoes) {
            numbers.extend(bounce(run).into_iter().map(|(name, value)| (format!("{shoes}_{name}"), value)));
        }
        numbers
    },
    judge: |paper, corrected| {
        let flight = |numbers: &Numbers, shoes: &str| number(numbers, &format!("{shoes}_flight_percent"));
        let landings = |numbers: &Numbers, shoes: &str| number(numbers, &format!("{shoes}_landings_a_step"));
        let softer = flight(paper, "soft") < flight(paper, "rigid");
        let table = |numbers: &Numbers| {
            ["rigid", "soft"]
                .map(|shoes| format!("{shoes} {:.1} % and {:.1}", flight(numbers, shoes), landings(numbers, shoes)))
                .join(", ")
        };
        let better = corrected.is_none_or(|numbers| {
            flight(numbers, "soft") < flight(paper, "soft") && flight(numbers, "rigid") < flight(paper, "rigid")
        });
        let other = corrected.map_or("not run".to_owned(), table);
        let note = format!(
            "passes if soft shoes shorten the flight phases of the paper's motion, and the corrected motion shortens them in both kinds of \
             shoes; flight and landings per step with the paper's motion: {}; with the corrected motion: {other}",
            table(paper)
        );
        (softer && better, note)
    },
};

pub(super) const SPEED: Statement = Statement {
    id: "k",
    paper: "interactive: 2.5 frames per second on an SGI Indigo2",
    headline: "frames_per_s",
    scope: Scope::Full,
    measure: |evidence| {
        let of = |name: &str, value: f64| (name.to_owned(), value);
        let steps = evidence.steps_per_s;
        let real_time = steps / super::evidence::RATE_HZ;
        vec![
            of("frames_per_s", steps),
            of("times_real_time_at_1000_hz", real_time),
            of("times_the_paper", steps / PAPER_FRAMES_PER_S),
        ]
    },
    judge: |paper, _| {
        let frames = number(paper, "frames_per_s");
        let note = if frames > 0.0 {
            format!(
                "passes above {PAPER_RATE_HZ:.0} frames per second, the frame rate of the paper's results; found {frames:.0} time steps per second \
                 on one core, recording included"
            )
        } else {
            "the computing time was not measured".to_owned()
        };
        (frames > PAPER_RATE_HZ, note)
    },
};
