//! Planar linkages with damped joints: closed loops of bars between two pivots on the ground.

use std::fmt::Write as _;

use dbd_scene::Scene;

/// What a linkage is made of.
#[derive(Clone, Copy, Debug)]
pub struct Linkage {
    /// Moving bars.
    pub bars: usize,
    /// \[kg\] of the first; each further one has a tenth more.
    pub mass: f64,
    /// \[N/m\] of a joint's springs.
    pub stiffness: f64,
    /// \[N·s/m\] of a joint's springs.
    pub damping: f64,
    /// How far from straight the loop is: the height of its arc over its width.
    pub height: f64,
    /// \[m/s\] of the middle bar out of the plane.
    pub out_of_plane: f64,
}

impl Linkage {
    /// The linkage as a scene in the plane of x and y, gravity along −y.
    pub fn scene(&self) -> Scene {
        let text = self.text();
        Scene::parse(&text, "linkage.toml").unwrap_or_else(|error| panic!("{self:?}: {error}"))
    }

    /// As a file.
    pub fn text(&self) -> String {
        let Self { bars, mass, stiffness, damping, height, out_of_plane } = *self;
        let mut text = "name = \"linkage\"\nduration = 0.5\nevery = 1e-3\n\
                        gravity = [0.0, -9.81, 0.0]\n"
            .to_owned();
        let pivot = |i: usize| {
            let along = i as f64 / bars as f64;
            let x = 0.25 * bars as f64 * along;
            [x, height * 0.25 * bars as f64 * 4.0 * along * (1.0 - along)]
        };
        for i in 0..bars {
            let ([x, y], [next_x, next_y]) = (pivot(i), pivot(i + 1));
            let mass = mass * (1.0 + 0.1 * i as f64);
            let square = (next_x - x).powi(2) + (next_y - y).powi(2);
            // Of a rod, and a little about its own axis.
            let (long, thin) = (mass * square / 12.0, mass * square / 120.0);
            let aside = if i == bars / 2 { out_of_plane } else { 0.0 };
            let _ = write!(
                text,
                "[[body]]\nname = \"b{i}\"\nmass = {mass:?}\ninertia = [{thin:?}, {long:?}, {long:?}]\n\
                 position = [{:?}, {:?}, 0.0]\nvelocity = [0.0, 0.0, {aside:?}]\n\
                 orientation = {{ axis = [0.0, 0.0, 1.0], angle = {:?} }}\n",
                0.5 * (x + next_x),
                0.5 * (y + next_y),
                (next_y - y).atan2(next_x - x)
            );
        }
        for i in 0..=bars {
            let [x, y] = pivot(i);
            let name = |i: Option<usize>| match i.filter(|i| *i < bars) {
                Some(i) => format!("b{i}"),
                None => "world".into(),
            };
            let _ = write!(
                text,
                "[[joint]]\nname = \"j{i}\"\ntype = \"revolute\"\nbetween = [\"{}\", \"{}\"]\n\
                 at = [{x:?}, {y:?}, 0.0]\naxis = [0.0, 0.0, 1.0]\nstiffness = {stiffness:?}\n\
                 damping = {damping:?}\nspan = 0.1\n",
                name(i.checked_sub(1)),
                name(Some(i))
            );
        }
        text
    }
}
