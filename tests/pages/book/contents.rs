//! The book's contents, links and manners.
//!
//! `README.md, docs/*.md, the crates' READMEs => nothing, where every page is in the contents, says whom
//! it is for and where to go next, and every link leads somewhere`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use dbd_tests::results::path;
use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd};

const CONTENTS: &str = "SUMMARY.md";
/// The cover, which is no chapter.
const COVER: &str = "README.md";

/// A page: where its links lead, and the anchors of its headings.
struct Page {
    links: Vec<String>,
    anchors: BTreeSet<String>,
}

impl Page {
    fn read(file: &Path) -> Self {
        let text =
            fs::read_to_string(file).unwrap_or_else(|why| panic!("{}: {why}", file.display()));
        let (mut links, mut anchors) = (Vec::new(), BTreeSet::new());
        let mut heading: Option<String> = None;
        for event in Parser::new_ext(&text, Options::ENABLE_TABLES) {
            match event {
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    links.push(dest_url.into_string());
                }
                Event::Html(html) | Event::InlineHtml(html) => {
                    let sources = html.split("src=\"").skip(1);
                    links.extend(sources.filter_map(|rest| Some(rest.split_once('"')?.0.into())));
                }
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::End(TagEnd::Heading(_)) => {
                    let slug = anchor(&heading.take().unwrap_or_default());
                    let again = (1..).map(|n| format!("{slug}-{n}"));
                    let free = std::iter::once(slug.clone()).chain(again);
                    let mut free = free.filter(|slug| !anchors.contains(slug));
                    anchors.extend(free.next().into_iter().collect::<Vec<_>>());
                }
                Event::Text(words) | Event::Code(words) => {
                    if let Some(heading) = &mut heading {
                        heading.push_str(&words);
                    }
                }
                _ => {}
            }
        }
        Self { links, anchors }
    }
}

/// What a heading is called in links, as GitHub and mdBook both have it.
fn anchor(heading: &str) -> String {
    let kept = heading.to_lowercase();
    let kept = kept.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// The Markdown files of a folder, in order.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let files = fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
    let mut files: Vec<_> =
        files.filter(|file| file.extension().is_some_and(|extension| extension == "md")).collect();
    files.sort();
    files
}

/// The pages of the book.
fn book() -> Vec<PathBuf> {
    [pages(&path("docs")), pages(&path("docs/validation"))].concat()
}

fn name(file: &Path) -> String {
    file.file_name().unwrap().to_string_lossy().into_owned()
}

#[test]
fn every_page_is_in_the_contents_once() {
    let docs = path("docs");
    let mut listed = Page::read(&docs.join(CONTENTS)).links;
    let shown = listed.len();
    listed.sort();
    listed.dedup();
    assert_eq!(listed.len(), shown, "{CONTENTS} names a page twice");
    let within = |file: PathBuf| file.strip_prefix(&docs).unwrap().display().to_string();
    let all: Vec<String> = book().into_iter().map(within).filter(|name| name != CONTENTS).collect();
    assert_eq!(listed, all);
    // mdBook finds its pages here.
    let book: toml::Table = fs::read_to_string(path("book.toml")).unwrap().parse().unwrap();
    assert_eq!(book["book"]["src"].as_str(), Some("docs"));
}

#[test]
fn every_link_leads_somewhere() {
    let root = path("");
    let mut files = [pages(&root), book()].concat();
    for folder in fs::read_dir(&root).unwrap() {
        let readme = folder.unwrap().path().join("README.md");
        files.extend(readme.is_file().then_some(readme));
    }
    let mut wrong = Vec::new();
    for file in &files {
        for link in Page::read(file).links {
            if link.contains("://") || link.starts_with("mailto:") {
                continue;
            }
            let (target, anchor) = link.split_once('#').unwrap_or((&link, ""));
            let target =
                if target.is_empty() { file.clone() } else { file.parent().unwrap().join(target) };
            let found = target.exists()
                && (anchor.is_empty() || Page::read(&target).anchors.contains(anchor));
            if !found {
                wrong.push(format!("{}: {link}", file.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "links that lead nowhere:\n{}", wrong.join("\n"));
    assert!(files.len() > 30, "{}", files.len());
}

#[test]
fn every_picture_is_shown_by_a_page() {
    let files = [vec![path("README.md")], book()].concat();
    let shown: BTreeSet<String> = files
        .iter()
        .flat_map(|file| Page::read(file).links)
        .map(|link| name(Path::new(&link)))
        .collect();
    for picture in fs::read_dir(path("docs/pictures")).unwrap() {
        let picture = name(&picture.unwrap().path());
        assert!(shown.contains(&picture), "no page shows docs/pictures/{picture}");
    }
}

#[test]
fn every_page_says_whom_it_is_for_and_where_to_go_next() {
    for file in book() {
        let page = name(&file);
        if [CONTENTS, COVER].contains(&page.as_str()) {
            continue;
        }
        let text = fs::read_to_string(&file).unwrap();
        let titles = Parser::new(&text)
            .filter(|event| {
                matches!(event, Event::Start(Tag::Heading { level: HeadingLevel::H1, .. }))
            })
            .count();
        assert!(text.starts_with("# ") && titles == 1, "{page} has one title, and begins with it");
        let mut paragraphs = text.trim_end().split("\n\n");
        let lead = paragraphs.nth(1).unwrap_or_default().replace("\n> ", " ");
        let says = lead.starts_with("> **For** ") && lead.contains(" **You learn** ");
        assert!(says, "{page} does not begin with `> **For** … **You learn** …`: {lead}");
        let last = paragraphs.last().unwrap_or_default();
        assert!(last.starts_with("**Next**: ") && last.contains(".md"), "{page} ends with: {last}");
    }
}

#[test]
fn the_readme_is_read_in_a_minute() {
    let text = fs::read_to_string(path("README.md")).unwrap();
    let lines = text.lines().count();
    assert!(lines <= 120, "README.md has {lines} lines: move something into docs/");
    let wide =
        text.lines().filter(|line| !line.starts_with(['|', '<']) && line.chars().count() > 125);
    // A line with the origin of a table's data is written by a test.
    let wide = wide.filter(|line| !line.starts_with("Data: "));
    assert_eq!(wide.collect::<Vec<_>>(), [""; 0]);
}

#[test]
fn anchors_are_those_of_the_browsers() {
    assert_eq!(anchor("The `[points]`: places by name"), "the-points-places-by-name");
    assert_eq!(anchor("What costs.csv says"), "what-costscsv-says");
    assert_eq!(anchor("check --stability"), "check---stability");
}
