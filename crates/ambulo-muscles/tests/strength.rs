//! Strength of muscles on rigid tendons against OpenSim 4.6.

use crate::muscle_models::{MODELS, Table, load, postures};
use ambulo_muscles::curves::ForceCurves;
use ambulo_muscles::set::{MillardCurves, MuscleCurves, MuscleParameters, ThelenCurves};
use ambulo_muscles::strength::{Pennation, Strength};

/// Parameters of the muscle of a row of `rigid_tendon_muscles.csv`.
fn parameters(table: &Table, row: &[String]) -> MuscleParameters {
    let curves = match table.text(row, "model") {
        "gait2392" | "arm26" => MuscleCurves::Thelen2003(ThelenCurves {
            tendon_strain_at_max: 0.033,
            active_shape: 0.5,
            passive_shape: 4.0,
            velocity_shape: 0.3,
            lengthening_force: 1.8,
            ..ThelenCurves::default()
        }),
        "rajagopal" => MuscleCurves::Millard2012(MillardCurves {
            active: [0.25, 0.77, 1.9, 0.75, 0.0],
            ..MillardCurves::default()
        }),
        _ => MuscleCurves::Millard2012(MillardCurves::default()),
    };
    let is_millard = matches!(curves, MuscleCurves::Millard2012(_));
    MuscleParameters {
        max_isometric_force: table.number(row, "F_iso_N"),
        optimal_fiber_length: table.number(row, "l_opt_m"),
        tendon_slack_length: table.number(row, "l_slack_m"),
        pennation_at_optimal: table.number(row, "alpha0_rad"),
        max_contraction_velocity: table.number(row, "v_max_lopt_s"),
        max_pennation: 0.1_f64.acos(),
        rigid_tendon: is_millard,
        activation_range: [0.01, 1.0],
        curves,
    }
}

/// Largest difference from `rigid_tendon_force.csv` in greatest isometric forces: Thelen's and Millard's muscles.
fn against_opensim(pennation: Pennation) -> Option<[f64; 2]> {
    let muscles = Table::read("rigid_tendon_muscles.csv")?;
    let forces = Table::read("rigid_tendon_force.csv")?;
    let mut worst = [0.0_f64; 2];
    for row in &muscles.rows {
        let own = parameters(&muscles, row);
        let curves = ForceCurves::new(&own.curves).unwrap();
        let strength = Strength::new(&own, &curves, pennation);
        let mut count = 0;
        for point in forces.rows.iter().filter(|point| point[..2] == row[..2]) {
            let [length, speed, activation, expected] =
                ["l_mt_m", "v_mt_m_s", "activation", "F_active_along_tendon_N"].map(|name| forces.number(point, name));
            let found = strength.force(&curves, length, speed, activation);
            let error = (found - expected).abs() / own.max_isometric_force;
            let kind = usize::from(matches!(own.curves, MuscleCurves::Millard2012(_)));
            worst[kind] = worst[kind].max(error);
            count += 1;
        }
        assert_eq!(count, 192, "{row:?}");
    }
    Some(worst)
}

#[test]
fn rigid_tendons_agree_with_opensim() {
    let Some([thelen, millard]) = against_opensim(Pennation::AsOpenSim) else { return };
    println!("largest difference: Thelen {thelen:.1e}, Millard {millard:.1e} of the greatest isometric force");
    assert!(thelen < 1e-6 && millard < 1e-6, "{thelen} {millard}");
}

#[test]
fn opensim_has_another_pennation_for_millards_muscles() {
    let Some([thelen, millard]) = against_opensim(Pennation::Right) else { return };
    assert!(thelen < 1e-6, "{thelen}");
    // README of the references: .19 of the greatest isometric force (soleus).
    assert!((0.1..0.25).contains(&millard), "{millard}");
}

/// Largest difference of strengths from `optimal_force_*.csv` over the walking postures, in greatest isometric forces.
/// Lengths and speeds are OpenSim's.
fn walking(name: &str, stretch: f64) -> Option<f64> {
    let muscles = load(name)?;
    let (paths, forces) =
        (Table::read(&format!("paths_{name}.csv"))?, Table::read(&format!("optimal_force_{name}.csv"))?);
    let table = Table::read(&format!("postures_{name}.csv"))?;
    let all = postures(name, &muscles.model)?;
    let count = muscles.set.muscles.len();
    let mut worst = 0.0_f64;
    for (posture, (kind, _)) in all.iter().enumerate().filter(|(_, (kind, _))| kind == "walk") {
        let time = table.number(&table.rows[posture], "time");
        let frame = forces.rows.iter().find(|row| (forces.number(row, "time") - time).abs() < 1e-6).unwrap();
        assert_eq!(kind, "walk");
        for (i, muscle) in muscles.set.muscles.iter().enumerate() {
            let row = &paths.rows[posture * count + i];
            assert_eq!(paths.text(row, "path"), muscle.name);
            let curves = ForceCurves::new(&muscle.parameters.curves).unwrap();
            let strength = Strength::new(&muscle.parameters, &curves, Pennation::AsOpenSim);
            let length = paths.number(row, "length_m") * stretch;
            let found = strength.force(&curves, length, paths.number(row, "speed_m_s"), 1.0);
            let expected = forces.number(frame, &muscle.name);
            worst = worst.max((found - expected).abs() / muscle.parameters.max_isometric_force);
        }
    }
    Some(worst)
}

#[test]
fn strengths_in_walking_agree_with_opensim() {
    for (name, _) in MODELS {
        let Some(worst) = walking(name, 1.0) else { return };
        println!("{name}: {worst:.1e} of the greatest isometric force");
        // Lengths have eight digits, and the curves are steep by at most about 5 per optimal fibre length.
        assert!(worst < 1e-6, "{name}: {worst}");
        assert!(walking(name, 1.0001).unwrap() > 1e-5, "{name}");
    }
}
