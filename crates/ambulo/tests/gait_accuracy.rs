//! The default curves against the normative means that they were fitted to: Schwartz, Rozumalski, Trost 2008, five
//! speeds.
//!
//! The tables are not part of the repository. They are looked for in `shared/data` next to it, or in
//! `$AMBULO_DATA/data`; without them the tests say `skipped` and pass.

use ambulo::findings::Findings;
use ambulo::gait::{Gait, Jet, Laws, LegJoint, Speed, Style, Walk};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

const SPEEDS: [(&str, f64); 5] =
    [("VerySlow", 0.172), ("Slow", 0.290), ("Free", 0.429), ("Fast", 0.560), ("VeryFast", 0.694)];
/// What issue 4 asks for [deg].
const ALLOWED_DEG: f64 = 1.5;
/// Second derivatives, relative to their own size: between the 0.04 and 0.36 of `literature.md` 1.3 that knots with
/// true values have, though here the knots follow laws of speed.
const ALLOWED_ACCELERATION: f64 = 0.30;

fn table(name: &str) -> Option<String> {
    let folder = match std::env::var_os("AMBULO_DATA") {
        Some(root) => PathBuf::from(root).join("data"),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    let found = std::fs::read_to_string(folder.join("normative").join(name)).ok();
    if found.is_none() {
        assert!(std::env::var_os("CI").is_none(), "no recordings, and in CI no test may be skipped");
        println!("skipped: no data");
    }
    found
}

/// Means of a quantity at a speed, 0 % to 98 % [deg].
fn means(table: &str, quantity: &str, speed: &str) -> Vec<f64> {
    let start = format!("{quantity},{speed},");
    let cells = table.lines().filter_map(|line| line.strip_prefix(&start)?.split(',').nth(1)?.parse().ok());
    let values: Vec<f64> = cells.collect();
    assert_eq!(values.len(), 51, "{quantity} {speed}");
    values
}

/// Second derivative [deg/cycle²] of the first twelve harmonics at a phase, the step from 100 % to 0 % taken out as a
/// line.
fn second_derivative(means: &[f64], phase: f64) -> f64 {
    let step = means[50] - means[0];
    let sum = |order: usize| {
        let turn = TAU * order as f64;
        let term = |i: usize| {
            let share = i as f64 / 50.0;
            (means[i] - step * (share - 0.5)) * (turn * (share - phase)).cos()
        };
        -turn * turn * (0..50).map(term).sum::<f64>() / 25.0
    };
    (1..=12).map(sum).sum()
}

fn quantity(joint: LegJoint) -> &'static str {
    match joint {
        LegJoint::Hip => "Hip Flex/Extension",
        LegJoint::Knee => "Knee Flex/Extension",
        LegJoint::Ankle => "Ankle Dorsi/Plantarflexion",
    }
}

/// RMS error of the angle [deg], and of the second derivative relative to its own.
fn errors(table: &str, style: Style, joint: LegJoint, speed: usize) -> (f64, f64) {
    let laws = Laws::built_in(style).unwrap();
    let means = means(table, quantity(joint), SPEEDS[speed].0);
    let v = Jet::constant(SPEEDS[speed].1);
    let curve = |phase: f64| laws.legs.of(joint).at(Jet { value: phase, rate: 1.0, acceleration: 0.0 }, v);
    let square = |i: usize| (curve(i as f64 / 50.0).value.to_degrees() - means[i]).powi(2);
    let rms = ((0..50).map(square).sum::<f64>() / 50.0).sqrt();
    let (mut missed, mut total) = (0.0, 0.0);
    for i in 0..200 {
        let phase = i as f64 / 200.0;
        let expected = second_derivative(&means, phase);
        missed += (curve(phase).acceleration.to_degrees() - expected).powi(2);
        total += expected * expected;
    }
    (rms, f64::sqrt(missed / total))
}

#[test]
fn the_default_style_is_within_a_degree_and_a_half_of_the_means() {
    let Some(table) = table("schwartz2008_angles.csv") else { return };
    for joint in LegJoint::ALL {
        for (i, (name, _)) in SPEEDS.iter().enumerate() {
            let (angle, acceleration) = errors(&table, Style::Knots, joint, i);
            println!("{} {name}: angle {angle:.2} deg, acceleration {acceleration:.2}", joint.name());
            assert!(angle <= ALLOWED_DEG, "{joint:?} {name}: {angle} deg");
            assert!(acceleration <= ALLOWED_ACCELERATION, "{joint:?} {name}: acceleration {acceleration}");
        }
    }
}

/// The comparison can fail: the paper's rule misses angles by degrees and accelerations by more than half.
#[test]
fn the_paper_s_style_is_not() {
    let Some(table) = table("schwartz2008_angles.csv") else { return };
    for joint in LegJoint::ALL {
        let (angle, acceleration) = errors(&table, Style::Paper1997, joint, 2);
        println!("1997, {} Free: angle {angle:.2} deg, acceleration {acceleration:.2}", joint.name());
        assert!(angle > ALLOWED_DEG && acceleration > 0.5, "{joint:?}: {angle} deg, {acceleration}");
    }
}

#[test]
fn the_tilt_of_the_pelvis_is_within_half_a_degree() {
    let Some(table) = table("schwartz2008_angles.csv") else { return };
    let laws = Laws::built_in(Style::Knots).unwrap();
    for (name, v) in SPEEDS {
        let means = means(&table, "Pelvic Ant/Posterior Tilt", name);
        let error = |i: usize| {
            let tilt = laws.pelvis_tilt.at(Jet::constant(i as f64 / 50.0), Jet::constant(v)).value;
            (tilt.to_degrees() - means[i]).powi(2)
        };
        let rms = ((0..50).map(error).sum::<f64>() / 50.0).sqrt();
        println!("pelvis {name}: {rms:.2} deg");
        assert!(rms < 0.5, "{name}: {rms}");
    }
}

/// The table gives foot off in whole percents.
#[test]
fn feet_leave_the_ground_when_the_table_says() {
    let Some(table) = table("schwartz2008_cycle_events.csv") else { return };
    let row = table.lines().find(|line| line.starts_with("Ipsilateral Foot Off")).unwrap();
    let expected: Vec<f64> = row.split(',').skip(1).step_by(2).map(|cell| cell.parse().unwrap()).collect();
    for ((name, v), expected) in SPEEDS.iter().zip(expected) {
        let mut gait = Gait::named("free").unwrap();
        gait.pace.speed = Some(Speed::Dimensionless(*v));
        gait.pace.cadence_exponent = Some(ambulo::gait::CHILD_EXPONENT);
        let walk = Walk::new(&gait, 0.7, &mut Findings::default()).unwrap();
        let off = walk.foot_off(&walk.clock(0.0));
        println!("foot off {name}: {off:.3} instead of {expected:.2}");
        assert!((off - expected).abs() < 0.025, "{name}: {off} instead of {expected}");
    }
}
