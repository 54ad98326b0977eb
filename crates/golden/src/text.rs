//! Reads a golden file in place, on a PC and on a target.
//!
//! `text => head, rows; or the damaged line`. The whole file is checked before the comparison: every number, every
//! line's hash, the last line.

use crate::chain::Chain;
use crate::component::ENDS;
use crate::head::{FIRST, Identity, NumberFormat, PrecisionTag, SchemeTag, VERSION};
use crate::mismatch::{Damage, KNOWN, Mismatch};
use crate::number::{Digits, read_hash};
use crate::record::Ending;

/// A complete golden file.
#[derive(Clone, Copy, Debug)]
pub struct Golden<'g> {
    pub(crate) scene: &'g str,
    pub(crate) identity: Identity<'g>,
    pub(crate) every: u64,
    pub(crate) values: usize,
    /// The line of column names.
    pub(crate) header: &'g str,
    lines: Lines<'g>,
    samples: u64,
}

/// A row: the numbers recorded at a step.
#[derive(Clone, Copy, Debug)]
pub struct Row<'g> {
    /// The step.
    pub step: u64,
    /// FNV-1a 64 over the state's stored words.
    pub hash: u64,
    /// The numbers, of bodies, turns and values.
    fields: &'g str,
}

/// Lines with their numbers, without line breaks.
#[derive(Clone, Copy, Debug)]
struct Lines<'g> {
    rest: &'g str,
    number: usize,
}

impl<'g> Iterator for Lines<'g> {
    type Item = (usize, &'g str);

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        let (line, rest) = self.rest.split_once('\n').unwrap_or((self.rest, ""));
        self.rest = rest;
        self.number += 1;
        Some((self.number, line.strip_suffix('\r').unwrap_or(line)))
    }
}

type Read<'g, T> = Result<T, Mismatch<&'g str>>;

fn damaged<'g>(line: usize, damage: Damage) -> Mismatch<&'g str> {
    Mismatch::Damaged { line, damage }
}

/// Reads the header lines in order.
struct HeadLines<'g> {
    lines: Lines<'g>,
    chain: Chain,
}

impl<'g> HeadLines<'g> {
    fn next(&mut self, key: &'static str) -> Read<'g, &'g str> {
        let number = self.lines.number + 1;
        let (_, line) = self.lines.next().ok_or(damaged(number, Damage::Cut))?;
        self.chain.add(line);
        self.chain.add("\n");
        line.strip_prefix(key).ok_or(damaged(number, Damage::Head(key)))
    }

    fn parsed<T>(
        &mut self,
        key: &'static str,
        read: impl FnOnce(&'g str) -> Option<T>,
    ) -> Read<'g, T> {
        let text = self.next(key)?;
        read(text).ok_or(damaged(self.lines.number, Damage::Head(key)))
    }
}

impl<'g> Golden<'g> {
    /// Reads a file's bytes.
    ///
    /// # Errors
    /// As [`Self::read`], and if it is not UTF-8.
    pub fn of_bytes(bytes: &'g [u8]) -> Result<Self, Mismatch<&'g str>> {
        let text = core::str::from_utf8(bytes).map_err(|error| {
            let before = bytes.get(..error.valid_up_to()).unwrap_or_default();
            let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
            damaged(line, Damage::Text)
        })?;
        Self::read(text)
    }

    /// Reads a file's text, to its end.
    ///
    /// # Errors
    /// [`Mismatch::Version`], or [`Mismatch::Damaged`] with the line.
    pub fn read(text: &'g str) -> Result<Self, Mismatch<&'g str>> {
        let mut head = HeadLines { lines: Lines { rest: text, number: 0 }, chain: Chain::new() };
        let version = head.next(FIRST).map_err(|_| damaged(1, Damage::Foreign))?;
        if version.parse() != Ok(VERSION) {
            return Err(Mismatch::Version { golden: version, present: KNOWN });
        }
        let scene = head.next("# scene: ")?;
        let model = head.parsed("# model: ", read_hash)?;
        let scheme = head.parsed("# scheme: ", |text| {
            let mut parts = text.split('\t');
            let (name, damping) = (parts.next()?, parts.next()?);
            let evaluations = parts.next()?.parse().ok()?;
            parts.next().is_none().then_some(SchemeTag { name, damping, evaluations })
        })?;
        let precision = head.parsed("# precision: ", |text| {
            let (name, orientation) = text.split_once('\t')?;
            Some(PrecisionTag { name, orientation })
        })?;
        let number_format = head.parsed("# digits: ", |text| {
            let mut digits = text.split(' ').map(Digits::of_name);
            let mut next = || digits.next().flatten();
            let (position, orientation) = (next()?, next()?);
            let (velocity, value) = (next()?, next()?);
            Some(NumberFormat { position, orientation, velocity, value })
        })?;
        let step_size = head.parsed("# step: ", |text| text.parse().ok())?;
        let every = head.parsed("# every: ", |text| text.parse().ok())?;
        let bodies = head.parsed("# bodies: ", |text| text.parse::<u16>().ok())?.into();
        let turns = head.parsed("# turns: ", |text| text.parse::<u16>().ok())?.into();
        let values = head.parsed("# values: ", |text| text.parse::<u16>().ok())?.into();
        let header = head.next("step\tstate\t")?;
        let identity =
            Identity { scheme, precision, number_format, step_size, model, bodies, turns };
        let HeadLines { lines, chain } = head;
        let mut golden = Self { scene, identity, every, values, header, lines, samples: 0 };
        if header.split('\t').count() != golden.numbers() + 1 || !header.ends_with("\tchain") {
            return Err(damaged(lines.number, Damage::Head("step\tstate\t…\tchain")));
        }
        golden.samples = golden.checked(chain)?;
        Ok(golden)
    }

    /// Numbers of a row.
    pub(crate) fn numbers(&self) -> usize {
        ENDS.len() * self.identity.bodies + self.identity.turns + self.values
    }

    /// Number of samples.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.samples
    }

    /// The scene's name.
    #[must_use]
    pub fn scene(&self) -> &'g str {
        self.scene
    }

    /// The identity of its plant.
    #[must_use]
    pub fn identity(&self) -> &Identity<'g> {
        &self.identity
    }

    /// Steps from sample to sample.
    #[must_use]
    pub fn every(&self) -> u64 {
        self.every
    }

    /// The names of the numbers of a row, in order: 13 of each body, the turn counts, the recorded values.
    pub fn columns(&self) -> impl Iterator<Item = &'g str> + use<'g> {
        self.header.split('\t').take(self.numbers())
    }

    /// The step of its first sample.
    #[must_use]
    pub fn first_step(&self) -> Option<u64> {
        self.rows().next().map(|row| row.step)
    }

    /// Checks every row and the last line; returns the number of samples.
    fn checked(&self, mut chain: Chain) -> Read<'g, u64> {
        let mut lines = self.lines;
        let (mut samples, mut last) = (0, None);
        while let Some((number, line)) = lines.next() {
            if line.starts_with('#') {
                let end = Ending { samples, chain };
                let mut expected = Expected(line);
                let whole = core::fmt::write(&mut expected, format_args!("{end}")).is_ok()
                    && expected.0.is_empty();
                return match lines.next() {
                    _ if !whole => Err(damaged(number, Damage::Count)),
                    _ if samples == 0 => Err(damaged(number, Damage::Cut)),
                    Some((number, _)) => Err(damaged(number, Damage::Rest)),
                    None => Ok(samples),
                };
            }
            let found = line.split('\t').count();
            let columns = self.numbers() + 3;
            if found != columns {
                return Err(damaged(number, Damage::Fields { found, columns }));
            }
            let (row, hash) = line.rsplit_once('\t').unwrap_or_default();
            if let Err(column) = self.check_numbers(row) {
                return Err(damaged(number, Damage::Number(column)));
            }
            let step = step_of(row);
            let hash = read_hash(hash).ok_or(damaged(number, Damage::Number(columns)))?;
            chain.add(row);
            if hash != chain.0 {
                let from = if samples == 0 { 1 } else { number };
                return Err(damaged(number, Damage::Chain { from }));
            }
            chain.add("\n");
            if last.is_some() && step <= last {
                return Err(damaged(number, Damage::Order));
            }
            last = step;
            samples += 1;
        }
        Err(damaged(lines.number + 1, Damage::Cut))
    }

    /// The first column of a row, from 1, that is not a number.
    fn check_numbers(&self, row: &str) -> Result<(), usize> {
        let mut fields = row.split('\t');
        let mut holds = |number: usize, is: &dyn Fn(&str) -> bool| {
            let good = fields.next().is_some_and(is);
            if good { Ok(()) } else { Err(number) }
        };
        holds(1, &|text| text.parse::<u64>().is_ok())?;
        holds(2, &|text| read_hash(text).is_some())?;
        let bodies = ENDS.len() * self.identity.bodies;
        for place in 0..self.numbers() {
            let digits = self.digits(place);
            let is_turn = (bodies..bodies + self.identity.turns).contains(&place);
            holds(place + 3, &|text| match is_turn {
                true => text.parse::<i32>().is_ok(),
                false => digits.read(text).is_some(),
            })?;
        }
        Ok(())
    }

    /// The digits of the number at an index of a row, from 0.
    pub(crate) fn digits(&self, place: usize) -> Digits {
        let bodies = ENDS.len() * self.identity.bodies;
        if place < bodies {
            self.identity.number_format.of_column(place % ENDS.len())
        } else if place < bodies + self.identity.turns {
            // A count, which may exceed single precision.
            Digits::Double
        } else {
            self.identity.number_format.value
        }
    }

    /// The rows in order.
    #[must_use]
    pub fn rows(&self) -> Rows<'g> {
        Rows(self.lines)
    }

    /// The numbers of a row, widened exactly.
    pub fn numbers_of(&self, row: &Row<'g>) -> impl Iterator<Item = f64> + use<'g> {
        let golden = *self;
        let numbers = row.fields.split('\t').enumerate();
        // All were checked before.
        numbers.map(move |(place, text)| golden.digits(place).read(text).unwrap_or(f64::NAN))
    }
}

fn step_of(row: &str) -> Option<u64> {
    row.split('\t').next()?.parse().ok()
}

/// The rows of a checked file.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'g>(Lines<'g>);

impl<'g> Iterator for Rows<'g> {
    type Item = Row<'g>;

    fn next(&mut self) -> Option<Row<'g>> {
        let (_, line) = self.0.next().filter(|(_, line)| !line.starts_with('#'))?;
        let (step, rest) = line.split_once('\t')?;
        let (hash, rest) = rest.split_once('\t')?;
        // A scene without numbers is invalid.
        let (fields, _) = rest.rsplit_once('\t')?;
        Some(Row { step: step.parse().ok()?, hash: read_hash(hash)?, fields })
    }
}

/// Consumes an expected text, and fails on any other.
pub(crate) struct Expected<'t>(pub(crate) &'t str);

impl core::fmt::Write for Expected<'_> {
    fn write_str(&mut self, written: &str) -> core::fmt::Result {
        self.0 = self.0.strip_prefix(written).ok_or(core::fmt::Error)?;
        Ok(())
    }
}
