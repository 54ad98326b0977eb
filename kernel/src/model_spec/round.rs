//! From a sketch to a model: counted, rounded once, checked.

use crate::body::{Body, BodyState};
use crate::elements::load::Load;
use crate::elements::point_bushing::PointBushing;
use crate::elements::revolute::Revolute;
use crate::elements::torsion_spring::TorsionSpring;
use crate::elements::tsda::Tsda;
use crate::elements::universal::Universal;
use crate::fixed::{Fixed, FixedPlace, FixedPoint, FixedTurn, FixedVelocity};
use crate::geometry::{F32, F64};
use crate::model::Model;
use crate::model_spec::ModelSpec;
use crate::planar::{Planar32, Planar64};
use crate::plane::{Axial, Heading, Vec2};
use crate::vector::{Quaternion, Vec3};

/// The first items, as many as in the model, each rounded.
macro_rules! rounded {
    ($list:expr, $count:ident, $item:ident => $round:expr) => {{
        let list = &$list;
        assert!(list.count == $count, "the sizes of the model and the sketch differ");
        let $item = &list.items[0];
        let mut all = [$round; $count];
        let mut i = 0;
        while i < all.len() {
            let $item = &list.items[i];
            all[i] = $round;
            i += 1;
        }
        all
    }};
}

/// Rounding functions for a precision's vectors, moments, inertias and rotations.
macro_rules! roundings {
    ($($real:ident: $vector:ident, $quaternion:ident, $flat:ident, $axial:ident, $about:ident,
        $heading:ident;)*) => {
        $(
            const fn $vector(v: &Vec3<f64>) -> Vec3<$real> {
                Vec3::new(v.x as $real, v.y as $real, v.z as $real)
            }

            const fn $quaternion(q: &Quaternion<f64>) -> Quaternion<$real> {
                Quaternion { w: q.w as $real, v: $vector(&q.v) }
            }

            const fn $flat(v: &Vec3<f64>) -> Vec2<$real> {
                assert!(v.z == 0.0, "a point or a vector is not in the plane z = 0");
                Vec2::new(v.x as $real, v.y as $real)
            }

            const fn $axial(m: &Vec3<f64>) -> Axial<$real> {
                assert!(m.x == 0.0 && m.y == 0.0, "a rotation or a torque is not about z");
                $about(m)
            }

            const fn $about(m: &Vec3<f64>) -> Axial<$real> {
                Axial::new(m.z as $real)
            }

            const fn $heading(q: &Quaternion<f64>) -> Heading<$real> {
                assert!(q.v.x == 0.0 && q.v.y == 0.0, "an orientation is not about z");
                Heading::new(q.w as $real, q.v.z as $real)
            }
        )*
    };
}

roundings! {
    f64: vector_f64, quaternion_f64, flat_f64, axial_f64, about_f64, heading_f64;
    f32: vector_f32, quaternion_f32, flat_f32, axial_f32, about_f32, heading_f32;
}

const fn place(v: &Vec3<f64>) -> FixedPlace {
    FixedPlace::new([v.x, v.y, v.z])
}

const fn turn(q: &Quaternion<f64>) -> FixedTurn {
    FixedTurn::new([q.w, q.v.x, q.v.y, q.v.z])
}

const fn fixed_velocity(v: &Vec3<f64>) -> FixedVelocity {
    FixedVelocity::from_f64([v.x, v.y, v.z])
}

const fn point(v: &Vec3<f64>) -> FixedPoint {
    FixedPoint::new([v.x, v.y, v.z])
}

/// The model of a sketch in one precision.
macro_rules! models {
    ($($function:ident: $precision:ty, $real:ty, $vector:ident, $moment:ident, $inertia:ident,
        $quaternion:ident,
        stored $position:ident $turn:ident $velocity:ident $spin:ident $point:ident;)*) => {
        impl ModelSpec {
            $(
                /// The model in this precision; its sizes are [`ModelSpec::counts`].
                ///
                /// # Panics
                /// Where an element refers to a body that does not exist; see [`Model::checked`]. In the plane, where a
                /// part is not in it.
                #[must_use]
                pub const fn $function<
                    const BODIES: usize,
                    const GROUPS: usize,
                    const POINTS: usize,
                    const TSDAS: usize,
                    const BUSHINGS: usize,
                    const DAMPERS: usize,
                    const TORSIONS: usize,
                    const GRAVITY: usize,
                    const LOADS: usize,
                    const REVOLUTES: usize,
                    const UNIVERSALS: usize,
                    const SUMS: usize,
                >(
                    &self,
                ) -> Model<
                    $precision,
                    BODIES,
                    GROUPS,
                    POINTS,
                    TSDAS,
                    BUSHINGS,
                    DAMPERS,
                    TORSIONS,
                    GRAVITY,
                    LOADS,
                    0,
                    0,
                    0,
                    0,
                    REVOLUTES,
                    UNIVERSALS,
                    SUMS,
                > {
                    Model {
                        bodies: rounded!(self.bodies, BODIES, b => Body {
                            mass: b.mass as $real,
                            inertia: $inertia(&b.inertia),
                            inverse_mass: b.inverse_mass as $real,
                            inverse_inertia: $inertia(&b.inverse_inertia),
                            ratio: $inertia(&b.ratio),
                            inverse_ratio: $inertia(&b.inverse_ratio),
                        }),
                        initial: rounded!(self.initial, BODIES, s => BodyState {
                            position: $position(&s.position),
                            orientation: $turn(&s.orientation),
                            velocity: $velocity(&s.velocity),
                            angular_velocity: $spin(&s.angular_velocity),
                        }),
                        gravity: rounded!(self.gravity, GRAVITY, g => $vector(g)),
                        groups: rounded!(self.groups, GROUPS, g => *g),
                        points: rounded!(self.points, POINTS, p => $point(p)),
                        tsdas: rounded!(self.tsdas, TSDAS, t => Tsda {
                            stiffness: t.stiffness as $real,
                            free_length: t.free_length as $real,
                        }),
                        bushings: rounded!(self.bushings, BUSHINGS, b => PointBushing {
                            stiffness: b.stiffness as $real,
                        }),
                        dampers: rounded!(self.dampers, DAMPERS, c => *c as $real),
                        torsions: rounded!(self.torsions, TORSIONS, t => TorsionSpring {
                            a: t.a,
                            b: t.b,
                            axis: $moment(&t.axis),
                            reference: $quaternion(&t.reference),
                            stiffness: t.stiffness as $real,
                            preload: t.preload as $real,
                            damper: t.damper,
                        }),
                        loads: rounded!(self.loads, LOADS, l => Load {
                            body: l.body,
                            frame: l.frame,
                            force: $vector(&l.force),
                            torque: $moment(&l.torque),
                            from: l.from,
                            until: l.until,
                        }),
                        lines: [],
                        inputs: [],
                        knots: [],
                        clearances: [],
                        revolutes: rounded!(self.revolutes, REVOLUTES, r => Revolute {
                            stiffness: r.stiffness as $real,
                            along: r.along as $real,
                            levers: [$vector(&r.levers[0]), $vector(&r.levers[1])],
                        }),
                        universals: rounded!(self.universals, UNIVERSALS, u => Universal {
                            stiffness: u.stiffness as $real,
                            lever: $vector(&u.lever),
                            axis: $vector(&u.axis),
                        }),
                        sources: [],
                        laws: (),
                    }
                    .checked()
                }
            )*
        }
    };
}

models! {
    model_f64: F64, f64, vector_f64, vector_f64, vector_f64, quaternion_f64,
        stored vector_f64 quaternion_f64 vector_f64 vector_f64 vector_f64;
    model_f32: F32, f32, vector_f32, vector_f32, vector_f32, quaternion_f32,
        stored vector_f32 quaternion_f32 vector_f32 vector_f32 vector_f32;
    model_fixed: Fixed, f32, vector_f32, vector_f32, vector_f32, quaternion_f32,
        stored place turn fixed_velocity fixed_velocity point;
    model_planar64: Planar64, f64, flat_f64, axial_f64, about_f64, heading_f64,
        stored flat_f64 heading_f64 flat_f64 axial_f64 flat_f64;
    model_planar32: Planar32, f32, flat_f32, axial_f32, about_f32, heading_f32,
        stored flat_f32 heading_f32 flat_f32 axial_f32 flat_f32;
}

/// A `static` model from a [`ModelSpec`] in a `const`, in precision `F64`, `F32` or `Fixed` or, for a model in the plane z
/// = 0, `Planar64` or `Planar32`: the compiler counts its parts, rounds them once and checks every index.
///
/// ```
/// use dbd_kernel::model_spec::{ModelSpec, Spring, Start};
/// use dbd_kernel::{BodyIndex, Leapfrog, Plant};
///
/// const PENDULUM: ModelSpec = ModelSpec::new()
///     .gravity([0.0, -9.81, 0.0])
///     .body(1.0, [0.1; 3], Start::at([1.0, 0.0, 0.0]))
///     .tsda(
///         [BodyIndex::WORLD, BodyIndex(0)],
///         [[0.0; 3]; 2],
///         Spring { stiffness: 1e4, damping: 0.0, free_length: 1.0 },
///     );
/// dbd_kernel::model!(static PENDULUM_F32: F32 = PENDULUM);
///
/// let mut plant = Plant::new(&PENDULUM_F32, Leapfrog, 1e-3)?;
/// plant.advance(100)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A reference to a body that does not exist is a compile error:
///
/// ```compile_fail
/// use dbd_kernel::BodyIndex;
/// use dbd_kernel::model_spec::{ModelSpec, Spring, Start};
///
/// const WRONG: ModelSpec = ModelSpec::new().body(1.0, [0.1; 3], Start::at([0.0; 3])).tsda(
///     [BodyIndex::WORLD, BodyIndex(1)],
///     [[0.0; 3]; 2],
///     Spring { stiffness: 1.0, damping: 0.0, free_length: 1.0 },
/// );
/// dbd_kernel::model!(static MODEL: F64 = WRONG);
/// ```
///
/// So is a part that is not in the plane of a planar model:
///
/// ```compile_fail
/// use dbd_kernel::model_spec::{ModelSpec, Start};
///
/// const LIFTED: ModelSpec = ModelSpec::new().body(1.0, [0.1; 3], Start::at([0.0, 0.0, 0.5]));
/// dbd_kernel::model!(static MODEL: Planar64 = LIFTED);
/// ```
#[macro_export]
macro_rules! model {
    ($(#[$meta:meta])* $visible:vis static $name:ident: F64 = $model_spec:path) => {
        $crate::model!(@ [$(#[$meta])* $visible] $name $crate::geometry::F64, model_f64 $model_spec);
    };
    ($(#[$meta:meta])* $visible:vis static $name:ident: F32 = $model_spec:path) => {
        $crate::model!(@ [$(#[$meta])* $visible] $name $crate::geometry::F32, model_f32 $model_spec);
    };
    ($(#[$meta:meta])* $visible:vis static $name:ident: Fixed = $model_spec:path) => {
        $crate::model!(@ [$(#[$meta])* $visible] $name $crate::fixed::Fixed, model_fixed $model_spec);
    };
    ($(#[$meta:meta])* $visible:vis static $name:ident: Planar64 = $model_spec:path) => {
        $crate::model!(@ [$(#[$meta])* $visible] $name $crate::planar::Planar64, model_planar64 $model_spec);
    };
    ($(#[$meta:meta])* $visible:vis static $name:ident: Planar32 = $model_spec:path) => {
        $crate::model!(@ [$(#[$meta])* $visible] $name $crate::planar::Planar32, model_planar32 $model_spec);
    };
    (@ [$($head:tt)*] $name:ident $precision:ty, $function:ident $model_spec:path) => {
        $($head)* static $name: $crate::model::Model<
            $precision,
            { $model_spec.counts()[0] },
            { $model_spec.counts()[1] },
            { $model_spec.counts()[2] },
            { $model_spec.counts()[3] },
            { $model_spec.counts()[4] },
            { $model_spec.counts()[5] },
            { $model_spec.counts()[6] },
            { $model_spec.counts()[7] },
            { $model_spec.counts()[8] },
            0,
            0,
            0,
            0,
            { $model_spec.counts()[9] },
            { $model_spec.counts()[10] },
            { if $model_spec.counts()[5] > 0 { $model_spec.counts()[0] } else { 0 } },
        > = $model_spec.$function();
    };
}
