//! Whether `summary.json` says what a page takes from it in the types of docs/OUTPUTS.md.
//!
//! A key that is missing or `null` is no error: what it would say is not shown. One of another type is.

use super::numbers;
use serde_json::Value;

/// What may stand at a key.
#[derive(Clone, Copy)]
enum Kind {
    Object,
    List,
    Flag,
    Number,
    Text,
    /// Two instants.
    Span,
    OneOf(&'static [&'static str]),
}

use Kind::{Flag, List, Number, Object, OneOf, Span, Text};

const SOURCES: &[&str] = &["measured", "predicted", "simulated", "none"];

/// Keys of the whole.
const KEYS: [(&str, Kind); 50] = [
    ("version", Text),
    ("model", Text),
    ("title", Text),
    ("input", Object),
    ("input.motion", Text),
    ("input.model", Text),
    ("input.static", Text),
    ("input.scene", Text),
    ("mass_kg", Number),
    ("mass_model_kg", Number),
    ("mass_source", Text),
    ("height_m", Number),
    ("speed_m_s", Number),
    ("ground", Object),
    ("ground.source", OneOf(SOURCES)),
    ("ground.rule", Text),
    ("ground.threshold_n", Number),
    ("residual", Object),
    ("residual.force_rms_n", Number),
    ("residual.force_rms_bw", Number),
    ("residual.force_peak_n", Number),
    ("residual.moment_rms_nm", Number),
    ("residual.moment_peak_nm", Number),
    ("peaks", List),
    ("findings", List),
    ("verdict", Object),
    ("verdict.feasible", Flag),
    ("verdict.figures", List),
    ("prediction", Object),
    ("prediction.checks", List),
    ("comparison", Object),
    ("comparison.feet", List),
    ("comparison.moments", List),
    ("comparison.events", List),
    ("consistency", Object),
    ("consistency.changes", Object),
    ("subject", Object),
    ("subject.markers", Object),
    ("subject.markers.errors", List),
    ("subject.markers.rms_mm", Number),
    ("subject.plates", List),
    ("subject.plate_corners_m", List),
    ("subject.events", List),
    ("subject.segments", List),
    ("subject.assumptions", List),
    ("subject.instrumented_windows_s", List),
    ("walk", Object),
    ("walk.gait", Text),
    ("walk.leg_length_m", Number),
    ("world", Object),
];
/// Keys of a verdict.
const VERDICT: [(&str, Kind); 6] = [
    ("feasible", Flag),
    ("reasons", List),
    ("closest", List),
    ("not_judged", List),
    ("mass_kg", Number),
    ("height_m", Number),
];
/// Keys of the entries of lists.
const REASON: [(&str, Kind); 5] =
    [("check", Text), ("quantity", Text), ("side", Text), ("time_s", Span), ("message", Text)];
const CLOSEST: [(&str, Kind); 7] = [
    ("check", Text),
    ("quantity", Text),
    ("at_s", Number),
    ("value", Number),
    ("limit", Number),
    ("unit", Text),
    ("share", Number),
];
const NOT_JUDGED: [(&str, Kind); 2] = [("check", Text), ("why", Text)];
const FINDING: [(&str, Kind); 4] = [("code", Text), ("severity", Text), ("message", Text), ("count", Number)];

/// What is wrong, with the key: what was found and what was expected.
pub(super) fn defect(summary: &Value) -> Option<String> {
    if !summary.is_object() {
        return Some(format!("found {}; expected an object with the keys of docs/OUTPUTS.md", shown(summary)));
    }
    let entries = |path: &str, keys: &[(&str, Kind)]| {
        let list = at(summary, path).as_array().map_or(&[][..], Vec::as_slice);
        list.iter().enumerate().find_map(|(i, entry)| entry_defect(entry, &format!("{path}[{i}]"), keys))
    };
    keys(summary, "", &KEYS)
        .or_else(|| entries("findings", &FINDING))
        .or_else(|| verdict(at(summary, "verdict"), "verdict"))
        .or_else(|| {
            let figures = at(summary, "verdict.figures").as_array()?;
            figures.iter().enumerate().find_map(|(i, figure)| verdict(figure, &format!("verdict.figures[{i}]")))
        })
        .or_else(|| {
            let (path, number) = numbers::unsound(summary, "")?;
            Some(format!("`{path}` is {number:?}; expected {}", numbers::EXPECTED))
        })
}

/// Of all figures together or of one.
fn verdict(value: &Value, path: &str) -> Option<String> {
    if value.is_null() {
        return None;
    }
    let lists: [(&str, &[(&str, Kind)]); 3] =
        [("reasons", &REASON), ("closest", &CLOSEST), ("not_judged", &NOT_JUDGED)];
    entry_defect(value, path, &VERDICT).or_else(|| {
        lists.into_iter().find_map(|(name, keys)| {
            let list = value[name].as_array()?;
            list.iter().enumerate().find_map(|(i, entry)| entry_defect(entry, &format!("{path}.{name}[{i}]"), keys))
        })
    })
}

fn entry_defect(entry: &Value, path: &str, wanted: &[(&str, Kind)]) -> Option<String> {
    match entry.is_object() {
        true => keys(entry, &format!("{path}."), wanted),
        false => Some(wrong(path, entry, Object)),
    }
}

fn keys(object: &Value, prefix: &str, wanted: &[(&str, Kind)]) -> Option<String> {
    wanted.iter().find_map(|(path, kind)| {
        let value = at(object, path);
        (!value.is_null() && !kind.allows(value)).then(|| wrong(&format!("{prefix}{path}"), value, *kind))
    })
}

/// `ground.source`; nothing where there is no such key.
fn at<'a>(object: &'a Value, path: &str) -> &'a Value {
    path.split('.').fold(object, |value, key| &value[key])
}

fn wrong(path: &str, value: &Value, kind: Kind) -> String {
    format!("`{path}` is {}; expected {}", shown(value), kind.words())
}

/// Its beginning.
fn shown(value: &Value) -> String {
    const MOST: usize = 40;
    let text = value.to_string();
    if text.chars().count() <= MOST { text } else { text.chars().take(MOST).chain("...".chars()).collect() }
}

impl Kind {
    fn allows(self, value: &Value) -> bool {
        match self {
            Object => value.is_object(),
            List => value.is_array(),
            Flag => value.is_boolean(),
            Number => value.is_number(),
            Text => value.is_string(),
            Span => value.as_array().is_some_and(|ends| ends.len() == 2 && ends.iter().all(Value::is_number)),
            OneOf(words) => value.as_str().is_some_and(|word| words.contains(&word)),
        }
    }

    fn words(self) -> String {
        match self {
            Object => "an object".to_owned(),
            List => "a list".to_owned(),
            Flag => "true or false".to_owned(),
            Number => "a number".to_owned(),
            Text => "a text".to_owned(),
            Span => "two instants [s]".to_owned(),
            OneOf(words) => format!("one of {}", words.join(", ")),
        }
    }
}
