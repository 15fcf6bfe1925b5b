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

pub(super) const SHOES: Statement = Statement {
    id: "i",
    kind: ClaimKind::Paper,
    paper: "soft shoes and a better starting motion are expected to reduce the bouncing and the extra flying phases",
    criterion: "soft shoes lessen flight and landings per step of the paper's motion; the corrected motion lessens \
        both in \
        rigid shoes, and raises neither in soft shoes",
    former: Some(Former {
        kind: ClaimKind::Paper,
        criterion: "soft shoes lessen flight, landings per step and the largest force, and the corrected motion \
            lessens all \
            three in both kinds of shoes",
        reason: "the sentence speaks of bouncing and of flying phases, and not of the force; where soft shoes alone \
            end all flight, nothing can be less",
        judge: |paper, corrected| {
            let all = ["flight_percent", "landings_a_step", "largest_force_bw"];
            let better = corrected.is_none_or(|corrected| {
                ["soft", "rigid"]
                    .iter()
                    .all(|shoes| all.iter().all(|what| is_less(what, [corrected, paper], [shoes; 2])))
            });
            better && all.iter().all(|what| is_less(what, [paper; 2], ["soft", "rigid"]))
        },
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
            let [flight, landings, force] = [MEASURES[0], MEASURES[1], "largest_force_bw"];
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
        (lessened(paper, corrected), note)
    },
};

/// Whether flight and landings fall as the claim expects.
fn lessened(paper: &Numbers, corrected: Option<&Numbers>) -> bool {
    MEASURES.iter().all(|what| {
        let softer = is_less(what, [paper; 2], ["soft", "rigid"]);
        let better = corrected.is_none_or(|corrected| {
            is_less(what, [corrected, paper], ["rigid"; 2]) && !is_less(what, [paper, corrected], ["soft"; 2])
        });
        softer && better
    })
}

/// Whether a measure in the first motion and shoes is less than in the second ones.
fn is_less(what: &str, numbers: [&Numbers; 2], shoes: [&str; 2]) -> bool {
    let of = |k: usize| number(numbers[k], &format!("{}_{what}", shoes[k]));
    of(0) < of(1)
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
