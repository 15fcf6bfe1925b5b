// Made from crates/ambulo-report/src/page/contract.rs by its test; do not edit.

/** Version of the contract. */
export const FORMAT = 1;

export type Page = { 
/**
 * Version of this contract.
 */
format: number, 
/**
 * Version of the program.
 */
program: string, 
/**
 * Title of the page.
 */
title: string, 
/**
 * The runs: the first is the one of this folder, the others are compared with it.
 */
sessions: Array<Session>, };

export type Series = { 
/**
 * Place of the first, counted in 16-bit numbers.
 */
at: number, 
/**
 * How many.
 */
count: number, 
/**
 * The smallest value.
 */
low: number, 
/**
 * Distance of neighbouring values; 0 if all are the same.
 */
step: number, };

export type PageSide = "r" | "l";

export type Session = { 
/**
 * A short name: the name of the recording.
 */
name: string, 
/**
 * How far each walking figure of a scene came, and whether it fell; nothing for recordings.
 */
outcome: Array<string>, 
/**
 * Whether the data can be used; nothing for scenes.
 */
data: DataQuality | null, 
/**
 * Summary at the top of the page; nothing for scenes.
 */
glance: Glance | null, 
/**
 * Subject, mass, height, speed, model, filter, source of the forces, ... in the order to be shown.
 */
header: Array<Fact>, 
/**
 * Where the ground forces come from.
 */
source: PageSource, 
/**
 * The instants of all series over time.
 */
time: TimeAxis, 
/**
 * Foot strikes and foot offs.
 */
events: Array<PageEvent>, 
/**
 * The whole cycles that curves were cut into.
 */
cycles: Array<PageCycle>, 
/**
 * Grids of panels, in the order to be shown.
 */
groups: Array<Group>, 
/**
 * The state machines of a synthetic walk, parents before children; empty for recordings and scenes.
 */
machines: Array<PageMachine>, 
/**
 * Time and distance, extracted values, symmetry.
 */
tables: Array<Table>, 
/**
 * How far the numbers can be trusted.
 */
quality: Quality, 
/**
 * Whether a person could do this.
 */
feasibility: Feasibility | null, 
/**
 * The 3-D view.
 */
view: View | null, 
/**
 * Data that this page cannot show, with the reason, one sentence each.
 */
missing: Array<string>, };

export type Fact = { 
/**
 * Name: `Body mass`.
 */
label: string, 
/**
 * Value with its unit: `72.8 kg`.
 */
value: string, 
/**
 * Where it comes from: `weighed by plates`.
 */
note: string | null, };

export type PageSource = "measured" | "mixed" | "predicted" | "simulated" | "none";

export type PageVerdict = "feasible" | "infeasible" | "not_judged";

export type TimeAxis = { 
/**
 * The first.
 */
start_s: number, 
/**
 * Distance of neighbours.
 */
step_s: number, 
/**
 * How many.
 */
frames: number, };

export type PageEvent = { 
/**
 * Whose foot.
 */
side: PageSide, 
/**
 * Strike, or else foot off.
 */
strike: boolean, 
/**
 * When [s].
 */
time_s: number, };

export type PageMachine = { 
/**
 * Its name: `left knee`.
 */
name: string, 
/**
 * Names of its states, sorted.
 */
states: Array<string>, 
/**
 * Times in its states, without gaps.
 */
periods: Array<PagePeriod>, };

export type PagePeriod = { 
/**
 * Place in `states`.
 */
state: number, 
/**
 * From [s].
 */
from_s: number, 
/**
 * To [s].
 */
to_s: number, };

export type PageCycle = { 
/**
 * Whose foot.
 */
side: PageSide, 
/**
 * Number of the cycle of this foot, from 1.
 */
number: number, 
/**
 * First strike [s].
 */
start_s: number, 
/**
 * Next strike [s].
 */
end_s: number, 
/**
 * Foot off [% of the cycle].
 */
foot_off_percent: number | null, };

export type Group = { 
/**
 * A word without blanks: `kinematics`, `kinetics`, `ground`, `overlay`, `energy`, ...
 */
id: string, 
/**
 * Heading.
 */
title: string, 
/**
 * A sentence below it.
 */
note: string | null, 
/**
 * Panels abreast on a wide screen.
 */
columns: number, 
/**
 * The panels, row by row.
 */
panels: Array<Panel>, };

export type Panel = { 
/**
 * A word without blanks, unique in the page: `hip_flexion_moment`.
 */
id: string, 
/**
 * `Hip flexion`.
 */
title: string, 
/**
 * `deg`, `N.m/kg`, `W/kg`, `BW`, ...
 */
unit: string, 
/**
 * Directions of positive and negative values: `flexion`, `extension`; may be empty.
 */
positive: string, 
/**
 * The other direction.
 */
negative: string, 
/**
 * Every cycle: 101 values from 0 to 100 %.
 */
cycles: Array<CycleCurve>, 
/**
 * Mean over the cycles of a side.
 */
means: Array<MeanCurve>, 
/**
 * Normative mean and deviation at this speed.
 */
band: Band | null, 
/**
 * The same over time.
 */
traces: Array<Trace>, 
/**
 * Parts that are not feasible, over time; those of the panel's own quantity only.
 */
red: Array<RedSpan>, 
/**
 * Why there is nothing to be seen, instead of an empty box.
 */
empty: string | null, 
/**
 * What belongs to the activation of muscles; only panels of muscles have it.
 */
activity?: Activity, };

export type Activity = { 
/**
 * Envelope of the electromyogram, mean over the cycles of a side.
 */
measured: Array<MeanCurve>, 
/**
 * Times in which this electromyogram is on [% of the cycle].
 */
recorded: Array<ActiveTimes>, 
/**
 * Times in which the muscles of healthy adults are usually active [% of the cycle]; empty if unknown.
 */
usual: Array<[number, number]>, 
/**
 * Agreement of activation and electromyogram, in a sentence.
 */
agreement: string | null, };

export type ActiveTimes = { 
/**
 * Whose cycles.
 */
side: PageSide, 
/**
 * From and to [% of the cycle].
 */
times: Array<[number, number]>, };

export type CycleCurve = { 
/**
 * Whose cycle.
 */
side: PageSide, 
/**
 * Number of the cycle, as in `cycles` of the session.
 */
number: number, 
/**
 * 101 values.
 */
values: Series, 
/**
 * Where they stand in the files; nothing for a value of several columns.
 */
origin: Origin | null, };

export type MeanCurve = { 
/**
 * Whose cycles.
 */
side: PageSide, 
/**
 * How many.
 */
cycles: number, 
/**
 * 101 values.
 */
values: Series, 
/**
 * Standard deviation over the cycles, from two on.
 */
sd: Series | null, 
/**
 * Mean foot off [%].
 */
foot_off_percent: number | null, };

export type Band = { 
/**
 * Mean at even steps from 0 to 100 %.
 */
mean: Series, 
/**
 * Standard deviation there.
 */
sd: Series, 
/**
 * Source: citation, group, speed.
 */
citation: string, };

export type Trace = { 
/**
 * Name: `right`, `plates, left`, `limit`.
 */
name: string, 
/**
 * Whose side.
 */
side: PageSide | null, 
/**
 * How it is drawn.
 */
role: Role, 
/**
 * A value an instant of the session's time.
 */
values: Series, 
/**
 * Its standard deviation.
 */
sd: Series | null, 
/**
 * Times in which the ground force behind it was predicted or is unknown, while others were measured [s].
 */
predicted: Array<[number, number]>, 
/**
 * Its column in the files.
 */
origin: Origin | null, };

export type Role = "main" | "measured" | "limit";

export type Origin = { 
/**
 * Name of the file.
 */
file: string, 
/**
 * Column; of `cycles.csv` the quantity.
 */
column: string, 
/**
 * Factor from the file's unit and sign to the panel's.
 */
factor: number, };

export type Table = { 
/**
 * A word without blanks: `time_distance`, `extracted`, `markers`, `plates`, ...
 */
id: string, 
/**
 * Heading.
 */
title: string, 
/**
 * A sentence below it: what the normal ranges are of, and their source.
 */
note: string | null, 
/**
 * Heads of the columns, with units.
 */
columns: Array<string>, 
/**
 * The rows; the first cell is the row's name.
 */
rows: Array<Array<Cell>>, 
/**
 * Why there are no rows.
 */
empty: string | null, };

export type Cell = { 
/**
 * As shown, rounded.
 */
text: string, 
/**
 * The number behind it, unrounded.
 */
value: number | null, 
/**
 * Outside of what is normal or allowed.
 */
outside: boolean, };

export type Quality = { 
/**
 * Residual, marker error, agreement with plates, ... one line each.
 */
facts: Array<Judged>, 
/**
 * Residual, friction, plates against prediction, ... over time.
 */
groups: Array<Group>, 
/**
 * Marker errors, plates and feet, agreement by component, changes made, ...
 */
tables: Array<Table>, 
/**
 * Warnings and notes.
 */
findings: Array<PageFinding>, 
/**
 * Assumptions, in sentences.
 */
assumptions: Array<string>, };

export type Judged = { 
/**
 * Name.
 */
label: string, 
/**
 * Value with its unit.
 */
value: string, 
/**
 * Allowed values, in words.
 */
allowed: string | null, 
/**
 * Whether it is so; nothing if unknown.
 */
good: boolean | null, };

export type PageFinding = { 
/**
 * `ground.predicted`.
 */
code: string, 
/**
 * `note` or `warning`.
 */
severity: string, 
/**
 * The remark.
 */
message: string, 
/**
 * How often.
 */
count: number, };

export type DataQuality = { 
/**
 * The answer.
 */
state: PageQuality, 
/**
 * The strongest reasons, a sentence each.
 */
reasons: Array<string>, };

export type Glance = { 
/**
 * Recording, person, source of the ground forces, speed, cadence, step length and asymmetry.
 */
facts: Array<Fact>, 
/**
 * The curves with the largest differences from the normative curves, one sentence each, the largest first.
 */
deviations: Array<string>, 
/**
 * The reference group, or why there is no comparison.
 */
norm: string, };

export type PageQuality = "good" | "doubtful" | "bad";

export type Feasibility = { 
/**
 * The verdict.
 */
state: PageVerdict, 
/**
 * The verdict in a sentence.
 */
sentence: string, 
/**
 * Reasons why the motion is infeasible.
 */
red: Array<RedSpan>, 
/**
 * How near to its limit every kind of check comes.
 */
closest: Table, };

export type RedSpan = { 
/**
 * From [s].
 */
from_s: number, 
/**
 * To [s].
 */
to_s: number, 
/**
 * Whose side.
 */
side: PageSide | null, 
/**
 * `strength`, `friction`, ...
 */
check: string, 
/**
 * Why, in a sentence with value, limit and unit.
 */
sentence: string, 
/**
 * The panel that shows it.
 */
panel: string | null, };

export type View = { 
/**
 * The bodies that move.
 */
bodies: Array<ViewBody>, 
/**
 * Fixed obstacles of a scene, in world axes.
 */
fixed: Array<ViewShape>, 
/**
 * Force plates.
 */
plates: Array<ViewPlate>, 
/**
 * Forces of the ground on the feet, with their points.
 */
forces: Array<ViewForce>, 
/**
 * Joint moments.
 */
torques: Array<ViewTorque>, 
/**
 * Points of the soles.
 */
contacts: Array<ViewContact>, 
/**
 * Muscles, if the run computed them.
 */
muscles?: Array<ViewMuscle>, 
/**
 * Height of the floor [m]; a grid is drawn there.
 */
floor_m: number, 
/**
 * Weight of the figure [N], for the length of the arrows.
 */
weight_n: number, };

export type ViewBody = { 
/**
 * Name in the model.
 */
name: string, 
/**
 * Whose side.
 */
side: PageSide | null, 
/**
 * Shapes in the body's axes.
 */
shapes: Array<ViewShape>, 
/**
 * Its path in the recorded motion, if the motion was changed.
 */
recorded?: ViewPath, 
/**
 * Origin of the body in the world [m]: x, y, z.
 */
position: [Series, Series, Series], 
/**
 * Orientation, world from body: x, y, z, w of a unit quaternion without jumps of sign.
 */
rotation: [Series, Series, Series, Series], };

export type ViewShape = { "kind": "capsule", 
/**
 * One end.
 */
from: [number, number, number], 
/**
 * The other.
 */
to: [number, number, number], 
/**
 * Radius.
 */
radius: number, } | { "kind": "box", 
/**
 * Its middle.
 */
center: [number, number, number], 
/**
 * Half of its lengths along its own axes.
 */
half: [number, number, number], 
/**
 * Its axes: x, y, z, w of a quaternion.
 */
turn: [number, number, number, number], } | { "kind": "mesh", 
/**
 * Corners.
 */
points: Array<[number, number, number]>, 
/**
 * Numbers of the corners.
 */
triangles: Array<[number, number, number]>, };

export type ViewPlate = { 
/**
 * Its name.
 */
name: string, 
/**
 * Its corners in the world [m], in turn.
 */
corners: [[number, number, number], [number, number, number], [number, number, number], [number, number, number]], };

export type ViewForce = { 
/**
 * `right`, `right, plates`.
 */
name: string, 
/**
 * Whose side.
 */
side: PageSide | null, 
/**
 * Main, or measured next to a prediction.
 */
role: Role, 
/**
 * Where it acts, world [m]; no number while it does not act.
 */
point: [Series, Series, Series], 
/**
 * The force, world [N].
 */
force: [Series, Series, Series], };

export type ViewTorque = { 
/**
 * `right knee`.
 */
name: string, 
/**
 * Whose side.
 */
side: PageSide | null, 
/**
 * Place in `bodies` of the body that it turns.
 */
body: number, 
/**
 * Centre of the joint in this body's axes [m].
 */
center: [number, number, number], 
/**
 * Axis in this body's axes, a unit vector.
 */
axis: [number, number, number], 
/**
 * The moment [N.m/kg], in the clinical sign of its panel.
 */
values: Series, 
/**
 * The panel that shows it.
 */
panel: string | null, };

export type ViewContact = { 
/**
 * Place in `bodies`.
 */
body: number, 
/**
 * In this body's axes [m].
 */
place: [number, number, number], 
/**
 * Whose side.
 */
side: PageSide | null, };

export type ViewMuscle = { 
/**
 * Its name in the model: `soleus_r`.
 */
name: string, 
/**
 * Whose side.
 */
side: PageSide | null, 
/**
 * Points of its path from origin to insertion.
 */
points: Array<ViewPathPoint>, 
/**
 * Its activation, 0 to 1.
 */
activation: Series, };

export type ViewPath = { 
/**
 * Origin of the body in the world [m]: x, y, z.
 */
position: [Series, Series, Series], 
/**
 * Orientation, world from body: x, y, z, w of a unit quaternion without jumps of sign.
 */
rotation: [Series, Series, Series, Series], };

export type ViewPathPoint = { 
/**
 * Place in `bodies`.
 */
body: number, 
/**
 * In this body's axes [m].
 */
place: [number, number, number], };

export type LivePage = { 
/**
 * Frame rate [Hz].
 */
rate_hz: number, 
/**
 * Time from a frame to its results [ms].
 */
delay_ms: number, 
/**
 * Ground forces on the feet, in the order of `forces` of the view.
 */
forces: Array<LiveForce>, 
/**
 * Curves of the last seconds.
 */
panels: Array<LivePanel>, };

export type LiveForce = { 
/**
 * The force, world [N]: x, y, z.
 */
force: [number, number, number], 
/**
 * Its centre of pressure, world [m].
 */
point: [number, number, number], };

export type LivePanel = { 
/**
 * `Knee moment`.
 */
title: string, 
/**
 * Unit of the values.
 */
unit: string, 
/**
 * A curve per side.
 */
curves: Array<LiveCurve>, };

export type LiveCurve = { 
/**
 * Whose side.
 */
side: PageSide, 
/**
 * Place of its value.
 */
column: number, 
/**
 * Place of its standard deviation.
 */
sd: number | null, };

export type LiveFrame = { 
/**
 * Its number.
 */
frame: number, 
/**
 * Its time [s].
 */
time_s: number, 
/**
 * The values of its results.
 */
values: Array<number>, 
/**
 * Position [m] and orientation of every body of the view, as there: 7 numbers each; nothing while the body is not
 * known.
 */
poses: Array<number>, 
/**
 * Frames that did not arrive so far.
 */
lost: number, };

export type LiveState = { 
/**
 * `waiting`, `running` or `ended`.
 */
state: string, 
/**
 * The same in a sentence.
 */
message: string, };
