//! Colours of a glTF file; right and left have the colours of the report.

use crate::style::{Style, style};
use ambulo::model::Side;
use ambulo::numerics::elementary::powf;
use serde_json::{Value, json};

/// Colour of a mesh; its number is the index of the material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Paint {
    Right,
    Left,
    Middle,
    Measured,
    Plate,
    Still,
}

impl Paint {
    pub(super) fn of_side(side: Option<Side>) -> Paint {
        match side {
            Some(Side::Right) => Paint::Right,
            Some(Side::Left) => Paint::Left,
            None => Paint::Middle,
        }
    }
}

/// All materials, in the order of [`Paint`].
pub(super) fn all() -> Value {
    let of_style = |pick: fn(&Style) -> &str| style().map_or("#808080", pick);
    let paints = [
        ("right", of_style(|style| &style.right.color)),
        ("left", of_style(|style| &style.left.color)),
        ("middle", "#BFB8AD"),
        ("measured", of_style(|style| &style.measured.color)),
        ("plate", of_style(|style| &style.quiet.color)),
        ("still", "#9AA0A6"),
    ];
    paints.iter().map(|(name, color)| material(name, color)).collect()
}

fn material(name: &str, color: &str) -> Value {
    json!({
        "name": name,
        // Sheets are visible from both sides.
        "doubleSided": true,
        "pbrMetallicRoughness": { "baseColorFactor": linear(color), "metallicFactor": 0, "roughnessFactor": 0.8 },
    })
}

/// `#RRGGBB` as linear red, green, blue and opacity (IEC 61966-2-1's curve; unverified).
fn linear(color: &str) -> [f64; 4] {
    let channel = |k: usize| {
        let byte = color.get(2 * k + 1..2 * k + 3).and_then(|text| u8::from_str_radix(text, 16).ok()).unwrap_or(128);
        let share = f64::from(byte) / 255.0;
        if share <= 0.040_45 { share / 12.92 } else { powf((share + 0.055) / 1.055, 2.4) }
    };
    [channel(0), channel(1), channel(2), 1.0]
}
