//! A row of costs: as the program prints it, as docs/costs.csv holds it.

use std::fmt::Write as _;

use anyhow::{Context as _, Result, bail};

const HEADER: &str = "scene,scheme,precision,step_s,instructions_mean,instructions_max,\
                      instructions_held,text_bytes,rodata_bytes,plant_ram_bytes,stack_bytes,estimated_rate_168mhz_hz";
/// \[Hz\] a common clock of Cortex-M4F parts.
const CLOCK: f64 = 168e6;
/// Cycles per instruction assumed for the estimated rate. Cortex-M4 takes one for most, two for
/// loads, 14 for a division or a square root in single precision (Technical Reference Manual,
/// DDI 0439, tables 3-1 and 7-1); memory without wait states.
const CYCLES_PER_INSTRUCTION: f64 = 1.5;

/// What a step of one combination costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// The scene.
    pub scene: String,
    /// The scheme with its variant.
    pub scheme: String,
    /// `f32` or `f64`.
    pub precision: String,
    /// \[s\] the step.
    pub step: f64,
    /// Instructions per step, mean; every input is set in every step.
    pub mean: u64,
    /// Instructions of the dearest step.
    pub max: u64,
    /// Instructions per step, mean, where nothing sets the inputs.
    pub held: u64,
    /// \[bytes\] code, where the audit's image holds the step.
    pub text: Option<u64>,
    /// \[bytes\] the const model.
    pub model: u64,
    /// \[bytes\] state, scratch and diagonals.
    pub plant: u64,
    /// \[bytes\] stack below the call.
    pub stack: u64,
}

impl Cost {
    /// Reads `cost SCENE SCHEME PRECISION STEP_NS MEAN MAX HELD PLANT MODEL STACK`.
    pub fn parse(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let ["cost", scene, scheme, precision, step, mean, max, held, plant, model, stack] =
            words[..]
        else {
            return None;
        };
        Some(Self {
            scene: scene.to_owned(),
            scheme: scheme.to_owned(),
            precision: precision.to_owned(),
            step: step.parse::<u64>().ok()? as f64 * 1e-9,
            mean: mean.parse().ok()?,
            max: max.parse().ok()?,
            held: held.parse().ok()?,
            text: None,
            model: model.parse().ok()?,
            plant: plant.parse().ok()?,
            stack: stack.parse().ok()?,
        })
    }

    /// Scene, scheme and precision.
    pub fn name(&self) -> String {
        format!("{} {} {}", self.scene, self.scheme, self.precision)
    }

    pub fn rate(&self) -> u64 {
        (CLOCK / (CYCLES_PER_INSTRUCTION * self.max as f64)) as u64
    }
}

/// The rows as a file.
pub fn csv(costs: &[Cost]) -> String {
    let mut text = format!("{HEADER}\n");
    for c in costs {
        let _ = writeln!(
            text,
            "{},{},{},{:e},{},{},{},{},{},{},{},{}",
            c.scene,
            c.scheme,
            c.precision,
            c.step,
            c.mean,
            c.max,
            c.held,
            c.text.map(|bytes| bytes.to_string()).unwrap_or_default(),
            c.model,
            c.plant,
            c.stack,
            c.rate()
        );
    }
    text
}

/// The rows of a file.
///
/// # Errors
/// Where its header or a row is not as [`csv`] writes them.
pub fn read(text: &str) -> Result<Vec<Cost>> {
    if text.lines().next() != Some(HEADER) {
        bail!("unexpected header of the cost file");
    }
    let row = |line| read_row(line).with_context(|| format!("cannot read the row `{line}`"));
    text.lines().skip(1).map(row).collect()
}

fn read_row(line: &str) -> Option<Cost> {
    let columns: Vec<&str> = line.split(',').collect();
    let [scene, scheme, precision, step, mean, max, held, text, model, plant, stack, _rate] =
        columns[..]
    else {
        return None;
    };
    Some(Cost {
        scene: scene.to_owned(),
        scheme: scheme.to_owned(),
        precision: precision.to_owned(),
        step: step.parse().ok()?,
        mean: mean.parse().ok()?,
        max: max.parse().ok()?,
        held: held.parse().ok()?,
        text: if text.is_empty() { None } else { Some(text.parse().ok()?) },
        model: model.parse().ok()?,
        plant: plant.parse().ok()?,
        stack: stack.parse().ok()?,
    })
}

/// The rows among a program's lines.
pub fn parse(lines: &[String]) -> Result<Vec<Cost>> {
    let rows = lines.iter().filter(|line| line.starts_with("cost "));
    rows.map(|line| Cost::parse(line).with_context(|| format!("cannot read `{line}`"))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_becomes_a_row_and_back() {
        let mut cost =
            Cost::parse("cost four-bar dbd f32 100000 9000 10000 8800 600 800 400").unwrap();
        cost.text = Some(7000);
        let row = "four-bar,dbd,f32,1e-4,9000,10000,8800,7000,800,600,400,11200";
        let text = csv(std::slice::from_ref(&cost));
        assert_eq!(text.lines().last(), Some(row));
        assert_eq!(read(&text).unwrap(), [cost]);
        assert_eq!(Cost::parse("cost four-bar dbd f32 refused"), None);
        assert!(read("scene\n").is_err());
        assert!(read(&format!("{HEADER}\nfour-bar,dbd\n")).is_err());
    }

    #[test]
    fn a_row_may_lack_the_text() {
        let cost =
            Cost::parse("cost four-bar dbd+1 f32 100000 9000 10000 8800 600 800 400").unwrap();
        let text = csv(std::slice::from_ref(&cost));
        let row = "four-bar,dbd+1,f32,1e-4,9000,10000,8800,,800,600,400,11200";
        assert_eq!(text.lines().last(), Some(row));
        assert_eq!(read(&text).unwrap(), [cost]);
    }
}
