//! Merges bodies without joints with their parents.
//!
//! `tree => parts, each of one or more bodies; pose of each body in its part`.

use std::collections::BTreeSet;

use nalgebra::{Isometry3, Vector3};

use crate::carrier::{self, Shares};
use crate::chain::Stage;
use crate::error::Fault;
use crate::mass::Mass;
use crate::mesh::REMEDY;
use crate::options::{Options, Weld};
use crate::settings::Settings;
use crate::tree::{Tree, WORLD};

/// A part, or the world.
pub(crate) type Side = Option<usize>;

/// Bodies that are rigid with each other.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// The first body, in whose frame the part is described.
    pub(crate) lead: usize,
    /// The body that gives the part its name.
    pub(crate) named: usize,
    /// All of them.
    pub(crate) bodies: Vec<usize>,
    /// Their mass in the lead's frame, without that of carriers.
    pub(crate) mass: Mass,
    /// \[m\] their centre of mass, including carriers.
    pub(crate) whole: Vector3<f64>,
    /// Principal axes in the centre of mass, in the lead's frame.
    pub(crate) frame: Isometry3<f64>,
    /// \[kg·m²\] about them.
    pub(crate) moments: [f64; 3],
}

/// All parts.
#[derive(Clone, Debug)]
pub(crate) struct Parts {
    /// In the order of their leads.
    pub(crate) parts: Vec<Part>,
    /// The part of each body and its pose in the lead's frame; `None`: rigid with the world, with its world pose.
    pub(crate) of: Vec<(Option<usize>, Isometry3<f64>)>,
    /// The carriers.
    pub(crate) shares: Vec<Shares>,
}

/// Why bodies cannot be merged.
pub(crate) enum Unfit {
    /// A body with an invalid mass.
    Fault(Fault),
    /// A body whose carriers have no exact mass, without a given fraction.
    Carriers(usize),
}

impl Parts {
    /// Merges bodies.
    ///
    /// # Errors
    /// If a part has no mass or inertia, or a carrier has no exact mass.
    pub(crate) fn of(
        tree: &Tree,
        stages: &[Stage],
        settings: &Settings,
        options: &Options,
    ) -> Result<Self, Unfit> {
        let mut parts: Vec<Part> = Vec::new();
        let mut of = vec![(None, Isometry3::identity())];
        let jointed: BTreeSet<usize> = stages.iter().map(|stage| stage.body).collect();
        for (number, body) in tree.bodies.iter().enumerate().skip(1) {
            // A frame without mass cannot be a body.
            let welded = body.joint.is_none() && options.weld == Weld::Fixed;
            let own = jointed.contains(&number) || welded && body.mass.mass > 0.0;
            let (parent, pose) = of[body.parent];
            if own {
                of.push((Some(parts.len()), Isometry3::identity()));
                parts.push(Part {
                    lead: number,
                    named: number,
                    bodies: vec![number],
                    mass: body.mass.clone(),
                    whole: Vector3::zeros(),
                    frame: Isometry3::identity(),
                    moments: [0.0; 3],
                });
                continue;
            }
            let pose = pose * body.pose;
            if let (Some(part), false) = (parent, tree.carries(number)) {
                let part = &mut parts[part];
                if tree.carries(part.named) {
                    part.named = number;
                    part.bodies.clear();
                }
                part.bodies.push(number);
                part.mass = part.mass.and(&body.mass.seen_from(&pose));
            }
            of.push((parent, pose));
        }
        if parts.is_empty() {
            let place = tree.bodies[WORLD + 1].place;
            let help = "add a <joint> or a <freejoint> to a body";
            return Err(Fault::at(place, "no body has a joint: nothing moves", help).into());
        }
        let carries = |part: &Part| tree.carries(part.named);
        for part in parts.iter_mut().filter(|part| !carries(part)) {
            part.settle(tree, settings)?;
            part.whole = part.mass.centre;
        }
        let side = |body: usize| of[body];
        let mut masses: Vec<Mass> = parts.iter().map(|part| part.mass.clone()).collect();
        let shares = carrier::share(tree, stages, &mut masses, side, options.carriers)
            .map_err(Unfit::Carriers)?;
        for (part, mass) in parts.iter_mut().zip(masses) {
            part.mass = mass;
            part.settle(tree, settings)?;
        }
        Ok(Self { parts, of, shares })
    }
}

impl From<Fault> for Unfit {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

impl Part {
    /// Finds the principal axes.
    ///
    /// # Errors
    /// If it has no mass or no inertia.
    fn settle(&mut self, tree: &Tree, settings: &Settings) -> Result<(), Fault> {
        (self.frame, self.moments) = self.mass.principal_axes();
        let body = &tree.bodies[self.named];
        let [a, b, c] = self.moments;
        if self.mass.mass <= 0.0 {
            let message = format!("body `{}` moves and has no mass", body.name);
            let unweighed = |one: &usize| tree.bodies[*one].unweighed.clone();
            if let Some((why, place)) = self.bodies.iter().find_map(unweighed) {
                return Err(Fault::at(place, format!("{message}: {why}"), REMEDY));
            }
            let help = "add an <inertial>, or geoms with a mass";
            return Err(Fault::at(body.place, message, help));
        }
        if self.moments.iter().any(|moment| *moment <= 0.0) {
            let message = format!("body `{}` has the principal moments {a}, {b}, {c}", body.name);
            let help = "give moments > 0 kg·m², or boundinertia in <compiler>";
            return Err(Fault::at(body.place, message, help));
        }
        if a > b + c || b > a + c || c > a + b {
            let message = format!(
                "body `{}` has the principal moments {a}, {b}, {c}: one exceeds the sum of the others",
                body.name
            );
            let help =
                if settings.balance { "" } else { "set balanceinertia=\"true\" in <compiler>" };
            return Err(Fault::at(body.place, message, help));
        }
        Ok(())
    }
}
