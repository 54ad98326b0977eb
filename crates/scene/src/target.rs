//! Named elements that inputs and read-outs refer to.

use crate::error::SceneError;
use crate::names::Names;
use crate::nearest::nearest;
use crate::shortened::shortened;
use crate::text::{Kind, Value};

/// The names of joints, raw TSDAs, points on lines and torsion springs; all are unique.
pub(crate) type Elements = Names<Target>;

/// A named element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// A joint by its row.
    Joint(usize),
    /// A raw TSDA by its group.
    Tsda(usize),
    /// A point on a line by its group.
    PointOnLine(usize),
    /// A torsion spring by its row.
    TorsionSpring(usize),
    /// An interaction by its row.
    Interaction(usize),
    /// A raw TSDA with a free length that an input sets, by the row of its interaction.
    Winch(usize),
}

/// Accepted kinds of elements.
#[derive(Clone, Copy)]
pub(crate) struct Kinds {
    suits: fn(&Target) -> bool,
    /// `a joint or …`.
    expected: &'static str,
}

impl Kinds {
    /// Elements that rotate about an axis.
    pub(crate) const TURNING: Self = Self {
        suits: |target| matches!(target, Target::Joint(_) | Target::TorsionSpring(_)),
        expected: "the name of a joint or of a torsion_spring",
    };
    /// A joint.
    pub(crate) const JOINT: Self = Self {
        suits: |target| matches!(target, Target::Joint(_)),
        expected: "the name of a joint",
    };
    /// A TSDA.
    pub(crate) const TSDA: Self =
        Self { suits: |target| matches!(target, Target::Tsda(_)), expected: "the name of a tsda" };
    /// A TSDA, also with a free length that an input sets.
    pub(crate) const ANY_TSDA: Self = Self {
        suits: |target| matches!(target, Target::Tsda(_) | Target::Winch(_)),
        expected: "the name of a tsda",
    };
    /// Elements that pull at points.
    pub(crate) const PULLING: Self = Self {
        suits: |target| {
            matches!(target, Target::Joint(_) | Target::Tsda(_) | Target::PointOnLine(_))
        },
        expected: "the name of a joint, a tsda or a point_on_line",
    };
    /// An interaction.
    pub(crate) const INTERACTION: Self = Self {
        suits: |target| matches!(target, Target::Interaction(_) | Target::Winch(_)),
        expected: "the name of an interaction",
    };
}

/// The name of an element of some kinds.
#[derive(Clone, Copy)]
pub(crate) struct ElementName<'e> {
    pub(crate) elements: &'e Elements,
    pub(crate) kinds: Kinds,
}

impl Kind for ElementName<'_> {
    type Output = (String, Target);

    fn expected(&self) -> String {
        self.kinds.expected.into()
    }

    fn read(&self, value: &Value<'_>) -> Result<Self::Output, SceneError> {
        let name = value.get().as_str().ok_or_else(|| value.wrong_type(&self.expected()))?;
        match self.elements.get(name) {
            Some(target) if (self.kinds.suits)(target) => Ok((name.to_owned(), *target)),
            Some(target) => {
                let kind = match target {
                    Target::Joint(_) => "joint",
                    Target::Tsda(_) => "tsda",
                    Target::PointOnLine(_) => "point_on_line",
                    Target::TorsionSpring(_) => "torsion_spring",
                    Target::Interaction(_) => "interaction",
                    Target::Winch(_) => "driven tsda",
                };
                let problem = format!("names the {kind} \"{name}\"");
                Err(value.refuse(&problem, &self.expected()))
            }
            None => Err(value
                .refuse_with(&format!("names nothing: \"{}\"", shortened(name)), self.help(name))),
        }
    }
}

impl ElementName<'_> {
    fn help(&self, name: &str) -> String {
        /// Most names listed in a message.
        const SHOWN: usize = 12;
        let suits = |(_, target): &(&str, &Target)| (self.kinds.suits)(target);
        let known: Vec<_> = self.elements.iter().filter(suits).map(|(name, _)| name).collect();
        let expected = self.expected();
        match nearest(name, known.iter().copied()) {
            Some(meant) => format!("did you mean \"{meant}\"? expected {expected}"),
            None if known.is_empty() => {
                format!("expected {expected}; the scene has none with a name")
            }
            None => {
                let rest = known.len().saturating_sub(SHOWN);
                let shown = known[..known.len() - rest].join("\", \"");
                let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
                format!("expected {expected}: \"{shown}\"{more}")
            }
        }
    }
}
