//! The command line of a measured run.
//!
//! `(scene as called, point) => host-sim run …`.

use dbd_plant::time::display;
use dbd_scene::Scene;

use crate::grid::every;
use crate::point::Point;

/// Commands for the points of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Command {
    scene: String,
    every: Option<String>,
}

impl Command {
    /// Commands for a scene that the user calls by a name or a path.
    #[must_use]
    pub fn new(scene: &Scene, called: &str) -> Self {
        Self { scene: with_changes(scene, called), every: every(scene) }
    }

    /// The command for a point; `None` for a reference, which no command runs.
    #[must_use]
    pub fn line(&self, point: &Point) -> Option<String> {
        let (options, step) = (point.stepper.options()?, display(point.step));
        let mut line = format!("host-sim run {} {options} --step {step}", self.scene);
        if let Some(every) = &self.every {
            line += &format!(" {every}");
        }
        Some(line)
    }
}

/// A scene that the user calls by a name or a path, with the changes of its values.
#[must_use]
pub fn with_changes(scene: &Scene, called: &str) -> String {
    let last = scene.changes.len().saturating_sub(1);
    let set = scene.changes.iter().enumerate().map(|(row, change)| match change.as_str() {
        // It is placed before all others.
        "planar=true" if row == last => " --planar".into(),
        change => format!(" --set {}", quoted(change)),
    });
    [quoted(called)].into_iter().chain(set).collect()
}

/// A word quoted for a shell.
#[must_use]
pub fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./\\:".contains(c);
    if word.chars().all(plain) { word.into() } else { format!("'{}'", word.replace('\'', "'\\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::tests::point;

    #[test]
    fn changes_are_given_as_they_were() {
        let text = "name = \"a\"\nduration = 1\n[[body]]\nname = \"b\"\nmass = 1\n\
                    inertia = [1, 1, 1]\nposition = [0, 0, 0]\n";
        let scene = Scene::parse_with(text, "a.toml", &["body.b.mass=2", "planar=true"]).unwrap();
        assert_eq!(with_changes(&scene, "a.toml"), "a.toml --set 'body.b.mass=2' --planar");
        let back = scene.with("planar=false").unwrap();
        assert!(with_changes(&back, "a").ends_with("--set 'planar=true' --set 'planar=false'"));
    }

    #[test]
    fn a_line_is_what_a_shell_takes() {
        let mut point = point("pefrl", 1e-3 / 12.0, 1.0, None);
        point.stepper.precision = "f32".into();
        let command = Command { scene: quoted("my scenes/it's.toml"), every: None };
        assert_eq!(
            command.line(&point).unwrap(),
            "host-sim run 'my scenes/it'\\''s.toml' --scheme pefrl --precision f32 \
             --step 83.33333333333333us"
        );
        let command = Command { scene: quoted("four-bar"), every: Some("--every 1s".into()) };
        assert!(command.line(&point).unwrap().ends_with(" --every 1s"));
        point.stepper.kernel = false;
        assert_eq!(command.line(&point), None);
    }
}
