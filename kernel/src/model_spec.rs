//! A const model written by hand: bodies and elements, with sizes counted by the compiler.
//!
//! `numbers in double precision => Model, in flash`. [`ModelSpec`] exists at compile time only; [`model!`](crate::model!)
//! counts it, rounds it once to the precision and checks it. It has the bits of the run-time builder's model with the
//! same elements in the same order.

mod bushings;
mod round;

use crate::body::{Body, BodyState};
use crate::elements::element::Law;
use crate::elements::load::{Load, LoadFrame};
use crate::elements::point_bushing::PointBushing;
use crate::elements::revolute::Revolute;
use crate::elements::torsion_spring::TorsionSpring;
use crate::elements::tsda::Tsda;
use crate::elements::universal::Universal;
use crate::geometry::F64;
use crate::index::{BodyIndex, ClearanceIndex, DamperIndex};
use crate::model::Group;
use crate::vector::{Quaternion, Vec3};

/// Largest number of bodies of a sketch; a scene in TOML has no such limit.
const BODIES: usize = 32;
/// Largest number of groups, of torsion springs and of loads.
const GROUPS: usize = 64;
/// Largest number of points, and of TSDAs.
const POINTS: usize = 256;

/// The initial state of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// \[m\] centre of mass, world.
    pub position: [f64; 3],
    /// \[1\] unit quaternion, scalar first, body → world.
    pub orientation: [f64; 4],
    /// \[m/s\] world.
    pub velocity: [f64; 3],
    /// \[rad/s\] body axes.
    pub angular_velocity: [f64; 3],
}

impl Start {
    /// At rest, with the world's axes, at `position` \[m\].
    #[must_use]
    pub const fn at(position: [f64; 3]) -> Self {
        let orientation = [1.0, 0.0, 0.0, 0.0];
        Self { position, orientation, velocity: [0.0; 3], angular_velocity: [0.0; 3] }
    }
}

/// The constants of a TSDA.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spring {
    /// \[N/m\] stiffness, ≥ 0.
    pub stiffness: f64,
    /// \[N·s/m\] damping, ≥ 0.
    pub damping: f64,
    /// \[m\] free length, ≥ 0; 0 makes a point bushing.
    pub free_length: f64,
}

/// A model under construction, in double precision. Used in a `const`, it costs no memory at run time.
#[derive(Clone, Copy, Debug)]
pub struct ModelSpec {
    bodies: List<Body<f64>, BODIES>,
    initial: List<BodyState<F64>, BODIES>,
    gravity: List<Vec3<f64>, 1>,
    groups: List<Group, GROUPS>,
    points: List<Vec3<f64>, POINTS>,
    tsdas: List<Tsda<f64>, POINTS>,
    bushings: List<PointBushing<f64>, POINTS>,
    dampers: List<f64, POINTS>,
    torsions: List<TorsionSpring<f64>, GROUPS>,
    loads: List<Load<f64>, GROUPS>,
    revolutes: List<Revolute<f64>, GROUPS>,
    universals: List<Universal<f64>, GROUPS>,
}

/// The first `count` of `items`.
#[derive(Clone, Copy, Debug)]
struct List<T, const N: usize> {
    items: [T; N],
    count: usize,
}

impl<T: Copy, const N: usize> List<T, N> {
    const fn of(blank: T) -> Self {
        Self { items: [blank; N], count: 0 }
    }

    const fn push(mut self, item: T) -> Self {
        assert!(self.count < N, "the capacity of a sketch is exceeded; use a scene");
        self.items[self.count] = item;
        self.count += 1;
        self
    }
}

const NOWHERE: Vec3<f64> = Vec3::new(0.0, 0.0, 0.0);
const NO_TURN: Quaternion<f64> = Quaternion { w: 1.0, v: NOWHERE };

const fn vector(v: [f64; 3]) -> Vec3<f64> {
    assert!(v[0].is_finite() && v[1].is_finite() && v[2].is_finite(), "a number is not finite");
    Vec3::new(v[0], v[1], v[2])
}

/// A point as a model stores it: without negative zeros.
const fn point(v: [f64; 3]) -> Vec3<f64> {
    vector([v[0] + 0.0, v[1] + 0.0, v[2] + 0.0])
}

const fn assert_unit(sum_of_squares: f64) {
    let off = sum_of_squares - 1.0;
    assert!(-1e-9 < off && off < 1e-9, "an axis or a quaternion is not of unit length");
}

const fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

const fn assert_not_negative(number: f64) {
    assert!(number.is_finite() && number >= 0.0, "a constant is negative or not finite");
}

impl Default for ModelSpec {
    fn default() -> Self {
        Self::new()
    }
}

impl ModelSpec {
    /// An empty sketch.
    #[must_use]
    pub const fn new() -> Self {
        let body = BodyIndex::WORLD;
        Self {
            bodies: List::of(Body {
                mass: 0.0,
                inertia: NOWHERE,
                inverse_mass: 0.0,
                inverse_inertia: NOWHERE,
                ratio: NOWHERE,
                inverse_ratio: NOWHERE,
            }),
            initial: List::of(BodyState {
                position: NOWHERE,
                orientation: NO_TURN,
                velocity: NOWHERE,
                angular_velocity: NOWHERE,
            }),
            gravity: List::of(NOWHERE),
            groups: List::of(Group {
                law: Law::Tsda,
                a: body,
                b: body,
                triples: 1,
                arms: 1,
                shared: false,
                point: 0,
                element: 0,
                damper: DamperIndex::NONE,
                clearance: ClearanceIndex::NONE,
            }),
            points: List::of(NOWHERE),
            tsdas: List::of(Tsda { stiffness: 0.0, free_length: 0.0 }),
            bushings: List::of(PointBushing { stiffness: 0.0 }),
            dampers: List::of(0.0),
            torsions: List::of(TorsionSpring {
                a: body,
                b: body,
                axis: NOWHERE,
                reference: NO_TURN,
                stiffness: 0.0,
                preload: 0.0,
                damper: DamperIndex::NONE,
            }),
            loads: List::of(Load {
                body,
                frame: LoadFrame::World,
                force: NOWHERE,
                torque: NOWHERE,
                from: 0.0,
                until: 0.0,
            }),
            revolutes: List::of(Revolute { stiffness: 0.0, along: 0.0, levers: [NOWHERE; 2] }),
            universals: List::of(Universal { stiffness: 0.0, lever: NOWHERE, axis: NOWHERE }),
        }
    }

    /// Sets gravity \[m/s²\].
    ///
    /// # Panics
    /// Where it is set twice or not finite; in a `const` at compile time.
    #[must_use]
    pub const fn gravity(mut self, field: [f64; 3]) -> Self {
        self.gravity = self.gravity.push(vector(field));
        self
    }

    /// The next body, the first is `BodyIndex(0)`: mass \[kg\] and principal inertia \[kg·m²\].
    ///
    /// # Panics
    /// Where a number is out of range, or the capacity for bodies is exceeded.
    #[must_use]
    pub const fn body(mut self, mass: f64, inertia: [f64; 3], start: Start) -> Self {
        let [x, y, z] = inertia;
        assert!(mass > 0.0 && mass.is_finite(), "a mass is not positive");
        assert!(x > 0.0 && y > 0.0 && z > 0.0, "a moment of inertia is not positive");
        let slack = 1.0 + 1e-9;
        let triangle = x <= (y + z) * slack && y <= (z + x) * slack && z <= (x + y) * slack;
        assert!(triangle, "an inertia violates the triangle inequality");
        self.bodies = self.bodies.push(Body {
            mass,
            inertia: vector(inertia),
            inverse_mass: 1.0 / mass,
            inverse_inertia: vector([1.0 / x, 1.0 / y, 1.0 / z]),
            ratio: vector([z / y, x / z, y / x]),
            inverse_ratio: vector([y / z, z / x, x / y]),
        });
        let [w, i, j, k] = start.orientation;
        assert_unit(w * w + dot([i, j, k], [i, j, k]));
        self.initial = self.initial.push(BodyState {
            position: vector(start.position),
            orientation: Quaternion { w, v: vector([i, j, k]) },
            velocity: vector(start.velocity),
            angular_velocity: vector(start.angular_velocity),
        });
        self
    }

    /// A TSDA between two points \[m\], each in its body's axes from the centre of mass, world for the
    /// ground.
    ///
    /// # Panics
    /// Where a number is out of range or a list is full.
    #[must_use]
    pub const fn tsda(
        self,
        between: [BodyIndex; 2],
        points: [[f64; 3]; 2],
        spring: Spring,
    ) -> Self {
        self.triples(between, &[points[0]], &[points[1]], spring)
    }

    /// The TSDAs of one joint: each of the `centres` \[m\] of the first body is joined to all `arms` \[m\], points of
    /// the second, 1 to 3. A spherical joint is one centre with three legs, a revolute two with the same three
    /// endpoints; in the plane a revolute is one centre with two legs. Without a free length each centre has one
    /// endpoint, not shared: a spherical joint is one such pair, a revolute two.
    ///
    /// # Panics
    /// Where a number is out of range or a list is full; without a free length, where `arms` and `centres` differ in
    /// length.
    #[must_use]
    pub const fn triples(
        mut self,
        between: [BodyIndex; 2],
        centres: &[[f64; 3]],
        arms: &[[f64; 3]],
        spring: Spring,
    ) -> Self {
        assert_not_negative(spring.stiffness);
        assert_not_negative(spring.damping);
        assert_not_negative(spring.free_length);
        assert!(!centres.is_empty() && centres.len() <= 255, "a joint must have 1 to 255 centres");
        let bushing = spring.free_length == 0.0;
        let known =
            if bushing { arms.len() == centres.len() } else { !arms.is_empty() && arms.len() <= 3 };
        assert!(known, "one to three legs are needed; without a free length, one leg per centre");
        let elements = if bushing { centres.len() } else { centres.len() * arms.len() };
        let damper = if spring.damping > 0.0 {
            DamperIndex(self.dampers.count as u16)
        } else {
            DamperIndex::NONE
        };
        let element = if bushing { self.bushings.count } else { self.tsdas.count } as u16;
        self.groups = self.groups.push(Group {
            law: if bushing { Law::PointBushing } else { Law::Tsda },
            a: between[0],
            b: between[1],
            triples: centres.len() as u8,
            arms: if bushing { 1 } else { arms.len() as u8 },
            shared: !bushing && centres.len() > 1,
            point: self.points.count as u16,
            element,
            damper,
            clearance: ClearanceIndex::NONE,
        });
        let mut i = 0;
        while i < centres.len() {
            self.points = self.points.push(point(centres[i]));
            i += 1;
        }
        i = 0;
        while i < arms.len() {
            self.points = self.points.push(point(arms[i]));
            i += 1;
        }
        i = 0;
        while i < elements {
            if bushing {
                let bushing = PointBushing { stiffness: spring.stiffness };
                self.bushings = self.bushings.push(bushing);
            } else {
                let Spring { stiffness, free_length, .. } = spring;
                self.tsdas = self.tsdas.push(Tsda { stiffness, free_length });
            }
            if spring.damping > 0.0 {
                self.dampers = self.dampers.push(spring.damping);
            }
            i += 1;
        }
        self
    }

    /// A torsion spring about the unit `axis` (first body's axes) between two bodies whose axes
    /// coincide at t = 0: stiffness \[N·m/rad\], damping \[N·m·s/rad\], preload \[N·m\] on the second.
    ///
    /// # Panics
    /// Where a number is out of range, the axes do not coincide or a list is full.
    #[must_use]
    pub const fn torsion_spring(
        mut self,
        between: [BodyIndex; 2],
        axis: [f64; 3],
        stiffness: f64,
        damping: f64,
        preload: f64,
    ) -> Self {
        assert_unit(dot(axis, axis));
        assert_not_negative(stiffness);
        assert_not_negative(damping);
        assert!(preload.is_finite(), "a preload is not finite");
        let [a, b] = [self.orientation(between[0]), self.orientation(between[1])];
        let apart = [b.v.x - a.v.x, b.v.y - a.v.y, b.v.z - a.v.z];
        let same = b.w == a.w && dot(apart, apart) == 0.0;
        assert!(same, "the initial axes of a torsion spring's bodies differ; use a scene");
        let damper = if damping > 0.0 {
            let first = DamperIndex(self.dampers.count as u16);
            self.dampers = self.dampers.push(damping);
            first
        } else {
            DamperIndex::NONE
        };
        self.torsions = self.torsions.push(TorsionSpring {
            a: between[0],
            b: between[1],
            axis: vector(axis),
            reference: NO_TURN,
            stiffness,
            preload,
            damper,
        });
        self
    }

    /// A force \[N\] and a torque \[N·m\] on a body over \[from, until) \[s\].
    ///
    /// # Panics
    /// Where a number is not finite, the window ends before it begins or the list is full.
    #[must_use]
    pub const fn load(mut self, load: Load<f64>) -> Self {
        let Load { force, torque, .. } = load;
        vector([force.x, force.y, force.z]);
        vector([torque.x, torque.y, torque.z]);
        assert!(load.from.is_finite() && load.from <= load.until, "a load ends before it begins");
        self.loads = self.loads.push(load);
        self
    }

    const fn orientation(&self, body: BodyIndex) -> Quaternion<f64> {
        if body.row() < self.bodies.count {
            self.initial.items[body.row()].orientation
        } else {
            NO_TURN
        }
    }

    /// The numbers of bodies, groups, points, TSDAs, bushings, dampers, torsion springs, gravity, loads, revolute and
    /// universal joints of bushings: sizes of [`Model`](crate::Model), filled in by [`model!`](crate::model!).
    #[must_use]
    pub const fn counts(&self) -> [usize; 11] {
        [
            self.bodies.count,
            self.groups.count,
            self.points.count,
            self.tsdas.count,
            self.bushings.count,
            self.dampers.count,
            self.torsions.count,
            self.gravity.count,
            self.loads.count,
            self.revolutes.count,
            self.universals.count,
        ]
    }
}
