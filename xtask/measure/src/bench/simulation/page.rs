//! The page docs/measured/BENCHMARKS.md, as Markdown that also reads well in a terminal.

use super::ladder::{self, OfMethod};
use super::markdown::{range, small, small_or_none, spread, time};
use super::requirements::Requirement;
use super::run::Run;
use super::scaling::Scaling;
use super::stance::Standing;
use super::{Results, accuracy::Accuracy};
use crate::simulators::{Measurement, Outcome, PeerTiming, Scene};
use ambulo::study::validation::TextTable as Table;
use std::fmt::Write as _;

const HEAD: &str = "\
# Benchmarks of the simulator

The other engines ran in the same run, right after ours (`cargo xtask simulators` runs them alone).

Steps of 1 ms, gravity 9.81 m/s². Times are CPU time of one thread for one step: median, and tenth and ninetieth
percentile. Each case runs for 10 simulated seconds, or for 20 s of CPU time if that is less. Errors are the largest
distance of two points that a joint or a loop should keep together, at any time.
";

const NOTES: &str = "\
## What differs between the engines

- **Soft and hard.** Our joints, loops and contacts are hard: what is left of them is rounding and the solver's tolerance
  (1e-10). MuJoCo's contacts and loops are springs and dampers by design, Rapier's joints and contacts as well; they
  are accurate to what their stiffness allows. The settings `tight` make them as stiff as they go (MuJoCo: `solref` of
  two steps, impedance 0.9999, tolerance 1e-12; Rapier: more iterations, stiffer joints), and MuJoCo's `discrete tight`
  stands to nanometres. All that was set is in `target/simulators.json`, which `cargo xtask simulators` writes.
- **Coordinates.** MuJoCo's joints are coordinates and cannot come apart, so its error on chains is 0 by construction. That is
  what makes its time on long chains grow faster than their length, and a depth of more than 1,024 bodies is refused.
- **Rapier's tuning.** Rapier is a game engine: constant work a step, little of it, in single precision (f32) by default. Its
  errors are those of so few iterations; `tight` shows by how much more of them lower the errors.
- **Springs.** The springs in the human's joints are three hinges in a row in MuJoCo, one ball or universal joint here, one
  joint with motors in Rapier. For small angles that is the same device. In Rapier's default settings they do not hold
  the human: it sags or falls, which says little about its contacts.
- **Energy.** A step by impulses is of the first order and loses or gains energy; ours too. `Integrator::Midpoint` keeps it, with
  contacts as well, and for smooth motion so does `Integrator::RungeKutta`, see Accuracy; MuJoCo's RK4 is its like.
- **Builds.** Ours runs as `cargo build --release` makes it, for any x86-64. Rapier is built with
  `-C target-cpu=native`; MuJoCo comes as a built library and is stepped from Python in tens, one by one from 1,000
  bodies on.
- **Flat ladders.** A ladder that hangs down is flat: its rails hang from two points of one vertical line, and all rails and
  rungs lie along it. There its loops no longer determine the forces, nor which way they open again. Our solver then stops
  at its most iterations (`not converged` in the table) and the worst loop error is made there; the median shows what is
  left elsewhere. The soft engines pass there with the error that they have anyway, or diverge.
";

/// Gravity in all scenes [m/s²].
const GRAVITY: f64 = 9.81;

/// The whole page.
pub(super) fn text(results: &Results, requirements: &[Requirement]) -> String {
    let mut text = format!("{HEAD}\nMachine: {}.\n", results.machine);
    let _ = write!(text, "\n## Requirements\n\n{}", requirement_table(requirements));
    if let Some(standing) = &results.stance {
        let _ = write!(text, "\n## The standing human\n\n{}", human(standing, &results.peers));
    }
    let _ = write!(text, "\n## Chains and random trees\n\n{}", scaling(&results.scaling, &results.peers));
    if let [ladders, ..] = results.ladders.as_slice() {
        let _ = write!(text, "\n## Ladders: closed loops\n\n{}", ladder(&results.ladders, ladders, &results.peers));
    }
    let _ = write!(text, "\n## Accuracy\n\n{}", accuracy(&results.accuracy));
    let _ = write!(text, "\n## Where another engine does better\n\n{}", better(results));
    let _ = write!(text, "\n{NOTES}");
    text
}

fn requirement_table(requirements: &[Requirement]) -> String {
    let mut table = Table::new(&["quantity", "required", "measured", ""]);
    for Requirement { what, required, measured, met, .. } in requirements {
        table.row([what.clone(), required.clone(), measured.clone(), if *met { "✓" } else { "✗" }.to_owned()]);
    }
    table.text()
}

// ---- the human ----

fn human(standing: &Standing, peers: &[PeerTiming]) -> String {
    let stance = &standing.stance;
    let text = format!(
        "{:.0} kg, 16 segments, springs and dampers in its joints, 12 spheres under its soles, 10 s. Force, \
         penetration, slip\n\
         and creep over the last second; a contact sticks below 0.95 of its limit of friction. Ours takes {:.2} tree \
         solves\n\
         and {:.2} factorisations a step; its joints come apart by {} m.\n\n",
        stance.weight_n / GRAVITY,
        stance.iterations,
        stance.factorizations,
        small(stance.joint_error_m),
    );
    let mut table = Table::new(&[
        "engine",
        "time",
        "p10 .. p90",
        "/ ours",
        "force [N]",
        "pelvis [m]",
        "penetration [m]",
        "slip [m/s]",
        "creep [m]",
    ]);
    table.row([
        "**Ambulo**".to_owned(),
        time(standing.step_us.median),
        spread(&standing.step_us),
        "1.00".to_owned(),
        format!("{:.3}", stance.contact_force_n),
        format!("{:.3}", stance.pelvis_height_m),
        small(stance.penetration_m),
        small(stance.slip_m_per_s),
        small(stance.creep_m),
    ]);
    for peer in peers.iter().filter(|p| p.scene == Scene::Human) {
        let Some(Measurement { median_us, p10_us, p90_us, stance: Some(theirs), .. }) = peer.measurement() else {
            continue;
        };
        let three = |value: Option<f64>| value.map_or_else(|| "not finite".to_owned(), |x| format!("{x:.3}"));
        let slipped = |value: Option<f64>| value.map_or_else(|| "none sticks".to_owned(), small);
        table.row([
            peer.name(),
            time(*median_us),
            range(*p10_us, *p90_us),
            format!("{:.2}", median_us / standing.step_us.median),
            three(theirs.contact_force_n),
            three(theirs.pelvis_height_m),
            small_or_none(theirs.penetration_m),
            slipped(theirs.slip_m_per_s),
            slipped(theirs.creep_m),
        ]);
    }
    text + &table.text() + &missing(peers, Scene::Human) + &laws(standing)
}

/// Violations of the contact laws.
fn laws(standing: &Standing) -> String {
    let pushed = &standing.pushed;
    let mut table = Table::new(&["largest violation of the contact laws", "falling, landing, standing", "pushed"]);
    let (ours, push) = (&standing.stance.left, &pushed.left);
    for (name, ours, pushed) in [
        ("complementarity: min of push / weight and departure / (g h)", ours.complementarity, push.complementarity),
        ("cone: friction beyond its limit / weight", ours.cone, push.cone),
        ("slip: violation of sticking or sliding friction / weight", ours.slip, push.slip),
        ("balance: sum of forces - m (a - g) / weight", ours.balance, push.balance),
    ] {
        table.row([name.to_owned(), small(ours), small(pushed)]);
    }
    format!(
        "\nComputed by the bench from the states before and after each step, not by the solver; g h is the speed that \
         falling\n\
         gains in a step. Pushed: 180 N on the pelvis for 0.2 s, then 1 s more; up to {} contacts slip at once, down \
         to {}\n\
         touch.\n\n{}",
        pushed.slipping,
        pushed.touching,
        table.text()
    )
}

// ---- chains, trees, ladders ----

fn scaling(scaling: &Scaling, peers: &[PeerTiming]) -> String {
    let mut table =
        Table::new(&["ours", "projection", "10", "100", "1,000", "10,000", "slope from 100", "worst error [m]"]);
    for family in &scaling.families {
        let at = |size: usize| family.run(size).map_or_else(String::new, |run| time(run.step_us.median));
        table.row([
            family.name.to_owned(),
            if family.projection { "with" } else { "without" }.to_owned(),
            at(10),
            at(100),
            at(1000),
            at(10_000),
            format!("{:.3}", family.slope()),
            small(family.sizes.iter().map(|(_, run)| run.worst_m).fold(0.0, f64::max)),
        ]);
    }
    let memory = scaling.bytes_a_body.map_or_else(String::new, |bytes| {
        format!("\nMemory for a body of the largest chain, with state and scratch: {:.1} kB.\n", bytes / 1000.0)
    });
    let ours = scaling.family("chain", true).map_or(&[][..], |f| f.sizes.as_slice());
    format!(
        "![Time per step and joint error over the number of bodies](../images/simulation_scaling.svg)\n\n\
         Links of 0.2 m and 1 kg, hinged to each other about y and z by turns, level at the start. In a random tree \
         each hangs\n\
         on one of the ten before it.\n\n{}{memory}\nThe chain, all engines; worst and median (ours) or last (theirs) \
         error:\n\n{}{}",
        table.text(),
        engines("Ambulo", ours, peers, Scene::Chain),
        missing(peers, Scene::Chain),
    )
}

fn ladder(all: &[OfMethod], first: &OfMethod, peers: &[PeerTiming]) -> String {
    let mut text = format!(
        "![Time per step and loop error over the number of loops](../images/simulation_ladder.svg)\n\n\
         Two rails of such links, 0.3 m apart, a rung hinged to each link of the one and closed by a point on the \
         other; three\n\
         bodies a loop. Time grows with the power {:.2} of the number of loops.\n\n{}{}",
        first.slope(),
        engines("Ambulo", &first.whole, peers, Scene::Ladder),
        missing(peers, Scene::Ladder),
    );
    for of_method in &all[1..] {
        let _ = write!(
            text,
            "\nOurs by the method `{}`:\n\n{}",
            of_method.name,
            engines("Ambulo", &of_method.whole, &[], Scene::Ladder)
        );
    }
    for of_method in all {
        let _ = write!(
            text,
            "\nA ladder of {} rungs, some of them closed (ours, `{}`):\n\n{}",
            ladder::RUNGS,
            of_method.name,
            closing(of_method)
        );
    }
    text
}

fn closing(of_method: &OfMethod) -> String {
    let mut table =
        Table::new(&["closed loops", "time", "p10 .. p90", "tree solves", "steps", "not converged", "worst error [m]"]);
    for (loops, run) in &of_method.closing {
        table.row([
            loops.to_string(),
            time(run.step_us.median),
            spread(&run.step_us),
            format!("{:.2}", run.iterations),
            run.steps.to_string(),
            run.unconverged.to_string(),
            small(run.worst_m),
        ]);
    }
    table.text()
}

/// All engines on one scene, by size.
fn engines(name: &str, ours: &[(usize, Run)], peers: &[PeerTiming], scene: Scene) -> String {
    let unit = if scene == Scene::Ladder { "loops" } else { "bodies" };
    let mut table = Table::new(&[
        "engine",
        unit,
        "time",
        "p10 .. p90",
        "/ ours",
        "steps",
        "tree solves",
        "worst error [m]",
        "median, last",
        "energy [J]",
    ]);
    for (size, run) in ours {
        table.row([
            format!("**{name}**"),
            size.to_string(),
            time(run.step_us.median),
            spread(&run.step_us),
            "1.00".to_owned(),
            run.steps.to_string(),
            format!("{:.2}", run.iterations),
            small(run.worst_m),
            small(run.median_m),
            format!("{:+.1e}", run.energy_change_j),
        ]);
        for peer in peers.iter().filter(|p| p.scene == scene && p.size == *size) {
            let Some(theirs) = peer.measurement() else { continue };
            table.row([
                peer.name(),
                size.to_string(),
                time(theirs.median_us),
                range(theirs.p10_us, theirs.p90_us),
                format!("{:.2}", theirs.median_us / run.step_us.median),
                format!("{:.0}", theirs.steps),
                String::new(),
                if theirs.diverged { "diverged".to_owned() } else { small_or_none(theirs.constraint_error_m[0]) },
                small_or_none(theirs.constraint_error_m[1]),
                theirs.energy_change_j.map_or_else(|| "not finite".to_owned(), |e| format!("{e:+.1e}")),
            ]);
        }
    }
    table.text()
}

/// Cases without a result, with the reason.
fn missing(peers: &[PeerTiming], scene: Scene) -> String {
    let reasons = peers.iter().filter(|p| p.scene == scene).filter_map(|peer| {
        let (what, why) = match &peer.outcome {
            Outcome::Measured(_) => return None,
            Outcome::Refused { reason } => ("not taken by the engine", reason),
            Outcome::NotInstalled { .. } => return Some(format!("- {}: not installed\n", peer.name())),
            Outcome::Failed { reason } => ("failed", reason),
        };
        Some(format!("- {}, {}: {what}: {why}\n", peer.name(), peer.size))
    });
    let list: String = reasons.collect();
    if list.is_empty() { list } else { format!("\n{list}") }
}

fn accuracy(accuracy: &Accuracy) -> String {
    let mut table = Table::new(&["chain of 20 links, steps of 1 ms", "measured"]);
    let integrators = [
        ("Runge-Kutta", &accuracy.smooth),
        ("the midpoint rule", &accuracy.midpoint),
        ("impulses", &accuracy.impulses),
    ];
    for (name, drift) in integrators {
        let measured =
            format!("{} ({} J of {:.0} J)", small(drift.share()), small(drift.change_j), drift.turned_over_j);
        table.row([format!("energy over 10 s, by {name}"), measured]);
    }
    for (name, error) in ["with", "without"].into_iter().zip(accuracy.joint_error_m) {
        table.row([format!("joint error in 60 s by impulses, {name} projection"), format!("{} m", small(error))]);
    }
    format!(
        "Energy: largest distance of the total energy from its start, over the energy turned over, which is the \
         largest\n\
         kinetic energy of the motion.\n\n{}",
        table.text()
    )
}

// ---- where others are better ----

/// Cases in which another engine takes less time or has smaller errors.
fn better(results: &Results) -> String {
    let mut list = String::new();
    for peer in &results.peers {
        let Some(theirs) = peer.measurement() else { continue };
        let (Some((us, error_m)), false) = (ours(results, peer), theirs.diverged) else { continue };
        let their_error = match &theirs.stance {
            Some(stance) => stance.penetration_m,
            None => theirs.constraint_error_m[0],
        };
        let more_exact = their_error.is_some_and(|e| e > 0.0 && e < error_m);
        if theirs.median_us < us || more_exact {
            let size = if peer.size > 0 { format!(" of {}", peer.size) } else { String::new() };
            let _ = writeln!(
                list,
                "- {:?}{size}: {}: {} against {}, error {} m in {:.0} steps against {} m",
                peer.scene,
                peer.name(),
                time(theirs.median_us),
                time(us),
                small_or_none(their_error),
                theirs.steps,
                small(error_m),
            );
        }
    }
    let less = "in less time or with a smaller worst error than ours (but for errors that are 0 by construction)";
    if list.is_empty() { format!("No case of this run was done {less}.\n") } else { format!("Done {less}:\n\n{list}") }
}

/// Our time [us] and error [m] on a peer's case.
fn ours(results: &Results, peer: &PeerTiming) -> Option<(f64, f64)> {
    let run = match peer.scene {
        Scene::Human => {
            let standing = results.stance.as_ref()?;
            return Some((standing.step_us.median, standing.stance.penetration_m));
        }
        Scene::Chain => results.scaling.family("chain", true)?.run(peer.size)?,
        Scene::Ladder => results.ladders.first()?.run(peer.size)?,
    };
    Some((run.step_us.median, run.worst_m))
}
