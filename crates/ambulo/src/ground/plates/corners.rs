//! Finds the order of a plate's corners by the feet.
//!
//! FORCE_PLATFORM:CORNERS states the axes of a plate by the order of its corners. Of the eight orders that keep
//! neighbours ([`CORNER_ORDERS`]) the true one puts the centre of pressure under the foot that stands on the plate, at
//! a distance d from the line from heel to toe. The others turn or reverse its path about the middle of the plate.
//! Where the foot crosses the middle this is not enough; but the horizontal force leads towards the mass centre in
//! every step ([`LeverRule`]; the middle of the pelvis stands for the mass centre), along the foot with the agreement
//! r₁ and across it with r₂, and the centre of pressure moves along the foot as the pelvis does, with the correlation
//! s.
//!
//! ```text
//! cost = (d / 30 mm)² + ((1 - r₁) / 0.3)² + ((1 - r₂) / 0.5)²
//! ```
//!
//! In 194 plates of 111 clean recordings (9 laboratories) d is 3 to 29 mm, r₁ 0.85 to 1, r₂ 0.5 to 1 with one exception
//! each, and the true order has the least cost of the eight in all of them.
//!
//! An order is changed only if the file's order fails clearly, also by its centre of pressure: a channel with the wrong
//! sign alone is no matter of corners. All plates are judged together first, because a laboratory makes the same error
//! with all of them, then each alone.
//! Pinned by: tests/plate_orders.rs

use super::super::lever_rule::LeverRule;
use super::feet::FeetInMotion;
use crate::findings::{Code, Findings};
use crate::ground::phases::contacts_from_force;
use crate::model::Side;
use crate::motion::PlateRecording;
use crate::motion::force_plate::CORNER_ORDERS;
use crate::numerics::Order;

/// Deviations of the right order: distance [m], correlation along the foot and across it.
const DEVIATIONS: [f64; 3] = [0.03, 0.3, 0.5];
/// The stated order fails if another has a cost that is less by this: three deviations.
const FAILS: f64 = 9.0;
/// ... and a centre of pressure that is nearer to the feet by this [m]. Wrong signs of channels move it by up to 15 mm.
const NEARER_M: f64 = 0.02;
/// The same distance, by the error of markers and of the line of the foot [m].
const SAME_M: f64 = 0.005;
/// The centre of pressure leads along the foot, or back, by this correlation with the pelvis: in clean recordings it is
/// above 0.8.
const LEADS: f64 = 0.5;
/// An order is right below this cost and this distance [m].
const RIGHT: f64 = 12.0;
const RIGHT_M: f64 = 0.05;
/// The cost of the right order is at least this much below the cost of the next order.
const DISTINCT: f64 = 1.0;
/// Distances are counted up to this [m].
const FARTHEST_M: f64 = 0.4;
/// Shortest and longest step [s]. Two feet that stand on one plate have their centre of pressure between them.
const STEP_S: [f64; 2] = [0.15, 1.6];
/// Loads from this share of the largest force of the plates show the centre of pressure.
const SOLID: f64 = 0.3;
/// Number of samples evaluated per step.
const SAMPLES: usize = 40;

/// Fit of the loads of some plates to the feet, with one order of corners.
#[derive(Debug, Clone, Copy, Default)]
struct Fit {
    /// Sum of the distances from the nearer foot [m], and their number.
    distance: f64,
    count: f64,
    /// Agreement of the horizontal force along the foot (0) and across it (1).
    lever: LeverRule,
    path: Path,
}

/// Sums for the correlation of the centre of pressure with the pelvis, along the foot.
#[derive(Debug, Clone, Copy, Default)]
struct Path {
    count: f64,
    /// Of the places of both along the foot [m].
    sums: [f64; 2],
    /// Of their squares, and of their product [m²].
    squares: [f64; 2],
    product: f64,
}

impl Path {
    fn add(&mut self, [pressure, body]: [f64; 2]) {
        self.count += 1.0;
        self.sums = [self.sums[0] + pressure, self.sums[1] + body];
        self.squares = [self.squares[0] + pressure * pressure, self.squares[1] + body * body];
        self.product += pressure * body;
    }

    fn correlation(&self) -> f64 {
        let mean = self.sums.map(|sum| sum / self.count);
        let spread = [0, 1].map(|k| (self.squares[k] - self.count * mean[k] * mean[k]).max(0.0));
        (self.product - self.count * mean[0] * mean[1]) / (spread[0] * spread[1]).sqrt()
    }
}

impl Fit {
    fn distance_m(&self) -> f64 {
        self.distance / self.count
    }

    /// The squared deviation from a right order; what is not known does not count.
    fn cost(&self) -> f64 {
        let off = [self.distance_m(), 1.0 - self.lever.agreement(0), 1.0 - self.lever.agreement(1)];
        let squares = off.iter().zip(DEVIATIONS).map(|(off, deviation)| (off / deviation).powi(2));
        squares.filter(|square| square.is_finite()).sum()
    }

    fn is_right(&self) -> bool {
        self.cost() < RIGHT && self.distance_m() < RIGHT_M
    }
}

/// A plate with loads of whole steps.
struct Loaded {
    plate: usize,
    /// Fits, one per order of the corners.
    fits: Vec<Fit>,
    /// Whether the file has the force of the foot on the plate, so that all signs were reversed.
    is_reversed: bool,
}

/// The plates with corners in the order that puts their loads under the feet.
pub(super) fn in_order(
    feet: &FeetInMotion<'_>,
    mut plates: Vec<PlateRecording>,
    findings: &mut Findings,
) -> Vec<PlateRecording> {
    let highest = plates.iter().map(PlateRecording::peak_n).fold(0.0, f64::max);
    let is_reversed = |i: usize| {
        let own = format!("force of {} points", plates[i].name);
        findings.as_slice().iter().any(|f| f.code == Code::PlatesForceOnPlate && f.message.contains(&own))
    };
    let loaded: Vec<Loaded> = (0..plates.len())
        .filter_map(|i| Some(Loaded { is_reversed: is_reversed(i), ..loaded(feet, &plates, i, SOLID * highest)? }))
        .collect();
    let together = better_order(&loaded.iter().collect::<Vec<_>>());
    for own in &loaded {
        let Loaded { plate, fits, .. } = own;
        let found = together.or_else(|| better_order(&[own]));
        let Some((order, is_distinct)) = found else { continue };
        match plates[*plate].with_corners(CORNER_ORDERS[order]).filter(|_| is_distinct) {
            Some(ordered) => {
                report_ordered(&plates[*plate].name, fits, order, findings);
                plates[*plate] = ordered;
            }
            None => report_unclear(&plates[*plate].name, fits, findings),
        }
    }
    plates
}

/// The fits of a plate in all orders; `None` without whole steps that markers of feet show.
fn loaded(feet: &FeetInMotion<'_>, plates: &[PlateRecording], plate: usize, solid_n: f64) -> Option<Loaded> {
    let samples = samples(&plates[plate], solid_n);
    let excerpt = excerpt(&plates[plate], &samples);
    let fits: Option<Vec<Fit>> =
        CORNER_ORDERS.into_iter().map(|order| Some(fit(feet, &excerpt.with_corners(order)?))).collect();
    fits.filter(|fits| fits.iter().all(|fit| fit.count > 0.0)).map(|fits| Loaded { plate, fits, is_reversed: false })
}

/// The order that is right for all of these plates where the file's order fails, and whether it is the only one.
fn better_order(plates: &[&Loaded]) -> Option<(usize, bool)> {
    let is_right = |order: &usize| plates.iter().all(|plate| plate.fits[*order].is_right());
    // The centre of pressure runs from heel to toe; no wrong sign of a force turns its way round.
    let runs_back = |order: usize| plates.iter().all(|plate| plate.fits[order].path.correlation() < -LEADS);
    let runs_forth = |order: usize| plates.iter().all(|plate| plate.fits[order].path.correlation() > LEADS);
    // Reversed corners reverse the vertical force and one horizontal one: two wrong signs with one cause.
    let turns_over = |order: usize| order >= 4 && plates.iter().all(|plate| plate.is_reversed);
    let cost = |order: usize| plates.iter().map(|plate| plate.fits[order].cost()).sum::<f64>();
    let away_m = |order: usize| plates.iter().map(|plate| plate.fits[order].distance_m()).sum::<f64>();
    let mut right: Vec<usize> = (0..CORNER_ORDERS.len()).filter(is_right).collect();
    right.sort_by_number(|order| cost(*order));
    let best = *right.first().filter(|_| !plates.is_empty())?;
    let nearer_m = (away_m(0) - away_m(best)) / plates.len() as f64;
    let is_moved = nearer_m > NEARER_M || runs_back(0) && runs_forth(best) || turns_over(best) && nearer_m > -SAME_M;
    let fails = cost(0) > cost(best) + FAILS && is_moved;
    let is_distinct = right.get(1).is_none_or(|next| cost(*next) > cost(best) + DISTINCT);
    fails.then_some((best, is_distinct))
}

/// Well-loaded samples of whole steps.
fn samples(plate: &PlateRecording, solid_n: f64) -> Vec<usize> {
    let vertical: Vec<f64> = (0..plate.times.len()).map(|i| plate.vertical(i)).collect();
    let (Some(&first), Some(&last)) = (plate.times.first(), plate.times.last()) else { return Vec::new() };
    // A step may be cut by one end of the recording; a person who stands is cut by both.
    let steps = contacts_from_force(&plate.times, &vertical).into_iter().filter(|c| c.strike_s.or(c.off_s).is_some());
    let steps = steps.map(|c| c.span(first, last));
    let of_step = |[from, to]: [f64; 2]| {
        let range = plate.times.partition_point(|t| *t < from)..plate.times.partition_point(|t| *t <= to);
        range.clone().step_by((range.len() / SAMPLES).max(1)).filter(|i| vertical[*i] > solid_n).collect::<Vec<_>>()
    };
    steps.filter(|[from, to]| (STEP_S[0]..=STEP_S[1]).contains(&(to - from))).flat_map(of_step).collect()
}

/// The plate at some of its samples.
fn excerpt(plate: &PlateRecording, samples: &[usize]) -> PlateRecording {
    PlateRecording {
        times: samples.iter().map(|i| plate.times[*i]).collect(),
        force: samples.iter().map(|i| plate.force[*i]).collect(),
        moment: samples.iter().map(|i| plate.moment[*i]).collect(),
        name: plate.name.clone(),
        clipped: Vec::new(),
        ..*plate
    }
}

/// Fit of the loads of all samples.
fn fit(feet: &FeetInMotion<'_>, plate: &PlateRecording) -> Fit {
    let mut fit = Fit::default();
    for i in 0..plate.times.len() {
        let (time_s, center) = (plate.times[i], plate.center_of_pressure(i));
        let distance = |side: Side| Some((feet.level_distance(side, center, plate.up, time_s)?, side));
        let nearest = Side::BOTH.into_iter().filter_map(distance).min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((nearest_m, side)) = nearest else { continue };
        fit.distance += nearest_m.min(FARTHEST_M);
        fit.count += 1.0;
        let (Some(body), Some(along)) = (feet.body_center(time_s), feet.direction(side, plate.up, time_s)) else {
            continue;
        };
        fit.lever.add(plate.force[i], body - center, plate.up, [along, plate.up.cross(&along)]);
        if let Some([heel, _]) = feet.line(side, time_s) {
            fit.path.add([center, body].map(|place| (place - heel).dot(&along)));
        }
    }
    fit
}

fn words(order: usize) -> String {
    CORNER_ORDERS[order].map(|corner| (corner + 1).to_string()).join(" ")
}

fn report_ordered(name: &str, fits: &[Fit], order: usize, findings: &mut Findings) {
    let [stated_mm, used_mm] = [0, order].map(|order| 1e3 * fits[order].distance_m());
    let kind = if order < 4 { "turned" } else { "reversed" };
    let message = format!(
        "{name}: with its corners in the order of the file the centre of pressure lies {stated_mm:.0} mm from the \
         feet, with the corners {kind} ({}) {used_mm:.0} mm; of the eight orders of four corners this one was used. \
         hint: correct FORCE_PLATFORM:CORNERS in the file",
        words(order)
    );
    findings.report(Code::PlatesCornersOrdered, message);
    if order >= 4 {
        // Reversed corners turn the plate upside down, which looks like the force of the foot on the plate.
        findings.withdraw(Code::PlatesForceOnPlate, |message| message.contains(&format!("force of {name} points")));
    }
    findings.withdraw(Code::PlatesCenterOutside, |message| message.contains(&format!("pressure of {name} lies")));
}

fn report_unclear(name: &str, fits: &[Fit], findings: &mut Findings) {
    let orders: Vec<String> =
        (0..fits.len()).filter(|k| fits[*k].is_right()).map(|k| format!("({})", words(k))).collect();
    let message = format!(
        "{name}: with its corners in the order of the file the centre of pressure lies {:.0} mm from the feet; the \
         orders {} put it under them, so the order in the file is wrong, but it is not clear which one is right. \
         hint: correct FORCE_PLATFORM:CORNERS in the file",
        1e3 * fits[0].distance_m(),
        orders.join(", ")
    );
    findings.report(Code::PlatesCornersUnclear, message);
}
