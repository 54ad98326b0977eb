//! Raw springs that act in a direction that contradicts their name, start far shorter than their free length, or store
//! an implausible energy at t = 0.

use dbd_kernel::Vec3;
use dbd_kernel::model::{Group, Law};

use crate::facts::Facts;
use crate::facts::{self, GroupFacts};
use crate::lint::elements::stiffness;
use crate::lint::warning::{Severity, Warning, short};
use crate::scene::Scene;

/// Names of elements that only pull, and of elements that only push.
const PULLS: &[&str] =
    &["band", "belt", "cable", "cord", "rope", "strap", "string", "tendon", "tether", "wire"];
const PUSHES: &[&str] = &[
    "buffer", "bump", "bumper", "bumpstop", "contact", "endstop", "floor", "ground", "stop",
    "stopper", "tire", "tyre",
];

/// Largest relative strain of a spring that counts as unstrained.
const UNSTRAINED: f64 = 1e-3;

/// Smallest initial length relative to the free length: below it the coils would touch.
const SHORT: f64 = 0.5;

/// \[J/kg\] Energy density of spring steel per mass of steel; the springs of a scene store less per mass of its bodies.
const STORED: f64 = 300.0;

/// Largest plausible energy: it lifts the bodies by this many times their size.
const LIFTS: f64 = 30.0;

pub(super) fn check(scene: &Scene, facts: &Facts, warnings: &mut Vec<Warning>) {
    let groups = facts::groups(scene);
    let raw = scene.joints.last().map_or(0, |joint| joint.groups.end);
    let named = scene.raw_names.iter().zip(scene.file_lines.raws());
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
                "acts in both directions, unlike a {word}; use the `limits` of a joint, which act \
                 only outside their range"
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
    /// \[m\] extension beyond its clearance; negative where it is compressed.
    extension: f64,
    name: &'s str,
    line: usize,
}

impl Spring<'_> {
    fn warning(&self, severity: Severity, text: String) -> Warning {
        Warning { severity, name: self.name.to_owned(), line: Some(self.line), text }
    }

    /// The warning about a spring that acts in both directions although its name suggests one.
    fn side(&self) -> Option<(Severity, String)> {
        let (word, pulls) = one_sided(self.name).filter(|_| self.group.law == Law::Tsda)?;
        let [does, length] = if pulls { ["pushes", "short"] } else { ["pulls", "long"] };
        let amount = if pulls { -self.extension } else { self.extension };
        if amount <= UNSTRAINED * self.facts.free_length {
            let text = format!(
                "acts in both directions: unlike a {word} it also {does} when it gets too \
                 {length}; use the law `distance-stop` of an interaction"
            );
            return Some((Severity::Note, text));
        }
        let text = format!(
            "{does} at t = 0, unlike a {word}: it is {} m long and its free length is {} m; change \
             the free length, or use the law `distance-stop` of an interaction, which acts in one \
             direction",
            short(self.facts.longest),
            short(self.facts.free_length)
        );
        Some((Severity::Warning, text))
    }

    fn shortness(&self) -> Option<(Severity, String)> {
        let GroupFacts { free_length, shortest, .. } = *self.facts;
        // A point on a line may start at any smaller distance.
        (self.group.law == Law::Tsda && shortest < SHORT * free_length).then(|| {
            let text = format!(
                "is {} m long at t = 0, less than half its free length of {} m; check that its \
                 points are in the axes of their bodies and its free length is in m",
                short(shortest),
                short(free_length)
            );
            (Severity::Warning, text)
        })
    }
}

/// The warning about an implausible energy at t = 0 in the springs of connected bodies.
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
            "stores {} J at t = 0, enough to accelerate the {} kg of its bodies to {} m/s; check \
             its points, free length and stiffness, or add a `clearance`",
            short(*most),
            short(mass),
            short(libm::sqrt(2.0 * most / mass))
        ),
    ));
}

/// \[m\] extension of a spring beyond its clearance.
fn extension(scene: &Scene, group: &Group, facts: &GroupFacts) -> f64 {
    let whole = facts.longest - facts.free_length;
    let clearance = group.clearance.row().and_then(|row| scene.model.clearances.get(row));
    let beyond = (whole.abs() - clearance.copied().unwrap_or(0.0)).max(0.0);
    beyond.copysign(whole)
}

/// A raw spring that acts in both directions although its name suggests one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OneSided {
    /// Its group in the model.
    pub group: usize,
    /// Its name in messages: ``tsda `left rope` (world–hand)``.
    pub name: String,
    /// Its line in the scene file, from 1.
    pub line: usize,
    /// The word in its name: `rope`.
    pub word: &'static str,
    /// Whether such an element only pulls; otherwise it only pushes.
    pub pulls: bool,
}

/// The raw springs that act in both directions although their names suggest one: ropes that may push, tyres and stops
/// that may pull.
#[must_use]
pub fn one_sided_springs(scene: &Scene) -> Vec<OneSided> {
    let raw = scene.joints.last().map_or(0, |joint| joint.groups.end);
    let named = scene.raw_names.iter().zip(scene.file_lines.raws()).enumerate();
    let tsdas = scene.file_lines.raw_tsdas.len();
    let one = |(row, (name, line)): (usize, (&String, &usize))| {
        let (word, pulls) = one_sided(name)?;
        Some(OneSided { group: raw + row, name: name.clone(), line: *line, word, pulls })
    };
    named.take(tsdas).filter_map(one).collect()
}

/// The word in an element's name that implies one direction, and whether it pulls.
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
