//! Tests of the body and its mechanics that need no other crate, one module per subject.
//!
//! All are modules of one program, which links faster and takes less space than a program each.

#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "what a test measured or skipped is shown with --show-output")]

mod contact_cone;
mod contact_height_field;
mod contact_polytope;
mod contact_separating_axis;
mod contact_shape;
mod dynamics_bordered;
mod dynamics_solve;
mod kinematics_attempts;
mod kinematics_axes;
mod kinematics_branch_matrix;
mod kinematics_gaps;
mod kinematics_joint_angles;
mod kinematics_legs;
mod kinematics_posture_sweep;
mod kinematics_rows;
mod model_landmark;
mod model_name_index;
mod motion_body_weight;
mod motion_channel_angles;
mod motion_clock;
mod motion_held;
mod motion_units;
mod numerics_band_cholesky;
mod numerics_cardinal_spline;
mod numerics_cma;
mod numerics_counted;
mod numerics_dense;
mod numerics_elementary;
mod numerics_harmonics;
mod numerics_least_squares;
mod numerics_matrix_product;
mod numerics_order;
mod numerics_profile_cholesky;
mod numerics_random;
mod numerics_shown;
mod numerics_sin_cos;
mod numerics_uniform_spline;
mod numerics_whittaker;
mod spatial;
mod spatial_rotation;
