//! Curves of muscles against OpenSim 4.6 (`muscles/opensim46/curves.csv`).

use crate::muscle_models::Table;
use ambulo_muscles::curves::{CurveError, ForceCurves};
use ambulo_muscles::set::{MillardCurves, MuscleCurves, ThelenCurves};

/// The curves of a set of the table, from its parameters.
fn curves_of(set: &str) -> MuscleCurves {
    let table = Table::read("curve_parameters.csv").unwrap();
    let value = |curve: &str, parameter: &str| -> Option<f64> {
        let is_it = |row: &&Vec<String>| {
            table.text(row, "set") == set && row[1] == curve && table.text(row, "parameter") == parameter
        };
        table.text(table.rows.iter().find(is_it).unwrap(), "value").parse().ok()
    };
    if set.starts_with("Thelen") {
        let all = |parameter: &str| value("all", parameter).unwrap();
        return MuscleCurves::Thelen2003(ThelenCurves {
            tendon_strain_at_max: all("FmaxTendonStrain"),
            fiber_strain_at_max: all("FmaxMuscleStrain"),
            active_shape: all("KshapeActive"),
            passive_shape: all("KshapePassive"),
            velocity_shape: all("Af"),
            lengthening_force: all("Flen"),
            straight_from: all("fv_linear_extrap_threshold"),
        });
    }
    let active = [
        "min_norm_active_fiber_length",
        "transition_norm_fiber_length",
        "max_norm_active_fiber_length",
        "shallow_ascending_slope",
        "minimum_value",
    ];
    let velocity = [
        "concentric_slope_at_vmax",
        "concentric_slope_near_vmax",
        "isometric_slope",
        "eccentric_slope_at_vmax",
        "eccentric_slope_near_vmax",
        "max_eccentric_velocity_force_multiplier",
        "concentric_curviness",
        "eccentric_curviness",
    ];
    let passive = [
        "strain_at_zero_force",
        "strain_at_one_norm_force",
        "stiffness_at_low_force",
        "stiffness_at_one_norm_force",
        "curviness",
    ];
    MuscleCurves::Millard2012(MillardCurves {
        active: active.map(|name| value("active_force_length", name).unwrap()),
        velocity: velocity.map(|name| value("force_velocity", name).unwrap()),
        passive: passive.map(|name| value("passive_force_length", name)),
        ..MillardCurves::default()
    })
}

/// Largest difference from OpenSim relative to the value (beside its last digit), by set and curve; `spoil` changes a
/// curve first.
fn worst(spoil: impl Fn(MuscleCurves) -> MuscleCurves) -> Option<Vec<(String, f64, usize)>> {
    let table = Table::read("curves.csv")?;
    let mut found: Vec<(String, f64, usize)> = Vec::new();
    let mut curves: Option<(String, ForceCurves)> = None;
    for row in &table.rows {
        let (set, curve) = (table.text(row, "set"), table.text(row, "curve"));
        if curve == "tendon_force_length" {
            continue;
        }
        if curves.as_ref().is_none_or(|(known, _)| known != set) {
            curves = Some((set.to_owned(), ForceCurves::new(&spoil(curves_of(set))).unwrap()));
        }
        let own = &curves.as_ref().unwrap().1;
        let x = table.number(row, "x");
        let y = match curve {
            "active_force_length" => own.active(x),
            "passive_force_length" => own.passive(x),
            _ => own.velocity(x, table.text(row, "activation").parse().unwrap_or(1.0)),
        };
        let expected = table.number(row, "y");
        // The table has nine digits or more.
        let error = ((y - expected).abs() - 1e-9).max(0.0) / expected.abs().max(1e-4);
        let key = format!("{set}, {curve}");
        match found.iter_mut().find(|(known, ..)| *known == key) {
            Some((_, worst, count)) => (*worst, *count) = (worst.max(error), *count + 1),
            None => found.push((key, error, 1)),
        }
    }
    Some(found)
}

#[test]
fn curves_agree_with_opensim() {
    let Some(found) = worst(|curves| curves) else { return };
    assert_eq!(found.len(), 15);
    for (key, error, count) in found {
        println!("{key:<45} {count:>5} points, worst {error:.1e}");
        // OpenSim solves Thelen's force-velocity to 1e-6 in velocity.
        let allowed = if key.starts_with("Thelen") && key.ends_with("force_velocity") { 1e-5 } else { 1e-6 };
        assert!(error <= allowed && count > 100, "{key}: {error}");
    }
}

#[test]
fn another_parameter_gives_another_curve() {
    let spoiled = worst(|curves| match curves {
        MuscleCurves::Thelen2003(own) => MuscleCurves::Thelen2003(ThelenCurves {
            active_shape: own.active_shape * 1.001,
            passive_shape: own.passive_shape * 1.001,
            velocity_shape: own.velocity_shape * 1.001,
            ..own
        }),
        MuscleCurves::Millard2012(own) => {
            let [least, transition, most, shallow, value] = own.active;
            let mut velocity = own.velocity;
            velocity[2] *= 1.001;
            MuscleCurves::Millard2012(MillardCurves {
                active: [least, transition * 1.001, most, shallow, value],
                velocity,
                passive: [own.passive[0], own.passive[1].map(|x| x * 1.001), None, None, None],
                ..own
            })
        }
    });
    let Some(spoiled) = spoiled else { return };
    for (key, error, _) in spoiled {
        assert!(error > 1e-5, "{key}: {error}");
    }
}

#[test]
fn parameters_without_a_curve_are_refused() {
    let spoiled = [
        ThelenCurves { active_shape: 0.0, ..ThelenCurves::default() },
        ThelenCurves { lengthening_force: 1.0, ..ThelenCurves::default() },
        ThelenCurves { straight_from: 0.5, ..ThelenCurves::default() },
        ThelenCurves { velocity_shape: f64::NAN, ..ThelenCurves::default() },
    ];
    for curves in spoiled {
        let error = ForceCurves::new(&MuscleCurves::Thelen2003(curves)).unwrap_err();
        assert!(error.to_string().contains("expected"), "{error}");
    }
    let millard = MillardCurves { active: [0.5, 0.4, 1.8, 0.8, 0.0], ..MillardCurves::default() };
    let error = ForceCurves::new(&MuscleCurves::Millard2012(millard)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the curve parameter `transition_norm_fiber_length` is 0.4; expected between the least length and 1"
    );
    let millard = MillardCurves { passive: [None, Some(0.5), Some(1.9), Some(2.1), None], ..MillardCurves::default() };
    let error = ForceCurves::new(&MuscleCurves::Millard2012(millard)).unwrap_err();
    assert!(matches!(error, CurveError::Parameter { .. } | CurveError::Bend { .. }), "{error}");
}
