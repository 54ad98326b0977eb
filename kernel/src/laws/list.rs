//! The list of a model's laws: a tuple of tables, each the rows of one law.
//!
//! `(tables, pose) => records added to the wrenches`. Laws that are not listed generate no code.

use crate::elements::share::Share;
use crate::force_pair::Wrench;
use crate::geometry::Geometry;
use crate::laws::end::Instant;
use crate::laws::interaction::{Damper, Interaction, Need, SharesOf};
use crate::laws::row::{Act, DamperPass, Row};
use crate::laws::rows;
use crate::laws::several::Several;
use crate::words::{WordSource, WordVisitor};

/// A model's laws: a table, a tuple of tables, or a container of a program that reads scenes.
pub trait Laws<P: Geometry>: Send + Sync + 'static {
    /// Memories of the rows.
    type States: Clone + Send + Sync + 'static;
    /// Weights of their dampers.
    type Shares: Clone + Send + Sync + 'static;
    /// Whether the list has no table.
    const EMPTY: bool;
    /// Whether any may have dampers.
    const DAMPED: bool;
    /// Whether any may have dampers that act on rotations only.
    const TURNS: bool;
    /// Whether any may have other dampers.
    const PUSHES: bool;
    /// Whether any may advance its memory by steps.
    const ADVANCES: bool;

    /// The number of rows.
    fn count(&self) -> usize;
    /// Whether any row has dampers that may act, by its constants.
    fn is_damped(&self) -> bool;
    /// Whether the force of any row depends on inputs.
    fn is_driven(&self) -> bool;
    /// Memories at t = 0.
    fn states(&self) -> Self::States;
    /// A weight per damper.
    fn shares(&self) -> Self::Shares;
    /// Adds the records in order.
    ///
    /// # Errors
    /// The first row whose record is undefined.
    fn act(
        &self,
        at: Instant<'_, P>,
        states: &mut Self::States,
        act: Act<'_, P>,
        wrenches: &mut [Wrench<P::Space>],
    ) -> Result<(), usize>;
    /// Applies the dampers row by row, in descending order with `reverse`.
    fn sweep(
        &self,
        reverse: bool,
        states: &mut Self::States,
        shares: &Self::Shares,
        pass: &mut dyn DamperPass<P>,
    );
    /// Passes a row with a copy of its memory to `look`; does nothing where the list has no such row.
    fn look(&self, row: usize, states: &Self::States, look: &mut dyn FnMut(&mut dyn Row<P>));
    /// The weight of a damper of a row.
    fn share_mut<'s>(
        &self,
        shares: &'s mut Self::Shares,
        row: usize,
        damper: usize,
    ) -> Option<&'s mut Share<P::Real>>;
    /// Visits the words of the memories.
    fn visit(states: &Self::States, visitor: &mut dyn WordVisitor);
    /// Reads the memories from a source.
    fn fill(states: &mut Self::States, source: &mut dyn WordSource);
    /// The first law with the strictest requirement on a scheme, and the requirement.
    fn memory(&self) -> Option<(&'static str, Need)>;

    /// Visits every row in order.
    fn look_at_all(&self, states: &Self::States, visit: &mut dyn FnMut(usize, &mut dyn Row<P>)) {
        for row in 0..self.count() {
            self.look(row, states, &mut |law| visit(row, law));
        }
    }
}

impl<P: Geometry, T: Interaction<P>, const N: usize> Laws<P> for [T; N] {
    type States = [T::State; N];
    type Shares = [SharesOf<P, T>; N];
    const EMPTY: bool = N == 0;
    const DAMPED: bool = N > 0 && T::Dampers::COUNT > 0;
    const TURNS: bool = <Self as Laws<P>>::DAMPED && T::TURNS;
    const PUSHES: bool = <Self as Laws<P>>::DAMPED && !T::TURNS;
    const ADVANCES: bool = N > 0 && T::ADVANCES;

    #[inline(always)]
    fn count(&self) -> usize {
        N
    }
    #[inline(always)]
    fn is_damped(&self) -> bool {
        <Self as Laws<P>>::DAMPED && self.iter().any(Interaction::is_damped)
    }
    #[inline(always)]
    fn is_driven(&self) -> bool {
        N > 0 && T::DRIVEN
    }
    #[inline]
    fn states(&self) -> Self::States {
        [T::State::default(); N]
    }
    #[inline]
    fn shares(&self) -> Self::Shares {
        [T::Dampers::of(Share::ALONE); N]
    }
    #[inline(always)]
    fn act(
        &self,
        at: Instant<'_, P>,
        states: &mut Self::States,
        act: Act<'_, P>,
        wrenches: &mut [Wrench<P::Space>],
    ) -> Result<(), usize> {
        for (number, (law, state)) in self.iter().zip(states).enumerate() {
            rows::act(&mut rows::row(law, state), at, act, wrenches).ok_or(number)?;
        }
        Ok(())
    }
    #[inline(always)]
    fn sweep(
        &self,
        reverse: bool,
        states: &mut Self::States,
        shares: &Self::Shares,
        pass: &mut dyn DamperPass<P>,
    ) {
        let order = [reverse, pass.is_evaluated()];
        for row in 0..N {
            let row = if reverse { N - 1 - row } else { row };
            let (Some(law), Some(state), Some(shares)) =
                (self.get(row), states.get_mut(row), shares.get(row))
            else {
                break;
            };
            let room = || T::Dampers::of(Damper::idle());
            rows::sweep(&mut rows::row(law, state), order, shares.as_ref(), room, pass);
        }
    }
    fn look(&self, row: usize, states: &Self::States, look: &mut dyn FnMut(&mut dyn Row<P>)) {
        if let (Some(law), Some(state)) = (self.get(row), states.get(row)) {
            look(&mut rows::row(law, &mut { *state }));
        }
    }
    fn share_mut<'s>(
        &self,
        shares: &'s mut Self::Shares,
        row: usize,
        damper: usize,
    ) -> Option<&'s mut Share<P::Real>> {
        shares.get_mut(row)?.as_mut().get_mut(damper)
    }
    fn visit(states: &Self::States, visitor: &mut dyn WordVisitor) {
        rows::visit::<P, T>(states, visitor);
    }
    fn fill(states: &mut Self::States, source: &mut dyn WordSource) {
        rows::fill::<P, T>(states, source);
    }
    fn memory(&self) -> Option<(&'static str, Need)> {
        rows::memory::<P, T>(self)
    }
}

/// The stricter of two laws' requirements, the first where both are equal.
fn stricter(
    a: Option<(&'static str, Need)>,
    b: Option<(&'static str, Need)>,
) -> Option<(&'static str, Need)> {
    let need = |of: Option<(&'static str, Need)>| of.map(|(_, need)| need);
    if need(a) < need(b) { b } else { a }
}

macro_rules! list {
    ($($table:ident $i:tt),*) => {
        #[allow(unused_variables, unused_mut, unused_assignments, clippy::unused_unit)]
        impl<P: Geometry, $($table: Laws<P>),*> Laws<P> for ($($table,)*) {
            type States = ($($table::States,)*);
            type Shares = ($($table::Shares,)*);
            const EMPTY: bool = true $(&& $table::EMPTY)*;
            const DAMPED: bool = false $(|| $table::DAMPED)*;
            const TURNS: bool = false $(|| $table::TURNS)*;
            const PUSHES: bool = false $(|| $table::PUSHES)*;
            const ADVANCES: bool = false $(|| $table::ADVANCES)*;

            #[inline(always)]
            fn count(&self) -> usize {
                0 $(+ self.$i.count())*
            }
            #[inline(always)]
            fn is_damped(&self) -> bool {
                false $(|| self.$i.is_damped())*
            }
            #[inline(always)]
            fn is_driven(&self) -> bool {
                false $(|| self.$i.is_driven())*
            }
            #[inline]
            fn states(&self) -> Self::States {
                ($(self.$i.states(),)*)
            }
            #[inline]
            fn shares(&self) -> Self::Shares {
                ($(self.$i.shares(),)*)
            }
            #[inline(always)]
            fn act(
                &self,
                at: Instant<'_, P>,
                states: &mut Self::States,
                act: Act<'_, P>,
                wrenches: &mut [Wrench<P::Space>],
            ) -> Result<(), usize> {
                let mut before = 0;
                $(
                    self.$i.act(at, &mut states.$i, act, wrenches).map_err(|row| before + row)?;
                    before += self.$i.count();
                )*
                Ok(())
            }
            #[inline(always)]
            fn sweep(
                &self,
                reverse: bool,
                states: &mut Self::States,
                shares: &Self::Shares,
                pass: &mut dyn DamperPass<P>,
            ) {
                let tables = 0 $(+ { let _ = $i; 1 })*;
                for table in 0..tables {
                    let table = if reverse { tables - 1 - table } else { table };
                    $(
                        if table == $i && $table::DAMPED {
                            self.$i.sweep(reverse, &mut states.$i, &shares.$i, pass);
                        }
                    )*
                }
            }
            fn look(&self, row: usize, states: &Self::States, look: &mut dyn FnMut(&mut dyn Row<P>)) {
                let mut row = row;
                $(
                    let count = self.$i.count();
                    if row < count {
                        return self.$i.look(row, &states.$i, look);
                    }
                    row -= count;
                )*
            }
            fn share_mut<'s>(
                &self,
                shares: &'s mut Self::Shares,
                row: usize,
                damper: usize,
            ) -> Option<&'s mut Share<P::Real>> {
                let mut row = row;
                $(
                    let count = self.$i.count();
                    if row < count {
                        return self.$i.share_mut(&mut shares.$i, row, damper);
                    }
                    row -= count;
                )*
                None
            }
            fn visit(states: &Self::States, visitor: &mut dyn WordVisitor) {
                $($table::visit(&states.$i, visitor);)*
            }
            fn fill(states: &mut Self::States, source: &mut dyn WordSource) {
                $($table::fill(&mut states.$i, source);)*
            }
            fn memory(&self) -> Option<(&'static str, Need)> {
                let mut found = None;
                $(found = stricter(found, self.$i.memory());)*
                found
            }
        }
    };
}

list!();
list!(A 0);
list!(A 0, B 1);
list!(A 0, B 1, C 2);
list!(A 0, B 1, C 2, D 3);
list!(A 0, B 1, C 2, D 3, E 4);
list!(A 0, B 1, C 2, D 3, E 4, F 5);
list!(A 0, B 1, C 2, D 3, E 4, F 5, G 6);
list!(A 0, B 1, C 2, D 3, E 4, F 5, G 6, H 7);
