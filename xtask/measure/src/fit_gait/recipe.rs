//! The knots of the joint curves, and how each is located.

/// What makes a time of the cycle a knot.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Mark {
    /// Contact of the curve's own foot, 0 %.
    Contact,
    /// Largest angle between two percents.
    Highest(f64, f64),
    /// Least angle between two percents.
    Lowest(f64, f64),
    /// Fastest flexion between two percents.
    Rising(f64, f64),
    /// Fastest extension between two percents.
    Falling(f64, f64),
    /// A share of the way from one knot of the recipe to another; one more knot where a single quintic was too stiff.
    Between(usize, usize, f64),
}

/// A knot to locate.
pub(crate) struct Wanted {
    pub(crate) name: &'static str,
    /// The sub-cycle that is activated here.
    pub(crate) begins: &'static str,
    pub(crate) mark: Mark,
    /// Share of a change of step height: 1 for what the swinging leg does to clear the ground.
    pub(crate) height_share: f64,
}

const fn knot(name: &'static str, begins: &'static str, mark: Mark, height_share: f64) -> Wanted {
    Wanted { name, begins, mark, height_share }
}

/// A joint's knots, in the order of their times.
pub(crate) struct Recipe {
    pub(crate) joint: &'static str,
    /// Its rows in the table of angles.
    pub(crate) quantity: &'static str,
    pub(crate) knots: &'static [Wanted],
}

use Mark::{Between, Contact, Falling, Highest, Lowest, Rising};

/// The default style.
pub(crate) const RECIPES: [Recipe; 3] = [
    Recipe {
        joint: "hip",
        quantity: "Hip Flex/Extension",
        knots: &[
            knot("contact", "E3", Contact, 0.0),
            knot("loading", "", Between(0, 2, 0.5), 0.0),
            knot("fastest extension", "", Falling(20.0, 35.0), 0.0),
            knot("largest extension", "F", Lowest(46.0, 62.0), 0.0),
            knot("fastest flexion", "", Rising(58.0, 82.0), 0.5),
            knot("late swing", "", Between(4, 6, 0.5), 1.0),
            knot("largest flexion", "E1", Highest(83.0, 97.0), 1.0),
        ],
    },
    Recipe {
        joint: "knee",
        quantity: "Knee Flex/Extension",
        knots: &[
            knot("fastest yield", "", Rising(1.0, 10.0), 0.0),
            knot("stance peak", "E3", Highest(8.0, 18.0), 0.0),
            knot("fastest stance extension", "", Falling(15.0, 34.0), 0.0),
            knot("stance minimum", "F", Lowest(28.0, 46.0), 0.0),
            knot("fastest flexion", "", Rising(50.0, 70.0), 0.5),
            knot("swing peak", "E1", Highest(66.0, 80.0), 1.0),
            knot("fastest swing extension", "", Falling(80.0, 96.0), 0.5),
            knot("terminal minimum", "E2", Lowest(94.0, 101.0), 0.0),
        ],
    },
    Recipe {
        joint: "ankle",
        quantity: "Ankle Dorsi/Plantarflexion",
        knots: &[
            knot("contact", "L", Contact, 0.0),
            knot("first plantarflexion", "E2", Lowest(2.0, 9.0), 0.0),
            knot("fastest yield", "", Rising(6.0, 12.0), 0.0),
            knot("mid stance", "", Between(2, 4, 0.5), 0.0),
            knot("largest dorsiflexion", "E3", Highest(25.0, 54.0), 0.0),
            knot("fastest push-off", "", Falling(52.0, 68.0), 0.0),
            knot("push-off peak", "F", Lowest(58.0, 73.0), 0.0),
            knot("fastest dorsiflexion", "", Rising(62.0, 80.0), 0.5),
            knot("swing dorsiflexion", "E1", Highest(79.0, 90.0), 1.0),
        ],
    },
];
