//! Elements of a scene without a counterpart in a URDF.
//!
//! `kind, line, description => a line of a list`.

use std::fmt::Write as _;

/// A kind of element without a counterpart; it can be ignored by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Lack {
    /// Joints that close a loop.
    Loop,
    /// Springs, dampers, bushings, stops and custom laws between bodies.
    Spring,
    /// Contacts.
    Contact,
    /// Couplings of other than two joint coordinates, with backlash or one-sided.
    Coupling,
    /// Inputs other than forces and torques at joint coordinates, signal chains, and driven bodies.
    Input,
    /// Inertia of rotors, and their gears and windings.
    Rotor,
    /// Constant forces and torques.
    Load,
}

impl Lack {
    /// All kinds.
    pub const ALL: &'static [Self] = &[
        Self::Loop,
        Self::Spring,
        Self::Contact,
        Self::Coupling,
        Self::Input,
        Self::Rotor,
        Self::Load,
    ];

    const fn words(self) -> [&'static str; 2] {
        match self {
            Self::Loop => ["loop", "joints that close a loop"],
            Self::Spring => {
                ["spring", "springs, dampers, bushings, stops and custom laws between bodies"]
            }
            Self::Contact => ["contact", "contacts"],
            Self::Coupling => {
                ["coupling", "couplings other than of two joint coordinates without play"]
            }
            Self::Input => [
                "input",
                "inputs other than forces and torques at joints, signal chains, driven bodies",
            ],
            Self::Rotor => ["rotor", "inertia of rotors, with their gears and windings"],
            Self::Load => ["load", "constant forces and torques"],
        }
    }

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.words()[0]
    }

    /// A one-line description.
    #[must_use]
    pub const fn summary(self) -> &'static str {
        self.words()[1]
    }
}

/// One element without a counterpart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Its kind.
    pub kind: Lack,
    /// Its line in the scene file, from 1, if known.
    pub line: Option<usize>,
    /// Its name or description.
    pub what: String,
}

/// A list of line, kind and description, one line per element.
#[must_use]
pub fn table(items: &[LeftOut]) -> String {
    let mut text = String::new();
    for LeftOut { kind, line, what } in items {
        let line = line.map_or(String::new(), |line| format!("line {line}"));
        let _ = writeln!(text, "  {line:9}  {:8}  {what}", kind.name());
    }
    text
}

/// The options that leave these out: `--ignore loop --ignore spring`.
pub(super) fn options(items: &[LeftOut]) -> String {
    let used = Lack::ALL.iter().filter(|kind| items.iter().any(|item| item.kind == **kind));
    used.map(|kind| format!("--ignore {}", kind.name())).collect::<Vec<_>>().join(" ")
}
