//! A figure of a scene that walks by its own torques, taken out of it.

use super::build::{SceneSettings, settings};
use super::built_entry::{BuiltFigure, ControlEntry, WalkEntry};
use super::built_figure::gait_of;
use super::file::SceneFile;
use super::planner::Planner;
use super::sources::{InputFiles, ReadFile};
use super::{Place, SceneError};
use crate::control::ControlSettings;
use crate::engine::workspace::StepSettings;
use crate::findings::Findings;
use crate::model::anthropometry::Human;
use crate::optimal::{Observer, Solution};

/// A figure with a controller, its plan and its settings, without the rest of its scene.
#[derive(Debug, Clone)]
pub struct ControlledFigure {
    /// Name of the figure.
    pub name: String,
    /// Place of its key `control` in the file.
    pub place: Place,
    /// The figure with the soles of its plan.
    pub human: Human,
    /// Plan of the figure at its initial speed.
    pub plan: Solution,
    /// Settings of the steps of the scene.
    pub step: StepSettings,
    /// Settings of its controller.
    pub settings: ControlSettings,
    /// The file of its torque curves, as the scene names it.
    pub torques: Option<String>,
}

impl ControlledFigure {
    /// The figure of a scene with this name; without one, the first figure that has a controller. `load` reads the
    /// files that the walk names, as in [`Scene::build`](super::Scene::build). `observer` follows the steps of the
    /// solver that plans the walk, and may stop them.
    ///
    /// # Errors
    /// No such figure, one without a controller, a walk that is not found.
    pub fn of(
        file: &SceneFile,
        name: Option<&str>,
        load: &mut ReadFile<'_>,
        observer: &Observer,
        findings: &mut Findings,
    ) -> Result<ControlledFigure, SceneError> {
        let (name, built, walk, control) = controlled(file, name)?;
        let step = settings(file, &SceneSettings::default());
        let mut sources = InputFiles::new(load, findings, file.duration_s, step);
        sources.observer = observer.clone();
        let gait = gait_of(walk, &mut sources)?;
        let planner = Planner { entry: walk, build: &built.build, gait: &gait };
        let settings = planner.settings(control, &mut sources)?;
        let plan = planner.plan(walk.speed, &mut sources)?;
        let (human, plan) = (plan.human.clone(), plan.solution.clone());
        let torques = control.torques.as_ref().map(|(_, file)| file.clone());
        Ok(ControlledFigure {
            name: name.to_owned(),
            place: control.place.clone(),
            human,
            plan,
            step,
            settings,
            torques,
        })
    }
}

type Controlled<'a> = (&'a str, &'a BuiltFigure, &'a WalkEntry, &'a ControlEntry);

fn controlled<'a>(file: &'a SceneFile, name: Option<&str>) -> Result<Controlled<'a>, SceneError> {
    let of_figures = file.figures.iter().filter_map(|entry| {
        let built = entry.built.as_ref()?;
        Some((entry.name.as_str(), built, built.walk.as_ref()?, built.control.as_ref()?))
    });
    let mut all = of_figures.clone().filter(|(own, ..)| name.is_none_or(|name| name == *own));
    all.next().ok_or_else(|| {
        let known: Vec<String> = of_figures.map(|(own, ..)| format!("`{own}`")).collect();
        let found = name.map_or("found no figure".to_owned(), |name| format!("found no figure `{name}`"));
        let known =
            if known.is_empty() { "none has one".to_owned() } else { format!("those are {}", known.join(", ")) };
        let place = Place { line: 1, key: "figure".to_owned() };
        place.error(format!("{found} with the key `control`; expected one that walks by its own torques; {known}"))
    })
}
