//! `[parameters]`: named values that a scene uses more than once or that are varied.
//!
//! `table => names with their quantities`. A parameter is a number or a text that may refer to others in any order,
//! without cycles. A change to a plain number is in the SI unit of the parameter's dimension in the file.

use std::collections::VecDeque;

use crate::error::{SceneError, Source};
use crate::nearest::nearest;
use crate::quantity::{NameFault, Quantity, Scope, check_name, words};
use crate::shortened::shortened;
use crate::text::{Kind as _, Measure, Table, Value};

/// A named value of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// \[[`unit`](Self::unit)\] its value.
    pub value: f64,
    /// The SI unit of its dimension, `N/m`; empty for a plain number.
    pub unit: String,
    /// The line, from 1, in the scene file.
    pub(crate) line: Option<usize>,
    /// Whether anything in the scene refers to it.
    pub(crate) used: bool,
}

/// A row of the table.
struct Row<'t> {
    name: &'t str,
    value: Value<'t>,
    /// The rows that its text refers to.
    needs: Vec<usize>,
}

/// Reads the parameters of a scene. `before` are their values without the changes.
///
/// # Errors
/// Invalid names or values, unknown references and cycles.
pub(crate) fn read(root: &Table<'_>, before: Option<&Scope>) -> Result<Scope, SceneError> {
    let Some(value) = root.value("parameters") else { return Ok(Scope::default()) };
    let table = value.labelled("a table of names and their values", "[parameters]")?;
    let values = table.values();
    let mut scope = Scope::of(values.iter().map(|(_, name, _)| (*name).to_owned()));
    let mut rows = Vec::new();
    for (place, name, value) in values {
        if value.source.is_change(place.start) {
            let known: Vec<_> = rows.iter().map(|row: &Row<'_>| row.name).collect();
            return Err(unknown(value.source, place, name, &known));
        }
        check_name(name).map_err(|fault| wrong_name(&table, name, fault))?;
        let needs = match value.get().as_str() {
            Some(text) => words(text).filter_map(|word| scope.row(word)).collect(),
            None => Vec::new(),
        };
        rows.push(Row { name, value, needs });
    }
    for row in order(&rows)? {
        let Row { name, value, .. } = &rows[row];
        // Everything that a parameter refers to is known by now.
        let source = Source { scope: Some(&scope), ..value.source };
        let within = Value { source, key: value.key.clone(), owner: value.owner.clone(), ..*value };
        let mut quantity = Measure.read(&within)?;
        if value.source.is_change(value.span().start) {
            quantity = kept(value, quantity, before.and_then(|before| before.look(name)))?;
        }
        scope.set(row, quantity);
    }
    Ok(scope)
}

/// The parameters with their values.
pub(crate) fn all(root: &Table<'_>, scope: &Scope) -> Vec<Parameter> {
    let table = root.value("parameters");
    let table = table.and_then(|value| value.labelled("a table", "[parameters]").ok());
    let places = table.map_or_else(Vec::new, |table| table.values());
    // One pass over the text: there may be thousands.
    let (mut line, mut from) = (1, 0);
    let mut parameters = Vec::new();
    for ((place, _, _), (name, quantity, used)) in places.into_iter().zip(scope.iter()) {
        line += root.breaks(from..place.start);
        from = place.start;
        parameters.push(Parameter {
            name: name.to_owned(),
            value: quantity.value,
            unit: quantity.dimension.to_string(),
            line: Some(line),
            used,
        });
    }
    parameters
}

/// The rows ordered by dependency.
fn order(rows: &[Row<'_>]) -> Result<Vec<usize>, SceneError> {
    let mut needed_by = vec![Vec::new(); rows.len()];
    let mut open: Vec<usize> = rows.iter().map(|row| row.needs.len()).collect();
    for (i, row) in rows.iter().enumerate() {
        for need in &row.needs {
            needed_by[*need].push(i);
        }
    }
    let mut ready: VecDeque<usize> = (0..rows.len()).filter(|row| open[*row] == 0).collect();
    let mut order = Vec::new();
    while let Some(row) = ready.pop_front() {
        order.push(row);
        for next in &needed_by[row] {
            open[*next] -= 1;
            if open[*next] == 0 {
                ready.push_back(*next);
            }
        }
    }
    match open.iter().position(|open| *open > 0) {
        None => Ok(order),
        Some(first) => Err(circle(rows, &open, first)),
    }
}

/// Most names of a cycle in a message.
const SHOWN: usize = 8;

/// The error of parameters that depend on each other; `first` leads into the cycle.
fn circle(rows: &[Row<'_>], open: &[usize], first: usize) -> SceneError {
    let mut seen = vec![None; rows.len()];
    let mut way = Vec::new();
    let mut row = first;
    // Each remaining row depends on a remaining row.
    while seen[row].is_none() {
        seen[row] = Some(way.len());
        way.push(row);
        let next = rows[row].needs.iter().find(|need| open[**need] > 0);
        row = next.copied().unwrap_or(row);
    }
    let circle = &way[seen[row].unwrap_or(0)..];
    let mut shown: Vec<_> = circle.iter().take(SHOWN).map(|row| quoted(rows[*row].name)).collect();
    if circle.len() > SHOWN {
        shown.push("…".into());
    }
    shown.push(quoted(rows[row].name));
    let problem = format!("is part of a cycle: {}", shown.join(" needs "));
    rows[row].value.refuse_with(
        &problem,
        "give one of them a value that does not depend on the \
                                           others",
    )
}

fn quoted(name: &str) -> String {
    format!("`{}`", shortened(name))
}

fn wrong_name(table: &Table<'_>, name: &str, fault: NameFault) -> SceneError {
    let (problem, help) = match fault {
        NameFault::NoWord => (
            "is not a valid parameter name",
            "use letters, digits and `_`, no digit first; not `inf` or `nan`".into(),
        ),
        NameFault::Unit => (
            "has the name of a unit",
            format!("use another name, e.g. `{name}_1`; in a value `{name}` is always the unit"),
        ),
        NameFault::Constant => ("is reserved for the number π", "use another name".into()),
    };
    table.refuse_key(name, problem, help)
}

/// The error of a change of an unknown parameter.
fn unknown(
    source: Source<'_>,
    place: std::ops::Range<usize>,
    name: &str,
    known: &[&str],
) -> SceneError {
    let mut help = match nearest(name, known.iter().copied()) {
        Some(meant) => format!("did you mean `{meant}`? "),
        None => String::new(),
    };
    let some: Vec<_> = known.iter().take(12).map(|name| shortened(name)).collect();
    help += &format!("known parameters: {}", some.join(", "));
    source.refuse(place, format!("the scene has no parameter `{}`", shortened(name)), help)
}

/// The changed value of a parameter, in the dimension that it has in the file.
fn kept(
    value: &Value<'_>,
    now: Quantity,
    before: Option<Quantity>,
) -> Result<Quantity, SceneError> {
    let Some(before) = before.filter(|before| !before.dimension.is_none()) else { return Ok(now) };
    if now.dimension.is_none() {
        return Ok(Quantity { dimension: before.dimension, ..now });
    }
    if now.dimension != before.dimension {
        let problem = format!("is a value in {}", now.dimension);
        let help =
            format!("expected a value in {}, as in the file, or a plain number", before.dimension);
        return Err(value.refuse_with(&problem, help));
    }
    Ok(now)
}
