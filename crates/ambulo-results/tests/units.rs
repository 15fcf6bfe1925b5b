//! Units of columns.

use ambulo_results::unit_of;

#[test]
fn units_follow_from_the_names_of_columns() {
    let of = |file, column| unit_of(file, column, None);
    assert_eq!(of("grf.mot", "time"), "s");
    assert_eq!(of("grf.mot", "ground_force_r_vy"), "N");
    assert_eq!(of("grf.mot", "ground_force_l_px"), "m");
    assert_eq!(of("grf_sd.mot", "ground_force_l_px_sd"), "m");
    assert_eq!(of("grf_sd.mot", "ground_torque_l_y_sd"), "N.m");
    assert_eq!(of("reactions.sto", "hip_r_on_femur_r_in_ground_mz"), "N.m");
    assert_eq!(of("moments.sto", "pelvis_ty_force"), "N");
    assert_eq!(of("moments.sto", "knee_angle_r_moment"), "N.m");
    assert_eq!(of("clinical.csv", "knee_flexion_moment_r"), "N.m/kg");
    assert_eq!(of("clinical.csv", "knee_flexion_r"), "deg");
}
