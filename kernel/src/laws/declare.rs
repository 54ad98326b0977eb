//! The macro that declares a law's constants.

/// Declares the constants of a law: a struct over a precision, with everything that can be derived from them. The law
/// itself is its [`Interaction`](crate::laws::Interaction), written by hand.
///
/// Each constant has a name, a kind of [`crate::laws`] and its units, a number optionally a default (`= 0.0`); its
/// documentation is used in the scene reference and in messages, so it must not be empty. The struct also has
/// `bodies: [BodyIndex; 2]`.
///
/// ```
/// use dbd_kernel::laws::{Interaction, NoStorage, ForcePair, Seen};
/// use dbd_kernel::{Geometry, Real};
///
/// dbd_kernel::law! {
///     /// A spring of zero length.
///     pub struct Rubber = "rubber" {
///         /// Where it is fixed.
///         points: Points,
///         /// Force per length.
///         stiffness: Number("N/m"),
///     }
/// }
///
/// impl<P: Geometry> Interaction<P> for Rubber<P> {
///     type State = NoStorage;
///     type Dampers = [(); 0];
///
///     fn force_pair(&self, seen: &Seen<'_, P>, _: &NoStorage) -> Option<ForcePair<P::Space>> {
///         let (a, b) = (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
///         // Not along a unit vector: the displacement itself, force over stiffness.
///         let way = P::displacement(&a.0, &b.0);
///         Some(seen.pull(&seen.along(way, [a.1, b.1]), self.stiffness))
///     }
///     fn energy(&self, seen: &Seen<'_, P>, _: &NoStorage) -> P::Real {
///         use dbd_kernel::space::Linear as _;
///         let (a, b) = (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
///         let way = P::displacement(&a.0, &b.0);
///         P::Real::HALF * self.stiffness * way.dot(way)
///     }
///     fn tangent(
///         &self,
///         seen: &Seen<'_, P>,
///         _: &NoStorage,
///         visit: dbd_kernel::laws::Springs<'_, P>,
///     ) -> [P::Real; 2] {
///         use dbd_kernel::space::Linear as _;
///         let (a, b) = (seen.a.place(&self.points[0]), seen.b.place(&self.points[1]));
///         for axis in P::Vector::axes() {
///             visit(self.stiffness, &seen.along(axis, [a.1, b.1]));
///         }
///         let way = P::displacement(&a.0, &b.0);
///         let force = self.stiffness * way.dot(way).sqrt();
///         [a.1, b.1].map(|arm| force * arm.dot(arm).sqrt())
///     }
/// }
/// ```
#[macro_export]
macro_rules! law {
    (
        $(#[doc = $about:literal])+
        $visible:vis struct $name:ident = $called:literal {
            $(
                $(#[doc = $doc:literal])+
                $field:ident: $kind:ident $(<$size:literal>)? $(($($unit:literal),+))? $(= $default:literal)?
            ),* $(,)?
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Clone, Copy, Debug, PartialEq)]
        $visible struct $name<P: $crate::Geometry = $crate::F64> {
            /// A, which may be the ground, and B, a body.
            pub bodies: [$crate::BodyIndex; 2],
            $(
                $(#[doc = $doc])+
                pub $field: <$crate::laws::$kind $(<$size>)? as $crate::laws::Kind>::In<P>,
            )*
        }

        impl<P: $crate::Geometry> $crate::laws::Constants<P> for $name<P> {
            const NAME: &'static str = $called;

            #[inline(always)]
            fn bodies(&self) -> [$crate::BodyIndex; 2] {
                self.bodies
            }

            fn visit(&self, visitor: &mut dyn $crate::words::WordVisitor) {
                let [a, b] = self.bodies;
                visitor.word($crate::words::Word::U64(u64::from(a.0) << 16 | u64::from(b.0)));
                $(
                    <$crate::laws::$kind $(<$size>)? as $crate::laws::Kind>::visit::<P>(
                        &self.$field,
                        visitor,
                    );
                )*
            }
        }

        impl $crate::laws::Law for $name<$crate::F64> {
            type In<P: $crate::Geometry> = $name<P>;

            const ABOUT: &'static str = concat!($($about),+).trim_ascii();
            const PATH: &'static str = concat!(module_path!(), "::", stringify!($name));
            const PACKAGE: [&'static str; 2] =
                [env!("CARGO_PKG_NAME"), env!("CARGO_MANIFEST_DIR")];
            const FIELDS: &'static [$crate::laws::Field] = &[$(
                $crate::laws::Field {
                    name: stringify!($field),
                    kind: <$crate::laws::$kind $(<$size>)? as $crate::laws::Kind>::NAME,
                    units: &[$($($unit),+)?],
                    default: $crate::laws::first(&[$($default)?]),
                    about: concat!($($doc),+).trim_ascii(),
                },
            )*];

            fn rounded<P: $crate::Geometry>(&self) -> $name<P> {
                $name {
                    bodies: self.bodies,
                    $(
                        $field: <$crate::laws::$kind $(<$size>)? as $crate::laws::Kind>::rounded::<P>(
                            &self.$field,
                        ),
                    )*
                }
            }

            fn read_from(
                bodies: [$crate::BodyIndex; 2],
                source: &mut dyn $crate::laws::FieldSource,
            ) -> Option<Self> {
                let mut fields = <Self as $crate::laws::Law>::FIELDS.iter();
                Some($name {
                    bodies,
                    $(
                        $field: <$crate::laws::$kind $(<$size>)? as $crate::laws::Kind>::read_from(
                            fields.next()?,
                            source,
                        )?,
                    )*
                })
            }

            fn write_to(&self, sink: &mut dyn $crate::laws::FieldSink) {
                let mut fields = <Self as $crate::laws::Law>::FIELDS.iter();
                $(
                    if let Some(field) = fields.next() {
                        <$crate::laws::$kind $(<$size>)? as $crate::laws::Kind>::write_to(
                            &self.$field,
                            field,
                            sink,
                        );
                    }
                )*
            }
        }
    };
}
