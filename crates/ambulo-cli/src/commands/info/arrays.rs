//! Description of archives of NumPy arrays, and of motions of the SMPL family among them.

use super::Sheet;
use ambulo::motion::SmplMotion;
use ambulo_formats::npz::{Array, Data, Npz};
use anyhow::Result;
use serde_json::Value;
use std::path::Path;

pub(super) fn describe(path: &Path, bytes: &[u8]) -> Result<Sheet> {
    let shapes = Npz::shapes(bytes)?;
    // Large arrays are read only if they belong to a motion.
    let is_short = |name: &str| shapes.array(name).is_some_and(|array| array.shape.iter().product::<usize>() <= 1);
    let motion = SmplMotion::check_shapes(&shapes);
    let is_motion = motion.is_ok();
    let npz = Npz::read_named(bytes, |name| is_short(name) || (is_motion && SmplMotion::is_array(name)))?;
    let mut sheet = Sheet::of("NumPy arrays");
    sheet.list("arrays", npz.arrays.iter().map(|(name, array)| in_words(name, array)).collect());
    match motion.and_then(|()| SmplMotion::from_npz(&npz)) {
        Ok(motion) => {
            let frames = motion.translations.len();
            sheet.value("frames", frames);
            sheet.value("rate_hz", motion.rate_hz);
            sheet.value("duration_s", frames.saturating_sub(1) as f64 / motion.rate_hz);
            sheet.next(format!(
                "ambulo forces {} --mass KG --height M -o out (or --smpl MODEL.npz for the lengths; the file contains \
                 neither mass nor lengths)",
                path.display()
            ));
        }
        Err(error) => sheet.entry("motion", Value::Null, vec![format!("none: {error}")]),
    }
    Ok(sheet)
}

/// `poses: 1200 x 156 numbers`.
fn in_words(name: &str, array: &Array) -> String {
    let lengths = array.shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(" x ");
    let shape = if lengths.is_empty() { String::new() } else { format!("{lengths} ") };
    match &array.data {
        Data::Numbers(numbers) if array.shape.is_empty() => format!("{name}: {}", numbers.first().unwrap_or(&f64::NAN)),
        Data::Numbers(_) => format!("{name}: {shape}numbers"),
        Data::Text(text) => format!("{name}: `{text}`"),
        Data::Texts { kind, .. } | Data::Other(kind) => format!("{name}: {shape}of type `{kind}`, not read"),
    }
}
