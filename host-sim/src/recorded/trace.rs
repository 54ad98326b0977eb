//! The rows of a `trace.csv`, checked against its summary.
//!
//! `trace.csv, summary.json => rows; or the line that is damaged, truncated, edited or of another run`. Columns are
//! those of [`dbd_scene::Scene::columns`], texts those of [`crate::report::TraceWriter`]. Errors that only the whole
//! file shows are reported after the last row.

use std::path::{Path, PathBuf};

use dbd_golden::subject::BodyNumbers;
use dbd_kernel::words::{Fnv1a, Word, WordVisitor as _};
use dbd_plant::number_format::{Digits, NumberFormat};
use dbd_plant::time::display;
use dbd_plant::{Named as _, OrientationName, PrecisionName};
use dbd_scene::TraceColumns;

use crate::recorded::head::{Head, Kind, Value};
use crate::recorded::lines::Lines;
use crate::recorded::row::Row;
use crate::recorded::row_text::{digits_of, fields, place, read, separated};
use crate::recorded::summary::RunSummary;
use crate::recorded::unreadable::Unreadable;

/// Bytes of the lines before the first row, at most.
const LONGEST_HEAD: u64 = 256 << 20;

/// Bytes of a number with its comma, at most.
const LONGEST_NUMBER: u64 = 32;

/// Times are whole multiples of the step, relative.
const ROUNDING: f64 = 1e-9;

/// The remedy for an incomplete trace.
const AGAIN: &str = "run the scene again: its trace and its summary belong together";

/// The number of rows of a trace if no summary states it.
fn count(file: &Path, header: &str) -> Result<u64, Unreadable> {
    let mut lines = Lines::open(file)?;
    let (mut rows, mut begun) = (0, false);
    while let Some(line) = lines.next(LONGEST_HEAD)? {
        rows += u64::from(begun);
        begun |= line == header;
    }
    Ok(rows)
}

/// A list in a message.
fn listed(names: &str) -> &str {
    if names.is_empty() { "none" } else { names }
}

/// A trace, read row by row.
#[derive(Debug)]
pub struct TraceReader {
    lines: Lines,
    names: Vec<String>,
    summary: RunSummary,
    number_format: NumberFormat,
    summary_file: PathBuf,
    samples: u64,
    rows: u64,
    /// Steps from row to row, once two are known.
    stride: Option<u64>,
    /// Whether the last row came early, so that none may follow.
    early: bool,
    row: Row,
    ended: bool,
}

impl TraceReader {
    /// Opens a trace with its summary and reads its head.
    ///
    /// # Errors
    /// If one of them cannot be read, or they do not belong together.
    pub fn open(file: &Path, summary_file: &Path) -> Result<(Head, Self), Unreadable> {
        let summary = RunSummary::read(summary_file)?;
        let names = (&*summary.precision, &*summary.orientation);
        let Some(number_format) = NumberFormat::of_names(names.0, names.1) else {
            let problem = format!("unknown precision `{}`", names.0);
            return Err(Unreadable::new(summary_file, problem));
        };
        let mut lines = Lines::open(file)?;
        let Some(header) = lines.next(LONGEST_HEAD)?.map(str::to_owned) else {
            return Err(lines
                .wrong("the file ends before the names of the columns")
                .with_remedy(AGAIN));
        };
        let names = fields(&header);
        let columns = TraceColumns::of(&names).map_err(|unlike| {
            let wrong = lines.wrong(format!("column {}: {}", unlike.place + 1, unlike.problem));
            let wrong = wrong.at_column(place(&header, unlike.place));
            wrong.with_remedy(separated(&header).unwrap_or(AGAIN))
        })?;
        let known: Vec<&str> = summary.readouts.iter().map(|column| column.name.as_str()).collect();
        if known != columns.readouts.iter().map(String::as_str).collect::<Vec<_>>() {
            let (has, says) = (columns.readouts.join(", "), known.join(", "));
            let problem = format!(
                "the read-outs are {}, those of {} {}: a column is missing, or the files belong to different runs",
                listed(&has),
                summary_file.display(),
                listed(&says),
            );
            return Err(lines.wrong(problem).with_remedy(AGAIN));
        }
        let values = summary
            .readouts
            .iter()
            .map(|column| Value { name: column.name.clone(), unit: Some(column.unit.clone()) });
        let mut unchecked = Vec::new();
        if summary.trace_hash.is_none() {
            unchecked.push(format!(
                "{} was written by an earlier version without a hash of its trace: edited numbers cannot be detected",
                summary_file.display()
            ));
        }
        let head = Head {
            file: file.to_owned(),
            kind: Kind::Run,
            scene: summary.scene.clone(),
            scheme: summary.scheme.clone(),
            newton: summary.newton,
            rho: summary.rho,
            damping: summary.damping.clone(),
            precision: summary.precision.clone(),
            orientation: summary.orientation.clone(),
            step: summary.step,
            samples: summary.samples.map_or_else(|| count(file, &header), Ok)?,
            number_format,
            bodies: columns.bodies,
            values: values.collect(),
            status: Some(summary.status.clone()),
            set: summary.set.clone(),
            scene_file: summary.scene_file.clone(),
            scene_hash: summary.scene_hash.clone(),
            model: None,
            version: summary.version.clone(),
            unchecked,
        };
        let row = Row {
            bodies: vec![BodyNumbers::default(); head.bodies.len()],
            values: vec![0.0; head.values.len()],
            ..Row::default()
        };
        let summary_file = summary_file.to_owned();
        let (samples, rows, stride, early, ended) = (head.samples, 0, None, false, false);
        let reader = Self {
            lines,
            names,
            summary,
            number_format,
            summary_file,
            samples,
            rows,
            stride,
            early,
            row,
            ended,
        };
        Ok((head, reader))
    }

    /// The next row; `None` after the last, if all of them match the summary.
    ///
    /// # Errors
    /// An error in the row or in the whole trace.
    pub fn next_row(&mut self) -> Result<Option<&Row>, Unreadable> {
        if self.ended {
            return Ok(None);
        }
        let limit = LONGEST_NUMBER * self.names.len() as u64;
        let Some(line) = self.lines.next(limit)? else {
            self.ended = true;
            self.end()?;
            return Ok(None);
        };
        let before = self.row.step;
        let read = read(line, &self.names, self.number_format, &mut self.row);
        if !self.lines.is_whole() {
            let cut = self.lines.wrong("the file ends within this line: it was truncated");
            return Err(cut.with_remedy(AGAIN));
        }
        if let Err(wrong) = read {
            return Err(self.lines.wrong(wrong.problem).at_column(wrong.column).with_remedy(AGAIN));
        }
        self.in_order(before)?;
        self.rows += 1;
        if self.samples == self.rows {
            self.row.hash = self.summary.state_hash.as_deref().and_then(RunSummary::hash);
        }
        Ok(Some(&self.row))
    }

    /// Checks that the rows are equally spaced.
    fn in_order(&mut self, before: u64) -> Result<(), Unreadable> {
        let time = self.row.time;
        let steps = (time / self.summary.step).round();
        let whole = (steps * self.summary.step - time).abs() <= ROUNDING * time.abs();
        if !(whole && (0.0..9e15).contains(&steps)) {
            let problem = format!(
                "the time {time} s is not a multiple of the step, {} s, in {}",
                self.summary.step,
                self.summary_file.display()
            );
            return Err(self.lines.wrong(problem).at_column(1));
        }
        let step = steps as u64;
        if self.rows == 0 {
            if step == 0 {
                return Ok(());
            }
            let problem =
                format!("the first row is at t = {}, not at 0: rows are missing", display(time));
            return Err(self.lines.wrong(problem).with_remedy(AGAIN));
        }
        let wrong = |problem: String| Err(self.lines.wrong(problem).with_remedy(AGAIN));
        if step <= before {
            return wrong(format!(
                "the time {} is not after that of the previous row",
                display(time)
            ));
        }
        let stride = *self.stride.get_or_insert(step - before);
        if self.early || step - before > stride {
            let (rows, here) = (stride as f64 * self.summary.step, display(time));
            return wrong(format!(
                "rows are missing before this one, t = {here}: they come every {}",
                display(rows)
            ));
        }
        self.early = step - before < stride;
        self.row.step = step;
        Ok(())
    }

    /// Checks the whole trace against the summary.
    fn end(&mut self) -> Result<(), Unreadable> {
        let summary = &self.summary;
        let named = self.summary_file.display();
        let wrong = |problem: String| Err(self.lines.wrong(problem).with_remedy(AGAIN));
        if self.rows == 0 {
            return wrong("the trace has no rows: its run failed before the first sample".into());
        }
        if !self.lines.is_whole() {
            return wrong("the file ends within this line: it was truncated".into());
        }
        let last = self.row.time;
        let rest = summary.duration - last;
        let missing = match self.stride {
            // A run that failed did so before its next sample.
            Some(stride) if summary.status != "ok" => rest > (stride as f64 + 0.5) * summary.step,
            _ if summary.status != "ok" => false,
            _ => rest > ROUNDING * summary.duration,
        };
        if missing || summary.samples.is_some_and(|samples| samples > self.rows) {
            let of = summary.samples.map(|all| format!(" of {all} rows")).unwrap_or_default();
            return wrong(format!(
                "the trace ends after {}{of}, at t = {}, but {named} states a run to {}: rows are missing",
                self.rows,
                display(last),
                display(summary.duration),
            ));
        }
        if rest < -ROUNDING * summary.duration || summary.samples.is_some_and(|all| all < self.rows)
        {
            return wrong(format!(
                "the trace has {} rows, to t = {}, more than {named} says: {}, to t = {}",
                self.rows,
                display(last),
                summary.samples.map_or("no number".into(), |all| all.to_string()),
                display(summary.duration),
            ));
        }
        if self.state_differs() {
            return wrong(format!(
                "the last row does not match `state_hash` in {named}: it was edited, or the files belong to \
                 different runs"
            ));
        }
        if let Some(hash) =
            summary.trace_hash.as_ref().filter(|hash| **hash != self.lines.hash().text())
        {
            return Err(Unreadable::new(
                self.lines.file(),
                format!(
                    "the text is not the one that was written: its hash is {}, {named} has `trace_hash` {hash}; a \
                     number or a name was edited, or they are of different runs",
                    self.lines.hash().text()
                ),
            )
            .with_remedy(AGAIN));
        }
        Ok(())
    }

    /// Whether the last row's state has another hash than the summary says.
    fn state_differs(&self) -> bool {
        let summary = &self.summary;
        let Some(hash) = &summary.state_hash else { return false };
        // With Euler angles and fixed point the stored words differ from the columns; earlier summaries lack the
        // revolution counts.
        let plain = PrecisionName::of_name(&summary.precision).is_none_or(PrecisionName::is_plain);
        if !plain
            || summary.orientation != OrientationName::Quaternion.name()
            || summary.trace_hash.is_none()
        {
            return false;
        }
        let word = |digits, value: f64| match digits {
            Digits::Single => Word::F32(value as f32),
            Digits::Double => Word::F64(value),
        };
        let mut state = Fnv1a::new();
        for body in &self.row.bodies {
            for (column, value) in body.iter().enumerate() {
                state.word(word(digits_of(self.number_format, column), *value));
            }
        }
        summary.turns.iter().for_each(|turns| state.word(Word::I32(*turns)));
        state.word(Word::U64(self.row.step));
        format!("{:016x}", state.finish()) != *hash
    }
}
