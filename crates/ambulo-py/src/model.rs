//! A body, and computations on arrays.
//!
//! Arrays of motions have one row per frame and one column per coordinate of the model. They are copied into the
//! trajectory in blocks of frames that stay in the processor's cache, so an array in Fortran order (columns are
//! contiguous) is read fastest.

use crate::arrays::{NumberArray, array_of};
use crate::failure::{Listed, exception, listed, refused, warn};
use crate::muscles;
use crate::recordings::vectors;
use crate::smoothing::{Cutoff, smoother};
use ambulo::analysis::feasibility::Person;
use ambulo::dynamics::{LoadSeries, Workspace, inverse_frames};
use ambulo::findings::Findings;
use ambulo::ground::feet;
use ambulo::ground::predict::{PredictSettings, predict};
use ambulo::kinematics::marker_fit::{FitSettings, MarkerFit, fit_markers};
use ambulo::kinematics::{BodyMotion, Trajectory, each_body_motion};
use ambulo::model::CoordinateId;
use ambulo::motion::filter::LowPass;
use ambulo::motion::{MarkerPath, MarkerRecording, Motion, SmoothSettings, Smoother, TimeGrid, Window, smooth};
use ambulo::muscles::set::MuscleSet;
use ambulo::muscles::settings::MuscleSettings;
use ambulo::simulation::synthetic::RATES_HZ;
use ambulo::spatial::{Vec3, Wrench};
use ambulo::study::Settings;
use ambulo_results::{deviation_columns, ground_columns};
use numpy::ndarray::{Array2, ArrayView1, ArrayView2, ArrayViewMut2, Ix2, Ix3, s};
use numpy::{IntoPyArray, PyArray2, PyArray4, PyArrayMethods, PyReadwriteArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyDict};
use std::hint::black_box;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Instant;

/// Frames of one block of inverse dynamics.
const BLOCK: usize = 128;

pub(crate) type MotionArray<'py> = NumberArray<'py, Ix2>;

/// Values, rates or accelerations of a coordinate.
type Part = fn(&Trajectory, CoordinateId) -> &[f64];

/// A body: an OpenSim model. `ambulo.model` reads one, `ambulo.calibrate` makes one.
#[pyclass(frozen, module = "ambulo")]
pub(crate) struct Model {
    name: PathBuf,
    content: Arc<[u8]>,
    model: ambulo::model::Model,
    findings: Vec<Listed>,
    /// Scratch memory of inverse dynamics that no call is using.
    scratch: Mutex<Vec<Workspace>>,
    /// The muscles, when they were asked for.
    muscle_set: OnceLock<Result<MuscleSet, String>>,
}

#[pymethods]
impl Model {
    #[new]
    fn new(py: Python<'_>, data: PyBackedBytes, name: PathBuf) -> PyResult<Model> {
        let mut findings = Findings::default();
        let model = py.detach(|| ambulo_cli::model(&data, &name, &mut findings));
        let model = model.map_err(|failure| exception(py, failure))?;
        let findings = listed(&findings);
        Ok(Model {
            name,
            content: Arc::from(&data[..]),
            model,
            findings,
            scratch: Mutex::default(),
            muscle_set: OnceLock::new(),
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (Bound<'py, PyBytes>, PathBuf)) {
        (slf.get_type().into_any(), (slf.get().data(slf.py()), slf.get().name.clone()))
    }

    fn __repr__(&self) -> String {
        let Model { model, .. } = self;
        let (bodies, coordinates) = (model.bodies().len(), model.coordinates().len());
        format!("<Model {}: {bodies} bodies, {coordinates} coordinates, {:.2} kg>", model.name(), model.mass())
    }

    /// The content of the OpenSim file.
    #[getter]
    fn data<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.content)
    }

    /// Name of the file, for messages.
    #[getter]
    fn file(&self) -> String {
        self.name.display().to_string()
    }

    /// Name of the model.
    #[getter]
    fn name(&self) -> &str {
        self.model.name()
    }

    /// Mass of all bodies [kg].
    #[getter]
    fn mass(&self) -> f64 {
        self.model.mass()
    }

    /// Names of the bodies.
    #[getter]
    fn bodies(&self) -> Vec<&str> {
        self.model.bodies().iter().map(|body| body.name.as_str()).collect()
    }

    /// Names of the coordinates; arrays of motions have their columns in this order.
    #[getter]
    fn coordinates(&self) -> Vec<&str> {
        self.model.coordinates().iter().map(|coordinate| coordinate.name.as_str()).collect()
    }

    /// Names of the generalised forces, as the columns of `moments.sto`.
    #[getter]
    fn force_names(&self) -> Vec<String> {
        self.model.force_names()
    }

    /// Names of the markers.
    #[getter]
    fn markers(&self) -> Vec<&str> {
        self.model.markers().iter().map(|marker| marker.name.as_str()).collect()
    }

    /// Warnings and notes about the file: ``code``, ``severity``, ``message``, ``count``.
    #[getter]
    fn findings(&self) -> Vec<Listed> {
        self.findings.clone()
    }

    /// Inverse dynamics: generalised forces from a motion and the known loads.
    ///
    /// Parameters
    /// ----------
    /// q, qd, qdd : array_like, shape (frames, coordinates)
    ///     Coordinates [rad, m], rates [rad/s, m/s] and accelerations [rad/s², m/s²]; columns in the order of `coordinates`. Arrays in Fortran
    ///     order are read fastest.
    /// loads : dict of str to array_like, shape (frames, 9), optional
    ///     Loads by the name of the body, in world axes: force [N], point of application [m], moment about that point [N.m].
    /// out : numpy.ndarray, shape (frames, coordinates), float64, optional
    ///     Array for the result; in Fortran order it is filled fastest. Reuse it in loops.
    ///
    /// Returns
    /// -------
    /// numpy.ndarray, shape (frames, coordinates)
    ///     Generalised forces [N.m, N], in Fortran order; those of the root are the residual.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     Arrays of other shapes, numbers that are not finite, an unknown body.
    ///
    /// Notes
    /// -----
    /// Newton-Euler equations in world axes; signs as OpenSim's InverseDynamicsSolver. Source: docs of
    /// `ambulo::dynamics::inverse`. Other threads run meanwhile.
    #[pyo3(signature = (q, qd, qdd, loads=None, out=None))]
    fn inverse_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: MotionArray<'py>,
        qd: MotionArray<'py>,
        qdd: MotionArray<'py>,
        loads: Option<Bound<'py, PyDict>>,
        out: Option<Bound<'py, PyArray2<f64>>>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let motion = self.motion(py, [&q, &qd, &qdd])?;
        let loads: Vec<(String, MotionArray<'_>)> = match loads {
            Some(loads) => {
                loads.iter().map(|(body, load)| Ok((body.extract()?, load.extract()?))).collect::<PyResult<_>>()?
            }
            None => Vec::new(),
        };
        let loads = self.loads(py, &loads, motion[0].nrows())?;
        let (frames, count) = motion[0].dim();
        let out = match out {
            Some(out) => out,
            None => PyArray2::zeros(py, [frames, count], true),
        };
        if out.shape() != [frames, count] {
            let found = out.shape();
            return Err(refused(py, format!("out: found the shape {found:?}; expected ({frames}, {count})")));
        }
        let mut writable: PyReadwriteArray2<'_, f64> =
            out.try_readwrite().map_err(|error| refused(py, format!("out: {error}; expected a separate array")))?;
        let forces = writable.as_array_mut();
        py.detach(|| self.inverse_in_blocks(motion, &loads, forces)).map_err(|message| refused(py, message))?;
        drop(writable);
        Ok(out)
    }

    /// Pose, velocity and acceleration of every body in world axes.
    ///
    /// Parameters
    /// ----------
    /// q : array_like, shape (frames, coordinates)
    ///     Coordinates [rad, m]; columns in the order of `coordinates`.
    /// qd, qdd : array_like, shape (frames, coordinates), optional
    ///     Rates and accelerations; zero if omitted.
    ///
    /// Returns
    /// -------
    /// dict
    ///     ``bodies`` (names); ``rotation`` (frames, bodies, 3, 3), axes of the body in the world as columns; and arrays (frames, bodies, 3):
    ///     ``origin`` and ``center`` of mass [m], ``velocity`` [m/s] and ``acceleration`` [m/s²] of the centre of mass, ``angular_velocity``
    ///     [rad/s], ``angular_acceleration`` [rad/s²].
    ///
    /// Raises
    /// ------
    /// InputError
    ///     Arrays of other shapes, numbers that are not finite.
    #[pyo3(signature = (q, qd=None, qdd=None))]
    fn forward_kinematics<'py>(
        &self,
        py: Python<'py>,
        q: MotionArray<'py>,
        qd: Option<MotionArray<'py>>,
        qdd: Option<MotionArray<'py>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let still = Array2::zeros(q.as_array().dim());
        let still = still.view();
        let rates = qd.as_ref().map_or(still, |qd| qd.as_array());
        let accelerations = qdd.as_ref().map_or(still, |qdd| qdd.as_array());
        let motion = self.checked(py, [q.as_array(), rates, accelerations])?;
        let bodies = py.detach(|| self.body_motions(motion, 1.0)).map_err(|message| refused(py, message))?;
        self.body_arrays(py, &bodies)
    }

    /// Names of the muscles: those in the file of the model, or those of the built-in body.
    #[getter]
    fn muscles(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(muscles::names(self.muscle_set(py)?))
    }

    /// Lengths, lengthening speeds and moment arms of all muscles.
    ///
    /// Parameters
    /// ----------
    /// q : array_like, shape (frames, coordinates)
    ///     Coordinates [rad, m]; columns in the order of `coordinates`.
    /// qd : array_like, shape (frames, coordinates), optional
    ///     Rates; zero if omitted.
    /// wraps : {"exact", "opensim"}, optional
    ///     How paths over surfaces are found.
    ///
    /// Returns
    /// -------
    /// dict
    ///     ``muscles`` (names); ``length`` [m] and ``speed`` [m/s], shape (frames, muscles), lengthening positive; ``arm`` [m], shape (frames,
    ///     muscles, coordinates), positive where tension gives a positive generalised force: minus the derivative of the length.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     A model without muscles, arrays of other shapes, numbers that are not finite.
    ///
    /// Notes
    /// -----
    /// Method: docs/MUSCLES.md.
    #[pyo3(signature = (q, qd=None, wraps="exact"))]
    fn muscle_paths<'py>(
        &self,
        py: Python<'py>,
        q: MotionArray<'py>,
        qd: Option<MotionArray<'py>>,
        wraps: &str,
    ) -> PyResult<Bound<'py, PyDict>> {
        let still = Array2::zeros(q.as_array().dim());
        let rates = qd.as_ref().map_or(still.view(), |qd| qd.as_array());
        let [q, qd, _] = self.checked(py, [q.as_array(), rates, rates])?;
        muscles::paths(py, &self.model, self.muscle_set(py)?, muscles::wrap_rule(py, wraps)?, [q, qd])
    }

    /// Muscle forces that give the joint moments with the least sum of the activations to a power, frame by frame.
    ///
    /// Parameters
    /// ----------
    /// q, qd : array_like, shape (frames, coordinates)
    ///     Coordinates and rates, as in `inverse_dynamics`.
    /// moments : array_like, shape (frames, coordinates)
    ///     Generalised forces [N.m, N], as `inverse_dynamics` returns them.
    /// exponent : float, optional
    ///     The power, 2 as in OpenSim.
    /// wraps : {"exact", "opensim"}, optional
    ///     How paths over surfaces are found.
    ///
    /// Returns
    /// -------
    /// dict
    ///     ``muscles`` (names); ``activation`` (0 to 1) and ``force`` [N], shape (frames, muscles); ``reserve`` [N.m, N], shape (frames,
    ///     coordinates): what motors add where muscles are too weak or missing.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     A model without muscles, an exponent out of range, arrays of other shapes, numbers that are not finite.
    ///
    /// Notes
    /// -----
    /// The problem of OpenSim's static optimisation, solved exactly; motors of 1 N.m at joints and 1000 at the root.
    /// Method: docs/MUSCLES.md.
    #[pyo3(signature = (q, qd, moments, exponent=None, wraps="exact"))]
    fn static_optimization<'py>(
        &self,
        py: Python<'py>,
        q: MotionArray<'py>,
        qd: MotionArray<'py>,
        moments: MotionArray<'py>,
        exponent: Option<f64>,
        wraps: &str,
    ) -> PyResult<Bound<'py, PyDict>> {
        let arrays = self.motion(py, [&q, &qd, &moments])?;
        let mut settings = MuscleSettings { wraps: muscles::wrap_rule(py, wraps)?, ..MuscleSettings::default() };
        settings.exponent = exponent.unwrap_or(settings.exponent);
        muscles::optimized(py, &self.model, self.muscle_set(py)?, &settings, arrays)
    }

    /// Coordinates that bring the markers of the model closest to recorded ones, frame by frame.
    ///
    /// Parameters
    /// ----------
    /// names : sequence of str
    ///     Names of the recorded markers; those that the model does not have are not used.
    /// positions : array_like, shape (frames, markers, 3)
    ///     Positions in world axes [m]; not a number where a marker is missing.
    /// rate : float
    ///     Frame rate [Hz].
    ///
    /// Returns
    /// -------
    /// dict
    ///     ``coordinates`` (names); ``q`` (frames, coordinates) [rad, m], not a number where no marker determines a coordinate; ``rms``
    ///     (frames,) distance of the markers [m]; ``converged`` (frames,).
    ///
    /// Raises
    /// ------
    /// InputError
    ///     No marker in common, too few markers, arrays of other shapes.
    ///
    /// Warns
    /// -----
    /// AmbuloWarning
    ///     Once for each kind of doubtful data, such as swapped labels.
    ///
    /// Notes
    /// -----
    /// The fit of ``ambulo forces`` with its defaults. Method: docs of `ambulo::kinematics::marker_fit`.
    fn fit_markers<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        positions: NumberArray<'py, Ix3>,
        rate: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let positions = positions.as_array();
        let (frames, count, axes) = positions.dim();
        if count != names.len() || axes != 3 {
            let found = format!("positions: found the shape ({frames}, {count}, {axes})");
            return Err(refused(py, format!("{found}; expected (frames, {}, 3), one name per marker", names.len())));
        }
        check_rate(py, rate)?;
        let path = |(k, name): (usize, String)| {
            let at = |frame: usize| Vec3::from_fn(|axis, _| positions[[frame, k, axis]]);
            MarkerPath { name, positions: (0..frames).map(at).collect() }
        };
        let recording = MarkerRecording {
            name: "positions".to_owned(),
            rate_hz: rate,
            times: (0..frames).map(|frame| frame as f64 / rate).collect(),
            markers: names.into_iter().enumerate().map(path).collect(),
        };
        let mut findings = Findings::default();
        let fit = py
            .detach(|| fit_markers(&self.model, &recording, &FitSettings::default(), &mut findings))
            .map_err(|error| refused(py, error.to_string()))?;
        warn(py, &findings)?;
        self.fit_arrays(py, frames, fit)
    }

    /// Smooth coordinates, and compute their rates and accelerations.
    ///
    /// Parameters
    /// ----------
    /// q : array_like, shape (frames, coordinates)
    ///     Coordinates [rad, m] at a uniform rate; columns in the order of `coordinates`. Not a number where a value is missing: gaps inside
    ///     the motion of at most 0.2 s are bridged, and a coordinate without any number gets the value of the model.
    /// rate : float
    ///     Frame rate [Hz].
    /// filter : {"butterworth", "spline"}, optional
    ///     Zero-phase low-pass, or quintic smoothing spline by generalised cross-validation.
    /// cutoff : float or "off", optional
    ///     Cut-off of one pass of the Butterworth filter [Hz]; ``"off"`` puts a spline through the numbers.
    /// order : int, optional
    ///     Order of one pass of the Butterworth filter, 1 to 8.
    ///
    /// Returns
    /// -------
    /// dict
    ///     ``times`` (frames,) [s], 0 at the first row of the argument; ``q``, ``qd``, ``qdd`` (frames, coordinates) [rad, m and per s, s²] in
    ///     Fortran order, for `inverse_dynamics` and `predict_ground`.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     Gaps that are too long or at an end, too few frames, a cut-off that the rate does not allow, arrays of other shapes.
    ///
    /// Warns
    /// -----
    /// AmbuloWarning
    ///     Once for each kind of doubtful data.
    ///
    /// Notes
    /// -----
    /// An option that is not given has the default of ``ambulo forces``. Methods and sources: docs of
    /// `ambulo::motion::smooth`.
    #[pyo3(signature = (q, rate, filter=None, cutoff=None, order=None))]
    fn smooth<'py>(
        &self,
        py: Python<'py>,
        q: MotionArray<'py>,
        rate: f64,
        filter: Option<&str>,
        cutoff: Option<Cutoff>,
        order: Option<usize>,
    ) -> PyResult<Bound<'py, PyDict>> {
        check_rate(py, rate)?;
        let [q, ..] = self.checked(py, [q.as_array(); 3])?;
        let smoother = asked(py, filter, cutoff, order)?;
        let mut findings = Findings::default();
        let trajectory = py.detach(|| self.smoothed(q, rate, smoother, &mut findings));
        let trajectory = trajectory.map_err(|message| refused(py, message))?;
        warn(py, &findings)?;
        let content = PyDict::new(py);
        content.set_item("times", trajectory.grid().times().into_pyarray(py))?;
        let parts = [("q", Trajectory::values as Part), ("qd", Trajectory::rates), ("qdd", Trajectory::accelerations)];
        for (name, part) in parts {
            let columns: Vec<&[f64]> = self.model.coordinate_ids().map(|id| part(&trajectory, id)).collect();
            content.set_item(name, array_of(py, trajectory.grid().frames, columns.into_iter())?)?;
        }
        Ok(content)
    }

    /// Time per frame [s] of the library's own batch, for comparison in `bench/measure.py`.
    fn _time_of_batch(
        &self,
        py: Python<'_>,
        q: MotionArray<'_>,
        qd: MotionArray<'_>,
        qdd: MotionArray<'_>,
        repeats: usize,
    ) -> PyResult<f64> {
        let motion = self.motion(py, [&q, &qd, &qdd])?;
        let trajectory = self.trajectory(motion, 0..motion[0].nrows(), 1.0).map_err(|message| refused(py, message))?;
        Ok(py.detach(|| self.batch(&trajectory, repeats)))
    }

    /// Ground forces on both feet from a motion alone, with standard deviations.
    ///
    /// Parameters
    /// ----------
    /// q, qd, qdd : array_like, shape (frames, coordinates)
    ///     Coordinates, rates and accelerations, as in `inverse_dynamics`.
    /// rate : float
    ///     Frame rate [Hz].
    /// filter, cutoff, order : optional
    ///     The filter that the motion has passed, as in `smooth`, which has the same default; ``cutoff="off"`` for a motion that was not filtered.
    ///     It is used for running.
    ///
    /// Returns
    /// -------
    /// dict of str to numpy.ndarray, shape (frames,)
    ///     The columns of ``grf.mot`` and ``grf_sd.mot``: ``ground_force_r_vx`` [N], ``ground_force_r_px`` [m], ``ground_torque_r_y`` [N.m],
    ///     ``ground_force_r_vx_sd``; zero while a foot is unloaded.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     A model without feet or gravity, arrays of other shapes, numbers that are not finite.
    ///
    /// Warns
    /// -----
    /// AmbuloWarning
    ///     Once for each kind of doubtful data.
    ///
    /// Notes
    /// -----
    /// Maximum a posteriori estimate; method and errors against force plates: docs/GROUND_FORCES.md.
    #[pyo3(signature = (q, qd, qdd, rate, filter=None, cutoff=None, order=None))]
    #[expect(clippy::too_many_arguments, reason = "the options of a function in Python")]
    fn predict_ground<'py>(
        &self,
        py: Python<'py>,
        q: MotionArray<'py>,
        qd: MotionArray<'py>,
        qdd: MotionArray<'py>,
        rate: f64,
        filter: Option<&str>,
        cutoff: Option<Cutoff>,
        order: Option<usize>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let [lowest, highest] = RATES_HZ;
        if !(lowest..=highest).contains(&rate) {
            return Err(refused(py, format!("rate: found {rate} Hz; expected {lowest} to {highest} Hz")));
        }
        let motion = self.motion(py, [&q, &qd, &qdd])?;
        let passed = asked(py, filter, cutoff, order)?.low_pass();
        let mut findings = Findings::default();
        let columns = py.detach(|| self.predicted_columns(motion, rate, passed, &mut findings));
        let columns = columns.map_err(|message| refused(py, message))?;
        warn(py, &findings)?;
        let content = PyDict::new(py);
        for (name, values) in columns {
            content.set_item(name, values.into_pyarray(py))?;
        }
        Ok(content)
    }
}

impl Model {
    /// The muscles of the file, or of the built-in body.
    fn muscle_set(&self, py: Python<'_>) -> PyResult<&MuscleSet> {
        let set = self.muscle_set.get_or_init(|| muscles::muscles_of(&self.content, &self.model));
        set.as_ref().map_err(|message| refused(py, message.clone()))
    }

    pub(crate) fn library(&self) -> &ambulo::model::Model {
        &self.model
    }

    fn smoothed(
        &self,
        q: ArrayView2<'_, f64>,
        rate: f64,
        smoother: Smoother,
        findings: &mut Findings,
    ) -> Result<Trajectory, String> {
        let recorded = |column: ArrayView1<'_, f64>| column.iter().any(|x| x.is_finite()).then(|| column.to_vec());
        let motion = Motion {
            origin: "q".to_owned(),
            times: (0..q.nrows()).map(|frame| frame as f64 / rate).collect(),
            columns: q.columns().into_iter().map(recorded).collect(),
        };
        let settings = SmoothSettings { smoother, window: Window::default(), rate_hz: None };
        let smoothed = smooth(&self.model, &motion, settings, findings).map_err(|error| error.to_string())?;
        Trajectory::complete(&self.model, smoothed, findings).map_err(|error| error.to_string())
    }

    /// Runs the batch of the library on a complete trajectory, without copies.
    fn batch(&self, trajectory: &Trajectory, repeats: usize) -> f64 {
        let mut workspace = Workspace::new(&self.model);
        let mut columns = vec![vec![0.0; trajectory.grid().frames]; self.model.coordinates().len()];
        let start = Instant::now();
        for _ in 0..repeats {
            inverse_frames(&mut workspace, trajectory, &[], |coordinate, first, values| {
                columns[coordinate][first..first + values.len()].copy_from_slice(values);
            });
            black_box(&columns);
        }
        start.elapsed().as_secs_f64() / (repeats * trajectory.grid().frames) as f64
    }

    /// The arrays of a motion, which have the shape that the model needs.
    fn motion<'a>(&self, py: Python<'_>, motion: [&'a MotionArray<'_>; 3]) -> PyResult<[ArrayView2<'a, f64>; 3]> {
        self.checked(py, motion.map(|array| array.as_array()))
    }

    fn checked<'a>(&self, py: Python<'_>, motion: [ArrayView2<'a, f64>; 3]) -> PyResult<[ArrayView2<'a, f64>; 3]> {
        let (frames, count) = (motion[0].nrows(), self.model.coordinates().len());
        for (array, name) in motion.iter().zip(["q", "qd", "qdd"]) {
            if array.dim() != (frames, count) {
                let (found, name_of_model) = (array.dim(), self.model.name());
                return Err(refused(
                    py,
                    format!(
                        "{name}: found the shape {found:?}; expected ({frames}, {count}), one column per coordinate of \
                         the model `{name_of_model}`"
                    ),
                ));
            }
        }
        Ok(motion)
    }

    /// Loads on bodies, one array per body with the columns of `grf.mot`: force, point, moment about the point.
    fn loads(&self, py: Python<'_>, loads: &[(String, MotionArray<'_>)], frames: usize) -> PyResult<Vec<LoadSeries>> {
        let series = |(name, array): &(String, MotionArray<'_>)| {
            let array = array.as_array();
            let Some(body) = self.model.body(name) else {
                let known = self.bodies().join(", ");
                return Err(refused(py, format!("loads: found the body `{name}`; expected one of {known}")));
            };
            if array.dim() != (frames, 9) {
                let found = array.dim();
                return Err(refused(
                    py,
                    format!(
                        "loads: `{name}`: found the shape {found:?}; expected ({frames}, 9): force [N], point [m], \
                         moment about the point [N.m]"
                    ),
                ));
            }
            if let Some(((row, column), found)) = array.indexed_iter().find(|(_, x)| !x.is_finite()) {
                let found = format!("loads: `{name}`: found {found} in row {row}, column {column}");
                return Err(refused(py, format!("{found}; expected finite numbers")));
            }
            let at = |frame: usize, first: usize| Vec3::from_fn(|axis, _| array[[frame, first + axis]]);
            let wrench = |frame: usize| Wrench { force: at(frame, 0), moment: at(frame, 6) };
            Ok(LoadSeries {
                body,
                points: (0..frames).map(|frame| at(frame, 3)).collect(),
                wrenches: (0..frames).map(wrench).collect(),
            })
        };
        loads.iter().map(series).collect()
    }

    /// Inverse dynamics, one block of frames after the other.
    fn inverse_in_blocks(
        &self,
        motion: [ArrayView2<'_, f64>; 3],
        loads: &[LoadSeries],
        mut forces: ArrayViewMut2<'_, f64>,
    ) -> Result<(), String> {
        let idle = || self.scratch.lock().unwrap_or_else(PoisonError::into_inner);
        let mut workspace = idle().pop().unwrap_or_else(|| Workspace::new(&self.model));
        let frames = motion[0].nrows();
        for first in (0..frames).step_by(BLOCK) {
            let rows = first..frames.min(first + BLOCK);
            let trajectory = self.trajectory(motion, rows.clone(), 1.0)?;
            let loads: Vec<LoadSeries> = loads.iter().map(|load| part(load, rows.clone())).collect();
            inverse_frames(&mut workspace, &trajectory, &loads, |coordinate, start, values| {
                let start = first + start;
                let mut place = forces.slice_mut(s![start..start + values.len(), coordinate]);
                match place.as_slice_mut() {
                    Some(place) => place.copy_from_slice(values),
                    None => place.iter_mut().zip(values).for_each(|(place, value)| *place = *value),
                }
            });
        }
        idle().push(workspace);
        Ok(())
    }

    /// A range of the rows as a trajectory.
    fn trajectory(
        &self,
        motion: [ArrayView2<'_, f64>; 3],
        rows: std::ops::Range<usize>,
        rate: f64,
    ) -> Result<Trajectory, String> {
        let first = rows.start;
        let grid = TimeGrid { start_s: first as f64 / rate, step_s: 1.0 / rate, frames: rows.len() };
        let motion = motion.map(|array| array.slice_move(s![rows.clone(), ..]));
        let columns = (0..self.model.coordinates().len()).map(|c| motion.map(|array| array.column(c).to_vec()));
        Trajectory::new(&self.model, grid, columns.collect()).map_err(|error| match not_finite(&motion) {
            Some((array, row, column)) => {
                let name = &self.model.coordinates()[column].name;
                format!(
                    "{array}: coordinate `{name}` is not a finite number in row {}; expected values without gaps",
                    first + row
                )
            }
            None => error.to_string(),
        })
    }

    fn body_motions(&self, motion: [ArrayView2<'_, f64>; 3], rate: f64) -> Result<Vec<Vec<BodyMotion>>, String> {
        let trajectory = self.trajectory(motion, 0..motion[0].nrows(), rate)?;
        let mut frames = Vec::with_capacity(trajectory.grid().frames);
        each_body_motion(&self.model, &trajectory, |_, bodies| frames.push(bodies.to_vec()));
        Ok(frames)
    }

    fn body_arrays<'py>(&self, py: Python<'py>, frames: &[Vec<BodyMotion>]) -> PyResult<Bound<'py, PyDict>> {
        let bodies = self.model.bodies().len();
        let series = |pick: fn(&BodyMotion) -> Vec3| {
            let path = |body: usize| frames.iter().map(|bodies| pick(&bodies[body])).collect::<Vec<_>>();
            let paths: Vec<Vec<Vec3>> = (0..bodies).map(path).collect();
            vectors(py, frames.len(), &paths.iter().map(Vec::as_slice).collect::<Vec<_>>())
        };
        let rotations = frames.iter().flatten().flat_map(|body| {
            // Row after row; a matrix is stored column after column.
            let rows = body.pose.rotation.transpose();
            <[f64; 9]>::try_from(rows.as_slice()).unwrap_or_default()
        });
        let rotations: Vec<f64> = rotations.collect();
        let rotations: Bound<'_, PyArray4<f64>> = rotations.into_pyarray(py).reshape([frames.len(), bodies, 3, 3])?;
        let content = PyDict::new(py);
        content.set_item("bodies", self.bodies())?;
        content.set_item("rotation", rotations)?;
        content.set_item("origin", series(|body| body.pose.translation)?)?;
        content.set_item("center", series(|body| body.center)?)?;
        content.set_item("velocity", series(|body| body.twist.linear)?)?;
        content.set_item("angular_velocity", series(|body| body.twist.angular)?)?;
        content.set_item("acceleration", series(|body| body.acceleration.linear)?)?;
        content.set_item("angular_acceleration", series(|body| body.acceleration.angular)?)?;
        Ok(content)
    }

    fn fit_arrays<'py>(&self, py: Python<'py>, frames: usize, fit: MarkerFit) -> PyResult<Bound<'py, PyDict>> {
        let unknown = vec![f64::NAN; frames];
        let columns: Vec<&[f64]> =
            fit.motion.columns.iter().map(|column| column.as_deref().unwrap_or(&unknown)).collect();
        let content = PyDict::new(py);
        content.set_item("coordinates", self.coordinates())?;
        content.set_item("q", array_of(py, frames, columns.into_iter())?)?;
        content.set_item("rms", fit.rms_m.into_pyarray(py))?;
        content.set_item("converged", fit.converged.into_pyarray(py))?;
        Ok(content)
    }

    fn predicted_columns(
        &self,
        motion: [ArrayView2<'_, f64>; 3],
        rate: f64,
        motion_filter: Option<LowPass>,
        findings: &mut Findings,
    ) -> Result<Vec<(String, Vec<f64>)>, String> {
        let frames = motion[0].nrows();
        let trajectory = self.trajectory(motion, 0..frames, rate)?;
        let soles = Person::of_model(&self.model).soles;
        let settings = PredictSettings { motion_filter, ..PredictSettings::default() };
        let prediction =
            predict(&self.model, &trajectory, &soles, &settings, findings).map_err(|error| error.to_string())?;
        let mut columns = ground_columns(&feet(&self.model, &prediction.ground), frames);
        columns.extend(deviation_columns(&prediction.deviations, frames));
        Ok(columns)
    }
}

/// A range of the frames of a load.
fn part(load: &LoadSeries, rows: std::ops::Range<usize>) -> LoadSeries {
    LoadSeries { body: load.body, points: load.points[rows.clone()].to_vec(), wrenches: load.wrenches[rows].to_vec() }
}

/// The first number that is not finite: array, row, column.
fn not_finite(motion: &[ArrayView2<'_, f64>; 3]) -> Option<(&'static str, usize, usize)> {
    motion.iter().zip(["q", "qd", "qdd"]).find_map(|(array, name)| {
        let ((row, column), _) = array.indexed_iter().find(|(_, x)| !x.is_finite())?;
        Some((name, row, column))
    })
}

/// The smoother of these arguments.
fn asked(py: Python<'_>, filter: Option<&str>, cutoff: Option<Cutoff>, order: Option<usize>) -> PyResult<Smoother> {
    let smoother = smoother(filter, cutoff, order).map_err(|message| refused(py, message))?;
    Ok(smoother.unwrap_or(Settings::default().smoother))
}

fn check_rate(py: Python<'_>, rate: f64) -> PyResult<()> {
    if rate.is_finite() && rate > 0.0 {
        return Ok(());
    }
    Err(refused(py, format!("rate: found {rate} Hz; expected a finite frame rate above zero")))
}
