//! Names of muscles in recordings and models.

use crate::shared_data;
use ambulo_body::model::Side;
use ambulo_muscles::emg::{AnatomicalMuscle as M, SPELLINGS};
use std::fs;

fn of(name: &str) -> Option<(M, Option<Side>)> {
    M::of_name(name)
}

#[test]
fn names_of_recordings_have_their_muscle_and_side() {
    let cases = [
        ("R_tibialis_anterior", M::TibialisAnterior, Some(Side::Right)),
        ("R_gluteus_medius", M::GluteusMedius, Some(Side::Right)),
        ("Voltage.R Rect", M::RectusFemoris, Some(Side::Right)),
        ("Voltage.L Tib Post", M::TibialisPosterior, Some(Side::Left)),
        ("L Hams", M::Hamstrings, Some(Side::Left)),
        ("RTTI", M::TibialisAnterior, Some(Side::Right)),
        ("LTGA", M::Gastrocnemius, Some(Side::Left)),
        ("R_RF", M::RectusFemoris, Some(Side::Right)),
        ("L_GL", M::GastrocnemiusLateralis, Some(Side::Left)),
        ("Right Biceps femoris caput longu", M::BicepsFemorisLongHead, Some(Side::Right)),
        ("Left Semimembranosus", M::Semimembranosus, Some(Side::Left)),
        ("QUADRICEPS VL EMG - ELE#4", M::VastusLateralis, None),
        ("soleus_l_activation", M::Soleus, Some(Side::Left)),
        ("med_gas_r", M::GastrocnemiusMedialis, Some(Side::Right)),
        ("R_TA (mV)", M::TibialisAnterior, Some(Side::Right)),
    ];
    for (name, muscle, side) in cases {
        assert_eq!(of(name), Some((muscle, side)), "{name}");
    }
}

#[test]
fn names_that_say_nothing_are_not_guessed() {
    for name in
        ["EMG1", "Pin 10", "Voltage.R Spare", "Fx1", "CH17", "", "R_", "Vastus", "gluteus", "L R soleus", "Left RTTI"]
    {
        assert_eq!(of(name), None, "{name}");
    }
}

#[test]
fn every_spelling_gives_its_muscle_with_either_side_and_no_other() {
    for spelling in SPELLINGS {
        assert_eq!(of(spelling.name), Some((spelling.muscle, spelling.side)), "{}", spelling.name);
        assert!(!spelling.seen.is_empty());
        let twice = SPELLINGS.iter().filter(|other| other.name == spelling.name).count();
        assert_eq!(twice, 1, "{} stands twice", spelling.name);
    }
    for muscle in M::all() {
        for side in Side::BOTH {
            assert_eq!(of(&format!("{muscle} {side}")), Some((muscle, Some(side))));
        }
    }
}

#[test]
fn groups_share_fibres_with_their_parts_only() {
    assert!(M::Vasti.shares_fibres_with(M::VastusMedialis));
    assert!(M::GastrocnemiusLateralis.shares_fibres_with(M::Gastrocnemius));
    assert!(M::Hamstrings.shares_fibres_with(M::BicepsFemoris), "the long head");
    assert!(!M::Hamstrings.shares_fibres_with(M::BicepsFemorisShortHead));
    assert!(!M::GastrocnemiusLateralis.shares_fibres_with(M::GastrocnemiusMedialis));
    assert!(!M::RectusFemoris.shares_fibres_with(M::Vasti), "no model lumps them");
}

/// Names of the muscles of a model, in the text of its document.
fn muscles_of(text: &str) -> Vec<String> {
    let marks = ["<Thelen2003Muscle name=\"", "<Millard2012EquilibriumMuscle name=\""];
    let after = marks.iter().flat_map(|mark| text.split(mark).skip(1));
    after.filter_map(|rest| Some(rest.split_once('"')?.0.to_owned())).collect()
}

#[test]
fn every_muscle_of_the_models_of_opensim_is_known_with_its_side() {
    let Some(data) = shared_data::data() else { return };
    for (file, count) in [
        ("opensim-gait2392-subject01/subject01_simbody.osim", 92),
        ("opensim-rajagopal-walk/subject_walk_scaled.osim", 80),
        ("opensim-gait10dof-subject01/subject01.osim", 18),
    ] {
        let names = muscles_of(&fs::read_to_string(data.join(file)).unwrap());
        assert_eq!(names.len(), count, "{file}");
        for name in names {
            let side = if name.ends_with("_r") { Side::Right } else { Side::Left };
            assert!(matches!(of(&name), Some((_, Some(found))) if found == side), "{file}: {name}");
        }
    }
}

#[test]
fn every_muscle_of_the_built_in_body_is_known() {
    let table = include_str!("../data/leg_muscles.toml");
    let names: Vec<&str> = table.lines().filter_map(|line| line.strip_prefix("name = \"")?.strip_suffix('"')).collect();
    assert_eq!(names.len(), 43);
    for name in names {
        assert!(matches!(of(&format!("{name}_l")), Some((_, Some(Side::Left)))), "{name}");
    }
}
