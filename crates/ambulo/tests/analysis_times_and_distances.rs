//! Times and distances of walking for every stride.

use ambulo::analysis::{Stride, StrideQuantity, TimesAndDistances, symmetry_index};
use ambulo::internals::{Floor, Places, Strike};
use ambulo::model::Side;
use ambulo::spatial::Vec3;

fn stride_of(side: Side, cycle_s: f64, stance: f64) -> Stride {
    Stride {
        side,
        start_s: 0.0,
        cycle_s,
        stance,
        single_support: Some(0.4),
        initial_double_support: None,
        terminal_double_support: None,
        step_time_s: None,
        stride_length_m: Some(1.4),
        step_length_m: Some(0.7),
        step_width_m: None,
    }
}

#[test]
fn means_standard_deviations_and_symmetry_are_computed_over_strides() {
    let strides =
        vec![stride_of(Side::Right, 1.0, 0.62), stride_of(Side::Right, 1.2, 0.58), stride_of(Side::Left, 1.1, 0.66)];
    let found = TimesAndDistances { strides, ..TimesAndDistances::default() };
    let right = found.spread(StrideQuantity::CycleTime, Some(Side::Right)).unwrap();
    assert!((right.mean - 1.1).abs() < 1e-12 && right.strides == 2);
    assert!((right.standard_deviation.unwrap() - 0.02_f64.sqrt()).abs() < 1e-12);
    assert_eq!(found.spread(StrideQuantity::CycleTime, Some(Side::Left)).unwrap().standard_deviation, None);
    assert_eq!(found.spread(StrideQuantity::StepWidth, None), None);
    assert!((found.symmetry(StrideQuantity::Stance).unwrap() - (0.60 - 0.66) / 0.63).abs() < 1e-12);
    let double = found.spread(StrideQuantity::DoubleSupport, Some(Side::Left)).unwrap().mean;
    assert!((double - 0.26).abs() < 1e-12);
    let cadence = found.spread(StrideQuantity::Cadence, Some(Side::Left)).unwrap().mean;
    let ratio = found.spread(StrideQuantity::WalkRatio, Some(Side::Left)).unwrap().mean;
    assert!((ratio * cadence - 0.7).abs() < 1e-12, "step length is walk ratio times cadence");
}

#[test]
fn symmetry_is_positive_if_the_right_side_is_larger() {
    assert!((symmetry_index(1.1, 0.9).unwrap() - 0.2).abs() < 1e-12);
    assert!((symmetry_index(-0.9, -1.1).unwrap() + 0.2).abs() < 1e-12, "sizes of negative peaks");
    assert_eq!(symmetry_index(0.1, -0.1), None);
}

#[test]
fn steps_in_a_turn_are_measured_along_the_curve() {
    // Feet 0.2 m apart on a circle of 2 m, 20 degrees from strike to strike.
    let on_circle = |i: usize| {
        let (angle, side) =
            (f64::to_radians(20.0) * i as f64, if i.is_multiple_of(2) { Side::Right } else { Side::Left });
        // Turning left: the right foot is outside.
        let radius = if side == Side::Right { 2.1 } else { 1.9 };
        let heel = Vec3::new(radius * angle.sin(), 0.0, radius * angle.cos());
        Strike { side, time_s: 0.5 * i as f64, heel }
    };
    let places =
        Places { floor: Floor { up: Vec3::y(), velocity: Vec3::zeros() }, strikes: (0..5).map(on_circle).collect() };
    let placed = places.of_stride(Side::Right, [0.0, 1.0]).unwrap();
    assert!((placed.width_m.unwrap() - 0.2).abs() < 0.02, "{placed:?}");
    assert!((placed.step_m.unwrap() - 0.70).abs() < 0.02, "{placed:?}");
}
