//! EMG of real recordings: names, kinds of signals, and when muscles work.

use crate::shared_data;
use ambulo_body::findings::Findings;
use ambulo_body::model::Side;
use ambulo_formats::c3d::{C3d, Channel};
use ambulo_formats::table::Table;
use ambulo_muscles::emg::{
    AnatomicalMuscle as M, EmgRecording, EmgSettings, EmgTrial, Processing, emg_from_c3d, emg_from_table, envelopes,
};
use std::fs;
use std::path::Path;

fn read(data: &Path, file: &str) -> EmgRecording {
    let (c3d, _) = C3d::read(&fs::read(data.join(file)).unwrap()).unwrap();
    emg_from_c3d(&c3d, &[]).unwrap()
}

fn visit(data: &Path, files: &[&str]) -> Vec<EmgTrial> {
    let trials: Vec<EmgRecording> = files.iter().map(|file| read(data, file)).collect();
    envelopes(&trials, &EmgSettings::default()).unwrap()
}

/// Names of the channels that hold a muscle.
fn muscles(trial: &EmgTrial) -> Vec<&str> {
    trial.envelopes.iter().filter(|e| e.signal.is_muscle()).map(|e| e.channel.as_str()).collect()
}

#[test]
fn clear_names_of_one_leg() {
    let Some(data) = shared_data::data() else { return };
    let trials =
        visit(&data, &["adults-rehazenter/2014001/2014001_C4_05.c3d", "adults-rehazenter/2014001/2014001_C5_01.c3d"]);
    for trial in &trials {
        assert_eq!(muscles(trial).len(), 8, "{:?}", trial.envelopes.iter().map(|e| e.signal).collect::<Vec<_>>());
        assert!(trial.envelopes.iter().all(|e| e.side == Some(Side::Right) && e.processing == Processing::Filtered));
        assert!(trial.unknown.is_empty(), "{:?}", trial.unknown);
    }
    let levels = |k: usize| trials[k].envelopes.iter().map(|e| e.level.to_bits()).collect::<Vec<u64>>();
    assert_eq!(levels(0), levels(1), "one level in the visit");
}

#[test]
fn full_names_and_a_name_that_was_cut() {
    let Some(data) = shared_data::data() else { return };
    let trial = &visit(&data, &["motonms-unipd/Walking1.c3d"])[0];
    assert_eq!(muscles(trial).len(), 15);
    assert!(trial.envelopes.iter().any(|e| e.muscle == M::BicepsFemorisLongHead));
}

#[test]
fn both_legs_and_a_trial_of_constants() {
    let Some(data) = shared_data::data() else { return };
    let trials =
        visit(&data, &["arthritis-p3m6/Static.c3d", "arthritis-p3m6/Walking01.c3d", "arthritis-p3m6/Walking06.c3d"]);
    assert!(muscles(&trials[0]).is_empty(), "the standing trial has constant channels");
    assert_eq!((muscles(&trials[1]).len(), muscles(&trials[2]).len()), (10, 10));
    assert_eq!(muscles(&visit(&data, &["c3d-other-labs/BTS.c3d"])[0]).len(), 8);
}

#[test]
fn letters_for_muscles_and_channels_that_are_no_emg() {
    let Some(data) = shared_data::data() else { return };
    let trial = &visit(&data, &["btkdata-flatfoot-full/PiG_Motion-FlatFoot-Full.c3d"])[0];
    assert_eq!(muscles(trial).len(), 10);
    assert_eq!(trial.unknown.len(), 16, "Pin 1 to Pin 16: {:?}", trial.unknown);
    // GL is a calf muscle: at 40 % of its cycle (strikes at 2.54 and 3.57 s), and not in early stance.
    let calf = trial.envelopes.iter().find(|e| e.channel == "R_GL").unwrap().cycle(1.53, 2.54).unwrap();
    assert!(calf[40] > 3.0 * calf[5] && calf[40] > 3.0 * calf[80], "{calf:?}");
}

#[test]
fn names_that_begin_with_the_side_and_names_in_descriptions() {
    let Some(data) = shared_data::data() else { return };
    let letters = read(&data, "c3d-format-variants/type-2a.c3d");
    let names: Vec<_> = letters.channels.iter().map(|c| (c.name.as_str(), c.muscle, c.side.unwrap())).collect();
    for (name, muscle, side) in [
        ("RTTI", M::TibialisAnterior, Side::Right),
        ("RTGA", M::Gastrocnemius, Side::Right),
        ("LTTI", M::TibialisAnterior, Side::Left),
        ("LTGA", M::Gastrocnemius, Side::Left),
    ] {
        assert!(names.contains(&(name, muscle, side)), "{names:?}");
    }
    let mut c3d = C3d::new(100.0, "mm");
    c3d.analog_rate_hz = 1000.0;
    let described = |name: &str, description: &str| Channel {
        description: description.to_owned(),
        ..Channel::new(name, "V", vec![0.0; 1000])
    };
    c3d.channels = vec![
        described("CH16", "FORCE TRANSDUCER"),
        described("CH17", "TIBIALIS ANTERIOR EMG - ELE#1"),
        described("CH18", "GASTROCNEMIUS EMG - ELE#2"),
        described("CH23", "RECTUS ABDOMINIUS EMG - ELE#10"),
    ];
    let recording = emg_from_c3d(&c3d, &[]).unwrap();
    let muscles: Vec<_> = recording.channels.iter().map(|c| (c.muscle, c.side)).collect();
    let expected = [M::TibialisAnterior, M::Gastrocnemius, M::RectusAbdominis].map(|muscle| (muscle, None));
    assert_eq!((muscles.as_slice(), recording.unknown), (expected.as_slice(), vec!["CH16".to_owned()]));
    let trial = envelopes(&[emg_from_c3d(&c3d, &[]).unwrap()], &EmgSettings::default()).unwrap().remove(0);
    assert!(trial.envelopes.iter().all(|e| !e.signal.is_muscle()), "zeros");
    // The parameters of this file name channels of EMG that its data do not have.
    assert!(read(&data, "c3d-format-variants/Eb015pr.c3d").channels.is_empty());
}

#[test]
fn unnamed_channels_are_listed() {
    let Some(data) = shared_data::data() else { return };
    let folder = fs::read_dir(data.join("btkdata-pig-adult3plates")).unwrap();
    let motion = folder.map(|e| e.unwrap().path()).find(|p| p.to_string_lossy().contains("Motion")).unwrap();
    let (c3d, _) = C3d::read(&fs::read(motion).unwrap()).unwrap();
    let recording = emg_from_c3d(&c3d, &[]).unwrap();
    assert!(recording.channels.is_empty());
    assert!((1..=16).all(|k| recording.unknown.contains(&format!("EMG{k}"))), "{:?}", recording.unknown);
}

/// Folder, trials of walking, the leg with electrodes, and channels of the other leg with artefacts in one trial.
const ONE_LEG: [(&str, &[&str], Side, &[&str]); 6] = [
    ("biomechzoo-HC002D", &["HC002D06.c3d", "HC002D25.c3d"], Side::Right, &[]),
    ("biomechzoo-HC031A", &["HC031A06.c3d", "HC031A23.c3d"], Side::Right, &[]),
    ("biomechzoo-HC033A", &["HC033A10.c3d", "HC033A22.c3d"], Side::Right, &["Voltage.L Hams"]),
    ("biomechzoo-HC032A", &["HC032A03.c3d", "HC032A18.c3d"], Side::Left, &[]),
    ("biomechzoo-HC034A", &["HC034A07.c3d", "HC034A29.c3d"], Side::Left, &[]),
    ("biomechzoo-HC036A", &["HC036A10.c3d", "HC036A23.c3d"], Side::Left, &["Voltage.R Gast"]),
];

#[test]
fn channels_of_the_leg_without_electrodes_hold_no_muscle() {
    let Some(data) = shared_data::data() else { return };
    for (folder, files, side, loose) in ONE_LEG {
        let files: Vec<String> = files.iter().map(|file| format!("{folder}/{file}")).collect();
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        for (trial, file) in visit(&data, &files).iter().zip(&files) {
            for envelope in &trial.envelopes {
                println!("{file} {}: {}", envelope.channel, envelope.signal);
                let has_electrode = envelope.side == Some(side) && envelope.muscle != M::TibialisPosterior;
                let is_loose = loose.contains(&envelope.channel.as_str());
                let is_muscle = envelope.signal.is_muscle();
                assert!(is_muscle == has_electrode || is_loose, "{file}, {}: {}", envelope.channel, envelope.signal);
            }
        }
    }
    let none = visit(&data, &["biomechzoo-HC055A/HC055A09.c3d", "biomechzoo-HC055A/HC055A34.c3d"]);
    assert!(none.iter().all(|trial| muscles(trial).is_empty()), "a person without electrodes");
}

#[test]
fn samples_before_the_recording_are_not_used() {
    let Some(data) = shared_data::data() else { return };
    let trial = &visit(&data, &["biomechzoo-HC003B/HC003B08.c3d"])[0];
    let channel = trial.envelopes.iter().find(|e| e.channel == "R Hams").unwrap();
    let recorded: usize = channel.recorded.iter().map(ExactSizeIterator::len).sum();
    let share = recorded as f64 / channel.values.len() as f64;
    assert!((0.65..0.75).contains(&share), "{share}");
    assert!(channel.signal.is_muscle());
}

#[test]
fn published_envelopes_are_recognised() {
    let Some(data) = shared_data::data() else { return };
    for (file, side, count) in [
        ("muscles/A-stanford-matlabso/EMG_allMuscles.sto", Side::Left, 7),
        ("muscles/B-ceinms-lowerlimb/walk36/emgFilt.sto", Side::Right, 9),
        ("muscles/B-ceinms-lowerlimb/walk45/emgFilt.sto", Side::Right, 9),
        ("muscles/B-ceinms-lowerlimb/run81/emgFilt.sto", Side::Right, 9),
    ] {
        let (table, _) = Table::read_storage(&fs::read(data.join(file)).unwrap()).unwrap();
        let recording = emg_from_table(&table, &[], &mut Findings::default()).unwrap();
        assert!(recording.unknown.is_empty(), "{file}");
        let trial = envelopes(&[recording], &EmgSettings::default()).unwrap().remove(0);
        assert_eq!(muscles(&trial).len(), count, "{file}");
        for envelope in &trial.envelopes {
            assert_eq!((envelope.processing, envelope.side), (Processing::Unchanged, Some(side)), "{file}");
            let column = table.column(&envelope.channel).unwrap();
            assert_eq!(envelope.values, column, "left alone");
        }
    }
}
