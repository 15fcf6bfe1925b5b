//! Options of `ambulo.forces` as a job, and dictionaries as requests of the other verbs.

use crate::failure::{exception, refused};
use ambulo::analysis::Adjustable;
use ambulo::job::{Filter, Job, MarkerFitting, ModelChoice, MuscleStatements, PlateFoot};
use ambulo::kinematics::calibration::{HipRegression, KneeAxis};
use ambulo::study::GroundSettings;
use ambulo_cli::{Outputs, Request};
use ambulo_results::{Convention, Keep};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use serde_json::{Number, Value};
use std::fmt::Display;
use std::path::PathBuf;
use std::str::FromStr;

/// A job, and what is written of its results.
#[derive(Default)]
pub(crate) struct Given {
    pub(crate) job: Job,
    pub(crate) outputs: Outputs,
}

/// An option: its name and its value, which is not None.
struct Named<'a, 'py> {
    name: &'a str,
    value: &'a Bound<'py, PyAny>,
}

impl Given {
    /// Makes a request from options by their names in Python. None and the defaults of Python are left out.
    pub(crate) fn of(options: &Bound<'_, PyDict>) -> PyResult<Given> {
        let mut request = Given::default();
        for (name, value) in options {
            let name: String = name.extract()?;
            let given = Named { name: &name, value: &value };
            let is_known = value.is_none()
                || request.take_file(&given)?
                || request.take_statement(&given)?
                || request.take_setting(&given)?;
            if !is_known {
                return Err(refused(options.py(), format!("found the option `{name}`, which `forces` does not have")));
            }
        }
        Ok(request)
    }

    /// The options of every trial of a folder, whose outputs are chosen by the verb.
    pub(crate) fn of_all(options: &Bound<'_, PyDict>) -> PyResult<Given> {
        match options.get_item("keep")?.filter(|keep| !keep.is_none()) {
            Some(_) => Err(refused(
                options.py(),
                "keep: trials have no folders of their own; expected it beside `options`".into(),
            )),
            None => Given::of(options),
        }
    }

    /// Takes the option if its value is a file.
    fn take_file(&mut self, given: &Named<'_, '_>) -> PyResult<bool> {
        let job = &mut self.job;
        let place = match given.name {
            "model" => {
                job.model = Some(ModelChoice::from(given.path()?));
                return Ok(true);
            }
            "setup" => {
                job.setups = given.list()?.iter().map(|given| given.path()).collect::<PyResult<_>>()?;
                return Ok(true);
            }
            "recording" => &mut job.recording,
            "static" => &mut job.standing,
            "functional" => &mut job.functional,
            "marker_set" => &mut job.marker_set,
            "smpl" => &mut job.smpl,
            "grf" => &mut job.forces.table,
            "loads" => &mut job.forces.loads,
            "person" => &mut job.person,
            "device" => &mut job.device,
            "thresholds" => &mut job.thresholds,
            _ => return Ok(false),
        };
        *place = Some(given.path()?);
        Ok(true)
    }

    /// Takes the option if it states something about the person or the laboratory.
    fn take_statement(&mut self, given: &Named<'_, '_>) -> PyResult<bool> {
        let job = &mut self.job;
        match given.name {
            "mass" => job.size.mass_kg = Some(given.number()?),
            "height" => job.size.height_m = Some(given.number()?),
            "trial" => job.trial = Some(given.text()?),
            "subject" => job.subject = Some(given.text()?),
            "figure" => job.segments = given.parsed()?,
            "markers" => job.markers = Some(given.path()?.display().to_string()),
            "right" => job.forces.right = Some(given.parsed()?),
            "left" => job.forces.left = Some(given.parsed()?),
            "heading" => job.sensors.heading = Some(given.parsed()?),
            "earth" => {
                let angles: Vec<String> = given.list()?.iter().map(|given| given.text()).collect::<PyResult<_>>()?;
                job.sensors.earth = Some(given.of_text(&angles.join(","))?);
            }
            "muscles" => job.muscles = given.muscles()?,
            "plates" => {
                let plates = given.value.cast::<PyDict>()?.iter();
                let plate = |(plate, foot): (Bound<'_, PyAny>, Bound<'_, PyAny>)| -> PyResult<PlateFoot> {
                    given.of_text(&format!("{}={}", plate.str()?, foot.str()?))
                };
                job.plates = plates.map(plate).collect::<PyResult<_>>()?;
            }
            "add_mass" => job.added_mass = given.list()?.iter().map(|given| given.parsed()).collect::<PyResult<_>>()?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Takes the option if it chooses how the recording is processed.
    fn take_setting(&mut self, given: &Named<'_, '_>) -> PyResult<bool> {
        let settings = &mut self.job.settings;
        match given.name {
            "predict" => return self.take_ground(given, GroundSettings::Predicted, given.switch()?),
            "track" => return self.take_ground(given, GroundSettings::Tracked, given.switch()?),
            "ground" => return self.take_ground(given, GroundSettings::NoContact, !given.switch()?),
            "refit" => settings.refit = given.switch()?,
            "fit" => settings.fit = Some(given.one_of(&MarkerFitting::ALL)?),
            "knee_axis" => settings.knee_axis = given.one_of(&KneeAxis::ALL)?,
            "hip" => settings.hip = given.one_of(&HipRegression::ALL)?,
            "max_gap" => settings.longest_gap_s = given.number()?,
            "start" => settings.window.from_s = Some(given.number()?),
            "end" => settings.window.to_s = Some(given.number()?),
            "rate" => settings.rate_hz = Some(given.number()?),
            "filter" => settings.filter = given.one_of(&Filter::ALL)?,
            "cutoff" => settings.cutoff = Some(given.parsed()?),
            "force_cutoff" => settings.force_cutoff = Some(given.parsed()?),
            "force_delay" => settings.force_delay_s = given.number()?,
            "order" => settings.order = given.parsed()?,
            "consistent" => {
                settings.residual_reduction = match given.value.cast::<PyBool>() {
                    Ok(switch) => switch.is_true().then_some(Adjustable::MotionAndBody),
                    Err(_) => Some(given.one_of(&Adjustable::ALL)?),
                }
            }
            "convention" => {
                let words = [Convention::Clinical, Convention::Opensim].map(|known| (known.word(), known));
                self.outputs.convention = given.one_of(&words)?;
            }
            "keep" => {
                let known = Keep::OF_RUNS.map(|name| (name, name));
                let name = |given: Named<'_, '_>| given.one_of(&known).map(str::to_owned);
                self.outputs.keep = given.list()?.iter().map(name).collect::<PyResult<_>>()?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn take_ground(&mut self, given: &Named<'_, '_>, ground: GroundSettings, is_chosen: bool) -> PyResult<bool> {
        let chosen = &mut self.job.settings.ground;
        if is_chosen && *chosen != GroundSettings::default() {
            return Err(given.refused("predict, track and ground=False exclude each other"));
        }
        if is_chosen {
            *chosen = ground;
        }
        Ok(true)
    }
}

impl Named<'_, '_> {
    fn refused(&self, what: impl Display) -> PyErr {
        refused(self.value.py(), format!("{}: {what}", self.name))
    }

    fn text(&self) -> PyResult<String> {
        Ok(self.value.str()?.to_string())
    }

    fn of_text<T: FromStr<Err: Display>>(&self, text: &str) -> PyResult<T> {
        text.parse().map_err(|error| self.refused(format!("found `{text}`; {error}")))
    }

    fn parsed<T: FromStr<Err: Display>>(&self) -> PyResult<T> {
        self.of_text(&self.text()?)
    }

    fn number(&self) -> PyResult<f64> {
        let is_number = self.value.is_instance_of::<PyFloat>() || self.value.is_instance_of::<PyInt>();
        if is_number { self.value.extract() } else { self.parsed() }
    }

    fn switch(&self) -> PyResult<bool> {
        self.value.is_truthy()
    }

    /// True for the defaults, or a dictionary of what differs from them, as in docs/REQUESTS.md.
    fn muscles(&self) -> PyResult<Option<MuscleStatements>> {
        match self.value.cast::<PyDict>() {
            Ok(stated) => serde_json::from_value(json(stated)?).map(Some).map_err(|error| self.refused(error)),
            Err(_) => Ok(self.switch()?.then(MuscleStatements::default)),
        }
    }

    fn path(&self) -> PyResult<PathBuf> {
        self.value.extract()
    }

    fn one_of<T: Copy>(&self, words: &[(&'static str, T)]) -> PyResult<T> {
        let text = self.text()?;
        words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value).ok_or_else(|| {
            let known = words.iter().map(|(word, _)| *word).collect::<Vec<_>>().join(", ");
            self.refused(format!("found `{text}`; expected one of {known}"))
        })
    }
}

impl<'a, 'py> Named<'a, 'py> {
    /// The items of a sequence; a value that is no list or tuple is the only one.
    fn list(&self) -> PyResult<Items<'a, 'py>> {
        let is_list = self.value.is_instance_of::<PyList>() || self.value.is_instance_of::<PyTuple>();
        let items = match is_list {
            true => self.value.try_iter()?.collect::<PyResult<_>>()?,
            false => vec![self.value.clone()],
        };
        Ok(Items { name: self.name, items })
    }
}

/// Values of an option.
struct Items<'a, 'py> {
    name: &'a str,
    items: Vec<Bound<'py, PyAny>>,
}

impl<'py> Items<'_, 'py> {
    fn iter(&self) -> impl Iterator<Item = Named<'_, 'py>> {
        self.items.iter().map(|value| Named { name: self.name, value })
    }
}

/// The request that a dictionary describes, as docs/REQUESTS.md; None leaves a field out.
pub(crate) fn typed(request: &Bound<'_, PyDict>) -> PyResult<Request> {
    Request::of_value(&json(request)?).map_err(|failure| exception(request.py(), failure))
}

/// A value as JSON: paths are text; numbers may be NumPy numbers.
fn json(value: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Ok(fields) = value.cast::<PyDict>() {
        let fields = fields.iter().filter(|(_, value)| !value.is_none());
        return fields.map(|(name, value)| Ok((name.extract::<String>()?, json(&value)?))).collect();
    }
    if let Ok(switch) = value.cast::<PyBool>() {
        return Ok(switch.is_true().into());
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        return value.try_iter()?.map(|item| json(&item?)).collect();
    }
    match value.extract::<i64>() {
        Ok(whole) => Ok(whole.into()),
        Err(_) if value.is_instance_of::<PyString>() => text(value),
        Err(_) => value.extract::<f64>().map_or_else(|_| text(value), |number| finite(value, number)),
    }
}

fn finite(value: &Bound<'_, PyAny>, number: f64) -> PyResult<Value> {
    let number = Number::from_f64(number);
    number.map(Value::Number).ok_or_else(|| refused(value.py(), format!("found {value}; expected a finite number")))
}

/// Text or a path.
fn text(value: &Bound<'_, PyAny>) -> PyResult<Value> {
    let path: PathBuf = value.extract()?;
    path.into_os_string()
        .into_string()
        .map(Value::String)
        .map_err(|path| refused(value.py(), format!("found the path {}; expected letters of Unicode", path.display())))
}
