//! Held samples of markers: programs that repeat frames or hold a marker, and people who stand still.

use ambulo_body::findings::{Code, Findings};
use ambulo_body::motion::{MarkerPath, MarkerRecording, release_held_markers};
use ambulo_body::spatial::Vec3;

const FRAMES: usize = 200;
const MARKERS: usize = 12;

/// Markers that swing with different phases while they travel with `speed` [m/s], rounded to `step_m`.
fn walk(speed: f64, swing_m: f64, step_m: f64) -> MarkerRecording {
    let times: Vec<f64> = (0..FRAMES).map(|frame| 0.01 * frame as f64).collect();
    let place = |marker: usize, t: f64| {
        let phase = 6.0 * t + marker as f64;
        let p = Vec3::new(speed * t + swing_m * phase.sin(), 0.1 * marker as f64 + 0.3 * swing_m * phase.cos(), 0.1);
        if step_m > 0.0 { p.map(|x| (x / step_m).round() * step_m) } else { p }
    };
    let path = |marker: usize| MarkerPath {
        name: format!("M{marker}"),
        positions: times.iter().map(|t| place(marker, *t)).collect(),
    };
    MarkerRecording { name: String::new(), rate_hz: 100.0, markers: (0..MARKERS).map(path).collect(), times }
}

/// Each frame shows the markers of another one.
fn played(mut recording: MarkerRecording, shown: impl Fn(usize) -> usize) -> MarkerRecording {
    for marker in &mut recording.markers {
        let recorded = marker.positions.clone();
        (0..recorded.len()).for_each(|frame| marker.positions[frame] = recorded[shown(frame)]);
    }
    recording
}

/// The released recording, its gaps of the first marker, and what was said.
fn released(mut recording: MarkerRecording) -> (MarkerRecording, usize, String) {
    let mut findings = Findings::default();
    release_held_markers(&mut recording, &mut findings);
    let gaps = (0..FRAMES).filter(|frame| !recording.markers[0].is_seen(*frame)).count();
    let said: Vec<String> = findings.as_slice().iter().map(|f| format!("{:?}: {}", f.code, f.message)).collect();
    (recording, gaps, said.join("; "))
}

#[test]
fn repeated_frames_are_gaps_and_named_by_what_they_look_like() {
    type Shown = fn(usize) -> usize;
    let cases: [(Shown, usize, &str); 4] = [
        (|frame| frame / 2 * 2, 100, "every second frame"),
        (|frame| frame / 5 * 5, 160, "20 frames per second that were held as 100"),
        (|frame| frame.min(120), 79, "frozen from 1.200 s on"),
        (|frame| if frame == 77 { 76 } else { frame }, 1, "one doubled frame"),
    ];
    for (shown, expected, words) in cases {
        let (_, gaps, said) = released(played(walk(1.2, 0.2, 0.0), shown));
        assert_eq!(gaps, expected, "{said}");
        assert!(said.contains(words), "{said}");
    }
}

#[test]
fn clean_and_rounded_walks_and_people_who_stand_keep_every_sample() {
    let standing =
        [walk(0.0, 0.005, 0.001), walk(0.0, 0.003, 0.0001), played(walk(0.0, 0.005, 0.0), |frame| frame / 2)];
    let walking = [walk(1.2, 0.2, 0.0), walk(1.2, 0.2, 0.001), walk(0.3, 0.1, 0.001)];
    for recording in standing.into_iter().chain(walking) {
        let (after, _, said) = released(recording.clone());
        assert!(said.is_empty() && after == recording, "{said}");
    }
}

/// A person who comes to rest: the velocity does not jump.
#[test]
fn a_movement_that_ends_in_rest_is_not_held() {
    let mut recording = walk(0.0, 0.0, 0.0);
    for (number, marker) in recording.markers.iter_mut().enumerate() {
        for (frame, place) in marker.positions.iter_mut().enumerate() {
            let share = (frame as f64 / 120.0).min(1.0);
            // A quintic: velocity and acceleration end at zero.
            let moved = share.powi(3) * (10.0 - 15.0 * share + 6.0 * share * share);
            *place = Vec3::new((0.4 + 0.05 * number as f64) * moved, 0.1 * number as f64, -0.2 * moved);
        }
    }
    let (after, _, said) = released(recording.clone());
    assert!(said.is_empty() && after == recording, "{said}");
}

#[test]
fn a_marker_that_is_held_while_the_others_move_is_a_gap_of_this_marker_alone() {
    let mut recording = walk(1.2, 0.2, 0.0);
    let at = recording.markers[0].positions[60];
    recording.markers[0].positions[61..80].fill(at);
    let (after, gaps, said) = released(recording.clone());
    assert_eq!(gaps, 19);
    assert!(said.contains("`M0` 19 frames from 0.610 s"), "{said}");
    assert_eq!(after.markers[1..], recording.markers[1..]);
    assert!(said.contains(&format!("{:?}", Code::MarkersHeldInPlace)));
}

/// A heel on the ground in a file of whole millimetres repeats its place.
#[test]
fn a_foot_that_stands_in_rounded_data_is_not_held() {
    let mut recording = walk(1.2, 0.2, 0.001);
    let path = &mut recording.markers[3].positions;
    let mut place = path[40];
    for frame in 40..100 {
        // It comes to rest within 50 ms, as after foot strike, and leaves as smoothly.
        let speed = match frame {
            40..45 => 1.0 - 0.2 * (frame - 40) as f64,
            95.. => 0.2 * (frame - 95) as f64,
            _ => 0.0,
        };
        place.x += 0.01 * speed;
        path[frame] = place.map(|x| (x * 1000.0).round() / 1000.0);
    }
    let tail = path[100] - place;
    path[100..].iter_mut().for_each(|p| *p -= tail);
    let (_, _, said) = released(recording);
    assert!(said.is_empty(), "{said}");
}
