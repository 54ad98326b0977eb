//! What has no counterpart in a scene, by kinds.
//!
//! `kind, place, what and how large => a line of a list`.

use std::fmt::Write as _;

use crate::place::{Place, Texts};

macro_rules! kinds {
    ($($(#[doc = $doc:literal])+ $variant:ident = $name:literal,)+) => {
        /// A kind of thing that has no counterpart; by its name it can be ignored.
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

            /// What it is, a line.
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
    /// dry friction of tendons, and of joints that a scene has not one by one
    FrictionLoss = "frictionloss",
    /// joints of a body that no joints of a scene say exactly
    Joints = "joints",
    /// springs of balls that start turned, springs and dampers of free bodies, stiffness that is not linear
    Spring = "spring",
    /// tendons that are no spring between two sites and no coupling of one to three joints
    Tendon = "tendon",
    /// equalities between tendons and flexes, of joints by a curve, welds at another angle
    Equality = "equality",
    /// actuators that are no linear law at a hinge, a slide or a tendon
    Actuator = "actuator",
    /// compensation of gravity that is no constant force at a centre of mass
    GravityCompensation = "gravcomp",
    /// wind and resistance of a medium
    Fluid = "fluid",
    /// mass of meshes that cannot be read, of shapes around meshes, of shells of shapes
    Mesh = "mesh",
    /// bodies that are moved from outside
    Mocap = "mocap",
    /// composites, flexes, replicas, attached models, plugins
    Generated = "generated",
    /// elements and attributes of no known name
    Unknown = "unknown",
}

/// One thing that has no counterpart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Omission {
    /// Its kind.
    pub kind: Kind,
    /// Its file.
    pub file: String,
    /// Its line there, from 1.
    pub line: usize,
    /// What it is and how large.
    pub what: String,
}

/// A list with file and line, kind, what: one line each.
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

/// What was found so far.
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
