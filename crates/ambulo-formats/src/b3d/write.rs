//! Writes a file: every frame of a kind has the same size, because repeated numbers are packed.

use super::wire::Encoder;
use super::{B3d, Header, MissingForce, PassFrames, PassKind, TrialFrames, TrialHeader, TrialKind};
use crate::error::Error;

pub(super) fn file(b3d: &B3d) -> Result<Vec<u8>, Error> {
    b3d.check()?;
    let header = &b3d.header;
    let frames = header.trials.iter().zip(&b3d.trials);
    let frames: Vec<(Vec<u8>, Vec<Vec<u8>>)> =
        frames.flat_map(|(head, trial)| (0..head.frames).map(|k| (sensors(trial, k), computed(trial, k)))).collect();
    let sensor_bytes = frames.iter().map(|(sensors, _)| sensors.len()).max().unwrap_or(0);
    let pass_bytes = frames.iter().flat_map(|(_, passes)| passes).map(Vec::len).max().unwrap_or(0);
    let message = header_message(header, sensor_bytes, pass_bytes);
    let mut bytes = (message.len() as i64).to_le_bytes().to_vec();
    bytes.extend(message);
    // Zeros fill a slot.
    let mut put = |content: &[u8], size: usize| {
        bytes.extend(content);
        bytes.resize(bytes.len() + size - content.len(), 0);
    };
    for (sensors, passes) in &frames {
        put(sensors, sensor_bytes);
        passes.iter().for_each(|pass| put(pass, pass_bytes));
    }
    Ok(bytes)
}

impl B3d {
    /// Whether the frames are as many as the header states.
    fn check(&self) -> Result<(), Error> {
        let Header { trials, markers, coordinates, contact_bodies, .. } = &self.header;
        let refused = |found: String, expected: &str| Err(Error::Record { found, expected: expected.to_owned() });
        if trials.len() != self.trials.len() {
            let found = format!("frames of {} trials and headers of {}", self.trials.len(), trials.len());
            return refused(found, "frames for each trial");
        }
        for (head, trial) in trials.iter().zip(&self.trials) {
            let n = head.frames;
            let has_all = |pass: &PassFrames| {
                let of_contacts = pass.contacts.iter().flat_map(|c| [&c.force, &c.centre_of_pressure, &c.moment]);
                pass.positions.len() == *coordinates
                    && pass.contacts.len() == contact_bodies.len()
                    && pass.positions.iter().all(|column| column.len() == n)
                    && (pass.mass_centre.is_empty() || pass.mass_centre.len() == n)
                    && of_contacts.into_iter().all(|column| column.len() == n)
            };
            let is_whole = head.missing_force.len() == n
                && trial.markers.len() == markers.len()
                && trial.markers.iter().all(|path| path.len() == n)
                && head.passes.len() == trial.passes.len()
                && trial.passes.iter().all(has_all);
            if !is_whole {
                return refused(format!("trial `{}` with columns of other lengths", head.name), "one entry per frame");
            }
        }
        Ok(())
    }
}

fn sensors(trial: &TrialFrames, frame: usize) -> Vec<u8> {
    let mut message = Encoder::default();
    message.doubles(2, trial.markers.iter().flat_map(|path| path[frame]));
    message.0
}

fn computed(trial: &TrialFrames, frame: usize) -> Vec<Vec<u8>> {
    trial.passes.iter().map(|pass| pass_frame(pass, frame)).collect()
}

fn pass_frame(pass: &PassFrames, frame: usize) -> Vec<u8> {
    let mut message = Encoder::default();
    message.doubles(1, pass.positions.iter().map(|column| column[frame]));
    message.doubles(6, pass.contacts.iter().flat_map(|contact| contact.centre_of_pressure[frame]));
    message.doubles(7, pass.contacts.iter().flat_map(|contact| contact.moment[frame]));
    message.doubles(8, pass.contacts.iter().flat_map(|contact| contact.force[frame]));
    message.doubles(9, pass.mass_centre.get(frame).copied().into_iter().flatten());
    message.0
}

fn header_message(header: &Header, sensor_bytes: usize, pass_bytes: usize) -> Vec<u8> {
    let mut message = Encoder::default();
    message.count(1, header.coordinates);
    message.count(2, header.trials.len());
    message.count(3, sensor_bytes);
    message.count(4, pass_bytes);
    for pass in &header.passes {
        let mut of_pass = Encoder::default();
        of_pass.count(1, number(&PassKind::ALL, pass.kind));
        of_pass.bytes(2, pass.model.as_bytes());
        message.bytes(5, &of_pass.0);
    }
    let texts = [(6, &header.contact_bodies), (17, &header.markers)];
    for (number, list) in texts {
        list.iter().for_each(|text| message.bytes(number, text.as_bytes()));
    }
    header.trials.iter().for_each(|trial| message.bytes(9, &trial_message(trial)));
    message.count(10, header.version);
    for (number, text) in [(11, &header.href), (12, &header.notes), (13, &header.person.sex)] {
        message.bytes(number, text.as_bytes());
    }
    message.double(14, header.person.height_m);
    message.double(15, header.person.mass_kg);
    message.count(16, header.person.age_years);
    message.count(24, header.joints);
    message.0
}

fn trial_message(trial: &TrialHeader) -> Vec<u8> {
    let mut message = Encoder::default();
    message.bytes(1, trial.name.as_bytes());
    message.varints(2, trial.missing_force.iter().map(|MissingForce(reason)| *reason));
    message.count(3, trial.frames);
    message.double(4, trial.step_s);
    for pass in &trial.passes {
        let mut of_pass = Encoder::default();
        of_pass.count(1, number(&PassKind::ALL, pass.kind));
        of_pass.varints(2, pass.observed.iter().map(|observed| u64::from(*observed)));
        of_pass.float(10, pass.cutoff_hz);
        message.bytes(5, &of_pass.0);
    }
    message.count(7, trial.force_plates);
    message.count(9, usize::from(trial.marker_names_guessed));
    message.count(17, number(&TrialKind::ALL, trial.kind));
    message.0
}

/// The number of a kind in the file.
fn number<T: PartialEq>(all: &[T], kind: T) -> usize {
    all.iter().position(|known| *known == kind).unwrap_or(0)
}
