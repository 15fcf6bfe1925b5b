//! Writing TRC.

use super::Trc;
use std::fmt::Write;

/// Every cell is followed by a tab, the last one too: OpenSim's reader would otherwise lose an empty last cell.
pub(super) fn write(trc: &Trc) -> Vec<u8> {
    let mut out = head(trc);
    for (k, (frame, time)) in trc.frames.iter().zip(&trc.times).enumerate() {
        cell(&mut out, format_args!("{frame}"));
        cell(&mut out, format_args!("{time:?}"));
        for marker in &trc.markers {
            let position = marker.positions_m[k];
            let seen = !position.iter().any(|value| value.is_nan());
            for metres in position {
                match seen {
                    true => cell(&mut out, format_args!("{:?}", trc.unit.value_of(metres))),
                    false => out.push('\t'),
                }
            }
        }
        out.push('\n');
    }
    out.into_bytes()
}

fn head(trc: &Trc) -> String {
    let name: String = trc.name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let (rate, frames, markers) = (trc.rate_hz, trc.times.len(), trc.markers.len());
    let mut out = format!(
        "PathFileType\t4\t(X/Y/Z)\t{}\n\
         DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n\
         {rate:?}\t{rate:?}\t{frames}\t{markers}\t{}\t{rate:?}\t{}\t{frames}\nFrame#\tTime\t",
        name.trim(),
        trc.unit.symbol(),
        trc.orig_start_frame,
    );
    for marker in &trc.markers {
        cell(&mut out, format_args!("{}\t\t", marker.name));
    }
    out.push_str("\n\t\t");
    for k in 1..=markers {
        cell(&mut out, format_args!("X{k}\tY{k}\tZ{k}"));
    }
    out.push_str("\n\n");
    out
}

fn cell(out: &mut String, text: std::fmt::Arguments<'_>) {
    write!(out, "{text}\t").expect("writing to memory does not fail");
}
