//! Phrases that no page, message or comment uses, and how long sentences of a page are.
//!
//! `pages, messages, comments => every breach, its line and what to write`. Code, names in backticks, generated blocks and
//! pages of other formats are not read. The terms to write are those of docs/glossary.md.

use std::fs;

use dbd_tests::results::path;
use pulldown_cmark::{Event, Parser, Tag, TagEnd};

use crate::words::messages::messages;
use crate::words::sources::sources;

/// A phrase, and what to write instead.
const PHRASES: [(&str, &str); 34] = [
    ("is none", "is not a valid …, is not representable …"),
    ("are none", "are not valid …"),
    ("told of", "includes, is notified of"),
    ("is told", "is reported"),
    ("are told", "are reported"),
    ("told apart", "distinguished"),
    ("stands", "is, is given with, represents"),
    ("gives way", "deflects"),
    ("give way", "deflect"),
    ("leads off", "moves from"),
    ("for ever", "indefinitely"),
    ("for who", "for users whose"),
    ("for whom", "for users whose"),
    ("the truth", "the reference solution"),
    ("a truth", "a reference solution"),
    ("way of stepping", "method"),
    ("ways of stepping", "methods"),
    ("further off", "less accurate"),
    ("comes to the end", "completes"),
    ("come to the end", "complete"),
    ("turn count", "revolution count"),
    ("turn counts", "revolution counts"),
    ("sweep of dampers", "damper pass"),
    ("sweeps of dampers", "damper passes"),
    ("pass of dampers", "damper pass"),
    ("passes of dampers", "damper passes"),
    ("what is left of", "the rest of, the residual of"),
    ("second opinion", "second solver"),
    ("no help", "did not help"),
    ("none of its business", "not checked"),
    ("goes with", "belongs to, is compatible with"),
    ("go with", "belong to, are compatible with"),
    ("on its own feet", "independently"),
    ("pencil", "matrix weights"),
];

/// Parts of names that no source uses, and the glossary's terms for them.
const NAMES: [(&str, &str); 10] = [
    ("star", "triple"),
    ("pencil", "matrix weights"),
    ("seat", "lumped joint"),
    ("ledger", "cache"),
    ("numerals", "number format"),
    ("judge", "check, monitor"),
    ("trouble", "run failure"),
    ("truth", "mask, reference solution"),
    ("twist", "torsion angle"),
    ("told", "reported"),
];

/// Words with which a heading does not begin: it is a noun phrase.
const NO_HEADING: [&str; 10] =
    ["what", "of", "whether", "who", "that", "why", "how", "where", "when", "for"];

/// The largest median of the words in a page's sentences.
const MAX_MEDIAN: usize = 20;

/// The phrases in a text, each with what to write.
fn phrases(text: &str) -> Vec<String> {
    let lower = without_names(text).to_lowercase();
    let words: Vec<&str> = lower
        .split(|c: char| !c.is_alphanumeric() && c != '\'')
        .filter(|w| !w.is_empty())
        .collect();
    let mut found = Vec::new();
    for (phrase, instead) in PHRASES {
        let wanted: Vec<&str> = phrase.split(' ').collect();
        // "There is none" is plain English.
        let plain = |at: usize| at.checked_sub(1).is_some_and(|before| words[before] == "there");
        let at = (0..words.len()).find(|&i| words[i..].starts_with(&wanted) && !plain(i));
        if at.is_some() {
            found.push(format!("\"{phrase}\": write {instead}"));
        }
    }
    found
}

/// A text without the parts in backticks.
fn without_names(text: &str) -> String {
    text.split('`').step_by(2).collect::<Vec<_>>().join(" x ")
}

/// Retired parts of names in a source, each with what to write. Names of tests are sentences and are not read.
fn retired(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    names(text.parse().unwrap(), &mut |name| {
        let parts = parts(name);
        for (retired, instead) in NAMES {
            let is = |part: &String| part.trim_end_matches('s') == retired.trim_end_matches('s');
            if parts.len() < 5 && parts.iter().any(is) {
                found.push(format!("`{name}`: write {instead}"));
            }
        }
    });
    found.sort();
    found.dedup();
    found
}

/// The parts of a name in snake, camel or capital letters, in lower case.
fn parts(name: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let mut low = false;
    for c in name.chars() {
        if c == '_' || c.is_uppercase() && low {
            parts.push(String::new());
        }
        low = c.is_lowercase() || c.is_numeric();
        if c != '_' {
            parts.last_mut().unwrap().extend(c.to_lowercase());
        }
    }
    parts
}

fn names(tokens: proc_macro2::TokenStream, visit: &mut impl FnMut(&str)) {
    for token in tokens {
        match token {
            proc_macro2::TokenTree::Group(group) => names(group.stream(), visit),
            proc_macro2::TokenTree::Ident(name) => visit(&name.to_string()),
            _ => {}
        }
    }
}

/// The comments of a source, each run of lines joined, with the line where it begins.
fn comments(text: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut open = false;
    for (i, line) in text.lines().enumerate() {
        let Some(comment) = line.trim_start().strip_prefix("//") else {
            open = false;
            // At the end of a line of code.
            found.extend(line.split_once(" // ").map(|(_, text)| (i + 1, text.to_owned())));
            continue;
        };
        let comment = comment.trim_start_matches(['/', '!']);
        if open {
            let (_, text) = found.last_mut().unwrap();
            text.push_str(comment);
        } else {
            found.push((i + 1, comment.to_owned()));
        }
        open = true;
    }
    found
}

/// The texts of a page: of its paragraphs and points, and of its headings, without code.
struct Page {
    texts: Vec<String>,
    headings: Vec<String>,
}

fn page(text: &str) -> Page {
    let mut page = Page { texts: Vec::new(), headings: Vec::new() };
    let (mut open, mut skipped, mut heading) = (String::new(), 0, false);
    let close = |open: &mut String, into: &mut Vec<String>| {
        if !open.trim().is_empty() {
            into.push(std::mem::take(open));
        }
    };
    let options = pulldown_cmark::Options::ENABLE_TABLES;
    for event in Parser::new_ext(text, options) {
        match event {
            Event::Start(Tag::CodeBlock(_) | Tag::Table(_)) => skipped += 1,
            Event::End(TagEnd::CodeBlock | TagEnd::Table) => skipped -= 1,
            Event::Start(Tag::Heading { .. }) => heading = true,
            Event::End(TagEnd::Heading(_)) => {
                heading = false;
                close(&mut open, &mut page.headings);
            }
            Event::Start(Tag::Paragraph | Tag::Item)
            | Event::End(TagEnd::Paragraph | TagEnd::Item)
                if !heading =>
            {
                close(&mut open, &mut page.texts);
            }
            Event::Text(text) if skipped == 0 => open.push_str(&text),
            Event::Code(_) if skipped == 0 => open.push_str("`x`"),
            Event::SoftBreak | Event::HardBreak if skipped == 0 => open.push(' '),
            _ => {}
        }
    }
    page
}

/// The words in each sentence of a text.
fn sentences(text: &str) -> Vec<usize> {
    let mut counts = Vec::new();
    let mut count = 0;
    for word in text.split_whitespace() {
        count += usize::from(word.chars().any(char::is_alphanumeric));
        if word.ends_with(['.', '!', '?', ':']) && !["e.g.", "i.e.", "Fig.", "al."].contains(&word)
        {
            counts.push(count);
            count = 0;
        }
    }
    counts.push(count);
    counts.retain(|count| *count > 1);
    counts
}

/// The pages by their path from the root.
fn pages() -> Vec<(String, String)> {
    let mut names = vec!["README.md".to_owned(), "CONTRIBUTING.md".to_owned()];
    let mut docs: Vec<_> = fs::read_dir(path("docs")).unwrap().map(|f| f.unwrap()).collect();
    docs.sort_by_key(fs::DirEntry::file_name);
    let of_docs = docs.iter().map(|file| file.file_name().into_string().unwrap());
    names.extend(of_docs.filter(|name| name.ends_with(".md")).map(|name| format!("docs/{name}")));
    assert!(names.len() > 40, "{names:?}");
    let read = |name: String| {
        let text = fs::read_to_string(path(&name)).unwrap();
        (name, text)
    };
    names.into_iter().map(read).collect()
}

fn breaches_of_page(name: &str, text: &str) -> Vec<String> {
    let page = page(text);
    let mut found = Vec::new();
    for text in page.texts.iter().chain(&page.headings) {
        let start: String = text.chars().take(60).collect();
        found.extend(phrases(text).into_iter().map(|what| format!("{name}: {start}…: {what}")));
    }
    for heading in &page.headings {
        let first = heading.split_whitespace().next().unwrap_or_default().to_lowercase();
        if NO_HEADING.contains(&first.as_str()) {
            found.push(format!("{name}: heading \"{heading}\": write a noun phrase"));
        }
    }
    let mut lengths: Vec<usize> = page.texts.iter().flat_map(|text| sentences(text)).collect();
    lengths.sort_unstable();
    if lengths.get(lengths.len() / 2).is_some_and(|median| *median > MAX_MEDIAN) {
        let median = lengths[lengths.len() / 2];
        found.push(format!("{name}: the median sentence has {median} words, {MAX_MEDIAN} at most"));
    }
    found
}

#[test]
fn pages_use_the_glossary_s_words() {
    let breaches: Vec<String> =
        pages().iter().flat_map(|(name, text)| breaches_of_page(name, text)).collect();
    assert!(breaches.is_empty(), "{}", breaches.join("\n"));
}

#[test]
fn messages_and_comments_use_the_glossary_s_words() {
    let mut breaches = Vec::new();
    for (file, text) in sources() {
        for message in messages(&text) {
            let found = phrases(&message).into_iter();
            breaches.extend(found.map(|what| format!("{file}: {message}: {what}")));
        }
        breaches.extend(retired(&text).into_iter().map(|what| format!("{file}: {what}")));
        if ["kernel/", "crates/scene/", "crates/plant/"].iter().any(|c| file.starts_with(c)) {
            for (line, comment) in comments(&text) {
                let found = phrases(&comment).into_iter();
                breaches.extend(found.map(|what| format!("{file}:{line}: {what}")));
            }
        }
    }
    assert!(breaches.is_empty(), "{}", breaches.join("\n"));
}

#[test]
fn planted_phrases_are_found() {
    assert_eq!(phrases("A step of 3 s is none.").len(), 1);
    assert_eq!(phrases("`None` where there is none."), [""; 0]);
    assert_eq!(phrases("The name `stands` is code."), [""; 0]);
    assert_eq!(phrases("It stands in the file, and the truth is told apart.").len(), 4);
    let odd = "# What it is\n\nThe joint gives way.\n\n- For who reads\n\n```\nthe truth\n```\n";
    assert_eq!(breaches_of_page("a.md", odd).len(), 3, "{:?}", breaches_of_page("a.md", odd));
    let long = format!("# Length\n\n{}.\n", "word ".repeat(30));
    assert_eq!(breaches_of_page("a.md", &long).len(), 1);
    assert_eq!(parts("TruthOf_MOST_stars2"), ["truth", "of", "most", "stars2"]);
    assert_eq!(retired("fn f(truth: StarsOf) { let judged = 1; }").len(), 2);
    assert_eq!(retired("// The truth\nfn the_truth_is_known_to_a_test() {}"), [""; 0]);
    let source = "// A joint\n// gives way.\nfn f() {} // told apart\n";
    let found = [(1, " A joint gives way.".to_owned()), (3, "told apart".to_owned())];
    assert_eq!(comments(source), found);
}
