//! Body mass.

use ambulo::analysis::MassSource;
use ambulo::findings::{Code, Findings};
use ambulo::internals::{KnownMass, combined, report_decided};
use ambulo::study::{BodyMass, MassEstimate, MassState, MassWitness};

fn body_mass(model_kg: f64, known: &KnownMass, motion: Vec<MassEstimate>) -> BodyMass {
    BodyMass::of(model_kg, known, motion, MassSource::Model)
}

fn by(by: MassWitness, kg: f64, error_kg: f64) -> MassEstimate {
    MassEstimate { by, kg, error_kg, times: 1, time_s: None }
}

fn known(stated: Option<f64>, standing: Option<f64>) -> KnownMass {
    let standing = standing.map(|kg| by(MassWitness::Standing, kg, 0.005 * kg));
    KnownMass { stated: stated.map(MassEstimate::stated), standing, ..KnownMass::default() }
}

fn moving(kg: f64) -> Vec<MassEstimate> {
    vec![by(MassWitness::Cycles, kg, 0.01 * kg)]
}

#[test]
fn the_plates_are_believed_where_they_weigh_the_same_person() {
    let kg = |stated, standing| known(stated, standing).decided(&[]).map(|decided| decided.kg);
    assert_eq!(kg(Some(32.1), Some(31.07)), Some(31.07));
    assert_eq!(kg(None, Some(60.0)), Some(60.0));
    assert_eq!(kg(Some(60.0), None), Some(60.0));
    assert_eq!(kg(None, None), None);
    assert_eq!(kg(Some(60.0), Some(41.0)), Some(60.0), "a foot next to the plates");
    let codes = |known: &KnownMass, motion: &[MassEstimate]| {
        let mut findings = Findings::default();
        let decided = known.decided(motion).unwrap();
        report_decided(known, &decided, &mut findings);
        body_mass(decided.kg, known, motion.to_vec()).report(&mut findings);
        findings.as_slice().iter().map(|finding| finding.code).collect::<Vec<Code>>()
    };
    assert_eq!(codes(&known(Some(60.0), Some(41.0)), &[]), [Code::MassContradicted]);
    assert_eq!(codes(&known(Some(60.0), Some(41.0)), &moving(41.2)), [Code::MassStandingMismatch]);
}

#[test]
fn a_third_witness_decides_where_two_disagree() {
    // A child stands at 27.2 kg, is stated at 25.0 kg and walks at 25.7 kg.
    let child = known(Some(25.0), Some(27.2));
    assert!(child.needs_motion());
    let decided = child.decided(&moving(25.7)).unwrap();
    assert_eq!((decided.by, decided.kg), (MassWitness::Stated, 25.0));
    let mass = body_mass(decided.kg, &child, moving(25.7));
    assert_eq!((mass.state, mass.plates_kg), (MassState::Weighed, Some(25.7)));
    let mut findings = Findings::default();
    mass.report(&mut findings);
    assert!(findings.has(Code::MassContradicted), "the standing trial is named");
    let other = child.decided(&moving(27.0)).unwrap();
    assert_eq!((other.by, other.kg), (MassWitness::Standing, 27.2));
}

#[test]
fn a_light_model_is_contradicted_and_weight_next_to_the_plates_is_not_a_lighter_person() {
    let light = body_mass(0.85 * 70.0, &KnownMass::default(), moving(70.0));
    assert_eq!((light.state, light.source, light.plates_kg), (MassState::Contradicted, MassWitness::Model, Some(70.0)));
    let beside = body_mass(70.0, &known(Some(70.0), Some(70.3)), moving(42.0));
    assert_eq!((beside.state, beside.plates_kg), (MassState::Contradicted, Some(42.0)), "not by these plates");
    let mut findings = Findings::default();
    beside.report(&mut findings);
    let said = &findings.as_slice()[0].message;
    assert!(said.contains("42.0 kg") && said.contains("next to the plates"), "{said}");
    // The source is the model where the body has another mass than the plates, even if it could be this person's.
    let own = body_mass(68.0, &KnownMass::default(), moving(70.0));
    assert_eq!((own.state, own.source), (MassState::Weighed, MassWitness::Model));
    let unknown = body_mass(70.0, &KnownMass::default(), Vec::new());
    assert_eq!(unknown.state, MassState::Unknown);
    assert_eq!(body_mass(70.0, &known(Some(70.0), None), Vec::new()).state, MassState::Stated);
}

#[test]
fn a_disagreement_between_ways_of_weighing_widens_the_error() {
    let both = [by(MassWitness::Cycles, 70.0, 0.5), by(MassWitness::Valleys, 74.0, 0.5)];
    let found = combined(&both).unwrap();
    assert!((found.kg - 72.0).abs() < 1e-9 && found.error_kg > 2.0, "{found:?}");
    assert!(combined(&[]).is_none());
}

#[test]
fn a_mass_that_the_recording_denies_is_reported_where_nothing_was_weighed() {
    let codes = |stated: f64, file: f64, standing: Option<f64>, height_m: f64| {
        let known =
            KnownMass { file: Some(by(MassWitness::File, file, 0.025 * file)), ..known(Some(stated), standing) };
        let kg = known.decided(&[]).unwrap().kg;
        let mut findings = Findings::default();
        body_mass(kg, &known, Vec::new()).report_statement(height_m, &mut findings);
        findings.as_slice().iter().map(|finding| finding.code).collect::<Vec<Code>>()
    };
    // Pounds.
    assert_eq!(codes(133.0, 60.3, None, 1.66), [Code::MassStatedTwice]);
    assert_eq!(codes(133.0, 60.3, None, 1.50), [Code::MassStatedTwice, Code::MassUnusual]);
    assert_eq!(codes(61.0, 60.3, None, 1.66), []);
    assert_eq!(codes(75.0, 60.3, Some(74.0), 1.66), [], "plates decide");
    assert_eq!(codes(16.3, 16.3, None, 1.80), [Code::MassUnusual]);
    assert_eq!(codes(20.0, 20.0, None, 1.15), [], "a child");
}
