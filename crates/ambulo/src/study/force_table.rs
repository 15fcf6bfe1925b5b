//! Ground forces as a table: the body and the axes of each group of columns.

use super::error::StudyError;
use super::force_columns::{LoadColumns, load_columns, with_axis_last};
use super::source::ForceTable;
use super::table_axes;
use crate::analysis::plausibility::pulls_down;
use crate::findings::{Code, Findings, and_more_times};
use crate::ground::phases::contacts_from_force;
use crate::ground::{CENTER_OF_PRESSURE_LOAD_N, FootPaths, LoadedSpan};
use crate::kinematics::Trajectory;
use crate::model::anatomy::Sole;
use crate::model::{BodyId, BySide, Model, Side};
use crate::motion::{ForceRecording, Motion, SmoothSettings, Smoother, Window, force_recordings, smooth};
use crate::spatial::{Mat3, Vec3};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::table::Table;

/// Loads on the feet, and how much of the measured load was left out.
#[derive(Default)]
pub(super) struct TableForces {
    pub(super) forces: Vec<ForceRecording>,
    /// Names of loads that carry nothing at any time.
    pub(super) idle: Vec<String>,
    /// Loaded times without a foot [s].
    pub(super) unassigned: Vec<[f64; 2]>,
    /// Total loaded time of all loads [s].
    pub(super) loaded_s: f64,
    /// Whether the table is in body weights, so that it does not weigh the person.
    pub(super) is_relative: bool,
}

/// The body on whose feet the forces act, in its motion.
pub(super) struct Walker<'a> {
    pub(super) model: &'a Model,
    pub(super) motion: &'a Motion,
    pub(super) soles: &'a BySide<Option<Sole>>,
    /// The longest time without gaps.
    pub(super) window: Window,
    /// Rotation from the axes of the markers to world axes.
    pub(super) world_from_lab: Option<&'a Mat3>,
    /// Delay of the recorded forces [s].
    pub(super) delay_s: f64,
}

impl Walker<'_> {
    /// The forces of a table on the bodies of the model.
    pub(super) fn forces_of_table(
        &self,
        ForceTable { table, loads }: &ForceTable,
        findings: &mut Findings,
    ) -> Result<TableForces, StudyError> {
        let paths = self.foot_paths();
        if let Some(stated) = loads {
            let (forces, is_relative) = self.read(stated, table, paths.as_ref(), findings)?;
            self.report_other_feet(&forces, paths.as_ref(), findings);
            return Ok(TableForces { idle: idle(&forces), forces, is_relative, ..TableForces::default() });
        }
        let renamed = with_axis_last(table);
        let (stated, table) = (table, renamed.as_ref().unwrap_or(table));
        let columns = load_columns(table);
        let unknown = || StudyError::ForceColumns { found: stated.names().iter().map(ToString::to_string).collect() };
        let feet = self.model.anatomy().feet().filter(|_| !columns.is_empty()).ok_or_else(unknown)?;
        let name = |body: BodyId| self.model.bodies()[body.index()].name.as_str();
        let of = |load: &LoadColumns| load.on_body(name(feet[load.side.unwrap_or(Side::Right)]));
        let recognised =
            ExternalLoads { name: "feet".into(), datafile: None, forces: columns.iter().map(of).collect() };
        let (forces, is_relative) = self.read(&recognised, table, paths.as_ref(), findings)?;
        let found = self.on_feet(forces, &columns, paths.as_ref(), findings).ok_or_else(unknown)?;
        self.report_other_feet(&found.forces, paths.as_ref(), findings);
        Ok(TableForces { is_relative, ..found })
    }

    /// The forces in world axes and in newtons, and whether the table has them in body weights.
    fn read(
        &self,
        loads: &ExternalLoads,
        table: &Table,
        paths: Option<&FootPaths>,
        findings: &mut Findings,
    ) -> Result<(Vec<ForceRecording>, bool), StudyError> {
        let mut forces = force_recordings(self.model, loads, table, findings).map_err(StudyError::ForceTable)?;
        if self.delay_s.abs() > 0.0 {
            forces.iter_mut().flat_map(|force| &mut force.times).for_each(|time| *time -= self.delay_s);
        }
        let weight_n = self.model.mass() * self.model.gravity().norm();
        let is_relative = match self.model.up() == Vec3::y() && forces.iter().all(is_in_world) {
            true => table_axes::in_world(&mut forces, self.world_from_lab, weight_n, paths, findings),
            false => false,
        };
        Ok((forces, is_relative))
    }

    /// Loads of a side that their names state, or else under the foot that is nearest to the centre of pressure. `None`
    /// if nothing shows the feet.
    fn on_feet(
        &self,
        forces: Vec<ForceRecording>,
        columns: &[LoadColumns],
        paths: Option<&FootPaths>,
        findings: &mut Findings,
    ) -> Option<TableForces> {
        let feet = self.model.anatomy().feet()?;
        let spans = match paths {
            Some(paths) => paths.spans(&forces),
            None => vec![Vec::new(); forces.len()],
        };
        let is_shown = spans.iter().any(|spans| !spans.is_empty());
        let (mut out, mut taken) = (TableForces { idle: idle(&forces), ..TableForces::default() }, Vec::new());
        for ((force, load), spans) in forces.into_iter().zip(columns).zip(&spans) {
            let by_name = load.side.or_else(|| usual_side(load, columns).filter(|_| !is_shown));
            let parts = match by_name {
                Some(side) => vec![(side, force)],
                None if !is_shown => return None,
                None => {
                    let unused = self.without_step(load, &force, spans, findings);
                    out.loaded_s += unused.iter().map(|[from, to]| to - from).sum::<f64>();
                    out.unassigned.extend(unused);
                    out.loaded_s += spans.iter().map(|s| s.span[1] - s.span[0]).sum::<f64>();
                    out.unassigned.extend(spans.iter().filter(|s| s.side().is_none()).map(|s| s.span));
                    divided(&force, load, spans, findings)
                }
            };
            for (side, force) in parts {
                let how = if by_name.is_some() { "" } else { " by the centre of pressure" };
                taken.push(format!("`{}...` on {}{how}", load.prefix, self.model.bodies()[feet[side].index()].name));
                out.forces.push(ForceRecording { body: feet[side], ..force });
            }
        }
        findings.report(Code::LoadsGuessed, format!("taken as ground forces: {}", taken.join(", ")));
        Some(out)
    }

    /// Reports a load that was not used because it carries no foot at any time. Returns its loaded times [s].
    fn without_step(
        &self,
        load: &LoadColumns,
        force: &ForceRecording,
        spans: &[LoadedSpan],
        findings: &mut Findings,
    ) -> Vec<[f64; 2]> {
        if !spans.is_empty() || !is_loaded(force) {
            return Vec::new();
        }
        let foot = format!("the foot of `{}...`, which was not used,", load.prefix);
        match pulls_down(&foot, &force.force, self.model.up()) {
            Some(message) => findings.report(Code::LoadsDownward, message),
            None => findings.report(
                Code::LoadsUnassigned,
                format!(
                    "`{}...` has forces, but no step in which it carries a foot; it was not used. hint: check its \
                     axes, its unit and its times",
                    load.prefix
                ),
            ),
        }
        let (Some(&first), Some(&last)) = (force.times.first(), force.times.last()) else { return Vec::new() };
        let size: Vec<f64> = force.force.iter().map(|force| force.norm()).collect();
        contacts_from_force(&force.times, &size).iter().map(|contact| contact.span(first, last)).collect()
    }

    /// The feet over time; `None` if the motion cannot be used before it is smoothed.
    fn foot_paths(&self) -> Option<FootPaths> {
        let settings = SmoothSettings { smoother: Smoother::Off, window: self.window, rate_hz: None };
        let ignored = &mut Findings::default();
        let smoothed = smooth(self.model, self.motion, settings, ignored).ok()?;
        let trajectory = Trajectory::complete(self.model, smoothed, ignored).ok()?;
        FootPaths::new(self.model, &trajectory, self.soles)
    }

    /// Reports loads that lie under the other foot than the one that they act on.
    fn report_other_feet(&self, forces: &[ForceRecording], paths: Option<&FootPaths>, findings: &mut Findings) {
        let Some(paths) = paths else { return };
        for (k, (force, spans)) in forces.iter().zip(paths.spans(forces)).enumerate() {
            let Some(stated) = self.model.anatomy().body_side(force.body) else { continue };
            let is_other = |span: &&LoadedSpan| span.side() == Some(stated.other());
            let wrong: Vec<&LoadedSpan> = spans.iter().filter(is_other).collect();
            let Some(first) = wrong.first() else { continue };
            let when = match wrong.len() == spans.len() {
                true => String::new(),
                false => format!(" from {:.3} to {:.3} s{}", first.span[0], first.span[1], and_more_times(wrong.len())),
            };
            let (name, body) = (&force.name, &self.model.bodies()[force.body.index()].name);
            let message = format!(
                "the {} load (`{name}`) lies under the {} foot{when} ({:.2} m from it, {:.2} m from the {stated} \
                 foot), but acts on `{body}`; it was used as stated. hint: correct the body, or leave out the \
                 statement, so that the centre of pressure decides",
                ordinal(k),
                stated.other(),
                first.distance_m[stated.other()],
                first.distance_m[stated],
            );
            findings.report(Code::LoadsUnderOtherFoot, message);
        }
    }
}

/// Whether a force is ever large enough for a centre of pressure.
pub(super) fn is_loaded(force: &ForceRecording) -> bool {
    force.force.iter().any(|force| force.norm() > CENTER_OF_PRESSURE_LOAD_N)
}

/// The names of loads that carry nothing at any time.
fn idle(forces: &[ForceRecording]) -> Vec<String> {
    forces.iter().filter(|force| !is_loaded(force)).map(|force| force.name.clone()).collect()
}

/// Whether a load is not in the axes of a body.
fn is_in_world(force: &ForceRecording) -> bool {
    force.force_frame.is_none() && force.point_frame.is_none()
}

fn ordinal(index: usize) -> String {
    const WORDS: [&str; 6] = ["first", "second", "third", "fourth", "fifth", "sixth"];
    WORDS.get(index).map_or_else(|| format!("{}th", index + 1), ToString::to_string)
}

/// The side by the habit of OpenSim's examples, if nothing else shows it: of two loads, one without a number or letter
/// is the right foot's.
fn usual_side(load: &LoadColumns, all: &[LoadColumns]) -> Option<Side> {
    let is_plain = |load: &LoadColumns| load.key.is_empty();
    let [first, second] = all else { return None };
    (is_plain(first) != is_plain(second)).then(|| if is_plain(load) { Side::Right } else { Side::Left })
}

/// The load of each foot. The signal between two loaded times belongs to the nearer one.
fn divided(
    force: &ForceRecording,
    load: &LoadColumns,
    spans: &[LoadedSpan],
    findings: &mut Findings,
) -> Vec<(Side, ForceRecording)> {
    report_other_heights(load, spans, findings);
    for LoadedSpan { span: [from, to], distance_m: BySide { right, left }, .. } in
        spans.iter().filter(|s| s.side().is_none())
    {
        let message = format!(
            "`{}...`, {from:.3}-{to:.3} s: its load was not assigned to a foot: no foot is near its centre of pressure \
             (right {:.0} mm, left {:.0} mm)",
            load.prefix,
            1000.0 * right,
            1000.0 * left
        );
        findings.report(Code::LoadsUnassigned, message);
    }
    let nearest = |t: f64| {
        let apart = |span: &&LoadedSpan| (span.span[0] - t).max(t - span.span[1]).max(0.0);
        spans.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).and_then(LoadedSpan::side)
    };
    let whose: Vec<Option<Side>> = force.times.iter().map(|&t| nearest(t)).collect();
    let of_side = |side: Side| {
        let masked = |values: &[Vec3]| -> Vec<Vec3> {
            let at = |(value, owner): (&Vec3, &Option<Side>)| if *owner == Some(side) { *value } else { Vec3::zeros() };
            values.iter().zip(&whose).map(at).collect()
        };
        let own = ForceRecording { force: masked(&force.force), moment: masked(&force.moment), ..force.clone() };
        whose.contains(&Some(side)).then_some((side, own))
    };
    Side::BOTH.into_iter().filter_map(of_side).collect()
}

/// Reports loads that lie under a foot at another height than theirs.
fn report_other_heights(load: &LoadColumns, spans: &[LoadedSpan], findings: &mut Findings) {
    let found: Vec<(&LoadedSpan, (Side, f64))> =
        spans.iter().filter_map(|span| Some((span, span.at_another_height()?))).collect();
    let Some((LoadedSpan { span: [from, to], .. }, (side, off_m))) = found.first() else { return };
    let message = format!(
        "`{}...`, {from:.3}-{to:.3} s: the sole of the {side} foot is {off_m:.2} m above or below its centre of \
         pressure{}; the load acts on this foot. hint: check that forces and motion have the same origin",
        load.prefix,
        and_more_times(found.len())
    );
    findings.report(Code::LoadsOtherHeight, message);
}
