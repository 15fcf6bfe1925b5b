//! Presents results: clinical curves with normative data, figures, the report page, and exchange formats.

mod batch;
mod clinical;
mod clinical_file;
mod exchange;
mod figure_files;
pub mod figures;
mod html;
mod normative;
pub mod page;
mod reproduction;
mod reproduction_page;
mod scene_shapes;
mod session;
mod stage;
pub mod style;
mod sweep;
mod validation;

pub use batch::{BATCH_QUANTITIES, BatchQuantity, BatchTrial, batch_page};
pub use clinical::clinical_wording;
pub use clinical_file::clinical_file;
pub use exchange::{
    ExchangeError, GroundReactions, bvh_of_folder, c3d_of_markers, csv_of_folder, glb_of_folder, glb_of_motion,
    ground_reactions, laboratory_recording, marker_paths, rig_of_folder, skeleton_of, standing_recording,
    table_of_markers, trc_of_markers,
};
pub use figure_files::{figure_files, outcome_figures};
#[doc(hidden)]
pub use figures::CycleFigures;
pub use figures::{FigureError, Mark, SceneCurves, gait_figure};
pub use reproduction::reproduction_files;
pub use reproduction_page::reproduction_page;
pub use scene_shapes::scene_shapes;
pub use session::{
    ChangeSummary, ChangesSummary, ComparedSession, ComputedTrial, ExcludedSummary, ProfileSummary, ReferenceGroup,
    ReferenceGroupError, RepresentativeSummary, SESSION_FORMAT, Session, SessionFacts, SessionSummary, SessionTrial,
    Spread, TrialSummary, TrialWarning, session_from_files, session_quantity_label,
};
pub use stage::quaternion;
pub use sweep::{SweptConditions, SweptWalk, WalkCurves, sweep_files};
pub use validation::{ListedTrial, listed_section, validation_files};

/// For the tests of results and pages.
#[doc(hidden)]
pub mod internals {
    pub use crate::clinical::{ClinicalGroup, ClinicalNames, ClinicalQuantity, clinical_quantities};
    pub use crate::exchange::glb::mesh::Triangles;
    pub use crate::exchange::glb::{METRES_PER_NEWTON, glb};
    pub use crate::figures::axes::{
        Labels, Ticks, number_text as axis_number, range as axis_range, round_labels, ticks as axis_ticks, with_power,
    };
    pub use crate::figures::moving_picture::{moving_picture, moving_speed};
    pub use crate::figures::session_panels::{LineLook, PanelArea, PanelLine, SessionPanel};
    pub use crate::figures::sheet::wrapped;
    pub use crate::figures::svg::{
        Drawing, Stroke, escaped as escaped_xml, short as two_decimals, text_width, without_zeros,
    };
    pub use crate::html::escaped as escaped_html;
    pub use crate::normative::{BAND_SAMPLES, Bands, Curves, NormalRange, band, dimensionless_speed, time_distance};
    pub use crate::page::session::cells::number;
    pub use crate::page::session::extracted::{Part, Read};
    pub use crate::page::session::feasibility::basis::percent;
    pub use crate::page::session::glance::Deviation;
    pub use crate::page::session::pace::{asked, mean_speed};
    pub use crate::page::session::words::in_words;
    #[cfg(feature = "contract")]
    pub use crate::page::typescript::contract;
    pub use crate::session::quantities::{ANGLES as SESSION_ANGLES, SessionQuantity, all as session_quantities};
    pub use crate::stage::path::BodyPath;
    pub use crate::stage::{
        ForceRole, Stage, StageBody, StageContact, StageForce, StageMuscle, StagePlate, StageTorque,
    };
}
