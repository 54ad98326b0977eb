//! Laws that a crate registers at link time with [`laws!`](crate::laws!), before the first scene is read.

use dbd_kernel::laws::Law;

use crate::laws::known::KnownLaw;

/// One entry of [`laws!`](crate::laws!).
#[doc(hidden)]
pub struct LinkedLaw {
    path: &'static str,
    known: fn(&str) -> KnownLaw,
}

inventory::collect!(LinkedLaw);

impl LinkedLaw {
    #[must_use]
    pub const fn new<L: Law>(path: &'static str) -> Self {
        Self { path, known: KnownLaw::of::<L> }
    }
}

/// Registers laws for every scene that the program or library reads.
///
/// Call it once, outside of functions, in the crate that becomes the program or the dynamic library (FMU, Python
/// module). Each law is a type declared with [`dbd_kernel::law!`], given by its path as seen from other crates, because
/// exported source uses this path. A law with the name of a shipped law replaces it;
/// [`register`](crate::laws::register) replaces both.
///
/// ```
/// # mod my_laws { pub use dbd_kernel::laws::{EndStop as Buffer, HingeStop as Latch}; }
/// dbd_scene::laws! { my_laws::Buffer, my_laws::Latch }
/// # fn main() {
/// assert!(dbd_scene::laws::known_laws().iter().any(|law| law.path == "my_laws::Buffer"));
/// # }
/// ```
#[macro_export]
macro_rules! laws {
    ($($law:ty),+ $(,)?) => {
        $($crate::laws::submit! { $crate::laws::LinkedLaw::new::<$law>(stringify!($law)) })+
    };
}

/// All linked laws, sorted by name because the linker's order is arbitrary.
pub(super) fn linked_laws() -> Vec<KnownLaw> {
    let mut laws: Vec<_> =
        inventory::iter::<LinkedLaw>().map(|linked| (linked.known)(linked.path)).collect();
    laws.sort_by(|one, other| (one.name, &one.path).cmp(&(other.name, &other.path)));
    laws
}

#[cfg(test)]
mod tests {
    use dbd_kernel::{BodyIndex, Vec3};

    use crate::laws::{Poses, hold, known_laws};

    mod my_laws {
        use dbd_kernel::Geometry;
        use dbd_kernel::Real as _;
        use dbd_kernel::laws::{
            Damper, Direction, ForcePair, Interaction, NoStorage, Seen, Springs,
        };

        dbd_kernel::law! {
            /// A damper along the first body's normal.
            pub struct Brush = "linked-brush" {
                /// Where it acts.
                points: Points,
                /// Along which it acts.
                normal: Normal,
                /// Force per rate.
                damping: Number("N*s/m"),
            }
        }

        impl<P: Geometry> Brush<P> {
            fn direction(&self, seen: &Seen<'_, P>) -> Direction<P::Space> {
                let ((at_a, arm_a), (at_b, arm_b)) =
                    (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
                let arm_a = seen.a.arm_at(arm_a, P::displacement(&at_a, &at_b));
                seen.along(seen.a.to_world(self.normal), [arm_a, arm_b])
            }
        }

        impl<P: Geometry> Interaction<P> for Brush<P> {
            type State = NoStorage;
            type Dampers = [(); 1];

            fn force_pair(&self, seen: &Seen<'_, P>, _: &NoStorage) -> Option<ForcePair<P::Space>> {
                Some(seen.pull(&self.direction(seen), P::Real::ZERO))
            }
            fn energy(&self, _: &Seen<'_, P>, _: &NoStorage) -> P::Real {
                P::Real::ZERO
            }
            fn tangent(&self, _: &Seen<'_, P>, _: &NoStorage, _: Springs<'_, P>) -> [P::Real; 2] {
                [P::Real::ZERO; 2]
            }
            fn dampers(
                &self,
                seen: &Seen<'_, P>,
                _: &NoStorage,
                visit: &mut impl FnMut(Damper<P>),
            ) {
                visit(Damper::new(self.damping, self.direction(seen)));
            }
        }
    }

    crate::laws! { my_laws::Brush }

    #[test]
    fn scenes_name_a_linked_law() {
        let known = known_laws();
        let law = known.iter().find(|law| law.name == "linked-brush").unwrap();
        assert_eq!((law.path.as_str(), law.fields.len()), ("my_laws::Brush", 3));
        let scene = r#"
            name = "brush"
            duration = 1.0
            step = "1 ms"
            [[body]]
            name = "weight"
            mass = 2.0
            inertia = [0.01, 0.01, 0.01]
            position = [0, 0, 0]
            [[interaction]]
            law = "linked-brush"
            between = ["world", "weight"]
            points = [[0, 0, 0], [0, 0, 0]]
            normal = [1, 0, 0]
            damping = 3.0
        "#;
        crate::Scene::parse(scene, "brush.toml").unwrap();
    }

    #[test]
    fn a_law_of_dampers_alone_is_held() {
        let bodies = [BodyIndex(0), BodyIndex(1)];
        let points = [Vec3::new(0.02, 0.0, 0.01), Vec3::new(0.0, -0.03, 0.02)];
        let brush =
            |damping| my_laws::Brush { bodies, points, normal: Vec3::new(0.0, 0.6, 0.8), damping };
        hold(&brush(3.0), Poses::default()).unwrap();
        assert!(hold(&brush(0.0), Poses::default()).is_err());
    }
}
