//! Compares a run with a golden file, sample by sample, while it runs.
//!
//! `(golden, head, tolerance), moments, values => nothing, or the first difference`. Nothing is allocated: firmware can
//! compare with a file in its flash.

use crate::bands::{Bands, Tolerance};
use crate::component::{Component, ENDS, Quantity};
use crate::head::Head;
use crate::mismatch::{Difference, Furthest, Mismatch};
use crate::number::{Digits, same};
use crate::subject::{BodyNumbers, Moment};
use crate::text::{Expected, Golden, Row, Rows};

/// A comparison in progress.
#[derive(Clone, Debug)]
pub struct Comparison<'a> {
    golden: Golden<'a>,
    head: Head<'a>,
    tolerance: Tolerance<'a>,
    rows: Rows<'a>,
    next: Option<Row<'a>>,
    equal: Option<u64>,
    summary: Summary<&'a str>,
}

/// The result of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary<N> {
    /// Samples compared.
    pub samples: u64,
    /// Largest distances of the run from the golden one; none if compared bit for bit.
    pub furthest: Furthest<N>,
}

impl<N> Summary<N> {
    /// Whether all numbers were equal.
    #[must_use]
    pub fn is_equal(&self) -> bool {
        self.furthest.quantities.iter().all(Option::is_none) && self.furthest.value.is_none()
    }
}

impl<'a> Comparison<'a> {
    /// Begins a comparison at the first sample; the head must match the file's.
    ///
    /// # Errors
    /// A [`Mismatch`] that names what differs: scene, model, scheme, precision, step, interval or column; or a value
    /// without a band, a band without a value.
    pub fn new(
        golden: Golden<'a>,
        head: Head<'a>,
        tolerance: Tolerance<'a>,
    ) -> Result<Self, Mismatch<&'a str>> {
        compare_heads(&golden, &head, &tolerance)?;
        if let Some(bands) = tolerance.bands() {
            if let Some(name) = bands.unknown(head.values) {
                return Err(Mismatch::UnknownBand(name));
            }
            let bare = head.values.iter().find(|name| bands.of_value(name).is_none());
            if let Some(name) = bare {
                return Err(Mismatch::NoBand(name));
            }
        }
        let mut rows = golden.rows();
        let next = rows.next();
        let summary = Summary { samples: 0, furthest: Furthest::default() };
        Ok(Self { golden, head, tolerance, rows, next, equal: None, summary })
    }

    /// The step of the golden run's next sample; none after the last.
    #[must_use]
    pub fn due(&self) -> Option<u64> {
        self.next.map(|row| row.step)
    }

    /// Compares a sample if one is due; returns whether one was.
    ///
    /// # Errors
    /// As [`Self::sample`].
    pub fn look(
        &mut self,
        moment: &(impl Moment + ?Sized),
        values: &[f64],
    ) -> Result<bool, Mismatch<&'a str>> {
        if self.due().is_some_and(|due| moment.steps_done() < due) {
            return Ok(false);
        }
        self.sample(moment, values).map(|()| true)
    }

    /// Compares a sample, which must be the golden run's next.
    ///
    /// # Errors
    /// [`Mismatch::Sample`], [`Mismatch::Count`] or [`Mismatch::Difference`].
    pub fn sample(
        &mut self,
        moment: &(impl Moment + ?Sized),
        values: &[f64],
    ) -> Result<(), Mismatch<&'a str>> {
        let step = moment.steps_done();
        let Some(row) = self.next.filter(|row| row.step == step) else {
            return Err(Mismatch::Sample { golden: self.due(), present: Some(step) });
        };
        let (names, given) = (self.head.values.len(), values.len());
        if names != given {
            return Err(Mismatch::Count { names, given });
        }
        let bands = self.tolerance.bands().copied();
        let mut tally = Tally::new(&self.golden, bands.as_ref());
        let mut numbers = self.golden.numbers_of(&row);
        for (index, body) in self.head.bodies.iter().copied().enumerate() {
            let Some(present) = moment.body_numbers(index) else {
                return Err(Mismatch::Count { names: self.head.bodies.len(), given: index });
            };
            tally.body(body, [0.0; 13].map(|_| numbers.next().unwrap_or(f64::NAN)), present);
        }
        for spring in 0..self.head.identity.turns {
            let present = moment.turn_count(spring).map_or(f64::NAN, f64::from);
            let golden = numbers.next().unwrap_or(f64::NAN);
            let at = (ENDS.len() * self.head.bodies.len() + spring, Component::Turns { spring });
            tally.number(at, golden, present);
        }
        for (name, present) in self.head.values.iter().copied().zip(values) {
            tally.value(name, numbers.next().unwrap_or(f64::NAN), *present);
        }
        let first = match (&bands, tally.found) {
            (_, Some(found)) => Some(found),
            (None, None) if row.hash != moment.state_hash() => Some(Found {
                component: Component::State,
                pair: [0.0; 2],
                ulps: None,
                beyond: None,
            }),
            _ => None,
        };
        if let Some(Found { component, pair: [golden, present], ulps, beyond }) = first {
            return Err(Mismatch::Difference(Difference {
                step,
                equal: self.equal,
                component,
                golden,
                present,
                ulps,
                beyond,
                differing: tally.differing,
                numbers: self.golden.numbers(),
                furthest: tally.furthest,
            }));
        }
        let seen = &mut self.summary.furthest;
        let pairs = seen.quantities.iter_mut().zip(tally.furthest.quantities);
        for (most, far) in pairs.chain([(&mut seen.value, tally.furthest.value)]) {
            if let Some((distance, name)) = far {
                Furthest::take(most, distance, name);
            }
        }
        self.summary.samples += 1;
        self.equal = Some(step);
        self.next = self.rows.next();
        Ok(())
    }

    /// Ends a comparison after the golden run's last sample.
    ///
    /// # Errors
    /// [`Mismatch::Sample`] if the golden run has more samples.
    pub fn finish(self) -> Result<Summary<&'a str>, Mismatch<&'a str>> {
        match self.due() {
            Some(due) => Err(Mismatch::Sample { golden: Some(due), present: None }),
            None => Ok(self.summary),
        }
    }
}

fn compare_heads<'a>(
    golden: &Golden<'a>,
    head: &Head<'a>,
    tolerance: &Tolerance<'a>,
) -> Result<(), Mismatch<&'a str>> {
    let (of, is) = (&golden.identity, &head.identity);
    if golden.scene != head.scene {
        return Err(Mismatch::Scene { golden: golden.scene, present: head.scene });
    }
    if !matches!(tolerance, Tolerance::AnyMethod(_)) {
        if of.scheme != is.scheme {
            return Err(Mismatch::Scheme { golden: of.scheme, present: is.scheme });
        }
        if of.precision != is.precision {
            return Err(Mismatch::Precision { golden: of.precision, present: is.precision });
        }
    }
    if !same(of.step_size, is.step_size) {
        return Err(Mismatch::Step { golden: of.step_size, present: is.step_size });
    }
    if head.bodies.len() != is.bodies {
        return Err(Mismatch::Count { names: head.bodies.len(), given: is.bodies });
    }
    compare_columns(golden, head)?;
    if of.model != is.model {
        return Err(Mismatch::Model { golden: of.model, present: is.model });
    }
    if golden.every != head.every {
        return Err(Mismatch::Every { golden: golden.every, present: head.every });
    }
    Ok(())
}

fn compare_columns<'a>(golden: &Golden<'a>, head: &Head<'a>) -> Result<(), Mismatch<&'a str>> {
    let header = golden.header.strip_suffix("\tchain").unwrap_or_default();
    let mut columns = head.columns();
    let mut names = header.split('\t');
    // After the columns step and state.
    for number in 3.. {
        let (name, column) = (names.next(), columns.next());
        let equal = match (name, column) {
            (None, None) => return Ok(()),
            (Some(name), Some(column)) => {
                let mut expected = Expected(name);
                core::fmt::write(&mut expected, format_args!("{column}")).is_ok()
                    && expected.0.is_empty()
            }
            _ => false,
        };
        if !equal {
            return Err(Mismatch::Column { number, golden: name, present: column });
        }
    }
    Ok(())
}

/// The findings on a sample.
struct Tally<'t, 'a> {
    golden: &'t Golden<'a>,
    bands: Option<&'t Bands<'a>>,
    bodies: usize,
    values: usize,
    differing: usize,
    furthest: Furthest<&'a str>,
    found: Option<Found<'a>>,
}

/// The difference to report.
#[derive(Clone, Copy)]
struct Found<'a> {
    component: Component<&'a str>,
    pair: [f64; 2],
    ulps: Option<u64>,
    beyond: Option<(f64, f64)>,
}

impl<'t, 'a> Tally<'t, 'a> {
    fn new(golden: &'t Golden<'a>, bands: Option<&'t Bands<'a>>) -> Self {
        let furthest = Furthest::default();
        Self { golden, bands, bodies: 0, values: 0, differing: 0, furthest, found: None }
    }

    /// A number with its index in a row.
    fn number(&mut self, at: (usize, Component<&'a str>), golden: f64, present: f64) {
        if same(golden, present) {
            return;
        }
        self.differing += 1;
        if self.bands.is_none() && self.found.is_none() {
            self.found = Some(self.found(at, [golden, present], None));
        }
    }

    fn found(
        &self,
        (place, component): (usize, Component<&'a str>),
        pair: [f64; 2],
        beyond: Option<(f64, f64)>,
    ) -> Found<'a> {
        let ulps = match component {
            Component::Turns { .. } => None,
            _ => {
                let digits = self.golden.digits(place);
                // For another precision, counted in numbers of the golden run's precision.
                let rounded = beyond.is_some() && digits == Digits::Single;
                let present = if rounded { f64::from(pair[1] as f32) } else { pair[1] };
                digits.ulps(pair[0], present)
            }
        };
        Found { component, pair, ulps, beyond }
    }

    fn body(&mut self, body: &'a str, golden: BodyNumbers, present: BodyNumbers) {
        let first = ENDS.len() * self.bodies;
        self.bodies += 1;
        for (column, (golden, present)) in golden.into_iter().zip(present).enumerate() {
            self.number((first + column, Component::Body { body, column }), golden, present);
        }
        for (quantity, far) in Quantity::ALL.into_iter().zip(0..) {
            let columns = quantity.columns();
            let (of, is) = (&golden[columns.clone()], &present[columns.clone()]);
            if of.iter().zip(is).all(|(of, is)| same(*of, *is)) {
                continue;
            }
            let distance = quantity.distance(&golden, &present);
            if let Some(place) = self.furthest.quantities.get_mut::<usize>(far) {
                Furthest::take(place, distance, body);
            }
            let Some(band) = self.bands.map(|bands| bands.of(quantity)) else { continue };
            let off = |column: &usize| (present[*column] - golden[*column]).abs();
            let most = columns.max_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or_default();
            let at = (first + most, Component::Body { body, column: most });
            self.band(at, [golden[most], present[most]], (distance, band));
        }
    }

    fn value(&mut self, name: &'a str, golden: f64, present: f64) {
        let place = ENDS.len() * self.bodies + self.golden.identity.turns + self.values;
        self.values += 1;
        let at = (place, Component::Value { name });
        self.number(at, golden, present);
        if same(golden, present) {
            return;
        }
        let distance = (present - golden).abs();
        Furthest::take(&mut self.furthest.value, distance, name);
        if let Some(band) = self.bands.and_then(|bands| bands.of_value(name)) {
            self.band(at, [golden, present], (distance, band));
        }
    }

    /// Keeps the quantity furthest beyond its band.
    fn band(
        &mut self,
        at: (usize, Component<&'a str>),
        pair: [f64; 2],
        beyond @ (distance, band): (f64, f64),
    ) {
        let within = distance <= band;
        let ratio = |(distance, band): (f64, f64)| {
            let ratio = distance / band;
            if ratio.is_nan() { f64::INFINITY } else { ratio }
        };
        let most = self.found.and_then(|found| found.beyond).map(ratio);
        if !within && most.is_none_or(|most| ratio(beyond) > most) {
            self.found = Some(self.found(at, pair, Some(beyond)));
        }
    }
}
