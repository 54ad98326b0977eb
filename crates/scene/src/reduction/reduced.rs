//! A group in a plane: fewer elements of equal stiffness at rest.
//!
//! `elements => sets of TSDAs, point bushings or points on lines in the plane`. Elements in the plane stay unchanged.
//! Elements that coincide in the plane are added; elements along the normal are dropped; tilted ones act with their
//! in-plane component. A set of more than two legs becomes two along the principal directions of its stiffness
//! `Σ k·u·uᵀ`; points at the same position along a line become one.

use dbd_kernel::Vec3;
use dbd_kernel::model::Law;

use crate::planar::ALIKE;
use crate::reduction::elements::Element;

/// An element of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arm {
    /// Its first endpoint, in the plane.
    pub(super) from: Vec3<f64>,
    /// Its second endpoint.
    pub(super) to: Vec3<f64>,
    /// The points in their bodies' axes, where they are taken from an element.
    pub(super) points: Option<[Vec3<f64>; 2]>,
    /// \[N/m\].
    pub(super) stiffness: f64,
    /// \[N·s/m\].
    pub(super) damping: f64,
    /// \[m\].
    pub(super) free_length: f64,
    /// \[m\] length used where two legs replace many: see [`condensed`].
    reach: f64,
}

/// A group in the plane.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reduced {
    /// The law of its elements.
    pub(super) law: Law,
    /// The direction of its lines, if any.
    pub(super) line: Option<Vec3<f64>>,
    /// The legs of each set.
    pub(super) triples: Vec<Vec<Arm>>,
    /// \[m\] 0 without one.
    pub(super) clearance: f64,
    /// Whether it is exactly equivalent in the plane at any deformation.
    pub(super) is_exact: bool,
}

/// Why a group cannot be reduced, to be read after its name.
pub(super) type Obstacle = String;

/// A group in the plane; points within `near` \[m\] coincide.
pub(super) fn reduced(
    law: Law,
    elements: &[Element],
    clearance: f64,
    near: f64,
) -> Result<Reduced, Obstacle> {
    let line = elements.iter().find_map(|element| element.line);
    match (law, line) {
        (Law::PointOnLine, Some(line)) if line.z.abs() <= ALIKE => {
            lines(elements, line, clearance, near)
        }
        (Law::PointOnLine, Some(line)) if 1.0 - line.z.abs() > ALIKE => {
            Err("has a line that is tilted against the plane".into())
        }
        (Law::PointBushing, _) => bushings(elements, clearance, near),
        (Law::PointOnLine, _) if elements.iter().all(|e| e.free_length == 0.0) => {
            // A line normal to the plane is a point of it.
            bushings(elements, clearance, near)
        }
        _ => triples(elements, clearance, near),
    }
}

fn flat(v: Vec3<f64>) -> Vec3<f64> {
    Vec3::new(v.x, v.y, 0.0)
}

fn length(v: Vec3<f64>) -> f64 {
    libm::sqrt(v.dot(v))
}

fn is_near(a: Vec3<f64>, b: Vec3<f64>, near: f64) -> bool {
    length(a - b) <= near
}

fn bushings(elements: &[Element], clearance: f64, near: f64) -> Result<Reduced, Obstacle> {
    if clearance > 0.0 {
        return Err(
            "has a clearance about a point of the plane, which planar elements do not support"
                .into(),
        );
    }
    let mut arms: Vec<Arm> = Vec::new();
    for element in elements {
        let arm = arm(element, element.stiffness, element.damping, 0.0);
        add(&mut arms, arm, near);
    }
    let triples = arms.into_iter().map(|arm| vec![arm]).collect();
    Ok(Reduced { law: Law::PointBushing, line: None, triples, clearance: 0.0, is_exact: true })
}

fn arm(element: &Element, stiffness: f64, damping: f64, free_length: f64) -> Arm {
    Arm {
        from: flat(element.from),
        to: flat(element.to),
        points: Some([flat(element.centre), flat(element.tip)]),
        stiffness,
        damping,
        free_length,
        reach: free_length,
    }
}

/// Adds an element; merges it with one between the same points.
fn add(arms: &mut Vec<Arm>, arm: Arm, near: f64) {
    let same = |other: &&mut Arm| {
        is_near(other.from, arm.from, near)
            && is_near(other.to, arm.to, near)
            && (other.free_length - arm.free_length).abs() <= near
    };
    match arms.iter_mut().find(same) {
        Some(other) => {
            other.stiffness += arm.stiffness;
            other.damping += arm.damping;
        }
        None => arms.push(arm),
    }
}

/// TSDAs, and points on lines normal to the plane.
fn triples(elements: &[Element], clearance: f64, near: f64) -> Result<Reduced, Obstacle> {
    let mut arms: Vec<Arm> = Vec::new();
    let (mut axis_error, mut is_exact) = (1.0, true);
    for element in elements {
        let Some(along) = element.direction() else { continue };
        let share = length(flat(along));
        if share <= ALIKE {
            is_exact = false;
            continue;
        }
        let is_parallel = 1.0 - share <= ALIKE;
        is_exact &= is_parallel;
        axis_error = share;
        let square = if is_parallel { 1.0 } else { share * share };
        let free_length =
            if is_parallel { element.free_length } else { element.free_length * share };
        if element.line.is_some() && element.damping > 0.0 {
            return Err("damps across its springs, which planar elements do not support".into());
        }
        let own = arm(element, element.stiffness * square, element.damping * square, free_length);
        add(&mut arms, Arm { reach: element.free_length / share, ..own }, near);
    }
    let mut triples: Vec<Vec<Arm>> = Vec::new();
    for arm in arms {
        match triples.iter_mut().find(|triple| is_near(triple[0].from, arm.from, near)) {
            Some(triple) => triple.push(arm),
            None => triples.push(vec![arm]),
        }
    }
    for triple in &mut triples {
        if triple.len() > 2
            && clearance == 0.0
            && let Some(two) = condensed(triple)
        {
            *triple = two;
            is_exact = false;
        }
    }
    if triples.is_empty() {
        return Err("has no stiffness or damping in the plane".into());
    }
    let clearance = if clearance > 0.0 { clearance / axis_error } else { 0.0 };
    Ok(Reduced { law: Law::Tsda, line: None, triples, clearance, is_exact })
}

/// The unit direction of a leg.
fn direction(arm: &Arm) -> Vec3<f64> {
    crate::direction::unit(arm.to - arm.from).unwrap_or(Vec3::new(1.0, 0.0, 0.0))
}

/// Replaces many legs by two, or by one where the set is stiff in one direction only; `None`, which keeps the legs,
/// where the dampers have other principal directions than the springs, or where stiffness and damping are zero, or too
/// small or too large for their sums.
///
/// At rest stiffness and damping are equal in every direction. Their length is arbitrary; it is set to the mean of
/// `L0/cos` of the elements, with the cosine of their tilt. For a pin, K its stiffness, the energy of third order in a
/// displacement δ is `¼·K·δ³·cos/L0·cos(3·φ)` before and `−½·K·x·y·(x + y)/L` after, whose mean squares over all
/// directions φ are the same then.
fn condensed(triple: &[Arm]) -> Option<Vec<Arm>> {
    let sum = |strength: fn(&Arm) -> f64| {
        triple.iter().fold([0.0; 3], |[xx, xy, yy], arm| {
            let (u, k) = (direction(arm), strength(arm));
            [xx + k * u.x * u.x, xy + k * u.x * u.y, yy + k * u.y * u.y]
        })
    };
    let (stiff, damp) = (sum(|arm| arm.stiffness), sum(|arm| arm.damping));
    let whole = |[xx, _, yy]: [f64; 3]| xx + yy;
    if !(whole(stiff) + whole(damp)).is_finite() {
        return None;
    }
    let [xx, xy, yy] = if whole(stiff) > 0.0 { stiff } else { damp };
    let (first, scale) = (direction(triple.first()?), xx + yy);
    let is_round = (xx - yy).abs() <= ALIKE * scale && xy.abs() <= ALIKE * scale;
    let main = if is_round {
        first
    } else {
        let angle = 0.5 * libm::atan2(2.0 * xy, xx - yy);
        let main = Vec3::new(libm::cos(angle), libm::sin(angle), 0.0);
        if main.dot(first) < 0.0 { -main } else { main }
    };
    let across = Vec3::new(-main.y, main.x, 0.0);
    let along = |[xx, xy, yy]: [f64; 3], u: Vec3<f64>, v: Vec3<f64>| {
        u.x * (xx * v.x + xy * v.y) + u.y * (xy * v.x + yy * v.y)
    };
    if along(damp, main, across).abs() > ALIKE * whole(damp) {
        return None;
    }
    let free_length = triple.iter().map(|arm| arm.reach).sum::<f64>() / triple.len() as f64;
    let from = triple.first()?.from;
    let arm = |u: Vec3<f64>| Arm {
        from,
        to: from + u * free_length,
        points: None,
        stiffness: along(stiff, u, u),
        damping: along(damp, u, u),
        free_length,
        reach: free_length,
    };
    let acts =
        |arm: &Arm| arm.stiffness > ALIKE * whole(stiff) || arm.damping > ALIKE * whole(damp);
    let two: Vec<Arm> = [main, across].map(arm).into_iter().filter(acts).collect();
    (!two.is_empty()).then_some(two)
}

/// Points at the same position along their lines.
struct Row {
    /// \[m\] along the lines.
    along: f64,
    /// The point with the largest in-plane deformation represents all.
    arm: Arm,
    /// \[m\] in-plane distance from its line to its point.
    deflection: f64,
    /// \[m\] position of each line across its direction.
    feet: Vec<f64>,
    is_flat: bool,
}

/// Points on lines in the plane or parallel to it.
fn lines(
    elements: &[Element],
    line: Vec3<f64>,
    clearance: f64,
    near: f64,
) -> Result<Reduced, Obstacle> {
    let line = crate::direction::unit(flat(line)).unwrap_or(line);
    let across = Vec3::new(-line.y, line.x, 0.0);
    let mut rows: Vec<Row> = Vec::new();
    for element in elements {
        let along = element.to.dot(line);
        let deflection = element.deformation().dot(across);
        let share = element.direction().map_or(1.0, |direction| direction.dot(across).abs());
        let share = if 1.0 - share <= ALIKE {
            1.0
        } else if share <= ALIKE {
            0.0
        } else {
            share
        };
        let damping = if clearance == 0.0 || share > 0.0 { element.damping } else { 0.0 };
        let free_length = element.free_length * share;
        let arm = arm(element, element.stiffness * share * share, damping, free_length);
        let foot = element.to.dot(across) - deflection;
        let is_flat = element.is_flat(near);
        match rows.iter_mut().find(|row| (row.along - along).abs() <= near) {
            None => rows.push(Row { along, arm, deflection, feet: vec![foot], is_flat }),
            Some(row) => {
                let (stiffness, damping) =
                    (row.arm.stiffness + arm.stiffness, row.arm.damping + arm.damping);
                if arm.free_length > row.arm.free_length {
                    (row.arm, row.deflection) = (arm, deflection);
                }
                row.arm = Arm { stiffness, damping, ..row.arm };
                row.feet.push(foot);
            }
        }
    }
    rows.retain(|row| row.arm.stiffness > 0.0 || row.arm.damping > 0.0 || row.is_flat);
    if rows.is_empty() {
        return Err("has no stiffness or damping in the plane".into());
    }
    let is_exact = rows.iter().all(Row::is_exact);
    let triples = rows.into_iter().map(|row| vec![row.settled(line, across)]).collect();
    Ok(Reduced { law: Law::PointOnLine, line: Some(line), triples, clearance, is_exact })
}

impl Row {
    fn is_exact(&self) -> bool {
        self.is_flat && self.feet.len() == 1
    }

    /// Its element, midway between the lines.
    fn settled(self, line: Vec3<f64>, across: Vec3<f64>) -> Arm {
        if self.is_exact() {
            return self.arm;
        }
        let foot = self.feet.iter().sum::<f64>() / self.feet.len() as f64;
        let from = line * self.along + across * foot;
        Arm { from, to: from + across * self.deflection, points: None, ..self.arm }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The three elements of a pin, 120 degrees apart.
    fn pin(stiffness: f64, damping: f64) -> Vec<Element> {
        let element = |i: f64| {
            let angle = core::f64::consts::TAU * i / 3.0;
            let to = Vec3::new(libm::cos(angle), libm::sin(angle), 0.5) * 0.1;
            let from = Vec3::ZERO;
            let free_length = length(to);
            Element { from, to, centre: from, tip: to, line: None, stiffness, damping, free_length }
        };
        [0.0, 1.0, 2.0].map(element).to_vec()
    }

    #[test]
    fn no_strength_leaves_a_star_without_arms() {
        let strengths = [0.0, -0.0, f64::from_bits(1), 1e-300, 1e5, 1.7e308];
        for stiffness in strengths {
            for damping in strengths {
                let found = reduced(Law::Tsda, &pin(stiffness, damping), 0.0, 1e-9).unwrap();
                let case = format!("stiffness {stiffness:e}, damping {damping:e}: {found:?}");
                assert!(found.triples.iter().all(|triple| !triple.is_empty()), "{case}");
                let arms = || found.triples.iter().flatten();
                assert!(arms().all(|arm| arm.stiffness.is_finite()), "{case}");
                assert!(arms().all(|arm| arm.damping.is_finite()), "{case}");
            }
        }
    }
}
