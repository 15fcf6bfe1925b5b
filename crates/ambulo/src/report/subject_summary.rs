//! How markers became a body in motion: `subject` of `summary.json` (docs/OUTPUTS.md).

use crate::kinematics::marker_fit::MarkerFit;
use serde::Serialize;

/// How markers became a body in motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SubjectSummary {
    /// How the laboratory's axes and unit were turned into the world's, in one line.
    pub axes: String,
    /// The sets of markers whose names were found; none with an OpenSim model.
    pub marker_sets: Vec<String>,
    /// How well the body follows the markers.
    pub markers: MarkersSummary,
    /// What the built-in body assumes of this person, in sentences.
    pub assumptions: Vec<String>,
}

/// How well a body follows markers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MarkersSummary {
    /// Mean over the frames of the root mean square distance of the markers [mm].
    pub rms_mm: Option<f64>,
    /// Frames in which the iteration did not come to rest.
    pub frames_not_converged: usize,
    /// Each marker.
    pub errors: Vec<MarkerErrorSummary>,
}

/// How far one marker stayed from its place on the body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MarkerErrorSummary {
    /// Name of the marker.
    pub name: String,
    /// Root mean square [mm]; `null` if it was never used.
    pub rms_mm: Option<f64>,
    /// Largest [mm].
    pub max_mm: Option<f64>,
    /// Frames in which it was seen.
    pub frames_seen: usize,
    /// Frames in which it was seen and not believed.
    pub frames_refused: usize,
}

impl SubjectSummary {
    /// Of a body that was fitted to markers.
    #[must_use]
    pub fn new(axes: &str, sets: &[String], fit: &MarkerFit, assumptions: &[String]) -> SubjectSummary {
        SubjectSummary {
            axes: axes.to_owned(),
            marker_sets: sets.to_vec(),
            markers: MarkersSummary::new(fit),
            assumptions: assumptions.to_vec(),
        }
    }
}

impl MarkersSummary {
    fn new(fit: &MarkerFit) -> MarkersSummary {
        let millimetres = |m: f64| m.is_finite().then_some(1e3 * m);
        let seen: Vec<f64> = fit.rms_m.iter().copied().filter(|rms| rms.is_finite()).collect();
        let errors = fit.errors.iter().map(|error| MarkerErrorSummary {
            name: error.name.clone(),
            rms_mm: millimetres(error.rms_m),
            max_mm: millimetres(error.max_m),
            frames_seen: error.seen,
            frames_refused: error.down_weighted,
        });
        MarkersSummary {
            rms_mm: millimetres(seen.iter().sum::<f64>() / seen.len() as f64),
            frames_not_converged: fit.converged.iter().filter(|converged| !**converged).count(),
            errors: errors.collect(),
        }
    }
}
