//! How well a body follows its markers, by region of the body.
//!
//! Moments of the legs follow from legs, pelvis and measured ground forces, whatever trunk and arms do, and arms carry
//! a fiftieth of the weight in the fit. Each region is therefore judged by its own markers.
//!
//! r² = Σ w_m n_m r_m² / Σ w_m n_m over the markers m of a region, where r_m is the root mean square distance of a
//! marker and n_m the number of frames in which it was used. On the trunk w_m is the weight in the fit, because
//! shoulders and head move on it by centimetres without a joint of the body; elsewhere it is 1.
//!
//! Pinned by: tests/region_fit.rs

use crate::kinematics::marker_fit::{MarkerFit, MarkerResidual};
use crate::model::{Model, Region};
use crate::numerics::Order;
use std::collections::BTreeMap;

/// Distances of the markers of a region from the body.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionFit {
    /// The region.
    pub region: Region,
    /// Names of the coordinates of its joints.
    pub coordinates: Vec<String>,
    /// Root mean square over markers and frames, on the trunk weighted as in the fit [m].
    pub rms_m: f64,
    /// Names of the markers that were used, with their root mean square distances [m], the farthest first.
    pub markers: Vec<(String, f64)>,
}

/// Markers named in messages.
const NAMED: usize = 3;

impl RegionFit {
    /// The fit of each region that has markers, in the order of [`Region::ALL`].
    /// `weights` of the markers in the fit are 1 for those that are not listed.
    pub(super) fn of(model: &Model, fit: &MarkerFit, weights: &BTreeMap<String, f64>) -> Vec<RegionFit> {
        Region::ALL.into_iter().filter_map(|region| RegionFit::of_region(model, fit, weights, region)).collect()
    }

    fn of_region(model: &Model, fit: &MarkerFit, weights: &BTreeMap<String, f64>, region: Region) -> Option<RegionFit> {
        let is_own = |residual: &&MarkerResidual| {
            let marker = model.markers().iter().find(|marker| marker.name == residual.name);
            let body = marker.and_then(|marker| marker.body);
            residual.rms_m.is_finite() && body.is_some_and(|body| Region::of(model, body) == region)
        };
        let own: Vec<&MarkerResidual> = fit.errors.iter().filter(is_own).collect();
        let weight = |residual: &MarkerResidual| match region {
            Region::Trunk => weights.get(&residual.name).copied().unwrap_or(1.0),
            _ => 1.0,
        };
        let frames = |residual: &MarkerResidual| residual.seen.saturating_sub(residual.down_weighted) as f64;
        let share = |residual: &MarkerResidual| weight(residual) * frames(residual);
        let all: f64 = own.iter().map(|residual| share(residual)).sum();
        let square: f64 = own.iter().map(|residual| share(residual) * residual.rms_m.powi(2)).sum();
        let mut markers: Vec<(String, f64)> = own.iter().map(|own| (own.name.clone(), own.rms_m)).collect();
        markers.sort_by_number(|(_, rms_m)| -rms_m);
        let rms_m = (square / all).sqrt();
        (all > 0.0).then(|| RegionFit { region, coordinates: coordinates(model, region), rms_m, markers })
    }

    /// As a part of a sentence: region, distance and the farthest markers.
    pub(super) fn words(&self) -> String {
        let shown = |(name, rms_m): &(String, f64)| format!("`{name}` {:.0} mm", 1e3 * rms_m);
        let farthest: Vec<String> = self.markers.iter().take(NAMED).map(shown).collect();
        format!(
            "the markers of {} are {:.0} mm from the body (rms; farthest {})",
            self.region.words(),
            1e3 * self.rms_m,
            farthest.join(", ")
        )
    }
}

fn coordinates(model: &Model, region: Region) -> Vec<String> {
    let own = model.coordinate_ids().filter(|id| Region::of_coordinate(model, *id) == Some(region));
    own.map(|id| model.coordinates()[id.index()].name.clone()).collect()
}
