//! Faults of a force in a table: spikes are bridged and reported, and columns that never move are named.
//!
//! | claim | tolerance |
//! |---|---|
//! | outside of a bridged spike force, point and moment are as recorded; inside they are a straight line | exact |
//! | a spike along each axis is bridged | 2 N |
//! | an excursion of 50 ms is bridged, one of 51 ms is reported as a lost signal | exact |
//! | missing rows are reported; points of light loads are held near the foot | 0.3 m |
//! | rows without a force are no load in a table that leaves out all light loads, and a gap in others | exact |
//! | clean tables, and those of a plane, are silent | exact |

use ambulo::findings::{Code, Findings};
use ambulo::formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo::formats::table::Table;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::motion::{ForceRecording, force_recordings};
use ambulo::spatial::Vec3;
use std::ops::Range;

const RATE_HZ: f64 = 1000.0;
const FRAMES: usize = 900;
/// Names of the columns of one load after its prefix.
const COLUMNS: [&str; 9] = ["vx", "vy", "vz", "px", "py", "pz", "x", "y", "z"];

/// Two stances of 0.4 s, one of each foot, as half sines of 800 N, with shear and a travelling point.
fn columns() -> Vec<(String, Vec<f64>)> {
    let time = |i: usize| i as f64 / RATE_HZ;
    let mut columns = vec![("time".to_owned(), (0..FRAMES).map(time).collect::<Vec<f64>>())];
    for (load, start) in [("right_", 50), ("left_", 450)] {
        let phase = |i: usize| (i as f64 - f64::from(start)) / 400.0;
        let load_n = |i: usize| {
            if (0.0..1.0).contains(&phase(i)) { 800.0 * (std::f64::consts::PI * phase(i)).sin() } else { 0.0 }
        };
        let shear = |i: usize| 0.2 * load_n(i) * (std::f64::consts::TAU * phase(i)).sin();
        let of = |name: &str| -> Vec<f64> {
            let value = |i: usize| match name {
                "vx" => shear(i),
                "vy" => load_n(i),
                "vz" => 0.05 * load_n(i),
                "px" => 0.2 * phase(i),
                "y" => 0.01 * shear(i),
                _ => 0.0,
            };
            (0..FRAMES).map(value).collect()
        };
        columns.extend(COLUMNS.map(|name| (format!("{load}{name}"), of(name))));
    }
    columns
}

fn set(columns: &mut [(String, Vec<f64>)], name: &str, rows: Range<usize>, value: f64) {
    columns.iter_mut().find(|(known, _)| known == name).unwrap().1[rows].fill(value);
}

fn read(columns: Vec<(String, Vec<f64>)>) -> (Vec<ForceRecording>, Findings) {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: false };
    let model = build.human().unwrap().model;
    let table = Table::new("forces", columns).unwrap();
    let load = |(side, body): (&str, &str)| ExternalForce::with_prefix(side, body, &format!("{side}_"));
    let forces = [("right", "calcn_r"), ("left", "calcn_l")].map(load).to_vec();
    let mut findings = Findings::default();
    let loads = ExternalLoads { name: "feet".into(), datafile: None, forces };
    (force_recordings(&model, &loads, &table, &mut findings).unwrap(), findings)
}

fn message(findings: &Findings, code: Code) -> Option<String> {
    findings.as_slice().iter().find(|finding| finding.code == code).map(|finding| finding.message.clone())
}

#[test]
fn a_spike_in_a_table_is_bridged_with_its_point_and_its_moment() {
    let (clean, findings) = read(columns());
    assert_eq!(findings.as_slice(), []);
    let mut spoiled = columns();
    set(&mut spoiled, "right_vy", 200..203, -6000.0);
    set(&mut spoiled, "right_px", 200..203, 4.0);
    set(&mut spoiled, "right_y", 200..203, 90.0);
    let (found, findings) = read(spoiled);
    let said = message(&findings, Code::PlatesExcursion).unwrap();
    assert!(said.contains("the force `right` along y jumps away and back, first at 0.200 s, 1 time in all"), "{said}");
    for i in 0..FRAMES {
        let inside = (200..203).contains(&i);
        let share = (i as f64 - 199.0) / 4.0;
        let expected = |values: &dyn Fn(usize) -> Vec3| match inside {
            true => values(199) + (values(203) - values(199)) * share,
            false => values(i),
        };
        let [own, other] = [&found[0], &clean[0]];
        assert!((own.force[i] - expected(&|k| other.force[k])).norm() < 1e-9, "force {i}");
        assert!((own.point[i] - expected(&|k| other.point[k])).norm() < 1e-9, "point {i}");
        assert!((own.moment[i] - expected(&|k| other.moment[k])).norm() < 1e-9, "moment {i}");
    }
    assert_eq!(found[1], clean[1]);
}

#[test]
fn a_spike_along_any_axis_is_bridged() {
    let (clean, _) = read(columns());
    for (column, axis, value) in [("left_vx", "x", 900.0), ("left_vz", "z", -700.0)] {
        let mut spoiled = columns();
        set(&mut spoiled, column, 600..604, value);
        let (found, findings) = read(spoiled);
        let said = message(&findings, Code::PlatesExcursion).unwrap();
        assert!(said.contains(&format!("the force `left` along {axis} jumps away and back")), "{said}");
        // A straight line over 5 ms is nearly the half sine.
        let off = (0..FRAMES).map(|i| (found[1].force[i] - clean[1].force[i]).norm()).fold(0.0, f64::max);
        assert!(off < 2.0, "{column}: {off} N");
    }
}

#[test]
fn what_lasts_longer_than_50_ms_is_lost() {
    for (length, is_brief) in [(50, true), (51, false)] {
        let mut spoiled = columns();
        set(&mut spoiled, "right_vy", 200..200 + length, 0.0);
        let (_, findings) = read(spoiled);
        assert_eq!(findings.has(Code::PlatesExcursion), is_brief, "{length} ms");
        assert_eq!(findings.has(Code::PlatesLost), !is_brief, "{length} ms");
    }
}

#[test]
fn rows_that_are_missing_under_a_load_are_reported() {
    let without = |rows: Range<usize>| {
        let mut columns = columns();
        columns.iter_mut().for_each(|(_, values)| drop(values.drain(rows.clone())));
        message(&read(columns).1, Code::PlatesLost)
    };
    let said = without(200..300).unwrap();
    assert!(said.contains("the force `right` has no rows from 0.199 to 0.300 s, under a load"), "{said}");
    assert_eq!(without(200..230), None);
}

#[test]
fn points_far_from_the_foot_under_a_light_load_are_held() {
    let (clean, _) = read(columns());
    let light = |i: usize| clean[0].force[i].norm() < 100.0;
    let mut spoiled = columns();
    let point = spoiled.iter_mut().find(|(known, _)| known == "right_px").unwrap();
    (0..FRAMES).filter(|i| light(*i)).for_each(|i| point.1[i] = 9999.0);
    let (found, findings) = read(spoiled);
    let said = message(&findings, Code::LoadsLightPoint).unwrap();
    assert!(said.contains("points of the load `right` lie up to ") && !findings.has(Code::LoadsMillimetres), "{said}");
    for i in (0..FRAMES).filter(|i| clean[0].force[*i].norm() > 1.0) {
        let off = (found[0].point[i] - clean[0].point[i]).norm();
        assert!(off < 0.3, "{i}: {off} m");
    }
}

#[test]
fn a_column_that_never_moves_is_named_unless_the_table_is_of_a_plane() {
    let still = |columns| message(&read(columns).1, Code::PlatesStillChannel);
    let mut dead = columns();
    set(&mut dead, "left_vx", 0..FRAMES, 0.0);
    let said = still(dead).unwrap();
    assert!(said.contains("the force `left` carries a load of 8") && said.contains("one value along x"), "{said}");
    // Noise without a load, and zeros of either sign under it.
    let mut silent = columns();
    let load = silent.iter().find(|(name, _)| name == "left_vy").unwrap().1.clone();
    for (row, load_n) in load.into_iter().enumerate() {
        let noise = if row % 2 == 0 { 0.3 } else { -0.3 };
        set(&mut silent, "left_vx", row..row + 1, if load_n > 10.0 { noise * 0.0 } else { noise });
    }
    assert!(still(silent).unwrap().contains("one value along x"));
    let mut plane = columns();
    for load in ["left_vz", "right_vz"] {
        set(&mut plane, load, 0..FRAMES, 0.0);
    }
    assert_eq!(still(plane.clone()), None, "a plane has no force across it");
    set(&mut plane, "left_vz", 0..FRAMES, 3.0);
    assert!(still(plane).unwrap().contains("one value along z"));
    let mut idle = columns();
    for name in ["vx", "vy", "vz"] {
        set(&mut idle, &format!("left_{name}"), 0..FRAMES, 0.0);
    }
    assert_eq!(still(idle), None, "a load that carries nothing is no broken one");
}

#[test]
fn a_table_that_leaves_out_light_loads_has_no_load_there() {
    let emptied = |below_n: f64, extra: Range<usize>| {
        let mut columns = columns();
        let load: Vec<f64> = columns.iter().find(|(name, _)| name == "right_vy").unwrap().1.clone();
        for name in COLUMNS {
            for row in (0..FRAMES).filter(|row| load[*row] < below_n || extra.contains(row)) {
                set(&mut columns, &format!("right_{name}"), row..row + 1, f64::NAN);
            }
        }
        read(columns)
    };
    let (whole, _) = read(columns());
    let (recordings, findings) = emptied(20.0, 0..0);
    let said = message(&findings, Code::LoadsPointUndefined).unwrap();
    assert!(said.contains("`right`") && said.contains("no load"), "{said}");
    for (force, known) in recordings[0].force.iter().zip(&whole[0].force) {
        assert_eq!(*force, if known.y < 20.0 { Vec3::zeros() } else { *known });
    }
    assert_eq!(findings.as_slice().len(), 1, "{findings:?}");
    // Rows that are missing under a load are a gap, and so are those of a table that writes its light loads.
    for (below_n, extra) in [(20.0, 200..260), (-1.0, 500..520)] {
        let (recordings, findings) = emptied(below_n, extra.clone());
        assert!(recordings[0].force[extra.start].x.is_nan(), "{below_n}");
        assert!(!findings.has(Code::LoadsPointUndefined), "{below_n}");
    }
}
