//! Forces under the feet of a body that follows markers: plates of the file, or a table.

use super::{Reading, coordinates};
use crate::args::ForcesArgs;
use ambulo::analysis::BodyInMotion;
use ambulo::findings::{Code, Findings};
use ambulo::ground::plates::foot_bodies;
use ambulo::motion::ForceRecording;
use ambulo::spatial::{Mat3, Vec3};
use ambulo_results::Input;
use anyhow::Result;

/// The forces under the feet: from a table if one was given, else from the plates of the file.
pub(super) fn read(
    args: &ForcesArgs,
    body: &BodyInMotion,
    reading: &mut Reading,
) -> Result<(Vec<ForceRecording>, Input)> {
    if args.no_ground {
        return Ok((Vec::new(), coordinates::input(args, None)));
    }
    if args.grf.is_some() || args.loads.is_some() {
        let (table, mut plates) = coordinates::read_ground(args, &body.subject.model, reading)?;
        turn_to_world(&mut plates, &body.laboratory.world_from_lab, &mut reading.findings);
        return Ok((plates, coordinates::input(args, table.as_ref())));
    }
    let plates = body.plate_forces();
    if plates.is_empty() {
        reading.findings.report(Code::GroundPredicted, without_forces(body));
        return Ok((plates, coordinates::input(args, None)));
    }
    let input = Input { ground: Some(args.input.display().to_string()), ..coordinates::input(args, None) };
    Ok((plates, input))
}

/// Brings forces of a table to the world's axes: from those of the markers, or not at all where they stand upright as they are.
fn turn_to_world(plates: &mut [ForceRecording], world_from_lab: &Mat3, findings: &mut Findings) {
    /// Share of the mean force that points up where the axes are right: walking sums to nearly none forwards and sideways.
    const UPRIGHT: f64 = 0.9;
    let sum: Vec3 = plates.iter().flat_map(|p| &p.force).filter(|f| f.iter().all(|x| x.is_finite())).sum();
    let is_upright = |sum: &Vec3| sum.y > UPRIGHT * sum.norm();
    if is_upright(&sum) && !is_upright(&(world_from_lab * sum)) {
        findings.report(
            Code::LoadsWorldAxes,
            "the table's forces do not stand in the axes of the markers; they are taken as x forward, y up, z right",
        );
        return;
    }
    plates.iter_mut().for_each(|plate| plate.turn(world_from_lab));
}

/// Why there are no forces under the feet.
fn without_forces(body: &BodyInMotion) -> String {
    let contacts = &body.on_plates.contacts;
    let found = if body.plates.is_empty() {
        "the file has no force plates".to_owned()
    } else if contacts.is_empty() {
        format!("no load was measured on the file's {}", counted(body.plates.len(), "force plate"))
    } else if foot_bodies(&body.subject.model).is_none() {
        "the model has no bodies called calcn_r and calcn_l, foot_r and foot_l or talus_r and talus_l".to_owned()
    } else {
        let first = &contacts[0];
        let plate = &body.plates[first.plate].name;
        format!(
            "no plate's load belongs to one foot ({plate}, {:.3}-{:.3} s: {})",
            first.start_s, first.end_s, first.reason
        )
    };
    format!("{found}: the ground forces are predicted from the motion")
}

fn counted(count: usize, one: &str) -> String {
    format!("{count} {one}{}", if count == 1 { "" } else { "s" })
}
