//! A person at some instants of a gait cycle, seen from the right, as SVG: the shapes of the 3-D view, projected.

use crate::page::ViewShape;
use crate::stage::{BodyPath, Stage, StageBody};
use crate::style::{Style, style};
use ambulo::analysis::Cycle;
use ambulo::model::Side;
use ambulo::numerics::Order;
use ambulo::spatial::Vec3;
use ambulo::study::Outcome;
use nalgebra::{Quaternion, UnitQuaternion};
use std::fmt::Write;

/// Instants of the figures [% of the cycle].
const INSTANTS: [f64; 7] = [0.0, 12.0, 31.0, 50.0, 62.0, 81.0, 100.0];
/// Pixels per metre; space per figure, height above the ground and below it [m].
const SCALE: f64 = 100.0;
const APART: f64 = 0.8;
const BELOW: f64 = 0.2;
/// Shorter paths show no direction [m].
const SHORTEST_M: f64 = 0.2;

/// The person over the middle cycle of the right foot, or of the left one; `None` without a cycle.
pub(super) fn walk_strip(outcome: &Outcome) -> Option<String> {
    let cycles = &outcome.analysis.cycles;
    let of = |side: Side| cycles.iter().filter(move |cycle| cycle.side == side);
    let side = if of(Side::Right).next().is_some() { Side::Right } else { Side::Left };
    let cycle = of(side).nth(of(side).count() / 2)?;
    let stage = Stage::of_motion(&outcome.body, &outcome.analysis.trajectory, outcome.height_m());
    let style = style().ok()?;
    Some(Strip { stage: &stage, style }.svg(cycle)).filter(|svg| svg.contains("<path"))
}

struct Strip<'a> {
    stage: &'a Stage,
    style: &'a Style,
}

/// The vertical plane of the path, through a point.
#[derive(Clone, Copy)]
struct Plane {
    forward: Vec3,
    centre: Vec3,
    floor_m: f64,
}

impl Plane {
    /// Forward and up [px].
    fn place(&self, point: &Vec3) -> [f64; 2] {
        [SCALE * self.forward.dot(&(point - self.centre)), -SCALE * (point.y - self.floor_m)]
    }
}

impl Strip<'_> {
    fn svg(&self, cycle: &Cycle) -> String {
        let grid = self.stage.grid;
        let frame = |percent: f64| {
            let time = cycle.start_s + 0.01 * percent * (cycle.end_s - cycle.start_s);
            (((time - grid.start_s) / grid.step_s).round().max(0.0) as usize).min(grid.frames.saturating_sub(1))
        };
        let Some(root) = self.stage.bodies.first().map(|body| &body.path) else { return String::new() };
        let forward = forward(root, [frame(0.0), frame(100.0)]);
        let tops = INSTANTS.map(|percent| root.position[frame(percent)].y - self.stage.floor_m);
        // The pelvis is at a little more than half of the stature.
        let height = 2.05 * tops.into_iter().fold(0.3, f64::max);
        let apart = SCALE * APART * height / 1.7;
        let (wide, high) = (apart * INSTANTS.len() as f64, SCALE * (height + BELOW));
        let mut svg = format!(
            "<svg class=\"strip\" role=\"img\" aria-label=\"The person over a gait cycle\" viewBox=\"0 {:.0} {wide:.0} \
             {high:.0}\" font-family=\"sans-serif\" font-size=\"10\"><path d=\"M0 0H{wide:.0}\" stroke=\"{}\"/>",
            -SCALE * height,
            self.style.quiet.color
        );
        for (k, percent) in INSTANTS.into_iter().enumerate() {
            let (x, frame) = (apart * (k as f64 + 0.5), frame(percent));
            let plane = Plane { forward, centre: root.position[frame], floor_m: self.stage.floor_m };
            let _ = write!(svg, "<g transform=\"translate({x:.1} 0)\" stroke-linecap=\"round\">");
            for side in [Some(Side::Left), None, Some(Side::Right)] {
                let of_side = self.stage.bodies.iter().filter(|body| body.side == side);
                of_side.for_each(|body| self.body(&mut svg, body, frame, plane));
            }
            let _ = write!(
                svg,
                "<text y=\"14\" text-anchor=\"middle\" fill=\"{}\">{percent:.0} %</text></g>",
                self.style.quiet.color
            );
        }
        svg + "</svg>"
    }

    fn body(&self, svg: &mut String, body: &StageBody, frame: usize, plane: Plane) {
        let color = body.side.map_or("#8a9199", |side| &self.style.side(side).color);
        let at = |point: [f64; 3]| plane.place(&body.path.place(frame, Vec3::from(point)));
        for shape in &body.shapes {
            match shape {
                ViewShape::Capsule { from, to, radius } => {
                    let ([x, y], [u, v]) = (at(*from), at(*to));
                    // A line of no length is not drawn by every program.
                    let u = if (x - u).abs() + (y - v).abs() < 0.05 { u + 0.05 } else { u };
                    let wide = 2.0 * SCALE * radius;
                    let _ = write!(
                        svg,
                        "<path d=\"M{x:.1} {y:.1}L{u:.2} {v:.1}\" stroke=\"{color}\" stroke-width=\"{wide:.1}\"/>"
                    );
                }
                ViewShape::Box { center, half, turn } => {
                    let turn = UnitQuaternion::new_normalize(Quaternion::from_vector((*turn).into()));
                    let corner = |k: usize| {
                        let sign = |bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
                        let own = Vec3::new(sign(0) * half[0], sign(1) * half[1], sign(2) * half[2]);
                        at((Vec3::from(*center) + turn * own).into())
                    };
                    polygon(svg, &hull((0..8).map(corner).collect()), color);
                }
                ViewShape::Mesh { points, .. } => polygon(svg, &hull(points.iter().map(|p| at(*p)).collect()), color),
            }
        }
    }
}

/// Unit vector along the path of the body between two frames, level; x if it stays where it is.
fn forward(root: &BodyPath, [from, to]: [usize; 2]) -> Vec3 {
    let way = root.position[to] - root.position[from];
    let level = Vec3::new(way.x, 0.0, way.z);
    if level.norm() > SHORTEST_M { level / level.norm() } else { Vec3::x() }
}

fn polygon(svg: &mut String, corners: &[[f64; 2]], color: &str) {
    let path: Vec<String> = corners.iter().map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
    let _ = write!(svg, "<path d=\"M{}Z\" fill=\"{color}\"/>", path.join("L"));
}

/// The convex hull of points, by the chains of Andrew 1979 (unverified).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by_numbers(|place| [place[0], place[1]]);
    let turns_left =
        |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0;
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while chain.len() > 1 && !turns_left(chain[chain.len() - 2], chain[chain.len() - 1], point) {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut points.iter().copied());
    hull.extend(chain(&mut points.iter().rev().copied()));
    hull
}
