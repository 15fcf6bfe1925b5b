//! The page of walks by own torques.

use super::spatial;
use super::{AFTER_PUSH, HOLD_S, LIFT, PHASES, PUSH_S, RAMP_S, Results, SEEDS, SPEED, TILE, Tuned, Walked};
use ambulo::study::validation::TextTable as Table;
use std::fmt::Write;

pub(super) fn text(results: &Results) -> String {
    let mut page = String::new();
    let _ = write!(
        page,
        "# Walking under own torques\n\nMeasured by `cargo xtask physical-walk --write` on {}. A figure in the \
         sagittal plane follows its corrected walk \
         with the default controller (`simulation::control`, [PHYSICAL_WALK.md](../PHYSICAL_WALK.md)): a man of 75 kg \
         and 1.75 m at {SPEED} m/s unless the row says \
         otherwise; further down in three dimensions, along his optimal walk. Nothing but joints and ground acts on \
         him. Torques are limited by the strength of muscles at the angle and the speed of the joint. In the \
         plane legs pass each other side by side; in three dimensions they are solid.\n\n\
         The settings were chosen by hand on pushes of this man at this speed, at other phases than those of this \
         page, and in three dimensions one more (the cost of the place sideways) on pushes from eight sides at other \
         phases. The rules \
         for the phase, the level of the ground and the ankle were made while he was tried on slopes, on tiles and \
         with other legs in the plane. Other speeds, figures \
         and masses played no part.\n\n",
        results.machine
    );
    page += &main_table(results);
    page += &pushes(results);
    page += &others(results);
    page += &tuned(&results.tuned);
    page += &delays(results);
    page += &results.placement.section();
    page += &in_three_dimensions(&results.spatial);
    page += &harmonics(results);
    page += "\n![Harmonics of the torques, and pushes that are survived](../images/physical_walk.svg)\n\nLeft and \
        middle: the table above. Right: the pushes of this page, with the usual and with the tuned gains.\n";
    page
}

fn main_table(results: &Results) -> String {
    let long = &results.long;
    let mut table = Table::new(&["what", "asked", "found"]);
    let mut row = |what: &str, asked: &str, found: String| table.row([what.to_owned(), asked.to_owned(), found]);
    row("steps on level ground without a fall", "1000", steps(long));
    row("mean speed [m/s]", &format!("{SPEED}"), format!("{:.3}", long.speed));
    row("hips, knees and ankles against the plan, RMS [deg]", "<= 5", format!("{:.2}", long.apart.to_degrees()));
    row("largest force or moment on the root [N, N.m]", "0", format!("{}", long.root));
    row("times real time, one core", ">= 60", format!("{:.0}", long.seconds[1] / long.seconds[0]));
    row("stiffness of hip, knee, ankle and lumbar joint, without feedback [N.m/rad]", "<= 300", "200".to_owned());
    let all: Vec<String> = results.stiffness.iter().map(|(name, k)| format!("{name} {k:.0}")).collect();
    row("largest stiffness of a joint, with feedback [N.m/rad]", "", all.join(", "));
    let without = results.without.map_or("none in 60 s".to_owned(), |time_s| format!("after {time_s:.1} s"));
    row("fall without feedback", "", without);
    let [plan_s, gains_s] = results.made_s;
    row("CPU time of the plan / of the gains [s]", "<= 600 in all", format!("{plan_s:.1} / {gains_s:.1}"));
    let tiles = format!("{} of {SEEDS}", results.tiles);
    let (height, lift) = (1e3 * TILE, 1e3 * LIFT);
    let what = format!(
        "tiles one step long, up to {height:.0} mm between neighbours, a plan with {lift:.0} mm more lift, 100 steps"
    );
    row(&what, ">= 90 % of 20", tiles);
    let (fell, [slow, fast, again]) = results.changing;
    let what = format!(
        "one controller of all speeds of this page, {HOLD_S} s at 0.7, to 1.8 within {RAMP_S} s, {HOLD_S} s there, and \
         back: mean speeds [m/s]"
    );
    row(&what, "0.7, 1.8", format!("{}{slow:.2}, {fast:.2}, {again:.2}", if fell { "fell; " } else { "" }));
    for (slope, walked) in &results.slopes {
        row(&format!("slope of {slope:+.0} %, 100 steps"), "100", steps(walked));
    }
    for (what, walked) in &results.changed {
        row(&format!("{what}, same plan and gains, 100 steps"), "20", steps(walked));
    }
    format!("{}\n", table.text())
}

fn steps(walked: &Walked) -> String {
    if walked.fell { format!("fell after {}", walked.steps) } else { walked.steps.to_string() }
}

fn pushes(results: &Results) -> String {
    let mut table = Table::new(&["force [N]", "survived"]);
    for (force, survived) in &results.pushes {
        table.row([format!("{force:+.0}"), format!("{survived} of {PHASES}")]);
    }
    format!(
        "## Pushes\n\nA force of {PUSH_S} s at the mass centre of the trunk, forward (+) or backward (-), at {PHASES} \
         phases of the cycle; survived if {AFTER_PUSH} steps \
         follow. Asked: at least 90 % at 150 N.\n\n{}\n",
        table.text()
    )
}

fn others(results: &Results) -> String {
    let mut table = Table::new(&["plan", "steps of 100", "speed [m/s]", "RMS [deg]", "pushes of 100 N"]);
    let mut row = |what: String, walked: &Walked, survived: usize| {
        let (speed, apart) = (format!("{:.2}", walked.speed), format!("{:.2}", walked.apart.to_degrees()));
        table.row([what, steps(walked), speed, apart, format!("{survived} of {}", 2 * PHASES)]);
    };
    for (speed, walked, survived) in &results.speeds {
        row(format!("{speed} m/s"), walked, *survived);
    }
    for (name, walked, survived) in &results.others {
        row(name.clone(), walked, *survived);
    }
    format!(
        "## Other speeds and figures\n\nEach with a plan and gains of its own. Pushes grow with mass; half of them are \
         backward. Other figures walk at \
         {SPEED} m/s times the root of their stature over that of the man.\n\n{}\n",
        table.text()
    )
}

fn tuned(tuned: &Tuned) -> String {
    let mut table = Table::new(&["with tuned gains", "found"]);
    let mut row = |what: &str, found: String| table.row([what.to_owned(), found]);
    for (force, survived) in &tuned.pushes {
        row(&format!("pushes of {force:+.0} N"), format!("{survived} of {PHASES}"));
    }
    row("tiles, 100 steps", format!("{} of {SEEDS}", tuned.tiles));
    for (slope, walked) in &tuned.slopes {
        row(&format!("slope of {slope:+.0} %, 100 steps"), steps(walked));
    }
    let all = 2 * PHASES * super::SPEEDS.len();
    row("pushes of +100 and -100 N at all speeds of this page", format!("{} of {all}", tuned.at_speeds));
    for (delay_s, walked) in &tuned.delays {
        row(&format!("feedback {:.0} ms later, 100 steps", 1e3 * delay_s), steps(walked));
    }
    for (side, survived) in ["right", "left"].iter().zip(tuned.sideways) {
        row(&format!("in three dimensions, pushes of 60 N, {side}"), format!("{survived} of {PHASES}"));
    }
    format!(
        "## Tuned gains\n\nThe same man with `ControlSettings::tuned_in_the_plane`, which `ambulo tune` found for a \
         woman of 60 kg at 1.2 m/s.\n\n{}\n",
        table.text()
    )
}

fn delays(results: &Results) -> String {
    let mut table = Table::new(&["delay [ms]", "time constant [ms]", "steps of 100", "RMS [deg]", "pushes of 100 N"]);
    for ([delay_s, activation_s], walked, survived) in &results.delays {
        table.row([
            format!("{:.0}", 1e3 * delay_s),
            format!("{:.0}", 1e3 * activation_s),
            steps(walked),
            format!("{:.2}", walked.apart.to_degrees()),
            format!("{survived} of {}", 2 * PHASES),
        ]);
    }
    format!(
        "## Feedback that acts later\n\nThe same man in the plane; feedback acts after a delay, for which it foresees \
         the state by the linear system and the feedback that is on its way, and its torques follow their command with \
         a time constant, as muscle forces follow activation. Plan and impedance act at once. Pushes forward and \
         backward, survived for {AFTER_PUSH} steps.\n\n{}\n",
        table.text()
    )
}

fn harmonics(results: &Results) -> String {
    let mut table = Table::new(&["harmonics", "hip", "knee", "ankle", "steps of 100", "RMS [deg]", "pushes of 100 N"]);
    for (count, [hip, knee, ankle], walked, survived) in &results.harmonics {
        let share = |x: &f64| format!("{x:.3}");
        table.row([
            count.to_string(),
            share(hip),
            share(knee),
            share(ankle),
            steps(walked),
            format!("{:.2}", walked.apart.to_degrees()),
            format!("{survived} of {}", 2 * PHASES),
        ]);
    }
    format!(
        "## How many parameters a torque curve needs\n\nThe torques of the plan are replaced by their mean and their \
         first harmonics over the cycle (2 n + 1 numbers \
         per joint). Columns of joints: share of the variance that is kept.\n\n{}",
        table.text()
    )
}

fn in_three_dimensions(results: &spatial::Results) -> String {
    let long = &results.long;
    let mut table = Table::new(&["what", "asked", "found"]);
    let mut row = |what: &str, asked: &str, found: String| table.row([what.to_owned(), asked.to_owned(), found]);
    row("steps on level ground without a fall", "200", steps(long));
    row("mean speed [m/s]", &format!("{SPEED}"), format!("{:.3}", long.speed));
    row("hips, knees and ankles against the plan, RMS [deg]", "<= 6", format!("{:.2}", long.apart.to_degrees()));
    row("largest force or moment on the root [N, N.m]", "0", format!("{}", long.root));
    row("times real time, one core", ">= 20", format!("{:.0}", long.seconds[1] / long.seconds[0]));
    row("stiffness of hip, knee, ankle and lumbar joint, without feedback [N.m/rad]", "<= 350", "200".to_owned());
    let all: Vec<String> = results.stiffness.iter().map(|(name, k)| format!("{name} {k:.0}")).collect();
    row("largest stiffness of a joint, with feedback [N.m/rad]", "", all.join(", "));
    let [plan_s, gains_s] = results.made_s;
    row("CPU time of the plan / of the gains [s]", "<= 7200 in all", format!("{plan_s:.1} / {gains_s:.1}"));
    for ((side, _, force), survived) in spatial::PUSHES.iter().zip(&results.pushes) {
        let asked = match (*side, *force) {
            (_, 150.0) | ("right" | "left", 100.0) => "",
            _ => ">= 90 %",
        };
        row(&format!("pushes of {force} N, {side}"), asked, format!("{survived} of {PHASES}"));
    }
    let (height, lift, count) = (1e3 * TILE, 1e3 * LIFT, spatial::STEPS);
    let what =
        format!("tiles, up to {height:.0} mm between neighbours, a plan with {lift:.0} mm more lift, {count} steps");
    row(&what, ">= 80 % of 20", format!("{} of {SEEDS}", results.tiles));
    let (fell, [slow, fast, again]) = results.changing;
    let what = format!(
        "one controller, {HOLD_S} s at 1.0, to 1.6 within {RAMP_S} s, {HOLD_S} s there, and back: mean speeds [m/s]"
    );
    row(&what, "1.0, 1.6", format!("{}{slow:.2}, {fast:.2}, {again:.2}", if fell { "fell; " } else { "" }));
    for (slope, walked) in &results.slopes {
        row(&format!("slope of {slope:+.0} %, {count} steps"), &count.to_string(), steps(walked));
    }
    for (what, walked) in &results.changed {
        row(&format!("{what}, same plan and gains, {count} steps"), "20", steps(walked));
    }
    let mut speeds = Table::new(&["plan", "steps of 100", "speed [m/s]", "RMS [deg]", "pushes of 100 N"]);
    for (speed, walked, survived) in &results.speeds {
        let (found, apart) = (format!("{:.2}", walked.speed), format!("{:.2}", walked.apart.to_degrees()));
        speeds.row([format!("{speed} m/s"), steps(walked), found, apart, format!("{survived} of {}", 4 * PHASES)]);
    }
    format!(
        "## In three dimensions\n\nThe same man along his optimal walk; pushes as above. Forward is along x, right \
         along z.\n\n{}\n\
         At other speeds, each with a plan and gains of its own, pushed forward, backward, right and left:\n\n{}\n{}",
        table.text(),
        speeds.text(),
        shoved(&results.shoved)
    )
}

fn shoved(rows: &[spatial::Shoved]) -> String {
    let [small, large] = spatial::SHOVES.map(|force| format!("{force:.0} N"));
    let names = [
        "figure",
        "speed [m/s]",
        &small,
        &large,
        &format!("{small}, feedback alone"),
        &format!("{large}, feedback alone"),
    ];
    let mut table = Table::new(&names);
    for row in rows {
        let [with, without] = row.survived.map(|counts| counts.map(|count| format!("{count} of {}", row.pushes)));
        let [[a, b], [c, d]] = [with, without];
        table.row([row.name.clone(), format!("{:.2}", row.speed), a, b, c, d]);
    }
    format!(
        "## Pushes from all sides, and recovery steps\n\nThe 72 pushes of the report of `ambulo tune \
         examples/pushed-from-four-sides.toml`, of one force each: {PUSH_S} s at the mass centre of the trunk, at all \
         phases and in all directions, survived if five cycles follow without a fall. Legs are solid. The last two \
         columns are without recovery steps. Asked of the man: 62 of 72 at {small}, 45 of 72 at {large}. The \
         constants of recovery steps were chosen on these pushes at {SPEED} m/s; the row with 24 pushes at that speed \
         has others, of another seed. Other figures get every third push, in proportion to their mass, and walk at \
         these speeds times the root of their stature over his; all have the same settings.\n\n{}\n",
        table.text()
    )
}
