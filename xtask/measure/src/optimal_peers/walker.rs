//! The problem that all solvers get: a planar figure walks half a cycle on spheres with OpenSim's contact force.
//!
//!   mean over time of   Σ_angles ((q - q*) / 3°)² + ((q̇ - q̇*) / 0.3 rad/s)²  +  Σ_joints (τ / 40 N.m)²     without forces at the root
//!
//! The targets q*, q̇* are the angles of the first guess, the mean normative curves at that speed. Duration and
//! distance are given. Each foot has two spheres, as in Moco's `2D_gait.osim`. One instant per knot interval: the
//! splines are then as free as the motion itself.

use ambulo::contact::{HuntCrossley, Onset};
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::{Build, ContactSphere, SegmentTable, SpherePart};
use ambulo::model::{CoordinateId, CoordinateKind, Model, Movement, Side};
use ambulo::optimal::{Bound, Continuation, Problem, Quantity, Sample, Solution, Term, WalkCosts, WalkProblem};
use cpu_time::ThreadTime;
use serde_json::{Value, json};

/// The figure, without toe joints.
const MAN: Build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: false };
/// Walking speed [m/s].
const SPEED: f64 = 1.25;
/// Knot intervals of the splines, and instants of each.
const KNOTS: usize = 60;
const PER_KNOT: usize = 1;
/// Deviations that cost one [rad], [rad/s], [N.m].
const ANGLE: f64 = 3.0 * std::f64::consts::PI / 180.0;
const RATE: f64 = 0.3;
const MOMENT: f64 = 40.0;
/// Deviation from the origin at the first instant that costs one [m]. The solution has none; it only fixes where the
/// walk starts.
const PLACE: f64 = 1e-2;
/// Contact force of Moco's `2D_gait.osim`, as published.
const SHOES: HuntCrossley = HuntCrossley { onset: Onset::Published, ..HuntCrossley::MOCO_2D_GAIT };
/// Instants of the motions that are exported for other transcriptions.
const SAMPLES: usize = 200;

/// Stages before Newton's method.
const STAGES: [Continuation; 2] = [
    Continuation { stiffness: 0.5, creep: 2.0, slip: 1.0, slack: 0.02, updates: 0, steps: 20, gain: 3e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.02, updates: 0, steps: 20, gain: 1e-3 },
];
/// Accuracy of Newton's method, and the largest number of its steps.
pub(super) const ACCURACY: f64 = 1e-5;
const NEWTON_STEPS: usize = 100;

/// The problem with its first guess.
pub(super) struct Walker {
    pub(super) problem: Problem,
    pub(super) guess: Vec<f64>,
}

/// How we solved it.
pub(super) struct Solved {
    pub(super) solution: Solution,
    /// CPU time of the solver [s].
    pub(super) seconds: f64,
    pub(super) objective: f64,
    /// Steps before Newton's method.
    pub(super) steps: usize,
}

impl Walker {
    pub(super) fn new() -> Result<Walker, String> {
        let human = MAN.human().map_err(|e| e.to_string())?;
        let mut gait = Gait::named("free").map_err(|e| e.to_string())?;
        gait.pace.speed = Some(Speed::MetersPerSecond(SPEED));
        let walk =
            Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
        let costs = WalkCosts { knots: KNOTS, per_knot: PER_KNOT, ..WalkCosts::default() };
        // Without the ball, between heel and toe.
        let soles: Vec<ContactSphere> =
            human.soles.iter().filter(|sole| sole.part != SpherePart::Ball).cloned().collect();
        let WalkProblem { mut problem, mut guess, .. } =
            WalkProblem::new(&human, &soles, SHOES, &walk, &costs).map_err(|e| e.to_string())?;
        lean_with_pelvis(&problem, &mut guess);
        let first = problem.at(&guess).map_err(|e| e.to_string())?;
        problem.terms = terms(&problem, &first);
        Ok(Walker { problem, guess })
    }

    /// The problem in words.
    pub(super) fn described(&self) -> String {
        let Problem { model, soles, duration_s, knots, .. } = &self.problem;
        format!(
            "A planar figure ({}: {} coordinates, {} spheres) walks at {SPEED} m/s: half a cycle of {duration_s:.3} s, \
             mirrored. {} unknowns, \
             {knots} instants. Objective: mean over time of all angles ((q - q*) / {:.0} deg)^2 and rates ((q' - q'*) \
             / {RATE} rad/s)^2 \
             relative to the first guess, the mean curves of people, plus joint moments (M / {MOMENT} N.m)^2. No force \
             at the root.",
            model.name(),
            model.coordinates().len(),
            soles.len(),
            self.guess.len(),
            ANGLE.to_degrees(),
        )
    }

    /// Solves the problem from the first guess.
    pub(super) fn solve(&self) -> Result<Solved, String> {
        let clock = ThreadTime::now();
        let solution = self.problem.solve(&self.guess, &STAGES).map_err(|e| e.to_string())?;
        let steps = solution.progress.iter().map(|stage| stage.steps).sum();
        let solution = self.problem.refine(solution.unknowns(), ACCURACY, NEWTON_STEPS).map_err(|e| e.to_string())?;
        let seconds = clock.elapsed().as_secs_f64();
        Ok(Solved { objective: self.objective(solution.unknowns())?, steps, solution, seconds })
    }

    /// The objective without the constraints.
    fn objective(&self, unknowns: &[f64]) -> Result<f64, String> {
        let at = self.problem.at(unknowns).map_err(|e| e.to_string())?;
        let last = &at.progress[0];
        // `at` has no multipliers and a slack of one, so the constraints add the mean of their squares.
        let count = self.problem.root().len() as f64;
        Ok(last.cost - count * last.root.0.powi(2))
    }

    /// Everything that another solver needs.
    pub(super) fn json(&self, solved: &Solved) -> Result<Value, String> {
        let problem = &self.problem;
        let root = problem.root();
        let model = &problem.model;
        let angles: Vec<usize> = angles(problem).iter().map(|id| id.index()).collect();
        let driven: Vec<usize> = driven(problem).iter().map(|id| id.index()).collect();
        let weight = model.mass() * model.gravity().norm();
        let scales: Vec<f64> =
            root.iter().map(|(_, turns)| if *turns { weight * problem.length_m } else { weight }).collect();
        let first = problem.at(&self.guess).map_err(|e| e.to_string())?;
        let (travel, distance) = problem.travel.ok_or("the walk does not travel")?;
        Ok(json!({
            "bodies": bodies(model)?,
            "coordinates": model.coordinates().iter().map(|c| c.name.clone()).collect::<Vec<_>>(),
            "mirror": mirror(model),
            "gravity": -model.gravity().y,
            "soles": problem.soles.iter().map(|s| json!({
                "name": s.name, "body": s.body.index(), "center": [s.center.x, s.center.y, s.center.z],
                    "radius": s.radius,
            })).collect::<Vec<_>>(),
            "law": {
                "stiffness": SHOES.stiffness, "dissipation": SHOES.dissipation,
                    "static_friction": SHOES.static_friction,
                "dynamic_friction": SHOES.dynamic_friction, "viscous_friction": SHOES.viscous_friction,
                "transition_velocity": SHOES.transition_velocity, "depth_offset": SHOES.depth_offset,
                "depth_slope": SHOES.depth_slope, "rate_slope": SHOES.rate_slope,
            },
            "duration": problem.duration_s,
            "travel": { "coordinate": travel.index(), "distance": distance },
            "knots": problem.knots,
            "per_knot": problem.instants_per_knot,
            "root": root.iter().map(|(id, _)| id.index()).collect::<Vec<_>>(),
            "root_scales": scales,
            "angles": angles, "angle_deviation": ANGLE, "rate_deviation": RATE,
             "driven": driven, "moment_deviation": MOMENT, "place_deviation": PLACE,
            "guess": self.guess,
            "solution": solved.solution.unknowns(),
            "objective": solved.objective,
            "guess_samples": samples(&first, problem.duration_s)?,
            "solution_samples": samples(&solved.solution, problem.duration_s)?,
        }))
    }
}

/// Adds the tilt of the pelvis to the lumbar angle: in the mean normative curves the trunk's angle is relative to the
/// pelvis, while the gait of a planar figure takes it as relative to the world. Both are sums of the same splines.
fn lean_with_pelvis(problem: &Problem, guess: &mut [f64]) {
    let of = |movement| problem.model.anatomy().coordinate(movement, None).map(|(id, _)| id.index());
    let (Some(tilt), Some(lumbar)) = (of(Movement::PelvicTilt), of(Movement::TrunkLean)) else { return };
    for block in guess.chunks_mut(problem.model.coordinates().len()) {
        block[lumbar] += block[tilt];
    }
}

/// Angles that have targets: all.
fn angles(problem: &Problem) -> Vec<CoordinateId> {
    let turns = |id: &CoordinateId| problem.model.coordinates()[id.index()].kind == CoordinateKind::Rotation;
    problem.model.coordinate_ids().filter(turns).collect()
}

/// Coordinates with a moment: all but those of the root.
fn driven(problem: &Problem) -> Vec<CoordinateId> {
    let root = problem.root();
    problem.model.coordinate_ids().filter(|id| root.iter().all(|(other, _)| other != id)).collect()
}

fn terms(problem: &Problem, first: &Solution) -> Vec<Term> {
    let count = problem.instants();
    let mut posture = [0; 3].map(|_| vec![0.0; problem.model.coordinates().len()]);
    let shares = problem.shares();
    let mut targets = vec![[Vec::with_capacity(count), Vec::with_capacity(count)]; posture[0].len()];
    for share in &shares {
        // The end of the span belongs to the next one, where sides are exchanged.
        first.write(share.min(1.0 - 1e-12) * problem.duration_s, &mut posture);
        for (c, targets) in targets.iter_mut().enumerate() {
            for (targets, values) in targets.iter_mut().zip(&posture) {
                targets.push(Some(values[c]));
            }
        }
    }
    let mut terms = Vec::new();
    let mut near = |quantity, targets, deviation| {
        terms.push(Term { name: String::new(), quantity, targets, deviation, bound: Bound::Near });
    };
    for id in angles(problem) {
        let [positions, rates] = targets[id.index()].clone();
        near(Quantity::Position(vec![(id, 1.0)]), positions, ANGLE);
        near(Quantity::Rate(vec![(id, 1.0)]), rates, RATE);
    }
    for id in driven(problem) {
        near(Quantity::Force(id), vec![Some(0.0); count], MOMENT);
    }
    if let Some((id, _)) = problem.travel {
        let mut at_start = vec![None; count];
        at_start[0] = Some(0.0);
        near(Quantity::Position(vec![(id, 1.0)]), at_start, PLACE);
    }
    terms
}

/// Bodies as planar links: parent, place of the joint in it, the coordinates of the joint, mass properties.
fn bodies(model: &Model) -> Result<Vec<Value>, String> {
    let body = |body: &ambulo::model::Body| {
        let joint = &body.joint;
        let place = joint.parent_from_joint.translation;
        let center = body.inertia.center();
        let about = body.inertia.about_center();
        let (turns, slides): (Vec<CoordinateId>, Vec<CoordinateId>) = joint
            .coordinates()
            .into_iter()
            .partition(|id| model.coordinates()[id.index()].kind == CoordinateKind::Rotation);
        let [turn] = turns[..] else { return Err(format!("joint `{}` does not turn about one axis", joint.name)) };
        Ok(json!({
            "name": body.name, "joint": joint.name, "parent": joint.parent.map(|id| id.index()),
            "place": [place.x, place.y, place.z], "rotation": turn.index(),
            "translations": slides.iter().map(|id| id.index()).collect::<Vec<_>>(),
            "mass": body.inertia.mass(), "center": [center.x, center.y, center.z],
            "inertia": [about.m11, about.m22, about.m33, about.m12, about.m13, about.m23],
        }))
    };
    model.bodies().iter().map(body).collect()
}

/// The coordinate on the other side, per coordinate.
fn mirror(model: &Model) -> Vec<usize> {
    let other = |id: CoordinateId| {
        let (side, stem) = Side::split_name(&model.coordinates()[id.index()].name)?;
        model.coordinate(&format!("{stem}_{}", side.other().letter()))
    };
    model.coordinate_ids().map(|id| other(id).unwrap_or(id).index()).collect()
}

fn samples(solution: &Solution, duration_s: f64) -> Result<Value, String> {
    let end = duration_s * (1.0 - 1e-12);
    let times: Vec<f64> = (0..=SAMPLES).map(|k| (k as f64 / SAMPLES as f64 * duration_s).min(end)).collect();
    let samples: Vec<Sample> = solution.samples(&times).map_err(|e| e.to_string())?;
    Ok(json!({
        "times": times,
        "positions": samples.iter().map(|s| s.posture[0].clone()).collect::<Vec<_>>(),
        "rates": samples.iter().map(|s| s.posture[1].clone()).collect::<Vec<_>>(),
        "forces": samples.iter().map(|s| s.forces.clone()).collect::<Vec<_>>(),
    }))
}
