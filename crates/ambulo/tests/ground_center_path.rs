//! The expected path of the centre of pressure under a foot, from the motion alone.

use ambulo::ground::predict::{FittedParameters, TRAITS};
use ambulo::internals::{BodyScale, FootPlace, GaitType, Stance, center_path, heel_down, share};
use ambulo::model::Side;
use ambulo::spatial::Vec3;

/// A foot whose sole slopes down to the ball by an angle, under an upright shank.
fn foot(slope: f64) -> FootPlace {
    let (sine, cosine) = slope.sin_cos();
    let point = |along: f64| Vec3::new(along * cosine, (0.18 - along) * sine, 0.0);
    FootPlace { sole: [point(0.0), point(0.18), point(0.25)], shank: Some(Vec3::y()) }
}

/// A stance of a right foot that walks along x on level ground.
fn level_stance(heel_down_s: Option<f64>) -> Stance {
    Stance {
        side: Side::Right,
        start_s: 0.0,
        end_s: 0.6,
        height_m: 0.0,
        forward: Vec3::x(),
        right: Vec3::z(),
        speed: 0.4,
        gait: GaitType::Walk,
        heel_down_s,
        on_stairs: false,
        traits: [0.0; TRAITS],
        knots: vec![[0.0, 0.0], [0.6, 1.0]],
    }
}

/// Place of the centre of pressure between rear (0) and ball (1) at 0.05 s of a stance in which the foot first has
/// these slopes.
fn place_between(slopes: &[f64]) -> f64 {
    let places: Vec<FootPlace> = slopes.iter().copied().map(foot).collect();
    let up = Vec3::y();
    let body_scale = BodyScale { up, weight_n: 700.0, leg_time_s: 0.3, leg_speed_m_s: 3.0, height_m: 1.75 };
    let heel_down_s = heel_down(&places, up).map(|frame| 0.01 * frame as f64);
    let stance = level_stance(heel_down_s);
    let center = center_path(&places[5], &stance, 0.05, &body_scale, &FittedParameters::default());
    let [rear, ball, _] = places[5].sole;
    (center.x - rear.x) / (ball.x - rear.x)
}

#[test]
fn a_foot_that_comes_down_forefoot_first_has_its_centre_of_pressure_under_the_ball_until_the_heel_is_down() {
    let steep = 25_f64.to_radians();
    let flat = place_between(&[0.0; 10]);
    assert!(flat < 0.5, "an upright shank over a flat foot: {flat}");
    // Still on the forefoot: between ball and tip.
    assert!(place_between(&[steep; 10]) > 0.99);
    // The heel came down before: the lean of the shank decides, also when the heel rises again.
    let mut slopes = [steep; 10];
    slopes[2] = 0.0;
    slopes[5] = 0.0;
    assert!((place_between(&slopes) - flat).abs() < 1e-12);
    // Heel first: a slope that comes later, as in push-off, changes nothing.
    let mut slopes = [-0.2; 10];
    slopes[5] = steep;
    let late = place_between(&slopes);
    assert!((late - flat).abs() < 0.06, "{late} {flat}");
}

#[test]
fn the_path_leads_from_heel_to_ball_as_the_shank_leans_forward() {
    let lean = [0.1, 0.087];
    let shares: Vec<f64> = (-30..=30).map(|degrees| share(f64::from(degrees).to_radians(), lean)).collect();
    assert!(shares[0].abs() < 1e-12 && (shares[60] - 1.0).abs() < 1e-12);
    assert!(shares.windows(2).all(|pair| pair[0] <= pair[1]));
    assert!((share(0.1, lean) - 0.5).abs() < 0.05);
}
