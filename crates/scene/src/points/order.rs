//! The order in which points and bodies are read: by dependency.
//!
//! `names in tables => order, or a cycle`. The order is that of the file, points first, except where one depends on a
//! later one. Unknown names are left to the readers.

use std::collections::BTreeMap;

use toml::de::DeValue;

use crate::error::SceneError;
use crate::shortened::shortened;
use crate::text::{Table, Value};

/// A point or a body, by its row in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Node {
    Point(usize),
    Body(usize),
}

/// Most items of a cycle in a message.
const SHOWN: usize = 6;

/// All points and bodies, ordered by dependency.
pub(crate) fn order(
    points: &[(String, Value<'_>)],
    bodies: &[(String, Table<'_>)],
) -> Result<Vec<Node>, SceneError> {
    let point_rows = points.iter().enumerate().map(|(row, (name, _))| (name.as_str(), row));
    let body_rows = bodies.iter().enumerate().map(|(row, (name, _))| (name.as_str(), row));
    let (point_rows, body_rows): (BTreeMap<_, _>, BTreeMap<_, _>) =
        (point_rows.collect(), body_rows.collect());
    let needs = |node: Node| -> Vec<Node> {
        let names = match node {
            Node::Point(row) => of_point(&points[row].1),
            Node::Body(row) => of_body(&bodies[row].1),
        };
        let find = |name: &Name| match name {
            Name::Point(name) => point_rows.get(name.as_str()).map(|row| Node::Point(*row)),
            Name::Body(name) => body_rows.get(name.as_str()).map(|row| Node::Body(*row)),
        };
        names.iter().filter_map(find).collect()
    };

    let all = (0..points.len()).map(Node::Point).chain((0..bodies.len()).map(Node::Body));
    let mut ordered = Vec::new();
    let mut is_done = BTreeMap::new();
    for node in all {
        // Depth first with an explicit stack: a chain may have thousands of points.
        let mut stack = Vec::new();
        let mut next = Some(node).filter(|node| !is_done.contains_key(node));
        while let Some(node) = next.take() {
            is_done.insert(node, false);
            stack.push((node, needs(node).into_iter()));
            while let Some((node, needed)) = stack.last_mut() {
                match needed.next() {
                    Some(other) if is_done.get(&other) == Some(&true) => {}
                    Some(other) if is_done.contains_key(&other) => {
                        let circle = stack.iter().map(|(node, _)| *node);
                        let circle = circle.skip_while(|node| *node != other).collect();
                        return Err(refuse(circle, points, bodies));
                    }
                    Some(other) => {
                        next = Some(other);
                        break;
                    }
                    None => {
                        is_done.insert(*node, true);
                        ordered.push(*node);
                        stack.pop();
                    }
                }
            }
        }
    }
    Ok(ordered)
}

/// A name with its expected kind.
enum Name {
    Point(String),
    Body(String),
}

/// The names that a point depends on.
fn of_point(value: &Value<'_>) -> Vec<Name> {
    let mut names = Vec::new();
    let DeValue::Table(table) = value.get() else {
        points_in(value.get(), &mut names);
        return names;
    };
    for key in ["from", "toward", "about", "frame"] {
        match table.get(key).map(|value| value.get_ref()) {
            Some(DeValue::String(body)) if key == "frame" => {
                names.push(Name::Body(body.clone().into_owned()));
            }
            Some(value) => points_in(value, &mut names),
            None => {}
        }
    }
    names
}

/// The names that a body depends on.
fn of_body(table: &Table<'_>) -> Vec<Name> {
    let mut names = Vec::new();
    if let Some(frame) = table.value("frame").and_then(|value| value.get().as_str()) {
        names.push(Name::Body(frame.to_owned()));
    }
    if let Some(position) = table.value("position") {
        points_in(position.get(), &mut names);
    }
    if let Some(link) = table.value("link").and_then(|value| value.table("").ok()) {
        for key in ["from", "to"] {
            if let Some(value) = link.value(key) {
                points_in(value.get(), &mut names);
            }
        }
    }
    names
}

/// The texts in a value.
fn points_in(value: &DeValue<'_>, names: &mut Vec<Name>) {
    match value {
        DeValue::String(name) => names.push(Name::Point(name.clone().into_owned())),
        DeValue::Array(array) => {
            for entry in array.iter() {
                if let DeValue::String(name) = entry.get_ref() {
                    names.push(Name::Point(name.clone().into_owned()));
                }
            }
        }
        _ => {}
    }
}

/// The error of a cycle, at its first item.
fn refuse(
    circle: Vec<Node>,
    points: &[(String, Value<'_>)],
    bodies: &[(String, Table<'_>)],
) -> SceneError {
    // Start with the one that is first in the file.
    let start = |node: &Node| match node {
        Node::Point(row) => points[*row].1.span().start,
        Node::Body(row) => bodies[*row].1.start(),
    };
    let first = circle.iter().enumerate().min_by_key(|(_, node)| start(node)).map_or(0, |(i, _)| i);
    let name = |node: &Node| match node {
        Node::Point(row) => format!("point `{}`", shortened(&points[*row].0)),
        Node::Body(row) => format!("body `{}`", shortened(&bodies[*row].0)),
    };
    let mut names: Vec<String> =
        circle.iter().cycle().skip(first).take(circle.len().min(SHOWN)).map(name).collect();
    if circle.len() > SHOWN {
        names.push(format!("{} more", circle.len() - SHOWN));
    }
    names.push(name(&circle[first]));
    let problem = format!("depends on itself: {}", names.join(" -> "));
    let help = "give one of them a position that does not depend on the others";
    match circle[first] {
        Node::Point(row) => points[row].1.refuse_with(&problem, help),
        Node::Body(row) => bodies[row].1.refuse(&problem, help),
    }
}
