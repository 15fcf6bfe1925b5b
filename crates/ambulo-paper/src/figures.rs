//! The figures of the paper as numbers: axes, curves and points, to be drawn and written by a report.

use super::evidence::{Evidence, MASSES, RATES_HZ};
use super::ground_force::{measured_vertical, stance};
use super::mode::Run;
use super::open_values::GAITS;
use super::paper_human::MASS;
use super::steady::{POINTS, Steady};
use ambulo_body::findings::Findings;
use ambulo_body::kinematics::{BodyMotion, Posture, body_motion};
use ambulo_body::model::Model;
use ambulo_walk::gait::{Clock, Gait, Jet, LegAngles, LegCurves, Pelvis, Style, Walk};

/// A figure of panels.
#[derive(Debug, Clone, PartialEq)]
pub struct PaperFigure {
    /// Name of its file, without ending.
    pub name: &'static str,
    /// Title.
    pub title: String,
    /// Panels from left to right.
    pub panels: Vec<PaperPanel>,
}

/// One set of axes.
#[derive(Debug, Clone, PartialEq)]
pub struct PaperPanel {
    /// Title above the axes.
    pub title: String,
    /// Quantity and unit of the abscissa.
    pub x_label: &'static str,
    /// Quantity and unit of the ordinate.
    pub y_label: &'static str,
    /// Whether a unit has the same length along both axes.
    pub to_scale: bool,
    /// Curves and points.
    pub series: Vec<PaperSeries>,
}

/// One curve, or a set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct PaperSeries {
    /// Name; a series without a name is not in the legend.
    pub name: String,
    /// How it is drawn.
    pub kind: SeriesKind,
    /// Abscissa and ordinate.
    pub points: Vec<[f64; 2]>,
}

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeriesKind {
    /// A line with its own colour.
    Line,
    /// A thin grey line.
    Faint,
    /// Points.
    Dots,
}

/// The walks that figures are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureSet {
    /// Figures of the paper: files `figure3` to `figure7`.
    Paper,
    /// Corrected figures: files `corrected_figure3` to `corrected_figure7`.
    Corrected,
}

impl FigureSet {
    /// The mode in words, as in legends.
    fn words(self) -> &'static str {
        match self {
            FigureSet::Paper => "paper's mode",
            FigureSet::Corrected => "corrected",
        }
    }

    fn named(self, of_paper: &'static str, corrected: &'static str) -> &'static str {
        match self {
            FigureSet::Paper => of_paper,
            FigureSet::Corrected => corrected,
        }
    }
}

/// Figures 3 to 7 with the walks of one mode.
#[must_use]
pub fn paper_figures(set: FigureSet, evidence: &Evidence) -> Vec<PaperFigure> {
    vec![
        snapshots_figure(set, evidence),
        torques(set, evidence),
        vertical(set, evidence),
        masses(set, evidence),
        four_gaits(set, evidence),
    ]
}

/// Figure 1: joint angles over a cycle of the standard gait; `report::gait_figure` adds the sub-cycles.
#[must_use]
pub fn angular_laws() -> Option<PaperFigure> {
    let gait = Gait::named("standard").ok()?;
    let walk = Walk::new(&gait, REFERENCE_LEG, &mut Findings::default()).ok()?;
    let curve = |name: &str, angle: fn(&LegAngles) -> Jet| line(name, leg_curve(&walk, angle));
    let series = vec![curve("hip", |leg| leg.hip), curve("knee", |leg| leg.knee), curve("ankle", |leg| leg.ankle)];
    let panel = cycle_panel("right leg".into(), "flexion, dorsiflexion (deg)", series);
    Some(PaperFigure { name: "figure1", title: "Angular laws of the limbs".into(), panels: vec![panel] })
}

fn line(name: impl Into<String>, points: Vec<[f64; 2]>) -> PaperSeries {
    PaperSeries { name: name.into(), kind: SeriesKind::Line, points }
}

fn of_cycle(values: &[f64]) -> Vec<[f64; 2]> {
    values.iter().enumerate().map(|(percent, y)| [percent as f64, *y]).collect()
}

fn cycle_panel(title: String, y_label: &'static str, series: Vec<PaperSeries>) -> PaperPanel {
    PaperPanel { title, x_label: "gait cycle (%)", y_label, to_scale: false, series }
}

/// Figure 2: the knee angle by the quintics of the paper, their bounds, and the measured curve that the bounds are
/// from.
#[must_use]
pub fn quintics() -> PaperFigure {
    let (mut series, mut findings) = (Vec::new(), Findings::default());
    let standard = Gait::named("standard");
    for (style, name) in
        [(Style::Paper1997, "paper's quintics"), (Style::Knots, "measured, knots with velocity and acceleration")]
    {
        let Ok(gait) = &standard else { break };
        let gait = Gait { style, pelvis: Pelvis::Vertical, ..gait.clone() };
        let Ok(walk) = Walk::new(&gait, REFERENCE_LEG, &mut findings) else { continue };
        series.push(line(name, leg_curve(&walk, |leg| leg.knee)));
        if style == Style::Paper1997 {
            series.push(PaperSeries {
                name: "bounds of the sub-cycles".into(),
                kind: SeriesKind::Dots,
                points: knots(walk.legs(), walk.curve_speed(&walk.clock(0.0)).value),
            });
        }
    }
    let panel = cycle_panel("knee, standard gait".into(), "flexion (deg)", series);
    PaperFigure {
        name: "figure2",
        title: "Approximation of the knee angle by polynomials of degree 5".into(),
        panels: vec![panel],
    }
}

/// Leg length of the paper's figure [m].
pub(super) const REFERENCE_LEG: f64 = 0.954;

fn leg_curve(walk: &Walk, angle: fn(&LegAngles) -> Jet) -> Vec<[f64; 2]> {
    let law_speed = walk.clock(0.0).law_speed;
    let at = |point: usize| {
        let phase = point as f64 / (4 * (POINTS - 1)) as f64;
        angle(&walk.posture(&Clock::steady(Jet::new(phase, 1.0, 0.0), law_speed)).right).value.to_degrees()
    };
    (0..=4 * (POINTS - 1)).map(|point| [0.25 * point as f64, at(point)]).collect()
}

fn knots(legs: &LegCurves, speed: f64) -> Vec<[f64; 2]> {
    let place = |knot: &ambulo_walk::gait::Knot| {
        [100.0 * knot.phase.at(speed).rem_euclid(1.0), knot.angle.at(speed).to_degrees()]
    };
    legs.knee.knots().iter().map(place).collect()
}

/// Figure 3: snapshots of a step.
fn snapshots_figure(set: FigureSet, evidence: &Evidence) -> PaperFigure {
    let panel = PaperPanel {
        title: set.words().to_owned(),
        x_label: "forward position (m), 0.55 m added between instants",
        y_label: "height (m)",
        to_scale: true,
        series: snapshots(evidence.standard()),
    };
    PaperFigure {
        name: set.named("figure3", "corrected_figure3"),
        title: "Snapshots of the motion during a step, standard gait".into(),
        panels: vec![panel],
    }
}

/// Instants of a step, from the strike of the right foot to the strike of the left foot.
const INSTANTS: usize = 7;
/// Lines between markers of the figure: trunk and head, legs with feet, arms; the left side is drawn thin.
pub(super) const STICKS: [(&[&str], SeriesKind); 5] = [
    (&["sacrum", "neck", "vertex"], SeriesKind::Line),
    (&["hip_l", "knee_l", "ankle_l", "heel_l", "toe_l", "ankle_l"], SeriesKind::Faint),
    (&["shoulder_l", "elbow_l", "wrist_l"], SeriesKind::Faint),
    (&["hip_r", "knee_r", "ankle_r", "heel_r", "toe_r", "ankle_r"], SeriesKind::Line),
    (&["shoulder_r", "elbow_r", "wrist_r"], SeriesKind::Line),
];
/// Distance that is added between the drawn instants [m].
const APART_M: f64 = 0.55;

/// The figure at instants of a step of the first steady cycle, next to each other.
pub(super) fn snapshots(run: &Run) -> Vec<PaperSeries> {
    let Ok(steady) = Steady::of(run) else { return Vec::new() };
    let (recording, mut series) = (&run.recording, Vec::new());
    let rows = steady.rows();
    let half = (0.5 * run.cycle_s / recording.grid().step_s) as usize;
    let mut start = f64::NAN;
    for instant in 0..INSTANTS {
        let row = rows.start + half * instant / (INSTANTS - 1);
        let motions = at_row(run, row);
        let root = motions[0].pose.translation.x;
        start = if start.is_nan() { root } else { start };
        let shift = APART_M * instant as f64 - start;
        for (names, kind) in STICKS {
            let points: Vec<[f64; 2]> = names
                .iter()
                .filter_map(|name| place(&recording.model, &motions, name))
                .map(|[x, y]| [x + shift, y])
                .collect();
            series.push(PaperSeries { name: String::new(), kind, points });
        }
    }
    series
}

pub(super) fn at_row(run: &Run, row: usize) -> Vec<BodyMotion> {
    let (model, trajectory) = (&run.recording.model, &run.recording.trajectory);
    let q: Vec<f64> = model.coordinate_ids().map(|id| trajectory.values(id)[row]).collect();
    let still = vec![0.0; q.len()];
    body_motion(model, Posture { q: &q, qd: &still, qdd: &still })
}

pub(super) fn place(model: &Model, motions: &[BodyMotion], name: &str) -> Option<[f64; 2]> {
    let marker = model.markers().iter().find(|marker| marker.name == name)?;
    let at = motions[marker.body?.index()].pose.place(marker.location);
    Some([at.x, at.y])
}

/// Figure 4: torques over a cycle at the paper's 30 Hz and at the finest rate.
fn torques(set: FigureSet, evidence: &Evidence) -> PaperFigure {
    let joints = [
        ("hip (flexion +)", "hip_flexion_r"),
        ("knee (extension +)", "knee_angle_r"),
        ("ankle (dorsiflexion +)", "ankle_angle_r"),
    ];
    let panels = joints.map(|(title, coordinate)| {
        let last = RATES_HZ.len() - 1;
        let of = |(run, rate): (&Run, f64)| line(format!("{}, {rate:.0} Hz", set.words()), torque(run, coordinate));
        let both = [0, last].into_iter().filter_map(|k| evidence.rates.get(k).zip(RATES_HZ.get(k).copied()));
        cycle_panel(title.into(), "torque (N.m)", both.map(of).collect())
    });
    PaperFigure {
        name: set.named("figure4", "corrected_figure4"),
        title: "Torques at hip, knee and ankle over a cycle, standard gait, without impacts".into(),
        panels: panels.into(),
    }
}

/// The mean cycle of a torque.
fn torque(run: &Run, coordinate: &str) -> Vec<[f64; 2]> {
    Steady::of(run).map_or_else(|_| Vec::new(), |steady| of_cycle(&steady.mean_cycle(&steady.effort(coordinate))))
}

/// Figure 5: the vertical force during stance, measured and computed.
fn vertical(set: FigureSet, evidence: &Evidence) -> PaperFigure {
    let weight = MASS * ambulo_walk::gait::GRAVITY;
    let stances = |scale: f64, of: &dyn Fn(f64) -> f64| {
        (0..POINTS)
            .map(|point| [point as f64, scale * of(point as f64 / (POINTS - 1) as f64)])
            .collect::<Vec<[f64; 2]>>()
    };
    let band = |sign: f64| PaperSeries {
        name: String::new(),
        kind: SeriesKind::Faint,
        points: stances(weight, &|at| {
            let [mean, deviation] = measured_vertical(at);
            (mean + sign * deviation).max(0.0)
        }),
    };
    let measured =
        line("children (Schwartz 2008), scaled; thin: ± SD", stances(weight, &|at| measured_vertical(at)[0]));
    let panel = |title: &str, series| PaperPanel {
        title: title.to_owned(),
        x_label: "stance (%)",
        y_label: "vertical force (N)",
        to_scale: false,
        series,
    };
    let faint = PaperSeries { name: "measured".into(), kind: SeriesKind::Faint, points: measured.points.clone() };
    let at_percent = |curve: &[f64], at: f64| curve[(at * (POINTS - 1) as f64).round() as usize];
    let computed =
        stance(evidence.standard()).map(|(curve, _)| line(set.words(), stances(weight, &|at| at_percent(&curve, at))));
    PaperFigure {
        name: set.named("figure5", "corrected_figure5"),
        title: "Action on the ground during stance: measured (a) and computed (b), 80 kg".into(),
        panels: vec![
            panel("(a) measured", vec![measured, band(1.0), band(-1.0)]),
            panel("(b) computed", computed.into_iter().chain([faint]).collect()),
        ],
    }
}

/// Figure 6: the hip torque for three masses.
fn masses(set: FigureSet, evidence: &Evidence) -> PaperFigure {
    let of = |(run, mass): (&Run, f64)| line(format!("{mass:.0} kg"), torque(run, "hip_flexion_r"));
    let series = evidence.masses.iter().zip(MASSES).map(of).collect();
    PaperFigure {
        name: set.named("figure6", "corrected_figure6"),
        title: "Influence of the mass of the figure on the hip torque".into(),
        panels: vec![cycle_panel(set.words().to_owned(), "hip torque (N.m), flexion +", series)],
    }
}

/// Figure 7: the knee torque in four gaits, each over its own cycle.
fn four_gaits(set: FigureSet, evidence: &Evidence) -> PaperFigure {
    let of = |(run, gait): (&Run, &str)| line(gait, torque(run, "knee_angle_r"));
    let series = evidence.gaits.iter().zip(GAITS).map(of).collect();
    PaperFigure {
        name: set.named("figure7", "corrected_figure7"),
        title: "Comparison of gaits: the knee torque after time scaling".into(),
        panels: vec![cycle_panel(set.words().to_owned(), "knee torque (N.m), extension +", series)],
    }
}
