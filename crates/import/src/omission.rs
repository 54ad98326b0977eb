//! Items without a counterpart in a scene, by kind.
//!
//! `kind, position, description with magnitude => a line of a list`.

use std::fmt::Write as _;

use crate::place::{Place, Texts};

macro_rules! kinds {
    ($($(#[doc = $doc:literal])+ $variant:ident = $name:literal,)+) => {
        /// A kind of item without a counterpart; it can be ignored by its name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Kind {
            $($(#[doc = $doc])+ $variant,)+
        }

        impl Kind {
            /// All kinds.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)+];

            /// Its name.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)+ }
            }

            /// A one-line description.
            #[must_use]
            pub fn summary(self) -> &'static str {
                match self { $(Self::$variant => concat!($($doc),+).trim_ascii(),)+ }
            }
        }
    };
}

kinds! {
    /// geoms that can touch each other
    Contact = "contact",
    /// ranges of joints, controls and forces
    Limit = "limit",
    /// inertia that an actuator adds to a joint
    Armature = "armature",
    /// dry friction of tendons, and of joints that a scene merges into one
    FrictionLoss = "frictionloss",
    /// joints of a body without an exact equivalent in a scene
    Joints = "joints",
    /// springs of balls that start rotated, springs and dampers of free bodies, nonlinear stiffness
    Spring = "spring",
    /// tendons other than springs between two sites and couplings of one to three joints
    Tendon = "tendon",
    /// equalities of tendons and flexes, nonlinear ones of joints, welds at another angle
    Equality = "equality",
    /// actuators other than linear laws at a hinge, a slide or a tendon
    Actuator = "actuator",
    /// gravity compensation other than a constant force at a centre of mass
    GravityCompensation = "gravcomp",
    /// wind and drag of a medium
    Fluid = "fluid",
    /// mass of unreadable meshes, of shapes fitted to meshes, of shells of shapes
    Mesh = "mesh",
    /// mocap bodies, which are moved from outside
    Mocap = "mocap",
    /// composites, flexes, replicas, attached models, plugins
    Generated = "generated",
    /// elements and attributes with unknown names
    Unknown = "unknown",
}

/// One item without a counterpart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Omission {
    /// Its kind.
    pub kind: Kind,
    /// Its file.
    pub file: String,
    /// Its line there, from 1.
    pub line: usize,
    /// Description with magnitude.
    pub what: String,
}

/// A list of file and line, kind and description, one line per item.
#[must_use]
pub fn table(omissions: &[Omission]) -> String {
    let places: Vec<String> =
        omissions.iter().map(|one| format!("{}:{}", one.file, one.line)).collect();
    let width = places.iter().map(|place| place.chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for (one, place) in omissions.iter().zip(&places) {
        let kind = one.kind.name();
        let _ = writeln!(text, "{place:width$}  {kind:12}  {}", one.what);
    }
    text
}

/// The items found so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Omissions {
    found: Vec<(Kind, Place, String)>,
}

impl Omissions {
    /// Adds one.
    pub(crate) fn add(&mut self, kind: Kind, place: Place, what: impl Into<String>) {
        self.found.push((kind, place, what.into()));
    }

    /// All of them, in the order of the file.
    pub(crate) fn list(&mut self) -> &[(Kind, Place, String)] {
        self.found.sort_by_key(|(_, place, _)| (place.file, place.start));
        &self.found
    }

    /// The same with the names of their files.
    pub(crate) fn named(mut self, texts: &Texts) -> Vec<Omission> {
        let named = |(kind, place, what): &(Kind, Place, String)| Omission {
            kind: *kind,
            file: texts.file(place.file).0.to_owned(),
            line: place.line,
            what: what.clone(),
        };
        self.list().iter().map(named).collect()
    }
}
