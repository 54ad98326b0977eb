//! Drawings on dark paper: a style sheet within the SVG, which follows the reader's screen, or the root of a page:
//! `data-theme="light"` or `"dark"`.
//!
//! `SVG in light colours => the same SVG with rules for dark colours`. Rules select the colours in `fill` and `stroke`,
//! so drawing code uses one set only; readers without style sheets see the light one.

use std::collections::HashSet;
use std::fmt::Write as _;

/// The class of a drawing's root: rules reach no other drawing of a page.
pub const CLASS: &str = "drawing";

/// Light and dark colours of drawings. Paper, ink and lines first, then curves (Okabe &
/// Ito 2008), then the same as text.
pub const PAIRS: [(&str, &str); 30] = [
    ("#fff", "#161a20"),
    ("#f4f6f8", "#0f1216"),
    ("#333a45", "#e3e7ec"),
    ("#69727f", "#a7b0bb"),
    ("#d9dee4", "#343b45"),
    ("#e3e7ec", "#2c333d"),
    ("#f1f3f5", "#20262e"),
    ("#dfe4ea", "#2a313a"),
    ("#aab2bc", "#59626e"),
    ("#8f949b", "#7b848f"),
    ("#f0e442", "#756f10"),
    ("#9aa1ab", "#8b949f"),
    ("#c0392b", "#ff7b6b"),
    ("#000", "#f2f4f7"),
    ("#000000", "#f2f4f7"),
    ("#0072b2", "#3d93d6"),
    ("#d55e00", "#ff8a33"),
    ("#009e73", "#12b386"),
    ("#cc79a7", "#e3a5c6"),
    ("#e69f00", "#f0b840"),
    ("#56b4e9", "#9bd6f7"),
    ("#8a7f00", "#c9bd3a"),
    ("#b04d00", "#ff9f57"),
    ("#00755a", "#45d0a8"),
    ("#a04478", "#edbfd7"),
    ("#946600", "#f6cd70"),
    ("#2477a6", "#b5e1fa"),
    ("#6b737e", "#a7b0bb"),
    ("#005e94", "#74b7ea"),
    ("#ffffff", "#161a20"),
];

/// The drawing with the rules of its colours. Other text is returned unchanged.
#[must_use]
pub fn adapted(svg: &str) -> String {
    let Some((root, rest)) = svg.split_once('>').filter(|(root, _)| root.starts_with("<svg "))
    else {
        return svg.to_owned();
    };
    let (used, mut followed, mut chosen) = (used(svg), String::new(), String::new());
    for (light, dark) in PAIRS {
        for property in ["fill", "stroke"] {
            let attribute = format!("{property}=\"{light}\"");
            if used.contains(attribute.as_str()) {
                let part = format!(":is(.{CLASS},.{CLASS} *)[{attribute}]");
                let rule = format!("{{{property}:{dark}}}");
                // A page may let its reader choose.
                let _ = write!(followed, "{part}:not([data-theme=\"light\"] *){rule}");
                let _ = write!(chosen, "[data-theme=\"dark\"] {part}{rule}");
            }
        }
    }
    let root = root.replacen("<svg ", &format!("<svg class=\"{CLASS}\" "), 1);
    format!(
        "{root}>\n<style>@media (prefers-color-scheme:dark){{{followed}}}{chosen}</style>{rest}"
    )
}

/// The attributes `fill="#…"` and `stroke="#…"` of a drawing, each once.
fn used(svg: &str) -> HashSet<&str> {
    let attribute = |(at, begins): (usize, &str)| {
        let name = ["fill", "stroke"].into_iter().find(|name| svg[..at].ends_with(name))?;
        let value = &svg[at + begins.len()..];
        svg.get(at - name.len()..at + begins.len() + value.find('"')? + 1)
    };
    svg.match_indices("=\"#").filter_map(attribute).collect()
}

/// Colours of a drawing's `fill` and `stroke` without a dark colour, for tests.
#[must_use]
pub fn unpaired(svg: &str) -> Vec<String> {
    let after = |property: &str| {
        let parts = svg.split(&format!(" {property}=\"#")).skip(1).collect::<Vec<_>>();
        parts.into_iter().filter_map(|part| part.split('"').next()).map(|hex| format!("#{hex}"))
    };
    let mut missing: Vec<String> = after("fill").chain(after("stroke")).collect();
    missing.retain(|colour| !PAIRS.iter().any(|(light, _)| light == colour));
    missing.sort();
    missing.dedup();
    missing
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str =
        "<svg width=\"9\" fill=\"#333a45\">\n<path fill=\"none\" stroke=\"#0072b2\"/></svg>\n";

    #[test]
    fn a_drawing_has_rules_for_its_own_colours_only() {
        let adapted = adapted(SVG);
        assert!(
            adapted.starts_with("<svg class=\"drawing\" width=\"9\" fill=\"#333a45\">\n<style>")
        );
        let rule =
            "[data-theme=\"dark\"] :is(.drawing,.drawing *)[stroke=\"#0072b2\"]{stroke:#3d93d6}";
        assert!(adapted.contains(rule), "{adapted}");
        assert!(adapted.contains(":is(.drawing,.drawing *)[fill=\"#333a45\"]:not("), "{adapted}");
        assert!(!adapted.contains("#d55e00") && adapted.ends_with("</svg>\n"));
        assert_eq!(super::adapted("words"), "words");
    }

    #[test]
    fn a_colour_without_a_pair_is_found() {
        assert_eq!(unpaired(SVG), [""; 0]);
        assert_eq!(unpaired("<a fill=\"#123456\" stroke=\"#abc\"/>"), ["#123456", "#abc"]);
        for (row, (light, _)) in PAIRS.iter().enumerate() {
            assert!(PAIRS[..row].iter().all(|(other, _)| other != light), "{light} is there twice");
        }
    }
}
