//! Text in HTML pages.

use ambulo_report::internals::escaped_html;

#[test]
fn no_text_becomes_markup() {
    assert_eq!(escaped_html(r#"<script>"a" & b</script>"#), "&lt;script&gt;&quot;a&quot; &amp; b&lt;/script&gt;");
}
