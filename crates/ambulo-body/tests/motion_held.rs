//! Held samples of markers: programs that repeat frames, hold a marker or draw a line, and people who stand still.

use ambulo_body::findings::{Code, Findings};
use ambulo_body::model::{BySide, Side};
use ambulo_body::motion::{
    MarkerPath, MarkerRecording, PosedSegment, SegmentPoses, SensorPath, SensorRecording, release_held_markers,
    release_held_poses, release_held_sensors,
};
use ambulo_body::spatial::{Mat3, Pose, Vec3, rotation_about};

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

/// The path of one marker, from one frame to another, as a straight line at constant speed.
fn draw(recording: &mut MarkerRecording, marker: usize, [from, to]: [usize; 2], step_m: f64) {
    let path = &mut recording.markers[marker].positions;
    let (first, last) = (path[from], path[to]);
    for frame in from + 1..to {
        let place = first + (last - first) * ((frame - from) as f64 / (to - from) as f64);
        path[frame] = if step_m > 0.0 { place.map(|x| (x / step_m).round() * step_m) } else { place };
    }
}

#[test]
fn a_line_through_the_path_of_a_marker_is_a_gap_of_this_marker_alone() {
    for step_m in [0.0, 0.0001] {
        let mut recording = walk(1.2, 0.2, step_m);
        draw(&mut recording, 0, [60, 90], step_m);
        let (after, gaps, said) = released(recording.clone());
        assert_eq!(gaps, 29, "{said}");
        assert!(said.contains("MarkersDrawn") && said.contains("`M0` 29 frames from 0.610 s"), "{said}");
        assert_eq!(after.markers[1..], recording.markers[1..]);
    }
    // Too short for a line, or all markers together, as in a recording of few frames a second that was resampled.
    let mut short = walk(1.2, 0.2, 0.0);
    draw(&mut short, 0, [60, 68], 0.0);
    let mut resampled = walk(1.2, 0.2, 0.0);
    for marker in 0..MARKERS {
        (0..9).for_each(|piece| draw(&mut resampled, marker, [20 * piece, 20 * piece + 20], 0.0));
    }
    for recording in [short, resampled] {
        let (after, _, said) = released(recording.clone());
        assert!(said.is_empty() && after == recording, "{said}");
    }
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

/// The orientation of thing number `n` of a walk.
fn turned(n: usize, frame: usize) -> Mat3 {
    let phase = 0.06 * frame as f64 + n as f64;
    rotation_about(Vec3::z(), 0.4 * phase.sin()) * rotation_about(Vec3::y(), 0.1 * phase.cos())
}

/// Sensors that turn, each frame showing those of another one.
fn sensors(shown: impl Fn(usize, usize) -> usize) -> SensorRecording {
    let path = |n: usize| SensorPath {
        name: format!("S{n}"),
        orientations: (0..FRAMES).map(|frame| Some(turned(n, shown(n, frame)))).collect(),
    };
    let times = (0..FRAMES).map(|frame| 0.01 * frame as f64).collect();
    SensorRecording { name: String::new(), times, sensors: (0..7).map(path).collect() }
}

/// The released sensors and what was said.
fn released_sensors(mut recording: SensorRecording) -> (SensorRecording, String) {
    let mut findings = Findings::default();
    release_held_sensors(&mut recording, &mut findings);
    let said: Vec<String> = findings.as_slice().iter().map(|f| format!("{:?}: {}", f.code, f.message)).collect();
    (recording, said.join("; "))
}

#[test]
fn held_samples_of_sensors_are_gaps_and_a_frozen_end_is_dropped() {
    let (after, said) = released_sensors(sensors(|_, frame| frame / 2 * 2));
    let known = after.sensors[3].orientations.iter().flatten().count();
    assert!(said.contains("every second frame") && known == FRAMES / 2, "{known}: {said}");
    let (after, said) = released_sensors(sensors(|_, frame| frame.min(120)));
    assert!(said.contains("frozen from 1.200 s on") && after.times.len() == 121, "{said}");
    assert!(after.sensors.iter().all(|sensor| sensor.orientations.iter().flatten().count() == 121));
    // One sensor loses its connection for 0.3 s.
    let lost = |n: usize, frame: usize| if n == 2 && (60..90).contains(&frame) { 60 } else { frame };
    let (after, said) = released_sensors(sensors(lost));
    assert!(said.contains("sensors stay exactly in place") && said.contains("`S2` 29 frames from 0.610 s"), "{said}");
    let gaps = |n: usize| after.sensors[n].orientations.iter().filter(|orientation| orientation.is_none()).count();
    assert_eq!((gaps(1), gaps(2)), (0, 29));
}

#[test]
fn sensors_that_turn_or_rest_keep_every_sample() {
    for recording in [sensors(|_, frame| frame), sensors(|_, _| 0)] {
        let (after, said) = released_sensors(recording.clone());
        assert!(said.is_empty() && after == recording, "{said}");
    }
}

#[test]
fn held_poses_of_segments_are_gaps() {
    let of = |n: usize, frame: usize| Pose {
        rotation: turned(n, frame),
        translation: Vec3::new(0.012 * frame as f64, 0.1 * n as f64, 0.0),
    };
    let legs = |side: Side| [PosedSegment::Thigh(side), PosedSegment::Shank(side), PosedSegment::Foot(side)];
    let all = std::iter::once(PosedSegment::Pelvis).chain(Side::BOTH.into_iter().flat_map(legs));
    let poses = |shown: fn(usize, usize) -> usize| SegmentPoses {
        rate_hz: 100.0,
        times: (0..FRAMES).map(|frame| 0.01 * frame as f64).collect(),
        segments: all
            .clone()
            .enumerate()
            .map(|(n, segment)| (segment, (0..FRAMES).map(|frame| Some(of(n, shown(n, frame)))).collect()))
            .collect(),
        heel: BySide::from_fn(|_| None),
        toe_length_m: BySide::from_fn(|_| None),
        statement: String::new(),
    };
    type Shown = fn(usize, usize) -> usize;
    let cases: [(Shown, usize, &str); 3] = [
        (|_, frame| frame, 0, ""),
        (|_, frame| frame / 5 * 5, 160, "20 frames per second that were held as 100"),
        (
            |n, frame| if n == 1 { frame.min(100).max(frame / 150 * frame) } else { frame },
            49,
            "`right thigh` 49 frames",
        ),
    ];
    for (shown, expected, words) in cases {
        let (mut after, mut findings) = (poses(shown), Findings::default());
        let is_held = release_held_poses(&mut after, &mut findings);
        let said: Vec<String> = findings.as_slice().iter().map(|finding| finding.message.clone()).collect();
        assert!(is_held == (expected > 0) && said.join(" ").contains(words), "{said:?}");
        let gaps = after.of(PosedSegment::Thigh(Side::Right)).unwrap().iter().filter(|pose| pose.is_none()).count();
        assert_eq!(gaps, expected, "{said:?}");
    }
}
