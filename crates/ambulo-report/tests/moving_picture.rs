//! The moving stick figure of a page.

use ambulo_paper::{MovingFigure, MovingHead, MovingStick, SeriesKind};
use ambulo_report::internals::moving_picture;

#[test]
fn every_stick_has_all_instants_and_marks_pass_by() {
    let points = vec![vec![[0.0, 0.0], [0.0, 1.0]], vec![[0.1, 0.0], [0.0, 1.0]]];
    let sticks = vec![MovingStick { kind: SeriesKind::Line, points }];
    let head = Some(MovingHead { radius: 0.125, centres: vec![[0.0, 1.5], [0.25, 1.5]] });
    let figure = MovingFigure { gait: "short".into(), cycle_s: 0.62, sticks, head, advance: vec![0.0, 1.0] };
    let svg = moving_picture(&figure, "short");
    assert!(svg.contains("dur=\"0.620s\"") && svg.contains("M85.0 226.0L85.0 114.0;M96.2 226.0L85.0 114.0"), "{svg}");
    assert!(svg.contains("<circle cx=\"85.0\" cy=\"58.0\" r=\"14.0\"") && svg.contains("\"85.0;113.0\""), "{svg}");
    assert!(svg.contains("0.0 0;-112.0 0") || svg.contains("-0.0 0;-112.0 0"), "{svg}");
}
