//! Gait files: what is read from good ones, and what is said of bad ones.

use ambulo::findings::Findings;
use ambulo::gait::{Gait, GaitError, Jet, Laws, LegJoint, Pelvis, Speed, Style, Walk};
use proptest::prelude::*;

const LEG: f64 = 0.92;

/// A gait of style 1997 with its own knee; line numbers are counted below.
const KNEE_1997: &str = r#"name = "marching"
style = "1997"
speed = 1.2
step_height = 1.3

[[knee.sub_cycle]]
name = "F"
end = "swing peak"
from_percent = 40
to_percent = [70, 4]
from_deg = 5
to_deg = [40, 30]
height_share = 1

[[knee.sub_cycle]]
name = "E"
from_percent = [70, 4]
to_percent = 140
from_deg = [40, 30]
to_deg = 5
"#;

/// A gait of the default style with its own ankle.
const ANKLE: &str = r#"base = "slow"
name = "flat-footed"

[[ankle.knot]]
name = "contact"
begins = "E2"
at_percent = 0
angle_deg = 0
slope_deg = 20
curvature_deg = 0

[[ankle.knot]]
name = "largest dorsiflexion"
begins = "E3"
at_percent = [50, -10]
angle_deg = [12, -5, 1]
slope_deg = 0
curvature_deg = -600

[[ankle.knot]]
name = "push-off"
begins = "F"
at_percent = 66
angle_deg = -10
slope_deg = 0
curvature_deg = 2500
"#;

fn refused(text: &str) -> String {
    match Gait::from_toml(text) {
        Err(error @ GaitError::Toml(_)) => error.to_string(),
        Err(error) => panic!("an error without line: {error}"),
        Ok(gait) => panic!("accepted: {gait:?}"),
    }
}

fn changed(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "`{from}` must stand once");
    refused(&text.replace(from, to))
}

fn walk(gait: &Gait) -> Walk {
    Walk::new(gait, LEG, &mut Findings::default()).unwrap()
}

#[test]
fn an_empty_file_is_free_walking() {
    let gait = Gait::from_toml("").unwrap();
    assert_eq!(
        Gait { name: "free".into(), pace: Gait::named("free").unwrap().pace, ..gait.clone() },
        Gait::named("free").unwrap()
    );
    assert!((walk(&gait).dimensionless_speed() - 0.429).abs() < 1e-12);
}

#[test]
fn a_gait_of_one_s_own_sub_cycles_is_walked() {
    let gait = Gait::from_toml(KNEE_1997).unwrap();
    assert_eq!((gait.name.as_str(), gait.style, gait.pelvis), ("marching", Style::Paper1997, Pelvis::Vertical));
    let walk = walk(&gait);
    let knee = &walk.legs().knee;
    let v = walk.curve_speed(&walk.clock(0.0)).value;
    assert!((walk.speed() - 1.2).abs() < 1e-12);
    // 40 + 30 V* degrees, times a step height of 1.3, at 70 + 4 V* percent.
    let peak = knee.at(Jet::constant(0.70 + 0.04 * v), Jet::constant(v)).value.to_degrees();
    assert!((peak - 1.3 * (40.0 + 30.0 * v)).abs() < 1e-10, "{peak}");
    assert_eq!(walk.legs().hip.knots().len(), 3, "the hip is that of the style");
}

#[test]
fn a_gait_of_one_s_own_knots_is_walked() {
    let gait = Gait::from_toml(ANKLE).unwrap();
    let walk = walk(&gait);
    assert_eq!(walk.name(), "flat-footed");
    assert!((walk.dimensionless_speed() - 0.290).abs() < 1e-12, "the speed of its base");
    let off = walk.legs().ankle.at(Jet { value: 0.66, rate: 1.0, acceleration: 0.0 }, Jet::constant(0.29));
    assert!((off.value.to_degrees() + 10.0).abs() < 1e-10 && off.rate.abs() < 1e-10);
    assert!((off.acceleration.to_degrees() - 2500.0).abs() < 1e-7);
}

#[test]
fn pace_is_read_in_the_units_of_the_keys() {
    let gait = Gait::from_toml("step_length = 0.7\ncadence = 120").unwrap();
    let walk_of = |text: &str| walk(&Gait::from_toml(text).unwrap());
    assert!((walk(&gait).speed() - 1.4).abs() < 1e-12);
    assert!((walk(&gait).cycle_s() - 1.0).abs() < 1e-12);
    assert!((walk_of("speed = 1.4\ncycle_s = 1.0").step_length() - 0.7).abs() < 1e-12);
    assert!((walk_of("step_length = 0.65").step_length() - 0.65).abs() < 1e-12);
    assert!((walk_of("cadence = 100").cycle_s() - 1.2).abs() < 1e-12);
    assert!((walk_of("dimensionless_speed = 0.3").dimensionless_speed() - 0.3).abs() < 1e-12);
    let scaled = walk_of("base = \"standard\"\ncadence_scale = 1.25\nstep_length_scale = 0.9");
    assert!((scaled.cycle_s() - 0.8).abs() < 1e-12 && (scaled.step_length() - 0.675).abs() < 1e-12);
    let gait = Gait::from_toml("base = \"standard\"\nspeed = 1.1").unwrap();
    assert_eq!(
        (gait.pace.speed, gait.pace.step_frequency),
        (Some(Speed::MetersPerSecond(1.1)), None),
        "the base gives way"
    );
    let children = walk_of("dimensionless_speed = 0.6\ncadence_exponent = 0.577");
    assert!((children.cycle_s() - 2.0 / 0.565 * (0.429_f64 / 0.6).powf(0.577) * (LEG / 9.81).sqrt()).abs() < 1e-12);
}

#[test]
fn changes_move_single_knots() {
    let text = "[[change]]\njoint = \"knee\"\nknot = \"swing peak\"\nscale = 0.5\nangle_deg = 3\ntime_percent = -1\n";
    let (usual, stiff) = (walk(&Gait::from_toml("").unwrap()), walk(&Gait::from_toml(text).unwrap()));
    let knots = usual.legs().knee.knots().iter().zip(stiff.legs().knee.knots());
    for (a, b) in knots {
        if a.name == "swing peak" {
            let expected = 0.5 * a.angle.at(0.4) + 3.0_f64.to_radians();
            assert!((b.angle.at(0.4) - expected).abs() < 1e-14);
            assert!((b.curvature.at(0.4) - 0.5 * a.curvature.at(0.4)).abs() < 1e-12);
            assert!((b.phase.at(0.4) - a.phase.at(0.4) + 0.01).abs() < 1e-14);
        } else {
            assert_eq!(a, b);
        }
    }
    assert_eq!(usual.legs().hip, stiff.legs().hip);
}

#[test]
fn the_built_in_laws_are_read() {
    for style in [Style::Knots, Style::Paper1997] {
        Laws::built_in(style).unwrap_or_else(|e| panic!("{style:?}: {e}"));
    }
    for name in Gait::NAMES {
        walk(&Gait::named(name).unwrap());
    }
}

#[test]
fn unknown_words_are_named_with_line_and_key() {
    assert_eq!(
        refused("name = \"a\"\nstyle = \"1979\""),
        "line 2, `style`: found \"1979\"; expected one of \"knots\", \"1997\". hint: did you mean \"1997\"?"
    );
    let text = refused("speeed = 1.0");
    assert!(text.starts_with("line 1, `speeed`: unknown key; expected `name`, `base`,"), "{text}");
    assert!(text.ends_with("hint: did you mean `speed`?"), "{text}");
    let text = refused("base = \"gose\"");
    assert!(
        text.starts_with("line 1, `base`: found \"gose\"; expected one of \"standard\"")
            && text.ends_with("did you mean \"goose\"?")
    );
    let text = refused("[[change]]\njoint = \"knee\"\nknot = \"swingpeak\"");
    assert!(
        text.starts_with("line 3, `change[1].knot`: found \"swingpeak\"; expected one of the knee's knots"),
        "{text}"
    );
    assert!(text.ends_with("did you mean \"swing peak\"?"), "{text}");
    let text = refused("name = \"a\"\nspeed = fast");
    assert!(text.starts_with("line 2: this is not TOML") && text.ends_with("see docs/GAITS.md"), "{text}");
}

#[test]
fn numbers_that_no_gait_can_have_are_refused() {
    for speed in ["0", "-1.3", "nan", "inf", "\"fast\""] {
        let text = refused(&format!("name = \"a\"\nspeed = {speed}"));
        assert!(text.starts_with("line 2, `speed`: found ") && text.contains("expected a number above zero"), "{text}");
    }
    assert_eq!(
        refused("speed = 1e6"),
        "line 1, `speed`: found 1e6; expected 0.05 to 5 m/s, because slower is standing and faster is running"
    );
    for (line, range) in [
        ("step_length = 1e-9", "0.02 to 3 m"),
        ("step_length = 75", "0.02 to 3 m"),
        ("cadence = 0.001", "5 to 1000 steps/min"),
        ("cycle_s = 1e-308", "5 to 1000 steps/min"),
        ("cycle_s = 1000", "5 to 1000 steps/min"),
        ("step_length_scale = 0.1\nstep_length = 0.19", "0.02 to 3 m"),
    ] {
        let text = refused(line);
        assert!(text.contains(range) && text.contains("because"), "{text}");
    }
    assert_eq!(refused("step_height = 30"), "line 1, `step_height`: found 30; expected a factor from 0.1 to 10");
    assert_eq!(
        refused("cadence_exponent = 1"),
        "line 1, `cadence_exponent`: found 1; expected an exponent from 0 to below 1"
    );
}

#[test]
fn changes_of_pace_are_read_in_the_units_of_the_keys() {
    let text = "speed = 0\n[[pace_change]]\nat = 1\nspeed = 1.2\n\
                [[pace_change]]\nat = 4\nwithin = 0.5\nstep_length = 0.6\ncadence = 120\n";
    let gait = Gait::from_toml(text).unwrap();
    let [first, second] = gait.pace_changes[..] else { panic!("{:?}", gait.pace_changes) };
    assert_eq!((first.start_s, first.duration_s, first.speed), (1.0, None, Some(1.2)));
    assert_eq!((second.duration_s, second.step_length, second.step_frequency), (Some(0.5), Some(0.6), Some(2.0)));
    assert!((walk(&gait).speed_at(5.0) - 1.2).abs() < 1e-12 && walk(&gait).speed().abs() < 1e-12);
    assert_eq!(
        refused("[[pace_change]]\nat = 1"),
        "line 1, `pace_change[1]`: found no speed, step_length or cadence; expected at least one of them"
    );
    assert!(refused("[[pace_change]]\nspeed = 1").contains("the time at which the change begins [s]"));
    assert!(refused("[[pace_change]]\nat = -1\nspeed = 1").starts_with("line 2, `pace_change[1].at`: found -1"));
    assert!(refused("[[pace_change]]\nat = 1\nspeed = 1\nwithin = 0").starts_with("line 4, `pace_change[1].within`"));
    assert!(refused("speed = 0").contains("expected a number above zero"));
}

#[test]
fn contradictions_are_refused() {
    assert_eq!(
        refused("speed = 1\nstep_length = 0.7\ncadence = 120"),
        "line 1, `speed`: found 1; expected the step length times the step frequency, 1.4000 m/s. hint: leave out one \
         of speed, \
         step length and frequency"
    );
    assert_eq!(
        refused("speed = 1\n\ndimensionless_speed = 0.4"),
        "line 3, `dimensionless_speed`: found both `speed` and `dimensionless_speed`; expected one of them"
    );
    assert!(refused("cadence = 100\ncycle_s = 1").starts_with("line 2, `cycle_s`: found both"));
    assert!(
        Gait::from_toml("speed = 1.4\nstep_length = 0.7\ncadence = 120").is_ok(),
        "three that agree are no contradiction"
    );
}

#[test]
fn overlapping_and_parted_sub_cycles_are_refused() {
    let overlap = changed(KNEE_1997, "name = \"E\"\nfrom_percent = [70, 4]", "name = \"E\"\nfrom_percent = [65, 4]");
    assert_eq!(
        overlap,
        "line 15, `knee.sub_cycle[2]`: sub-cycle E overlaps sub-cycle F (by 5.0 % of the cycle at free speed); \
         expected \
         `from_percent` to be equal to `to_percent` of the previous one"
    );
    let gap = changed(KNEE_1997, "to_percent = 140", "to_percent = 135");
    assert!(
        gap.starts_with("line 6, `knee.sub_cycle[1]`: sub-cycle F leaves a gap after sub-cycle E (by 5.0 %"),
        "{gap}"
    );
    let jump = changed(KNEE_1997, "to_deg = 5", "to_deg = 6");
    assert!(
        jump.starts_with(
            "line 6, `knee.sub_cycle[1]`: sub-cycle F starts at another angle than the end of sub-cycle E"
        ),
        "{jump}"
    );
}

#[test]
fn knots_out_of_order_are_refused() {
    let text = changed(ANKLE, "at_percent = 66", "at_percent = 40");
    assert!(text.starts_with("line 20, `ankle.knot[3]`: found 40.0 % after 4"), "{text}");
    assert!(
        text.ends_with("expected knots in the order of their times, at least 0.5 % apart, within one cycle"),
        "{text}"
    );
    let text = changed(ANKLE, "at_percent = 66", "at_percent = 100.2");
    assert!(text.starts_with("line 4, `ankle.knot[1]`: found 100.0 % after 100.2 %"), "{text}");
    let text = refused(
        "[[change]]\njoint = \"hip\"\nknot = \"loading\"\nscale = 1\n[[change]]\njoint = \"knee\"\nknot = \"stance \
         peak\"\ntime_percent = 15",
    );
    assert!(
        text.starts_with("line 5, `change[2]`: with all changes, at knot `fastest stance extension`: found"),
        "{text}"
    );
}

#[test]
fn angles_that_no_joint_has_are_refused() {
    let text = changed(KNEE_1997, "from_deg = 5\nto_deg = [40, 30]", "from_deg = 5\nto_deg = [170, 30]");
    // The next sub-cycle begins elsewhere, which is found first.
    assert!(text.contains("starts at another angle"), "{text}");
    let text = refused(&KNEE_1997.replace("[40, 30]", "[170, 30]"));
    assert!(text.starts_with("line 6, `knee.sub_cycle[1]`: found 1"), "{text}");
    assert!(text.ends_with("expected knee angles from -15° to 160°"), "{text}");
    let text = refused("[[change]]\njoint = \"ankle\"\nknot = \"push-off peak\"\nangle_deg = -60");
    assert!(
        text.starts_with("line 1, `change[1]`: with all changes, at knot `") && text.contains("ankle angles"),
        "{text}"
    );
}

#[test]
fn rules_of_style_1997_are_kept() {
    let text = refused(&KNEE_1997.replace("[70, 4]", "[70, 4, 1]"));
    assert!(
        text.ends_with(
            "expected a number, or a linear law [c0, c1] of dimensionless speed, because the style is \"1997\""
        ),
        "{text}"
    );
    let text = changed(KNEE_1997, "style = \"1997\"", "style = \"knots\"");
    assert!(
        text.ends_with(
            "found `sub_cycle` in a gait of style \"knots\"; expected `knot`. hint: style \"1997\" has sub-cycles, \
             style \
             \"knots\" has knots"
        ),
        "{text}"
    );
    let text = refused("style = \"1997\"\n[[change]]\njoint = \"knee\"\nknot = \"swing peak\"\nslope_deg = 3");
    assert!(text.starts_with("line 5, `change[1].slope_deg`: found a change of slope"), "{text}");
    // A knee whose yield turns into an extension at low speed.
    let text = refused(&KNEE_1997.replace("[40, 30]", "[0, 30]"));
    assert!(
        text.contains("found a sub-cycle that turns by") && text.contains("the same direction at every speed"),
        "{text}"
    );
}

#[test]
fn laws_have_one_to_three_numbers() {
    let text = changed(ANKLE, "[12, -5, 1]", "[12, -5, 1, 0]");
    assert!(
        text.ends_with("expected a number, or a law [c0, c1, c2] of dimensionless speed with one to three numbers"),
        "{text}"
    );
    assert!(changed(ANKLE, "[12, -5, 1]", "[]").starts_with("line 16, `ankle.knot[2].angle_deg`: found []"));
    assert!(changed(ANKLE, "[12, -5, 1]", "\"12\"").starts_with("line 16, `ankle.knot[2].angle_deg`: found \"12\""));
}

#[test]
fn a_curve_needs_two_knots() {
    let one = ANKLE.split("\n[[ankle.knot]]\nname = \"largest").next().unwrap();
    assert!(refused(one).contains("found fewer than two of `knot`; expected two or more"));
}

const DOCUMENT: &str = include_str!("../../../docs/GAITS.md");

#[test]
fn the_gaits_of_the_document_are_walked() {
    let blocks: Vec<&str> = DOCUMENT.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect();
    assert_eq!(blocks.len(), 4);
    for block in blocks {
        let gait = Gait::from_toml(block).unwrap_or_else(|e| panic!("{e} in\n{block}"));
        walk(&gait);
    }
}

#[test]
fn the_document_has_every_knot_and_gait() {
    for style in [Style::Knots, Style::Paper1997] {
        let laws = Laws::built_in(style).unwrap();
        for joint in LegJoint::ALL {
            let row = DOCUMENT.lines().find(|line| line.starts_with(&format!("| {} | ", joint.name()))).unwrap();
            for knot in laws.legs.of(joint).knots() {
                assert!(row.contains(&knot.name), "{row} lacks {}", knot.name);
            }
        }
    }
    for name in Gait::NAMES {
        assert!(DOCUMENT.contains(&format!("`{name}`")), "{name}");
    }
}

/// Every key that a refusal lists stands in the document.
#[test]
fn the_document_has_every_key() {
    let files = [
        "x = 1",
        "[[change]]\nx = 1",
        "[[pace_change]]\nx = 1",
        "[[hip.knot]]\nx = 1",
        "style = \"1997\"\n[[hip.sub_cycle]]\nx = 1",
    ];
    for file in files {
        let message = refused(file);
        let keys = message.split("expected ").nth(1).unwrap().split('`').skip(1).step_by(2);
        for key in keys {
            let shown = [format!("`{key}`"), format!("\n{key} = "), format!("[[{key}]]"), format!("[[{key}.knot]]")];
            assert!(shown.iter().any(|shown| DOCUMENT.contains(shown)), "docs/GAITS.md lacks {key}");
        }
    }
}

proptest! {
    /// Whatever is cut off, doubled or replaced: an answer, never a panic.
    #[test]
    fn no_file_makes_the_reader_panic(cut in 0..700_usize, from in 0..700_usize,
        word in "[a-z0-9_\\[\\]=.\" -]{0,12}") {
        for text in [KNEE_1997, ANKLE] {
            let cut = text.floor_char_boundary(cut.min(text.len()));
            let from = text.floor_char_boundary(from.min(text.len()));
            let broken = format!("{}{word}{}", &text[..cut], &text[from..]);
            if let Ok(gait) = Gait::from_toml(&broken) {
                let _ = Walk::new(&gait, LEG, &mut Findings::default());
            }
        }
    }
}
