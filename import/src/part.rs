//! Bodies without joints become one with their parents.
//!
//! `tree => parts, each of one or more bodies; where each body lies in its part`.

use nalgebra::Isometry3;

use crate::error::Fault;
use crate::mass::Mass;
use crate::options::Weld;
use crate::settings::Settings;
use crate::tree::{Tree, WORLD};

/// Bodies that are rigid with each other.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// The first, in whose frame the part is described.
    pub(crate) lead: usize,
    /// All of them.
    pub(crate) bodies: Vec<usize>,
    /// Their mass, in the lead's frame.
    pub(crate) mass: Mass,
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
    /// The part of each body and its pose in the lead's frame; `None`: rigid with the world, and the
    /// pose is that in the world.
    pub(crate) of: Vec<(Option<usize>, Isometry3<f64>)>,
}

impl Parts {
    /// Puts bodies together.
    ///
    /// # Errors
    /// Where a part has no mass or no inertia.
    pub(crate) fn of(tree: &Tree, settings: &Settings, weld: Weld) -> Result<Self, Fault> {
        let mut parts: Vec<Part> = Vec::new();
        let mut of = vec![(None, Isometry3::identity())];
        for (number, body) in tree.bodies.iter().enumerate().skip(1) {
            // A frame without mass cannot be a body.
            let own = !body.joints.is_empty() || weld == Weld::Fixed && body.mass.mass > 0.0;
            let (parent, pose) = of[body.parent];
            if own {
                of.push((Some(parts.len()), Isometry3::identity()));
                parts.push(Part {
                    lead: number,
                    bodies: vec![number],
                    mass: body.mass.clone(),
                    frame: Isometry3::identity(),
                    moments: [0.0; 3],
                });
                continue;
            }
            let pose = pose * body.pose;
            if let Some(part) = parent {
                let part = &mut parts[part];
                part.bodies.push(number);
                part.mass = part.mass.and(&body.mass.seen_from(&pose));
            }
            of.push((parent, pose));
        }
        for part in &mut parts {
            (part.frame, part.moments) = part.mass.principal_axes();
            let lead = &tree.bodies[part.lead];
            let [a, b, c] = part.moments;
            if part.mass.mass <= 0.0 {
                let message = format!("body `{}` moves and has no mass", lead.name);
                let help = "an <inertial>, or geoms with a mass that are no meshes";
                return Err(Fault::at(lead.place, message, help));
            }
            if part.moments.iter().any(|moment| *moment <= 0.0) {
                let message =
                    format!("body `{}` has the principal moments {a}, {b}, {c}", lead.name);
                let help = "moments > 0 kg·m², or boundinertia in <compiler>";
                return Err(Fault::at(lead.place, message, help));
            }
            if a > b + c || b > a + c || c > a + b {
                let message = format!(
                    "body `{}` has the principal moments {a}, {b}, {c}: one exceeds the sum of the others",
                    lead.name
                );
                let help =
                    if settings.balance { "" } else { "balanceinertia=\"true\" in <compiler>" };
                return Err(Fault::at(lead.place, message, help));
            }
        }
        if parts.is_empty() {
            let place = tree.bodies[WORLD + 1].place;
            let help = "a <joint> or a <freejoint> in a body";
            return Err(Fault::at(place, "no body has a joint: nothing moves", help));
        }
        Ok(Self { parts, of })
    }
}
