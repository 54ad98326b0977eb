//! Records a run as text, line by line: to a file's text, to a console.
//!
//! `(head, moments, values) => lines`. Nothing is allocated, and only the chain is stored, so that firmware can print a
//! record which a PC compares.

use core::fmt::{self, Display, Write};

use crate::chain::{Chain, Chained};
use crate::head::{Head, NumberFormat};
use crate::subject::Moment;

/// Why a sample could not be recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecordError<N> {
    /// The sink accepts no more.
    Sink,
    /// A name is empty or contains a control character.
    Name(N),
    /// The numbers of names and bodies differ.
    Bodies {
        /// Names of bodies.
        names: usize,
        /// Bodies of the plant.
        bodies: usize,
    },
    /// The numbers of values and names differ.
    Values {
        /// Names of values.
        names: usize,
        /// Values given.
        given: usize,
    },
    /// The sampling interval is 0.
    Every,
    /// The step is not after that of the last sample.
    Order {
        /// The last sample's.
        last: u64,
        /// This one's.
        step: u64,
    },
    /// The plant was advanced beyond the step at which a sample was due.
    Missed {
        /// The step.
        due: u64,
        /// The step of the plant.
        step: u64,
    },
}

impl<N> RecordError<N> {
    /// The same with another text type for its name.
    pub fn map<M>(self, with: impl FnOnce(N) -> M) -> RecordError<M> {
        match self {
            RecordError::Sink => RecordError::Sink,
            RecordError::Name(name) => RecordError::Name(with(name)),
            RecordError::Bodies { names, bodies } => RecordError::Bodies { names, bodies },
            RecordError::Values { names, given } => RecordError::Values { names, given },
            RecordError::Every => RecordError::Every,
            RecordError::Order { last, step } => RecordError::Order { last, step },
            RecordError::Missed { due, step } => RecordError::Missed { due, step },
        }
    }
}

impl<N: Display> Display for RecordError<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RecordError::Sink => f.write_str("the record cannot be written"),
            RecordError::Name(name) => {
                write!(
                    f,
                    "`{name}` is not a valid name: it is empty or contains a control character"
                )
            }
            RecordError::Bodies { names, bodies } => {
                write!(f, "{names} names are given for {bodies} bodies")
            }
            RecordError::Values { names, given } => {
                write!(f, "{given} values are given for {names} names")
            }
            RecordError::Every => f.write_str("the sampling interval must be at least one step"),
            RecordError::Order { last, step } => {
                write!(f, "step {step} is not after the last sample, step {last}")
            }
            RecordError::Missed { due, step } => write!(
                f,
                "a sample was due at step {due}, but the plant is at step {step}: sample after every \
                 advance, by steps that divide the sampling interval"
            ),
        }
    }
}

impl<N: Display + fmt::Debug> core::error::Error for RecordError<N> {}

/// Writes a record.
#[derive(Clone, Debug)]
pub struct Recorder<W> {
    sink: W,
    chain: Chain,
    shape: Shape,
    samples: u64,
    last: Option<u64>,
}

/// Numbers of bodies, revolution counts and values in a row.
#[derive(Clone, Copy, Debug)]
struct Shape {
    bodies: usize,
    turns: usize,
    values: usize,
    number_format: NumberFormat,
    every: u64,
}

impl<W: Write> Recorder<W> {
    /// Writes the head.
    ///
    /// # Errors
    /// [`RecordError`] if names or interval are invalid, or the sink accepts no more.
    pub fn begin<'a>(sink: W, head: &Head<'a>) -> Result<Self, RecordError<&'a str>> {
        let identity = &head.identity;
        if head.bodies.len() != identity.bodies {
            let (names, bodies) = (head.bodies.len(), identity.bodies);
            return Err(RecordError::Bodies { names, bodies });
        }
        if let Some(name) = head.unfit_name() {
            return Err(RecordError::Name(name));
        }
        if head.every == 0 {
            return Err(RecordError::Every);
        }
        let shape = Shape {
            bodies: identity.bodies,
            turns: identity.turns,
            values: head.values.len(),
            number_format: identity.number_format,
            every: head.every,
        };
        let mut recorder = Self { sink, chain: Chain::new(), shape, samples: 0, last: None };
        let mut to = Chained { to: &mut recorder.sink, chain: &mut recorder.chain };
        head.write(&mut to).map_err(|_| RecordError::Sink)?;
        Ok(recorder)
    }

    /// The step of the next sample; the first sample is at the plant's present step.
    #[must_use]
    pub fn due(&self) -> Option<u64> {
        self.last.map(|last| last.saturating_add(self.shape.every))
    }

    /// Records a sample if one is due; returns whether one was.
    ///
    /// # Errors
    /// [`RecordError::Missed`] where the plant is beyond it, [`RecordError::Values`],
    /// [`RecordError::Sink`].
    pub fn look(
        &mut self,
        moment: &(impl Moment + ?Sized),
        values: &[f64],
    ) -> Result<bool, RecordError<&'static str>> {
        let step = moment.steps_done();
        match self.due() {
            Some(due) if step < due => Ok(false),
            Some(due) if step > due => Err(RecordError::Missed { due, step }),
            _ => self.sample(moment, values).map(|()| true),
        }
    }

    /// Records a sample at any step: the last one may be early.
    ///
    /// # Errors
    /// [`RecordError::Order`] if it is not after the last, [`RecordError::Bodies`], [`RecordError::Values`],
    /// [`RecordError::Sink`].
    pub fn sample(
        &mut self,
        moment: &(impl Moment + ?Sized),
        values: &[f64],
    ) -> Result<(), RecordError<&'static str>> {
        let (shape, step) = (self.shape, moment.steps_done());
        if let Some(last) = self.last.filter(|last| step <= *last) {
            return Err(RecordError::Order { last, step });
        }
        if values.len() != shape.values {
            return Err(RecordError::Values { names: shape.values, given: values.len() });
        }
        let bodies =
            (0..shape.bodies).take_while(|row| moment.body_numbers(*row).is_some()).count();
        if bodies != shape.bodies {
            return Err(RecordError::Bodies { names: shape.bodies, bodies });
        }
        let mut to = Chained { to: &mut self.sink, chain: &mut self.chain };
        row(&shape, moment, values, &mut to).map_err(|_| RecordError::Sink)?;
        let chain = self.chain.0;
        writeln!(self.sink, "\t{chain:016x}").map_err(|_| RecordError::Sink)?;
        self.chain.add("\n");
        self.last = Some(step);
        self.samples += 1;
        Ok(())
    }

    /// Writes the last line, which completes the record, and returns the sink.
    ///
    /// # Errors
    /// [`RecordError::Sink`].
    pub fn finish(mut self) -> Result<W, RecordError<&'static str>> {
        let end = Ending { samples: self.samples, chain: self.chain };
        writeln!(self.sink, "{end}").map_err(|_| RecordError::Sink)?;
        Ok(self.sink)
    }
}

/// The last line.
pub(crate) struct Ending {
    pub(crate) samples: u64,
    pub(crate) chain: Chain,
}

impl Display for Ending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "# end: {} samples\t{:016x}", self.samples, self.chain.0)
    }
}

fn row(
    shape: &Shape,
    moment: &(impl Moment + ?Sized),
    values: &[f64],
    to: &mut impl Write,
) -> fmt::Result {
    write!(to, "{}\t{:016x}", moment.steps_done(), moment.state_hash())?;
    for body in (0..shape.bodies).filter_map(|row| moment.body_numbers(row)) {
        for (column, value) in body.into_iter().enumerate() {
            to.write_char('\t')?;
            shape.number_format.of_column(column).write(value, to)?;
        }
    }
    for spring in 0..shape.turns {
        write!(to, "\t{}", moment.turn_count(spring).unwrap_or_default())?;
    }
    for value in values {
        to.write_char('\t')?;
        shape.number_format.value.write(*value, to)?;
    }
    Ok(())
}
