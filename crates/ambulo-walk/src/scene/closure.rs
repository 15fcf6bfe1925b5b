//! Closures in a scene file: joints that close loops, from the start or when an event adds them.

use super::SceneError;
use super::body::BodyEntry;
use super::joint_axes::JointAxes;
use super::names::{Attachment, Names};
use crate::spatial::Vec3;
use crate::toml_reader::{Table, Value};

/// A joint that closes a loop. It keeps the orientations (of a weld, of axes) of the time at which it becomes active.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosureEntry {
    /// Name, unique among joints and closures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// The free motions; never [`JointAxes::Free`].
    pub kind: JointAxes,
    /// One end.
    pub first: Attachment,
    /// The other end.
    pub second: Attachment,
    /// The points that it keeps together.
    pub anchor: Anchor,
    /// Whether it is active from the start; otherwise an event adds it.
    pub active: bool,
}

/// The points that a closure keeps together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Anchor {
    /// The points of both bodies that are at this position at the start.
    Start {
        /// Position in the world [m].
        at: Vec3,
    },
    /// A point of each body, in its frame [m].
    Points {
        /// Point in the frame of the first body.
        on_first: Vec3,
        /// Point in the frame of the second body.
        on_second: Vec3,
    },
    /// A point of the first body, and the point of the second one that is there when the closure becomes active.
    AsFound {
        /// Point in the frame of the first body [m].
        on_first: Vec3,
    },
}

impl Anchor {
    /// The anchor for points that are relative to other reference points than the mass centres.
    pub(super) fn shifted(self, first: Vec3, second: Vec3) -> Anchor {
        match self {
            Anchor::Start { at } => Anchor::Start { at },
            Anchor::Points { on_first, on_second } => {
                Anchor::Points { on_first: on_first + first, on_second: on_second + second }
            }
            Anchor::AsFound { on_first } => Anchor::AsFound { on_first: on_first + first },
        }
    }
}

const KEYS: &[&str] = &["name", "kind", "first", "second", "at", "on_first", "on_second", "active"];
/// Largest initial distance of the points of an active closure [m]: the sum of rounding a few lengths to a tenth of a
/// millimetre.
const LARGEST_GAP: f64 = 1e-3;

impl ClosureEntry {
    pub(super) fn read(
        table: &Table<'_>,
        name: String,
        names: &Names,
        bodies: &[BodyEntry],
    ) -> Result<ClosureEntry, SceneError> {
        let kind = JointAxes::read(table, KEYS)?;
        if kind == JointAxes::Free {
            return Err(table.need("kind", "a kind")?.wrong("a kind with a constraint; `free` has none"));
        }
        let value = table.need("second", "the other end")?;
        let closure = ClosureEntry {
            name,
            line: table.line,
            kind,
            first: names.carrier(&table.need("first", "one end: \"world\" or a body")?)?,
            second: names.carrier(&value)?,
            anchor: anchor(table)?,
            active: table.truth_or("active", true)?,
        };
        if closure.first == closure.second {
            return Err(value.wrong("another body than `first`"));
        }
        closure.refuse_gap(table, bodies)?;
        Ok(closure)
    }

    /// Rejects a closure that is active from the start but open.
    fn refuse_gap(&self, table: &Table<'_>, bodies: &[BodyEntry]) -> Result<(), SceneError> {
        let Anchor::Points { on_first, on_second } = self.anchor else { return Ok(()) };
        let place = |carrier: &Attachment, point: Vec3| match carrier {
            Attachment::World => Some(point),
            Attachment::Body(body) => Some(bodies[*body].start.place(point)),
            Attachment::FigureBody { .. } => None,
        };
        let (Some(a), Some(b)) = (place(&self.first, on_first), place(&self.second, on_second)) else { return Ok(()) };
        let gap = match self.kind {
            JointAxes::Prismatic { axis } => (b - a).cross(&axis).norm(),
            JointAxes::Planar { normal, .. } => (b - a).dot(&normal).abs(),
            _ => (b - a).norm(),
        };
        if !self.active || gap <= LARGEST_GAP {
            return Ok(());
        }
        let value = table.need("on_second", "a point")?;
        let expected = "points that coincide at the start, within 1 mm";
        let advice = "move the bodies, or set active = false and add the closure by an [[event]]";
        Err(value.wrong(&format!("{expected}; they are {gap:.4} m apart")).hint(advice))
    }
}

fn anchor(table: &Table<'_>) -> Result<Anchor, SceneError> {
    let get = |key: &str| table.get(key).map(|value: Value<'_>| value.vector()).transpose();
    match (get("at")?, get("on_first")?, get("on_second")?) {
        (Some(at), None, None) => Ok(Anchor::Start { at }),
        (None, Some(on_first), Some(on_second)) => Ok(Anchor::Points { on_first, on_second }),
        (None, Some(on_first), None) => Ok(Anchor::AsFound { on_first }),
        (None, None, None) => Err(table
            .missing("at", "the point [m] of the world at the start that both share")
            .hint("or `on_first` and `on_second`, or `on_first` alone")),
        (None, None, Some(_)) => Err(table.missing("on_first", "the point of the first body [m]")),
        (Some(_), _, _) => {
            let value = table.need("at", "a point")?;
            Err(value.wrong("either `at`, or `on_first` and `on_second`"))
        }
    }
}
