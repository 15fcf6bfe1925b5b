//! The content of a report page: the contract between this crate and `viewer/`.
//!
//! The viewer draws and never computes: these types contain curves, means, tables and sentences as displayed, with
//! their units and in clinical signs. `viewer/src/contract.ts` is made from them, including the doc comments
//! (`typescript.rs`, tests/page_contract.rs).
//!
//! World: x forward, y up, z to the right, metres. Times are seconds of the recording.

use ambulo::analysis::feasibility::VerdictState;
use serde::{Deserialize, Serialize};

/// Version of the contract; a bundle refuses a page of another one.
pub(super) const FORMAT: u32 = 1;

/// A whole page.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Page {
    /// Version of this contract.
    pub format: u32,
    /// Version of the program.
    pub program: String,
    /// Title of the page.
    pub title: String,
    /// The runs: the first is the one of this folder, the others are compared with it.
    pub sessions: Vec<Session>,
}

/// Numbers in the page's block: `count` of them from number `at` on; `low + step q` for the 16-bit number q, and none
/// where q is 65535.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Series {
    /// Place of the first, counted in 16-bit numbers.
    pub at: usize,
    /// How many.
    pub count: usize,
    /// The smallest value.
    pub low: f64,
    /// Distance of neighbouring values; 0 if all are the same.
    pub step: f64,
}

/// A side of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "contract", derive(ts_rs::TS), ts(rename_all = "lowercase"))]
pub(crate) enum PageSide {
    /// Right: blue, solid lines.
    R,
    /// Left: vermilion, dashed lines.
    L,
}

/// One run of the program: the files of one folder.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Session {
    /// A short name: the name of the recording.
    pub name: String,
    /// How far each walking figure of a scene came, and whether it fell; nothing for recordings.
    pub(crate) outcome: Vec<String>,
    /// Whether the data can be used; nothing for scenes.
    pub(crate) data: Option<DataQuality>,
    /// Summary at the top of the page; nothing for scenes.
    pub(crate) glance: Option<Glance>,
    /// Subject, mass, height, speed, model, filter, source of the forces, ... in the order to be shown.
    pub(crate) header: Vec<Fact>,
    /// Where the ground forces come from.
    pub(crate) source: PageSource,
    /// The instants of all series over time.
    pub(crate) time: TimeAxis,
    /// Foot strikes and foot offs.
    pub(crate) events: Vec<PageEvent>,
    /// The whole cycles that curves were cut into.
    pub(crate) cycles: Vec<PageCycle>,
    /// Grids of panels, in the order to be shown.
    pub groups: Vec<Group>,
    /// The state machines of a synthetic walk, parents before children; empty for recordings and scenes.
    pub(crate) machines: Vec<PageMachine>,
    /// Time and distance, extracted values, symmetry.
    pub tables: Vec<Table>,
    /// How far the numbers can be trusted.
    pub quality: Quality,
    /// Whether a person could do this.
    pub feasibility: Option<Feasibility>,
    /// The 3-D view.
    pub view: Option<View>,
    /// Data that this page cannot show, with the reason, one sentence each.
    pub missing: Vec<String>,
}

/// Whether recording, body and forces fit together.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct DataQuality {
    /// The answer.
    pub state: PageQuality,
    /// The strongest reasons, a sentence each.
    pub reasons: Vec<String>,
}

/// A recording or walk at a glance.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct Glance {
    /// Recording, person, source of the ground forces, speed, cadence, step length and asymmetry.
    pub facts: Vec<Fact>,
    /// The curves with the largest differences from the normative curves, one sentence each, the largest first.
    pub deviations: Vec<String>,
    /// The reference group, or why there is no comparison.
    pub norm: String,
}

/// The three states of data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "contract", derive(ts_rs::TS), ts(rename_all = "lowercase"))]
pub(crate) enum PageQuality {
    /// No measure is beyond its limit.
    Good,
    /// Results may be wrong in parts.
    Doubtful,
    /// Results should not be used.
    Bad,
}

/// A line of the header.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct Fact {
    /// Name: `Body mass`.
    pub label: String,
    /// Value with its unit: `72.8 kg`.
    pub value: String,
    /// Where it comes from: `weighed by plates`.
    pub note: Option<String>,
}

/// How ground forces came about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "contract", derive(ts_rs::TS), ts(rename_all = "lowercase"))]
pub(crate) enum PageSource {
    /// By force plates.
    Measured,
    /// By force plates, and from the motion where a foot was beside them.
    Mixed,
    /// From the motion.
    Predicted,
    /// By a simulation.
    Simulated,
    /// There are none.
    None,
}

/// Evenly spaced instants [s].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct TimeAxis {
    /// The first.
    pub start_s: f64,
    /// Distance of neighbours.
    pub step_s: f64,
    /// How many.
    pub frames: usize,
}

/// A foot strike or foot off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct PageEvent {
    /// Whose foot.
    pub side: PageSide,
    /// Strike, or else foot off.
    pub strike: bool,
    /// When [s].
    pub time_s: f64,
}

/// A state machine and its states over time.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct PageMachine {
    /// Its name: `left knee`.
    pub name: String,
    /// Names of its states, sorted.
    pub states: Vec<String>,
    /// Times in its states, without gaps.
    pub periods: Vec<PagePeriod>,
}

/// A period of time in which a machine is in one state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct PagePeriod {
    /// Place in `states`.
    pub state: usize,
    /// From [s].
    pub from_s: f64,
    /// To [s].
    pub to_s: f64,
}

/// A gait cycle: strike to next strike of the same foot.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct PageCycle {
    /// Whose foot.
    pub side: PageSide,
    /// Number of the cycle of this foot, from 1.
    pub number: usize,
    /// First strike [s].
    pub start_s: f64,
    /// Next strike [s].
    pub end_s: f64,
    /// Foot off [% of the cycle].
    pub foot_off_percent: Option<f64>,
}

/// A grid of panels under one heading.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Group {
    /// A word without blanks: `kinematics`, `kinetics`, `ground`, `overlay`, `energy`, ...
    pub id: String,
    /// Heading.
    pub title: String,
    /// A sentence below it.
    pub note: Option<String>,
    /// Panels abreast on a wide screen.
    pub columns: usize,
    /// The panels, row by row.
    pub panels: Vec<Panel>,
}

/// One diagram: over the gait cycle where there are cycles, and over time.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Panel {
    /// A word without blanks, unique in the page: `hip_flexion_moment`.
    pub id: String,
    /// `Hip flexion`.
    pub title: String,
    /// `deg`, `N.m/kg`, `W/kg`, `BW`, ...
    pub unit: String,
    /// Directions of positive and negative values: `flexion`, `extension`; may be empty.
    pub positive: String,
    /// The other direction.
    pub negative: String,
    /// Every cycle: 101 values from 0 to 100 %.
    pub(crate) cycles: Vec<CycleCurve>,
    /// Mean over the cycles of a side.
    pub(crate) means: Vec<MeanCurve>,
    /// Normative mean and deviation at this speed.
    pub band: Option<Band>,
    /// The same over time.
    pub(crate) traces: Vec<Trace>,
    /// Parts that are not feasible, over time; those of the panel's own quantity only.
    pub(crate) red: Vec<RedSpan>,
    /// Why there is nothing to be seen, instead of an empty box.
    pub empty: Option<String>,
    /// What belongs to the activation of muscles; only panels of muscles have it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "contract", ts(optional))]
    pub(crate) activity: Option<Activity>,
}

/// What is known of the activity of muscles besides their computed activation.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct Activity {
    /// Envelope of the electromyogram, mean over the cycles of a side.
    pub measured: Vec<MeanCurve>,
    /// Times in which this electromyogram is on [% of the cycle].
    pub recorded: Vec<ActiveTimes>,
    /// Times in which the muscles of healthy adults are usually active [% of the cycle]; empty if unknown.
    pub usual: Vec<[f64; 2]>,
    /// Agreement of activation and electromyogram, in a sentence.
    pub agreement: Option<String>,
}

/// A curve of one cycle.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct CycleCurve {
    /// Whose cycle.
    pub side: PageSide,
    /// Number of the cycle, as in `cycles` of the session.
    pub number: usize,
    /// 101 values.
    pub values: Series,
    /// Where they stand in the files; nothing for a value of several columns.
    pub origin: Option<Origin>,
}

/// The mean over the cycles of a side.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct MeanCurve {
    /// Whose cycles.
    pub side: PageSide,
    /// How many.
    pub cycles: usize,
    /// 101 values.
    pub values: Series,
    /// Standard deviation over the cycles, from two on.
    pub sd: Option<Series>,
    /// Mean foot off [%].
    pub foot_off_percent: Option<f64>,
}

/// When the muscles of one leg are on.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct ActiveTimes {
    /// Whose cycles.
    pub side: PageSide,
    /// From and to [% of the cycle].
    pub times: Vec<[f64; 2]>,
}

/// Normative band at this speed.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Band {
    /// Mean at even steps from 0 to 100 %.
    pub mean: Series,
    /// Standard deviation there.
    pub sd: Series,
    /// Source: citation, group, speed.
    pub citation: String,
}

/// A series over time.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct Trace {
    /// Name: `right`, `plates, left`, `limit`.
    pub name: String,
    /// Whose side.
    pub side: Option<PageSide>,
    /// How it is drawn.
    pub role: Role,
    /// A value an instant of the session's time.
    pub values: Series,
    /// Its standard deviation.
    pub sd: Option<Series>,
    /// Times in which the ground force behind it was predicted or is unknown, while others were measured [s].
    pub predicted: Vec<[f64; 2]>,
    /// Its column in the files.
    pub origin: Option<Origin>,
}

/// Role of a series in its panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "contract", derive(ts_rs::TS), ts(rename_all = "lowercase"))]
pub(crate) enum Role {
    /// Quantity of the panel.
    Main,
    /// Measured curve next to a prediction: black or white, thin.
    Measured,
    /// Limit: grey.
    Limit,
}

/// The place in the files that a series was read from: shown = `factor` times the file's number.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Origin {
    /// Name of the file.
    pub file: String,
    /// Column; of `cycles.csv` the quantity.
    pub column: String,
    /// Factor from the file's unit and sign to the panel's.
    pub factor: f64,
}

/// A table.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Table {
    /// A word without blanks: `time_distance`, `extracted`, `markers`, `plates`, ...
    pub id: String,
    /// Heading.
    pub title: String,
    /// A sentence below it: what the normal ranges are of, and their source.
    pub note: Option<String>,
    /// Heads of the columns, with units.
    pub columns: Vec<String>,
    /// The rows; the first cell is the row's name.
    pub rows: Vec<Vec<Cell>>,
    /// Why there are no rows.
    pub empty: Option<String>,
}

/// A cell of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Cell {
    /// As shown, rounded.
    pub text: String,
    /// The number behind it, unrounded.
    pub value: Option<f64>,
    /// Outside of what is normal or allowed.
    pub outside: bool,
}

/// How far the numbers can be trusted.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Quality {
    /// Residual, marker error, agreement with plates, ... one line each.
    pub facts: Vec<Judged>,
    /// Residual, friction, plates against prediction, ... over time.
    pub groups: Vec<Group>,
    /// Marker errors, plates and feet, agreement by component, changes made, ...
    pub tables: Vec<Table>,
    /// Warnings and notes.
    pub(crate) findings: Vec<PageFinding>,
    /// Assumptions, in sentences.
    pub assumptions: Vec<String>,
}

/// A number with what is allowed.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Judged {
    /// Name.
    pub label: String,
    /// Value with its unit.
    pub value: String,
    /// Allowed values, in words.
    pub allowed: Option<String>,
    /// Whether it is so; nothing if unknown.
    pub good: Option<bool>,
}

/// A remark of the program.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct PageFinding {
    /// `ground.predicted`.
    pub code: String,
    /// `note` or `warning`.
    pub severity: String,
    /// The remark.
    pub message: String,
    /// How often.
    pub count: usize,
}

/// The three verdicts on a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "contract", derive(ts_rs::TS), ts(rename_all = "snake_case"))]
pub(crate) enum PageVerdict {
    /// Enough of the motion was judged and no check failed.
    Feasible,
    /// A check failed.
    Infeasible,
    /// No check failed, but too little was judged.
    NotJudged,
}

impl From<VerdictState> for PageVerdict {
    fn from(state: VerdictState) -> PageVerdict {
        match state {
            VerdictState::Feasible => PageVerdict::Feasible,
            VerdictState::Infeasible => PageVerdict::Infeasible,
            VerdictState::NotJudged => PageVerdict::NotJudged,
        }
    }
}

/// Whether a person could do this.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct Feasibility {
    /// The verdict.
    pub(crate) state: PageVerdict,
    /// The verdict in a sentence.
    pub sentence: String,
    /// Reasons why the motion is infeasible.
    pub(crate) red: Vec<RedSpan>,
    /// How near to its limit every kind of check comes.
    pub closest: Table,
}

/// A time in which a motion is not feasible.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct RedSpan {
    /// From [s].
    pub from_s: f64,
    /// To [s].
    pub to_s: f64,
    /// Whose side.
    pub side: Option<PageSide>,
    /// `strength`, `friction`, ...
    pub check: String,
    /// Why, in a sentence with value, limit and unit.
    pub sentence: String,
    /// The panel that shows it.
    pub panel: Option<String>,
}

/// Content of the 3-D view.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct View {
    /// The bodies that move.
    pub(crate) bodies: Vec<ViewBody>,
    /// Fixed obstacles of a scene, in world axes.
    pub(crate) fixed: Vec<ViewShape>,
    /// Force plates.
    pub(crate) plates: Vec<ViewPlate>,
    /// Forces of the ground on the feet, with their points.
    pub(crate) forces: Vec<ViewForce>,
    /// Joint moments.
    pub(crate) torques: Vec<ViewTorque>,
    /// Points of the soles.
    pub(crate) contacts: Vec<ViewContact>,
    /// Muscles, if the run computed them.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "contract", ts(optional))]
    pub(crate) muscles: Option<Vec<ViewMuscle>>,
    /// Height of the floor [m]; a grid is drawn there.
    pub floor_m: f64,
    /// Weight of the figure [N], for the length of the arrows.
    pub weight_n: f64,
}

/// A body with its shape and its path.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct ViewBody {
    /// Name in the model.
    pub name: String,
    /// Whose side.
    pub side: Option<PageSide>,
    /// Shapes in the body's axes.
    pub shapes: Vec<ViewShape>,
    /// Its path.
    #[serde(flatten)]
    #[cfg_attr(feature = "contract", ts(flatten))]
    pub path: ViewPath,
    /// Its path in the recorded motion, if the motion was changed.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "contract", ts(optional))]
    pub recorded: Option<ViewPath>,
}

/// The pose of a body over time.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct ViewPath {
    /// Origin of the body in the world [m]: x, y, z.
    pub position: [Series; 3],
    /// Orientation, world from body: x, y, z, w of a unit quaternion without jumps of sign.
    pub rotation: [Series; 4],
}

/// A shape, lengths in metres.
#[doc(hidden)] // for tests
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
#[cfg_attr(feature = "contract", derive(ts_rs::TS), ts(tag = "kind", rename_all = "lowercase"))]
pub enum ViewShape {
    /// A cylinder with round ends; a sphere if both ends are the same.
    Capsule {
        /// One end.
        from: [f64; 3],
        /// The other.
        to: [f64; 3],
        /// Radius.
        radius: f64,
    },
    /// A box.
    Box {
        /// Its middle.
        center: [f64; 3],
        /// Half of its lengths along its own axes.
        half: [f64; 3],
        /// Its axes: x, y, z, w of a quaternion.
        turn: [f64; 4],
    },
    /// A surface of triangles: three numbers a corner, three corners a triangle.
    Mesh {
        /// Corners.
        points: Vec<[f64; 3]>,
        /// Numbers of the corners.
        triangles: Vec<[u32; 3]>,
    },
}

/// A force plate.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct ViewPlate {
    /// Its name.
    pub name: String,
    /// Its corners in the world [m], in turn.
    pub corners: [[f64; 3]; 4],
}

/// A force of the ground on a foot.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct ViewForce {
    /// `right`, `right, plates`.
    pub name: String,
    /// Whose side.
    pub side: Option<PageSide>,
    /// Main, or measured next to a prediction.
    pub role: Role,
    /// Where it acts, world [m]; no number while it does not act.
    pub point: [Series; 3],
    /// The force, world [N].
    pub force: [Series; 3],
}

/// A joint moment about an axis of a body.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct ViewTorque {
    /// `right knee`.
    pub name: String,
    /// Whose side.
    pub side: Option<PageSide>,
    /// Place in `bodies` of the body that it turns.
    pub body: usize,
    /// Centre of the joint in this body's axes [m].
    pub center: [f64; 3],
    /// Axis in this body's axes, a unit vector.
    pub axis: [f64; 3],
    /// The moment [N.m/kg], in the clinical sign of its panel.
    pub values: Series,
    /// The panel that shows it.
    pub panel: Option<String>,
}

/// A point of a sole.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct ViewContact {
    /// Place in `bodies`.
    pub body: usize,
    /// In this body's axes [m].
    pub place: [f64; 3],
    /// Whose side.
    pub side: Option<PageSide>,
}

/// A muscle: a line through points of bodies.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct ViewMuscle {
    /// Its name in the model: `soleus_r`.
    pub name: String,
    /// Whose side.
    pub side: Option<PageSide>,
    /// Points of its path from origin to insertion.
    pub points: Vec<ViewPathPoint>,
    /// Its activation, 0 to 1.
    pub activation: Series,
}

/// A point of a muscle's path.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct ViewPathPoint {
    /// Place in `bodies`.
    pub body: usize,
    /// In this body's axes [m].
    pub place: [f64; 3],
}

/// The live page of a stream; indices refer to the values of a [`LiveFrame`].
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct LivePage {
    /// Frame rate [Hz].
    pub rate_hz: f64,
    /// Time from a frame to its results [ms].
    pub delay_ms: f64,
    /// Ground forces on the feet, in the order of `forces` of the view.
    pub forces: Vec<LiveForce>,
    /// Curves of the last seconds.
    pub panels: Vec<LivePanel>,
}

/// Places of a ground force.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct LiveForce {
    /// The force, world [N]: x, y, z.
    pub force: [usize; 3],
    /// Its centre of pressure, world [m].
    pub point: [usize; 3],
}

/// A panel of the live page.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct LivePanel {
    /// `Knee moment`.
    pub title: String,
    /// Unit of the values.
    pub unit: String,
    /// A curve per side.
    pub curves: Vec<LiveCurve>,
}

/// A curve of the live page.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub(crate) struct LiveCurve {
    /// Whose side.
    pub side: PageSide,
    /// Place of its value.
    pub column: usize,
    /// Place of its standard deviation.
    pub sd: Option<usize>,
}

/// Event `frame`: a frame with its results.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct LiveFrame {
    /// Its number.
    pub frame: u64,
    /// Its time [s].
    pub time_s: f64,
    /// The values of its results.
    pub values: Vec<f32>,
    /// Position [m] and orientation of every body of the view, as there: 7 numbers each; nothing while the body is not
    /// known.
    pub poses: Vec<f32>,
    /// Frames that did not arrive so far.
    pub lost: u64,
}

/// Event `state`: what happens to the stream.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "contract", derive(ts_rs::TS))]
pub struct LiveState {
    /// `waiting`, `running` or `ended`.
    pub state: String,
    /// The same in a sentence.
    pub message: String,
}
