//! Writes markers with their meaning as a TOML file that [`MarkerSet::from_toml`](super::MarkerSet::from_toml) reads.

use super::NamedMarker;
use crate::model::Side;
use std::fmt::Write;

/// A marker set as text: one table per marker, and a comment per name without a meaning. `comment` is written at the
/// top; the names in `proposed` get a comment that asks to check them.
#[must_use]
pub fn marker_template(comment: &str, markers: &[NamedMarker], proposed: &[String], unknown: &[String]) -> String {
    let mut text = String::new();
    for line in comment.lines() {
        // Writing to a string does not fail.
        let _ = writeln!(text, "# {line}");
    }
    let _ = writeln!(text, "\nname = \"template\"");
    for marker in markers {
        let definition = &marker.definition;
        if proposed.contains(&marker.name) {
            let _ = write!(text, "\n# proposed by its position; check it");
        }
        let _ = write!(text, "\n[[single]]\nnames = {}\n", quoted(&marker.name));
        let side = definition.side.map(|side| if side == Side::Right { "right" } else { "left" });
        if let Some(side) = side {
            let _ = writeln!(text, "side = \"{side}\"");
        }
        let _ = match definition.landmark {
            Some(landmark) => writeln!(text, "landmark = \"{}\"", landmark.word()),
            None => writeln!(text, "segment = \"{}\"", definition.segment.word()),
        };
    }
    for name in unknown {
        let _ = write!(text, "\n# no proposal:\n# [[single]]\n# names = {}\n# segment = \"\"\n", quoted(name));
    }
    text
}

/// A TOML string.
fn quoted(name: &str) -> String {
    let mut text = String::from("\"");
    for c in name.chars() {
        match c {
            '"' | '\\' => text.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(text, "\\u{:04X}", u32::from(c));
            }
            c => text.push(c),
        }
    }
    text.push('"');
    text
}
