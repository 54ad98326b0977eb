//! Controllers, which set the inputs: constants, noise, or a child process that reads and writes lines.

use std::io::{self, BufRead as _, BufReader, Write as _};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use fastrand::Rng;
use serde_json::{Map, Value};
use thiserror::Error;

use crate::message::Values;

/// The plant data for a controller.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'s> {
    /// Steps since t = 0.
    pub step: u64,
    /// \[s\] the time.
    pub time: f64,
    /// Values of the sensors.
    pub sensors: &'s [f64],
}

/// A controller, which sets the inputs.
#[allow(clippy::large_enum_variant)]
pub enum Controller {
    /// All inputs are 0.
    Zero,
    /// Uniformly distributed within ± an amplitude, from a seed: for comparisons of bits.
    Noise {
        /// \[N, N·m or m\].
        amplitude: f64,
        /// The generator.
        random: Rng,
    },
    /// A function.
    Function(Box<dyn FnMut(Shown<'_>) -> Vec<f64> + Send>),
    /// A child process.
    Process(Process),
}

/// Why a controller did not set the inputs.
#[derive(Debug, Error)]
pub enum ControllerError {
    /// The command is invalid.
    #[error("`{0}` is not a command: a quotation mark is missing")]
    Command(String),
    /// It did not start.
    #[error("cannot start the controller `{command}`: {reason}")]
    Start {
        /// The command.
        command: String,
        /// The reason.
        reason: io::Error,
    },
    /// It ended.
    #[error("the controller `{command}` ended: {status}")]
    Ended {
        /// The command.
        command: String,
        /// Its exit status.
        status: String,
    },
    /// It did not answer.
    #[error("the controller `{command}` did not answer a line within {seconds} s")]
    Silent {
        /// The command.
        command: String,
        /// \[s\] the time limit.
        seconds: f64,
    },
    /// Its answer is invalid.
    #[error("the controller `{command}` answered `{line}`: {reason}")]
    Answer {
        /// The command.
        command: String,
        /// Its answer.
        line: String,
        /// The problem.
        reason: String,
    },
}

/// Format of lines to and from a controller.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Numbers separated by commas; the first line to the controller contains the names.
    #[default]
    Csv,
    /// An object per line, by names.
    Json,
}

/// A controller as a child process: it gets a line per frame and answers with one.
pub struct Process {
    command: String,
    child: Child,
    input: ChildStdin,
    lines: Receiver<String>,
    format: Format,
    limit: Duration,
    inputs: Vec<String>,
    sensors: Vec<String>,
}

impl Process {
    /// Starts a command, split into words like in a shell. `limit` is the time limit for an answer.
    ///
    /// # Errors
    /// [`ControllerError::Command`], [`ControllerError::Start`], [`ControllerError::Ended`].
    pub fn start(
        command: &str,
        format: Format,
        limit: Duration,
        [inputs, sensors]: [&[String]; 2],
    ) -> Result<Self, ControllerError> {
        let words = shlex::split(command).filter(|words| !words.is_empty());
        let words = words.ok_or_else(|| ControllerError::Command(command.to_owned()))?;
        let failed = |reason| ControllerError::Start { command: command.to_owned(), reason };
        let mut child = Command::new(&words[0])
            .args(&words[1..])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(failed)?;
        let (input, output) = (child.stdin.take(), child.stdout.take());
        let (Some(input), Some(output)) = (input, output) else {
            return Err(failed(io::ErrorKind::BrokenPipe.into()));
        };
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        let (inputs, sensors) = (inputs.to_vec(), sensors.to_vec());
        let command = command.to_owned();
        let mut own = Self { command, child, input, lines, format, limit, inputs, sensors };
        if format == Format::Csv {
            let names = ["step", "time"].map(str::to_owned).into_iter().chain(own.sensors.clone());
            own.say(&names.collect::<Vec<_>>().join(","))?;
        }
        Ok(own)
    }

    fn say(&mut self, line: &str) -> Result<(), ControllerError> {
        let said = writeln!(self.input, "{line}").and_then(|()| self.input.flush());
        said.map_err(|_| self.ended())
    }

    fn ended(&mut self) -> ControllerError {
        // Its output is closed, so it is about to end.
        let status = self.child.wait().map_or_else(|error| error.to_string(), |s| s.to_string());
        ControllerError::Ended { command: self.command.clone(), status }
    }

    fn answer(&mut self, shown: Shown<'_>) -> Result<Vec<f64>, ControllerError> {
        self.say(&self.line(shown))?;
        let line = match self.lines.recv_timeout(self.limit) {
            Ok(line) => line,
            Err(RecvTimeoutError::Disconnected) => return Err(self.ended()),
            Err(RecvTimeoutError::Timeout) => {
                let (command, seconds) = (self.command.clone(), self.limit.as_secs_f64());
                return Err(ControllerError::Silent { command, seconds });
            }
        };
        let read = match self.format {
            Format::Csv => csv(&line, &self.inputs),
            Format::Json => json(&line, &self.inputs),
        };
        read.map_err(|reason| ControllerError::Answer {
            command: self.command.clone(),
            line,
            reason,
        })
    }

    fn line(&self, Shown { step, time, sensors }: Shown<'_>) -> String {
        match self.format {
            Format::Csv => sensors
                .iter()
                .fold(format!("{step},{time}"), |line, value| line + &format!(",{value}")),
            Format::Json => {
                let mut object = Map::new();
                object.insert("step".to_owned(), step.into());
                object.insert("time".to_owned(), time.into());
                for (name, value) in self.sensors.iter().zip(sensors) {
                    // NaN becomes null.
                    object.insert(name.clone(), Value::from(*value));
                }
                Value::Object(object).to_string()
            }
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        _ = self.child.kill();
        _ = self.child.wait();
    }
}

/// Reads one number per input.
fn csv(line: &str, inputs: &[String]) -> Result<Vec<f64>, String> {
    let words = line.split(',').map(str::trim).filter(|word| !word.is_empty());
    let numbers = words.map(|word| match word.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("`{word}` is not a finite number")),
    });
    let numbers = numbers.collect::<Result<Vec<_>, _>>()?;
    if numbers.len() == inputs.len() {
        Ok(numbers)
    } else {
        let (count, names) = (numbers.len(), inputs.join(","));
        Err(format!("{count} numbers given for the inputs {names}"))
    }
}

/// Reads an object with all inputs by name.
fn json(line: &str, inputs: &[String]) -> Result<Vec<f64>, String> {
    let object: Map<String, Value> =
        serde_json::from_str(line).map_err(|error| format!("not a JSON object: {error}"))?;
    if let Some(name) = object.keys().find(|name| !inputs.contains(name)) {
        return Err(format!("unknown input `{name}`; the inputs are {}", inputs.join(", ")));
    }
    let number = |name: &String| match object.get(name).map(Value::as_f64) {
        Some(Some(number)) => Ok(number),
        Some(None) => Err(format!("`{name}` is not a number")),
        None => Err(format!("`{name}` is missing")),
    };
    inputs.iter().map(number).collect()
}

impl Controller {
    /// Noise within ± `amplitude` from a seed.
    #[must_use]
    pub fn noise(amplitude: f64, seed: u64) -> Self {
        Self::Noise { amplitude, random: Rng::with_seed(seed) }
    }

    /// The values of the given number of inputs.
    ///
    /// # Errors
    /// [`ControllerError`].
    pub fn next(&mut self, shown: Shown<'_>, inputs: usize) -> Result<Values, ControllerError> {
        let values = match self {
            Self::Zero => vec![0.0; inputs],
            Self::Noise { amplitude, random } => {
                (0..inputs).map(|_| *amplitude * (2.0 * random.f64() - 1.0)).collect()
            }
            Self::Function(function) => function(shown),
            Self::Process(process) => process.answer(shown)?,
        };
        Ok(values.into_iter().take(inputs).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_read_or_refused_with_a_reason() {
        let inputs = ["a".to_owned(), "b".to_owned()];
        assert_eq!(csv(" 1, -2.5e3 ", &inputs).unwrap(), [1.0, -2500.0]);
        assert_eq!(csv("", &[]).unwrap(), [0.0; 0]);
        assert_eq!(json(r#"{"b": 2, "a": 1.5}"#, &inputs).unwrap(), [1.5, 2.0]);
        for (line, reason) in
            [("1", "1 numbers"), ("1,x", "`x`"), ("1,nan", "`nan`"), ("1,2,3", "3 numbers")]
        {
            assert!(csv(line, &inputs).unwrap_err().contains(reason), "{line}");
        }
        for (line, reason) in [
            ("[]", "not a JSON object"),
            (r#"{"a": 1}"#, "`b` is missing"),
            (r#"{"a": 1, "b": "x"}"#, "`b` is not a number"),
            (r#"{"a": 1, "b": 2, "c": 3}"#, "unknown input `c`"),
        ] {
            assert!(json(line, &inputs).unwrap_err().contains(reason), "{line}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn processes_answer_end_or_are_silent() {
        let names = ["u".to_owned()];
        let start = |command, limit| {
            let names: [&[String]; 2] = [&names, &names];
            Process::start(command, Format::Csv, Duration::from_millis(limit), names)
        };
        let shown = Shown { step: 3, time: 0.5, sensors: &[7.0] };
        // The first line contains the names.
        let mut echo =
            start("sh -c 'read head; while read line; do echo \"${line##*,}\"; done'", 10_000)
                .unwrap();
        assert_eq!(echo.answer(shown).unwrap(), [7.0]);
        let ends = start("sh -c 'exit 3'", 10_000).and_then(|mut ends| ends.answer(shown));
        assert!(ends.unwrap_err().to_string().contains("exit status: 3"));
        let silent = start("sleep 20", 50).unwrap().answer(shown).unwrap_err().to_string();
        assert!(silent.contains("within 0.05 s"), "{silent}");
        assert!(start("'", 50).is_err());
        let absent = start("no-such-program-here", 50).err().unwrap().to_string();
        assert!(absent.contains("cannot start"), "{absent}");
    }
}
