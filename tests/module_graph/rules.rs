//! What a crate's modules keep to: a list of all in its documentation, arrows to earlier ones only.
//!
//! `sources => every breach in words`. The list is that of `lib.rs`, points `- [`a`], [`b`]: what they
//! do`; a private module may stand without brackets before the colon. Within a folder, whose modules
//! no list orders, no circle.

use std::collections::{BTreeMap, BTreeSet};

use crate::sources::{Names, Sources};

/// A point of the list: modules and what they do.
#[derive(Debug)]
pub struct Floor {
    /// In the order of the list.
    pub modules: Vec<String>,
    /// The words, without marks.
    pub words: String,
}

/// The list of modules in the crate's documentation.
pub fn floors(sources: &Sources) -> Vec<Floor> {
    let modules: BTreeSet<&str> =
        sources.modules.keys().filter_map(|path| path.first()).map(String::as_str).collect();
    let mut points: Vec<String> = Vec::new();
    let mut open = false;
    for line in sources.doc.lines().map(|line| line.strip_prefix(' ').unwrap_or(line)) {
        if let Some(point) = line.strip_prefix("- ") {
            points.push(point.into());
            open = true;
        } else if open && line.starts_with("  ") {
            let point = points.last_mut().unwrap_or_else(|| unreachable!("a point is open"));
            point.push_str(&line[1..]);
        } else {
            open = false;
        }
    }
    let floor = |point: String| {
        let (mut names, mut words) = (Vec::new(), String::new());
        let mut head = true;
        for (i, part) in point.split('`').enumerate() {
            if i % 2 == 0 {
                head &= !part.contains(':');
                words += part;
                continue;
            }
            let name = part.strip_prefix("mod@").unwrap_or(part);
            let linked = words.ends_with('[');
            let lower = name.chars().all(|c| c.is_lowercase() || c.is_numeric() || c == '_');
            // A link of another kind, `[`F64`]`, is left; what looks like a module must be one.
            if lower && (linked || head && modules.contains(name)) {
                names.push(name.to_owned());
            }
            words += name;
        }
        Floor { modules: names, words: words.replace(['[', ']'], "") }
    };
    points.into_iter().map(floor).filter(|floor| !floor.modules.is_empty()).collect()
}

/// Every breach, each a line.
pub fn breaches(sources: &Sources) -> Vec<String> {
    let mut breaches = Vec::new();
    let listed: Vec<String> = floors(sources).into_iter().flat_map(|f| f.modules).collect();
    let modules: BTreeSet<&String> =
        sources.modules.keys().filter_map(|path| path.first()).collect();
    for module in &modules {
        match listed.iter().filter(|name| name == module).count() {
            0 => breaches.push(format!("`{module}` is missing in the list of lib.rs")),
            1 => {}
            times => breaches.push(format!("`{module}` is {times} times in the list of lib.rs")),
        }
    }
    for name in listed.iter().filter(|name| !modules.contains(name)) {
        breaches.push(format!("`{name}` is in the list of lib.rs and no module of the crate"));
    }
    let place = |name: &String| listed.iter().position(|listed| listed == name);
    for ((from, to), path) in &sources.arrows {
        let Some(first) = from.first() else { continue };
        let file = &sources.modules[from];
        match to.first() {
            None => breaches.push(format!(
                "{file} uses crate::{path}, which lib.rs defines: it stands above all modules"
            )),
            Some(to) if to != first => {
                let upward = place(first).zip(place(to)).is_some_and(|(from, to)| from < to);
                if upward {
                    breaches.push(format!(
                        "{file} uses crate::{path}: `{to}` stands after `{first}` in the list"
                    ));
                }
            }
            Some(_) => {}
        }
    }
    let folders: BTreeSet<Names> = sources
        .modules
        .keys()
        .filter(|path| path.len() > 1)
        .map(|path| path[..path.len() - 1].to_vec())
        .collect();
    for folder in folders {
        for circle in circles(&arrows_within(sources, &folder)) {
            breaches.push(format!("circle within {}: {}", folder.join("/"), circle.join(" → ")));
        }
    }
    breaches
}

/// The arrows among the modules that lie in a folder, the folder's own file as `mod`.
fn arrows_within(sources: &Sources, folder: &[String]) -> BTreeMap<String, BTreeSet<String>> {
    let node = |path: &Names| {
        path.starts_with(folder)
            .then(|| path.get(folder.len()).cloned().unwrap_or_else(|| "mod".into()))
    };
    let mut arrows: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (from, to) in sources.arrows.keys() {
        if let (Some(from), Some(to)) = (node(from), node(to))
            && from != to
        {
            arrows.entry(from).or_default().insert(to);
        }
    }
    arrows
}

/// Circles, one through each module that no other of them passes; none where there is no circle.
fn circles(arrows: &BTreeMap<String, BTreeSet<String>>) -> Vec<Vec<String>> {
    let mut circles: Vec<Vec<String>> = Vec::new();
    for start in arrows.keys() {
        if circles.iter().flatten().any(|module| module == start) {
            continue;
        }
        // The shortest way back to the start, breadth first.
        let mut ways: Vec<Vec<&String>> = vec![vec![start]];
        let mut seen = BTreeSet::new();
        while !ways.is_empty() {
            let next = |way: &Vec<&String>| arrows.get(way[way.len() - 1]).into_iter().flatten();
            if let Some(way) = ways.iter().find(|way| next(way).any(|to| to == start)) {
                circles.push(way.iter().copied().chain([start]).cloned().collect());
                break;
            }
            let mut longer = Vec::new();
            for way in &ways {
                for to in next(way).filter(|to| seen.insert((*to).clone())) {
                    longer.push(way.iter().copied().chain([to]).collect());
                }
            }
            ways = longer;
        }
    }
    circles
}
