//! Claims about other bodies and figures: loops cost from linear to quadratic time, obstacles move, a gripper grasps,
//! two figures walk hand in hand. They are simulated once, in the scenes of `data/scenes`, and do not depend on the
//! mode of walking.

use super::claim::{ClaimKind, Former, Numbers, Statement, number, numbers};
use super::evidence::Scope;
use ambulo_body::findings::Findings;
use ambulo_body::numerics::elementary::ln;
use ambulo_walk::scene::{RunStatistics, Scene, SceneFile, SceneFrame, SceneSettings};
use std::fmt::Write;
use std::sync::LazyLock;

const GRASP: &str = include_str!("../data/scenes/grasp.toml");
const PUSHER: &str = include_str!("../data/scenes/pusher.toml");
const HANDS: &str = include_str!("../data/scenes/hand-in-hand.toml");

/// Rungs of the ladders whose cost is compared.
const RUNGS: [usize; 3] = [10, 20, 40];
/// Time steps of each ladder.
const LADDER_STEPS: usize = 50;
/// Seconds of the walk hand in hand: about five steps of each person.
const HANDS_S: f64 = 2.5;
/// Opening of a loop that counts as closed [m].
const CLOSED_M: f64 = 1e-3;

/// Criterion of [`LOOPS`].
const CHEAP: &str = "the cost of a step, conjugate-gradient iterations times bodies, grows with an exponent of 0.95 to \
    1.05 in the \
    number of constraints without closed loops and of at most 2 with all of them closed";

/// Cost of closed loops.
pub const LOOPS: Statement = Statement {
    id: "n1",
    kind: ClaimKind::ByConstruction,
    paper: "closed loops cost from linear to quadratic time in the number of constraints, according to the number of \
        loops",
    criterion: CHEAP,
    former: Some(Former {
        kind: ClaimKind::Paper,
        criterion: CHEAP,
        reason: "conjugate gradients end after at most as many solves, each of linear cost, as there are loop \
            constraints: \
            nothing that follows the paper could fail, so the claim leaves the count",
        judge: |paper, _| cheap(paper),
    }),
    headline: "exponent_with_all_loops",
    scope: Scope::Full,
    measure: |_| {
        static COSTS: LazyLock<Option<Numbers>> = LazyLock::new(loop_costs);
        COSTS.clone().unwrap_or_default()
    },
    judge: |paper, _| {
        let of = |name: &str| number(paper, name);
        let (none, all) = (of("exponent_without_loops"), of("exponent_with_all_loops"));
        let note = format!(
            "ladders of {RUNGS:?} rungs: \
             {none:.2} and {all:.2}, \
             {:.1} and {:.1} solves per step at the most rungs",
            of("solves_per_step_without_loops"),
            of("solves_per_step_with_all_loops")
        );
        (cheap(paper), note)
    },
};

fn cheap(paper: &Numbers) -> bool {
    let of = |name: &str| number(paper, name);
    (0.95..=1.05).contains(&of("exponent_without_loops")) && of("exponent_with_all_loops") <= 2.0
}

/// Obstacles that stand or move.
pub const OBSTACLE: Statement = Statement {
    id: "n2",
    kind: ClaimKind::ByConstruction,
    paper: "obstacles may stand or move",
    criterion: "a paddle with a prescribed motion sweeps a box of 3 kg over a floor by more than 0.1 m, and no overlap \
        is deeper than \
        1 mm",
    former: None,
    headline: "swept_m",
    scope: Scope::Full,
    measure: |_| {
        static SWEPT: LazyLock<Option<Numbers>> = LazyLock::new(swept);
        SWEPT.clone().unwrap_or_default()
    },
    judge: |paper, _| {
        let (swept, deep) = (number(paper, "swept_m"), number(paper, "largest_overlap_m"));
        let note = format!(
            "found \
             {swept:.2} m, {:.2} mm (`crates/ambulo-paper/data/scenes/pusher.toml`)",
            1000.0 * deep
        );
        (swept > 0.1 && deep < 1e-3, note)
    },
};

/// Hands that grasp objects.
pub const GRASP_CLAIM: Statement = Statement {
    id: "n3",
    kind: ClaimKind::ByConstruction,
    paper: "contact with friction lets hands grasp objects",
    criterion: "two fingers of a gripper lift a box by 0.3 m with friction alone, and it slips by less than 1 mm",
    former: None,
    headline: "lifted_m",
    scope: Scope::Full,
    measure: |_| {
        static GRASPED: LazyLock<Option<Numbers>> = LazyLock::new(grasped);
        GRASPED.clone().unwrap_or_default()
    },
    judge: |paper, _| {
        let (lifted, slip) = (number(paper, "lifted_m"), number(paper, "slip_m"));
        let note = format!(
            "found {lifted:.3} m, {:.3} mm \
             (`crates/ambulo-paper/data/scenes/grasp.toml`)",
            1000.0 * slip
        );
        ((lifted - 0.3).abs() < 1e-3 && slip < 1e-3, note)
    },
};

/// Figures hand in hand.
pub const HAND_IN_HAND: Statement = Statement {
    id: "n4",
    kind: ClaimKind::ByConstruction,
    paper: "several figures are synchronised by their contact, as in walking hand in hand",
    criterion: "the hands of two people of different size stay within 1 mm for 2.5 s of walking, and one is never more \
        than half a \
        step ahead of where both began",
    former: None,
    headline: "largest_gap_m",
    scope: Scope::Full,
    measure: |_| {
        static WALKED: LazyLock<Option<Numbers>> = LazyLock::new(hand_in_hand);
        WALKED.clone().unwrap_or_default()
    },
    judge: |paper, _| {
        let of = |name: &str| number(paper, name);
        let (gap, apart, force) = (of("largest_gap_m"), of("apart_m"), of("largest_force_n"));
        let note = format!(
            "found {:.3} mm, {apart:.2} m ahead, at most {force:.0} N between the hands \
             (`crates/ambulo-paper/data/scenes/hand-in-hand.toml`)",
            1000.0 * gap
        );
        (gap < CLOSED_M && apart < 0.35, note)
    },
};

/// Simulates a scene; `None` if it cannot be built or run.
fn simulated(
    text: &str,
    duration_s: Option<f64>,
    visit: impl FnMut(&SceneFrame<'_>),
) -> Option<(Scene, RunStatistics)> {
    let settings = SceneSettings { duration_s, ..SceneSettings::default() };
    let mut findings = Findings::default();
    let mut load = |path: &str| Err(format!("{path}: the scenes of the claims read no files"));
    let mut scene = Scene::build(&SceneFile::parse(text).ok()?, settings, &mut load, &mut findings).ok()?;
    let statistics = scene.run(&mut findings, visit).ok()?;
    Some((scene, statistics))
}

fn place(frame: &SceneFrame<'_>, body: &str) -> Option<ambulo_body::spatial::Vec3> {
    let number = frame.scene.world().bodies.iter().position(|own| own.name == body)?;
    Some(frame.scene.state().poses[number].translation)
}

/// Solves per step of a hanging ladder, with none or all of its loops closed.
fn solves_per_step(rungs: usize, closed: bool) -> Option<f64> {
    let (_, statistics) = simulated(&ladder(rungs, closed), None, |_| {})?;
    Some(statistics.iterations as f64 / statistics.steps as f64)
}

/// Slopes of log cost against log number of constraints, which are proportional to the number of rungs.
fn loop_costs() -> Option<Numbers> {
    let mut all = Numbers::new();
    for (closed, name) in [(false, "without_loops"), (true, "with_all_loops")] {
        let solves = RUNGS.iter().map(|rungs| solves_per_step(*rungs, closed)).collect::<Option<Vec<f64>>>()?;
        let costs: Vec<f64> = RUNGS.iter().zip(&solves).map(|(rungs, solves)| *rungs as f64 * solves).collect();
        let last = RUNGS.len() - 1;
        let exponent = ln(costs[last] / costs[0]) / ln(RUNGS[last] as f64 / RUNGS[0] as f64);
        all.push((format!("exponent_{name}"), exponent));
        all.push((format!("solves_per_step_{name}"), solves[last]));
    }
    Some(all)
}

/// A rope ladder that hangs straight, pushed aside at its lowest rung: sides of pieces of 0.3 m, rungs of 0.4 m.
fn ladder(rungs: usize, closed: bool) -> String {
    let mut text = format!(
        "step = 0.001\nduration = {}\n[solver]\nmethod = \"conjugate-gradient\"\n",
        0.001 * LADDER_STEPS as f64
    );
    let mut parts = String::new();
    for k in 1..=rungs {
        let (low, middle, high) = (-0.3 * k as f64, -0.3 * k as f64 + 0.15, -0.3 * (k - 1) as f64);
        for (side, z) in [("left", -0.2), ("right", 0.2)] {
            let parent = if k == 1 { "world".to_owned() } else { format!("{side} {}", k - 1) };
            let _ = write!(
                text,
                "[[body]]\nname = \"{side} {k}\"\nmass = 0.3\ninertia = [0.00225, 1.5e-05, 0.00225]\nposition = [0, \
                 {middle}, {z}]\n"
            );
            let _ = write!(
                parts,
                "[[joint]]\nname = \"{side} knot {k}\"\nkind = \"ball\"\nparent = \"{parent}\"\nchild = \"{side} \
                 {k}\"\nat = [0, {high}, {z}]\n"
            );
        }
        let push = if k == rungs { "velocity = [1, 0, 0]\n" } else { "" };
        let _ = write!(
            text,
            "[[body]]\nname = \"rung {k}\"\nmass = 0.4\ninertia = [0.00533333, 0.00533333, 4.5e-05]\nposition = [0, \
             {low}, 0]\n{push}"
        );
        let _ = write!(
            parts,
            "[[joint]]\nname = \"rung knot {k}\"\nkind = \"ball\"\nparent = \"left {k}\"\nchild = \"rung {k}\"\nat = \
             [0, {low}, -0.2]\n"
        );
        if closed {
            let _ = write!(
                parts,
                "[[closure]]\nname = \"loop {k}\"\nkind = \"ball\"\nfirst = \"rung {k}\"\nsecond = \"right {k}\"\nat = \
                 [0, {low}, 0.2]\n"
            );
        }
    }
    text + &parts
}

fn swept() -> Option<Numbers> {
    let (mut path, mut deepest) = (Vec::new(), 0.0_f64);
    simulated(PUSHER, None, |frame| {
        path.extend(place(frame, "box").map(|at| at.z));
        if let Some(forces) = &frame.forces {
            deepest = forces.contacts.iter().map(|contact| -contact.gap).fold(deepest, f64::max);
        }
    })?;
    Some(numbers([("swept_m", path.last()? - path.first()?), ("largest_overlap_m", deepest)]))
}

fn grasped() -> Option<Numbers> {
    let mut heights = Vec::new();
    simulated(GRASP, None, |frame| {
        if let (Some(held), Some(palm)) = (place(frame, "box"), place(frame, "palm")) {
            heights.push((frame.scene.state().time_s, held.y, held.y - palm.y));
        }
    })?;
    // The fingers are closed after 0.8 s, and the palm rises from 1 s on.
    let closed: Vec<f64> = heights.iter().filter(|(t, ..)| *t > 0.99).map(|(_, _, below)| *below).collect();
    let slip = closed.iter().map(|below| (below - closed[0]).abs()).fold(0.0, f64::max);
    Some(numbers([("lifted_m", heights.last()?.1 - heights.first()?.1), ("slip_m", slip)]))
}

fn hand_in_hand() -> Option<Numbers> {
    let (mut gap, mut force, mut apart, mut first) = (0.0_f64, 0.0_f64, 0.0_f64, None);
    simulated(HANDS, Some(HANDS_S), |frame| {
        gap = gap.max(frame.scene.closure_gap(0));
        if let Some(forces) = &frame.forces {
            force = forces.closing.iter().map(|(_, wrench)| wrench.force.norm()).fold(force, f64::max);
        }
        if let (Some(ann), Some(bob)) = (place(frame, "ann/pelvis"), place(frame, "bob/pelvis")) {
            let ahead = ann.x - bob.x;
            apart = apart.max((ahead - *first.get_or_insert(ahead)).abs());
        }
    })?;
    Some(numbers([("largest_gap_m", gap), ("apart_m", apart), ("largest_force_n", force)]))
}
