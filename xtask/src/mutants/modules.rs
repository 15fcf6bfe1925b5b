//! The modules whose tests are tested, and the tests for each.

/// A part of the library.
pub(super) struct Module {
    /// As typed on the command line.
    pub(super) name: &'static str,
    /// Its files, from the workspace root; `**` is any folder.
    pub(super) files: &'static str,
    /// How many mutants are drawn; none: all are run.
    pub(super) sample: Option<usize>,
    /// Tests that each mutant is run with: parts of their names. They take a few seconds together.
    pub(super) quick: &'static [&'static str],
    /// Tests that what survives the quick ones is run with.
    pub(super) wide: &'static [&'static str],
}

/// Tests that take more than five seconds, left out everywhere: a mutant that only they would notice counts as a
/// survivor.
pub(super) const SLOW: [&str; 17] = [
    "quarter_of_random_scenes",
    "a_simulated_walk_in_a_plane_hardly_changes",
    "a_wrong_mass_is_only_detected_with_plates",
    "contact_convergence_of",
    "exchanged_labels_are_found",
    "flails_for_a_minute",
    "gait_style_1997",
    "ground_forces_explain_the_change_of_momentum",
    "ground_stream",
    "inverse_dynamics_gives_the_efforts_of_the_simulator",
    "jumps_are_found_and_change_no_angle",
    "losing_markers_for_a_while",
    "residual_reduction::",
    "scene_walkers",
    "spoiled_copies_are_never_good",
    "ten_balls_come_to_rest_in_the_bin",
    "without_friction_the_box_stays",
];

/// Tests that take more than a second, left out of the quick ones.
pub(super) const LONG: [&str; 18] = [
    "a_known_walk_starts_other_speeds",
    "a_model_without_feet",
    "a_walk_of_lazy_muscles",
    "a_walk_with_other_joints_or_knots",
    "a_weak_leg_does_less",
    "a_whipping_chain_of_twenty_links",
    "forces_that_are_a_tenth_larger",
    "joint_moments_of_an_optimal_walk",
    "marker_outliers",
    "muscles_that_are_too_weak",
    "slopes_and_loads_change_moments",
    "solids_of_every_shape_come_to_rest",
    "springs_at_the_ankles",
    "the_size_of_a_disturbed_model",
    "too_little_gravity_is_rejected",
    "unusual_numbers_are_rejected_or_ignored",
    "with_everything_prescribed",
    "work_becomes_height_and_losses",
];

/// Tests of the simulator that take less than a second each.
const SIMULATOR: &[&str] = &["simulation_closed_form", "simulation_contact", "simulation_smooth"];

impl Module {
    /// The crate of its files.
    pub(super) fn package(&self) -> &'static str {
        self.files.split('/').nth(1).unwrap_or_default()
    }

    /// The programs of its tests: that of `ambulo`, and that of its own crate.
    pub(super) fn programs(&self) -> impl Iterator<Item = &'static str> {
        std::iter::once("library").chain(self.package().strip_prefix("ambulo-"))
    }
}

pub(super) const MODULES: [Module; 8] = [
    Module {
        name: "inverse",
        files: "crates/ambulo-body/src/dynamics/inverse.rs",
        sample: None,
        quick: &["identities", "independent::", "conventions"],
        wide: &[
            "both_feet_together_give_the_total",
            "the_total_force_is_what",
            "analysis",
            "mujoco_parity",
            "opensim_parity",
            "full_body",
            "recordings",
            "walking",
            "feasibility",
            "scaling",
        ],
    },
    Module {
        name: "step",
        files: "crates/ambulo-walk/src/engine/step.rs",
        sample: None,
        quick: SIMULATOR,
        wide: &["simulation_", "scene_", "walking", "consistent_walk"],
    },
    Module {
        name: "contact",
        files: "crates/ambulo-body/src/contact/**",
        sample: Some(40),
        quick: &["contact_geometry", "simulation_closed_form", "simulation_contact"],
        wide: &["contact_", "simulation_", "scene_", "walking", "consistent_walk"],
    },
    Module {
        name: "touch",
        files: "crates/ambulo-walk/src/engine/touch.rs",
        sample: Some(40),
        quick: SIMULATOR,
        wide: &["simulation_", "scene_", "walking", "consistent_walk"],
    },
    Module {
        name: "kinematics",
        files: "crates/ambulo-body/src/kinematics/**",
        sample: Some(40),
        quick: &[
            "identities",
            "independent",
            "retarget",
            "scaling",
            "clinical_angles",
            "calibration",
            "marker_",
            "opensim_parity",
        ],
        wide: &[
            "kinematics_",
            "analysis",
            "laboratory",
            "recordings",
            "skeleton",
            "plug_in_gait",
            "anatomy",
            "splines",
        ],
    },
    Module {
        name: "predict",
        files: "crates/ambulo/src/ground/predict/**",
        sample: Some(40),
        quick: &[
            "unchanged_results",
            "both_feet_together_give_the_total",
            "fore_aft_and_vertical_forces",
            "prediction_checks",
            "standing_ground",
        ],
        wide: &["ground_", "prediction_checks", "footfalls", "feasibility", "activity"],
    },
    Module {
        name: "analysis",
        files: "crates/ambulo/src/analysis/**",
        sample: Some(40),
        quick: &[
            "unchanged_results",
            "analysis",
            "activity",
            "feasibility",
            "ground_agreement",
            "prediction_checks",
            "times_and_distances",
            "weighing",
            "scene_verdict",
        ],
        wide: &[
            "recordings",
            "laboratory",
            "calibration",
            "quality",
            "ground_",
            "synthetic_walk",
            "study",
            "events",
            "walking",
        ],
    },
    Module {
        name: "optimal",
        files: "crates/ambulo-walk/src/optimal/**",
        sample: Some(40),
        quick: &["optimal"],
        wide: &["inverse_derivatives", "consistent_walk", "feasibility"],
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Source of all tests of the library, and the names of their files.
    fn tests_of_the_library() -> String {
        let folder = crate::workspace::root().join("crates/ambulo/tests");
        let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let files = files.filter(|file| file.extension().is_some_and(|ending| ending == "rs"));
        files.map(|file| format!("{}::\n{}\n", file.display(), std::fs::read_to_string(&file).unwrap())).collect()
    }

    #[test]
    fn every_test_that_is_left_out_exists() {
        let tests = tests_of_the_library().replace(".rs::", "::");
        assert_eq!(SLOW.iter().chain(&LONG).find(|name| !tests.contains(**name)), None);
    }
}
