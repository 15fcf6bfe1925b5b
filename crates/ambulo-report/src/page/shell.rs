//! Puts data and viewer into one HTML file.
//!
//! Only inline script and style may run (Content-Security-Policy), so the page loads nothing from any network. The data
//! are in a script element of type `application/json`, in which every `<` is written as `\\u003c`: no text can end the
//! element.

use super::block::Block;
use super::contract::{LivePage, Page};
use crate::html::Document;
use ambulo_results::ResultsError;

const SCRIPT: &str = include_str!("../../data/report/viewer.js");
const STYLE: &str = include_str!("../../data/report/viewer.css");
const POLICY: &str =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:";

/// Kind of a page.
#[derive(Debug, Clone, Copy)]
pub(super) enum Kind<'a> {
    /// Complete and offline.
    Report,
    /// Gets more from the server that it comes from.
    Live(&'a LivePage),
}

/// The page as one HTML file.
pub(super) fn html(page: &Page, block: &Block, kind: Kind<'_>) -> Result<String, ResultsError> {
    let (live, policy) = match kind {
        Kind::Report => (String::new(), POLICY.to_owned()),
        Kind::Live(live) => {
            let data = serde_json::to_string(live)?.replace('<', "\\u003c");
            let element = format!("<script type=\"application/json\" id=\"ambulo-live\">{data}</script>\n");
            (element, format!("{POLICY}; connect-src 'self'"))
        }
    };
    let data = serde_json::to_string(page)?.replace('<', "\\u003c");
    let numbers = block.encode();
    let body = format!(
        r#"<div id="ambulo"></div>
<noscript>This report is drawn by a script within this file; nothing is loaded from elsewhere. Please allow scripts.</noscript>
<script type="application/json" id="ambulo-page">{data}</script>
<script type="application/octet-stream" id="ambulo-numbers">{numbers}</script>
{live}<script>{SCRIPT}</script>"#
    );
    Ok(Document { title: &page.title, policy: &policy, style: STYLE, body: &body }.html())
}
