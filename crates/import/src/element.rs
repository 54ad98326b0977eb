//! XML elements with their positions; included files are merged into one tree.
//!
//! `text, folder => tree`. An `<include file="…"/>` is replaced by the contents of that file's root; its path is
//! relative to the folder of the first file.

use std::path::Path;

use dbd_scene::file::read_text;

use crate::error::{Fault, ImportError};
use crate::file;
use crate::place::{Place, Texts};

/// Maximum nesting depth of elements, as in MuJoCo's reader.
const DEPTH: usize = 500;
/// Maximum number of elements and texts of a file.
const NODES: u32 = 10_000_000;
/// Maximum number of attributes of an element: the XML reader compares each with all others.
const ATTRIBUTES: usize = 1000;

/// An element.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Element {
    /// Its name.
    pub(crate) name: String,
    /// Its attributes in order.
    pub(crate) attributes: Vec<Attribute>,
    /// Its child elements.
    pub(crate) children: Vec<Element>,
    /// The position of its name in the text.
    pub(crate) place: Place,
}

/// An attribute.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Attribute {
    /// Its name.
    pub(crate) name: String,
    /// Its value.
    pub(crate) value: String,
    /// The position of the value in the text.
    pub(crate) place: Place,
}

impl Element {
    /// The attribute with a name.
    pub(crate) fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|attribute| attribute.name == name)
    }

    /// An attribute's value; `None` if absent.
    pub(crate) fn text(&self, name: &str) -> Option<&str> {
        self.attribute(name).map(|attribute| attribute.value.as_str())
    }

    /// A description of the element: its kind and name.
    pub(crate) fn called(&self) -> String {
        match self.text("name") {
            Some(name) => format!("{} `{name}`", self.name),
            None => format!("{} without a name", self.name),
        }
    }

    /// All sections with a name, such as `<worldbody>` or `<actuator>`: a file may have several.
    pub(crate) fn sections<'e>(&'e self, name: &str) -> impl Iterator<Item = &'e Element> {
        self.children.iter().filter(move |child| child.name == name)
    }
}

/// The texts and the merged tree.
pub(crate) struct Document {
    /// The texts.
    pub(crate) texts: Texts,
    /// `<mujoco>` or `<robot>`.
    pub(crate) root: Element,
}

impl Document {
    /// Reads a text and its included files.
    pub(crate) fn read(text: &str, name: &str, folder: &Path) -> Result<Self, ImportError> {
        let mut texts = Texts::default();
        let mut root = parse(text, name, None, &mut texts)?;
        match root.name.as_str() {
            "mujoco" => include(&mut root, folder, &mut texts)?,
            "robot" => {}
            other => {
                let found = format!("the root element is <{other}>");
                let help = "expected <mujoco> (MJCF) or <robot> (URDF)";
                return Err(Fault::at(root.place, found, help).refuse(&texts));
            }
        }
        Ok(Self { texts, root })
    }
}

/// Replaces include elements by the contents of the included files.
fn include(element: &mut Element, folder: &Path, texts: &mut Texts) -> Result<(), ImportError> {
    let mut children = Vec::with_capacity(element.children.len());
    for mut child in std::mem::take(&mut element.children) {
        if child.name != "include" {
            include(&mut child, folder, texts)?;
            children.push(child);
            continue;
        }
        let Some(file) = child.attribute("file") else {
            let help = "give <include file=\"…\"/>, relative to the folder of the first file";
            return Err(Fault::at(child.place, "<include> has no `file`", help).refuse(texts));
        };
        let name = folder.join(&file.value).display().to_string();
        let refuse = |message: String, help: &str, texts: &Texts| {
            Err(Fault::at(file.place, message, help).refuse(texts))
        };
        if texts.knows(&name) {
            let message = format!("{name} is included a second time");
            return refuse(message, "include each file once, and not from itself", texts);
        }
        let text = match file::within(folder, &file.value).and_then(|path| read_text(&path)) {
            Ok(text) => text,
            Err(reason) => {
                let message = format!("cannot read {name}: {reason}");
                return refuse(
                    message,
                    "give a path within, and relative to, the folder of the first file",
                    texts,
                );
            }
        };
        let mut included = parse(&text, &name, Some(file.place), texts)?;
        include(&mut included, folder, texts)?;
        children.append(&mut included.children);
    }
    element.children = children;
    Ok(())
}

/// Reads one text. An included file may be any file, so its text is not shown until it is known to be XML: faults are
/// reported at the include.
fn parse(
    text: &str,
    name: &str,
    included: Option<Place>,
    texts: &mut Texts,
) -> Result<Element, ImportError> {
    let file = texts.add(name, text);
    let fault = match (xml(text, file), included) {
        (Ok(document), _) => {
            return Ok(element(document.root_element(), file, &Lines::of(text)));
        }
        (Err(fault), None) => fault,
        (Err(fault), Some(place)) => {
            let message = format!("{name} is not valid XML, see its line {}", fault.line());
            Fault::at(place, message, "expected well-formed XML in UTF-8")
        }
    };
    Err(fault.refuse(texts))
}

/// The document of a text, or why it is refused.
fn xml(text: &str, file: usize) -> Result<roxmltree::Document<'_>, Fault> {
    if let Some(fault) = too_large(text, file) {
        return Err(fault);
    }
    let options = roxmltree::ParsingOptions { nodes_limit: NODES, ..Default::default() };
    roxmltree::Document::parse_with_options(text, options).map_err(|error| {
        let place = position(text, file, error.pos());
        let message = format!("not valid XML: {}", error_text(&error));
        Fault::at(place, message, "expected well-formed XML in UTF-8")
    })
}

/// The reader's error without its position, which is shown separately.
fn error_text(error: &roxmltree::Error) -> String {
    let text = error.to_string();
    match text.rsplit_once(" at ") {
        Some((what, place)) if place.contains(':') => what.to_owned(),
        _ => text,
    }
}

/// The position of a line and a column.
fn position(text: &str, file: usize, at: roxmltree::TextPos) -> Place {
    let line = usize::try_from(at.row).unwrap_or(1);
    let column = usize::try_from(at.col).unwrap_or(1).saturating_sub(1);
    let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let rest = &text[start.min(text.len())..];
    let start = start + rest.chars().take(column).map(char::len_utf8).sum::<usize>();
    let end = start + text.get(start..).and_then(|t| t.chars().next()).map_or(0, char::len_utf8);
    Place { file, start, end, line }
}

/// The first element nested deeper than [`DEPTH`] or with more than [`ATTRIBUTES`] attributes: checked before parsing,
/// because XML readers recurse at each level.
fn too_large(text: &str, file: usize) -> Option<Fault> {
    let (mut depth, mut byte) = (0_usize, 0);
    let ends = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("<!", ">")];
    while let Some(found) = text[byte..].find('<') {
        let start = byte + found;
        let rest = &text[start..];
        if let Some((_, end)) = ends.iter().find(|(begin, _)| rest.starts_with(begin)) {
            byte = start + rest.find(end).map_or(rest.len(), |length| length + end.len());
            continue;
        }
        let length = tag_length(rest);
        let tag = &rest[..length];
        if tag.starts_with("</") {
            depth = depth.saturating_sub(1);
        } else if !tag.ends_with("/>") {
            depth += 1;
        }
        let problem = if depth > DEPTH {
            Some((
                format!("the element is nested more than {DEPTH} levels deep"),
                "reduce the nesting depth",
            ))
        } else if attributes(tag) > ATTRIBUTES {
            Some((
                format!("the element has more than {ATTRIBUTES} attributes"),
                "expected an element of MJCF",
            ))
        } else {
            None
        };
        if let Some((message, help)) = problem {
            let line = text[..start].matches('\n').count() + 1;
            // An unterminated tag is not shown to the end of the text.
            let place = Place { file, start, end: start + 1, line };
            return Some(Fault::at(place, message, help));
        }
        byte = start + length;
    }
    None
}

/// Number of attributes of a tag: each has one equals sign outside quotes.
fn attributes(tag: &str) -> usize {
    let mut quote = None;
    let mut count = 0;
    for letter in tag.chars() {
        match (quote, letter) {
            (None, '"' | '\'') => quote = Some(letter),
            (Some(open), _) if open == letter => quote = None,
            (None, '=') => count += 1,
            _ => {}
        }
    }
    count
}

/// The bytes of a tag, including any `>` within quotes.
fn tag_length(text: &str) -> usize {
    let mut quote = None;
    for (byte, letter) in text.char_indices() {
        match (quote, letter) {
            (None, '"' | '\'') => quote = Some(letter),
            (Some(open), _) if open == letter => quote = None,
            (None, '>') => return byte + 1,
            _ => {}
        }
    }
    text.len()
}

/// The starts of lines.
struct Lines(Vec<usize>);

impl Lines {
    fn of(text: &str) -> Self {
        let after = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(i, _)| i + 1);
        Self(after.collect())
    }

    fn line(&self, byte: usize) -> usize {
        self.0.partition_point(|start| *start <= byte) + 1
    }
}

fn element(node: roxmltree::Node<'_, '_>, file: usize, lines: &Lines) -> Element {
    let place = |start: usize, end: usize| Place { file, start, end, line: lines.line(start) };
    let name = node.tag_name().name().to_owned();
    let start = node.range().start;
    let attributes = node.attributes().map(|attribute| {
        let value = attribute.range_value();
        Attribute {
            name: attribute.name().to_owned(),
            value: attribute.value().to_owned(),
            place: place(value.start, value.end),
        }
    });
    let attributes = attributes.collect();
    let within = node.children().filter(roxmltree::Node::is_element);
    let children = within.map(|child| element(child, file, lines)).collect();
    Element { place: place(start, start + 1 + name.len()), name, attributes, children }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_those_of_the_text() {
        let text = "<mujoco>\n <!-- <deep> -->\n <option a='ü>' timestep=\"0.1\"/>\n</mujoco>";
        let document = Document::read(text, "a.xml", Path::new("")).unwrap();
        let option = &document.root.children[0];
        assert_eq!((option.name.as_str(), option.place.line), ("option", 3));
        let value = option.attribute("timestep").unwrap();
        assert_eq!(&text[value.place.start..value.place.end], "0.1");
        assert_eq!(document.texts.shown(value.place), "line 3");
    }

    #[test]
    fn what_is_no_xml_is_refused_where_it_breaks() {
        let refused = |text: &str| {
            let Err(ImportError::Refused(refusal)) = Document::read(text, "a.xml", Path::new(""))
            else {
                panic!("{text}");
            };
            assert!(refusal.message.starts_with("not valid XML: "), "{refusal}");
            (refusal.line, refusal.column)
        };
        let places = [
            "<mujoco>\n<body",
            "<mujoco>\n <a></b>\n</mujoco>",
            "",
            "<mujoco a='1' a='2'/>",
            "<!DOCTYPE x [<!ENTITY a 'b'>]><mujoco>&a;</mujoco>",
        ];
        assert_eq!(places.map(refused), [(1, 1), (2, 5), (1, 1), (1, 15), (1, 1)]);
    }

    #[test]
    fn deep_nests_are_refused_before_anything_calls_itself_as_often() {
        let nest = |depth: usize| {
            format!("<mujoco>{}{}</mujoco>", "<a>\n".repeat(depth), "</a>".repeat(depth))
        };
        assert!(Document::read(&nest(DEPTH - 1), "a", Path::new("")).is_ok());
        for depth in [DEPTH, 1_000_000] {
            let Err(ImportError::Refused(refusal)) =
                Document::read(&nest(depth), "a", Path::new(""))
            else {
                panic!("{depth}");
            };
            assert_eq!((refusal.line, refusal.column), (DEPTH, 1));
        }
    }
}
