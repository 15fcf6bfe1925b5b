//! Compares synthetic walks with normative bands: `cargo xtask walk-bands [--write]`.
//!
//! Walks of a figure at the five speeds of Schwartz, Rozumalski, Trost 2008 (equal V/√(gL)) are made consistent
//! ([`ambulo::simulation::consistent_walk`]) and walked by the simulator on soft shoes; the last cycle is compared with
//! the tables. A failed criterion is listed as missed and is no error. With `--write` the page goes to
//! docs/measured/WALK_BANDS.md, its picture to docs/images.

mod adjustment;
pub(crate) mod child_leg;
mod criteria;
mod curve;
mod cycle;
mod figure;
mod page;
pub(crate) use page::build_name;
mod second_laboratory;
mod trend;

use crate::normative::{self, Band, SPEEDS};
use crate::workspace;
use ambulo::model::anthropometry::{Build, SegmentTable};
use child_leg::FromJoint;
use cycle::Cycle;

/// Index of free walking among the speeds.
const FREE: usize = 2;
/// The main figure.
const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };

/// Other figures, at free speed.
const BUILDS: [Build; 8] = [
    Build { toe_joint: false, ..MAN },
    Build { table: SegmentTable::DeLevaFemale, mass: 60.0, height: 1.65, toe_joint: true },
    Build { mass: 30.0, height: 1.30, ..MAN },
    Build { mass: 120.0, height: 1.90, ..MAN },
    Build { table: SegmentTable::DempsterWinter, ..MAN },
    Build { table: SegmentTable::DempsterWinter, toe_joint: false, ..MAN },
    Build { table: SegmentTable::Faure1997, mass: 80.0, height: 1.80, toe_joint: false },
    Build { table: SegmentTable::Faure1997, mass: 80.0, height: 1.80, toe_joint: true },
];

/// A walk with the bands scaled to its leg length, or the reason for its absence.
type Walked = Result<(Cycle, [Band; 8]), String>;

/// Everything measured in one run.
struct Results {
    machine: String,
    /// Leg lengths of the subjects of the tables; the mean from the first joint is used.
    legs: [FromJoint; 3],
    /// Bands for the leg length of the main figure, at five speeds.
    people: [[Band; 8]; 5],
    /// Foot off of the subjects [share of the cycle].
    foot_off: [f64; 5],
    man: [Cycle; 5],
    /// Bands of free walking with other leg lengths of the subjects: source and length [m].
    other_legs: Vec<(&'static str, f64, [Band; 8])>,
    /// Free walking compared with a second laboratory.
    second_laboratory: String,
    /// Walks of the other figures.
    others: Vec<(Build, Walked)>,
}

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the page is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let write = workspace::write_option(words)?;
    let results = measure()?;
    let page = page::text(&results);
    println!("{page}");
    if write {
        let picture = figure::free(&results.man[FREE], &results.people[FREE])?;
        workspace::save("docs/images/walk_bands_free.svg", &picture)?;
        workspace::save("docs/measured/WALK_BANDS.md", &page)?;
    }
    Ok(())
}

#[expect(clippy::print_stderr, reason = "a minute passes before the page is complete")]
fn measure() -> Result<Results, String> {
    let legs = child_leg::legs()?;
    let their_leg = legs[0].mean();
    let mut man = Vec::new();
    for (name, speed) in normative::NAMES.into_iter().zip(SPEEDS) {
        eprintln!("{}: {name}", MAN.table);
        man.push(cycle::walk(&MAN, speed).map_err(|e| format!("{name}: {e}"))?);
    }
    let man: [Cycle; 5] = man.try_into().map_err(|_| "as many walks as speeds")?;
    let our_leg = man[FREE].walk.leg_length;
    let people = curve::people(our_leg, their_leg)?;
    let [shortest, longest] = legs[0].range();
    let named = [
        ("knee, mean", their_leg),
        ("knee, shortest", shortest),
        ("knee, longest", longest),
        ("ankle, mean", legs[2].mean()),
        ("hip, mean", legs[1].mean()),
    ];
    let mut other_legs = Vec::new();
    for (name, length) in named {
        let [_, _, free, _, _] = curve::people(our_leg, length)?;
        other_legs.push((name, length, free));
    }
    let mut others = Vec::new();
    for build in BUILDS {
        eprintln!("{}", build_name(&build));
        let walked = cycle::walk(&build, SPEEDS[FREE]).and_then(|cycle| {
            let [_, _, free, _, _] = curve::people(cycle.walk.leg_length, their_leg)?;
            Ok((cycle, free))
        });
        others.push((build, walked));
    }
    Ok(Results {
        machine: crate::bench::machine(),
        legs,
        people,
        foot_off: normative::foot_off()?,
        second_laboratory: second_laboratory::section(&man[FREE])?,
        man,
        other_legs,
        others,
    })
}
