//! Muscle moments at a joint, and their cost.

use ambulo_walk::contact::HuntCrossley;
use ambulo_walk::internals::{Evaluator, Instant, Row, tissue_of};
use ambulo_walk::model::anthropometry::{Build, SegmentTable};
use ambulo_walk::model::full_body::full_body;
use ambulo_walk::model::{Movement, Side};
use ambulo_walk::optimal::{ECCENTRIC, Effort, Quantity, StrengthCurve};

#[test]
fn slopes_of_all_quantities_of_muscles_and_feet_are_those_of_differences() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = full_body(&build).unwrap();
    let anatomy = human.model.anatomy();
    let (knee, _) = anatomy.coordinate(Movement::KneeFlexion, Some(Side::Left)).unwrap();
    let (tissue, constant) = tissue_of(anatomy, Movement::KneeFlexion, Side::Left).unwrap();
    let effort = Effort { coordinate: knee, tissue, stiffness: 30.0, damping: 3.0, given: vec![constant, 7.0] };
    let strength = StrengthCurve::built_in(Movement::KneeFlexion, 75.0, 1.75).unwrap();
    let quantities = [
        Quantity::Effort(effort.clone()),
        Quantity::Activation { effort: effort.clone(), strength: strength.clone(), sign: 1.0 },
        Quantity::Activation { effort: Effort::whole(knee), strength, sign: -1.0 },
        Quantity::RootPower { effort: effort.clone(), prices: [4.0, 0.8], smooth_w: 5.0 },
        Quantity::RootPower { effort: Effort::whole(knee), prices: [4.0, 0.8], smooth_w: 50.0 },
        Quantity::Place(3, 2),
        Quantity::Place(2, 0),
        Quantity::LoadOffset { spheres: vec![0, 1, 2], axis: 0, points: vec![0.0, 0.05] },
        Quantity::LoadOffset { spheres: vec![1, 3], axis: 2, points: vec![0.0, -0.02] },
        Quantity::Height(3),
    ];
    let mut evaluator = Evaluator::new(&human.model, &human.soles, &[]).unwrap();
    let law = HuntCrossley::SOFT_SHOES;
    let count = human.model.coordinates().len();
    let wave = |size: f64, shift: f64| (0..count).map(|k| size * (1.3 * k as f64 + shift).sin()).collect();
    let mut at = [Instant { posture: [wave(0.2, 0.0), wave(1.0, 2.0), wave(5.0, 4.0)], ..Instant::default() }];
    at[0].posture[0][4] = human.dimensions.leg_length;
    evaluator.evaluate(&law, &mut at);
    for quantity in &quantities {
        let mut full = Vec::new();
        let row = match quantity.row(1, &at[0], 1.0, &mut full) {
            Row::Full => full,
            Row::Entries(entries) => {
                let mut row = vec![0.0; 3 * count];
                entries.into_iter().for_each(|(place, slope)| row[place] += slope);
                row
            }
        };
        let size = row.iter().fold(1.0_f64, |a, x| a.max(x.abs()));
        for (part, step) in [1e-6, 1e-5, 1e-3].into_iter().enumerate() {
            for column in 0..count {
                let mut pair = [at[0].clone(), at[0].clone()];
                pair[0].posture[part][column] += step;
                pair[1].posture[part][column] -= step;
                evaluator.evaluate(&law, &mut pair);
                let expected = (quantity.value(1, &pair[0]) - quantity.value(1, &pair[1])) / (2.0 * step);
                let found = row[part * count + column];
                assert!((found - expected).abs() < 1e-5 * size, "{quantity:?}: {found}, difference {expected}");
            }
        }
    }
}

/// An activation is the moment over what muscles can do at this angle and speed, as the verdict has it, and stays
/// finite where nothing is left.
#[test]
fn an_activation_is_the_share_of_the_strength_at_the_angle_and_the_speed() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = full_body(&build).unwrap();
    let (ankle, _) = human.model.anatomy().coordinate(Movement::AnkleDorsiflexion, Some(Side::Right)).unwrap();
    let strength = StrengthCurve::built_in(Movement::AnkleDorsiflexion, 75.0, 1.75).unwrap();
    let zeros = || vec![0.0; human.model.coordinates().len()];
    let mut at = Instant { posture: [(); 3].map(|()| zeros()), forces: zeros(), ..Instant::default() };
    for (sign, moment, angle_deg, rate) in
        [(-1.0, -100.0, 10.0, 0.0), (-1.0, -80.0, -5.0, -3.0), (-1.0, -120.0, 8.0, 2.0), (1.0, 20.0, 0.0, 0.5)]
    {
        at.posture[0][ankle.index()] = f64::to_radians(angle_deg);
        at.posture[1][ankle.index()] = rate;
        at.forces[ankle.index()] = moment;
        let share = |sign: f64| {
            Quantity::Activation { effort: Effort::whole(ankle), strength: strength.clone(), sign }.value(0, &at)
        };
        let expected = moment.abs() / strength.available(f64::to_radians(angle_deg), rate, sign, ECCENTRIC);
        assert!((share(sign) / expected - 1.0).abs() < 0.06, "{} and {expected}", share(sign));
        assert!(share(sign) > 0.0 && share(-sign) < 0.0);
    }
    at.posture[1][ankle.index()] = 60.0;
    let fast = Quantity::Activation { effort: Effort::whole(ankle), strength, sign: 1.0 }.value(0, &at);
    assert!(fast.is_finite() && fast > 1.0, "{fast}");
}

/// Riener and Edrich's passive knee: little moment at 20 degrees of flexion, more towards both ends.
#[test]
fn tissue_pulls_a_joint_away_from_the_ends_of_its_range() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = full_body(&build).unwrap();
    let anatomy = human.model.anatomy();
    for side in Side::BOTH {
        let (knee, sign) = anatomy.coordinate(Movement::KneeFlexion, Some(side)).unwrap();
        let (tissue, constant) = tissue_of(anatomy, Movement::KneeFlexion, side).unwrap();
        let flexion = |degrees: f64| {
            let mut at = Instant::default();
            at.posture[0] = vec![0.0; human.model.coordinates().len()];
            at.posture[0][knee.index()] = sign * degrees.to_radians();
            sign * (constant + tissue.iter().map(|part| part.value(&at).0).sum::<f64>())
        };
        assert!(flexion(20.0).abs() < 2.0, "{}", flexion(20.0));
        assert!(flexion(-5.0) > 10.0 && flexion(120.0) < -5.0, "{} and {}", flexion(-5.0), flexion(120.0));
    }
}
