//! Reads the channels of EMG from C3D files and tables.
//!
//! A channel whose name is not that of a muscle is judged by its description. Channels of force platforms are left out;
//! all others without a known name are listed. A channel can be assigned to a muscle by the caller.
//!
//! Pinned by: tests/emg_recordings.rs

use super::{AnatomicalMuscle, EmgError};
use ambulo_body::findings::Findings;
use ambulo_body::model::Side;
use ambulo_body::motion::{TimeGrid, clock_of_table};
use ambulo_formats::c3d::C3d;
use ambulo_formats::table::Table;

/// EMG of one trial as recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct EmgRecording {
    /// Times of the samples.
    pub grid: TimeGrid,
    /// Channels of known muscles, in the order of the file.
    pub channels: Vec<EmgChannel>,
    /// Names of the channels that are not used: no force platform has them and their muscle is not known.
    pub unknown: Vec<String>,
}

/// One channel of EMG.
#[derive(Debug, Clone, PartialEq)]
pub struct EmgChannel {
    /// Name in the file.
    pub name: String,
    /// Unit in the file; empty if it has none.
    pub unit: String,
    /// The muscle.
    pub muscle: AnatomicalMuscle,
    /// Its side; `None` if the file does not state it.
    pub side: Option<Side>,
    /// The samples in that unit; not-a-number where the file has none.
    pub samples: Vec<f64>,
}

/// EMG of a C3D file. `assigned` has names of channels and the muscles that they record (`EMG1`, `soleus_r`); they
/// replace what the name says. Without any channel of a known muscle, the list of channels is empty.
///
/// # Errors
/// An assigned channel that the file does not have, an assigned muscle without a known name.
pub fn emg_from_c3d(c3d: &C3d, assigned: &[(String, String)]) -> Result<EmgRecording, EmgError> {
    let platforms: Vec<usize> =
        c3d.each_platform().into_iter().flatten().flat_map(|platform| platform.channels).flatten().collect();
    let candidates = c3d.channels.iter().enumerate().filter(|(index, _)| !platforms.contains(index));
    let candidates = candidates.map(|(_, channel)| Candidate {
        name: &channel.name,
        description: &channel.description,
        unit: &channel.unit,
        samples: &channel.samples,
    });
    let samples = c3d.channels.first().map_or(0, |channel| channel.samples.len());
    let start_s = c3d.analog_times().first().copied().unwrap_or(0.0);
    let step_s = if c3d.analog_rate_hz > 0.0 { 1.0 / c3d.analog_rate_hz } else { 1.0 };
    recording(candidates.collect(), TimeGrid { start_s, step_s, frames: samples }, assigned)
}

/// EMG of a table: `.sto`, `.mot` or CSV, a column per muscle. `assigned` as in [`emg_from_c3d`]. Times in another unit
/// than seconds are a finding.
///
/// # Errors
/// No times, times that are not uniform, no column of a known muscle, and as [`emg_from_c3d`].
pub fn emg_from_table(
    table: &Table,
    assigned: &[(String, String)],
    findings: &mut Findings,
) -> Result<EmgRecording, EmgError> {
    let times = table.times().ok_or_else(|| EmgError::Times {
        found: format!("the first column is `{}`", table.names().first().map_or("", String::as_str)),
    })?;
    let times = clock_of_table(&table.name, times, None, None, findings);
    let grid = TimeGrid::through(&times).ok_or_else(|| EmgError::Times { found: irregular(&times) })?;
    let candidates =
        table.columns().skip(1).map(|(name, samples)| Candidate { name, description: "", unit: "", samples });
    let recording = recording(candidates.collect(), grid, assigned)?;
    if recording.channels.is_empty() {
        return Err(EmgError::NoMuscle { found: listed(recording.unknown.iter().map(String::as_str)) });
    }
    Ok(recording)
}

/// A channel whose muscle is not known yet.
struct Candidate<'c> {
    name: &'c str,
    description: &'c str,
    unit: &'c str,
    samples: &'c [f64],
}

fn recording(
    candidates: Vec<Candidate<'_>>,
    grid: TimeGrid,
    assigned: &[(String, String)],
) -> Result<EmgRecording, EmgError> {
    let missing = assigned.iter().find(|(channel, _)| candidates.iter().all(|candidate| candidate.name != channel));
    if let Some((channel, _)) = missing {
        let known = listed(candidates.iter().map(|candidate| candidate.name));
        return Err(EmgError::NoChannel { channel: channel.clone(), known });
    }
    let mut recording = EmgRecording { grid, channels: Vec::new(), unknown: Vec::new() };
    for candidate in candidates {
        let assigned = assigned.iter().find(|(channel, _)| channel == candidate.name);
        let known = match assigned {
            Some((channel, muscle)) => Some(
                AnatomicalMuscle::of_name(muscle)
                    .ok_or_else(|| EmgError::UnknownMuscle { channel: channel.clone(), muscle: muscle.clone() })?,
            ),
            None => {
                AnatomicalMuscle::of_name(candidate.name).or_else(|| AnatomicalMuscle::of_name(candidate.description))
            }
        };
        let Some((muscle, side)) = known else {
            recording.unknown.push(candidate.name.to_owned());
            continue;
        };
        recording.channels.push(EmgChannel {
            name: candidate.name.to_owned(),
            unit: candidate.unit.to_owned(),
            muscle,
            side,
            samples: candidate.samples.to_vec(),
        });
    }
    Ok(recording)
}

/// What is wrong with times that are not uniform.
fn irregular(times: &[f64]) -> String {
    let Some(spanning) = TimeGrid::spanning(times) else {
        return format!("found {} times that do not increase", times.len());
    };
    let off = |i: usize| (times[i] - spanning.time(i)).abs();
    let worst = (0..times.len()).max_by(|&a, &b| off(a).total_cmp(&off(b))).unwrap_or(0);
    format!("row {} has {} s where a constant step gives {:.6} s", worst + 1, times[worst], spanning.time(worst))
}

/// Names in a message.
fn listed<'n>(names: impl Iterator<Item = &'n str>) -> String {
    const SHOWN: usize = 20;
    let names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    match names.len() {
        0 => "no channels".to_owned(),
        count if count > SHOWN => format!("{} and {} others", names[..SHOWN].join(", "), count - SHOWN),
        _ => names.join(", "),
    }
}
