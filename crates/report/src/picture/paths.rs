//! Lines that symbols are made of: zigzags, hatching, arrow heads, hulls.
//!
//! `points on paper => points on paper`.

use crate::picture::ink::Point;

fn apart((x0, y0): Point, (x1, y1): Point) -> f64 {
    libm::hypot(x1 - x0, y1 - y0)
}

/// A point at a fraction between two.
pub(crate) fn between((x0, y0): Point, (x1, y1): Point, share: f64) -> Point {
    (x0 + share * (x1 - x0), y0 + share * (y1 - y0))
}

/// The direction from one point to another and the one to its right; `None` where they are one.
pub(crate) fn directions(from: Point, to: Point) -> Option<(Point, Point)> {
    let length = apart(from, to);
    if length < 1e-9 {
        return None;
    }
    let (x, y) = ((to.0 - from.0) / length, (to.1 - from.1) / length);
    Some(((x, y), (-y, x)))
}

/// `from + along·u + across·v`.
pub(crate) fn offset(
    from: Point,
    ((ux, uy), (vx, vy)): (Point, Point),
    along: f64,
    across: f64,
) -> Point {
    (from.0 + along * ux + across * vx, from.1 + along * uy + across * vy)
}

/// A spring between two points; `None` if they are too close.
pub(crate) fn zigzag(from: Point, to: Point, symbols: f64) -> Option<Vec<Point>> {
    let length = apart(from, to);
    let frame = directions(from, to)?;
    if length < 12.0 * symbols {
        return None;
    }
    let lead = (0.2 * length).min(40.0 * symbols);
    let teeth = ((length - 2.0 * lead) / (5.0 * symbols)).clamp(5.0, 40.0) as usize;
    let pitch = (length - 2.0 * lead) / teeth as f64;
    let mut points = vec![from, offset(from, frame, lead, 0.0)];
    for tooth in 0..teeth {
        let side = if tooth % 2 == 0 { 1.0 } else { -1.0 };
        let along = lead + (tooth as f64 + 0.5) * pitch;
        points.push(offset(from, frame, along, side * 5.0 * symbols));
    }
    points.extend([offset(from, frame, length - lead, 0.0), to]);
    Some(points)
}

/// The head of an arrow that ends at a point, along a unit direction.
pub(crate) fn head(tip: Point, (x, y): Point, size: f64) -> [Point; 3] {
    let frame = ((x, y), (-y, x));
    [tip, offset(tip, frame, -size, 0.45 * size), offset(tip, frame, -size, -0.45 * size)]
}

/// A ground line through a point along a unit direction, and its hatching to the line's right.
pub(crate) fn ground(at: Point, (x, y): Point, half: f64, symbols: f64) -> Vec<[Point; 2]> {
    let frame = ((x, y), (-y, x));
    let mut lines = vec![[offset(at, frame, -half, 0.0), offset(at, frame, half, 0.0)]];
    let count = (2.0 * half / (5.5 * symbols)).clamp(3.0, 40.0) as usize;
    for n in 0..count {
        let along = half * (2.0 * (n as f64 + 0.8) / count as f64 - 1.0);
        let foot = offset(at, frame, along, 0.0);
        lines.push([foot, offset(foot, frame, -4.5 * symbols, 6.0 * symbols)]);
    }
    lines
}

/// The convex hull of points, counter-clockwise in axes of x right and y up (Andrew 1979).
pub(crate) fn hull(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    sorted.dedup_by(|a, b| apart(*a, *b) < 0.05);
    if sorted.len() < 3 {
        return sorted;
    }
    let turn = |a: Point, b: Point, c: Point| (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0);
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && turn(a, b, point) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut sorted.iter().copied());
    hull.extend(half(&mut sorted.iter().rev().copied()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_goes_around_all_points() {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (1.0, 1.0), (1.0, 0.0)];
        assert_eq!(hull(&square), [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        assert_eq!(hull(&[(1.0, 1.0); 4]), [(1.0, 1.0)]);
        assert_eq!(hull(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]), [(0.0, 0.0), (2.0, 2.0)]);
    }

    #[test]
    fn a_spring_goes_from_end_to_end() {
        let spring = zigzag((0.0, 0.0), (60.0, 0.0), 1.0).unwrap();
        assert_eq!((spring[0], spring[spring.len() - 1]), ((0.0, 0.0), (60.0, 0.0)));
        assert!(spring.iter().all(|(x, y)| (0.0..=60.0).contains(x) && y.abs() <= 5.0));
        assert_eq!(zigzag((1.0, 1.0), (1.0, 1.0), 1.0), None);
    }
}
