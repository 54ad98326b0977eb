//! The cases of a sweep, in their order.
//!
//! `(axes, case) => values, changes of the scene, method`. In a grid the last axis varies fastest, and paired axes
//! count as the first of them; a sample has a value of every axis in each case. Nothing is stored per case.

use dbd_plant::{Method, MethodError};

use crate::sweep::axis::{Axis, Choices, Target};
use crate::sweep::spec::Spec;
use crate::sweep::value::Value;

/// The cases of a sweep.
#[derive(Clone, Copy, Debug)]
pub struct Cases<'s> {
    spec: &'s Spec,
}

impl<'s> Cases<'s> {
    /// The cases of a file.
    #[must_use]
    pub fn new(spec: &'s Spec) -> Self {
        Self { spec }
    }

    /// Their number; at most [`MAX_CASES`](crate::sweep::spec::MAX_CASES).
    #[must_use]
    pub fn len(&self) -> usize {
        self.spec.count() as usize
    }

    /// Always false: there is at least one.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The values of the axes in a case, from 0.
    #[must_use]
    pub fn values(&self, case: usize) -> Vec<&'s Value> {
        let Spec { axes, leaders, sample, .. } = self.spec;
        if sample.is_some() {
            return axes.iter().map(|axis| &axis.values[case]).collect();
        }
        let mut rows = vec![0; axes.len()];
        let mut rest = case;
        for (row, axis) in axes.iter().enumerate().rev().filter(|(row, _)| leaders[*row] == *row) {
            rows[row] = rest % axis.values.len();
            rest /= axis.values.len();
        }
        let row_of = |axis: usize| rows[leaders[axis]];
        axes.iter().enumerate().map(|(row, axis)| &axis.values[row_of(row)]).collect()
    }

    /// The changes of the scene in a case, each `PATH=VALUE`, later ones before earlier ones.
    #[must_use]
    pub fn changes(&self, case: usize) -> Vec<String> {
        changes(self.spec, &self.values(case))
    }

    /// The method of a case.
    ///
    /// # Errors
    /// Where its choices do not go together.
    pub fn method(&self, case: usize) -> Result<Method, MethodError> {
        choices(self.spec, &self.values(case)).method()
    }
}

/// The changes of the scene with these values of the axes.
pub(crate) fn changes(spec: &Spec, values: &[&Value]) -> Vec<String> {
    let set = spec.set.iter().map(|change| change.text.clone());
    let pairs = spec.fixed.iter().flat_map(|axis| axis.values.iter().map(move |v| (axis, v)));
    let pairs = pairs.chain(spec.axes.iter().zip(values.iter().copied()));
    let of_scene = pairs.filter(|(axis, _)| axis.target == Target::Scene);
    set.chain(of_scene.map(|(axis, value)| change(axis, value))).collect()
}

/// A change of the scene.
pub(crate) fn change(axis: &Axis, value: &Value) -> String {
    format!("{}={}", axis.path, value.toml)
}

/// The choices of a method with these values of the axes.
pub(crate) fn choices<'v>(spec: &'v Spec, values: &[&'v Value]) -> Choices<'v> {
    let fixed = spec.fixed.iter().flat_map(|axis| axis.values.iter().map(move |v| (axis, v)));
    let mut choices = Choices::default();
    for (axis, value) in fixed.chain(spec.axes.iter().zip(values.iter().copied())) {
        if axis.target != Target::Scene {
            choices.add(axis.target, &value.cell);
        }
    }
    choices
}
