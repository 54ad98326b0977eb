//! Two runs, sample by sample, at the times that both have.
//!
//! `pairs of rows => first difference, quantities, first sample beyond a band`. Numbers are equal if their bits
//! are; all NaNs are equal. The distances of bodies are those of `dbd-golden`.

use dbd_golden::{Bands, Quantity as BodyQuantity, same};
use dbd_plant::number_format::Digits;
use dbd_scene::{BODY_COLUMNS, ENERGY_COLUMNS};

use crate::comparison::first::{Beyond, First};
use crate::comparison::pairing::Pairing;
use crate::comparison::quantity::{Quantity, ulps};
use crate::recorded::row_text::digits_of;
use crate::recorded::{Head, Row};

/// The result so far.
pub struct Walk<'h> {
    heads: [&'h Head; 2],
    pairing: &'h Pairing,
    /// Whether both have stored words of the same kind, so that their hashes can be compared.
    hashes: bool,
    /// Common samples.
    pub samples: u64,
    /// \[s\] the first and the last of them.
    pub span: Option<[f64; 2]>,
    /// Their last steps, while all was equal.
    equal: Option<[u64; 2]>,
    /// Where they first differ.
    pub first: Option<First>,
    /// The first sample beyond a band.
    pub beyond: Option<Beyond>,
    /// The quantities of bodies, in the order of [`BodyQuantity::ALL`].
    bodies: [Quantity; 4],
    energies: Option<[Quantity; 3]>,
    values: Vec<Quantity>,
}

/// A number that is compared.
struct Number<'n> {
    component: &'n dyn Fn() -> String,
    body: Option<&'n str>,
    quantity: &'static str,
    unit: &'n str,
    values: [f64; 2],
    ulps: Option<u64>,
}

/// The numbers of a sample, counted.
#[derive(Default)]
struct Seen {
    numbers: usize,
    differing: usize,
    first: Option<First>,
}

impl Seen {
    /// Takes a number; whether it is equal.
    fn take(&mut self, number: &Number<'_>) -> bool {
        self.numbers += 1;
        let [a, b] = number.values;
        if same(a, b) {
            return true;
        }
        self.differing += 1;
        if self.first.is_none() {
            self.first = Some(First {
                time: 0.0,
                steps: [0; 2],
                equal_steps: None,
                component: (number.component)(),
                body: number.body.map(str::to_owned),
                quantity: number.quantity,
                unit: number.unit.to_owned(),
                values: number.values,
                ulps: number.ulps,
                differing: 0,
                numbers: 0,
            });
        }
        false
    }
}

/// The distance of two numbers; infinite if one is a NaN.
fn apart(a: f64, b: f64) -> f64 {
    if same(a, b) {
        return 0.0;
    }
    let distance = (b - a).abs();
    if distance.is_nan() { f64::INFINITY } else { distance }
}

impl<'h> Walk<'h> {
    /// Begins with nothing seen; `bands` are those of the quantities.
    #[must_use]
    pub fn new(heads: [&'h Head; 2], pairing: &'h Pairing, bands: Option<&Bands<'_>>) -> Self {
        let banded = |mut quantity: Quantity, band: Option<f64>| {
            quantity.band = band;
            quantity
        };
        let bodies = BodyQuantity::ALL
            .map(|of| banded(Quantity::new(of.name(), of.unit()), bands.map(|bands| bands.of(of))));
        // Energies follow from the state: a single number does not apply to them.
        let named = |name: &str| {
            let own = bands.map(|bands| Bands { others: None, ..*bands });
            own.and_then(|bands| bands.of_value(name))
        };
        let energies = ENERGY_COLUMNS.map(|name| banded(Quantity::new(name, "J"), named(name)));
        let values = pairing.values.iter().map(|pair| {
            let band = bands.and_then(|bands| bands.of_value(&pair.name));
            banded(Quantity::new(&pair.name, &pair.unit), band)
        });
        let [a, b] = heads;
        let hashes = (&a.precision, &a.orientation) == (&b.precision, &b.orientation)
            && !pairing.lacks_bodies();
        Self {
            heads,
            pairing,
            hashes,
            samples: 0,
            span: None,
            equal: None,
            first: None,
            beyond: None,
            bodies,
            energies: Some(energies),
            values: values.collect(),
        }
    }

    /// Takes a common sample.
    pub fn look(&mut self, a: &Row, b: &Row) {
        let steps = [a.step, b.step];
        let mut seen = Seen::default();
        self.look_at_bodies(a, b, &mut seen);
        self.look_at_turns(a, b, &mut seen);
        self.look_at_energies(a, b, &mut seen);
        self.look_at_values(a, b, &mut seen);
        if let (None, true, [Some(of_a), Some(of_b)]) = (&seen.first, self.hashes, [a.hash, b.hash])
            && of_a != of_b
            && a.step == b.step
        {
            seen.take(&Number {
                component: &|| "state".into(),
                body: None,
                quantity: "state",
                unit: "",
                // The words are not numbers of the traces.
                values: [f64::NAN, 0.0],
                ulps: None,
            });
            seen.numbers -= 1;
        }
        match seen.first {
            Some(first) if self.first.is_none() => {
                let (differing, numbers) = (seen.differing, seen.numbers);
                let (time, equal_steps) = (a.time, self.equal);
                self.first = Some(First { time, steps, equal_steps, differing, numbers, ..first });
            }
            None if self.first.is_none() => self.equal = Some(steps),
            _ => {}
        }
        self.samples += 1;
        self.span = Some([self.span.map_or(a.time, |[from, _]| from), a.time]);
    }

    /// All quantities, those of the bodies first.
    #[must_use]
    pub fn quantities(self) -> Vec<Quantity> {
        let bodies = if self.pairing.bodies.is_empty() { Vec::new() } else { self.bodies.to_vec() };
        let energies = self.energies.into_iter().flatten();
        bodies.into_iter().chain(energies).chain(self.values).collect()
    }

    fn look_at_bodies(&mut self, a: &Row, b: &Row, seen: &mut Seen) {
        let mut furthest = [(f64::NEG_INFINITY, ""); 4];
        for pair in &self.pairing.bodies {
            let (of_a, of_b) = (&a.bodies[pair.rows[0]], &b.bodies[pair.rows[1]]);
            // Both signs are the same orientation; the nearer one counts.
            let dot: f64 = (3..7).map(|column| of_a[column] * of_b[column]).sum();
            let mut equal = [true; 4];
            let mut most: [(f64, Option<u64>); 4] = [(-1.0, None); 4];
            for column in 0..BODY_COLUMNS.len() {
                let of = BodyQuantity::of_column(column);
                let values = [of_a[column], of_b[column]];
                let sign = if of == BodyQuantity::Orientation && dot < 0.0 { -1.0 } else { 1.0 };
                let digits = self.heads.map(|head| digits_of(head.number_format, column));
                let row = of as usize;
                let ulps = match same(values[0], values[1]) {
                    true => Some(0),
                    false => ulps(digits, [values[0], sign * values[1]]),
                };
                equal[row] &= seen.take(&Number {
                    component: &|| format!("{}{}", pair.name, BODY_COLUMNS[column]),
                    body: Some(&pair.name),
                    quantity: of.name(),
                    unit: if of == BodyQuantity::Orientation { "" } else { of.unit() },
                    values,
                    ulps,
                });
                let off = (values[0] - sign * values[1]).abs();
                if off > most[row].0 {
                    most[row] = (off, ulps);
                }
            }
            for of in BodyQuantity::ALL {
                let row = of as usize;
                let distance = if equal[row] { 0.0 } else { of.distance(of_a, of_b) };
                self.bodies[row].push(distance, a.time, Some(&pair.name), most[row].1);
                if distance > furthest[row].0 {
                    furthest[row] = (distance, &pair.name);
                }
            }
        }
        for (row, (distance, body)) in furthest.into_iter().enumerate() {
            let quantity = &self.bodies[row];
            check_band(&mut self.beyond, quantity, distance, Some(body), [a, b]);
        }
    }

    fn look_at_turns(&self, a: &Row, b: &Row, seen: &mut Seen) {
        let (Some(of_a), Some(of_b)) = (&a.turns, &b.turns) else { return };
        for (spring, (of_a, of_b)) in of_a.iter().zip(of_b).enumerate() {
            seen.take(&Number {
                component: &|| format!("turns.{spring}"),
                body: None,
                quantity: "turns",
                unit: "",
                values: [of_a, of_b].map(|turns| f64::from(*turns)),
                ulps: None,
            });
        }
    }

    fn look_at_energies(&mut self, a: &Row, b: &Row, seen: &mut Seen) {
        let both = a.energies.zip(b.energies);
        let Some((quantities, (of_a, of_b))) = self.energies.as_mut().zip(both) else {
            // A golden file has no energies.
            self.energies = None;
            return;
        };
        for (row, quantity) in quantities.iter_mut().enumerate() {
            let values = [of_a[row], of_b[row]];
            number(quantity, "energy", values, [Digits::Double; 2], [a, b], seen);
            check_band(&mut self.beyond, quantity, apart(values[0], values[1]), None, [a, b]);
        }
    }

    fn look_at_values(&mut self, a: &Row, b: &Row, seen: &mut Seen) {
        let digits = self.heads.map(|head| head.number_format.reading);
        for (pair, quantity) in self.pairing.values.iter().zip(&mut self.values) {
            let values = [a.values[pair.rows[0]], b.values[pair.rows[1]]];
            number(quantity, "readout", values, digits, [a, b], seen);
            check_band(&mut self.beyond, quantity, apart(values[0], values[1]), None, [a, b]);
        }
    }
}

/// Adds a number that is a quantity by itself.
fn number(
    quantity: &mut Quantity,
    kind: &'static str,
    values: [f64; 2],
    digits: [Digits; 2],
    [a, _]: [&Row; 2],
    seen: &mut Seen,
) {
    let between = if same(values[0], values[1]) { Some(0) } else { ulps(digits, values) };
    let name = quantity.name.clone();
    seen.take(&Number {
        component: &|| name.clone(),
        body: None,
        quantity: kind,
        unit: &quantity.unit,
        values,
        ulps: between,
    });
    quantity.push(apart(values[0], values[1]), a.time, None, between);
}

/// Keeps the first sample at which a quantity is beyond its band.
fn check_band(
    beyond: &mut Option<Beyond>,
    quantity: &Quantity,
    distance: f64,
    body: Option<&str>,
    [a, b]: [&Row; 2],
) {
    let Some(band) = quantity.band.filter(|band| beyond.is_none() && distance > *band) else {
        return;
    };
    *beyond = Some(Beyond {
        time: a.time,
        steps: [a.step, b.step],
        quantity: quantity.name.clone(),
        unit: quantity.unit.clone(),
        body: body.map(str::to_owned),
        distance: Some(distance).filter(|distance| distance.is_finite()),
        band,
    });
}
