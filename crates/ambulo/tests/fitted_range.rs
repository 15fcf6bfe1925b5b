//! Of a part of a recording, only the frames near it are fitted, and the results are those of the whole recording.

use crate::shared_data::data;
use ambulo::findings::Findings;
use ambulo::model::anthropometry::SegmentTable;
use ambulo::motion::Window;
use ambulo::study::{
    self, LaboratoryFile, MarkerBody, MarkerSource, Outcome, Settings, Source, StandingTrial, Tracking,
};
use std::path::Path;
use std::sync::Arc;

/// The part that is analysed [s]; filters at 6 Hz and events need a second around it.
const PART: [f64; 2] = [2.3, 3.0];
/// Differences of values, rates and accelerations [rad, rad/s, rad/s²; m]: the filter leaves e⁻¹⁸ of what the ends of
/// the fitted time change, a tenth of a radian; each derivative multiplies it by the cutoff of 38 rad/s.
const SAME: [f64; 3] = [1e-7, 1e-5, 1e-3];

fn walk(data: &Path, window: Window) -> Outcome {
    let read = |name: &str| {
        let bytes = std::fs::read(data.join("biomechzoo-HC030A").join(name)).unwrap();
        LaboratoryFile::from_c3d(bytes, name, &mut Findings::default()).unwrap()
    };
    let source = Source::markers(MarkerSource {
        trial: read("HC030A22.c3d"),
        standing: Some(Arc::new(StandingTrial::new(read("HC030A01.c3d")))),
        body: MarkerBody::BuiltIn {
            table: SegmentTable::DeLevaMale,
            mass_kg: Some(45.8),
            height_m: Some(1.48),
            set: None,
        },
        plates: Vec::new(),
    });
    study::run(source, &Settings { window, ..Settings::default() }, &mut Findings::default()).unwrap()
}

fn fitted_frames(outcome: &Outcome) -> usize {
    let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no markers") };
    tracked.body.fit.motion.times.len()
}

#[test]
fn a_part_of_a_recording_has_the_results_of_the_whole_and_is_fitted_alone() {
    let Some(data) = data() else { return };
    let whole = walk(&data, Window::default());
    let part = walk(&data, Window { from_s: Some(PART[0]), to_s: Some(PART[1]) });
    let [all, some] = [&whole, &part].map(fitted_frames);
    println!("fitted: {some} of {all} frames");
    assert!((some as f64) < 0.8 * all as f64, "{some} of {all}");
    let [long, short] = [&whole, &part].map(|outcome| outcome.analysis.trajectory.grid());
    let first = ((short.start_s - long.start_s) / long.step_s).round() as usize;
    assert!((long.time(first) - short.start_s).abs() < 1e-9, "both have the same frames");
    let mut apart = [0.0_f64; 3];
    for id in whole.body.coordinate_ids() {
        let [of_whole, of_part] = [&whole, &part].map(|outcome| &outcome.analysis.trajectory.columns()[id.index()]);
        for (k, apart) in apart.iter_mut().enumerate() {
            for frame in 0..short.frames {
                *apart = apart.max((of_whole[k][first + frame] - of_part[k][frame]).abs());
            }
        }
    }
    println!("largest differences: {apart:?}");
    assert!(apart.iter().zip(SAME).all(|(apart, same)| *apart < same), "{apart:?}");
}
