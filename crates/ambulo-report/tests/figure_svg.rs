//! Texts, numbers and lines of SVG files.

use ambulo_report::internals::{Drawing, Stroke, escaped_xml, two_decimals, without_zeros};

#[test]
fn a_text_cannot_leave_its_element() {
    assert_eq!(escaped_xml("a<b> & \"c\"\u{0}\n'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;");
}

#[test]
fn numbers_have_the_digits_of_the_standard_library() {
    for whole in [0.0, 0.5, 1.0, 9.99, 10.0, 123.4, 999_999.0, 1e7, 1e9] {
        // Steps of an eighth of a hundredth have all ties.
        for eighths in -1000..=1000 {
            let near = whole + f64::from(eighths) / 800.0;
            for x in [near, near.next_down(), near.next_up(), -near] {
                assert_eq!(two_decimals(x), without_zeros(&format!("{x:.2}")), "{x:?}");
            }
        }
    }
    assert_eq!([0.0, -0.001, 0.125, 0.375, -2.5].map(two_decimals), ["0", "0", "0.12", "0.38", "-2.5"]);
    assert_eq!([f64::NAN, f64::INFINITY].map(two_decimals), ["NaN", "inf"]);
}

#[test]
fn a_line_breaks_where_there_is_no_number() {
    let mut drawing = Drawing::new(100.0, "serif");
    let points = [[0.0, 1.0], [1.0, 1.0], [2.0, f64::NAN], [3.0, 1.0], [4.0, 1.005]];
    drawing.polyline(&points, Stroke::solid("#000000", 1.0), &[]);
    let svg = drawing.finish(50.0, "t", "d", "#FFFFFF");
    assert_eq!(svg.matches("<polyline").count(), 2, "{svg}");
    assert!(svg.contains("width=\"35.28mm\""), "{svg}");
}
