//! Markers that arrive frame by frame: the coordinates of the fit of the whole recording, without its later frames.
//!
//! | claim                                                                             | tolerance                      |
//! |-----------------------------------------------------------------------------------|--------------------------------|
//! | complete frames have the coordinates of the whole recording                       | 1e-5 rad or m                  |
//! | a marker of a foot is lost for 0.2 s: the ankle moves less than without its offset | 3 degrees, and less than half   |
//! | markers that alone determine a coordinate are lost: it is not-a-number, no other is | exact                          |
//! | swapped labels are swapped back, a jump is excluded                               | a fifth of the error without   |
//! | frames with two markers are none; the body is found again after 10 s              | 1e-5 rad or m                  |

use crate::marker_data::{Subject, rajagopal};
use ambulo::findings::Findings;
use ambulo::kinematics::marker_fit::{FitError, FitMethod, FitSettings, LiveMarkerFit, OutlierDetection, fit_markers};
use ambulo::motion::MarkerRecording;
use ambulo::spatial::Vec3;

/// Coordinates of one frame, or none.
type Frame = Option<Vec<f64>>;

fn names(markers: &MarkerRecording) -> Vec<String> {
    markers.markers.iter().map(|marker| marker.name.clone()).collect()
}

fn live(subject: &Subject, markers: &MarkerRecording, settings: &FitSettings) -> Vec<Frame> {
    let mut findings = Findings::default();
    let mut fit =
        LiveMarkerFit::new(&subject.model, &names(markers), markers.rate_hz, settings, &mut findings).unwrap();
    (0..markers.frames()).map(|frame| fit.push(&row(markers, frame)).unwrap().map(<[f64]>::to_vec)).collect()
}

fn row(markers: &MarkerRecording, frame: usize) -> Vec<Vec3> {
    markers.markers.iter().map(|marker| marker.positions[frame]).collect()
}

/// The coordinates of the fit of the whole recording, one column per coordinate that markers determine.
fn whole(subject: &Subject) -> Vec<Option<Vec<f64>>> {
    let settings = FitSettings { method: FitMethod::Frames, ..FitSettings::default() };
    fit_markers(&subject.model, &subject.markers, &settings, &mut Findings::default()).unwrap().motion.columns
}

/// Largest difference of the coordinates in these frames [rad or m].
fn largest_difference(found: &[Frame], whole: &[Option<Vec<f64>>], frames: std::ops::Range<usize>) -> f64 {
    let mut largest = 0.0_f64;
    for frame in frames {
        let found = found[frame].as_ref().unwrap();
        for (value, column) in found.iter().zip(whole) {
            largest = largest.max(column.as_ref().map_or(0.0, |column| (value - column[frame]).abs()));
        }
    }
    largest
}

fn edited(
    markers: &MarkerRecording,
    frames: std::ops::Range<usize>,
    edit: impl Fn(&str, Vec3) -> Vec3,
) -> MarkerRecording {
    let mut edited = markers.clone();
    for marker in &mut edited.markers {
        frames.clone().for_each(|frame| marker.positions[frame] = edit(&marker.name, marker.positions[frame]));
    }
    edited
}

fn lost(markers: &MarkerRecording, names: &[&str], frames: std::ops::Range<usize>) -> MarkerRecording {
    edited(markers, frames, |name, at| if names.contains(&name) { Vec3::repeat(f64::NAN) } else { at })
}

#[test]
fn complete_frames_have_the_coordinates_of_the_whole_recording() {
    let Some(subject) = rajagopal() else { return };
    let found = live(&subject, &subject.markers, &FitSettings::default());
    let difference = largest_difference(&found, &whole(&subject), 0..subject.markers.frames());
    println!("largest difference {difference:.1e} rad or m over {} frames", found.len());
    assert!(difference < 1e-5, "{difference}");
}

#[test]
fn a_lost_marker_of_a_foot_hardly_moves_the_ankle() {
    let Some(subject) = rajagopal() else { return };
    let gap = 60..80;
    let ankle = subject.model.coordinate("ankle_angle_r").unwrap().index();
    let whole = whole(&subject);
    let expected = whole[ankle].as_ref().unwrap();
    let markers = lost(&subject.markers, &["R.Toe"], gap.clone());
    let change = |settings: &FitSettings| {
        let found = live(&subject, &markers, settings);
        gap.clone().map(|frame| (found[frame].as_ref().unwrap()[ankle] - expected[frame]).abs()).fold(0.0, f64::max)
    };
    let with_offsets = change(&FitSettings::default()).to_degrees();
    // The weight 0 in all frames is what a fit without offsets would do.
    let weights = [("R.Toe".to_owned(), 0.0)].into();
    let without = change(&FitSettings { weights, ..FitSettings::default() }).to_degrees();
    println!("ankle {with_offsets:.2} deg, without the marker's offset {without:.2} deg");
    assert!(with_offsets < 3.0 && with_offsets < 0.5 * without, "{with_offsets} {without}");
    let found = live(&subject, &markers, &FitSettings::default());
    let after = largest_difference(&found, &whole, gap.end + 1..subject.markers.frames());
    assert!(after < 1e-5, "complete frames are those of the whole recording again: {after}");
}

#[test]
fn coordinates_that_the_visible_markers_do_not_determine_are_missing() {
    let Some(subject) = rajagopal() else { return };
    let hand: Vec<String> = names(&subject.markers).into_iter().filter(|name| is_of_forearm(name)).collect();
    let hand: Vec<&str> = hand.iter().map(String::as_str).collect();
    assert!(hand.len() >= 3, "{:?}", names(&subject.markers));
    let found = live(&subject, &lost(&subject.markers, &hand, 60..80), &FitSettings::default());
    let elbow = subject.model.coordinate("elbow_flex_r").unwrap().index();
    let knee = subject.model.coordinate("knee_angle_r").unwrap().index();
    for (frame, q) in found.iter().enumerate() {
        let q = q.as_ref().unwrap();
        assert_eq!(q[elbow].is_nan(), (60..80).contains(&frame), "frame {frame}: {}", q[elbow]);
        assert!(q[knee].is_finite(), "frame {frame}");
    }
}

fn is_of_forearm(name: &str) -> bool {
    ["R.Elbow", "R.Forearm", "R.Wrist"].contains(&name)
}

#[test]
fn swapped_labels_and_jumps_are_detected() {
    let Some(subject) = rajagopal() else { return };
    let whole = whole(&subject);
    let (a, b) = ("R.Toe", "R.Heel");
    let place = |name: &str| subject.markers.markers.iter().position(|marker| marker.name == name).unwrap();
    let mut swapped = subject.markers.clone();
    for frame in 60..100 {
        let (first, second) = (swapped.markers[place(a)].positions[frame], swapped.markers[place(b)].positions[frame]);
        swapped.markers[place(a)].positions[frame] = second;
        swapped.markers[place(b)].positions[frame] = first;
    }
    let jumped =
        edited(&subject.markers, 60..100, |name, at| if name == a { at + Vec3::new(0.1, 0.05, 0.0) } else { at });
    let ankle = subject.model.coordinate("ankle_angle_r").unwrap().index();
    for markers in [&swapped, &jumped] {
        let change = |outliers| {
            let found = live(&subject, markers, &FitSettings { outliers, ..FitSettings::default() });
            let expected = whole[ankle].as_ref().unwrap();
            let changes = (0..120).map(|frame| (found[frame].as_ref().unwrap()[ankle] - expected[frame]).abs());
            changes.fold(0.0, f64::max).to_degrees()
        };
        let (detected, ignored) = (change(OutlierDetection::On), change(OutlierDetection::Off));
        println!("ankle {detected:.2} deg; without detection {ignored:.2} deg");
        assert!(detected < 0.2 * ignored && ignored > 5.0, "{detected} {ignored}");
    }
}

#[test]
fn frames_with_too_few_markers_are_missing_and_the_body_is_found_again() {
    let Some(subject) = rajagopal() else { return };
    let whole = whole(&subject);
    let markers = &subject.markers;
    let mut fit = LiveMarkerFit::new(
        &subject.model,
        &names(markers),
        markers.rate_hz,
        &FitSettings::default(),
        &mut Findings::default(),
    )
    .unwrap();
    for frame in 0..20 {
        assert!(fit.push(&row(markers, frame)).unwrap().is_some());
    }
    let mut two = vec![Vec3::repeat(f64::NAN); markers.markers.len()];
    two[..2].copy_from_slice(&row(markers, 20)[..2]);
    assert_eq!(fit.push(&two).unwrap(), None);
    fit.skip(1000);
    let found = vec![fit.push(&row(markers, 100)).unwrap().map(<[f64]>::to_vec)];
    let at = |column: &Option<Vec<f64>>| column.as_ref().map(|column| vec![column[100]]);
    let difference = largest_difference(&found, &whole.iter().map(at).collect::<Vec<_>>(), 0..1);
    assert!(difference < 1e-5, "{difference}");
    let error = fit.push(&two[1..]).unwrap_err();
    assert!(
        matches!(error, FitError::Setting { .. }) && error.to_string().contains("one position per marker"),
        "{error}"
    );
}
