//! An HTML page that needs no other file.
//!
//! `title, styles, body, scripts => page`.

use std::fmt::Write as _;

use crate::output::markup::escape;

/// Writes a page: `title` is text, `body` is markup, each style and each script a separate element, in order.
#[must_use]
pub fn html(title: &str, styles: &[&str], body: &str, scripts: &[&str]) -> String {
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" href=\"data:,\">\n\
         <title>{}</title>\n",
        escape(title)
    );
    for style in styles {
        let _ = writeln!(page, "<style>\n{style}</style>");
    }
    let _ = writeln!(page, "</head>\n<body>\n{}", body.trim_end());
    for script in scripts {
        let _ = writeln!(page, "<script>\n{script}</script>");
    }
    page.push_str("</body>\n</html>\n");
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_is_no_markup_and_nothing_is_fetched() {
        let page = html("a < b", &["p { color: red; }\n"], "<p>text</p>\n", &["run();\n"]);
        assert!(page.contains("<title>a &lt; b</title>"), "{page}");
        assert!(
            page.contains("<body>\n<p>text</p>\n<script>\nrun();\n</script>\n</body>"),
            "{page}"
        );
        assert!(!page.contains("http"), "{page}");
    }
}
