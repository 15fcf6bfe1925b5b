//! The page docs/measured/OPTIMAL_PEERS.md, from recorded outcomes.

use ambulo::study::validation::TextTable as Table;
use serde_json::Value;
use std::fmt::Write as _;

/// Requirements: difference of objectives, our time in theirs, KKT residual.
const SAME_OBJECTIVE: f64 = 0.01;
const FASTER_THAN_IPOPT: f64 = 5.0;
const FASTER_THAN_MOCO: f64 = 30.0;
const KKT: f64 = 1e-4;

const HEAD: &str = "\
# Optimal motion, compared with other solvers

Made from outcomes that `cargo xtask optimal-peers` recorded (xtask/measure/peers/optimal_outcomes.json). A peer's result of an earlier run counts if
the exported problem is the same, byte for byte. Other work ran on the machine. Missed requirements are listed as missed.
";

const METHODS: &str = "
## How they differ

- **Ours**: quintic splines of all coordinates; some steps of Gauss and Newton with softer ground first, then Newton's method
  (`Problem::solve`, `Problem::refine`). CPU time of one thread, median of seven runs, everything included.
- **CasADi and IPOPT**: the same unknowns, instants, objective and constraints, with dynamics and splines written again in Python
  (`optimal_casadi.py`); exact gradient, sparse Jacobian and Hessian; MUMPS. CPU time of the solver alone, without building its functions.
  The tolerance is our accuracy (1e-5), and 1e-8 from our solution, which has met 1e-5 already.
- **Moco**: a model of the same bodies with `SmoothSphereHalfSpaceForce` and `CoordinateActuator` (`optimal_moco.py`), `MocoCasADiSolver` with
  Hermite-Simpson transcription and explicit dynamics, one job. Its unknowns are states and controls, so its objective differs by the
  discretisation. CPU time of `MocoStudy::solve`.
- *First guess*: the target motion, at the height where the ground carries the weight. *Our solution*: the same solver started from it.
- The contact formula is OpenSim's, with the parameters of Moco's `2D_gait.osim` (`Onset::Published`): smoothed normal force before touch, and friction with a corner
  at 0.2 m/s.
- The problem has other local minima. Deviations and number of knots were chosen with IPOPT from several first guesses, so that these end in the same one; with
  weaker tracking of rates (0.5 instead of 0.3 rad/s) and 50 knots, IPOPT and our solver ended in minima that differ by 4 %.
- KKT residual: the largest entry of grad f + J^T lambda, per rad or m, with multipliers lambda of least squares; not scaled. Constraints are in body weights (BW), or
  BW x leg length.
";

/// A run of a peer.
struct Run<'a> {
    name: &'static str,
    value: &'a Value,
    required: f64,
}

pub(super) fn text(outcomes: &Value) -> Result<String, String> {
    let ours = Ours::read(outcomes)?;
    let runs = [
        Run { name: "CasADi and IPOPT, first guess", value: &outcomes["casadi"]["cold"], required: FASTER_THAN_IPOPT },
        Run { name: "CasADi and IPOPT, our solution", value: &outcomes["casadi"]["warm"], required: FASTER_THAN_IPOPT },
        Run { name: "Moco, first guess", value: &outcomes["moco"]["cold"], required: FASTER_THAN_MOCO },
        Run { name: "Moco, our solution", value: &outcomes["moco"]["warm"], required: FASTER_THAN_MOCO },
    ];
    let word = |value: &Value| value.as_str().unwrap_or("unknown").to_owned();
    let mut page = format!(
        "{HEAD}\nMachine: {}. Ambulo at commit {}; {}; {}.\n\n{}\n\n",
        word(&outcomes["machine"]),
        word(&outcomes["commit"]),
        word(&outcomes["casadi"]["version"]),
        runs[2..].iter().find_map(|run| run.value["version"].as_str()).unwrap_or("OpenSim"),
        word(&outcomes["walker"]),
    );
    let _ = write!(page, "## Requirements\n\n{}\n", requirements(outcomes, &ours, &runs)?);
    let _ = write!(page, "## Runs\n\n{}", solved(&ours, &runs)?);
    let between = &outcomes["ours"]["root_between"];
    let _ = writeln!(
        page,
        "\nOur solution between the instants: forces at the root {:.4} (root mean square), {:.3} (largest).",
        number(between, "rms")?,
        number(between, "largest")?
    );
    page.push_str(METHODS);
    Ok(page)
}

struct Ours {
    seconds: f64,
    objective: f64,
    steps: String,
    root: f64,
}

impl Ours {
    fn read(outcomes: &Value) -> Result<Ours, String> {
        let ours = &outcomes["ours"];
        let steps = format!("{} + {}", number(ours, "steps")?, number(ours, "newton_steps")?);
        Ok(Ours {
            seconds: number(ours, "seconds")?,
            objective: number(ours, "objective")?,
            root: number(ours, "root")?,
            steps,
        })
    }
}

impl Run<'_> {
    fn has_failed(&self) -> bool {
        self.value["objective"].is_null()
    }

    fn apart(&self, ours: &Ours) -> Result<f64, String> {
        Ok((number(self.value, "objective")? / ours.objective - 1.0).abs())
    }
}

fn number(object: &Value, key: &str) -> Result<f64, String> {
    object[key].as_f64().ok_or_else(|| format!("no number `{key}` in {object}"))
}

fn verdict(met: bool, text: &str) -> String {
    if met { text.to_owned() } else { format!("{text} **missed**") }
}

fn requirements(outcomes: &Value, ours: &Ours, runs: &[Run<'_>]) -> Result<String, String> {
    let mut table = Table::new(&["requirement", "asked", "result"]);
    let check = &outcomes["casadi"]["check"];
    let kkt = number(check, "kkt")?;
    table.row([
        "KKT residual of our solution in CasADi".into(),
        "<= 1e-4".into(),
        verdict(kkt <= KKT, &format!("{kkt:.1e}")),
    ]);
    for run in runs {
        if run.has_failed() {
            table.row([format!("same objective: {}", run.name), "<= 1 %".to_owned(), verdict(false, "no solution")]);
            continue;
        }
        let apart = run.apart(ours)?;
        let text = format!("{:.3} %", 100.0 * apart);
        table.row([format!("same objective: {}", run.name), "<= 1 %".into(), verdict(apart <= SAME_OBJECTIVE, &text)]);
    }
    // A start from our solution helps the peer; it counts only where there is no result from the first guess.
    for run in runs.chunks(2).filter_map(|starts| starts.iter().find(|run| !run.has_failed())) {
        let ratio = number(run.value, "seconds")? / ours.seconds;
        let asked = format!(">= {:.0} x", run.required);
        table.row([
            format!("time ratio: {}", run.name),
            asked,
            verdict(ratio >= run.required, &format!("{ratio:.1} x")),
        ]);
    }
    Ok(table.text())
}

fn solved(ours: &Ours, runs: &[Run<'_>]) -> Result<String, String> {
    let mut table = Table::new(&[
        "solver and start",
        "CPU time [s]",
        "ratio",
        "iterations",
        "objective",
        "KKT",
        "root [BW]",
        "status",
    ]);
    table.row([
        "ours, first guess".to_owned(),
        format!("{:.3}", ours.seconds),
        "1".to_owned(),
        ours.steps.clone(),
        format!("{:.5}", ours.objective),
        "see above".to_owned(),
        format!("{:.0e}", ours.root),
        "solved".to_owned(),
    ]);
    for run in runs {
        let value = run.value;
        let status = value["status"].as_str().or(value["failed"].as_str()).unwrap_or("-").to_owned();
        if run.has_failed() {
            let none = || "-".to_owned();
            table.row([run.name.to_owned(), none(), none(), none(), none(), none(), none(), status]);
            continue;
        }
        let seconds = number(value, "seconds")?;
        let small = |key: &str| value[key].as_f64().map_or_else(|| "-".to_owned(), |x| format!("{x:.0e}"));
        table.row([
            run.name.to_owned(),
            format!("{seconds:.2}"),
            format!("{:.1}", seconds / ours.seconds),
            format!("{}", number(value, "iterations")?),
            format!("{:.5}", number(value, "objective")?),
            small("kkt"),
            small("root"),
            status,
        ]);
    }
    Ok(table.text())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn outcomes() -> Value {
        let run = |seconds: f64, objective: f64| {
            json!({ "seconds": seconds, "objective": objective, "iterations": 9,
            "kkt": 1e-9, "root": 1e-9, "status": "ok" })
        };
        json!({
            "machine": "m", "commit": "c", "walker": "A walker.",
            "ours": { "seconds": 0.5, "objective": 2.0, "steps": 20, "newton_steps": 9, "root": 1e-6,
                "root_between": { "rms": 0.001, "largest": 0.01 } },
            "casadi": { "version": "CasADi", "check": { "kkt": 2e-4 }, "cold": run(2.0, 2.1), "warm": run(0.1, 2.0) },
            "moco": { "cold": { "failed": "out of time" }, "warm": run(100.0, 2.01) },
        })
    }

    #[test]
    fn what_is_missed_is_said() {
        let page = text(&outcomes()).unwrap();
        let row = |start: &str| page.lines().find(|line| line.starts_with(&format!("| {start}"))).unwrap().to_owned();
        assert!(row("KKT").contains("2.0e-4 **missed**"), "{page}");
        assert!(row("same objective: CasADi and IPOPT, first guess").contains("5.000 % **missed**"), "{page}");
        assert!(row("same objective: Moco, our solution").contains("0.500 %"), "{page}");
        assert!(row("same objective: Moco, first guess").contains("no solution **missed**"), "{page}");
        assert!(row("time ratio: CasADi and IPOPT, first guess").contains("4.0 x **missed**"), "{page}");
        assert!(row("Moco, first guess").contains("out of time"), "{page}");
    }

    #[test]
    fn an_incomplete_record_is_an_error() {
        assert!(text(&json!({})).unwrap_err().contains("no number"));
    }
}
