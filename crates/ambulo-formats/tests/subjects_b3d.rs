//! Files of AddBiomechanics: one that Google's library wrote from the published schema, round trips, and damaged ones.

use ambulo_formats::Error;
use ambulo_formats::b3d::{
    B3d, ContactFrames, Header, MissingForce, Pass, PassFrames, PassKind, Person, TrialFrames, TrialHeader, TrialKind,
    TrialPass,
};

/// Written by testdata/by_protobuf.py.
const BY_PROTOBUF: &[u8] = include_bytes!("testdata/by_protobuf.b3d");

#[test]
fn a_file_that_another_program_wrote_is_read_to_its_last_byte() {
    let file = B3d::read(BY_PROTOBUF).unwrap();
    let header = &file.header;
    let person = Person { sex: "female".into(), height_m: 1.7, mass_kg: 68.0, age_years: 0 };
    assert_eq!((&header.person, header.version, header.joints, header.coordinates), (&person, 4, 1, 3));
    assert_eq!(
        (&header.markers[..], &header.contact_bodies[..]),
        (&["HEEL".into(), "TOE".into()][..], &["calcn_r".into()][..])
    );
    let models: Vec<(PassKind, &str)> = header.passes.iter().map(|pass| (pass.kind, pass.model.as_str())).collect();
    assert_eq!(models, [(PassKind::Kinematics, "<osim 0>"), (PassKind::Dynamics, "<osim 1>")]);
    let [walk, stand] = &header.trials[..] else { panic!("{:?}", header.trials) };
    assert_eq!((walk.name.as_str(), walk.frames, walk.step_s, walk.kind), ("walk", 2, 0.01, TrialKind::Overground));
    assert_eq!((stand.name.as_str(), stand.frames, stand.passes.len()), ("stand", 1, 1));
    assert_eq!(walk.missing_force, [MissingForce(0), MissingForce(5)]);
    assert_eq!((walk.missing_force[1].is_missing(), walk.missing_force[1].words()), (true, "not over a force plate"));
    assert_eq!((&walk.passes[1].observed[..], walk.passes[1].cutoff_hz), (&[true, true, false][..], 8.0));
    let frames = &file.trials[0];
    assert_eq!(frames.markers[0], [[0.1, 0.2, 0.3], [1.1, 0.2, 0.3]]);
    assert!(frames.markers[1].as_flattened().iter().all(|x| x.is_nan()), "a marker that was not seen");
    assert_eq!(frames.passes[1].positions, [[10.0, 11.0], [0.5, 0.5], [0.0, 0.0]]);
    let contact = &frames.passes[1].contacts[0];
    assert_eq!(contact.force, [[1.0, 700.0, 2.0], [1.0, 699.0, 2.0]]);
    assert_eq!((contact.centre_of_pressure[1], contact.moment[1]), ([0.1, 0.0, 0.2], [0.0, 3.0, 0.0]));
    assert_eq!(header.trial_place(1).unwrap().end, BY_PROTOBUF.len());
    assert_eq!(header.trial_place(2), None);
}

/// Two trials of a model with two coordinates; the second has one pass only.
fn two_trials() -> B3d {
    let path = |x: f64| vec![[x, 0.5, -0.25], [f64::NAN; 3], [x + 1.0, 0.5, -0.25]];
    let frames = |passes: usize| TrialFrames {
        markers: vec![path(0.0), path(7.0)],
        passes: vec![
            PassFrames {
                positions: vec![vec![0.1, 0.2, 0.3], vec![-1.0, -2.0, 1e-300]],
                mass_centre: vec![[0.0, 0.9, 0.0]; 3],
                contacts: vec![ContactFrames { force: path(3.0), centre_of_pressure: path(4.0), moment: path(5.0) }],
            };
            passes
        ],
    };
    let pass = |kind| TrialPass { kind, observed: vec![true, false], cutoff_hz: 6.0 };
    let trial = |name: &str, passes: usize| TrialHeader {
        name: name.into(),
        frames: 3,
        step_s: 0.01,
        missing_force: vec![MissingForce(0), MissingForce(400), MissingForce(17)],
        passes: [PassKind::Kinematics, PassKind::LowPassFilter].into_iter().take(passes).map(pass).collect(),
        force_plates: 2,
        kind: TrialKind::Other,
        marker_names_guessed: true,
    };
    let header = Header {
        version: 3,
        person: Person { sex: "unknown".into(), height_m: 1.6, mass_kg: 55.5, age_years: 41 },
        coordinates: 2,
        joints: 1,
        passes: vec![Pass::default(), Pass { kind: PassKind::LowPassFilter, model: "<x/>".into() }],
        contact_bodies: vec!["calcn_l".into()],
        markers: vec!["A".into(), "B".into()],
        trials: vec![trial("one", 2), trial("two", 1)],
        ..Header::default()
    };
    B3d { header, trials: vec![frames(2), frames(1)] }
}

#[test]
fn what_is_written_reads_back_and_one_trial_can_be_read_alone() {
    let made = two_trials();
    let bytes = made.write().unwrap();
    let again = B3d::read(&bytes).unwrap();
    assert_eq!(again.write().unwrap(), bytes);
    assert_eq!(format!("{:?}", again.trials), format!("{:?}", made.trials), "not-a-number is compared too");
    assert_eq!((&again.header.trials, &again.header.person), (&made.header.trials, &made.header.person));
    let length = Header::length(&bytes[..8]).unwrap();
    let header = Header::read(&bytes[..length]).unwrap();
    let place = header.trial_place(1).unwrap();
    let alone = header.read_trial(1, &bytes[place]).unwrap();
    assert_eq!(format!("{alone:?}"), format!("{:?}", made.trials[1]));
    let mut odd = made;
    odd.trials[0].markers[0].pop();
    let refused = odd.write().unwrap_err().to_string();
    assert!(refused.contains("trial `one`"), "{refused}");
}

#[test]
fn a_file_that_ends_anywhere_or_has_any_byte_changed_is_an_error_or_a_record() {
    let bytes = two_trials().write().unwrap();
    for end in 0..bytes.len() {
        assert!(B3d::read(&bytes[..end]).is_err(), "{end} bytes");
    }
    for place in 0..bytes.len() {
        for value in [0x00, 0x7f, 0xff, bytes[place] ^ 1] {
            let mut changed = bytes.clone();
            changed[place] = value;
            let _ = B3d::read(&changed);
        }
    }
}

#[test]
fn the_reason_of_a_refusal_is_the_true_one() {
    let refused = |change: &dyn Fn(&mut B3d, &mut Vec<u8>)| {
        let mut file = two_trials();
        let mut bytes = Vec::new();
        change(&mut file, &mut bytes);
        let bytes = if bytes.is_empty() { file.write().unwrap() } else { bytes };
        B3d::read(&bytes).unwrap_err().to_string()
    };
    let header_of = |message: &[u8]| [&(message.len() as i64).to_le_bytes()[..], message].concat();
    let text = refused(&|_, bytes| bytes.extend(b"HIERARCHY\nROOT Hips\n"));
    assert!(text.contains("ends after 20 bytes") || text.contains("length of the header"), "{text}");
    let text = refused(&|_, bytes| bytes.extend(header_of(&[0x4a, 0x02, 0x18, 0x05])));
    assert!(text.contains("0 frames with a reason in trial 1; expected one for each of its 5 frames"), "{text}");
    let text = refused(&|_, bytes| bytes.extend(header_of(&[0x03, 0x01])));
    assert!(text.contains("a field of type 3"), "{text}");
    let text = refused(&|_, bytes| bytes.extend(header_of(&[0x00, 0x01])));
    assert!(text.contains("a field with the number 0"), "{text}");
    let text = refused(&|file, _| file.header.trials[1].step_s = 0.0);
    assert!(text.contains("a time step of 0 s in trial 2"), "{text}");
    assert_eq!(
        B3d::read(&[]),
        Err(Error::Empty { expected: "a .b3d file, which begins with the length of its header" })
    );
}

#[test]
fn a_cut_off_that_is_no_number_is_not_stated() {
    let mut file = two_trials();
    file.header.trials[0].passes[0].cutoff_hz = f32::NAN;
    let again = B3d::read(&file.write().unwrap()).unwrap();
    assert_eq!(again.header.trials[0].passes[0].cutoff_hz.to_bits(), 0.0_f32.to_bits());
    file.header.trials[0].step_s = f64::NAN;
    let error = B3d::read(&file.write().unwrap()).unwrap_err().to_string();
    assert!(error.contains("a time step of NaN s in trial 1"), "{error}");
}

#[test]
fn the_length_of_a_header_has_bounds() {
    for length in [0, -1, i64::MAX, 1 << 40] {
        let error = Header::length(&length.to_le_bytes()).unwrap_err().to_string();
        let words = [format!("found {length} as the length of the header"), "1 to 268435456 bytes".to_owned()];
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }
    assert_eq!(Header::length(&5_i64.to_le_bytes()), Ok(13));
}

#[test]
fn stated_sizes_cost_neither_time_nor_memory() {
    // Two thousand million frames of a kilobyte in a file of a few bytes.
    let mut trial = vec![0x18];
    trial.extend([0xff, 0xff, 0xff, 0xff, 0x07]);
    let mut message = vec![0x18, 0x80, 0x08, 0x4a, trial.len() as u8];
    message.extend(&trial);
    let bytes = [&(message.len() as i64).to_le_bytes()[..], &message].concat();
    assert!(B3d::read(&bytes).is_err());
}
