//! A problem of optimal motion.

use ambulo_walk::contact::HuntCrossley;
use ambulo_walk::internals::{Contact, Instant, Stage};
use ambulo_walk::model::CoordinateId;
use ambulo_walk::optimal::{Bound, Continuation, Quantity, SPATIAL_STAGES, STAGES, Term};

fn term(quantity: Quantity) -> Term {
    Term { name: String::new(), quantity, targets: vec![Some(1.0)], deviation: 0.5, bound: Bound::Near }
}

#[test]
fn a_stage_makes_slip_alone_cheaper() {
    let stage = Stage { shoes: HuntCrossley::SOFT_SHOES, slack: 1.0, slip: 4.0 };
    let mut contact = Contact::default();
    (contact.values.force.y, contact.values.slip[0]) = (100.0, 3.0);
    let at = Instant { posture: [vec![3.0], vec![0.0], vec![0.0]], contacts: vec![contact], ..Instant::default() };
    let slip = term(Quantity::Slip { sphere: 0, axis: 0, light_n: 0.0 });
    let place = term(Quantity::Position(vec![(CoordinateId(0), 1.0)]));
    let residual = |term: &Term| stage.residual(term, 0, &at).unwrap();
    let near = |found: [f64; 2], expected: [f64; 2]| found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(near([stage.deviation(&slip), stage.deviation(&place)], [2.0, 0.5]));
    assert!(near([residual(&slip), residual(&place)], [1.0, 4.0]));
}

#[test]
fn stages_in_three_dimensions_end_with_the_cost_of_slip_of_the_problem() {
    let slips = SPATIAL_STAGES.map(|stage| stage.slip);
    assert!(slips.is_sorted_by(|a, b| a >= b) && slips[0] > 1.0 && slips.last() == Some(&1.0), "{slips:?}");
    for (spatial, planar) in SPATIAL_STAGES.iter().zip(&STAGES) {
        assert_eq!(Continuation { slip: planar.slip, updates: planar.updates, ..*spatial }, *planar);
    }
}
