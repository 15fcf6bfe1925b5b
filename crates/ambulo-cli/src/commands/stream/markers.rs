//! Frames of markers: their names, unit and axes, and the fit of the model to them.

use super::formats::{MarkerDescription, Message};
use crate::args::{LabAxes, MarkerUnit};
use ambulo::findings::Findings;
use ambulo::kinematics::marker_fit::{FitSettings, LiveMarkerFit};
use ambulo::model::Model;
use ambulo::spatial::Vec3;
use anyhow::{Context, Result, bail};

/// The markers of a frame and the fit.
pub(super) struct MarkerFrames {
    names: Vec<String>,
    unit: MarkerUnit,
    axes: LabAxes,
    rate_hz: f64,
    fit: LiveMarkerFit,
    /// Positions of one frame, in the axes of the model [m].
    positions: Vec<Vec3>,
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
                "the model `{}` has no markers; expected a model that was calibrated with those of the recording. hint: `ambulo forces walk.c3d --static standing.c3d -o out` writes one, out/subject.osim",
                model.name()
            );
        }
        let fit = fit(model, &names, rate_hz, &mut Findings::default())?;
        Ok(MarkerFrames { names, unit, axes, rate_hz, fit, positions: Vec::new() })
    }

    /// Number of values of a frame.
    pub(super) fn values(&self) -> usize {
        3 * self.names.len()
    }

    pub(super) fn description(&self) -> MarkerDescription {
        MarkerDescription { markers: self.names.clone(), unit: self.unit, axes: self.axes }
    }

    /// Sets the names of the markers, their unit and the axes of the laboratory. Returns what is to be known about markers that only model or stream
    /// have.
    ///
    /// # Errors
    /// A name twice, or none that the model has; nothing is changed then.
    pub(super) fn name_markers(&mut self, model: &Model, message: &Message) -> Result<Option<String>> {
        let mut findings = Findings::default();
        if let Some(names) = message.marker_names() {
            let mut sorted: Vec<&String> = names.iter().collect();
            sorted.sort_unstable();
            if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
                bail!("the marker `{}` is named twice; expected each name once", pair[0]);
            }
            self.fit = fit(model, names, self.rate_hz, &mut findings)?;
            self.names = names.to_vec();
        }
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

    /// Checks the values of a frame: three per marker; a marker without all three is missing.
    ///
    /// # Errors
    /// Another number of values, an infinite one.
    pub(super) fn take(&mut self, values: &[Option<f64>]) -> Result<()> {
        let expected = self.names.len();
        if values.len() != self.values() {
            bail!("a frame with {} markers; expected {expected}, as they were named", values.len() as f64 / 3.0);
        }
        let axes = self.axes.world_from_lab() * self.unit.metres();
        self.positions.clear();
        for (name, place) in self.names.iter().zip(values.chunks_exact(3)) {
            let position = Vec3::from_iterator(place.iter().map(|value| value.unwrap_or(f64::NAN)));
            if position.iter().any(|value| value.is_infinite()) {
                bail!("marker `{name}` is at {place:?}; expected finite numbers, or none");
            }
            let is_seen = position.iter().all(|value| value.is_finite());
            self.positions.push(if is_seen { axes * position } else { Vec3::repeat(f64::NAN) });
        }
        Ok(())
    }

    /// Fits the frame that was taken; `None` if too few markers are visible.
    pub(super) fn fit(&mut self) -> Result<Option<Vec<f64>>> {
        Ok(self.fit.push(&self.positions)?.map(<[f64]>::to_vec))
    }
}

fn fit(model: &Model, names: &[String], rate_hz: f64, findings: &mut Findings) -> Result<LiveMarkerFit> {
    LiveMarkerFit::new(model, names, rate_hz, &FitSettings::default(), findings).context("the markers cannot be fitted")
}
