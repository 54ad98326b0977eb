use super::*;
use dbd_kernel::laws::{
    Curve, Damper, DistanceDamper, DistanceSpring, DistanceStop, DistanceWinch, EndStop, Hinge,
    HingeDamper, HingeFriction, HingeSpring, HingeStop, PlaneContact, SlideFriction,
    SoftDistanceStop, SoftEndStop, SoftHingeStop, SphereContact, Springs, WheelContact,
};
use dbd_kernel::space::Linear as _;
use dbd_kernel::{BodyIndex, InputIndex, Real as _};

pub(super) const BODIES: [BodyIndex; 2] = [BodyIndex(0), BodyIndex(1)];

pub(super) fn hinge() -> Hinge<f64> {
    Hinge { axis: Vec3::new(0.6, 0.0, 0.8), reference: Quaternion::IDENTITY }
}

pub(super) fn end_stop(dissipation: f64) -> EndStop {
    EndStop {
        bodies: BODIES,
        points: [Vec3::new(0.02, 0.0, 0.01), Vec3::new(0.0, -0.03, 0.02)],
        normal: Vec3::new(0.0, 0.6, 0.8),
        from: 0.0,
        to: 1e30,
        stiffness: 1e5,
        dissipation,
    }
}

#[test]
fn the_projects_laws_keep_what_laws_promise() {
    let poses = Poses::default();
    let plane = end_stop(0.5);
    hold(&plane, poses).unwrap();
    hold(&EndStop { from: -0.01, to: 0.01, ..plane }, poses).unwrap();
    let points = plane.points;
    for (from, to) in [(0.0, 0.03), (0.06, 1e30), (0.03, 0.05)] {
        let stop =
            DistanceStop { bodies: BODIES, points, from, to, stiffness: 1e5, dissipation: 0.5 };
        hold(&stop, poses).unwrap();
    }
    let soft = 0.02;
    let EndStop { bodies, normal, stiffness, dissipation, .. } = plane;
    for (from, to) in [(0.0, 1e30), (-0.01, 0.01)] {
        let stop = SoftEndStop { bodies, points, normal, from, to, stiffness, soft, dissipation };
        hold(&stop, poses).unwrap();
    }
    for (from, to) in [(0.0, 0.03), (0.06, 1e30), (0.03, 0.05)] {
        let stop = SoftDistanceStop { bodies, points, from, to, stiffness, soft, dissipation };
        hold(&stop, poses).unwrap();
    }
    let (axis, [from, to]) = (hinge(), [-0.3, 0.2]);
    let stop = SoftHingeStop { bodies, axis, from, to, stiffness, soft: 0.3, dissipation };
    hold(&stop, poses).unwrap();
    let friction = SlideFriction {
        bodies: BODIES,
        points,
        axis: plane.normal,
        coulomb: 4.0,
        breakaway: 5.0,
        stribeck: 0.01,
        give: 1e-4,
        damping: 0.1,
        viscous: 0.2,
    };
    hold(&friction, poses).unwrap();
    let (from, to) = (-0.3, 0.2);
    let stop =
        HingeStop { bodies: BODIES, axis: hinge(), from, to, stiffness: 2e3, dissipation: 0.4 };
    hold(&stop, poses).unwrap();
    let friction = HingeFriction {
        bodies: BODIES,
        axis: hinge(),
        coulomb: 4.0,
        breakaway: 5.0,
        stribeck: 0.05,
        give: 1e-3,
        damping: 0.1,
        viscous: 0.2,
    };
    hold(&friction, poses).unwrap();
}

/// A table with separate slopes on both sides of each knot.
fn table() -> Curve<f64, 16> {
    let mut knots = [[0.0; 2]; 16];
    knots[..4].copy_from_slice(&[[-0.5, -80.0], [-0.05, -30.0], [0.0, 0.0], [0.03, 90.0]]);
    Curve { knots, count: 4 }
}

#[test]
fn tables_keep_what_laws_promise() {
    let (poses, points) = (Poses::default(), end_stop(0.0).points);
    let spring = DistanceSpring { bodies: BODIES, points, free_length: 0.06, force: table() };
    hold(&spring, poses).unwrap();
    hold(&DistanceDamper { bodies: BODIES, points, force: table() }, poses).unwrap();
    let rope = DistanceWinch {
        bodies: BODIES,
        points,
        input: InputIndex(0),
        stiffness: 1e5,
        damping: 50.0,
        pulls: 1.0,
        pushes: 0.0,
    };
    for (pulls, pushes) in [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
        let rope = DistanceWinch { pulls, pushes, ..rope };
        hold(&rope, Poses { input: 0.06, ..poses }).unwrap();
    }
    hold(&HingeSpring { bodies: BODIES, axis: hinge(), torque: table() }, poses).unwrap();
    hold(&HingeDamper { bodies: BODIES, axis: hinge(), torque: table() }, poses).unwrap();
}

#[test]
fn a_contact_keeps_what_laws_promise() {
    let EndStop { bodies, points, normal, .. } = end_stop(0.0);
    let contact = PlaneContact {
        bodies,
        points,
        normal,
        radius: 0.02,
        stiffness: 1e5,
        dissipation: 0.5,
        friction: 0.4,
        shear: 0.8,
        damping: 20.0,
        rolling: 1e-3,
    };
    hold(&contact, Poses::default()).unwrap();
    hold(&PlaneContact { radius: 0.0, friction: 0.0, ..contact }, Poses::default()).unwrap();
}

#[test]
fn spheres_keep_what_laws_promise() {
    let EndStop { bodies, points, .. } = end_stop(0.0);
    let contact = SphereContact {
        bodies,
        points,
        first_radius: 0.05,
        second_radius: 0.03,
        stiffness: 1e5,
        dissipation: 0.5,
        friction: 0.4,
        shear: 0.8,
        damping: 20.0,
        rolling: 1e-3,
    };
    hold(&contact, Poses::default()).unwrap();
    hold(&SphereContact { first_radius: 0.0, ..contact }, Poses::default()).unwrap();
    hold(&SphereContact { friction: 0.0, ..contact }, Poses::default()).unwrap();
}

#[test]
fn a_wheel_keeps_what_laws_promise() {
    let EndStop { bodies, points, normal, .. } = end_stop(0.0);
    let wheel = WheelContact {
        bodies,
        points,
        normal,
        axis: hinge(),
        radius: 0.06,
        tread: 0.01,
        stiffness: 1e5,
        dissipation: 0.5,
        friction: 0.4,
        slip_stiffness: 2e3,
        cornering_stiffness: 1.5e3,
        shear: 0.8,
        damping: 20.0,
        rolling: 1e-3,
    };
    hold(&wheel, Poses::default()).unwrap();
    hold(&WheelContact { tread: 0.0, ..wheel }, Poses::default()).unwrap();
    hold(&WheelContact { tread: 0.06, cornering_stiffness: 0.0, ..wheel }, Poses::default())
        .unwrap();
    let axis = Hinge { axis: normal, ..hinge() };
    let lies = WheelContact { axis, friction: 0.0, ..wheel };
    hold(&lies, Poses { turn: 0.05, ..Poses::default() }).unwrap();
    hold(&lies, Poses { turn: 3.0, ..Poses::default() }).unwrap();
}

/// Counts the calls of settle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settled(i32);

impl dbd_kernel::words::Words for Settled {
    fn visit(&self, visitor: &mut impl dbd_kernel::words::WordVisitor) {
        visitor.word(dbd_kernel::words::Word::I32(self.0));
    }
    fn fill(&mut self, source: &mut impl dbd_kernel::words::WordSource) {
        self.0 = source.take(4) as i32;
    }
}

/// A law that breaks a rule; the second one also promises what [`Interaction::TURNS`] and
/// [`Interaction::ADVANCE_SETTLES`] state.
macro_rules! broken {
    ($law:ident, $name:literal, $turns:literal) => {
        dbd_kernel::law! {
            /// A spring of zero length that breaks a rule.
            pub struct $law = $name {
                /// Where it is fixed.
                points: Points,
                /// Which rule.
                rule: Count,
            }
        }

        impl<P: dbd_kernel::Geometry> Interaction<P> for $law<P> {
            type State = Settled;
            type Dampers = [(); 1];
            const TURNS: bool = $turns;
            const ADVANCE_SETTLES: bool = $turns;

            fn advance(&self, _: &Seen<'_, P>, _: P::Real, state: &mut Settled) {
                state.0 = 0;
            }
            fn settle(&self, _: &Seen<'_, P>, state: &mut Settled) {
                state.0 += i32::from(self.rule == 1);
                state.0 |= i32::from(self.rule == 8 || self.rule == 9);
            }
            fn force_pair(&self, seen: &Seen<'_, P>, _: &Settled) -> Option<ForcePair<P::Space>> {
                let (a, b) = (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
                let way = P::displacement(&a.0, &b.0);
                let arms = if self.rule == 2 { [b.1, b.1] } else { [a.1, b.1] };
                Some(seen.pull(&seen.along(way, arms), P::Real::ONE))
            }
            fn energy(&self, seen: &Seen<'_, P>, state: &Settled) -> P::Real {
                let (a, b) = (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
                let way = P::displacement(&a.0, &b.0);
                let held =
                    if self.rule == 8 && state.0 == 0 { P::Real::ONE } else { P::Real::ZERO };
                if self.rule == 3 { way.dot(way) } else { P::Real::HALF * way.dot(way) + held }
            }
            fn tangent(
                &self,
                seen: &Seen<'_, P>,
                _: &Settled,
                visit: Springs<'_, P>,
            ) -> [P::Real; 2] {
                let (a, b) = (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
                let way = P::displacement(&a.0, &b.0);
                if self.rule == 4 {
                    return [P::Real::ZERO; 2];
                }
                for axis in P::Vector::axes() {
                    visit(P::Real::ONE, &seen.along(axis, [a.1, b.1]));
                }
                [a.1, b.1].map(|arm| (way.dot(way) * arm.dot(arm)).sqrt())
            }
            fn dampers(&self, seen: &Seen<'_, P>, _: &Settled, visit: &mut impl FnMut(Damper<P>)) {
                let (a, b) = (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
                let arms = if self.rule == 7 { [a.1, a.1] } else { [a.1, b.1] };
                let direction = seen.along(P::displacement(&a.0, &b.0), arms);
                let c = if self.rule == 5 { -P::Real::ONE } else { P::Real::ONE };
                visit(Damper::new(c, direction));
                if self.rule == 6 {
                    visit(Damper::new(c, direction));
                }
            }
        }
    };
}

broken!(Broken, "broken", false);
broken!(Promising, "promising", true);

#[test]
fn a_law_that_breaks_a_rule_is_told_which() {
    let points = [Vec3::new(0.02, 0.0, 0.01), Vec3::new(0.0, -0.03, 0.02)];
    let broken = |rule| hold(&Broken { bodies: BODIES, points, rule }, Poses::default());
    broken(0).unwrap();
    for (rule, says) in [
        (1, "not idempotent"),
        (2, "angular momentum is not conserved"),
        (3, "not minus the energy gradient"),
        (4, "the tangent is too small"),
        (5, "a damper supplies"),
        (6, "more than it declares"),
        (7, "damper 1: angular momentum"),
        (8, "such a law must set SLIPS"),
    ] {
        let why = broken(rule).unwrap_err();
        assert!(why.contains(says), "{rule}: {why}");
    }
    let promising = |rule| hold(&Promising { bodies: BODIES, points, rule }, Poses::default());
    assert!(promising(0).unwrap_err().contains("the law sets TURNS"));
    assert!(promising(9).unwrap_err().contains("advancing does not settle"));
    let away = EndStop { points: [Vec3::ZERO, Vec3::new(0.0, 1.0, 1.0)], ..end_stop(0.0) };
    let near = Poses { reach: 1e-9, turn: 1e-9, ..Poses::default() };
    assert!(hold(&away, near).unwrap_err().contains("no effect at any pose"));
}
