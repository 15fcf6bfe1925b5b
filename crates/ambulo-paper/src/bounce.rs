//! Claim (i): "Soft shoes and a better motion reduce the bounce"; and claim (k): interactive speed.

use super::claim::{ClaimKind, Former, Numbers, Statement, number};
use super::evidence::Scope;
use super::ground_force::bounce;

/// Computed frames per second in the paper, on an SGI Indigo2.
const PAPER_FRAMES_PER_S: f64 = 2.5;
/// Frames per second of the results of the paper.
const PAPER_RATE_HZ: f64 = 30.0;
/// Names of the numbers that measure flight and bouncing.
const MEASURES: [&str; 2] = ["flight_percent", "landings_a_step"];
/// The same with the largest force, which was judged too.
const FORMER_MEASURES: [&str; 3] = ["flight_percent", "landings_a_step", "largest_force_bw"];

pub(super) const SHOES: Statement = Statement {
    id: "i",
    kind: ClaimKind::Paper,
    paper: "soft shoes and a better starting motion are expected to reduce the bouncing and the extra flying phases",
    criterion: "soft shoes lessen flight and landings per step, and the corrected motion lessens both in both kinds of shoes",
    former: Some(Former {
        kind: ClaimKind::Paper,
        criterion: "the same, and the same for the largest force",
        reason: "the sentence speaks of bouncing and of flying phases, and not of the force",
        judge: |paper, corrected| lessened(&FORMER_MEASURES, paper, corrected),
    }),
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
        let of = |numbers: &Numbers, shoes: &str, what: &str| number(numbers, &format!("{shoes}_{what}"));
        let table = |numbers: &Numbers| {
            let [flight, landings, force] = FORMER_MEASURES;
            ["rigid", "soft"]
                .map(|shoes| {
                    let of = |what| of(numbers, shoes, what);
                    format!("{shoes} {:.1} %, {:.1} and {:.2}", of(flight), of(landings), of(force))
                })
                .join(", ")
        };
        let other = corrected.map_or("not run".to_owned(), table);
        let note = format!(
            "flight, landings per step and largest force in body weights with the paper's motion: {}; with \
             the corrected motion: \
             {other}. Soft shoes give back part of the energy that a rigid impact takes away",
            table(paper)
        );
        (lessened(&MEASURES, paper, corrected), note)
    },
};

/// Whether soft shoes lessen all measures, and the corrected motion lessens them in both kinds of shoes.
fn lessened(measures: &[&str], paper: &Numbers, corrected: Option<&Numbers>) -> bool {
    let of = |numbers: &Numbers, shoes: &str, what: &str| number(numbers, &format!("{shoes}_{what}"));
    let softer = measures.iter().all(|what| of(paper, "soft", what) < of(paper, "rigid", what));
    let better = corrected.is_none_or(|numbers| {
        let less = |shoes: &str| measures.iter().all(|what| of(numbers, shoes, what) < of(paper, shoes, what));
        less("soft") && less("rigid")
    });
    softer && better
}

pub(super) const SPEED: Statement = Statement {
    id: "k",
    kind: ClaimKind::ByConstruction,
    paper: "interactive: 2.5 frames per second on an SGI Indigo2",
    criterion: "more than 30 drawn frames per second, which is real time",
    former: None,
    headline: "drawn_frames_per_s",
    scope: Scope::Full,
    measure: |evidence| {
        let of = |name: &str, value: f64| (name.to_owned(), value);
        let steps = evidence.steps_per_s;
        // A drawn frame is 33 ms of the walk, simulated in steps of 1 ms.
        let real_time = steps / super::evidence::RATE_HZ;
        let drawn = PAPER_RATE_HZ * real_time;
        vec![
            of("drawn_frames_per_s", drawn),
            of("steps_per_s", steps),
            of("times_real_time_at_1000_hz", real_time),
            of("times_the_paper", drawn / PAPER_FRAMES_PER_S),
        ]
    },
    judge: |paper, _| {
        let frames = number(paper, "drawn_frames_per_s");
        let note = if frames > 0.0 {
            format!(
                "found {frames:.0} on one \
                 core, each of them {:.0} \
                 time steps of 1 ms, recording included. It holds by the progress of computers",
                super::evidence::RATE_HZ / PAPER_RATE_HZ
            )
        } else {
            "the computing time was not measured".to_owned()
        };
        (frames > PAPER_RATE_HZ, note)
    },
};
