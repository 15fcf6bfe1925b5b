//! Constraint graphs built by hand: free bodies, contacts, tables, ladders, towers.

use super::random::Random;
use ambulo::dynamics::{
    ActsOn, BodyTerms, Constraint, ConstraintGraph, ConstraintGroup, GraphSolution, GraphWorkspace, Law, Link, Method,
    Six, SolverSettings, solve_graph,
};
use ambulo::spatial::{Mat3, Vec3};

pub(crate) const METHODS: [Method; 2] = [Method::Newton, Method::ConjugateGradient];
const GRAVITY: f64 = 9.81;

pub(crate) fn six(angular: Vec3, linear: Vec3) -> Six {
    Six::new(angular.x, angular.y, angular.z, linear.x, linear.y, linear.z)
}

/// The rows of the motion of one body relative to another at a point: angular velocity along each of `axes`, then
/// velocity of the point along each of them. `to_first` points from the point to the first mass centre, `from_second`
/// from the second one to the point [m].
pub(crate) fn relative_rows(axes: [Vec3; 3], to_first: Vec3, from_second: Vec3) -> [Constraint; 6] {
    let row = |on_first: Six, on_second: Six| Constraint { on_first, on_second, target: 0.0, compliance: 0.0 };
    let turn = |axis: Vec3| row(six(axis, Vec3::zeros()), six(-axis, Vec3::zeros()));
    let slide = |axis: Vec3| row(six(-to_first.cross(&axis), axis), six(-from_second.cross(&axis), -axis));
    let [x, y, z] = axes;
    [turn(x), turn(y), turn(z), slide(x), slide(y), slide(z)]
}

pub(crate) fn random_six(r: &mut Random) -> Six {
    Six::from_iterator(r.list(6, 1.0))
}

/// Inertia of a solid box of these edges [m].
pub(crate) fn box_inertia(mass: f64, edges: Vec3) -> Mat3 {
    let [x, y, z] = [edges.x, edges.y, edges.z].map(|e| e * e);
    Mat3::from_diagonal(&(Vec3::new(y + z, x + z, x + y) * (mass / 12.0)))
}

/// Adds a free body under gravity (-z); the number of the body.
pub(crate) fn add_free(graph: &mut ConstraintGraph, mass: f64, inertia: Mat3) -> usize {
    graph.links.push(Link { parent: None, freedom: 6 });
    graph.bodies.push(BodyTerms { mass, inertia });
    graph.wrenches.push(six(Vec3::zeros(), Vec3::new(0.0, 0.0, -GRAVITY * mass)));
    graph.terms.arm.push(Vec3::zeros());
    graph.terms.offset.push(Six::zeros());
    for k in 0..6 {
        graph.terms.directions.push(Six::ith(k, 1.0));
        graph.efforts.push(0.0);
        graph.rotors.push(0.0);
    }
    graph.bodies.len() - 1
}

/// Adds a body on a hinge about `axis`; `from_parent` and `to_center` lead to and from the hinge.
pub(crate) fn add_hinged(
    graph: &mut ConstraintGraph,
    parent: Option<usize>,
    (from_parent, to_center): (Vec3, Vec3),
    axis: Vec3,
    terms: BodyTerms,
) -> usize {
    graph.links.push(Link { parent, freedom: 1 });
    graph.bodies.push(terms);
    graph.wrenches.push(six(Vec3::zeros(), Vec3::new(0.0, 0.0, -GRAVITY * terms.mass)));
    graph.terms.arm.push(if parent.is_some() { from_parent + to_center } else { Vec3::zeros() });
    graph.terms.offset.push(Six::zeros());
    graph.terms.directions.push(six(axis, axis.cross(&to_center)));
    graph.efforts.push(0.0);
    graph.rotors.push(0.0);
    graph.bodies.len() - 1
}

/// Adds rows as one group; the number of the first row.
pub(crate) fn add_rows(graph: &mut ConstraintGraph, on: ActsOn, rows: &[Constraint], law: Law) -> usize {
    let start = graph.rows.len();
    graph.rows.extend_from_slice(rows);
    graph.groups.push(ConstraintGroup { on, rows: start..graph.rows.len(), law });
    start
}

/// Two directions that make a right-handed frame with a unit normal.
pub(crate) fn tangents(normal: Vec3) -> [Vec3; 2] {
    let aside = if normal.x.abs() < 0.7 { Vec3::x() } else { Vec3::y() };
    let first = normal.cross(&aside).normalize();
    [first, normal.cross(&first)]
}

/// Adds a contact at a point `from_first` of the first body's centre and `from_second` of the second's; the normal
/// points towards the first body. The number of its normal row.
pub(crate) fn add_contact(
    graph: &mut ConstraintGraph,
    (first, from_first): (usize, Vec3),
    second: Option<(usize, Vec3)>,
    normal: Vec3,
    friction: f64,
) -> usize {
    let from_second = second.map_or(Vec3::zeros(), |(_, arm)| arm);
    let [s, t] = tangents(normal);
    let all = relative_rows([normal, s, t], -from_first, from_second);
    let on = ActsOn::Bodies { first, second: second.map(|(body, _)| body) };
    add_rows(graph, on, &all[3..6], Law::Contact { friction, bound: f64::INFINITY })
}

/// A box of these edges under gravity on `points` (from its centre), each a contact with the ground below.
pub(crate) fn box_on(mass: f64, edges: Vec3, points: &[Vec3], friction: f64) -> ConstraintGraph {
    let mut graph = ConstraintGraph::default();
    let body = add_free(&mut graph, mass, box_inertia(mass, edges));
    for point in points {
        add_contact(&mut graph, (body, *point), None, Vec3::z(), friction);
    }
    graph
}

/// The corners below, at half the edges.
pub(crate) fn corners(edges: Vec3) -> [Vec3; 4] {
    [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)]
        .map(|(x, y)| Vec3::new(0.5 * x * edges.x, 0.5 * y * edges.y, -0.5 * edges.z))
}

/// Boxes on each other, each on the four corners of the one below; masses from below.
pub(crate) fn tower(masses: &[f64], friction: f64) -> ConstraintGraph {
    let edges = Vec3::new(0.4, 0.3, 0.2);
    let mut graph = ConstraintGraph::default();
    for (level, mass) in masses.iter().enumerate() {
        let body = add_free(&mut graph, *mass, box_inertia(*mass, edges));
        for corner in corners(edges) {
            let below = level.checked_sub(1).map(|b| (b, corner + Vec3::z() * edges.z));
            add_contact(&mut graph, (body, corner), below, Vec3::z(), friction);
        }
    }
    graph
}

/// Two rails of hinged links hanging from the ground, and a rung between them at every joint: `loops` loops in the
/// plane, closed by the two rows of the plane; or by five rows, of which three are redundant.
pub(crate) fn ladder(loops: usize, rows: &[usize]) -> ConstraintGraph {
    let mut graph = ConstraintGraph::default();
    let (axis, down, side) = (Vec3::y(), Vec3::new(0.0, 0.0, -0.5), Vec3::x());
    let terms = |mass: f64| BodyTerms { mass, inertia: Mat3::identity() * (0.02 * mass) };
    let mut last = [None, None];
    for _ in 0..loops {
        let hang = |last: Option<usize>| (if last.is_some() { down } else { Vec3::zeros() }, down);
        let left = add_hinged(&mut graph, last[0], hang(last[0]), axis, terms(1.0));
        let right = add_hinged(&mut graph, last[1], hang(last[1]), axis, terms(1.2));
        let rung = add_hinged(&mut graph, Some(left), (down, 0.5 * side), axis, terms(0.7));
        let all = relative_rows([side, Vec3::z(), axis], -0.5 * side, down);
        let chosen: Vec<Constraint> = rows.iter().map(|k| all[*k]).collect();
        add_rows(&mut graph, ActsOn::Bodies { first: rung, second: Some(right) }, &chosen, Law::EQUALITY);
        // A push from the side, else nothing happens.
        graph.wrenches[rung][3] += 3.0;
        last = [Some(left), Some(right)];
    }
    graph
}

/// In-plane rows of a ladder's closings.
pub(crate) const PLANE: [usize; 2] = [3, 4];
/// All but the turn about the hinge (axes side, z, hinge).
pub(crate) const SPACE: [usize; 5] = [0, 1, 3, 4, 5];

/// A guess for contacts without a past.
pub(crate) fn fresh(graph: &ConstraintGraph) -> GraphSolution {
    let mut solution = GraphSolution { lambda: vec![0.0; graph.rows.len()], ..GraphSolution::default() };
    for group in &graph.groups {
        if matches!(group.law, Law::Contact { .. }) {
            solution.lambda[group.rows.start] = f64::MIN_POSITIVE;
        }
    }
    solution
}

pub(crate) fn settings(method: Method, tolerance: f64, max_iterations: usize) -> SolverSettings {
    SolverSettings { method, tolerance, max_iterations }
}

/// The solution without a past, and the workspace that it left.
pub(crate) fn solved(graph: &ConstraintGraph, settings: &SolverSettings) -> (GraphSolution, GraphWorkspace) {
    let (mut solution, mut workspace) = (fresh(graph), GraphWorkspace::default());
    solve_graph(graph, settings, &mut workspace, &mut solution).unwrap();
    (solution, workspace)
}

/// Random trees with free bodies among them, contacts at random points with random normals, and sometimes a closing row
/// or a bounded one.
pub(crate) fn random_contacts(r: &mut Random, most_friction: f64) -> ConstraintGraph {
    let mut graph = ConstraintGraph::default();
    let bodies = 1 + r.below(8);
    for child in 0..bodies {
        let turn = r.rotation();
        let diagonal = Vec3::new(r.between(0.1, 1.0), r.between(0.1, 1.0), r.between(0.1, 1.0));
        let terms =
            BodyTerms { mass: r.between(0.5, 20.0), inertia: turn * Mat3::from_diagonal(&diagonal) * turn.transpose() };
        if child == 0 || r.chance(0.5) {
            add_free(&mut graph, terms.mass, terms.inertia);
        } else {
            let arms = (r.vector(0.5), r.vector(0.5));
            add_hinged(&mut graph, Some(r.below(child)), arms, r.unit(), terms);
        }
        graph.wrenches[child] += random_six(r) * 30.0;
    }
    for _ in 0..1 + r.below(2 * bodies + 2) {
        let first = r.below(bodies);
        let second = Some(r.below(bodies)).filter(|s| *s != first && r.chance(0.5)).map(|s| (s, r.vector(0.5)));
        let friction = if r.chance(0.2) { 0.0 } else { r.between(0.0, most_friction) };
        let normal = r.unit();
        let row = add_contact(&mut graph, (first, r.vector(0.5)), second, normal, friction);
        // Some part, some approach.
        (0..3).for_each(|k| graph.rows[row + k].target = r.within(5.0));
    }
    if r.chance(0.5) {
        let (first, law) = match r.below(3) {
            0 => (r.below(bodies), Law::EQUALITY),
            1 => (r.below(bodies), Law::Bounded { least: 0.0, most: f64::INFINITY }),
            _ => (r.below(bodies), Law::Bounded { least: -5.0, most: 10.0 }),
        };
        let compliance = if r.chance(0.3) { r.between(0.0, 0.5) } else { 0.0 };
        let row = Constraint { on_first: random_six(r), on_second: Six::zeros(), target: r.within(5.0), compliance };
        add_rows(&mut graph, ActsOn::Bodies { first, second: None }, &[row], law);
    }
    graph
}
