//! How often claims hold over values that the paper does not give, sampled jointly.

use ambulo_paper::{Setting, open_values, shares_csv, shares_of, stored_shares};

#[test]
fn stored_results_are_read_as_they_are_written() {
    assert_eq!(shares_csv(stored_shares()), include_str!("../data/shares.csv"));
    assert!(stored_shares().settings >= 2000 && stored_shares().of("c1").is_some_and(|own| own.share > 0.0));
}

#[test]
fn drawn_values_repeat_and_stay_in_their_ranges() {
    assert_eq!(Setting::drawn(1, 2), Setting::drawn(1, 2));
    assert_ne!(Setting::drawn(1, 2).values(), Setting::drawn(1, 3).values());
    for number in 0..100 {
        let drawn = Setting::drawn(1, number);
        assert!(open_values().iter().zip(drawn.values()).all(|(open, value)| open.allows(*value)));
    }
}

#[test]
fn the_value_that_decides_a_claim_is_found() {
    let stature = open_values().iter().position(|open| open.key == "stature_m").unwrap();
    let spheres = open_values().iter().position(|open| open.key == "toe_spheres").unwrap();
    let judged: Vec<(Setting, Vec<bool>)> = (0..300)
        .map(|number| {
            let setting = Setting::drawn(7, number);
            let (tall, toes) = (setting.values()[stature] > 1.85, setting.values()[spheres] > 0.5);
            (setting, vec![tall, !toes])
        })
        .collect();
    let [tall, toes] = &shares_of(&judged, &["c1", "e3"])[..] else { panic!("two claims") };
    assert_eq!((tall.decided_by.as_str(), toes.decided_by.as_str()), ("stature_m", "toe_spheres"));
    assert!(tall.lower < 0.01 && tall.upper > 0.9, "{tall:?}");
    assert!(toes.lower > 0.99 && toes.upper < 0.01, "{toes:?}");
    // A claim that holds always or never is decided by nothing, and not by a switch that is never drawn.
    let constant: Vec<(Setting, Vec<bool>)> = judged.iter().map(|(setting, _)| (setting.clone(), vec![true])).collect();
    assert_eq!(shares_of(&constant, &["e4"])[0].decided_by, "");
    assert!((tall.share - 1.0 / 3.0).abs() < 0.1 && (toes.share - 0.5).abs() < 0.1);
}
