//! A wheel on a plane: contact, a brush tyre, parking without creep.
//!
//! The wheel is a disc of `radius − tread`, thickened by a sphere of the radius `tread`; its lowest point follows from
//! the normal n and the axle a: `−r·(n − (n·a)·a)/|n − (n·a)·a| − tread·n`. Along the normal `N = k·x·(1 + a·ẋ)`, the law of
//! [`super::EndStop`]. Along the plane the spring of [`super::PlaneContact`] is in series with a brush ([`super::brush`]):
//! with the slip s over the rolling speed the force settles at the brush's, `μ·N·(3y − 3y² + y³)`, and a wheel at rest
//! holds its deflection. Distances, not velocities, advance it, so nothing is divided by a speed.

use crate::force_pair::ForcePair;
use crate::geometry::Geometry;
use crate::laws::brush::{Brush, Relaxed};
use crate::laws::contact::{BEYOND, Held, Surface, Touching};
use crate::laws::coordinate::Coordinate;
use crate::laws::end::Seen;
use crate::laws::interaction::{Damper, Interaction, Quantity, Springs, Wrong};
use crate::laws::stop::Stopped;
use crate::laws::tabled::inverse_of_rate;
use crate::real::Real;
use crate::space::{Linear, Moment as _, Space as _, Vector as _};
use crate::words::{WordSource, WordVisitor, Words};

law! {
    /// A wheel of the second body on a plane of the first body, with a brush tyre.
    pub struct WheelContact = "wheel-contact" {
        /// A point of the plane in the first body, the centre of the wheel in the second.
        points: Points,
        /// Normal of the plane, towards the side where the wheel is free.
        normal: Normal,
        /// Axis of the wheel, fixed in the second body. Axis × normal is the direction "along".
        axis: Axle,
        /// Outer radius.
        radius: Number("m"),
        /// Radius of the rounded cross-section of the rim, at most `radius`; 0 is a thin disc.
        tread: Number("m") = 0.0,
        /// Normal force per depth.
        stiffness: Number("N/m"),
        /// Hunt–Crossley coefficient a: the normal force is stiffness · depth · (1 + a · rate of the depth).
        dissipation: Number("s/m") = 0.0,
        /// Coefficient of dry friction: the largest tangential force over the normal force.
        friction: Number,
        /// Longitudinal force per slip at small slip.
        slip_stiffness: Number("N"),
        /// Lateral force per slip, the tangent of the slip angle, at small slip; 0 for `slip_stiffness`.
        cornering_stiffness: Number("N") = 0.0,
        /// Tangential stiffness over `stiffness` of a wheel at rest.
        shear: Number = 0.8,
        /// Damping of the tangential deflection; the tangential force with damping stays within the friction limit.
        damping: Number("N·s/m") = 0.0,
        /// Moment of rolling resistance over the normal force.
        rolling: Number("m") = 0.0,
    }
}

/// The memory of a wheel: the points of contact and the slip of its tread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rolled<V: Linear> {
    /// The points of contact.
    pub held: Held<V>,
    /// \[1\] force over μ·N·y of the brush: 3 without slip, 1 where it slides.
    pub secant: V::Real,
}

impl<V: Linear> Default for Rolled<V> {
    fn default() -> Self {
        Self { held: Held::default(), secant: V::Real::ONE }
    }
}

impl<V: Linear> Words for Rolled<V> {
    fn visit(&self, visitor: &mut impl WordVisitor) {
        self.held.visit(visitor);
        visitor.word(self.secant.word());
    }
    fn fill(&mut self, source: &mut impl WordSource) {
        self.held.fill(source);
        self.secant = V::Real::from_words(source);
    }
}

/// \[1\] half the thickness of the disc's edge over its radius, squared: it is a flat ellipsoid, so that a wheel on its
/// side has a lowest point. At a lean φ this changes the height by `r·FLAT·sin²φ/(2·cos φ)`.
const FLAT: f64 = 1.0 / 65536.0;

/// \[1\] threshold, over the radius: a smaller motion of the point of contact on the wheel is the rounding of a wheel at
/// rest and is not stored, so that the wheel does not creep.
const STANDING: f64 = 1.0 / 65536.0;

/// A wheel at a pose.
struct Met<P: Geometry> {
    touching: Touching<P>,
    /// \[1\] axle × normal, world.
    across: P::Vector,
    /// \[1\] the axle, world.
    axle: P::Moment,
    /// \[m\] from the centre to the plane below the lowest point, world.
    foot: P::Vector,
    /// \[1\] the disc's half height over its radius: the cosine of the lean.
    upright: P::Real,
}

impl<P: Geometry> Met<P> {
    /// Unit direction of rolling, world; 0 for a wheel on its side.
    #[inline(always)]
    fn along(&self) -> P::Vector {
        self.across * self.across.dot(self.across).sqrt().reciprocal_or_zero()
    }

    /// Unit vector along the axle's projection onto the plane, as a moment, world.
    #[inline(always)]
    fn flat_axle(&self) -> P::Moment {
        self.touching.normal.cross(self.along())
    }

    /// \[m/s\] the speed of the point of contact along the tread.
    #[inline(always)]
    fn speed(&self, seen: &Seen<'_, P>) -> P::Real {
        let spin = seen.b.spin() - seen.a.spin();
        let size = self.across.dot(self.across).sqrt().reciprocal_or_zero();
        let rate = self.flat_axle().dot(spin) * size;
        (self.axle.cross(self.foot).dot(self.along()) * rate).abs()
    }

    /// \[m/s\] the velocity at which the tread slips in the patch without extending its spring, world.
    #[inline(always)]
    fn creep(&self, seen: &Seen<'_, P>, brush: &Brush<P::Real>, secant: P::Real) -> P::Vector {
        let (give, along) = (seen.a.to_world(self.touching.give), self.along());
        let first = along * along.dot(give);
        let [x, y] = brush.slip_per_give();
        (first * x + (give - first) * y) * (self.speed(seen) / secant)
    }
}

impl<P: Geometry> WheelContact<P> {
    #[inline(always)]
    fn surface(&self) -> Surface<P::Real> {
        let Self { stiffness, dissipation, friction, shear, damping, rolling, .. } = *self;
        Surface { stiffness, dissipation, friction, shear, damping, rolling }
    }

    #[inline(always)]
    fn brush(&self) -> Brush<P::Real> {
        let (along, across) = (self.slip_stiffness, self.cornering_stiffness);
        let across = P::Real::pick(across.equals(P::Real::ZERO), along, across);
        Brush { slip: [along, across], stiffness: self.surface().shear_stiffness() }
    }

    #[inline(always)]
    fn met(&self, seen: &Seen<'_, P>, memory: &Rolled<P::Vector>) -> Met<P> {
        let ((at_a, arm), (at_b, other)) =
            (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
        let (way, normal) = (P::displacement(&at_a, &at_b), seen.a.to_world(self.normal));
        let axle = seen.b.moment_to_world(self.axis.of_b());
        let across = axle.cross(normal);
        // n − (n·a)·a, and the lowest point of the ellipsoid.
        let (rim, flat) = (-axle.cross(across), P::Real::from_f64(FLAT));
        let rim = rim + (normal - rim) * flat;
        let disc = self.radius - self.tread;
        let upright = rim.dot(normal).sqrt();
        let low = -(rim * (disc / upright) + normal * self.tread);
        let height = normal.dot(way) - (disc * upright + self.tread);
        let travel = Coordinate::carried(height, normal, [arm, way + low, other + low]);
        let range = [P::Real::ZERO, P::Real::from_f64(1e30)];
        let stopped = Stopped::within(travel, range, [self.stiffness, P::Real::ZERO]);
        let (normals, ways) = ([normal, self.normal], [arm, way, other]);
        let held = &memory.held;
        let touching = Touching::new(seen, self.surface(), stopped, normals, ways, held);
        Met { touching, across, axle, foot: low - normal * height, upright }
    }
}

impl<P: Geometry> Interaction<P> for WheelContact<P> {
    type State = Rolled<P::Vector>;
    type Dampers = [(); 3];
    const SLIPS: bool = true;
    const KEEPS: bool = true;
    const QUANTITIES: &'static [Quantity] = &[
        Quantity { name: "depth", unit: "m" },
        Quantity { name: "force", unit: "N" },
        Quantity { name: "friction", unit: "N" },
        Quantity { name: "force_along", unit: "N" },
        Quantity { name: "force_across", unit: "N" },
        Quantity { name: "slip_along", unit: "1" },
        Quantity { name: "slip_across", unit: "1" },
    ];

    #[inline(always)]
    fn settle(&self, seen: &Seen<'_, P>, memory: &mut Rolled<P::Vector>) {
        if !self.surface().is_rough() {
            return self.keep_pose(seen, memory);
        }
        let met = self.met(seen, memory);
        let touching = &met.touching;
        if touching.stopped.beyond == P::Real::ZERO {
            *memory = Rolled::default();
            memory.held.apart = true;
            return;
        }
        memory.held.apart = false;
        let held = memory.held;
        let (arm, along) = (seen.b.to_axes(met.foot), met.along());
        let moved = arm - held.arm;
        let least = self.radius * P::Real::from_f64(STANDING);
        let moves = !held.touched || least * least < moved.dot(moved);
        let mut rolled = P::Real::ZERO;
        if held.touched && moves {
            rolled = moved.dot(seen.b.to_axes(along)).abs();
        }
        let limits = [touching.limit(seen), P::Real::from_f64(BEYOND)];
        let along = seen.a.to_axes(along);
        let Relaxed { give, secant, slides } =
            self.brush().relaxed(touching.give, along, rolled, limits);
        if slides || moves {
            *memory = Rolled { held: touching.hold(seen, arm, give), secant };
        }
    }

    #[inline(always)]
    fn keep_pose(&self, seen: &Seen<'_, P>, memory: &mut Rolled<P::Vector>) {
        memory.held.apart = self.met(seen, memory).touching.stopped.beyond == P::Real::ZERO;
    }

    #[inline(always)]
    fn is_idle(&self, memory: &Rolled<P::Vector>) -> bool {
        memory.held.apart
    }

    #[inline(always)]
    fn force_pair(
        &self,
        seen: &Seen<'_, P>,
        memory: &Rolled<P::Vector>,
    ) -> Option<ForcePair<P::Space>> {
        Some(self.met(seen, memory).touching.force_pair(seen))
    }

    fn energy(&self, seen: &Seen<'_, P>, memory: &Rolled<P::Vector>) -> P::Real {
        self.met(seen, memory).touching.energy()
    }

    fn tangent(
        &self,
        seen: &Seen<'_, P>,
        memory: &Rolled<P::Vector>,
        visit: Springs<'_, P>,
    ) -> [P::Real; 2] {
        let Met { touching, upright, .. } = self.met(seen, memory);
        let stopped = &touching.stopped;
        visit(self.stiffness, &stopped.coordinate.direction(seen));
        let force = (self.stiffness * stopped.beyond).abs();
        let centre = Coordinate::<P>::carried(P::Real::ZERO, touching.normal, touching.ways);
        let mut stop = centre.bent(seen, force, visit);
        if !P::Space::PLANAR {
            // The second derivative of the height by the lean is at most 2·r over the cosine of the lean.
            let lean = P::Real::TWO * (self.radius - self.tread) / upright;
            stop = stop.map(|bent| bent + force * lean);
        }
        touching.tangent(seen, stop, visit)
    }

    #[inline(always)]
    fn is_damped(&self) -> bool {
        self.surface().is_damped()
    }

    #[inline(always)]
    fn dampers(
        &self,
        seen: &Seen<'_, P>,
        memory: &Rolled<P::Vector>,
        visit: &mut impl FnMut(Damper<P>),
    ) {
        let surface = self.surface();
        if !surface.is_damped() {
            return (0..3).for_each(|_| visit(Damper::idle()));
        }
        let met = self.met(seen, memory);
        let mut creep = P::Vector::ZERO;
        if surface.shears() {
            creep = met.creep(seen, &self.brush(), memory.secant);
        }
        met.touching.dampers(seen, Some((creep, met.flat_axle())), visit);
    }

    fn turn(memory: &mut Rolled<P::Vector>, turn: &mut dyn FnMut(usize, [f64; 3]) -> [f64; 3]) {
        memory.held.turn(turn);
    }

    fn check(&self) -> Result<(), Wrong> {
        let (zero, least) = (P::Real::ZERO, "a number ≥ 0");
        let holds = self.radius > zero;
        Wrong::unless(holds, "radius", "is not positive", "a number > 0")?;
        let holds = self.tread >= zero && self.tread <= self.radius;
        Wrong::unless(holds, "tread", "is not within the radius", "between 0 and `radius`")?;
        self.surface().check()?;
        let holds = self.slip_stiffness > zero;
        Wrong::unless(holds, "slip_stiffness", "is not positive", "a stiffness > 0")?;
        let holds = self.cornering_stiffness >= zero;
        Wrong::unless(holds, "cornering_stiffness", "is negative", least)
    }

    fn read(&self, quantity: usize, seen: &Seen<'_, P>, memory: &Rolled<P::Vector>) -> P::Real {
        let met = self.met(seen, memory);
        let (touching, along) = (&met.touching, met.along());
        let across = touching.normal.across(along);
        let force = seen.a.to_world(touching.give) * -touching.surface.shear_stiffness();
        let slip = |way: P::Vector| {
            let inverse = inverse_of_rate(met.speed(seen));
            let is_free = touching.stopped.beyond == P::Real::ZERO;
            if is_free { P::Real::ZERO } else { way.dot(touching.slip(seen)) * inverse }
        };
        match quantity {
            0 => touching.stopped.depth(),
            1 => touching.pressed(seen),
            2 => touching.rubbed(),
            3 => force.dot(along),
            4 => force.dot(across),
            5 => slip(along),
            _ => slip(across),
        }
    }
}
