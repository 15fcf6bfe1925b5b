//! The table of curves over gait cycles.

use ambulo::model::Side;
use ambulo_results::internals::{CYCLES_HEAD, read_cycles};

fn file(percents: impl Iterator<Item = usize>) -> String {
    let rows = percents.map(|p| format!("knee_angle_angle,l,2,{p},{},deg\n", 0.5 * p as f64));
    format!("{CYCLES_HEAD}\n{}", rows.collect::<String>())
}

#[test]
fn a_curve_has_all_its_rows() {
    let found = read_cycles(&file(0..101)).unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].side, found[0].cycle, found[0].values[100]), (Side::Left, 2, 50.0));
}

#[test]
fn invalid_curves_are_rejected_with_their_line() {
    for (text, words) in [
        (file((0..50).chain(51..101)), "line 52: found 51 % of `knee_angle_angle`"),
        (file(0..100), "has 100 rows; expected 101"),
        (file(0..101).replace(",25,deg", ",x,deg"), "line 52: found `knee_angle_angle,l,2,50,x,deg`"),
        (file(0..101).replace(",25,deg", ",1e300,deg"), "line 52: found `knee_angle_angle,l,2,50,1e300,deg`"),
        (file(0..101).replace(",25,deg", ",NaN,deg"), "line 52: found"),
        (file(0..101).replace(",l,", ",m,"), "line 2: found"),
        ("side,value\n".to_owned(), "line 1: found `side,value`"),
    ] {
        let error = read_cycles(&text).unwrap_err();
        assert!(error.contains(words), "{error}");
    }
}
