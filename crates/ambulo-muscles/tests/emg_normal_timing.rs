//! Normal timing of muscles, made from recordings and compared with the table.
//!
//! `AMBULO_WRITE=1 cargo test -p ambulo-muscles emg_normal_timing` writes the table.

use crate::shared_data;
use ambulo_body::findings::Findings;
use ambulo_body::model::Side;
use ambulo_body::motion::{EventKind, events_from_c3d};
use ambulo_formats::c3d::C3d;
use ambulo_muscles::emg::{
    AnatomicalMuscle as M, EmgSettings, OnOffSettings, emg_from_c3d, envelopes, normal_timing, on_off,
};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/data/emg_timing.csv");
const MUSCLES: [M; 8] = [
    M::TibialisAnterior,
    M::Soleus,
    M::GastrocnemiusMedialis,
    M::VastusMedialis,
    M::RectusFemoris,
    M::Semitendinosus,
    M::GluteusMaximus,
    M::GluteusMedius,
];
const HEADER: &str = "\
# Made by `AMBULO_WRITE=1 cargo test -p ambulo-muscles emg_normal_timing`; do not edit.
#
# When muscles of the right leg are on in walking: share of persons in whom the muscle is on in each percent of the
# cycle. A percent is the interval from it to the next; the cycle begins with the strike of the right foot.
# Source: C. Schreiber, F. Moissenet 2019, \"A multimodal dataset of human gait at different walking speeds
# established on injury-free adult participants\" (Scientific Data 6:111, doi 10.1038/s41597-019-0124-4), licence
# CC BY 4.0: ten adults at their own speed (trials C4), one cycle each between the foot strikes of the files. Only
# shares of persons are kept here.
# On: the envelope (band-pass 20 to 450 Hz, rectified, low-pass 6 Hz) is above a fifth of its maximum in the cycle,
# for at least 5 % of the cycle. A channel without the signal of a muscle is not counted.
";

/// Trials at own speed, by person.
fn trials(data: &Path) -> Vec<PathBuf> {
    let mut persons: Vec<PathBuf> =
        fs::read_dir(data.join("adults-rehazenter")).unwrap().map(|entry| entry.unwrap().path()).collect();
    persons.sort();
    let own_speed = |person: &PathBuf| {
        let files = fs::read_dir(person).ok()?.map(|entry| entry.unwrap().path());
        files.into_iter().find(|file| file.to_string_lossy().contains("_C4_"))
    };
    persons.iter().filter_map(own_speed).collect()
}

/// Persons who are on in each percent, and their number, for each muscle.
fn counted(files: &[PathBuf]) -> Vec<(usize, Vec<usize>)> {
    let mut counts = vec![(0, vec![0; 100]); MUSCLES.len()];
    for file in files {
        let (c3d, _) = C3d::read(&fs::read(file).unwrap()).unwrap();
        let events = events_from_c3d(&c3d, &mut Findings::default());
        let is_strike = |e: &&ambulo_body::motion::Event| (e.side, e.kind) == (Side::Right, EventKind::Strike);
        let strikes: Vec<f64> = events.iter().filter(is_strike).map(|event| event.time_s).collect();
        assert_eq!(strikes.len(), 2, "{}: {strikes:?}", file.display());
        let recording = emg_from_c3d(&c3d, &[]).unwrap();
        let trial = envelopes(&[recording], &EmgSettings::default()).unwrap().remove(0);
        for (muscle, count) in MUSCLES.iter().zip(&mut counts) {
            let envelope = trial.envelopes.iter().find(|e| e.muscle == *muscle).unwrap();
            if !envelope.signal.is_muscle() {
                println!("{}: {}: {}", file.display(), envelope.channel, envelope.signal);
                continue;
            }
            let cycle = envelope.cycle(strikes[0], strikes[1]).unwrap();
            count.0 += 1;
            let on = on_off(&cycle, OnOffSettings::default());
            on.iter().zip(&mut count.1).for_each(|(on, sum)| *sum += usize::from(*on));
        }
    }
    counts
}

fn table(counts: &[(usize, Vec<usize>)]) -> String {
    let mut text = HEADER.to_owned();
    let persons: Vec<String> = counts.iter().map(|(persons, _)| persons.to_string()).collect();
    writeln!(text, "# Number of persons: {}", persons.join(", ")).unwrap();
    let names: Vec<String> = MUSCLES.iter().map(|muscle| muscle.to_string().replace(' ', "_")).collect();
    writeln!(text, "percent,{}", names.join(",")).unwrap();
    for percent in 0..100 {
        let share = |(persons, on): &(usize, Vec<usize>)| format!("{:.3}", on[percent] as f64 / *persons as f64);
        let shares: Vec<String> = counts.iter().map(share).collect();
        writeln!(text, "{percent},{}", shares.join(",")).unwrap();
    }
    text
}

#[test]
fn the_table_is_that_of_the_recordings() {
    let Some(data) = shared_data::data() else { return };
    let files = trials(&data);
    assert_eq!(files.len(), 10);
    let made = table(&counted(&files));
    if std::env::var_os("AMBULO_WRITE").is_some() {
        fs::write(TABLE, &made).unwrap();
    }
    assert!(fs::read_to_string(TABLE).unwrap() == made, "{TABLE} is out of date; run this test with AMBULO_WRITE=1");
}

#[test]
fn muscles_are_on_when_textbooks_say() {
    let mean = |muscle: M, range: std::ops::Range<usize>| {
        let share = &normal_timing(muscle).unwrap().share_on[range.clone()];
        share.iter().sum::<f64>() / range.len() as f64
    };
    // Phases of gait in texts (Perry and Burnfield 2010, unverified page): calf in mid and terminal stance, quadriceps
    // in loading response and late swing, tibialis anterior in swing and loading response, hamstrings in late swing,
    // gluteal muscles in loading response and mid-stance.
    for (muscle, on, off) in [
        (M::Soleus, 30..50, 70..85),
        (M::GastrocnemiusMedialis, 30..45, 70..85),
        (M::TibialisAnterior, 0..6, 30..45),
        (M::VastusMedialis, 2..12, 40..60),
        (M::Semitendinosus, 88..98, 35..55),
        (M::GluteusMedius, 2..20, 60..75),
        (M::GluteusMaximus, 0..12, 50..65),
    ] {
        let (on, off) = (mean(muscle, on), mean(muscle, off));
        assert!(on > 0.7 && on > off + 0.35, "{muscle}: on in {on:.2} of persons, and in {off:.2} when it should rest");
    }
}

#[test]
fn each_muscle_has_a_hundred_shares() {
    for muscle in MUSCLES {
        let timing = normal_timing(muscle).unwrap();
        assert_eq!(timing.share_on.len(), 100);
        assert!(timing.share_on.iter().all(|share| (0.0..=1.0).contains(share)));
        assert!(timing.is_on(0.0).iter().all(|on| *on));
    }
    assert!(normal_timing(M::Psoas).is_none());
}
