//! Classes of attributes, and attributes as numbers.
//!
//! `<default>` sections `=> class, element => attributes`. A class has what its parent has and what it
//! gives itself; an element what it gives itself, then what its class does.

use std::collections::BTreeMap;

use dbd_scene::nearest;
use nalgebra::Vector3;

use crate::element::{Attribute, Element};
use crate::error::Fault;
use crate::place::Place;

/// The class of what names none.
pub(crate) const MAIN: &str = "main";

/// Actuators in their forms, which have one class among them all.
const SHORTCUTS: &[&str] = &[
    "general",
    "motor",
    "position",
    "velocity",
    "intvelocity",
    "damper",
    "cylinder",
    "muscle",
    "adhesion",
    "pid",
    "orientation",
    "dcmotor",
];

/// The attributes of elements by their kinds; of actuators in any form together, and as they stand in their
/// order.
#[derive(Clone, Debug, Default)]
struct Class {
    kinds: BTreeMap<String, Vec<Attribute>>,
    shortcuts: Vec<Element>,
}

/// All classes.
#[derive(Debug, Default)]
pub(crate) struct Defaults {
    classes: BTreeMap<String, Class>,
}

impl Defaults {
    /// Reads the sections in their order.
    pub(crate) fn read(root: &Element) -> Result<Self, Fault> {
        let mut defaults = Self::default();
        defaults.classes.insert(MAIN.into(), Class::default());
        for section in root.sections("default") {
            let name = section.text("class").unwrap_or(MAIN).to_owned();
            let class = defaults.classes.get(&name).or(defaults.classes.get(MAIN));
            let class = class.cloned().unwrap_or_default();
            defaults.class(section, &name, class)?;
        }
        Ok(defaults)
    }

    fn class(&mut self, section: &Element, name: &str, mut class: Class) -> Result<(), Fault> {
        for child in section.children.iter().filter(|child| child.name != "default") {
            let is_actuator = SHORTCUTS.contains(&child.name.as_str());
            let kind = if is_actuator { "actuator" } else { &child.name };
            let kept = class.kinds.entry(kind.to_owned()).or_default();
            for attribute in &child.attributes {
                kept.retain(|old| old.name != attribute.name);
                kept.push(attribute.clone());
            }
            if is_actuator {
                class.shortcuts.push(child.clone());
            }
        }
        self.classes.insert(name.to_owned(), class.clone());
        for child in section.children.iter().filter(|child| child.name == "default") {
            let Some(name) = child.text("class") else {
                let help = "<default class=\"…\">: within another class each has a name";
                return Err(Fault::at(child.place, "has no class", help));
            };
            self.class(child, name, class.clone())?;
        }
        Ok(())
    }

    /// The attributes of an element; `within` is the class of what it stands in.
    pub(crate) fn of<'e>(
        &'e self,
        element: &'e Element,
        within: &str,
    ) -> Result<Attributes<'e>, Fault> {
        self.of_kind(element, &element.name, within)
    }

    /// The actuators that a class gives, in their order.
    pub(crate) fn shortcuts(&self, class: &str) -> &[Element] {
        self.classes.get(class).map_or(&[], |class| &class.shortcuts)
    }

    /// The attributes of an element whose class knows it as `kind`.
    pub(crate) fn of_kind<'e>(
        &'e self,
        element: &'e Element,
        kind: &str,
        within: &str,
    ) -> Result<Attributes<'e>, Fault> {
        let own = element.attribute("class");
        let name = own.map_or(within, |attribute| attribute.value.as_str());
        let place = own.map_or(element.place, |attribute| attribute.place);
        let class = self.class_of(name, place)?;
        let defaults = class.kinds.get(kind).map_or(&[][..], Vec::as_slice);
        Ok(Attributes { element, defaults })
    }

    /// Refuses a class that there is not.
    pub(crate) fn check(&self, name: &str, place: Place) -> Result<(), Fault> {
        self.class_of(name, place).map(drop)
    }

    fn class_of(&self, name: &str, place: Place) -> Result<&Class, Fault> {
        self.classes.get(name).ok_or_else(|| {
            let meant = nearest(name, self.classes.keys().map(String::as_str));
            let help = meant.map_or("a class of a <default>".into(), |meant| {
                format!("a class of a <default>: did you mean \"{meant}\"?")
            });
            Fault::at(place, format!("there is no class \"{name}\""), help)
        })
    }
}

/// The attributes of an element, its class's included.
#[derive(Clone, Copy)]
pub(crate) struct Attributes<'e> {
    /// The element.
    pub(crate) element: &'e Element,
    defaults: &'e [Attribute],
}

impl<'e> Attributes<'e> {
    /// Those of an element without a class.
    pub(crate) fn own(element: &'e Element) -> Self {
        Self { element, defaults: &[] }
    }

    /// One by its name.
    pub(crate) fn get(&self, name: &str) -> Option<&'e Attribute> {
        let default = || self.defaults.iter().find(|attribute| attribute.name == name);
        self.element.attribute(name).or_else(default)
    }

    /// The text of one.
    pub(crate) fn text(&self, name: &str) -> Option<&'e str> {
        self.get(name).map(|attribute| attribute.value.as_str())
    }

    /// Where one stands, else where the element does.
    pub(crate) fn place(&self, name: &str) -> Place {
        self.element.attribute(name).map_or(self.element.place, |attribute| attribute.place)
    }

    /// So many numbers at least and at most.
    pub(crate) fn numbers(
        &self,
        name: &str,
        least: usize,
        most: usize,
    ) -> Result<Option<Vec<f64>>, Fault> {
        // As in MuJoCo a blank value is none, and that of the class counts.
        let own = self.element.attribute(name).filter(|own| !own.value.trim().is_empty());
        let default = || self.defaults.iter().find(|attribute| attribute.name == name);
        let given = own.or_else(default).filter(|given| !given.value.trim().is_empty());
        let Some(attribute) = given else { return Ok(None) };
        let expected = || match (least, most) {
            (1, 1) => "a number".to_owned(),
            _ if least == most => format!("{least} numbers with blanks between them"),
            _ => format!("{least} to {most} numbers with blanks between them"),
        };
        let refuse = |what: String| {
            let message = format!("`{name}` {what}");
            Fault::at(attribute.place, message, format!("`{name}` is {}", expected()))
        };
        let words: Vec<&str> = attribute.value.split_ascii_whitespace().collect();
        if !(least..=most).contains(&words.len()) {
            return Err(refuse(format!("has {} numbers", words.len())));
        }
        let number = |word: &&str| {
            let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
            number.ok_or_else(|| refuse(format!("holds \"{word}\", which is no finite number")))
        };
        words.iter().map(number).collect::<Result<_, _>>().map(Some)
    }

    /// One number.
    pub(crate) fn number(&self, name: &str) -> Result<Option<f64>, Fault> {
        Ok(self.numbers(name, 1, 1)?.and_then(|numbers| numbers.first().copied()))
    }

    /// A number that is not negative, with a default.
    pub(crate) fn magnitude(&self, name: &str, default: f64) -> Result<f64, Fault> {
        let number = self.number(name)?.unwrap_or(default);
        if number < 0.0 {
            let place = self.get(name).map_or(self.element.place, |attribute| attribute.place);
            let message = format!("`{name}` is {number:?}");
            return Err(Fault::at(place, message, format!("`{name}` is a number ≥ 0")));
        }
        Ok(number)
    }

    /// Three numbers.
    pub(crate) fn vector(&self, name: &str) -> Result<Option<Vector3<f64>>, Fault> {
        Ok(self.numbers(name, 3, 3)?.map(|numbers| Vector3::from_column_slice(&numbers)))
    }

    /// One of some words, by its place among them.
    pub(crate) fn word(&self, name: &str, words: &[&str]) -> Result<Option<usize>, Fault> {
        let Some(attribute) = self.get(name) else { return Ok(None) };
        let found = words.iter().position(|word| *word == attribute.value);
        found.map(Some).ok_or_else(|| {
            let message = format!("`{name}` is \"{}\"", attribute.value);
            let list: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
            Fault::at(attribute.place, message, format!("`{name}` is one of {}", list.join(", ")))
        })
    }

    /// `true` or `false`.
    pub(crate) fn flag(&self, name: &str, default: bool) -> Result<bool, Fault> {
        Ok(self.word(name, &["false", "true"])?.map_or(default, |word| word == 1))
    }

    /// Whether a range counts: `NAMElimited`, or where that is `auto` whether the range is given.
    pub(crate) fn limited(&self, name: &str, range: &str, automatic: bool) -> Result<bool, Fault> {
        Ok(match self.word(name, &["false", "true", "auto"])? {
            Some(0) => false,
            Some(1) => true,
            // As in MuJoCo: `range="0 0"` is how a file takes back the range of a class.
            _ => automatic && self.numbers(range, 2, 2)?.is_some_and(|range| range[0] < range[1]),
        })
    }
}
