//! Events that a file lists, against those of force plates.

use ambulo::internals::contradiction;
use ambulo::model::Side;
use ambulo::motion::{Event, EventKind};

/// Two steps over two plates: strikes and offs of the right and of the left foot.
fn measured() -> Vec<Event> {
    let event = |side, kind, time_s| Event { side, kind, time_s };
    vec![
        event(Side::Right, EventKind::Strike, 1.00),
        event(Side::Left, EventKind::Off, 1.11),
        event(Side::Left, EventKind::Strike, 1.55),
        event(Side::Right, EventKind::Off, 1.66),
        event(Side::Left, EventKind::Off, 2.21),
    ]
}

fn changed(change: impl Fn(usize, &mut Event)) -> Vec<Event> {
    let mut list = measured();
    list.iter_mut().enumerate().for_each(|(number, event)| change(number, event));
    list
}

#[test]
fn lists_that_force_plates_deny_are_told_from_those_they_confirm() {
    let found = |list: &[Event]| contradiction(&measured(), list);
    // An observer is a few frames early or late.
    let observed = changed(|number, event| event.time_s += [0.02, -0.03, 0.01, 0.04, -0.02][number]);
    assert_eq!(found(&observed), None);
    assert_eq!(found(&[]), None);
    let exchanged = found(&changed(|_, event| event.side = event.side.other())).unwrap();
    assert!(exchanged.contains("right and left are exchanged in 5 of 5 events"), "{exchanged}");
    let late = found(&changed(|_, event| event.time_s += 0.1)).unwrap();
    assert!(late.contains("5 events are 100 ms late"), "{late}");
    assert!(found(&changed(|_, event| event.time_s -= 0.08)).unwrap().contains("80 ms early"));
    // 50 ms is the limit, and an event more than 150 ms away is another one.
    assert_eq!(found(&changed(|_, event| event.time_s += 0.049)), None);
    assert!(found(&changed(|_, event| event.time_s += 0.051)).is_some());
    assert!(found(&changed(|_, event| event.time_s -= 0.149)).is_some());
    assert_eq!(found(&changed(|_, event| event.time_s -= 0.151)), None);
    // A single event decides nothing, nor does a list of other steps.
    assert_eq!(contradiction(&measured()[..1], &changed(|_, event| event.time_s += 0.1)), None);
    assert_eq!(found(&changed(|_, event| event.time_s += 3.0)), None);
}
