//! The scene's text.
//!
//! `mechanism => TOML with a comment on each part: its element and line`.

use std::fmt::Write as _;

use nalgebra::Vector3;

use crate::couplings::SETTLING;
use crate::interaction::{LIMIT_SPEED, RESTITUTION};
use crate::mass::Solid;
use crate::mechanism::{Axis, Interaction, Mechanism, Signal, Type, rounded};
use crate::notation::{fitting, line, number, snapped, text, vector};
use crate::omission::Kind;
use crate::options::{TOLERANCE, Weld};
use crate::part::Side;
use crate::place::{Place, Source, Texts};
use crate::settings::Settings;

/// First line of an imported scene.
pub(crate) const HEAD: &str = "# Imported by `host-sim import` from ";

/// Data for the header.
pub(crate) struct Head<'h> {
    /// Settings of the file.
    pub(crate) settings: &'h Settings,
    /// The texts, to show positions.
    pub(crate) texts: &'h Texts,
}

/// The scene's text; `file` is the source file.
pub(crate) fn scene(
    mechanism: &Mechanism<'_>,
    head: &Head<'_>,
    omissions: &[(Kind, Place, String)],
    file: &str,
) -> String {
    let mut out = String::new();
    top(&mut out, mechanism, head, omissions, file);
    bodies(&mut out, mechanism, head.texts);
    joints(&mut out, mechanism, head.texts);
    springs(&mut out, mechanism, head.texts);
    contacts(&mut out, mechanism, head.texts);
    let signals = [("input", &mechanism.inputs), ("readout", &mechanism.readouts)];
    for (table, signals) in signals {
        for signal in signals {
            write_signal(&mut out, table, signal, head.texts);
        }
    }
    looks(&mut out, mechanism, head.texts);
    out
}

fn top(
    out: &mut String,
    mechanism: &Mechanism<'_>,
    head: &Head<'_>,
    omissions: &[(Kind, Place, String)],
    file: &str,
) {
    let (settings, options) = (head.settings, mechanism.options);
    let short = file.rsplit(['/', '\\']).next().unwrap_or(file);
    let _ = writeln!(out, "{HEAD}{}", line(short));
    let stated = match options.span {
        Some(span) => format!("span {} m", number(span)),
        None => "span: twice the radius of gyration of the smaller body".to_owned(),
    };
    let k = number(options.stiffness);
    let c = number(options.damping);
    let _ = writeln!(
        out,
        "# Joints, from the options: stiffness {k} N/m, damping {c} N·s/m, {stated}."
    );
    if mechanism.links.iter().any(|link| link.keys.iter().any(|key| key.contains("limits"))) {
        let _ = writeln!(
            out,
            "# Limits, from the options: as stiff as their joints; an impact at {LIMIT_SPEED} rad/s or m/s rebounds at {} of that speed.",
            RESTITUTION
        );
    }
    if mechanism.links.iter().any(|link| link.keys.iter().any(|key| key.contains("rotor"))) {
        out.push_str("# Rotors: armatures behind gears as stiff as their joints.\n");
    }
    if !mechanism.couplings.is_empty() {
        let _ = writeln!(
            out,
            "# Couplings without a stiffness in the file: as stiff as limits, damping {SETTLING} s times the stiffness."
        );
    }
    let is_stop = |one: &Interaction| one.law != "bushing";
    if !mechanism.contacts.is_empty() || mechanism.interactions.iter().any(is_stop) {
        let _ = writeln!(
            out,
            "# Contacts, ranges of tendons and of slides, from the options: as stiff as joints; an impact at {LIMIT_SPEED} m/s rebounds at {RESTITUTION} of that speed."
        );
    }
    if mechanism.interactions.iter().any(|one| one.law == "bushing") {
        out.push_str("# Bushings: two slides of one body from the world, alone or with a hinge across them.\n");
    }
    if options.weld == Weld::Merge {
        out.push_str("# Bodies without joints are merged with their parents.\n");
    }
    if let Some(step) = settings.timestep {
        let _ = writeln!(
            out,
            "# The file's timestep was {step} s; without `step` here a run chooses a stable one."
        );
    }
    for (kind, place, what) in omissions {
        let _ = writeln!(
            out,
            "# Left out, {} ({}): {}",
            kind.name(),
            head.texts.shown(*place),
            line(what)
        );
    }
    let stem = short.rsplit_once('.').map_or(short, |(stem, _)| stem);
    let name = options.name.as_deref().or(settings.model.as_deref()).unwrap_or(stem);
    let _ = writeln!(out, "\nname = {}", text(&fitting(name)));
    let _ = writeln!(out, "description = {}", text(&format!("imported from {short}")));
    let _ = writeln!(out, "duration = {}", number(options.duration));
    if settings.gravity != Vector3::zeros() {
        let _ = writeln!(out, "gravity = {}", vector(settings.gravity, 0.0));
    }
    if mechanism.planar {
        out.push_str(
            "# In the plane a body without a joint is free: this replaces two slides and a hinge.\n",
        );
        out.push_str("planar = true\n");
    }
    if mechanism.links.iter().any(|link| !link.is_closed()) {
        let tolerance = options.tolerance.unwrap_or_else(|| rounded(TOLERANCE * mechanism.size()));
        out.push_str("\n# Closes the joints given by two points, up to this gap in m.\n");
        let _ = writeln!(out, "[assemble]\ntolerance = {}", number(tolerance));
    }
}

fn bodies(out: &mut String, mechanism: &Mechanism<'_>, texts: &Texts) {
    let size = mechanism.size();
    for (number_of, part) in mechanism.parts.parts.iter().enumerate() {
        out.push('\n');
        let carries = mechanism.tree.carries(part.named);
        for body in &part.bodies {
            let body = &mechanism.tree.bodies[*body];
            let masses = body.mass_words.iter();
            let masses: Vec<String> =
                masses.map(|(words, place)| format!("{words}, {}", texts.shown(*place))).collect();
            let masses = match (masses.is_empty(), carries) {
                (_, true) => "taken from its neighbours".into(),
                (true, _) => "no mass".into(),
                _ => masses.join("; "),
            };
            let words = if carries {
                format!("between joints of a <body>: {}", body.name)
            } else {
                format!("<body name=\"{}\">", body.name)
            };
            comment(out, &(words, body.place), texts);
            let _ = writeln!(out, "#   mass: {}", line(&masses));
        }
        let pose = mechanism.placed(number_of);
        let turn = pose.rotation;
        let _ = writeln!(out, "[[body]]\nname = {}", text(mechanism.name(Some(number_of))));
        let _ = writeln!(out, "mass = {}", number(part.mass.mass));
        let _ = writeln!(out, "inertia = {}", vector(Vector3::from(part.moments), 0.0));
        let _ = writeln!(out, "position = {}", vector(pose.translation.vector, size));
        if turn.w != 1.0 {
            let parts = [turn.w, turn.i, turn.j, turn.k].map(|q| number(snapped(q, 1.0)));
            let _ = writeln!(out, "orientation = {{ quaternion = [{}] }}", parts.join(", "));
        }
    }
}

fn joints(out: &mut String, mechanism: &Mechanism<'_>, texts: &Texts) {
    let (size, options) = (mechanism.size(), mechanism.options);
    for link in &mechanism.links {
        out.push('\n');
        comment(out, &link.source, texts);
        let _ = writeln!(out, "[[joint]]\nname = {}", text(&link.name));
        let kind = match link.kind {
            Type::Revolute(_) => "revolute",
            Type::Spherical => "spherical",
            Type::Cylindrical(_) => "cylindrical",
            Type::Universal(_) => "universal",
            Type::Translational(_) => "translational",
            Type::Fixed => "fixed",
        };
        let _ = writeln!(out, "type = \"{kind}\"\nbetween = {}", between(mechanism, link.between));
        let [first, second] = link.at.map(|at| vector(at, size));
        if link.is_closed() {
            let _ = writeln!(out, "at = {first}");
        } else {
            let gap = link.gap();
            let _ = writeln!(out, "# Open by {gap:.3e} m at the file's pose.");
            let _ = writeln!(out, "at = {{ first = {first}, second = {second} }}");
        }
        let span = number(link.span);
        match link.kind {
            Type::Revolute(axis) => {
                let _ = writeln!(out, "axis = {}\nspan = {span}", vector(axis, 1.0));
            }
            Type::Spherical => {
                let _ = writeln!(out, "arm = {span}");
            }
            Type::Cylindrical(axis) => {
                let (axis, offset) = (vector(axis, 1.0), number(link.span * 0.25));
                let _ = writeln!(out, "axis = {axis}\nspan = {span}\noffset = {offset}");
            }
            Type::Universal(axes) => {
                let [a, b] = axes.map(|axis| vector(axis, 1.0));
                let _ =
                    writeln!(out, "axes = [{a}, {b}]\nspan = {span}\nrealisation = \"bushing\"");
            }
            Type::Translational(axis) => {
                let _ = writeln!(
                    out,
                    "axis = {}\nspan = {span}\ngauge = {span}\noffset = {}\noffsets = \"outward\"",
                    vector(axis, 1.0),
                    number(link.span * 0.25),
                );
            }
            Type::Fixed => {
                let _ = writeln!(out, "axis = [0.0, 0.0, 1.0]\nspan = {span}\narm = {span}");
            }
        }
        let _ = writeln!(out, "stiffness = {}", number(options.stiffness));
        if options.damping > 0.0 {
            let _ = writeln!(out, "damping = {}", number(options.damping));
        }
        link.keys.iter().for_each(|key| {
            let _ = writeln!(out, "{key}");
        });
    }
}

fn springs(out: &mut String, mechanism: &Mechanism<'_>, texts: &Texts) {
    let size = mechanism.size();
    for line in &mechanism.lines {
        out.push('\n');
        comment(out, &line.source, texts);
        let _ = writeln!(out, "[[tsda]]\nname = {}", text(&line.name));
        let _ = writeln!(out, "between = {}", between(mechanism, line.between));
        let [first, second] =
            [0, 1].map(|i| vector(mechanism.within(line.between[i], line.points[i]), size));
        let _ = writeln!(out, "points = [{first}, {second}]");
        let _ = writeln!(out, "free_length = {}", number(line.free_length));
        let _ = writeln!(out, "stiffness = {}", number(line.stiffness));
        let _ = writeln!(out, "damping = {}", number(line.damping));
    }
    for rail in &mechanism.rails {
        out.push('\n');
        comment(out, &rail.source, texts);
        let _ = writeln!(out, "[[point_on_line]]\nname = {}", text(&rail.name));
        let _ = writeln!(out, "between = {}", between(mechanism, [None, Some(rail.part)]));
        let _ = writeln!(out, "line_point = {}", vector(rail.line, size));
        let _ = writeln!(out, "line_direction = {}", vector(rail.across, 1.0));
        let point = mechanism.within(Some(rail.part), rail.at);
        let _ = writeln!(out, "point = {}\nfree_length = 0.0", vector(point, size));
        let _ = writeln!(out, "stiffness = {}", number(rail.stiffness));
        let _ = writeln!(out, "damping = {}", number(rail.damping));
    }
    for spring in &mechanism.torsions {
        out.push('\n');
        comment(out, &spring.source, texts);
        let _ = writeln!(out, "[[torsion_spring]]\nname = {}", text(&spring.name));
        let _ = writeln!(out, "between = {}", between(mechanism, spring.between));
        let _ = writeln!(out, "axis = {}", vector(spring.axis, 1.0));
        let _ = writeln!(out, "stiffness = {}", number(spring.stiffness));
        let _ = writeln!(out, "damping = {}", number(spring.damping));
        let _ = writeln!(out, "preload = {}", number(spring.preload));
    }
    for Interaction { name, law, between: sides, keys, source } in &mechanism.interactions {
        out.push('\n');
        comment(out, source, texts);
        let _ = writeln!(out, "[[interaction]]\nname = {}\nlaw = \"{law}\"", text(name));
        let _ = writeln!(out, "between = {}\n{}", between(mechanism, *sides), keys.join("\n"));
    }
    for coupling in &mechanism.couplings {
        out.push('\n');
        comment(out, &coupling.source, texts);
        let term = |(axis, factor): &(Axis, f64)| {
            let freedom = axis.freedom.map_or(String::new(), |of| format!("freedom = \"{of}\", "));
            format!("{{ joint = {}, {freedom}factor = {} }}", text(&axis.joint), number(*factor))
        };
        let of: Vec<String> = coupling.of.iter().map(term).collect();
        let _ = writeln!(out, "[[coupling]]\nname = {}", text(&coupling.name));
        let _ = writeln!(out, "of = [{}]", of.join(", "));
        let _ = writeln!(out, "stiffness = {}", number(coupling.stiffness));
        let _ = writeln!(out, "damping = {}", number(coupling.damping));
        for (key, value) in [("offset", coupling.offset), ("play", coupling.play)] {
            let value = snapped(value, 1.0);
            if value != 0.0 {
                let _ = writeln!(out, "{key} = {}", number(value));
            }
        }
    }
    for load in &mechanism.loads {
        out.push('\n');
        comment(out, &load.source, texts);
        let _ = writeln!(out, "[[load]]\nbody = {}", text(mechanism.name(Some(load.part))));
        let _ = writeln!(out, "force = {}", vector(load.force, 0.0));
    }
}

fn contacts(out: &mut String, mechanism: &Mechanism<'_>, texts: &Texts) {
    let size = mechanism.size();
    for contact in &mechanism.contacts {
        out.push('\n');
        comment(out, &contact.source, texts);
        let _ = writeln!(out, "[[interaction]]\nname = {}", text(&contact.name));
        let _ = writeln!(out, "law = \"plane-contact\"");
        let _ = writeln!(out, "between = {}", between(mechanism, contact.between));
        let [ground, centre] =
            [0, 1].map(|i| vector(mechanism.within(contact.between[i], contact.points[i]), size));
        let _ = writeln!(out, "points = [{ground}, {centre}]");
        let _ = writeln!(out, "normal = {}", vector(contact.normal, 1.0));
        let _ = writeln!(out, "radius = {}", number(contact.radius));
        let _ = writeln!(out, "{}", mechanism.stop(None).join("\n"));
        contact.grip.iter().for_each(|key| {
            let _ = writeln!(out, "{key}");
        });
    }
}

/// Visible shapes of geoms, in the axes of their bodies.
fn looks(out: &mut String, mechanism: &Mechanism<'_>, texts: &Texts) {
    let size = mechanism.size();
    for look in &mechanism.tree.looks {
        let side = mechanism.side(look.body);
        let pose = mechanism.pose.start[look.body] * look.pose;
        let pose = side.map_or(pose, |part| mechanism.placed(part).inverse() * pose);
        let at = |along: f64| {
            let point = pose.translation.vector + pose.rotation * Vector3::new(0.0, 0.0, along);
            vector(point, size)
        };
        let keys = match look.solid {
            Solid::Sphere(radius) => {
                format!("shape = \"sphere\"\nat = {}\nradius = {}", at(0.0), number(radius))
            }
            Solid::Capsule(radius, half) | Solid::Cylinder(radius, half) => {
                let is_round = matches!(look.solid, Solid::Capsule(..));
                let shape = if is_round { "link" } else { "cylinder" };
                let (from, to, radius) = (at(-half), at(half), number(radius));
                format!("shape = \"{shape}\"\nfrom = {from}\nto = {to}\nradius = {radius}")
            }
            Solid::Box(half) => {
                let turn = pose.rotation;
                let [w, x, y, z] =
                    [turn.w, turn.i, turn.j, turn.k].map(|q| number(snapped(q, 1.0)));
                let sides = vector(Vector3::from(half) * 2.0, 0.0);
                format!(
                    "shape = \"box\"\nat = {}\nsize = {sides}\n\
                     orientation = {{ quaternion = [{w}, {x}, {y}, {z}] }}",
                    at(0.0)
                )
            }
            Solid::Ellipsoid(_) => continue,
        };
        out.push('\n');
        comment(out, &(look.words.clone(), look.place), texts);
        let _ = writeln!(out, "[[geometry]]\nbody = {}\n{keys}", text(mechanism.name(side)));
        if let Some(colour) = &look.colour {
            let _ = writeln!(out, "colour = \"{colour}\"");
        }
    }
}

fn write_signal(out: &mut String, table: &str, signal: &Signal, texts: &Texts) {
    out.push('\n');
    comment(out, &signal.source, texts);
    let _ = writeln!(out, "[[{table}]]\nname = {}\ntype = \"{}\"", text(&signal.name), signal.kind);
    for key in &signal.keys {
        let _ = writeln!(out, "{key}");
    }
}

fn comment(out: &mut String, (words, place): &Source, texts: &Texts) {
    let _ = writeln!(out, "# {}: {}", texts.shown(*place), line(words));
}

fn between(mechanism: &Mechanism<'_>, sides: [Side; 2]) -> String {
    let [first, second] = sides.map(|side| text(mechanism.name(side)));
    format!("[{first}, {second}]")
}
