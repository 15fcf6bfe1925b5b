//! Ticks, labels and ranges of the axes of figures.

use ambulo_report::internals::{Labels, Ticks, axis_number, axis_range, axis_ticks, round_labels, with_power};

#[test]
fn ticks_are_round_and_inside() {
    assert_eq!(axis_ticks([0.0, 100.0]), (vec![0.0, 20.0, 40.0, 60.0, 80.0, 100.0], 0));
    let (rows, digits) = axis_ticks([-0.83, 1.41]);
    assert_eq!((rows.len(), digits), (4, 1), "{rows:?}");
    assert!(rows.iter().all(|x| (-0.83..1.41).contains(x)));
    assert_eq!(axis_ticks([1.0, 1.0]).0.len(), 0);
    assert_eq!(axis_number(-0.0, 1), "0.0");
    assert_eq!(axis_number(-2.5, 1), "−2.5");
}

#[test]
fn small_and_large_numbers_share_a_power_of_ten_that_the_unit_shows() {
    let labels = |low, high| {
        let Labels { ticks, power } = round_labels([low, high]);
        (ticks.into_iter().map(|(_, label)| label).collect::<Vec<_>>(), power)
    };
    let (tiny, power) = labels(-2e-12, 2e-12);
    assert_eq!((tiny.join(" ").as_str(), power), ("−2 −1 0 1 2", -12));
    assert_eq!(labels(0.0, 2e6).1, 6);
    assert_eq!(labels(-90.0, 30.0).1, 0);
    assert_eq!(with_power("change (J)", -12), "change (10⁻¹² J)");
    assert_eq!(with_power("N", 3), "10³ N");
}

#[test]
fn given_ticks_are_drawn_where_they_lie_inside() {
    let given = [(0.0, "1".to_owned()), (1.0, "10".to_owned()), (2.0, "100".to_owned())];
    assert_eq!(Ticks::Given(&given).labels([0.5, 2.0]).ticks, &given[1..]);
}

#[test]
fn a_range_is_never_empty() {
    let [low, high] = axis_range([], 0.2);
    assert!(low < 0.0 && high > 0.0);
    let [low, high] = axis_range([5.0, 5.0, f64::NAN], 1.0);
    assert!(low < 5.0 && high > 5.0 && high - low >= 1.0);
}
