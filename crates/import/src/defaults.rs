//! Classes of attributes, and attributes as numbers.
//!
//! `<default>` sections `=> class, element => attributes`. A class inherits and overrides its parent's attributes; an
//! element overrides those of its class.

use std::collections::BTreeMap;

use dbd_scene::nearest;
use nalgebra::Vector3;

use crate::element::{Attribute, Element};
use crate::error::Fault;
use crate::place::Place;

/// The default class.
pub(crate) const MAIN: &str = "main";

/// Forms of actuators, which share one class.
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

/// The attributes of elements by kind; those of actuators of any form merged, and separately in order.
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
    /// Reads the sections in order.
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
                let help = "give <default class=\"…\">: a nested class needs a name";
                return Err(Fault::at(child.place, "<default> has no `class`", help));
            };
            self.class(child, name, class.clone())?;
        }
        Ok(())
    }

    /// The attributes of an element; `within` is the class of its parent.
    pub(crate) fn of<'e>(
        &'e self,
        element: &'e Element,
        within: &str,
    ) -> Result<Attributes<'e>, Fault> {
        self.of_kind(element, &element.name, within)
    }

    /// The actuators of a class, in order.
    pub(crate) fn shortcuts(&self, class: &str) -> &[Element] {
        self.classes.get(class).map_or(&[], |class| &class.shortcuts)
    }

    /// The attributes of an element with the `kind` that classes use for it.
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

    /// Refuses an unknown class.
    pub(crate) fn check(&self, name: &str, place: Place) -> Result<(), Fault> {
        self.class_of(name, place).map(drop)
    }

    fn class_of(&self, name: &str, place: Place) -> Result<&Class, Fault> {
        self.classes.get(name).ok_or_else(|| {
            let meant = nearest(name, self.classes.keys().map(String::as_str));
            let help = meant.map_or("expected the class of a <default>".into(), |meant| {
                format!("expected the class of a <default>: did you mean \"{meant}\"?")
            });
            Fault::at(place, format!("unknown class \"{name}\""), help)
        })
    }
}

/// The attributes of an element, including those of its class.
#[derive(Clone, Copy)]
pub(crate) struct Attributes<'e> {
    /// The element.
    pub(crate) element: &'e Element,
    defaults: &'e [Attribute],
}

impl<'e> Attributes<'e> {
    /// The element's own attributes, without a class.
    pub(crate) fn own(element: &'e Element) -> Self {
        Self { element, defaults: &[] }
    }

    /// An attribute by name.
    pub(crate) fn get(&self, name: &str) -> Option<&'e Attribute> {
        let default = || self.defaults.iter().find(|attribute| attribute.name == name);
        self.element.attribute(name).or_else(default)
    }

    /// The text of an attribute.
    pub(crate) fn text(&self, name: &str) -> Option<&'e str> {
        self.get(name).map(|attribute| attribute.value.as_str())
    }

    /// The position of an attribute, else of the element.
    pub(crate) fn place(&self, name: &str) -> Place {
        self.element.attribute(name).map_or(self.element.place, |attribute| attribute.place)
    }

    /// A given range of numbers.
    pub(crate) fn numbers(
        &self,
        name: &str,
        least: usize,
        most: usize,
    ) -> Result<Option<Vec<f64>>, Fault> {
        // As in MuJoCo a blank value is absent, and that of the class applies.
        let own = self.element.attribute(name).filter(|own| !own.value.trim().is_empty());
        let default = || self.defaults.iter().find(|attribute| attribute.name == name);
        let given = own.or_else(default).filter(|given| !given.value.trim().is_empty());
        let Some(attribute) = given else { return Ok(None) };
        let expected = || match (least, most) {
            (1, 1) => "a number".to_owned(),
            _ if least == most => format!("{least} numbers separated by blanks"),
            _ => format!("{least} to {most} numbers separated by blanks"),
        };
        let refuse = |what: String| {
            let message = format!("`{name}` {what}");
            Fault::at(attribute.place, message, format!("`{name}` must be {}", expected()))
        };
        let words: Vec<&str> = attribute.value.split_ascii_whitespace().collect();
        if !(least..=most).contains(&words.len()) {
            return Err(refuse(format!("has {} numbers", words.len())));
        }
        let number = |word: &&str| {
            let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
            number
                .ok_or_else(|| refuse(format!("contains \"{word}\", which is not a finite number")))
        };
        words.iter().map(number).collect::<Result<_, _>>().map(Some)
    }

    /// One number.
    pub(crate) fn number(&self, name: &str) -> Result<Option<f64>, Fault> {
        Ok(self.numbers(name, 1, 1)?.and_then(|numbers| numbers.first().copied()))
    }

    /// A non-negative number, with a default.
    pub(crate) fn magnitude(&self, name: &str, default: f64) -> Result<f64, Fault> {
        let number = self.number(name)?.unwrap_or(default);
        if number < 0.0 {
            let place = self.get(name).map_or(self.element.place, |attribute| attribute.place);
            let message = format!("`{name}` is {number:?}");
            return Err(Fault::at(place, message, format!("`{name}` must be a number ≥ 0")));
        }
        Ok(number)
    }

    /// Three numbers.
    pub(crate) fn vector(&self, name: &str) -> Result<Option<Vector3<f64>>, Fault> {
        Ok(self.numbers(name, 3, 3)?.map(|numbers| Vector3::from_column_slice(&numbers)))
    }

    /// The index of one of the given words.
    pub(crate) fn word(&self, name: &str, words: &[&str]) -> Result<Option<usize>, Fault> {
        let Some(attribute) = self.get(name) else { return Ok(None) };
        let found = words.iter().position(|word| *word == attribute.value);
        found.map(Some).ok_or_else(|| {
            let message = format!("`{name}` is \"{}\"", attribute.value);
            let list: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
            Fault::at(
                attribute.place,
                message,
                format!("`{name}` must be one of {}", list.join(", ")),
            )
        })
    }

    /// `true` or `false`.
    pub(crate) fn flag(&self, name: &str, default: bool) -> Result<bool, Fault> {
        Ok(self.word(name, &["false", "true"])?.map_or(default, |word| word == 1))
    }

    /// Whether a range applies: `NAMElimited`, or for `auto` whether the range is given.
    pub(crate) fn limited(&self, name: &str, range: &str, automatic: bool) -> Result<bool, Fault> {
        Ok(match self.word(name, &["false", "true", "auto"])? {
            Some(0) => false,
            Some(1) => true,
            // As in MuJoCo, `range="0 0"` cancels the range of a class.
            _ => automatic && self.numbers(range, 2, 2)?.is_some_and(|range| range[0] < range[1]),
        })
    }
}
