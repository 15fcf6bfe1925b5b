//! Conditions of transitions, written in words.

use ambulo_walk::gait::machine::Condition;

#[test]
fn conditions_are_written_as_they_are_read() {
    for text in [
        "after 1.5 s",
        "after 4 steps",
        "time >= 3 s",
        "left phase > 60 %",
        "right foot strikes",
        "left foot is down and not right foot is up",
        "not standing",
        "angle 'left knee' < 20 deg or signal 'push' >= 0.5",
        "(machine 'right leg' is 'swing' or machine 'turn' is done) and after 2 s",
    ] {
        let condition = Condition::parse(text).unwrap();
        assert_eq!(condition.to_string(), text);
        assert_eq!(Condition::parse(&condition.to_string()), Ok(condition));
    }
}

#[test]
fn text_that_is_no_condition_is_refused_with_what_was_found() {
    for (text, expected) in [
        ("", "found the end of the condition; expected `after`"),
        ("after x s", "found `x`; expected a number"),
        ("after inf s", "found `inf`; expected a number"),
        ("after 2 days", "found `days`; expected `s` or `steps`"),
        ("left hand is up", "found `hand`; expected `foot` or `phase`"),
        ("left foot strikes right", "found `right`; expected `and`, `or` or the end"),
        ("angle 'left knee > 2 deg", "without a closing quote"),
        ("(after 2 s", "expected )"),
        ("time = 2 s", "found `=`; expected `<`"),
    ] {
        let message = Condition::parse(text).unwrap_err().to_string();
        assert!(message.contains(expected), "{text}: {message}");
    }
    assert!(Condition::parse(&"(".repeat(1000)).unwrap_err().to_string().contains("fewer parentheses"));
}
