//! Comparison of two complete runs.
//!
//! `A, B, bands => comparison`. Samples are compared at the times that both runs have, to rounding (relative 1e-9);
//! the others are counted; there is no interpolation.

use std::path::PathBuf;

use dbd_golden::BandList;
use dbd_plant::time::display;
use miette::Diagnostic;
use thiserror::Error;

use crate::comparison::first::{Beyond, First};
use crate::comparison::pairing::Pairing;
use crate::comparison::quantity::Quantity;
use crate::comparison::walk::Walk;
use crate::recorded::{Head, Recorded, Row, Unreadable};

/// Times are equal below this relative difference.
const ROUNDING: f64 = 1e-9;

/// The verdict on two runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every number that both have is equal at every common time.
    Equal,
    /// No quantity leaves its band.
    Within,
    /// Neither.
    Different,
}

/// The result of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The heads of A and B.
    pub heads: [Head; 2],
    /// How they ended.
    pub ends: [End; 2],
    /// The pairs of bodies and values.
    pub pairing: Pairing,
    /// Common samples.
    pub samples: u64,
    /// \[s\] the first and the last of them.
    pub span: [f64; 2],
    /// Where they first differ.
    pub first: Option<First>,
    /// Where one first leaves a band.
    pub beyond: Option<Beyond>,
    /// The distances.
    pub quantities: Vec<Quantity>,
    /// Whether bands were stated.
    pub banded: bool,
}

/// How far a run came.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct End {
    /// Samples.
    pub samples: u64,
    /// \[s\] from sample to sample; `None` where there is one.
    pub every: Option<f64>,
    /// \[s\] the first.
    pub from: f64,
    /// \[s\] the last.
    pub until: f64,
}

/// Why two runs could not be compared.
#[derive(Debug, Error, Diagnostic)]
pub enum CompareError {
    /// One of them cannot be read.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Unreadable(#[from] Unreadable),
    /// They have no time in common.
    #[error("{} and {} have no sample at the same time{}: {}", files[0].display(), files[1].display(), but, samples)]
    #[diagnostic(help("run one of them again with the other's --every"))]
    Apart {
        /// The files of A and B.
        files: [PathBuf; 2],
        /// The common time, if there is one.
        but: &'static str,
        /// How each is sampled.
        samples: String,
    },
    /// They have no body in common.
    #[error("{} and {} have no body of the same name: {}; {}", files[0].display(), files[1].display(), bodies[0], bodies[1])]
    #[diagnostic(help("compare runs of one scene, or of scenes with the same body names"))]
    Strangers {
        /// The files of A and B.
        files: [PathBuf; 2],
        /// Their bodies.
        bodies: [String; 2],
    },
    /// A band is given for something that is not compared, or missing for something that is.
    #[error("{0}")]
    #[diagnostic(help(
        "a single number applies to every read-out without its own band: --band 1e-6,angle=1e-3"
    ))]
    Band(String),
}

/// One of two runs in progress.
struct Side {
    run: Recorded,
    row: Option<Row>,
    end: End,
}

impl Side {
    fn new(run: Recorded) -> Result<Self, Unreadable> {
        let mut side = Self { run, row: None, end: End::default() };
        side.step()?;
        Ok(side)
    }

    /// Advances to the next sample.
    fn step(&mut self) -> Result<(), Unreadable> {
        let next = self.run.next_row()?;
        // The row is reused, because runs are long.
        match (next, &mut self.row) {
            (None, kept) => *kept = None,
            (Some(row), Some(kept)) => kept.clone_from(row),
            (Some(row), kept) => *kept = Some(row.clone()),
        }
        if let Some(row) = &self.row {
            match self.end.samples {
                0 => self.end.from = row.time,
                1 => self.end.every = Some(row.time - self.end.from),
                _ => {}
            }
            self.end.samples += 1;
            self.end.until = row.time;
        }
        Ok(())
    }
}

/// How far a run came; it is read to its end, which shows whether it is complete.
///
/// # Errors
/// If a row cannot be read.
pub fn end_of(run: Recorded) -> Result<End, Unreadable> {
    let mut side = Side::new(run)?;
    while side.row.is_some() {
        side.step()?;
    }
    Ok(side.end)
}

/// Compares two runs; `look` sees every common sample.
///
/// # Errors
/// [`CompareError`].
pub fn compare(
    runs: [Recorded; 2],
    bands: Option<&BandList>,
    look: &mut dyn FnMut(&Row, &Row),
) -> Result<Comparison, CompareError> {
    let heads = runs.each_ref().map(|run| run.head.clone());
    let pairing = Pairing::of([&heads[0], &heads[1]]);
    if pairing.bodies.is_empty() {
        let files = heads.each_ref().map(|head| head.file.clone());
        let bodies = heads.each_ref().map(|head| head.bodies.join(", "));
        return Err(CompareError::Strangers { files, bodies });
    }
    let of = [&heads[0], &heads[1]];
    let mut walk = match bands {
        None => Walk::new(of, &pairing, None),
        Some(list) => list.with(|bands| {
            check_bands(&bands, &pairing)?;
            Ok::<_, CompareError>(Walk::new(of, &pairing, Some(&bands)))
        })?,
    };
    let [a, b] = runs;
    let (mut a, mut b) = (Side::new(a)?, Side::new(b)?);
    // Both are read to the end, which shows whether they are complete.
    loop {
        match (&a.row, &b.row) {
            (Some(of_a), Some(of_b)) if is_one(of_a.time, of_b.time) => {
                walk.look(of_a, of_b);
                look(of_a, of_b);
                a.step()?;
                b.step()?;
            }
            (Some(of_a), Some(of_b)) if of_a.time > of_b.time => b.step()?,
            (Some(_), _) => a.step()?,
            (None, Some(_)) => b.step()?,
            (None, None) => break,
        }
    }
    let ends = [a.end, b.end];
    let alone = ends.iter().any(|end| end.samples == 1);
    let span = walk.span.filter(|[from, until]| alone || until > from);
    let Some(span) = span else {
        let files = heads.each_ref().map(|head| head.file.clone());
        let but = if walk.samples == 0 { "" } else { " but t = 0" };
        let samples = format!("A {}; B {}", ends[0].text(), ends[1].text());
        return Err(CompareError::Apart { files, but, samples });
    };
    let (samples, first, beyond) = (walk.samples, walk.first.take(), walk.beyond.take());
    let (quantities, banded) = (walk.quantities(), bands.is_some());
    Ok(Comparison { heads, ends, pairing, samples, span, first, beyond, quantities, banded })
}

fn is_one(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING * a.abs().max(b.abs())
}

/// Checks that every value has a band, and every band a value.
fn check_bands(bands: &dbd_golden::Bands<'_>, pairing: &Pairing) -> Result<(), CompareError> {
    let names = || pairing.values.iter().map(|pair| pair.name.as_str());
    let known: Vec<&str> = names().chain(dbd_scene::ENERGY_COLUMNS).collect();
    if let Some(name) = bands.unknown(&known) {
        let problem = format!("a band is given for `{name}`, which is not in both runs");
        return Err(CompareError::Band(problem));
    }
    match names().find(|name| bands.of_value(name).is_none()) {
        Some(name) => Err(CompareError::Band(format!("no band is given for `{name}`"))),
        None => Ok(()),
    }
}

impl End {
    /// The sampling of a run as text.
    #[must_use]
    pub fn text(&self) -> String {
        let (from, until) = (display(self.from), display(self.until));
        match self.every {
            Some(every) => {
                format!("has one every {} from {from} to {until}", display(rounded(every)))
            }
            None => format!("has one, at {from}"),
        }
    }
}

/// A difference of two times without its rounding error.
fn rounded(time: f64) -> f64 {
    dbd_plant::time::rounded(time, 12)
}

impl Comparison {
    /// Whether one run ended early and the other did not, or at another time.
    #[must_use]
    pub fn ended_apart(&self) -> bool {
        let [a, b] = &self.heads;
        let apart = !is_one(self.ends[0].until, self.ends[1].until);
        a.failed() != b.failed() && a.status.is_some() && b.status.is_some()
            || apart && (a.failed() || b.failed())
    }

    /// The verdict.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        if self.pairing.lacks_bodies() || self.ended_apart() {
            Verdict::Different
        } else if self.first.is_none() {
            Verdict::Equal
        } else if self.banded && self.beyond.is_none() {
            Verdict::Within
        } else {
            Verdict::Different
        }
    }
}
