//! Names of the files in a result folder; docs/OUTPUTS.md describes their content.

/// Coordinates of a motion.
pub const KINEMATICS: &str = "kinematics.mot";
/// Coordinates of the recorded motion, where it was changed.
pub const KINEMATICS_RECORDED: &str = "kinematics_recorded.mot";
/// Generalised forces.
pub const MOMENTS: &str = "moments.sto";
/// Generalised forces without the forces of a worn device.
pub const MOMENTS_BIOLOGICAL: &str = "moments_biological.sto";
/// Powers.
pub const POWERS: &str = "powers.sto";
/// Joint reactions.
pub const REACTIONS: &str = "reactions.sto";
/// Activations, forces and lengths of the muscles.
pub const MUSCLES: &str = "muscles.sto";
/// Loads of the joints, with the forces of the muscles.
pub const CONTACT_REACTIONS: &str = "reactions_contact.sto";
/// Envelopes of the electromyograms.
pub const EMG: &str = "emg.sto";
/// Ground forces.
pub const GROUND: &str = "grf.mot";
/// Standard deviations of predicted ground forces.
pub const GROUND_SD: &str = "grf_sd.mot";
/// Measured ground forces next to predicted ones.
pub const GROUND_MEASURED: &str = "grf_measured.mot";
/// Feet on which the ground forces act, for OpenSim.
pub const EXTERNAL_LOADS: &str = "external_loads.xml";
/// Foot strikes and foot offs.
pub const EVENTS: &str = "events.csv";
/// Stances with the source of their loads.
pub const STANCES: &str = "stances.csv";
/// Ends of the soles that touch the ground.
pub const FOOT_CONTACT: &str = "foot_contact.sto";
/// Curves over gait cycles.
pub const CYCLES: &str = "cycles.csv";
/// Clinical curves.
pub const CLINICAL: &str = "clinical.csv";
/// Times and distances.
pub const TIMES_AND_DISTANCES: &str = "times_and_distances.csv";
/// States of a gait's machines.
pub const STATES: &str = "states.csv";
/// The summary.
pub const SUMMARY: &str = "summary.json";
/// The page.
pub const PAGE: &str = "report.html";
/// Poses of the bodies of a scene.
pub const POSES: &str = "poses.csv";
/// Joints of a scene.
pub const JOINTS: &str = "joints.csv";
/// Joint reactions of a scene.
pub const SCENE_REACTIONS: &str = "reactions.csv";
/// Contacts of a scene.
pub const CONTACTS: &str = "contacts.csv";
/// Closures of a scene.
pub const CLOSURES: &str = "closures.csv";
/// Energy of a scene.
pub const ENERGY: &str = "energy.csv";
/// Shapes of a scene.
pub const SHAPES: &str = "shapes.json";
/// Body of a person.
pub const SUBJECT: &str = "subject.osim";
/// Body of a synthetic walk.
pub const FIGURE: &str = "figure.osim";
/// Walks of a sweep.
pub const WALKS: &str = "walks.csv";
/// Judged claims of a reproduction.
pub const CLAIMS: &str = "claims.json";
/// Page of a validation.
pub const VALIDATION_PAGE: &str = "validation.html";
/// Page of a session.
pub const SESSION_PAGE: &str = "session.html";
/// Reference group that a session is compared with.
pub const REFERENCE_GROUP: &str = "norm.json";
/// Description of a batch.
pub const BATCH: &str = "batch.json";
/// Page of a batch.
pub const BATCH_PAGE: &str = "summary.html";
/// Durations of the run.
pub const TIMINGS: &str = "timings.json";
