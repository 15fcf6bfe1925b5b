//! The live page: the figure of a model, moved by events, and curves of the last seconds.
//!
//! The page is a report with one instant and without curves; what follows comes as events ([`LiveFrame`],
//! [`LiveState`]).

use super::block::Block;
use super::contract::{
    FORMAT, LiveCurve, LiveForce, LivePage, LivePanel, Page, PageSide, PageSource, Quality, Session, TimeAxis,
};
use super::shell::{self, Kind};
use super::view::drawn;
use crate::exchange::ExchangeError;
use crate::stage::{ForceRole, Stage, StageForce};
use ambulo::findings::Findings;
use ambulo::kinematics::Trajectory;
use ambulo::model::{Model, Side};
use ambulo::motion::{SmoothMotion, TimeGrid};
use ambulo::spatial::Vec3;

/// Joint moments with a panel: title and beginning of the coordinate's name.
const MOMENTS: [(&str, &str); 3] =
    [("Hip flexion moment", "hip_flexion_"), ("Knee moment", "knee_angle_"), ("Ankle moment", "ankle_angle_")];
/// Ground forces with a panel: title and end of the column's name.
const FORCES: [(&str, &str); 2] = [("Ground force, up", "vy"), ("Ground force, forward", "vx")];

/// The page of a model whose results have these columns, at a frame rate [Hz] and with a delay [ms].
///
/// # Errors
/// A model that cannot be drawn.
pub fn live_page(
    model: &Model,
    columns: &[(String, &'static str)],
    rate_hz: f64,
    delay_ms: f64,
) -> Result<String, ExchangeError> {
    let motion = SmoothMotion {
        grid: TimeGrid { start_s: 0.0, step_s: 0.0, frames: 1 },
        columns: vec![None; model.coordinates().len()],
        noise: vec![None; model.coordinates().len()],
    };
    let trajectory = Trajectory::complete(model, motion, &mut Findings::default())?;
    let mut stage = Stage::of_motion(model, &trajectory, None);
    stage.forces = Side::BOTH.map(no_force).to_vec();
    let mut block = Block::default();
    let viewed = drawn(stage, &mut block);
    let session = Session {
        name: model.name().to_owned(),
        outcome: Vec::new(),
        data: None,
        glance: None,
        header: Vec::new(),
        source: PageSource::Predicted,
        time: TimeAxis { start_s: 0.0, step_s: 0.0, frames: 1 },
        events: Vec::new(),
        cycles: Vec::new(),
        groups: Vec::new(),
        machines: Vec::new(),
        tables: Vec::new(),
        quality: Quality {
            facts: Vec::new(),
            groups: Vec::new(),
            tables: Vec::new(),
            findings: Vec::new(),
            assumptions: Vec::new(),
        },
        feasibility: None,
        view: viewed.view,
        missing: viewed.missing,
    };
    let title = format!("{}, live", model.name());
    let page = Page { format: FORMAT, program: env!("CARGO_PKG_VERSION").to_owned(), title, sessions: vec![session] };
    let live = LivePage { rate_hz, delay_ms, forces: forces(columns), panels: panels(columns) };
    Ok(shell::html(&page, &block, Kind::Live(&live))?)
}

fn no_force(side: Side) -> StageForce {
    let name = if side == Side::Right { "right" } else { "left" };
    let zero = vec![Vec3::zeros()];
    StageForce { name: name.to_owned(), side: Some(side), role: ForceRole::Main, point: zero.clone(), force: zero }
}

fn place(columns: &[(String, &'static str)], name: &str) -> Option<usize> {
    columns.iter().position(|(column, _)| column == name)
}

/// Columns of force and centre of pressure of the right and the left foot.
fn forces(columns: &[(String, &'static str)]) -> Vec<LiveForce> {
    let vector = |side: &str, letter: &str| {
        let axis = |axis: &str| place(columns, &format!("ground_force_{side}_{letter}{axis}"));
        Some([axis("x")?, axis("y")?, axis("z")?])
    };
    let force = |side| Some(LiveForce { force: vector(side, "v")?, point: vector(side, "p")? });
    ["r", "l"].into_iter().filter_map(force).collect()
}

fn panels(columns: &[(String, &'static str)]) -> Vec<LivePanel> {
    let panel = |title: &str, name: &dyn Fn(&str) -> String| {
        let curve = |(side, letter): (PageSide, &str)| {
            let name = name(letter);
            let column = place(columns, &name)?;
            Some(LiveCurve { side, column, sd: place(columns, &format!("{name}_sd")) })
        };
        let curves: Vec<LiveCurve> = [(PageSide::R, "r"), (PageSide::L, "l")].into_iter().filter_map(curve).collect();
        let unit = columns[curves.first()?.column].1.to_owned();
        Some(LivePanel { title: title.to_owned(), unit, curves })
    };
    let ground = FORCES.iter().filter_map(|(title, end)| panel(title, &|side| format!("ground_force_{side}_{end}")));
    let moments = MOMENTS.iter().filter_map(|(title, start)| panel(title, &|side| format!("{start}{side}_moment")));
    ground.chain(moments).collect()
}
