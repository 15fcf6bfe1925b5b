//! Frames of markers: their names, unit and axes, and the fit of the model to them.

use super::formats::{MarkerDescription, Message};
use crate::args::{LabAxes, MarkerUnit};
use ambulo::findings::Findings;
use ambulo::kinematics::marker_fit::{FitSettings, LiveMarkerFit};
use ambulo::kinematics::{Posture, body_motion};
use ambulo::model::{BodyId, Model};
use ambulo::numerics::{median, quantiles};
use ambulo::spatial::Vec3;
use anyhow::{Context, Result, bail};

/// Markers of a body that is followed are 1 to 4 cm from it. A fit is lost if a quarter of them is farther away [m].
const LOST_M: f64 = 0.1;

/// Postures in which a person is upright or not [s].
const JUDGED_S: f64 = 0.5;
/// Cosine of the largest inclination of the pelvis in walking: 60 degrees.
const LYING_COSINE: f64 = 0.5;

/// Factors of positions in millimetres or centimetres that are stated as metres, and of those in centimetres or metres
/// that are stated as millimetres.
const OTHER_UNITS: [f64; 5] = [1e-3, 1e-2, 10.0, 1e2, 1e3];

/// Outcome of a frame.
pub(super) enum Fitted {
    /// A value per coordinate.
    Posture(Vec<f64>),
    /// Too few markers are visible.
    TooFew,
    /// The markers are visible, but not where a body near the last posture can have them; so far from it is a quarter
    /// of them [m], if there is a posture at all.
    Lost(Option<f64>),
}

/// The markers of a frame and the fit.
pub(super) struct MarkerFrames {
    names: Vec<String>,
    unit: MarkerUnit,
    axes: LabAxes,
    rate_hz: f64,
    fit: LiveMarkerFit,
    /// Body and place in it of each marker; `None` for one that the model does not have.
    attached: Vec<Option<(BodyId, Vec3)>>,
    /// Positions of one frame, in the axes of the model [m].
    positions: Vec<Vec3>,
    /// Factor that corrects positions whose stated unit is wrong; `None` until it is determined.
    correction: Option<f64>,
    /// Cosines of the angle from upright of the first postures, until they are judged.
    upright: Option<Vec<f64>>,
}

impl MarkerFrames {
    /// All markers of the model, in its order.
    ///
    /// # Errors
    /// A model without markers on its bodies.
    pub(super) fn new(model: &Model, rate_hz: f64, unit: MarkerUnit, axes: LabAxes) -> Result<MarkerFrames> {
        let names: Vec<String> =
            model.markers().iter().filter(|marker| marker.body.is_some()).map(|marker| marker.name.clone()).collect();
        if names.is_empty() {
            bail!(
                "the model `{}` has no markers; expected a model that was calibrated with those of the recording. \
                 hint: `ambulo forces walk.c3d --static standing.c3d -o out` writes one, out/subject.osim",
                model.name()
            );
        }
        let fit = fit(model, &names, rate_hz, &mut Findings::default())?;
        let (attached, positions) = (attached(model, &names), Vec::new());
        Ok(MarkerFrames {
            attached,
            names,
            unit,
            axes,
            rate_hz,
            fit,
            positions,
            correction: None,
            upright: Some(Vec::new()),
        })
    }

    /// Number of values of a frame.
    pub(super) fn values(&self) -> usize {
        3 * self.names.len()
    }

    pub(super) fn description(&self) -> MarkerDescription {
        MarkerDescription { markers: self.names.clone(), unit: self.unit, axes: self.axes }
    }

    /// Sets the names of the markers, their unit and the axes of the laboratory. Returns what is to be known about
    /// markers that only model or stream have.
    ///
    /// # Errors
    /// A repeated name, or no name of the model; the state then does not change.
    pub(super) fn name_markers(&mut self, model: &Model, message: &Message) -> Result<Option<String>> {
        let mut findings = Findings::default();
        if let Some(names) = message.marker_names() {
            let mut sorted: Vec<&String> = names.iter().collect();
            sorted.sort_unstable();
            if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
                bail!("the marker `{}` is named twice; expected each name once", pair[0]);
            }
            self.fit = fit(model, names, self.rate_hz, &mut findings)?;
            self.attached = attached(model, names);
            self.names = names.to_vec();
        }
        (self.correction, self.upright) = (None, Some(Vec::new()));
        self.unit = message.unit.unwrap_or(self.unit);
        self.axes = message.axes.unwrap_or(self.axes);
        Ok(findings.as_slice().first().map(|finding| finding.message.clone()))
    }

    /// Begins again with another sequence.
    pub(super) fn restart(&mut self, model: &Model) -> Result<()> {
        self.fit = fit(model, &self.names, self.rate_hz, &mut Findings::default())?;
        Ok(())
    }

    /// Passes over frames that did not arrive.
    pub(super) fn skip(&mut self, frames: u64) {
        self.fit.skip(frames);
    }

    /// Checks the values of a frame: three per marker. A marker without all three is missing, and one at exactly 0 0 0,
    /// as some systems write it.
    ///
    /// # Errors
    /// Another number of values, an infinite one.
    pub(super) fn take(&mut self, values: &[Option<f64>]) -> Result<()> {
        let expected = self.names.len();
        if values.len() != self.values() {
            bail!("a frame with {} markers; expected {expected}, as they were named", values.len() as f64 / 3.0);
        }
        let axes = self.axes.world_from_lab() * (self.unit.metres() * self.correction.unwrap_or(1.0));
        self.positions.clear();
        for (name, place) in self.names.iter().zip(values.chunks_exact(3)) {
            let position = Vec3::from_iterator(place.iter().map(|value| value.unwrap_or(f64::NAN)));
            if position.iter().any(|value| value.is_infinite()) {
                bail!("marker `{name}` is at {place:?}; expected finite numbers, or none");
            }
            let is_seen = position.iter().all(|value| value.is_finite()) && position != Vec3::zeros();
            self.positions.push(if is_seen { axes * position } else { Vec3::repeat(f64::NAN) });
        }
        Ok(())
    }

    /// Corrects the unit of the frame that was taken, and of those after it, if the body would have an impossible size
    /// with the stated one, as the readers of files do. Returns what is to be known then.
    pub(super) fn correct_unit(&mut self, model: &Model) -> Option<String> {
        if self.correction.is_some() {
            return None;
        }
        let poses = model.poses(&model.coordinates().iter().map(|c| c.default_value).collect::<Vec<f64>>());
        let on_body = self.visible().map(|(_, body, local)| poses[body.index()].place(local));
        let expected_m = extent(&on_body.collect::<Vec<Vec3>>())?;
        let found_m = extent(&self.visible().map(|(place, ..)| place).collect::<Vec<Vec3>>())?;
        // A crouching or stretching person differs by less than a factor of two.
        let is_near = |factor: &f64| (0.3..3.2).contains(&(found_m * factor / expected_m));
        let factor = OTHER_UNITS.into_iter().find(is_near);
        self.correction = factor.or(Some(1.0));
        let factor = factor?;
        self.positions.iter_mut().for_each(|place| *place *= factor);
        let (unit, metres) = (self.unit.word(), self.unit.metres() * factor);
        Some(format!(
            "half of the markers are more than {found_m:.3} m from their middle, those of the model {expected_m:.3} m: \
             the positions are not in {unit} as stated; they are read as {metres} m each. hint: state the unit with \
             --unit or in the first line"
        ))
    }

    /// Judges whether the body is upright in its first postures; returns what is to be known if it is not.
    pub(super) fn judge_axes(&mut self, model: &Model, q: &[f64]) -> Option<String> {
        let upright = self.upright.as_mut()?;
        let defaults: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
        let root = |q: &[f64]| model.poses(q).first().map(|pose| pose.rotation);
        let turned = root(q)? * root(&defaults)?.transpose();
        upright.push(model.up().dot(&(turned * model.up())));
        if (upright.len() as f64) < JUDGED_S * self.rate_hz {
            return None;
        }
        let cosine = median(self.upright.take()?)?;
        (cosine < LYING_COSINE).then(|| {
            format!(
                "the pelvis is inclined by more than 60 deg: the person lies, or the axes of the laboratory are not \
                 {}. hint: state the axes that point forward and up with --axes or in the first line",
                self.axes
            )
        })
    }

    /// Fits the frame that was taken. After a fit that is lost, the next frame is fitted as the first one.
    pub(super) fn fit(&mut self, model: &Model) -> Result<Fitted> {
        let lost = match self.fit.push(&self.positions)?.map(<[f64]>::to_vec) {
            None if 2 * self.visible().count() < self.attached.iter().flatten().count() => return Ok(Fitted::TooFew),
            None => None,
            Some(q) => match self.quarter_beyond_m(model, &q) {
                Some(distance_m) if distance_m > LOST_M => Some(distance_m),
                _ => return Ok(Fitted::Posture(q)),
            },
        };
        self.restart(model)?;
        Ok(Fitted::Lost(lost))
    }

    /// The visible markers that the model has, each with its body and its place there.
    fn visible(&self) -> impl Iterator<Item = (Vec3, BodyId, Vec3)> {
        let pairs = self.positions.iter().zip(&self.attached).filter(|(place, _)| place.iter().all(|x| x.is_finite()));
        pairs.filter_map(|(place, at)| at.map(|(body, local)| (*place, body, local)))
    }

    /// The distance from the body that a quarter of the visible markers exceeds [m]; `None` where the posture is not
    /// known.
    fn quarter_beyond_m(&self, model: &Model, q: &[f64]) -> Option<f64> {
        let rest = vec![0.0; q.len()];
        let bodies = body_motion(model, Posture { q, qd: &rest, qdd: &rest });
        let distance =
            |(place, body, local): (Vec3, BodyId, Vec3)| (bodies[body.index()].pose.place(local) - place).norm();
        quantiles(self.visible().map(distance), [0.75]).map(|[beyond]| beyond)
    }
}

/// The median distance of points from their middle, by medians, which a stray marker does not move [m]; `None` for too
/// few points.
fn extent(points: &[Vec3]) -> Option<f64> {
    const FEWEST: usize = 4;
    let along = |axis: usize| median(points.iter().map(|point| point[axis]));
    let middle = Vec3::new(along(0)?, along(1)?, along(2)?);
    let distance = median(points.iter().map(|point| (point - middle).norm()))?;
    (points.len() >= FEWEST && distance > 0.0).then_some(distance)
}

/// Body and place of each marker.
fn attached(model: &Model, names: &[String]) -> Vec<Option<(BodyId, Vec3)>> {
    let of = |name: &String| {
        let marker = model.markers().iter().find(|marker| marker.name == *name)?;
        Some((marker.body?, marker.location))
    };
    names.iter().map(of).collect()
}

fn fit(model: &Model, names: &[String], rate_hz: f64, findings: &mut Findings) -> Result<LiveMarkerFit> {
    LiveMarkerFit::new(model, names, rate_hz, &FitSettings::default(), findings).context("the markers cannot be fitted")
}
