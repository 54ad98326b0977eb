//! Legend of a picture: one entry for each kind of symbol.
//!
//! `mechanism => symbols with words, in rows`.

use crate::picture::bodies::centre_of_mass;
use crate::picture::ink::{Point, line, path, through, width, words};
use crate::picture::mechanism::{ForceKind, JointKind, Mechanism};
use crate::picture::paths::{ground, head, zigzag};
use crate::picture::style::LETTERS;
use crate::picture::symbols::{bushing, joint_symbol};

/// \[pixels\] from row to row.
const ROW: f64 = 26.0;
/// \[pixels\] of a symbol's room.
const SYMBOL: f64 = 34.0;

/// An entry: draws its symbol about a point.
struct Entry {
    words: String,
    draw: fn(&mut String, Point),
}

fn counted(count: usize, one: &str, many: &str) -> String {
    if count == 1 { one.into() } else { format!("{count} {many}") }
}

fn joint_entry(kind: JointKind, count: usize) -> Entry {
    let (name, draw): (&str, fn(&mut String, Point)) = match kind {
        JointKind::Fixed => ("fixed", |t, at| joint_symbol(t, at, JointKind::Fixed, None, 1.0)),
        JointKind::Translational => ("translational", |t, at| {
            joint_symbol(t, at, JointKind::Translational, Some((1.0, 0.0)), 1.0);
        }),
        JointKind::Cylindrical => ("cylindrical", |t, at| {
            joint_symbol(t, at, JointKind::Cylindrical, Some((1.0, 0.0)), 1.0);
        }),
        JointKind::Revolute => {
            ("revolute", |t, at| joint_symbol(t, at, JointKind::Revolute, None, 1.0))
        }
        JointKind::Universal => ("universal", |t, (x, y)| {
            joint_symbol(t, (x, y), JointKind::Universal, None, 1.0);
            line(t, "ink", &[(x - 6.5, y - 6.5), (x + 6.5, y + 6.5)]);
            line(t, "ink", &[(x - 6.5, y + 6.5), (x + 6.5, y - 6.5)]);
        }),
        JointKind::Spherical => {
            ("spherical", |t, at| joint_symbol(t, at, JointKind::Spherical, None, 1.0))
        }
        JointKind::Other => ("joint", |t, at| joint_symbol(t, at, JointKind::Other, None, 1.0)),
    };
    Entry { words: counted(count, &format!("{name} joint"), &format!("{name} joints")), draw }
}

fn entries(mechanism: &Mechanism) -> Vec<Entry> {
    use JointKind::{Cylindrical, Fixed, Other, Revolute, Spherical, Translational, Universal};
    let mut entries: Vec<Entry> = Vec::new();
    for kind in [Revolute, Spherical, Universal, Cylindrical, Translational, Fixed, Other] {
        let count = mechanism.joints.iter().filter(|joint| joint.kind == kind).count();
        if count > 0 {
            entries.push(joint_entry(kind, count));
        }
    }
    let mut add = |count: usize, one: &str, many: &str, draw: fn(&mut String, Point)| {
        if count > 0 {
            entries.push(Entry { words: counted(count, one, many), draw });
        }
    };
    let bushings = mechanism.springs.iter().filter(|spring| spring.free_length == 0.0).count();
    add(mechanism.springs.len() - bushings, "TSDA", "TSDAs", |text, (x, y)| {
        line(text, "ink", &zigzag((x - 15.0, y), (x + 15.0, y), 0.8).unwrap_or_default());
    });
    add(bushings, "point spring", "point springs", |text, at| bushing(text, at, "ink", 1.0));
    add(mechanism.guides.len(), "point on a line", "points on lines", |text, (x, y)| {
        line(text, "guide", &[(x - 15.0, y), (x + 15.0, y)]);
        let corners = [(x - 4.5, y), (x, y - 4.5), (x + 4.5, y), (x, y + 4.5)];
        path(text, "joint", &through(&corners, true));
    });
    add(mechanism.torsions.len(), "torsion spring", "torsion springs", |text, (x, y)| {
        let spiral = (0..=40).map(|n| {
            let share = f64::from(n) / 40.0;
            let (angle, radius) = (13.0 * share, 3.0 + 7.0 * share);
            (x + radius * libm::cos(angle), y + radius * libm::sin(angle))
        });
        line(text, "ink", &spiral.collect::<Vec<_>>());
    });
    let interactions = &mechanism.interactions;
    let at_points = interactions.iter().filter(|one| one.ends.is_some()).count();
    let about_axes = interactions.iter().filter(|one| one.axis.is_some()).count();
    add(at_points, "interaction at points", "interactions at points", |text, (x, y)| {
        line(text, "guide", &[(x - 10.0, y), (x + 12.0, y)]);
        line(text, "ink", &[(x - 10.0, y - 9.0), (x - 10.0, y + 9.0)]);
        path(
            text,
            "full",
            &through(&[(x + 10.0, y - 2.0), (x + 14.0, y), (x + 10.0, y + 2.0)], true),
        );
    });
    add(about_axes, "interaction about an axis", "interactions about axes", |text, (x, y)| {
        let arc = (0..=12).map(|n| -0.6 + 2.5 * f64::from(n) / 12.0);
        let arc: Vec<Point> =
            arc.map(|a| (x + 10.0 * libm::cos(a), y - 10.0 * libm::sin(a))).collect();
        line(text, "ink", &arc);
    });
    let on_ground = |place: &crate::picture::mechanism::Place| place.body.is_none();
    let stands = mechanism.joints.iter().flat_map(|joint| &joint.places).any(on_ground)
        || mechanism.springs.iter().flat_map(|spring| &spring.ends).any(on_ground)
        || interactions.iter().flat_map(|one| &one.ends).any(|ends| on_ground(&ends[0]));
    if stands {
        entries.push(Entry {
            words: "ground".into(),
            draw: |text, (x, y)| {
                for part in ground((x, y - 3.0), (1.0, 0.0), 14.0, 1.0) {
                    line(text, "ink", &part);
                }
            },
        });
    }
    let pushes = |kind: ForceKind| mechanism.forces.iter().any(|force| force.kind == kind);
    let arrow: fn(&mut String, Point) = |text, (x, y)| {
        line(text, "force", &[(x - 14.0, y), (x + 8.0, y)]);
        path(text, "head", &through(&head((x + 14.0, y), (1.0, 0.0), 9.0), true));
    };
    let turning: fn(&mut String, Point) = |text, (x, y)| {
        let arc = (0..=18).map(|n| 0.4 + 4.4 * f64::from(n) / 18.0);
        let arc: Vec<Point> =
            arc.map(|a| (x + 10.0 * libm::cos(a), y - 10.0 * libm::sin(a))).collect();
        line(text, "force", &arc);
        path(text, "head", &through(&head((x + 5.0, y + 10.5), (1.0, 0.15), 8.0), true));
    };
    let driven: fn(&mut String, Point) = |text, (x, y)| {
        line(text, "force", &zigzag((x - 15.0, y), (x + 15.0, y), 0.8).unwrap_or_default());
    };
    if pushes(ForceKind::Force) || pushes(ForceKind::Shift) {
        entries.push(Entry { words: "load or input".into(), draw: arrow });
    }
    if pushes(ForceKind::Torque) {
        entries.push(Entry { words: "torque, load or input".into(), draw: turning });
    }
    if mechanism.springs.iter().any(|spring| spring.driven) {
        entries.push(Entry { words: "driven TSDA".into(), draw: driven });
    }
    if !mechanism.bodies.is_empty() {
        entries.push(Entry {
            words: "centre of mass".into(),
            draw: |text, at| centre_of_mass(text, at, 5.5),
        });
    }
    entries
}

/// Writes the entries in rows from a corner on; returns their height \[pixels\].
pub(crate) fn write(
    text: &mut String,
    mechanism: &Mechanism,
    (left, top): Point,
    room: f64,
) -> f64 {
    let (mut x, mut y) = (left, top);
    for entry in entries(mechanism) {
        let size = SYMBOL + 6.0 + width(&entry.words, LETTERS);
        if x > left && x + size > left + room {
            (x, y) = (left, y + ROW);
        }
        let centre = (x + 0.5 * SYMBOL, y + 0.5 * ROW);
        (entry.draw)(text, centre);
        words(text, "quiet", (x + SYMBOL + 4.0, centre.1 + 5.0), "start", &entry.words);
        x += size + 14.0;
    }
    y + ROW - top
}

/// A scale: a bar of the given pixels and its length.
pub(crate) fn scale_bar(text: &mut String, (x, y): Point, (pixels, name): (f64, &str)) {
    let end = x + pixels;
    line(text, "ink", &[(x, y - 4.0), (x, y + 4.0)]);
    line(text, "ink", &[(x, y), (end, y)]);
    line(text, "ink", &[(end, y - 4.0), (end, y + 4.0)]);
    words(text, "quiet", (x + 0.5 * pixels, y - 9.0), "middle", name);
}
