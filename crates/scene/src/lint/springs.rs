//! Raw springs that act on the side on which what their name says does not, that start far shorter than their free
//! length, or that store more energy at t = 0 than fits their bodies.

use dbd_kernel::Vec3;
use dbd_kernel::model::{Group, Law};

use crate::facts::Facts;
use crate::facts::{self, GroupFacts};
use crate::lint::elements::stiffness;
use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;

/// Words for what only pulls, and for what only pushes.
const PULLS: &[&str] =
    &["band", "belt", "cable", "cord", "rope", "strap", "string", "tendon", "tether", "wire"];
const PUSHES: &[&str] = &[
    "buffer", "bump", "bumper", "bumpstop", "contact", "endstop", "floor", "ground", "stop",
    "stopper", "tire", "tyre",
];

/// A spring is unstrained that is off its free length by less than this share of it.
const UNSTRAINED: f64 = 1e-3;

/// A spring starts far shorter than its free length below this share of it: its coils would touch.
const SHORT: f64 = 0.5;

/// \[J/kg\] Spring steel stores no more than this per mass of its own; all springs of bodies together store less
/// per mass of the bodies.
const STORED: f64 = 300.0;

/// Nor more than would lift the bodies by so many times their size.
const LIFTS: f64 = 30.0;

pub(super) fn judge(scene: &Scene, facts: &Facts, warnings: &mut Vec<Warning>) {
    let groups = facts::groups(scene);
    let raw = scene.joints.last().map_or(0, |joint| joint.groups.end);
    let lines = scene.file_lines.tsdas.iter().chain(&scene.file_lines.points_on_lines);
    let named = scene.raw_names.iter().zip(lines);
    let mut springs = Vec::new();
    for ((group, facts), (name, line)) in
        scene.model.groups[raw..].iter().zip(&groups[raw..]).zip(named)
    {
        let extension = extension(scene, group, facts);
        springs.push(Spring { group, facts, extension, name, line: *line });
    }
    for spring in &springs {
        if let Some((severity, text)) = spring.side().or_else(|| spring.shortness()) {
            warnings.push(spring.warning(severity, text));
        }
    }
    let torsion_springs = scene.torsion_names.iter().take(scene.torsion_springs());
    for (name, line) in torsion_springs.zip(&scene.file_lines.torsion_springs) {
        if let Some((word, _)) = one_sided(name) {
            let text = format!(
                "acts in both directions, which no {word} does: `limits` of a joint act beyond their range only"
            );
            let (severity, name, line) = (Severity::Note, name.clone(), Some(*line));
            warnings.push(Warning { severity, name, line, text });
        }
    }
    for island in &facts.islands {
        let own = springs.iter().filter(|spring| {
            let [a, b] = [spring.group.a, spring.group.b].map(|body| body.row());
            island.bodies.contains(&a) || island.bodies.contains(&b)
        });
        energy(scene, &island.bodies, own, warnings);
    }
}

/// A raw spring at the initial pose.
struct Spring<'s> {
    group: &'s Group,
    facts: &'s GroupFacts,
    /// \[m\] beyond its clearance; negative where it is compressed.
    extension: f64,
    name: &'s str,
    line: usize,
}

impl Spring<'_> {
    fn warning(&self, severity: Severity, text: String) -> Warning {
        Warning { severity, name: self.name.to_owned(), line: Some(self.line), text }
    }

    /// What is said of one that acts on both sides though its name says one.
    fn side(&self) -> Option<(Severity, String)> {
        let (word, pulls) = one_sided(self.name).filter(|_| self.group.law == Law::Tsda)?;
        let [does, now, length] =
            if pulls { ["push", "pushes", "short"] } else { ["pull", "pulls", "long"] };
        let amount = if pulls { -self.extension } else { self.extension };
        if amount <= UNSTRAINED * self.facts.free_length {
            let text = format!(
                "acts on both sides: unlike a {word} it would also {does} where it gets too {length}; the law \
                 `distance-stop` of an interaction does not"
            );
            return Some((Severity::Note, text));
        }
        let text = format!(
            "{now} at t = 0, which no {word} does: it is {} m long and its free length is {} m; another free length, \
             or the law `distance-stop` of an interaction, which acts on one side",
            short(self.facts.longest),
            short(self.facts.free_length)
        );
        Some((Severity::Warning, text))
    }

    fn shortness(&self) -> Option<(Severity, String)> {
        let GroupFacts { free_length, longest, .. } = *self.facts;
        // A point on a line may lie anywhere within its distance from it.
        (self.group.law == Law::Tsda && longest < SHORT * free_length).then(|| {
            let text = format!(
                "is {} m long at first, less than half its free length of {} m: are its points in the axes of \
                 their bodies, is the free length in m?",
                short(longest),
                short(free_length)
            );
            (Severity::Warning, text)
        })
    }
}

/// What the springs of bodies that hang together store at t = 0, where it is out of proportion.
fn energy<'s>(
    scene: &Scene,
    bodies: &[usize],
    springs: impl Iterator<Item = &'s Spring<'s>>,
    warnings: &mut Vec<Warning>,
) {
    let energy = |spring: &Spring<'_>| {
        0.5 * stiffness(scene, spring.group) * spring.extension * spring.extension
    };
    let mut stored: Vec<_> = springs.map(|spring| (energy(spring), spring)).collect();
    let all: f64 = stored.iter().map(|(energy, _)| energy).sum();
    let mass: f64 = bodies.iter().map(|row| scene.model.bodies[*row].mass).sum();
    let places = || bodies.iter().map(|row| scene.model.initial[*row].position);
    let from = places().next().unwrap_or(Vec3::ZERO);
    let reach = places().map(|place| crate::closure::length(place - from)).fold(0.0, f64::max);
    let gravity =
        scene.model.gravity.iter().map(|g| crate::closure::length(*g)).fold(0.0, f64::max);
    if all <= mass * f64::max(STORED, LIFTS * gravity * reach) {
        return;
    }
    stored.sort_by(|a, b| b.0.total_cmp(&a.0));
    let Some((most, spring)) = stored.first() else { return };
    warnings.push(spring.warning(
        Severity::Warning,
        format!(
            "stores {} J at t = 0, enough to throw the {} kg of its bodies at {} m/s: are its points, its free length \
             and its stiffness right, is a `clearance` missing?",
            short(*most),
            short(mass),
            short(libm::sqrt(2.0 * most / mass))
        ),
    ));
}

/// \[m\] how far a spring is beyond its clearance.
fn extension(scene: &Scene, group: &Group, facts: &GroupFacts) -> f64 {
    let whole = facts.longest - facts.free_length;
    let clearance = group.clearance.row().and_then(|row| scene.model.clearances.get(row));
    let beyond = (whole.abs() - clearance.copied().unwrap_or(0.0)).max(0.0);
    beyond.copysign(whole)
}

/// A raw spring that acts on both sides though its name says one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OneSided {
    /// Its group in the model.
    pub group: usize,
    /// What messages call it: ``tsda `left rope` (world–hand)``.
    pub name: String,
    /// Its line in the scene file, from 1.
    pub line: usize,
    /// What its name says it is: `rope`.
    pub word: &'static str,
    /// Whether such a thing only pulls; it only pushes otherwise.
    pub pulls: bool,
}

/// The raw springs that act on both sides though their names say one: ropes that may push, tyres and stops
/// that may pull.
#[must_use]
pub fn one_sided_springs(scene: &Scene) -> Vec<OneSided> {
    let raw = scene.joints.last().map_or(0, |joint| joint.groups.end);
    let named = scene.raw_names.iter().zip(&scene.file_lines.tsdas).enumerate();
    let one = |(row, (name, line)): (usize, (&String, &usize))| {
        let (word, pulls) = one_sided(name)?;
        Some(OneSided { group: raw + row, name: name.clone(), line: *line, word, pulls })
    };
    named.filter_map(one).collect()
}

/// The word of an element's own name that says it acts on one side only, and whether it pulls.
fn one_sided(label: &str) -> Option<(&'static str, bool)> {
    let name = label.split('`').nth(1)?.to_lowercase();
    let words = || name.split(|letter: char| !letter.is_alphabetic());
    let is = |known: &&&str| {
        words().any(|word| word == **known || word.strip_suffix('s') == Some(**known))
    };
    let of =
        |known: &'static [&'static str], pulls| known.iter().find(is).map(|word| (*word, pulls));
    of(PULLS, true).or_else(|| of(PUSHES, false))
}
