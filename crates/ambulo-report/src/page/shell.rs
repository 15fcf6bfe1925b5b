//! The HTML file around data and viewer.
//!
//! Nothing but inline script and style may run (Content-Security-Policy), so the page asks nothing of any network. Data stand in a
//! script element of type `application/json`, in which every `<` is written as `\\u003c`: no text can end the element.

use super::block::Block;
use super::contract::Page;
use super::folder::PageError;
use crate::html::escaped;

const SCRIPT: &str = include_str!("../../data/report/viewer.js");
const STYLE: &str = include_str!("../../data/report/viewer.css");
const POLICY: &str =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; font-src data:";

/// The page as one HTML file.
pub(super) fn html(page: &Page, block: &Block) -> Result<String, PageError> {
    let data = serde_json::to_string(page)?.replace('<', "\\u003c");
    let title = escaped(&page.title);
    let numbers = block.encode();
    Ok(format!(
        r#"<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{POLICY}">
<title>{title} - Ambulo</title>
<style>{STYLE}</style>
</head>
<body>
<div id="ambulo"></div>
<noscript>This report is drawn by a script within this file; nothing is loaded from elsewhere. Please allow scripts.</noscript>
<script type="application/json" id="ambulo-page">{data}</script>
<script type="application/octet-stream" id="ambulo-numbers">{numbers}</script>
<script>{SCRIPT}</script>
</body>
</html>
"#
    ))
}
