//! The page: data, and content readable without scripts, in one file.
//!
//! `data => HTML`. Text is written here; the page's scripts draw the animation and the curves into empty sections.
//! Nothing is fetched.

use std::fmt::Write as _;

use crate::output::{self, markup::escape};

use crate::data::{Data, Survey, Table};

/// Style sheets of the page, in order.
pub const STYLES: &[&str] = &[
    include_str!("../web/vendor/uplot.min.css"),
    include_str!("../web/theme.css"),
    include_str!("../web/layout.css"),
    include_str!("../web/stage.css"),
    include_str!("../web/charts.css"),
];

/// Scripts that draw a mechanism, in order: those of others first.
pub const STAGE: &[&str] = &[
    include_str!("../web/vendor/three.min.js"),
    include_str!("../web/vendor/uplot.min.js"),
    include_str!("../web/numbers.js"),
    include_str!("../web/clock.js"),
    include_str!("../web/film.js"),
    include_str!("../web/theme.js"),
    include_str!("../web/batch.js"),
    include_str!("../web/bodies.js"),
    include_str!("../web/joints.js"),
    include_str!("../web/springs.js"),
    include_str!("../web/arrows.js"),
    include_str!("../web/traces.js"),
    include_str!("../web/machine.js"),
    include_str!("../web/camera.js"),
    include_str!("../web/labels.js"),
    include_str!("../web/stage.js"),
];

/// Scripts of the page in addition to [`STAGE`], in order.
const SCRIPTS: &[&str] = &[
    include_str!("../web/controls.js"),
    include_str!("../web/chart.js"),
    include_str!("../web/sections.js"),
    include_str!("../web/modes.js"),
    include_str!("../web/main.js"),
];

/// Sections that scripts fill, with their headings, in order.
const DRAWN: [(&str, &str); 6] = [
    ("readouts", "Read-outs"),
    ("inputs", "Inputs"),
    ("energy", "Energy"),
    ("joints", "Joints"),
    ("motion", "Motion"),
    ("modes", "Modes"),
];

/// The page of a run or of a comparison.
#[must_use]
pub fn html(data: &Data) -> String {
    let Data { name, description, text, .. } = data;
    let mut page = format!("<main>\n<header>\n<h1>{}</h1>\n", escape(name));
    if !description.is_empty() {
        let _ = writeln!(page, "<p class=\"lead\">{}</p>", escape(description));
    }
    page.push_str("</header>\n");
    for failure in &text.failures {
        let failure = escape(failure);
        let _ = writeln!(page, "<p class=\"failed\"><strong>Failed:</strong> {failure}.</p>");
    }
    for warning in &text.warnings {
        let warning = escape(warning);
        let _ = writeln!(page, "<p class=\"warning\"><strong>Warning:</strong> {warning}.</p>");
    }
    page.push_str("<section id=\"stage\">\n");
    if let Some(picture) = &text.picture {
        let _ = writeln!(page, "<figure class=\"still\">\n{picture}</figure>");
    }
    page.push_str("</section>\n");
    page.push_str("<noscript><p>The animation and the curves need JavaScript.</p></noscript>\n");
    for (id, heading) in DRAWN {
        // Shown by the scripts where there is something to draw.
        let _ = writeln!(page, "<section id=\"{id}\" hidden>\n<h2>{heading}</h2>\n</section>");
    }
    if let Some(survey) = &text.survey {
        write_survey(&mut page, survey);
    }
    for table in &text.tables {
        write_table(&mut page, table);
    }
    if !text.commands.is_empty() {
        page.push_str("<section id=\"again\">\n<h2>Run it again</h2>\n");
        for (makes, command) in &text.commands {
            if !makes.is_empty() {
                let _ = writeln!(page, "<p>{}</p>", escape(makes));
            }
            let _ = writeln!(page, "<pre>{}</pre>", escape(command));
        }
        for note in &text.notes {
            let _ = writeln!(page, "<p>{}</p>", escape(note));
        }
        page.push_str("</section>\n");
    }
    let _ = writeln!(
        page,
        "</main>\n<script type=\"application/json\" id=\"report\">{}</script>",
        json(data)
    );
    output::page::html(name, STYLES, &page, &[STAGE, SCRIPTS].concat())
}

/// The data as JSON that ends no script: nothing in it opens a tag or a comment.
#[must_use]
pub fn json(data: &Data) -> String {
    script_json(data)
}

/// Any data as such JSON.
#[must_use]
pub fn script_json(data: &impl serde::Serialize) -> String {
    // Serialization of these data does not fail.
    let text = serde_json::to_string(data).unwrap_or_else(|_| "null".into());
    text.replace('<', "\\u003c")
}

/// The chart is made for a wide screen; the page that it comes from has one for others.
const SURVEY_STYLE: &str = ".survey{margin:1rem 0}.survey svg{width:100%;height:auto}\
     @media(max-width:900px){.survey{display:none}}";

fn write_survey(page: &mut String, survey: &Survey) {
    page.push_str("<section id=\"trade\">\n<h2>Speed against accuracy</h2>\n");
    if !survey.advice.is_empty() {
        page.push_str("<ul class=\"advice\">\n");
        for (sentence, command) in &survey.advice {
            let (sentence, command) = (escape(sentence), escape(command));
            let _ = writeln!(page, "<li>{sentence}.<br><code>{command}</code></li>");
        }
        page.push_str("</ul>\n");
    }
    if let Some(chart) = &survey.chart {
        let _ = writeln!(page, "<style>{SURVEY_STYLE}</style>");
        let _ = writeln!(page, "<figure class=\"survey\">\n{chart}</figure>");
    }
    let file = escape(&survey.page);
    let _ = writeln!(
        page,
        "<p>As <code>host-sim trade</code> measured this scene; all of it is in \
         <a href=\"{file}\">{file}</a> beside this page.</p>\n</section>"
    );
}

fn write_table(page: &mut String, table: &Table) {
    let id = table.title.to_lowercase().replace(' ', "-");
    let (id, title) = (escape(&id), escape(&table.title));
    let _ = writeln!(page, "<section id=\"{id}\">\n<h2>{title}</h2>\n<table>");
    if !table.columns.is_empty() {
        page.push_str("<thead><tr>");
        for column in &table.columns {
            let _ = write!(page, "<th scope=\"col\">{}</th>", escape(column));
        }
        page.push_str("</tr></thead>\n");
    }
    page.push_str("<tbody>\n");
    for row in &table.rows {
        page.push_str("<tr>");
        for (column, cell) in row.iter().enumerate() {
            let cell = escape(cell);
            let _ = match column {
                0 => write!(page, "<th scope=\"row\">{cell}</th>"),
                _ => write!(page, "<td>{cell}</td>"),
            };
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</tbody>\n</table>\n</section>\n");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::{Run, Text};

    fn page() -> String {
        let name = "a \"b\" </script><b>&amp; ü –";
        let mut data = Data::of_run(name, "<!-- what it is", Run::default());
        data.text = Text {
            failures: vec!["it <broke>".into()],
            warnings: vec!["too \"soft\"".into()],
            picture: Some("<svg id=\"still\"></svg>\n".into()),
            tables: vec![Table {
                title: "Summary".into(),
                columns: vec!["of".into(), "first".into()],
                rows: vec![vec!["energy".into(), "1 < 2".into()]],
            }],
            commands: vec![(String::new(), "host-sim run 'a' && b".into())],
            notes: vec!["bits".into()],
            survey: Some(Survey {
                advice: vec![("For 1e-3 m < choose".into(), "host-sim run 'b' && c".into())],
                chart: Some("<svg id=\"survey\"></svg>\n".into()),
                page: "trade.html".into(),
            }),
        };
        html(&data)
    }

    #[test]
    fn names_cannot_become_markup_or_end_a_script() {
        let page = page();
        assert!(page.contains("<h1>a &quot;b&quot; &lt;/script&gt;&lt;b&gt;&amp;amp; ü –</h1>"));
        assert!(
            page.contains("<li>For 1e-3 m &lt; choose.<br><code>host-sim run 'b' &amp;&amp; c<")
        );
        assert!(page.contains("<svg id=\"survey\">") && page.contains("href=\"trade.html\""));
        assert!(page.contains("&lt;!-- what it is") && page.contains("it &lt;broke&gt;."));
        let start = "<script type=\"application/json\" id=\"report\">";
        let data = page.split(start).nth(1).unwrap().split("</script>").next().unwrap();
        assert!(!data.contains('<'));
        let data: serde_json::Value = serde_json::from_str(data).unwrap();
        assert_eq!(data["name"], "a \"b\" </script><b>&amp; ü –");
        assert_eq!((&data["format"], &data["kind"]), (&1.into(), &"run".into()));
        assert_eq!(data["runs"][0]["film"], serde_json::Value::Null);
    }

    #[test]
    fn what_is_read_without_scripts_stands_in_its_order() {
        let page = page();
        let parts = [
            "<h1>",
            "Failed:",
            "too &quot;soft&quot;.",
            "id=\"stage\"",
            "id=\"still\"",
            "id=\"readouts\"",
            "id=\"inputs\"",
            "id=\"energy\"",
            "id=\"joints\"",
            "id=\"motion\"",
            "id=\"modes\"",
            "id=\"summary\"",
            "<th scope=\"col\">first</th>",
            "<th scope=\"row\">energy</th><td>1 &lt; 2</td>",
            "host-sim run 'a' &amp;&amp; b",
            "bits",
            "id=\"report\"",
        ];
        let places: Vec<_> = parts.iter().map(|part| page.find(part).unwrap_or(0)).collect();
        assert!(places[0] > 0 && places.is_sorted_by(|a, b| a < b), "{parts:?} {places:?}");
        // One file: nothing is fetched.
        for fetch in ["src=\"", "href=\"http", "@import", "url(http"] {
            assert!(!page.contains(fetch), "{fetch}");
        }
    }
}
