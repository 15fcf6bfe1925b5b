//! Machines in gait files: what they drive, when their states change, and what is refused.

use crate::gait_machine::shuffled;
use ambulo::findings::Findings;
use ambulo::gait::machine::{StateWatch, WalkMachine, planned, repeats};
use ambulo::gait::{Gait, GaitError, Jet, Walk, WalkPosture};
use ambulo::model::Side;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::numerics::{Smoothing, SplineDegree, SplineFitter};
use ambulo::simulation::ImpactLaw;
use ambulo::simulation::StepSettings;
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalk, SyntheticWalkSettings, run_of_states, synthesise};
use ambulo::simulation::walking::{GaitTargets, GroundContact, Shoes, Walker, WatchedTargets, gait_signals};
use std::cell::Cell;
use std::sync::LazyLock;

const LEG: f64 = 0.92;
const LIMP: &str = include_str!("../../../examples/gaits/limp.toml");
const STOP_AND_GO: &str = include_str!("../../../examples/gaits/stop-and-go.toml");
const SUB_CYCLES: &str = include_str!("../../../examples/gaits/sub-cycles.toml");

fn gait(text: &str) -> Gait {
    Gait::from_toml(text).unwrap_or_else(|e| panic!("{e} in\n{text}"))
}

fn walk(text: &str) -> Walk {
    Walk::new(&gait(text), LEG, &mut Findings::default()).unwrap_or_else(|e| panic!("{e} in\n{text}"))
}

fn refused(text: &str) -> String {
    match Gait::from_toml(text) {
        Err(GaitError::Toml(error)) => error.to_string(),
        other => panic!("{other:?}"),
    }
}

fn build() -> Build {
    Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true }
}

fn made(text: &str, mode: SyntheticMode, cycles: usize) -> SyntheticWalk {
    let gait = gait(text);
    let settings = SyntheticWalkSettings { gait: &gait, build: build(), mode, cycles, rate_hz: 100.0 };
    synthesise(&settings, &mut Findings::default()).unwrap_or_else(|e| panic!("{e}"))
}

/// The walk that stops and goes, corrected; it takes long.
static STOPS_AND_GOES: LazyLock<SyntheticWalk> = LazyLock::new(|| made(STOP_AND_GO, SyntheticMode::Corrected, 3));

/// A machine of the left knee with these states and transitions.
fn knee(states: &str, transitions: &str) -> String {
    format!(
        "speed = 1.2\n[[machine]]\nname = \"own\"\ndrives = \"left knee\"\nstate = [{states}]\ntransition = \
         [{transitions}]\n"
    )
}

/// States that a machine enters in steps of a millisecond until an end, with their times [s].
fn entered(walk: &Walk, machine: &str, until_s: f64) -> Vec<(String, f64)> {
    let mut running = WalkMachine::new(walk);
    let mut list: Vec<(String, f64)> = Vec::new();
    for i in 0..(until_s * 1000.0) as u32 {
        let t = 0.001 * f64::from(i);
        running.step(t);
        let number = running.running().number(machine).unwrap();
        let state = running.running().state_name(number);
        if list.last().is_none_or(|(last, _)| last != state) {
            list.push((state.to_owned(), t));
        }
    }
    list
}

/// The largest differences of rate and acceleration from central differences of value and rate, in steps of a tenth of
/// a millisecond.
fn jumps(text: &str, of: impl Fn(&WalkPosture) -> Jet, until_s: f64) -> [f64; 2] {
    const H: f64 = 1e-4;
    let mut machine = WalkMachine::new(&walk(text));
    let all: Vec<Jet> = (0..(until_s / H) as u32).map(|i| of(&machine.step(H * f64::from(i)))).collect();
    let differs = |x: fn(&Jet) -> f64, dx: fn(&Jet) -> f64| {
        let of = |w: &[Jet]| ((x(&w[2]) - x(&w[0])) / (2.0 * H) - dx(&w[1])).abs();
        all.windows(3).map(of).fold(0.0, f64::max)
    };
    [differs(|jet| jet.value, |jet| jet.rate), differs(|jet| jet.rate, |jet| jet.acceleration)]
}

#[test]
fn transitions_by_events_start_from_the_present_value_rate_and_acceleration() {
    // In the middle of the fastest flexion, away to a curve, to a constant and back.
    let text = knee(
        "{ name = \"gait\" }, { name = \"high\", activity = \"sub_cycle\", to_deg = 70, within = 0.3 }, \
         { name = \"scaled\", scale = 0.5, angle_deg = 5 }",
        "{ from = \"gait\", to = \"high\", when = \"left phase > 55 % and left phase < 57 %\" }, { from = \"high\", \
         to = \"scaled\", when = \"after 0.17 s\", within = 0.15 }, { from = \"scaled\", to = \"gait\", when = \"after \
         0.4 s\", within = 0.05 }",
    );
    let states = entered(&walk(&text), "own", 3.0);
    assert!(states.len() > 6, "{states:?}");
    let [rate, acceleration] = jumps(&text, |posture| posture.left.knee, 3.0);
    println!("largest jump: {rate:.2e} rad/s, {acceleration:.2e} rad/s²");
    // Differences of the third order, (fourth derivative) h²/6, are below 1 rad/s²; a jump shows in full.
    assert!(rate < 1e-3 && acceleration < 2.0, "{rate} {acceleration}");
    // Without passages the same transitions jump.
    let abrupt = jumps(&text.replace("within = 0.15", "within = 0.01"), |posture| posture.left.knee, 3.0);
    assert!(abrupt[1] > 3.0 * acceleration, "{abrupt:?}");
}

#[test]
fn sub_cycles_of_a_file_are_those_of_the_gait() {
    let (own, plain) =
        (made(SUB_CYCLES, SyntheticMode::Paper, 2), made("base = \"standard\"", SyntheticMode::Paper, 2));
    for name in ["hip_flexion_r", "knee_angle_r", "ankle_angle_r", "hip_flexion_l", "knee_angle_l", "ankle_angle_l"] {
        let id = own.human.model.coordinate(name).unwrap();
        let (a, b) = (own.trajectory.values(id), plain.trajectory.values(id));
        let worst = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max).to_degrees();
        println!("{name}: {worst:.2} deg");
        // Bounds are written with one decimal, and machines run once per millisecond.
        assert!(worst < 0.7, "{name}: {worst}");
    }
}

#[test]
fn a_walk_stops_stands_for_a_second_and_goes_on() {
    let walk = walk(STOP_AND_GO);
    let step_s = 0.5 * walk.cycle_s();
    let (walk, planned_s) = planned(walk, 12.0, 60.0, &mut Findings::default()).unwrap();
    let states = entered(&walk, "traffic light", planned_s);
    let names: Vec<&str> = states.iter().map(|(name, _)| name.as_str()).take(8).collect();
    assert_eq!(names, ["walking", "stopping", "standing", "starting", "stopping", "standing", "starting", "stopping"]);
    assert!((states[1].1 - 4.0 * step_s).abs() < 0.002, "four steps of {step_s} s: {states:?}");
    for stop in [2, 5] {
        let ([_, from], [_, to]) = ([0.0, states[stop].1], [0.0, states[stop + 1].1]);
        assert!((to - from - 1.0).abs() < 0.002, "{states:?}");
        let clock = walk.clock(0.5 * (from + to));
        assert!(clock.stands() && clock.phase.rate == 0.0, "{clock:?}");
    }
    // Both ways of the same change: by the machine and by the pace changes that it has made.
    let ramps = walk.pace_ramps();
    assert!(ramps.len() >= 5 && (ramps[0].start_s - states[1].1).abs() < 0.0015, "{:?}", ramps.len());
}

#[test]
fn stop_and_go_is_corrected_like_any_change_of_pace() {
    let walk = &*STOPS_AND_GOES;
    assert!(walk.report.correction.is_some() && walk.report.changes.len() >= 2, "{:?}", walk.report.changes);
    let light = walk.states.iter().filter(|period| period.machine == "traffic light");
    let names: Vec<&str> = light.map(|period| period.state.as_str()).collect();
    assert_eq!(names[..4], ["walking", "stopping", "standing", "starting"], "{names:?}");
}

#[test]
fn left_and_right_are_edited_apart() {
    let walk = walk(LIMP);
    assert!(!walk.is_symmetric());
    let plain = crate::gait_machine_files::walk("base = \"standard\"");
    for i in 0..50 {
        let t = 0.031 * f64::from(i);
        let (limp, usual) = (walk.at(t), plain.at(t));
        assert_eq!(limp.right, usual.right);
        assert!((limp.left.knee.value - usual.left.knee.value - 8_f64.to_radians()).abs() < 1e-12);
        assert!((limp.left.knee.rate - usual.left.knee.rate).abs() < 1e-12);
    }
    // Both sides by one name, pelvis, trunk and arms.
    let text = "[[joint]]\njoint = \"elbow\"\nangle_deg = 20\n[[joint]]\njoint = \"trunk\"\nangle_deg = \
        5\n[[joint]]\njoint = \"pelvis\"\nscale = 2\n[[joint]]\njoint = \"right shoulder\"\nscale = 0\n";
    let (own, usual) = (crate::gait_machine_files::walk(text).at(0.4), crate::gait_machine_files::walk("").at(0.4));
    for k in [0, 1] {
        assert!((own.elbows[k].value - usual.elbows[k].value - 20_f64.to_radians()).abs() < 1e-12);
    }
    assert!((own.trunk_lean.value - usual.trunk_lean.value - 5_f64.to_radians()).abs() < 1e-12);
    let tilt = |posture: &WalkPosture| posture.pelvis_tilt.value - posture.standing_tilt;
    assert!((tilt(&own) - 2.0 * tilt(&usual)).abs() < 1e-12);
    assert!(own.shoulders[0].value.abs() < 1e-15);
    assert_eq!(own.shoulders[1], usual.shoulders[1]);
}

#[test]
fn sides_that_differ_are_corrected_if_their_machines_repeat_what_they_do() {
    assert!(repeats(&walk(LIMP)) && repeats(&walk(SUB_CYCLES)) && repeats(&walk(STOP_AND_GO)));
    let once = "[[machine]]\nname = \"nod\"\ndrives = \"left elbow\"\nstate = [{ name = \"a\" }, { name = \"b\", \
        activity = \"constant\", angle_deg = 40 }]\ntransition = [{ from = \"a\", to = \"b\", when = \"time >= 10 s\" \
        }]\n";
    assert!(!repeats(&walk(once)));
    let early = once.replace("time >= 10 s", "after 4 steps");
    assert!(!repeats(&walk(&early)), "results show the state before");
    let settings = |gait| SyntheticWalkSettings {
        gait,
        build: build(),
        mode: SyntheticMode::Corrected,
        cycles: 1,
        rate_hz: 100.0,
    };
    let error = synthesise(&settings(&gait(once)), &mut Findings::default()).unwrap_err().to_string();
    assert!(error.contains("otherwise from cycle to cycle") && error.contains("the mode `paper`"), "{error}");
    let limp = made(LIMP, SyntheticMode::Corrected, 1);
    assert!(limp.report.correction.is_some());
    let bent = made("[[joint]]\njoint = \"knee\"\nangle_deg = 3\n", SyntheticMode::Corrected, 1);
    assert!(bent.report.correction.unwrap().parameters < limp.report.correction.unwrap().parameters);
}

#[test]
fn machines_in_a_simulation_see_the_feet_strike() {
    let text = "speed = 1.2\n[[machine]]\nname = \"striking\"\nstate = [{ name = \"before\" }, \
        { name = \"after\" }]\ntransition = [{ from = \"before\", to = \"after\", when = \"left foot strikes\" }, \
        { from = \"after\", to = \"before\", when = \"left foot is up and after 0.2 s\" }]\n";
    let walk = made(text, SyntheticMode::Paper, 3);
    let strikes: Vec<f64> =
        walk.states.iter().filter(|p| p.state == "after" && p.time_s[0] > 0.0).map(|p| p.time_s[0]).collect();
    assert!(strikes.len() >= 2, "{:?}", walk.states);
    let left = walk.loads.iter().find(|load| load.name.starts_with("left")).unwrap();
    let times = &left.times;
    for strike in strikes {
        // The loads on heel and toes have the rows of the simulation; a strike is the first loaded row after an
        // unloaded one.
        let row = times.iter().position(|t| *t >= strike - 1e-9).unwrap();
        let loaded = |row: usize| {
            let of_side = walk.loads.iter().filter(|load| load.name.starts_with("left"));
            of_side.map(|load| load.force[row].y).sum::<f64>() > 0.0
        };
        let near = (row.saturating_sub(2)..=row + 1).any(|row| loaded(row) && !loaded(row - 1));
        assert!(near, "no strike of the left foot at {strike} s");
    }
}

#[test]
fn a_parent_interrupts_restarts_and_waits_for_its_children() {
    let text = |resumes: bool| {
        format!(
            "[[machine]]\nname = \"parent\"\nstate = [{{ name = \"work\" }}, {{ name = \"pause\" }}, \
             {{ name = \"over\" }}]\ntransition = [{{ from = \"work\", to = \"over\", \
             when = \"machine child is done\" }}, {{ from = \"work\", to = \"pause\", when = \"after 0.5 s\" }}, {{ \
             from = \"pause\", to = \"work\", when = \"after 0.3 s\" }}]\n\
             [[machine]]\nname = \"child\"\nduring = {{ machine = \"parent\", state = \"work\" }}\nresumes = \
             {resumes}\nstate = [{{ name = \"first\" }}, {{ name = \"second\" }}, {{ name = \"last\", \
             done = true }}]\ntransition = [{{ from = \"first\", to = \"second\", when = \"after 0.4 s\" }}, {{ from = \
             \"second\", to = \"last\", when = \"after 0.2 s\" }}]\n"
        )
    };
    let names = |list: &[(String, f64)]| list.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    // Restarting, the child never comes to its end: the parent interrupts it after 0.5 s each time.
    let walk_of = |resumes: bool| walk(&text(resumes));
    let restarted = entered(&walk_of(false), "child", 3.0);
    assert_eq!(names(&restarted)[..6], ["rest", "first", "second", "rest", "first", "second"]);
    assert!(!restarted.iter().any(|(name, _)| name == "last"), "{restarted:?}");
    // Going on, it ends after the second start, and the parent, which waits for that, is over.
    let resumed = entered(&walk_of(true), "child", 3.0);
    assert_eq!(names(&resumed), ["rest", "first", "second", "rest", "second", "last", "rest"]);
    assert_eq!(names(&entered(&walk_of(true), "parent", 3.0)), ["work", "pause", "work", "over"]);
}

#[test]
fn conditions_on_angles_phases_and_machines_fire_where_they_say() {
    let text = "speed = 1.2\n[[machine]]\nname = \"bent\"\nstate = [{ name = \"no\" }, { name = \"yes\" }]\ntransition \
        = [{ from = \"no\", to = \"yes\", when = \"angle 'left knee' > 30 deg\" }, { from = \"yes\", to = \"no\", \
        when = \"not angle 'left knee' > 30 deg\" }]\n\
                [[machine]]\nname = \"both\"\nstate = [{ name = \"no\" }, { name = \"yes\" }]\ntransition = \
                [{ from = \"no\", to = \"yes\", when = \"machine bent is yes and machine 'left leg' is swing\" }, \
                { from = \"yes\", to = \"no\", when = \"machine bent is no or machine 'left leg' is stance\" }]\n";
    let walk = walk(text);
    for (state, at_s) in entered(&walk, "bent", 3.0).into_iter().skip(1) {
        let [before, now] = [0.003, 0.0].map(|earlier| walk.at(at_s - earlier).left.knee.value.to_degrees());
        assert_eq!(
            (before > 30.0, now > 30.0 || state == "no"),
            (state == "no", true),
            "{state} at {at_s}: {before} {now}"
        );
    }
    for (state, at_s) in entered(&walk, "both", 3.0).into_iter().skip(1) {
        let posture = walk.at(at_s - 0.001);
        assert_eq!(
            !posture.phases.stance[Side::Left] && posture.left.knee.value.to_degrees() > 30.0,
            state == "yes",
            "{at_s}"
        );
    }
}

#[test]
fn curves_recordings_and_coordinates_of_the_model_are_followed() {
    let text = "speed = 1.2\n[[machine]]\nname = \"toes\"\ndrives = \"mtp_angle_r\"\n[[machine.state]]\nname = \
        \"curled\"\nactivity = \"curve\"\n[[machine.state.knot]]\nname = \"flat\"\nat_percent = 30\nangle_deg = \
        0\nslope_deg = 0\ncurvature_deg = 0\n[[machine.state.knot]]\nname = \"push\"\nat_percent = 60\nangle_deg = \
        25\nslope_deg = 0\ncurvature_deg = 0\n\
                [[machine]]\nname = \"nod\"\ndrives = \"trunk\"\nstate = [{ name = \"replayed\", \
                activity = \"recording\", file = \"nod.sto\", column = \"lean\", from = 0.2 }]\n";
    let mut asked = Vec::new();
    let gait = Gait::from_toml_with(text, &mut |file, column| {
        asked.push(format!("{file}/{column}"));
        let times: Vec<f64> = (0..101).map(|i| 0.1 * f64::from(i)).collect();
        let values: Vec<f64> = times.iter().map(|t| 0.2 * t.sin()).collect();
        let fitter = SplineFitter::new(SplineDegree::Quintic, &times).map_err(|e| e.to_string())?;
        fitter.fit(&values, Smoothing::Interpolate).map_err(|e| e.to_string())
    });
    let walk = Walk::new(&gait.unwrap(), LEG, &mut Findings::default()).unwrap();
    assert_eq!(asked, ["nod.sto/lean"]);
    let mut machine = WalkMachine::new(&walk);
    let mut largest = 0.0_f64;
    for i in 0..3000 {
        let t = 0.001 * f64::from(i);
        let posture = machine.step(t);
        if t > 0.2 {
            assert!((posture.trunk_lean.value - 0.2 * (t + 0.2).sin()).abs() < 1e-5, "{t}");
        }
        let (name, toes) = machine.coordinates().next().map(|(name, jet)| (name.to_owned(), jet)).unwrap();
        assert_eq!(name, "mtp_angle_r");
        largest = largest.max(toes.value);
    }
    assert!((largest.to_degrees() - 25.0).abs() < 0.01, "{largest}");
    // A figure without toe joints has no such coordinate.
    let text = "[[machine]]\nname = \"toes\"\ndrives = \"mtp_angle_r\"\nstate = [{ name = \"curled\", \
        activity = \"constant\", angle_deg = 20 }]\n";
    let gait = crate::gait_machine_files::gait(text);
    let build = Build { toe_joint: false, ..build() };
    let settings = SyntheticWalkSettings { gait: &gait, build, mode: SyntheticMode::Paper, cycles: 1, rate_hz: 100.0 };
    let error = synthesise(&settings, &mut Findings::default()).unwrap_err().to_string();
    assert!(
        error.starts_with("the machine `toes` drives the coordinate `mtp_angle_r`; expected one of pelvis_tilt"),
        "{error}"
    );
}

#[test]
fn the_order_of_machines_changes_no_bit() {
    let walk = walk(&(LIMP.to_owned() + STOP_AND_GO.split("speed = 1.1\n").nth(1).unwrap()));
    let mut plain = WalkMachine::new(&walk);
    let mut others: Vec<WalkMachine> = (0..10).map(|seed| WalkMachine::ordered(&walk, &shuffled(seed))).collect();
    for i in 0..3000 {
        let t = 0.001 * f64::from(i);
        let expected = plain.step(t);
        others.iter_mut().for_each(|other| assert_eq!(other.step(t), expected, "at {t} s"));
    }
}

#[test]
fn files_that_describe_no_machine_are_refused_with_line_and_key() {
    let state = "state = [{ name = \"a\" }, { name = \"b\" }]";
    let named = |name: &str| format!("[[machine]]\nname = \"{name}\"\n{state}\n");
    for (text, expected) in [
        (
            "[[machine]]\nname = \"m\"".to_owned(),
            "line 1, `machine[1].state`: found no `state`; expected at least one state",
        ),
        (
            named("left knee"),
            "line 2, `machine[1].name`: found \"left knee\"; expected a name that no other machine has",
        ),
        (named("m") + &named("m"), "line 5, `machine[2].name`: found \"m\"; expected a name that no other machine has"),
        ("[[machine]]\nname = \"m\"\ndrives = \"left nee\"".to_owned(), "did you mean \"left knee\"?"),
        (
            "[[machine]]\nname = \"m\"\ndrives = \"knee_angle_l\"".to_owned(),
            "or a coordinate of the model that the gait does not move",
        ),
        (named("m").replace("{ name = \"b\" }", "{ name = \"a\" }"), "a name that no other state of this machine has"),
        (named("m").replace("\"b\"", "\"rest\""), "another name, because this one has a special meaning"),
        (
            named("m").replace("{ name = \"b\" }", "{ name = \"b\", activity = \"pace\" }"),
            "expected wait, because this machine drives nothing",
        ),
        (knee("{ name = \"a\", activity = \"pace\" }", ""), "expected an activity of a joint"),
        (
            knee("{ name = \"a\", activity = \"constant\", angle_deg = 400 }", ""),
            "expected an angle from -15 to 160 degrees",
        ),
        (
            knee("{ name = \"a\", activity = \"sub_cycle\", to_deg = 40 }", ""),
            "found no `within`; expected the duration of the sub-cycle",
        ),
        (
            knee("{ name = \"a\", activity = \"sub_cycle\", to_deg = 40, within = 0 }", ""),
            "expected a duration from 0.01 to 60 s",
        ),
        (knee("{ name = \"a\", activity = \"curve\" }", ""), "found 0 of `knot`; expected two or more"),
        (
            knee("{ name = \"a\", activity = \"recording\", file = \"x.sto\", column = \"y\" }", ""),
            "x.sto: found a recording; expected none here",
        ),
        (knee("{ name = \"a\", scal = 2 }", ""), "did you mean `scale`?"),
        (
            knee("{ name = \"a\" }", "{ from = \"a\", to = \"c\", when = \"after 1 s\" }"),
            "`machine[1].transition[1].to`: found \"c\"; expected one of \"a\"",
        ),
        (
            knee("{ name = \"a\" }", "{ from = \"a\", to = \"a\", when = \"soon\" }"),
            "found `soon`; expected `after`, `time`",
        ),
        (
            knee("{ name = \"a\" }", "{ from = \"a\", to = \"a\", when = \"machine 'lef leg' is swing\" }"),
            "did you mean 'left leg'?",
        ),
        (
            knee("{ name = \"a\" }", "{ from = \"a\", to = \"a\", when = \"machine own is b\" }"),
            "found no `b`; expected one of 'a'",
        ),
        (named("m") + "[machine.during]\nmachine = \"m\"\nstate = \"a\"", "expected another machine"),
        (
            knee("{ name = \"a\" }", "")
                + &knee("{ name = \"a\" }", "").replace("speed = 1.2\n", "").replace("own", "other"),
            "expected something that no other machine drives; the machine `own` does",
        ),
        (
            STOP_AND_GO.to_owned() + "[[pace_change]]\nat = 1\nspeed = 1\n",
            "expected none, because the machine `traffic light` drives the pace",
        ),
        ("[[joint]]\njoint = \"kne\"".to_owned(), "did you mean \"knee\"?"),
        ("[[joint]]\njoint = \"knee\"\nscale = 1e9".to_owned(), "expected a number from -10 to 10"),
    ] {
        let message = refused(&text);
        assert!(message.contains(expected), "{text}\n{message}\nexpected {expected}");
    }
    assert!(refused(&(0..101).map(|k| named(&format!("m{k}"))).collect::<String>()).contains("more than 100 machines"));
}

#[test]
fn angles_that_no_joint_can_follow_are_refused() {
    for (text, expected) in [
        (
            "[[joint]]\njoint = \"left knee\"\nangle_deg = 150\n".to_owned(),
            "left knee, with its scale and offset: found 16",
        ),
        ("[[joint]]\njoint = \"hip\"\nscale = -9\n".to_owned(), "right hip, with its scale and offset: found"),
        (knee("{ name = \"a\", scale = 8 }", ""), "expected angles from -15° to 160°. hint: use a scale nearer to 1"),
    ] {
        let error = Walk::new(&gait(&text), LEG, &mut Findings::default()).unwrap_err().to_string();
        assert!(error.contains(expected), "{text}\n{error}");
    }
    walk("[[joint]]\njoint = \"knee\"\nangle_deg = 90\n");
}

#[test]
fn a_change_of_pace_during_another_is_refused() {
    let text = "[[machine]]\nname = \"m\"\ndrives = \"pace\"\nstate = [{ name = \"a\", activity = \"pace\", \
        speed = 1 }, { name = \"b\", activity = \"pace\", speed = 1.4 }]\ntransition = [{ from = \"a\", to = \"b\", \
        when = \"after 0.2 s\" }]\n";
    let error = planned(walk(text), 4.0, 60.0, &mut Findings::default()).unwrap_err().to_string();
    assert!(error.contains("after the end of the previous change"), "{error}");
}

#[test]
fn the_run_of_states_is_told_as_it_stands_in_the_finished_walk() {
    // The limp reads the feet of its simulation; the clock alone moves the machines of the other two.
    for (text, mode) in
        [(LIMP, SyntheticMode::Paper), (SUB_CYCLES, SyntheticMode::Paper), (STOP_AND_GO, SyntheticMode::Corrected)]
    {
        let gait = gait(text);
        let settings = SyntheticWalkSettings { gait: &gait, build: build(), mode, cycles: 3, rate_hz: 100.0 };
        let mut told = Vec::new();
        run_of_states(&settings, &mut |change| told.push(change.clone()), &mut Findings::default()).unwrap();
        assert!(told.iter().filter(|change| change.from.is_some()).count() > 20, "{told:?}");
        let finished = if text == STOP_AND_GO { STOPS_AND_GOES.clone() } else { made(text, mode, 3) };
        assert_eq!(told, finished.state_changes, "{}", gait.name);
    }
}

#[test]
fn a_change_of_state_is_told_before_the_next_step_of_the_simulation() {
    let (gait, human) = (gait(LIMP), build().human().unwrap());
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let step = StepSettings::default();
    let ground = GroundContact { friction: 1.0, shoes: Shoes::Rigid, impact: ImpactLaw::Sticking };
    let walker =
        Walker::new(&human, gait_signals(&walk, &human.model, 0.0, 2.0).unwrap(), &ground, walk.speed()).unwrap();
    let mut targets = GaitTargets::new(&walk, &human.model, &[]).unwrap();
    let (now_s, told) = (Cell::new(0.0), Cell::new(0));
    let zero_s = 0.2;
    let tell = &mut |change: &ambulo::gait::machine::StateChange| {
        if change.from.is_some() {
            assert!((zero_s + change.time_s - now_s.get()).abs() < 1e-12, "{change:?} told at {} s", now_s.get());
            told.set(told.get() + 1);
        }
    };
    let mut states = StateWatch::new([zero_s, 1.5], tell);
    let watch = &mut |targets: &GaitTargets| {
        now_s.set(targets.time_s());
        states.look(targets.trace(), targets.machine().running(), targets.time_s());
    };
    walker
        .walk_with(Some(WatchedTargets { targets: &mut targets, watch }), &step, 1.8, &mut Findings::default())
        .unwrap();
    let all = targets.trace().changes(targets.machine().running(), zero_s, 1.5);
    assert_eq!(told.get(), all.iter().filter(|change| change.from.is_some()).count());
    // A watch that looks once, at the end, tells of nothing but the past: every change is late.
    let late = Cell::new(0);
    let tell = &mut |change: &ambulo::gait::machine::StateChange| {
        late.set(late.get() + usize::from(change.from.is_some() && zero_s + change.time_s < now_s.get() - 0.1));
    };
    StateWatch::new([zero_s, 1.5], tell).look(targets.trace(), targets.machine().running(), targets.time_s());
    assert_eq!(late.get(), told.get());
}
