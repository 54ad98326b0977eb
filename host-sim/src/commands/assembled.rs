//! Displacements that closed the joints of a scene and brought it to equilibrium, as `check` and `run` report them.
//!
//! `scene => bodies with how far, joints that were open, what is left free; sentences`.

use dbd_plant::digits::significant;
use dbd_scene::{Assembled, Moved, OpenJoint, Scene};
use serde::Serialize;

/// Largest number of bodies or joints in a line.
const NAMED: usize = 6;

/// What was moved to close the joints.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AssembledCheck {
    /// The bodies that were moved.
    pub moved: Vec<MovedCheck>,
    /// The joints that were open at the given poses.
    pub open: Vec<OpenCheck>,
    /// The bodies that were given velocities that the joints allow.
    pub set_moving: Vec<String>,
    /// Steps that were computed.
    pub iterations: usize,
    /// Degrees of freedom that the joints leave to the movable bodies.
    pub freedoms: usize,
    /// Constraints that others imply.
    pub held_twice: usize,
    /// \[m\] the length at which a radian counted as a metre.
    pub length: f64,
}

/// What was moved to bring the scene to rest.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SettledCheck {
    /// The bodies that were moved.
    pub moved: Vec<MovedCheck>,
    /// Steps that were computed.
    pub iterations: usize,
}

impl SettledCheck {
    /// Of a scene that says `settle = true`.
    #[must_use]
    pub fn of(scene: &Scene) -> Option<Self> {
        let settled = scene.settled.clone()?;
        let moved = settled.moved.into_iter().map(MovedCheck::from).collect();
        Some(Self { moved, iterations: settled.iterations })
    }

    /// Which bodies were moved, and by how much.
    #[must_use]
    pub fn sentence(&self) -> String {
        moved_text(&self.moved, self.iterations)
            .unwrap_or_else(|| "no body was moved: the scene is in equilibrium".into())
    }
}

/// A body that was moved.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MovedCheck {
    /// Its name.
    pub body: String,
    /// \[m\].
    pub distance: f64,
    /// \[rad\].
    pub angle: f64,
}

impl From<Moved> for MovedCheck {
    fn from(Moved { body, distance, angle }: Moved) -> Self {
        Self { body, distance, angle }
    }
}

/// A joint that was open.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OpenCheck {
    /// Its name.
    pub joint: String,
    /// \[m\].
    pub distance: f64,
    /// \[rad\].
    pub angle: f64,
}

impl AssembledCheck {
    /// Of a scene that has a table `assemble`.
    #[must_use]
    pub fn of(scene: &Scene) -> Option<Self> {
        let Assembled {
            moved,
            open,
            left: _,
            set_moving,
            iterations,
            freedoms,
            held_twice,
            length,
        } = scene.assembled.clone()?;
        let open = open.into_iter();
        Some(Self {
            moved: moved.into_iter().map(MovedCheck::from).collect(),
            open: open
                .map(|OpenJoint { joint, distance, angle }| OpenCheck { joint, distance, angle })
                .collect(),
            set_moving,
            iterations,
            freedoms,
            held_twice,
            length,
        })
    }

    /// A row of a table each.
    #[must_use]
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let free = format!(
            "{} remain to the movable bodies, {} constraints are redundant",
            self.freedoms, self.held_twice
        );
        let mut rows = vec![("assembled", self.sentence()), ("freedoms", free)];
        let open = self.open.iter().map(|open| (open.joint.as_str(), open.distance, open.angle));
        if let Some(open) = named(open) {
            rows.push(("were open", open));
        }
        if !self.set_moving.is_empty() {
            let names = self.set_moving.iter().map(|name| format!("`{name}`"));
            rows.push(("set moving", shortened_list(names.collect())));
        }
        rows
    }

    /// Which bodies were moved, and by how much.
    #[must_use]
    pub fn sentence(&self) -> String {
        moved_text(&self.moved, self.iterations)
            .unwrap_or_else(|| "no body was moved: all joints are closed".into())
    }
}

fn moved_text(moved: &[MovedCheck], steps: usize) -> Option<String> {
    let moved = moved.iter().map(|moved| (moved.body.as_str(), moved.distance, moved.angle));
    named(moved).map(|moved| format!("{moved} ({steps} steps)"))
}

fn named<'n>(all: impl Iterator<Item = (&'n str, f64, f64)>) -> Option<String> {
    let by = |(name, distance, angle): (&str, f64, f64)| {
        let [distance, angle] = [distance, angle].map(|value| significant(value, 3));
        format!("`{name}` by {distance} m and {angle} rad")
    };
    let all: Vec<String> = all.map(by).collect();
    (!all.is_empty()).then(|| shortened_list(all))
}

fn shortened_list(mut all: Vec<String>) -> String {
    let more = all.len().saturating_sub(NAMED);
    all.truncate(NAMED);
    if more > 0 {
        all.push(format!("{more} more"));
    }
    all.join(", ")
}
