//! The moving stick figure of a page.

use ambulo_paper::{MovingFigure, MovingHead, MovingStick, SeriesKind};
use ambulo_report::internals::{moving_picture, moving_speed};

#[test]
fn every_stick_has_all_instants_and_marks_pass_by() {
    let points = vec![vec![[0.0, 0.0], [0.0, 1.0]], vec![[0.1, 0.0], [0.0, 1.0]]];
    let sticks = vec![MovingStick { kind: SeriesKind::Line, points }];
    let head = Some(MovingHead { radius: 0.125, centres: vec![[0.0, 1.5], [0.25, 1.5]] });
    let figure = MovingFigure {
        gait: "short".into(),
        cycle_s: 0.62,
        sticks,
        head,
        advance: vec![0.0, 1.0],
        speed: vec![0.0, 1.5],
    };
    let svg = moving_picture(&figure, "short");
    assert!(svg.contains("dur=\"0.620s\"") && svg.contains("M85.0 226.0L85.0 114.0;M96.2 226.0L85.0 114.0"), "{svg}");
    assert!(svg.contains("<circle cx=\"85.0\" cy=\"58.0\" r=\"14.0\"") && svg.contains("\"85.0;113.0\""), "{svg}");
    assert!(svg.contains("0.0 0;-112.0 0") || svg.contains("-0.0 0;-112.0 0"), "{svg}");
}

#[test]
fn the_dot_of_the_speed_is_at_each_speed_of_the_cycle() {
    let speed = vec![-0.5, 0.0, 1.0, 1.5];
    let figure =
        MovingFigure { gait: "standard".into(), cycle_s: 1.0, sticks: vec![], head: None, advance: vec![], speed };
    let svg = moving_speed(&figure);
    // From the lowest speed at 206 px to the highest at 22 px.
    assert!(svg.contains("M46.0 206.0L166.7 160.0L287.3 68.0L408.0 22.0"), "{svg}");
    assert!(svg.contains("\"206.0;160.0;68.0;22.0\"") && svg.contains("dur=\"1.000s\""), "{svg}");
    assert_eq!(svg.matches("stroke=\"#ccc\"").count(), 5, "a line each half metre per second: {svg}");
}
