//! Text of numbers.

use ambulo_formats::number::NumberText;
use proptest::prelude::*;

fn check(number: f64) {
    let mut text = NumberText::default();
    check_text(text.of(number), &format!("{number:?}"), number);
    check_text(text.plain(number), &format!("{number}"), number);
}

/// The text is the standard library's, or it is the even one of two that are equally near.
fn check_text(ours: &str, theirs: &str, number: f64) {
    if ours == theirs {
        return;
    }
    assert_eq!(ours.parse::<f64>().unwrap().to_bits(), number.to_bits(), "{ours} for {theirs}");
    assert_eq!(ours.len(), theirs.len(), "{ours} for {theirs}");
    // The exact digits of a tie end in one more digit, which is five.
    let exact = format!("{number:.20}");
    assert!(ours.ends_with(['0', '2', '4', '6', '8']), "{ours} for {theirs}");
    assert_eq!(exact.trim_end_matches('0'), format!("{ours}5"), "{ours} for {theirs}");
}

#[test]
fn of_two_texts_that_are_equally_near_the_even_one_is_written() {
    let tie = 4_993_861_512_708_813.0 / 4.0;
    assert_eq!(NumberText::default().of(tie), "1248465378177203.2");
    assert_eq!(NumberText::default().of(-tie - 0.5), "-1248465378177203.8");
    assert_eq!(NumberText::default().plain(tie + 0.25), "1248465378177203.5");
    check(-tie);
}

#[test]
fn numbers_at_the_ends_of_each_form_are_written_as_the_standard_library_does() {
    let ends = [0.0, 1e-5, 1e-4, 1.0, 0.1, 1e15, 1e16, 1e17, 5e-324, f64::MAX, f64::MIN_POSITIVE, 1.0 / 3.0, 123.0];
    for number in ends.into_iter().flat_map(|x| [x, x.next_down(), x.next_up(), 0.999 * x]) {
        check(number);
        check(-number);
    }
    [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().for_each(check);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn any_number_is_written_in_the_form_of_the_standard_library(bits in any::<u64>(), near_one in -1e3..1e3_f64,
        large in 1e14..1e16_f64) {
        check(f64::from_bits(bits));
        check(near_one);
        // Numbers with few bits after the point have ties.
        check(large);
    }
}
