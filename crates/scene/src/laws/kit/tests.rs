use super::*;
use dbd_kernel::laws::{self, Damper, EndStop, Hinge, Springs};
use dbd_kernel::space::Linear as _;
use dbd_kernel::{BodyIndex, Real as _};

pub(super) const BODIES: [BodyIndex; 2] = [BodyIndex(0), BodyIndex(1)];
pub(super) const POINTS: [Vec3<f64>; 2] = [Vec3::new(0.02, 0.0, 0.01), Vec3::new(0.0, -0.03, 0.02)];
pub(super) const AXIS: Vec3<f64> = Vec3::new(0.0, 0.6, 0.8);
pub(super) const HINGE: Hinge<f64> =
    Hinge { axis: Vec3::new(0.6, 0.0, 0.8), reference: Quaternion::IDENTITY };

/// A law with the constants and motions that it is tested with.
pub(super) trait Cases: Law {
    fn cases() -> Vec<(Self, Poses)>;
}

/// Cases whose motion is the default one.
pub(super) fn by_default<L: Law>(laws: impl IntoIterator<Item = L>) -> Vec<(L, Poses)> {
    laws.into_iter().map(|law| (law, Poses::default())).collect()
}

#[test]
fn the_projects_laws_keep_what_laws_promise() {
    macro_rules! holds {
        // Between more than two bodies: `tests/elements/couplings.rs`.
        (Coupling) => {};
        // Their force is 0, or what their memory has of the commands before.
        (HingeSensor) => {};
        (SlideSensor) => {};
        (HingeActuator) => {};
        (SlideActuator) => {};
        ($law:ident) => {
            let cases = laws::$law::cases();
            assert!(!cases.is_empty(), "{}", stringify!($law));
            for (number, (law, poses)) in cases.iter().enumerate() {
                law.check().unwrap();
                let name = stringify!($law);
                hold(law, *poses).unwrap_or_else(|why| panic!("case {number} of {name}: {why}"));
            }
        };
    }
    macro_rules! all {
        ($($law:ident),+ $(,)?) => { $(holds!($law);)+ };
    }
    dbd_kernel::each_law!(all);
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
    let points = POINTS;
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
    let [(stop, _), ..] = &EndStop::cases()[..] else { panic!() };
    let away = EndStop { points: [Vec3::ZERO, Vec3::new(0.0, 1.0, 1.0)], ..*stop };
    let near = Poses { reach: 1e-9, turn: 1e-9, ..Poses::default() };
    assert!(hold(&away, near).unwrap_err().contains("no effect at any pose"));
}
