//! Placement of labels: near their anchors, away from marks, lines and each other.
//!
//! `(obstacles, anchor, text) => box`. Candidates lie in rings around the anchor; the one with the least overlap is
//! taken, the nearer of equals. Placed labels are obstacles to the next.

/// A rectangle \[pixels\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Left.
    pub x: f64,
    /// Top.
    pub y: f64,
    /// Its width.
    pub width: f64,
    /// Its height.
    pub height: f64,
}

impl Rectangle {
    fn touches(&self, other: &Self, gap: f64) -> bool {
        self.x < other.x + other.width + gap
            && other.x < self.x + self.width + gap
            && self.y < other.y + other.height + gap
            && other.y < self.y + self.height + gap
    }

    fn contains(&self, (x, y): (f64, f64), gap: f64) -> bool {
        (self.x - gap..=self.x + self.width + gap).contains(&x)
            && (self.y - gap..=self.y + self.height + gap).contains(&y)
    }

    fn within(&self, outer: &Self) -> bool {
        self.x >= outer.x
            && self.y >= outer.y
            && self.x + self.width <= outer.x + outer.width
            && self.y + self.height <= outer.y + outer.height
    }

    /// Its point nearest to another.
    pub fn nearest(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (x.clamp(self.x, self.x + self.width), y.clamp(self.y, self.y + self.height))
    }
}

/// Occupied areas of the chart.
pub struct LabelPositions {
    bounds: Rectangle,
    labels: Vec<Rectangle>,
    marks: Vec<(f64, f64)>,
    strokes: Vec<(f64, f64)>,
}

/// \[pixels\] between the samples of a stroke.
const SAMPLING: f64 = 4.0;
/// \[pixels\] maximum distance from a label's anchor to its box.
const RINGS: [f64; 5] = [8.0, 14.0, 22.0, 32.0, 44.0];
const DIRECTIONS: u32 = 24;

/// How bad it is to lie on a mark, on a sample of a stroke, and against the direction wished; in
/// pixels of distance.
const ON_MARK: f64 = 60.0;
const ON_STROKE: f64 = 9.0;
const AGAINST: f64 = 30.0;

impl LabelPositions {
    /// None yet.
    pub fn new(bounds: Rectangle) -> Self {
        Self { bounds, labels: Vec::new(), marks: Vec::new(), strokes: Vec::new() }
    }

    /// A mark to keep free.
    pub fn mark(&mut self, at: (f64, f64)) {
        self.marks.push(at);
    }

    /// A stroke that labels should not hide.
    pub fn stroke(&mut self, (x0, y0): (f64, f64), (x1, y1): (f64, f64)) {
        let count = (libm::hypot(x1 - x0, y1 - y0) / SAMPLING).ceil().max(1.0);
        for n in 0..=count as u32 {
            let share = f64::from(n) / count;
            self.strokes.push((x0 + share * (x1 - x0), y0 + share * (y1 - y0)));
        }
    }

    /// A box that no label may touch.
    pub fn reserve(&mut self, rectangle: Rectangle) {
        self.labels.push(rectangle);
    }

    /// Finds the spot of a label of a size, best in a direction (unit vector, y down); `None` where every
    /// spot is worse than `worst` \[pixels\].
    pub fn find(
        &mut self,
        anchor: (f64, f64),
        (width, height): (f64, f64),
        wish: (f64, f64),
        worst: f64,
    ) -> Option<Rectangle> {
        let mut best: Option<(f64, Rectangle)> = None;
        for ring in RINGS {
            for n in 0..DIRECTIONS {
                let angle = f64::from(n) * std::f64::consts::TAU / f64::from(DIRECTIONS);
                // The same spots on every machine.
                let (sine, cosine) = libm::sincos(angle);
                let rectangle = Rectangle {
                    x: anchor.0 + cosine * (width / 2.0 + ring) - width / 2.0,
                    y: anchor.1 + sine * (height / 2.0 + ring) - height / 2.0,
                    width,
                    height,
                };
                if !rectangle.within(&self.bounds) {
                    continue;
                }
                let against = AGAINST * (1.0 - cosine * wish.0 - sine * wish.1);
                let Some(hidden) = self.hidden(anchor, &rectangle) else { continue };
                let badness = ring + against + hidden;
                if best.is_none_or(|(least, _)| badness < least - 1e-6) {
                    best = Some((badness, rectangle));
                }
            }
        }
        let (_, rectangle) = best.filter(|(badness, _)| *badness <= worst)?;
        self.reserve(rectangle);
        self.stroke(anchor, rectangle.nearest(anchor));
        Some(rectangle)
    }

    /// How much a label would hide, its leader included; `None` where it would lie on another.
    fn hidden(&self, anchor: (f64, f64), rectangle: &Rectangle) -> Option<f64> {
        let end = rectangle.nearest(anchor);
        let on_leader = |share: f64| {
            (anchor.0 + share * (end.0 - anchor.0), anchor.1 + share * (end.1 - anchor.1))
        };
        let crosses = self.labels.iter().any(|other| {
            rectangle.touches(other, 2.0)
                || [0.2, 0.4, 0.6, 0.8].iter().any(|share| other.contains(on_leader(*share), 0.0))
        });
        if crosses {
            return None;
        }
        let count = |points: &[(f64, f64)], gap: f64| {
            points.iter().filter(|point| rectangle.contains(**point, gap)).count() as f64
        };
        Some(ON_MARK * count(&self.marks, 4.0) + ON_STROKE * count(&self.strokes, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_keep_off_each_other_and_inside() {
        let bounds = Rectangle { x: 0.0, y: 0.0, width: 600.0, height: 400.0 };
        let mut positions = LabelPositions::new(bounds);
        let anchors: Vec<_> = (0..12).map(|n| (250.0 + 9.0 * f64::from(n), 200.0)).collect();
        for anchor in &anchors {
            positions.mark(*anchor);
        }
        let placed: Vec<Rectangle> = anchors
            .iter()
            .filter_map(|at| positions.find(*at, (90.0, 14.0), (-1.0, 0.0), 1e3))
            .collect();
        assert!(placed.len() >= 4, "{}", placed.len());
        for (anchor, rectangle) in anchors.iter().zip(&placed) {
            let near = rectangle.nearest(*anchor);
            assert!((near.0 - anchor.0).hypot(near.1 - anchor.1) < 130.0, "{rectangle:?}");
        }
        for (n, rectangle) in placed.iter().enumerate() {
            assert!(rectangle.within(&bounds), "{rectangle:?}");
            assert!(placed[..n].iter().all(|other| !rectangle.touches(other, 1.0)), "{n}");
            assert!(anchors.iter().all(|mark| !rectangle.contains(*mark, 0.0)), "{n}");
        }
        // Where the space is taken, there is no label rather than a hidden one.
        positions.reserve(bounds);
        assert_eq!(positions.find((300.0, 200.0), (90.0, 14.0), (-1.0, 0.0), 1e3), None);
    }
}
