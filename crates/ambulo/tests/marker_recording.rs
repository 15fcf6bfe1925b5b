//! Markers as cameras saw them: units, gaps, axes.

#![expect(clippy::unwrap_used, reason = "tests may unwrap")]

use ambulo::findings::Findings;
use ambulo::motion::{MarkerError, markers_from_trc};
use ambulo::spatial::{Mat3, Vec3};
use ambulo_formats::trc::{Marker, Trc};

fn trc(markers: &[(&str, [[f64; 3]; 2])]) -> Trc {
    let marker = |(name, positions): &(&str, [[f64; 3]; 2])| Marker {
        name: (*name).to_owned(),
        positions_m: positions.to_vec(),
    };
    Trc::new(100.0, vec![0.0, 0.01], markers.iter().map(marker).collect()).unwrap()
}

#[test]
fn a_position_of_exactly_zero_is_a_gap_and_is_reported() {
    let mut findings = Findings::default();
    let file = trc(&[("HEEL", [[0.0; 3], [0.1, 0.0, 0.2]]), ("TOE", [[0.3, 0.0, 0.2]; 2])]);
    let markers = markers_from_trc(&file, &mut findings).unwrap();
    let heel = markers.marker("HEEL").unwrap();
    assert!(!heel.is_seen(0) && heel.is_seen(1), "{heel:?}");
    assert!(findings.has("markers.zero_is_gap"));
    assert!(findings.as_slice()[0].message.contains("HEEL") && !findings.as_slice()[0].message.contains("TOE"));
}

#[test]
fn turning_the_axes_turns_every_position_and_leaves_gaps() {
    let gap = [f64::NAN; 3];
    let file = trc(&[("HEEL", [[1.0, 2.0, 3.0], gap])]);
    let markers = markers_from_trc(&file, &mut Findings::default()).unwrap();
    // Laboratory z up, walking along +y: x forward is +y, y up is +z, z right is +x.
    let turned = markers.turned(&Mat3::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0));
    assert_eq!(turned.markers[0].positions[0], Vec3::new(2.0, 3.0, 1.0));
    assert!(!turned.markers[0].is_seen(1));
    assert_eq!((turned.frames(), turned.rate_hz), (2, markers.rate_hz));
}

#[test]
fn a_recording_without_a_seen_marker_is_refused_with_the_names_that_it_lists() {
    let error = markers_from_trc(&trc(&[("HEEL", [[f64::NAN; 3]; 2])]), &mut Findings::default()).unwrap_err();
    assert!(matches!(&error, MarkerError::NoMarker { frames: 2, .. }), "{error}");
    assert!(error.to_string().contains("HEEL"), "{error}");
}

#[test]
fn times_that_stand_still_are_refused_with_the_frame() {
    let marker = Marker { name: "HEEL".to_owned(), positions_m: vec![[0.1, 0.2, 0.3]; 3] };
    let file = Trc::new(100.0, vec![0.0, 0.01, 0.01], vec![marker]).unwrap();
    let error = markers_from_trc(&file, &mut Findings::default()).unwrap_err();
    assert!(matches!(error, MarkerError::TimeNotRising { frame: 3, .. }), "{error}");
}
