//! Force plates compared with those of ezc3d: force and centre of pressure.
//!
//! ezc3d leaves offsets where they are, so ours are read without removing them. Where the file contains the force of
//! the foot on the plate, ezc3d passes it on as it stands and we turn it.

use ambulo::findings::{Code, Findings};
use ambulo::motion::{PlateRecording, PlateSettings, plates_from_c3d};
use ambulo_formats::c3d::C3d;
use std::collections::BTreeMap;

/// Allowed difference of forces [N].
const FORCE_N: f64 = 1.0;
/// Allowed difference of centres of pressure under [`SOLID_N`] or more [m].
const CENTER_M: f64 = 0.001;
/// Lighter loads leave the centre of pressure to noise [N].
const SOLID_N: f64 = 100.0;

/// Largest differences, and whether they are allowed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PlateComparison {
    pub(super) force_n: f64,
    pub(super) center_m: f64,
    pub(super) note: String,
}

impl PlateComparison {
    pub(super) fn is_fine(&self) -> bool {
        self.force_n <= FORCE_N && self.center_m <= CENTER_M
    }
}

/// Our plates compared with ezc3d's; `None` if neither has any. An error states how they differ in number.
pub(super) fn compare(
    record: &C3d,
    blocks: &BTreeMap<String, (usize, Vec<f64>)>,
) -> Result<Option<PlateComparison>, String> {
    let mut findings = Findings::default();
    let settings = PlateSettings { remove_baseline: false };
    let plates = plates_from_c3d(record, settings, &mut findings).map_err(|e| e.to_string())?;
    let rows = |name: &str| blocks.get(name).map_or(Vec::new(), |(n, v)| v.chunks_exact((*n).max(1)).collect());
    let (forces, centers) = (rows("plate_forces"), rows("plate_centers"));
    if forces.len() != plates.len() || centers.len() != plates.len() {
        return Err(format!("{} plates, ezc3d {}", plates.len(), forces.len()));
    }
    if plates.is_empty() {
        return Ok(None);
    }
    let turned = findings.has(Code::PlatesForceOnPlate);
    let mut found = PlateComparison { force_n: 0.0, center_m: 0.0, note: String::new() };
    if turned {
        found.note = "holds the force on the plate, which ezc3d does not turn".to_owned();
    }
    for (plate, (force, center)) in plates.iter().zip(forces.into_iter().zip(centers)) {
        add(&mut found, plate, force, center, if turned { -1.0 } else { 1.0 })?;
    }
    Ok(Some(found))
}

fn add(
    found: &mut PlateComparison,
    plate: &PlateRecording,
    force: &[f64],
    center: &[f64],
    sign: f64,
) -> Result<(), String> {
    if force.len() != 3 * plate.times.len() || center.len() != force.len() {
        return Err(format!("{}: {} samples, ezc3d {}", plate.name, plate.times.len(), force.len() / 3));
    }
    for i in 0..plate.times.len() {
        let solid = plate.vertical(i) >= SOLID_N;
        for k in 0..3 {
            let apart = (plate.force[i][k] - sign * force[3 * i + k]).abs();
            found.force_n = found.force_n.max(if apart.is_nan() { f64::INFINITY } else { apart });
            if solid {
                found.center_m = found.center_m.max((plate.center_of_pressure(i)[k] - center[3 * i + k]).abs());
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ambulo_formats::c3d::{Channel, Group, Parameter, Values};

    /// A plate of type 2 under 600 N at its centre, (0.2, 0.3, 0) m.
    fn record() -> C3d {
        let mut record = C3d::new(100.0, "mm");
        let values = [0.0, 0.0, -600.0, 0.0, 0.0, 0.0];
        let channel = |(i, v): (usize, &f64)| Channel::new(&format!("C{i}"), "N", vec![0.0, *v]);
        record.channels = values.iter().enumerate().map(channel).collect();
        record.analog_rate_hz = 100.0;
        let corners = vec![400.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 600.0, 0.0, 400.0, 600.0, 0.0];
        let parameters = vec![
            Parameter::single("USED", Values::Integers(vec![1])),
            Parameter::list("TYPE", Values::Integers(vec![2])),
            Parameter { dimensions: vec![3, 4, 1], ..Parameter::list("CORNERS", Values::Reals(corners)) },
            Parameter { dimensions: vec![3, 1], ..Parameter::list("ORIGIN", Values::Reals(vec![0.0; 3])) },
            Parameter { dimensions: vec![6, 1], ..Parameter::list("CHANNEL", Values::Integers((1..=6).collect())) },
        ];
        let (name, description) = ("FORCE_PLATFORM".to_owned(), String::new());
        record.parameters.groups.push(Group { name, description, locked: false, parameters });
        record
    }

    #[test]
    fn agreement_and_difference_of_plates_are_told_apart() {
        let blocks = |up: f64, x: f64| {
            let forces = vec![0.0, 0.0, 0.0, 0.0, 0.0, up];
            let centers = vec![f64::NAN, f64::NAN, f64::NAN, x, 0.3, 0.0];
            BTreeMap::from([("plate_forces".to_owned(), (6, forces)), ("plate_centers".to_owned(), (6, centers))])
        };
        let fine = |up, x| compare(&record(), &blocks(up, x)).unwrap().unwrap().is_fine();
        assert!(fine(600.0, 0.2));
        assert!(!fine(605.0, 0.2) && !fine(-600.0, 0.2) && !fine(600.0, 0.21));
        assert!(compare(&record(), &BTreeMap::new()).unwrap_err().contains("1 plates, ezc3d 0"));
    }
}
