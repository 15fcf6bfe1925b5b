//! Declarations of the contract for TypeScript: the content of `viewer/src/contract.ts`.

use super::contract::*;
use ts_rs::{Config, TS};

/// The file that the viewer is compiled with.
#[must_use]
pub fn contract() -> String {
    let config = Config::new().with_large_int("number");
    let head = format!(
        "// Made from crates/ambulo-report/src/page/contract.rs by its test; do not edit.\n\n/** Version of the \
         contract. */\nexport const FORMAT = {FORMAT};\n"
    );
    let parts = [runs(&config), curves(&config), judgements(&config), views(&config), live(&config)];
    parts.concat().iter().fold(head, |text, declaration| text + &format!("\nexport {declaration}\n"))
}

/// Pages, runs, and the head of the page.
fn runs(config: &Config) -> Vec<String> {
    vec![
        Page::decl(config),
        Series::decl(config),
        PageSide::decl(config),
        Session::decl(config),
        Fact::decl(config),
        PageSource::decl(config),
        PageVerdict::decl(config),
        TimeAxis::decl(config),
        PageEvent::decl(config),
        PageMachine::decl(config),
        PagePeriod::decl(config),
        PageCycle::decl(config),
    ]
}

/// Panels with their curves, and tables.
fn curves(config: &Config) -> Vec<String> {
    vec![
        Group::decl(config),
        Panel::decl(config),
        Activity::decl(config),
        ActiveTimes::decl(config),
        CycleCurve::decl(config),
        MeanCurve::decl(config),
        Band::decl(config),
        Trace::decl(config),
        Role::decl(config),
        Origin::decl(config),
        Table::decl(config),
        Cell::decl(config),
    ]
}

/// Quality of the data, and feasibility.
fn judgements(config: &Config) -> Vec<String> {
    vec![
        Quality::decl(config),
        Judged::decl(config),
        PageFinding::decl(config),
        DataQuality::decl(config),
        Glance::decl(config),
        PageQuality::decl(config),
        Feasibility::decl(config),
        RedSpan::decl(config),
    ]
}

/// The 3-D view.
fn views(config: &Config) -> Vec<String> {
    vec![
        View::decl(config),
        ViewBody::decl(config),
        ViewShape::decl(config),
        ViewPlate::decl(config),
        ViewForce::decl(config),
        ViewTorque::decl(config),
        ViewContact::decl(config),
        ViewMuscle::decl(config),
        ViewPath::decl(config),
        ViewPathPoint::decl(config),
    ]
}

/// The types of the live page.
fn live(config: &Config) -> Vec<String> {
    vec![
        LivePage::decl(config),
        LiveForce::decl(config),
        LivePanel::decl(config),
        LiveCurve::decl(config),
        LiveFrame::decl(config),
        LiveState::decl(config),
    ]
}
