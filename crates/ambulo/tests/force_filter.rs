//! The low-pass filter of measured forces that is chosen by the movement.

use crate::free_bodies::{DOWN_Y, free_bodies};
use ambulo::findings::Findings;
use ambulo::model::Model;
use ambulo::motion::filter::LowPass;
use ambulo::motion::{ForceRecording, Motion, Smoother};
use ambulo::spatial::Vec3;
use ambulo::study::{self, ForceFilter, MeasuredForces, Settings, Source};

const MASS_KG: f64 = 50.0;
const SIX_HZ: LowPass = LowPass { order: 3, cutoff_hz: 6.0 };

fn body() -> Model {
    free_bodies(DOWN_Y, &[("pelvis", MASS_KG)])
}

/// Two feet that carry these shares of the weight for one second, each in the middle third, at this rate.
fn carried(shares: [f64; 2], rate_hz: f64) -> Vec<ForceRecording> {
    let model = body();
    let times: Vec<f64> = (0..=rate_hz as usize).map(|i| i as f64 / rate_hz).collect();
    let load = |share: f64| {
        let force = |t: &f64| Vec3::y() * if (0.3..0.6).contains(t) { share * MASS_KG * 9.81 } else { 0.0 };
        ForceRecording {
            name: "plate".to_owned(),
            body: model.body_ids().next().unwrap(),
            force_frame: None,
            point_frame: None,
            force: times.iter().map(force).collect(),
            point: vec![Vec3::zeros(); times.len()],
            moment: vec![Vec3::zeros(); times.len()],
            times: times.clone(),
        }
    };
    shares.map(load).into()
}

/// The filter that a study uses.
fn used(forces: Vec<ForceRecording>, settings: &Settings) -> Option<LowPass> {
    let model = body();
    let times: Vec<f64> = (0..=100).map(|i| 0.01 * f64::from(i)).collect();
    let columns = vec![Some(vec![0.0; times.len()]); model.coordinates().len()];
    let motion = Motion { origin: "still".to_owned(), times, columns };
    let source = Source::coordinates(model, motion).with_forces(MeasuredForces::OnBodies(forces));
    study::run(source, settings, &mut Findings::default()).unwrap().processing.force_filter
}

fn smoothed(smoother: Smoother) -> Settings {
    Settings { smoother, ..Settings::default() }
}

#[test]
fn forces_of_walking_keep_more_than_the_motion() {
    let walking = || carried([1.2, 0.4], 1000.0);
    let chosen = |settings: &Settings| used(walking(), settings);
    assert_eq!(chosen(&Settings::default()), Some(LowPass { order: 3, cutoff_hz: 25.0 }));
    assert_eq!(chosen(&smoothed(Smoother::Spline)), Some(LowPass { order: 3, cutoff_hz: 25.0 }));
    assert_eq!(chosen(&smoothed(Smoother::Off)), None, "nothing is filtered if the motion is not");
    let sharp = LowPass { order: 2, cutoff_hz: 30.0 };
    assert_eq!(chosen(&smoothed(Smoother::Butterworth(sharp))), Some(sharp), "never less than the motion");
}

#[test]
fn forces_of_running_and_landing_are_filtered_nearly_as_the_motion() {
    let eight_hz = Some(LowPass { order: 3, cutoff_hz: 8.0 });
    assert_eq!(used(carried([2.3, 0.0], 1000.0), &Settings::default()), eight_hz, "a run, on one foot");
    assert_eq!(used(carried([1.1, 1.1], 1000.0), &Settings::default()), eight_hz, "a landing on two plates");
    let twelve_hz = LowPass { order: 3, cutoff_hz: 12.0 };
    assert_eq!(used(carried([2.3, 0.0], 1000.0), &smoothed(Smoother::Butterworth(twelve_hz))), Some(twelve_hz));
    // A spike of ten samples is no landing.
    let mut spiked = carried([1.2, 0.0], 1000.0);
    spiked[0].force[400..410].fill(Vec3::y() * 3.0 * MASS_KG * 9.81);
    assert_eq!(used(spiked, &Settings::default()).map(|filter| filter.cutoff_hz), Some(25.0));
}

#[test]
fn a_slow_plate_limits_the_filter_and_a_stated_filter_is_used() {
    assert_eq!(used(carried([1.0, 0.0], 50.0), &Settings::default()).map(|filter| filter.cutoff_hz), Some(20.0));
    let with = |force_filter: ForceFilter| Settings { force_filter, ..Settings::default() };
    assert_eq!(used(carried([2.3, 0.0], 1000.0), &with(ForceFilter::LowPass(SIX_HZ))), Some(SIX_HZ));
    assert_eq!(used(carried([1.0, 0.0], 1000.0), &with(ForceFilter::Off)), None);
}
