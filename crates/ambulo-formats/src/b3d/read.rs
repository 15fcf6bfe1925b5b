//! Reads the header and the frames of a trial.

use super::wire::{Field, Message};
use super::{
    B3d, ContactFrames, Header, LENGTH_BYTES, Layout, MAX_HEADER_BYTES, MissingForce, Pass, PassFrames, PassKind,
    Person, TrialFrames, TrialHeader, TrialKind, TrialPass,
};
use crate::error::Error;

pub(super) fn file(bytes: &[u8]) -> Result<B3d, Error> {
    let header = header(bytes)?;
    let frames = |trial: usize| {
        let place = header.trial_place(trial);
        let of_trial = place.as_ref().and_then(|place| bytes.get(place.clone())).ok_or_else(|| Error::CutOff {
            offset: bytes.len(),
            expected: format!(
                "the frames of trial {} up to byte {}",
                trial + 1,
                place.map_or_else(|| "beyond any file".to_owned(), |place| place.end.to_string())
            ),
        })?;
        header.read_trial(trial, of_trial)
    };
    let trials = (0..header.trials.len()).map(frames).collect::<Result<_, _>>()?;
    Ok(B3d { header, trials })
}

pub(super) fn header_length(bytes: &[u8]) -> Result<usize, Error> {
    let expected = "a .b3d file, which begins with the length of its header";
    let Some(first) = bytes.first_chunk::<LENGTH_BYTES>() else {
        return Err(match bytes.is_empty() {
            true => Error::Empty { expected },
            false => Error::CutOff { offset: bytes.len(), expected: expected.to_owned() },
        });
    };
    let length = i64::from_le_bytes(*first);
    let of_header = usize::try_from(length).ok().filter(|length| (1..=MAX_HEADER_BYTES).contains(length));
    of_header.map(|length| length + LENGTH_BYTES).ok_or_else(|| Error::Byte {
        offset: 0,
        found: format!("{length} as the length of the header"),
        expected: format!("1 to {MAX_HEADER_BYTES} bytes. Is this {expected}?"),
    })
}

pub(super) fn header(bytes: &[u8]) -> Result<Header, Error> {
    let end = header_length(bytes)?;
    let message = bytes.get(LENGTH_BYTES..end).ok_or_else(|| Error::CutOff {
        offset: bytes.len(),
        expected: format!("a header of {} bytes after the first eight", end - LENGTH_BYTES),
    })?;
    let mut header = Header { layout: Layout { frames_start: end, ..Layout::default() }, ..Header::default() };
    for field in Message::new(message, LENGTH_BYTES) {
        header.take(&field?)?;
    }
    header.check()?;
    Ok(header)
}

impl Header {
    fn take(&mut self, field: &Field<'_>) -> Result<(), Error> {
        match field.number {
            1 => self.coordinates = field.count()?,
            3 => self.layout.sensor_bytes = field.count()?,
            4 => self.layout.pass_bytes = field.count()?,
            5 => self.passes.push(pass(field.message()?)?),
            6 => self.contact_bodies.push(field.text()?),
            9 => self.trials.push(trial_header(field.message()?)?),
            10 => self.version = field.count()?,
            11 => self.href = field.text()?,
            12 => self.notes = field.text()?,
            17 => self.markers.push(field.text()?),
            24 => self.joints = field.count()?,
            _ => self.person.take(field)?,
        }
        Ok(())
    }

    /// Whether the numbers of the header belong together.
    fn check(&self) -> Result<(), Error> {
        let refused = |found: String, expected: &str| {
            Err(Error::Byte { offset: LENGTH_BYTES, found, expected: expected.to_owned() })
        };
        for (k, trial) in self.trials.iter().enumerate() {
            let (number, frames) = (k + 1, trial.frames);
            if trial.missing_force.len() != frames {
                let found = format!("{} frames with a reason in trial {number}", trial.missing_force.len());
                return refused(found, &format!("one for each of its {frames} frames"));
            }
            if trial.passes.len() > self.passes.len() {
                let found = format!("{} passes in trial {number}", trial.passes.len());
                return refused(found, &format!("at most the {} passes of the file", self.passes.len()));
            }
            if frames > 0 && self.frame_bytes(trial) == Some(0) {
                return refused(format!("{frames} frames of no bytes in trial {number}"), "frames with a size");
            }
            if !trial.step_s.is_finite() || (frames > 1 && trial.step_s <= 0.0) {
                return refused(format!("a time step of {} s in trial {number}", trial.step_s), "a time above zero");
            }
        }
        Ok(())
    }
}

impl Person {
    fn take(&mut self, field: &Field<'_>) -> Result<(), Error> {
        match field.number {
            13 => self.sex = field.text()?,
            14 => self.height_m = field.double()?,
            15 => self.mass_kg = field.double()?,
            16 => self.age_years = field.count().unwrap_or(0), // some files state -1
            _ => {}
        }
        Ok(())
    }
}

/// The kind with this number in a list of all kinds.
fn kind<T: Copy, const N: usize>(field: &Field<'_>, all: [T; N]) -> Result<T, Error> {
    let number = field.count()?;
    all.get(number).copied().ok_or_else(|| Error::Byte {
        offset: field.offset,
        found: format!("the kind {number} in field {}", field.number),
        expected: format!("a kind from 0 to {}", N - 1),
    })
}

fn pass(message: Message<'_>) -> Result<Pass, Error> {
    let mut pass = Pass::default();
    for field in message {
        let field = field?;
        match field.number {
            1 => pass.kind = kind(&field, PassKind::ALL)?,
            2 => pass.model = field.text()?,
            _ => {}
        }
    }
    Ok(pass)
}

fn trial_header(message: Message<'_>) -> Result<TrialHeader, Error> {
    let mut trial = TrialHeader::default();
    let mut reasons = Vec::new();
    for field in message {
        let field = field?;
        match field.number {
            1 => trial.name = field.text()?,
            2 => field.varints_into(&mut reasons)?,
            3 => trial.frames = field.count()?,
            4 => trial.step_s = field.double()?,
            5 => trial.passes.push(trial_pass(field.message()?)?),
            7 => trial.force_plates = field.count()?,
            9 => trial.marker_names_guessed = field.count()? != 0,
            17 => trial.kind = kind(&field, TrialKind::ALL)?,
            _ => {}
        }
    }
    trial.missing_force = reasons.into_iter().map(MissingForce).collect();
    Ok(trial)
}

fn trial_pass(message: Message<'_>) -> Result<TrialPass, Error> {
    let mut pass = TrialPass::default();
    let mut observed = Vec::new();
    for field in message {
        let field = field?;
        match field.number {
            1 => pass.kind = kind(&field, PassKind::ALL)?,
            2 => field.varints_into(&mut observed)?,
            10 => pass.cutoff_hz = Some(field.float()?).filter(|cutoff| cutoff.is_finite()).unwrap_or_default(),
            _ => {}
        }
    }
    pass.observed = observed.into_iter().map(|observed| observed != 0).collect();
    Ok(pass)
}

pub(super) fn trial(header: &Header, trial: usize, bytes: &[u8]) -> Result<TrialFrames, Error> {
    let (Some(of_trial), Some(place)) = (header.trials.get(trial), header.trial_place(trial)) else {
        let found = format!("trial {}", trial + 1);
        return Err(Error::Record { found, expected: format!("a trial from 1 to {}", header.trials.len()) });
    };
    if bytes.len() != place.len() {
        let expected = format!("{} bytes of the frames of trial {}", place.len(), trial + 1);
        return Err(Error::CutOff { offset: place.start + bytes.len(), expected });
    }
    let passes = of_trial.passes.len();
    let Layout { sensor_bytes, pass_bytes, .. } = header.layout;
    let mut frames =
        TrialFrames { markers: vec![Vec::new(); header.markers.len()], passes: vec![PassFrames::new(header); passes] };
    let width = sensor_bytes + pass_bytes * passes;
    let slots = if width == 0 { bytes.chunks_exact(1) } else { bytes.chunks_exact(width) };
    for (k, slot) in slots.enumerate() {
        let start = place.start + k * width;
        let (sensors, computed) = slot.split_at(sensor_bytes);
        take_markers(&mut frames.markers, sensors, start)?;
        if pass_bytes > 0 {
            for (p, (pass, slot)) in frames.passes.iter_mut().zip(computed.chunks_exact(pass_bytes)).enumerate() {
                pass.take(slot, start + sensor_bytes + p * pass_bytes)?;
            }
        }
    }
    Ok(frames)
}

/// As many numbers as expected.
fn counted(values: Vec<f64>, expected: usize, what: &str, offset: usize) -> Result<Vec<f64>, Error> {
    if values.len() == expected {
        return Ok(values);
    }
    Err(Error::Byte {
        offset,
        found: format!("{} numbers of {what} in a frame", values.len()),
        expected: format!("{expected}, as the header states"),
    })
}

fn take_markers(markers: &mut [Vec<[f64; 3]>], slot: &[u8], offset: usize) -> Result<(), Error> {
    let mut seen = Vec::new();
    for field in Message::new(slot, offset) {
        let field = field?;
        if field.number == 2 {
            field.doubles_into(&mut seen)?;
        }
    }
    let seen = counted(seen, 3 * markers.len(), "marker positions", offset)?;
    markers.iter_mut().zip(triples(&seen)).for_each(|(path, place)| path.push(place));
    Ok(())
}

fn triples(values: &[f64]) -> impl Iterator<Item = [f64; 3]> {
    values.chunks_exact(3).map(|three| [three[0], three[1], three[2]])
}

impl PassFrames {
    /// Without frames.
    fn new(header: &Header) -> PassFrames {
        PassFrames {
            positions: vec![Vec::new(); header.coordinates],
            mass_centre: Vec::new(),
            contacts: vec![ContactFrames::default(); header.contact_bodies.len()],
        }
    }

    fn take(&mut self, slot: &[u8], offset: usize) -> Result<(), Error> {
        let [mut positions, mut centres, mut moments, mut forces, mut mass_centre] = [const { Vec::new() }; 5];
        for field in Message::new(slot, offset) {
            let field = field?;
            match field.number {
                1 => field.doubles_into(&mut positions)?,
                6 => field.doubles_into(&mut centres)?,
                7 => field.doubles_into(&mut moments)?,
                8 => field.doubles_into(&mut forces)?,
                9 => field.doubles_into(&mut mass_centre)?,
                _ => {}
            }
        }
        let on_bodies = 3 * self.contacts.len();
        let positions = counted(positions, self.positions.len(), "coordinates", offset)?;
        let forces = counted(forces, on_bodies, "ground forces", offset)?;
        let centres = counted(centres, on_bodies, "centres of pressure", offset)?;
        let moments = counted(moments, on_bodies, "ground moments", offset)?;
        self.positions.iter_mut().zip(positions).for_each(|(column, value)| column.push(value));
        let on_body = triples(&forces).zip(triples(&centres)).zip(triples(&moments));
        for (contact, ((force, centre), moment)) in self.contacts.iter_mut().zip(on_body) {
            contact.force.push(force);
            contact.centre_of_pressure.push(centre);
            contact.moment.push(moment);
        }
        self.mass_centre.extend(triples(&mass_centre).take(1));
        Ok(())
    }
}
