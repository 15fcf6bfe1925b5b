//! The page docs/measured/PHYSICAL_PEERS.md, from recorded outcomes.

use ambulo::study::validation::TextTable as Table;
use serde_json::Value;
use std::fmt::Write as _;

const HEAD: &str = "\
# Walking under own torques in MuJoCo

The controller of [PHYSICAL_WALK.md](../PHYSICAL_WALK.md) walks the same figure in another simulator. Plan, gains and settings are those of our
simulator; nothing was tuned in MuJoCo. In one walk MuJoCo's contact imitates the soft shoes of the plan, in another one it has MuJoCo's
default values.

The page is made from outcomes that `cargo xtask physical-peers` recorded (xtask/measure/peers/physical_outcomes.json). Other work ran on the machine.
";

const METHODS: &str = "
## Method

- **Figure**: bodies, masses, inertias, joints and spheres of the model are written as MJCF. Every coordinate is a slide or a hinge of its own. The
  spheres under the soles touch only the ground, in both simulators. Legs are solid in our simulator alone. Each run compares mass matrix and bias forces of
  both models at the start.
- **Controller**: after each step of 1 ms, MuJoCo sends coordinates, rates and the vertical force on each foot through a pipe. Our controller returns
  stiffness, damping, target and largest torque of a motor for each joint. Nothing acts on the root. All walks start in the same state.
- **Damping** belongs to MuJoCo's actuators. The integrator `implicitfast` takes it implicitly, except where a torque is at its limit. Our simulator
  takes stiffness and damping implicitly.
- **Contact, as the shoes**: elliptic friction cone, friction coefficient of the shoes. `solimp` is fitted so that the static force of a sphere grows
  with depth as that of the shoes (Hunt-Crossley) does, within 8 % from 3 to 18 mm. `solref` is given as stiffness and damping, so that force and
  damping at 10 mm are those of the shoes. `impratio` gives friction the creep of the shoes. Two differences remain: a foot that touches the ground
  is damped from the first instant, and the contact has an inertia of about the mass that MuJoCo gives to the body (`solimp` is 0.3 to 0.6).
- **Contact, default**: MuJoCo's `solref`, `solimp` and `impratio`; cone and friction coefficient are the same. Heel and ball are then four to seven
  times as stiff as the shoes at 10 mm.
- **Speed** is the distance divided by the time of the whole walk. **RMS** is the difference from the plan at the phase of the controller.
- **Time per step** is processor time of one thread, without the pipe and without the controller. MuJoCo: `mj_step` in batches of ten steps, which
  begin at every tenth state of its walk and keep the motors of that state; median of five passes. Ours: all steps of our walk minus the time of the
  controller for the same states; median of five walks. Our steps include reading coordinates and loads.
";

/// Name and key of each walk of a figure.
const WALKS: [(&str, &str); 3] = [
    ("MuJoCo, contact as the shoes", "mujoco"),
    ("MuJoCo, default contact", "mujoco_default_contact"),
    ("ours", "ours"),
];

pub(super) fn text(outcomes: &Value) -> Result<String, String> {
    let walks = outcomes["walks"].as_array().ok_or("no `walks`")?;
    let first = walks.first().ok_or("no walk")?;
    let word = |value: &Value| value.as_str().unwrap_or("unknown").to_owned();
    let solver = &first["mujoco"]["settings"];
    let mut page =
        format!("{HEAD}\nMachine: {}. Ambulo at commit {}. ", word(&outcomes["machine"]), word(&outcomes["commit"]));
    let _ = write!(
        page,
        "MuJoCo {}, integrator `{}`, {} solver; `impratio` is {:.1} for the shoes. ",
        word(&solver["version"]),
        word(&solver["integrator"]),
        word(&solver["solver"]),
        number(&solver["impratio"], "impratio")?,
    );
    let (figure, speed) = (word(&outcomes["figure"]), number(&outcomes["speed"], "speed")?);
    let _ = write!(page, "Figure: {figure}. Speed of both plans: {speed} m/s.\n\n");
    Ok(page + &requirements(walks)? + &details(walks)? + METHODS)
}

fn number(value: &Value, name: &str) -> Result<f64, String> {
    value.as_f64().ok_or_else(|| format!("no number `{name}`"))
}

fn or_dash(value: Option<f64>, digits: usize) -> String {
    value.map_or("-".to_owned(), |x| format!("{x:.digits$}"))
}

/// What was asked: steps in MuJoCo, and the ratio of speeds.
fn requirements(walks: &[Value]) -> Result<String, String> {
    let mut table =
        Table::new(&["figure", "steps asked", "steps in MuJoCo", "our time per step [us]", "MuJoCo's [us]", "ratio"]);
    let mut by_default = Vec::new();
    for walk in walks {
        let asked = number(&walk["asked"], "asked")?;
        let steps = number(&walk["mujoco"]["walk"]["steps"], "steps")?;
        let missed = if steps < asked { " **missed**" } else { "" };
        let ours = number(&walk["ours"]["step_us"], "step_us")?;
        let default = walk["mujoco_default_contact"]["step_us"].as_f64();
        by_default.push(or_dash(default.map(|default| default / ours), 2));
        // Without a number: MuJoCo's state was not finite.
        let theirs = walk["mujoco"]["step_us"].as_f64();
        table.row([
            named(walk),
            format!("{asked}"),
            format!("{}{missed}", steps_of(&walk["mujoco"]["walk"])?),
            format!("{ours:.1}"),
            or_dash(theirs, 1),
            or_dash(theirs.map(|theirs| theirs / ours), 2),
        ]);
    }
    Ok(format!(
        "{}\nRatio: MuJoCo's time divided by ours, with its contact as the shoes. Above 1, ours is faster. With \
         MuJoCo's default contact, the ratios are {}.\n\n",
        table.text(),
        by_default.join(" and ")
    ))
}

fn details(walks: &[Value]) -> Result<String, String> {
    let mut table =
        Table::new(&["walk", "steps", "speed [m/s]", "RMS hips [deg]", "knees", "ankles", "time per step [us]"]);
    for walk in walks {
        for (name, key) in WALKS {
            let walked = &walk[key]["walk"];
            let apart = |k: usize| Ok::<_, String>(format!("{:.2}", number(&walked["apart_deg"][k], "apart_deg")?));
            table.row([
                format!("{}, {name}", walk["name"].as_str().unwrap_or("unknown")),
                steps_of(walked)?,
                format!("{:.3}", number(&walked["speed"], "speed")?),
                apart(0)?,
                apart(1)?,
                apart(2)?,
                or_dash(walk[key]["step_us"].as_f64(), 1),
            ]);
        }
    }
    let mut differences = walks.iter().filter_map(|walk| walk["mujoco"]["figure_difference"].as_f64());
    let apart = differences.try_fold(0.0_f64, |most, x| x.is_finite().then(|| most.max(x))).unwrap_or(f64::NAN);
    Ok(format!(
        "## Walks\n\nA walk ends after {} steps, or with a fall. Mass matrix and bias forces of the figures in MuJoCo \
         differ from ours by at most {apart:.0e} of the \
         largest entry.\n\n{}",
        super::STEPS,
        table.text()
    ))
}

fn named(walk: &Value) -> String {
    let name = walk["name"].as_str().unwrap_or("unknown");
    format!("{name}: {} coordinates, {} spheres", walk["coordinates"], walk["spheres"])
}

fn steps_of(walked: &Value) -> Result<String, String> {
    let steps = number(&walked["steps"], "steps")?;
    let time_s = number(&walked["time_s"], "time_s")?;
    let fell = walked["fell"].as_bool().ok_or("no `fell`")?;
    Ok(if fell { format!("fell after {steps} ({time_s:.1} s)") } else { format!("{steps}") })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_walk_that_is_too_short_is_listed_as_missed() {
        let recorded = std::fs::read_to_string(crate::workspace::root().join(super::super::OUTCOMES)).unwrap();
        let mut outcomes: Value = serde_json::from_str(&recorded).unwrap();
        assert!(!text(&outcomes).unwrap().contains("**missed**"));
        outcomes["walks"][0]["mujoco"]["walk"]["steps"] = 19.into();
        outcomes["walks"][0]["mujoco"]["walk"]["fell"] = true.into();
        assert!(text(&outcomes).unwrap().contains("fell after 19") && text(&outcomes).unwrap().contains("**missed**"));
        outcomes["walks"][1]["ours"] = Value::Null;
        assert_eq!(text(&outcomes).unwrap_err(), "no number `step_us`");
    }
}
