//! Muscles of a body on arrays: paths, moment arms and static optimisation.

use crate::failure::refused;
use ambulo::findings::Findings;
use ambulo::formats::osim::OsimModel;
use ambulo::kinematics::Posture;
use ambulo::model::Model;
use ambulo::muscles::built_in::muscle_set;
use ambulo::muscles::path::PathWorkspace;
use ambulo::muscles::set::MuscleSet;
use ambulo::muscles::settings::MuscleSettings;
use ambulo::muscles::solver::MuscleSolver;
use ambulo::muscles::wrap::WrapRule;
use numpy::IntoPyArray;
use numpy::ndarray::{Array2, Array3, ArrayView2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The muscles in the file of a model, or those of the built-in body if it has none.
pub(crate) fn muscles_of(content: &[u8], model: &Model) -> Result<MuscleSet, String> {
    let document = OsimModel::read(content).map_err(|error| error.to_string())?;
    if document.muscles.as_ref().is_ok_and(|own| own.muscles.is_empty()) {
        return muscle_set(model).map_err(|error| format!("the file has no muscles; built-in muscles: {error}"));
    }
    MuscleSet::of_document(&document, model, &mut Findings::default()).map_err(|error| error.to_string())
}

/// How paths over surfaces are found, by its name.
pub(crate) fn wrap_rule(py: Python<'_>, name: &str) -> PyResult<WrapRule> {
    let known = WrapRule::ALL.into_iter().find(|(word, _)| *word == name).map(|(_, rule)| rule);
    known.ok_or_else(|| {
        let words = WrapRule::ALL.map(|(word, _)| word).join(", ");
        refused(py, format!("wraps: found `{name}`; expected one of {words}"))
    })
}

/// Lengths [m], lengthening speeds [m/s] and moment arms [m] of all muscles.
pub(crate) fn paths<'py>(
    py: Python<'py>,
    model: &Model,
    set: &MuscleSet,
    rule: WrapRule,
    [q, qd]: [ArrayView2<'_, f64>; 2],
) -> PyResult<Bound<'py, PyDict>> {
    let (frames, count) = q.dim();
    let muscles = set.muscles.len();
    let [mut lengths, mut speeds] = [(); 2].map(|()| Array2::zeros((frames, muscles)));
    let mut arms = Array3::zeros((frames, muscles, count));
    py.detach(|| {
        let mut workspace = PathWorkspace::new(model, set, rule);
        let rest = vec![0.0; count];
        for frame in 0..frames {
            let [values, rates] = [q, qd].map(|part| part.row(frame).to_vec());
            workspace.update(Posture { q: &values, qd: &rates, qdd: &rest });
            for muscle in 0..muscles {
                lengths[[frame, muscle]] = workspace.lengths()[muscle];
                speeds[[frame, muscle]] = workspace.speeds()[muscle];
                for (coordinate, arm) in workspace.coordinates(muscle).iter().zip(workspace.arms(muscle)) {
                    arms[[frame, muscle, coordinate.index()]] = *arm;
                }
            }
        }
    });
    let content = PyDict::new(py);
    content.set_item("muscles", names(set))?;
    content.set_item("length", lengths.into_pyarray(py))?;
    content.set_item("speed", speeds.into_pyarray(py))?;
    content.set_item("arm", arms.into_pyarray(py))?;
    Ok(content)
}

/// Activations, tensions [N] and generalised forces of the motors [N.m, N].
pub(crate) fn optimized<'py>(
    py: Python<'py>,
    model: &Model,
    set: &MuscleSet,
    settings: &MuscleSettings,
    [q, qd, moments]: [ArrayView2<'_, f64>; 3],
) -> PyResult<Bound<'py, PyDict>> {
    let solver = MuscleSolver::new(model, set, settings);
    let mut solver = solver.map_err(|error| refused(py, error.to_string()))?;
    let (frames, count) = q.dim();
    let [mut activations, mut forces] = [(); 2].map(|()| Array2::zeros((frames, set.muscles.len())));
    let mut reserves = Array2::zeros((frames, count));
    py.detach(|| {
        let rest = vec![0.0; count];
        let coordinates = solver.coordinates().to_vec();
        for frame in 0..frames {
            let [values, rates, wanted] = [q, qd, moments].map(|part| part.row(frame).to_vec());
            let found = solver.frame(Posture { q: &values, qd: &rates, qdd: &rest }, &wanted);
            for (muscle, (activation, force)) in found.activations.iter().zip(&found.forces).enumerate() {
                activations[[frame, muscle]] = *activation;
                forces[[frame, muscle]] = *force;
            }
            for (coordinate, reserve) in coordinates.iter().zip(&found.reserves) {
                reserves[[frame, coordinate.index()]] = *reserve;
            }
        }
    });
    let content = PyDict::new(py);
    content.set_item("muscles", names(set))?;
    content.set_item("activation", activations.into_pyarray(py))?;
    content.set_item("force", forces.into_pyarray(py))?;
    content.set_item("reserve", reserves.into_pyarray(py))?;
    Ok(content)
}

/// Names of the muscles, in the order of the arrays.
pub(crate) fn names(set: &MuscleSet) -> Vec<String> {
    set.muscles.iter().map(|muscle| muscle.name.clone()).collect()
}
