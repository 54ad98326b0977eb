//! Names of bodies, and `between`, the two bodies that an element joins.

use dbd_kernel::BodyIndex;

use crate::assembly::{Assembly, WORLD};
use crate::error::SceneError;
use crate::nearest::nearest;
use crate::pair::Pair;
use crate::shortened::shortened;
use crate::text::{Kind, Value};

/// `["FIRST", "SECOND"]`.
#[derive(Clone, Copy)]
pub(crate) struct Between<'a>(pub(crate) &'a Assembly);

impl Kind for Between<'_> {
    type Output = Pair;

    fn expected(&self) -> String {
        "the names of two different bodies, or of one body and \"world\"".into()
    }

    fn read(&self, value: &Value<'_>) -> Result<Pair, SceneError> {
        let entries = value.entries(2, || self.expected())?;
        let mut names = [String::new(), String::new()];
        let mut bodies = [BodyIndex::WORLD; 2];
        for ((name, body), entry) in names.iter_mut().zip(&mut bodies).zip(&entries) {
            (*name, *body) = BodyName { assembly: self.0, world: true }.read(entry)?;
        }
        let [a, b] = bodies;
        if a == b {
            let problem = format!("joins `{}` to itself", names[0]);
            return Err(value.refuse(&problem, &self.expected()));
        }
        Ok(Pair { a, b, names })
    }
}

/// The name of a body.
#[derive(Clone, Copy)]
pub(crate) struct BodyName<'a> {
    pub(crate) assembly: &'a Assembly,
    /// Whether the world is allowed.
    pub(crate) world: bool,
}

impl Kind for BodyName<'_> {
    type Output = (String, BodyIndex);

    fn expected(&self) -> String {
        if self.world { "the name of a body or \"world\"" } else { "the name of a body" }.into()
    }

    fn read(&self, value: &Value<'_>) -> Result<Self::Output, SceneError> {
        let name = value.get().as_str().ok_or_else(|| value.wrong_type(&self.expected()))?;
        match self.assembly.body(name) {
            Some(body) if self.world || !body.is_world() => Ok((name.to_owned(), body)),
            Some(_) => Err(value.refuse("is the world, which is fixed", &self.expected())),
            None => Err(value
                .refuse_with(&format!("names no body: \"{}\"", shortened(name)), self.help(name))),
        }
    }
}

impl BodyName<'_> {
    fn help(&self, name: &str) -> String {
        /// Maximum number of names in a help text.
        const SHOWN: usize = 12;
        let world = self.world.then_some(WORLD);
        let known = || self.assembly.body_names().iter().map(String::as_str).chain(world);
        let mut help = match nearest(name, known()) {
            Some(meant) => format!("did you mean \"{meant}\"? known bodies: "),
            None => "known bodies: ".to_owned(),
        };
        let names: Vec<_> = known().take(SHOWN).map(|name| format!("\"{name}\"")).collect();
        help.push_str(&names.join(", "));
        let rest = known().count() - names.len();
        if rest > 0 {
            help.push_str(&format!(" and {rest} more"));
        }
        help
    }
}
