//! Paths over one surface against OpenSim 4.6 (`unit_wraps.csv`: two free points, a cylinder or a sphere at the origin).

use crate::shared_data::data;
use ambulo_body::spatial::{Pose, Vec3};
use ambulo_muscles::set::{Quadrant, WrapShape};
use ambulo_muscles::wrap::{PathAnchor, PathRoute, PathSurface, WrapRule};

/// A row of the reference.
struct Row {
    cylinder: bool,
    quadrant: Option<Quadrant>,
    ends: [Vec3; 2],
    length: f64,
    arc: Option<f64>,
    touches: [Vec3; 2],
    /// Derivatives of the length by the ends, as forces.
    pulls: [Vec3; 2],
}

fn rows() -> Vec<Row> {
    let Some(data) = data() else { return Vec::new() };
    let text = std::fs::read_to_string(data.join("muscles/opensim46/unit_wraps.csv")).unwrap();
    text.lines().skip(1).filter_map(row).collect()
}

fn row(line: &str) -> Option<Row> {
    let cells: Vec<&str> = line.split(',').collect();
    let number = |k: usize| cells[k].parse::<f64>().unwrap_or(0.0);
    let vector = |k: usize| Vec3::new(number(k), number(k + 1), number(k + 2));
    let cylinder = match cells[0] {
        "Cylinder" => true,
        "Sphere" => false,
        _ => return None,
    };
    Some(Row {
        cylinder,
        quadrant: quadrant(cells[2]),
        ends: [vector(3), vector(6)],
        length: number(9),
        arc: (cells[10] == "1").then(|| number(11)),
        touches: [vector(12), vector(15)],
        pulls: [vector(18), vector(21)],
    })
}

fn quadrant(word: &str) -> Option<Quadrant> {
    let axis = ["x", "y", "z"].iter().position(|axis| word.ends_with(axis))?;
    Some(Quadrant { axis, positive: !word.starts_with('-') })
}

impl Row {
    fn route(&self, rule: WrapRule) -> PathRoute {
        let shape = match self.cylinder {
            true => WrapShape::Cylinder { radius: 0.03, length: 0.2 },
            false => WrapShape::Sphere { radius: 0.03 },
        };
        let quadrant = self.quadrant;
        let surface =
            PathSurface { body: None, pose: Pose::IDENTITY, shape, quadrant, active: true, first: 0, last: 1 };
        let mut route = PathRoute::default();
        route.find(rule, &self.ends.map(|place| PathAnchor { body: None, place }), &[surface]);
        route
    }
}

#[test]
fn dump() {
    for rule in [WrapRule::Exact, WrapRule::OpenSim] {
        for (k, row) in rows().iter().enumerate() {
            let route = row.route(rule);
            let nodes = route.nodes();
            let arc = nodes.iter().find_map(|n| n.arc);
            let pull = (nodes[0].place - nodes[1].place).normalize();
            println!(
                "{rule:?} {k} cyl {} {:?} dL {:+.3e} arc {:?} {:?} {:?} dpull {:.2e}",
                row.cylinder,
                row.quadrant.map(|q| (q.axis, q.positive)),
                row.length - route.length(),
                row.arc,
                arc,
                route.contacts(),
                (pull - row.pulls[0]).norm()
            );
        }
    }
}
