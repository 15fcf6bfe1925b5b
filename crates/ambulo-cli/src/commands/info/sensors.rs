//! Description of orientations of sensors.

use super::Sheet;
use ambulo_formats::table::OrientationTable;
use anyhow::Result;
use std::path::Path;

pub(super) fn describe(path: &Path, bytes: &[u8]) -> Result<Sheet> {
    let table = OrientationTable::read(bytes)?;
    let mut sheet = Sheet::of("orientations of sensors (quaternions)");
    let (first, last) = (table.times.first(), table.times.last());
    sheet.value("rows", table.times.len());
    sheet.value("from_s", first.copied());
    sheet.value("to_s", last.copied());
    sheet.value("rate_hz", table.rate_hz);
    sheet.names("sensors", &table.sensors.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>());
    let missing = |path: &[Option<[f64; 4]>]| path.iter().filter(|orientation| orientation.is_none()).count();
    let gaps = table.sensors.iter().filter(|(_, path)| missing(path) > 0);
    let gaps: Vec<String> = gaps.map(|(name, path)| format!("{name}: {} rows without", missing(path))).collect();
    if !gaps.is_empty() {
        sheet.list("sensors_with_gaps", gaps);
    }
    sheet.next(format!(
        "ambulo forces {} --static STANDING.sto --model MODEL.osim -o out (or --mass KG --height M for the built-in \
         body; without --static the first row is the standing posture)",
        path.display()
    ));
    Ok(sheet)
}
