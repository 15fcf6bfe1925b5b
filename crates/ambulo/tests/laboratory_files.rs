//! Recordings as laboratories write them: plates, axes, feet on plates, events.
//!
//! The recordings are not part of the repository. They are looked for in `shared/data` beside it, or in
//! `$AMBULO_DATA/data`; without them each test says `skipped` and passes.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "the figures are shown with --show-output")]

use ambulo::analysis::event_agreement;
use ambulo::findings::Findings;
use ambulo::ground::foot_motion::foot_motion;
use ambulo::ground::phases::contacts;
use ambulo::model::Side;
use ambulo::motion::{
    Event, EventKind, Laboratory, MarkerRecording, PlateRecording, PlateSettings, laboratory, markers_from_c3d,
    markers_from_trc, plates_from_c3d,
};
use ambulo_formats::c3d::C3d;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use std::path::{Path, PathBuf};

fn data() -> Option<PathBuf> {
    let folder = match std::env::var_os("AMBULO_DATA") {
        Some(root) => PathBuf::from(root).join("data"),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
    };
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: no data");
    None
}

/// A trial in the world's axes.
struct Trial {
    markers: MarkerRecording,
    plates: Vec<PlateRecording>,
    laboratory: Laboratory,
    file: C3d,
    findings: Findings,
}

fn trial(folder: &Path, name: &str) -> Trial {
    let (file, _) = C3d::read(&std::fs::read(folder.join(name)).unwrap()).unwrap();
    let mut findings = Findings::default();
    let plates = plates_from_c3d(&file, PlateSettings::default(), &mut findings).unwrap();
    let markers = markers_from_c3d(&file, &mut findings).unwrap();
    let laboratory = laboratory(&markers, &plates, &file.point_unit, &mut findings);
    Trial {
        markers: laboratory.markers(&markers),
        plates: plates.iter().map(|p| laboratory.plate(p)).collect(),
        laboratory,
        file,
        findings,
    }
}

/// A plate's contacts of one foot, as the data's README tells them: plate, side, first and last loaded instant [s],
/// peak [body weights].
type Told = (usize, Side, f64, f64, f64);

const R: Side = Side::Right;
const L: Side = Side::Left;

const HC032A03: [Told; 2] = [(1, R, 1.667, 2.282, 1.04), (0, L, 2.191, 2.819, 1.15)];
const HC002D06: [Told; 2] = [(1, R, 1.830, 2.350, 1.25), (0, L, 2.284, 2.807, 1.19)];
const BTKDATA: [Told; 3] = [(0, L, 7.853, 8.511, 1.09), (1, R, 8.382, 9.045, 1.13), (2, L, 8.93, 9.60, 1.14)];

fn events_of(told: &[Told]) -> Vec<Event> {
    let event = |side, kind, time_s| Event { side, kind, time_s };
    told.iter().flat_map(|t| [event(t.1, EventKind::Strike, t.2), event(t.1, EventKind::Off, t.3)]).collect()
}

fn trc(path: &Path) -> MarkerRecording {
    let (file, _) = Trc::read(&std::fs::read(path).unwrap()).unwrap();
    let mut findings = Findings::default();
    let markers = markers_from_trc(&file, &mut findings).unwrap();
    laboratory(&markers, &[], file.unit.symbol(), &mut findings).markers(&markers)
}

/// Events from the vertical force columns of a table.
fn events_of_table(path: &Path, columns: [(Side, &str); 2], until_s: f64) -> Vec<Event> {
    let (table, _) = Table::read_storage(&std::fs::read(path).unwrap()).unwrap();
    let mut out = Vec::new();
    for (side, column) in columns {
        for contact in contacts(table.times().unwrap(), table.column(column).unwrap()) {
            let event = |kind, time_s| Event { side, kind, time_s };
            out.extend(contact.strike_s.map(|t| event(EventKind::Strike, t)));
            out.extend(contact.off_s.map(|t| event(EventKind::Off, t)));
        }
    }
    out.retain(|e| e.time_s < until_s);
    out
}

#[test]
fn events_from_motion_are_those_of_the_plates_within_the_published_errors() {
    let Some(data) = data() else { return };
    let c3d = |name: &str, told: &[Told]| {
        let trial = trial(&data, name);
        (name.to_owned(), trial.markers, events_of(told))
    };
    let opensim = |markers: &str, forces: &str, columns: [(Side, &str); 2], until_s: f64| {
        let events = events_of_table(&data.join(forces), columns, until_s);
        (markers.to_owned(), trc(&data.join(markers)), events)
    };
    let recordings = [
        c3d("biomechzoo-HC032A/HC032A03.c3d", &HC032A03),
        c3d("biomechzoo-HC002D/HC002D06.c3d", &HC002D06),
        c3d("btkdata-pig-adult3plates/PiG_Motion3_FF.c3d", &BTKDATA),
        opensim(
            "opensim-rajagopal-walk/markers_walk.trc",
            "opensim-rajagopal-walk/grf_walk.mot",
            [(R, "ground_force_r_vy"), (L, "ground_force_l_vy")],
            2.3,
        ),
        opensim(
            "opensim-gait2392-subject01/subject01_walk1.trc",
            "opensim-gait2392-subject01/subject01_walk1_grf.mot",
            [(R, "ground_force_vy"), (L, "1_ground_force_vy")],
            2.4,
        ),
        opensim(
            "opensim-rajagopal-run/motion_capture_run.trc",
            "opensim-rajagopal-run/grf_run.mot",
            [(R, "R_ground_force_vy"), (L, "L_ground_force_vy")],
            5.2,
        ),
    ];
    for (name, markers, reference) in recordings {
        let found = foot_motion(&markers, &mut Findings::default());
        println!("{name}: walking {:.2} m/s, floor {:.2} m/s", found.walking_speed_m_s, found.floor_speed_m_s);
        let rows = found.by_method.iter().map(|(m, e)| (m.name(), e));
        for (method, events) in rows.chain([("agreed", &found.events)]) {
            for row in event_agreement(&reference, events) {
                println!(
                    "   {method:<60} {:<6} {} pairs, {} missed, {} extra, mean {:.1} ms, bias {:+.1} ms",
                    row.kind, row.pairs, row.missed, row.extra, row.mean_absolute_ms, row.bias_ms
                );
            }
        }
    }
}
