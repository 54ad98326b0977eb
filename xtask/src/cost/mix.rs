//! Which instructions a step is made of, and an estimate of its cycles: docs/costs-mix.csv.
//!
//! `program cost in QEMU with the plugin examples/mix.rs, its disassembly => rows`. The program marks
//! its steps by calls of a function that does nothing else; the plugin counts instructions by
//! address from mark to mark; an empty call is subtracted, as from the counts by SysTick. Cycles
//! are an estimate by the manual's table, see `cycles`, never a measurement.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};

use crate::audit::{Image, instruction};
use crate::chip::{Toolchain, firmware};
use crate::command::{cargo, output, program, root, run as run_command, target_dir};

use super::cycles::{self, Class};
use super::row::{self, Cost};

pub const FILE: &str = "docs/costs-mix.csv";
/// Programs that count, each in an image of its own.
const PROGRAMS: [&str; 4] = ["cost", "cost-double", "cost-fixed", "cost-solved"];
/// The function whose calls are marks.
const MARK: &str = "firmware::cost::mark";
/// Calls between two marks.
const CALLS: u64 = 64;
/// Marks per row: before empty calls, before steps, after them.
const MARKS: u64 = 3;
/// The two ways of counting may lie this part of a count apart: SysTick's ticks are 0.6 instructions.
const APART: f64 = 1e-3;
/// The same of double precision in software: of its long steps SysTick has missed 0.2 %, for reasons unknown.
const APART_IN_SOFTWARE: f64 = 4e-3;

/// Instructions of a step by class, mean of the counted steps, and what cycles they may take.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mix {
    /// In the order of [`Class::ALL`].
    classes: [f64; 8],
    /// Least and most.
    cycles: [f64; 2],
}

impl Mix {
    /// All instructions.
    fn instructions(&self) -> f64 {
        self.classes.iter().sum()
    }

    /// Least and most cycles of a step.
    pub fn cycles(&self) -> [u64; 2] {
        self.cycles.map(|cycles| cycles.round() as u64)
    }

    /// The share of floating-point arithmetic, roots and divisions in all instructions.
    pub fn arithmetic(&self) -> f64 {
        (self.classes[0] + self.classes[1]) / self.instructions()
    }

    fn add(&mut self, mnemonic: &str, operands: &str, calls: f64) {
        let (class, cycles) = cycles::of(mnemonic, operands);
        self.classes[class as usize] += calls;
        for (sum, of_it) in self.cycles.iter_mut().zip(cycles) {
            *sum += calls * of_it as f64;
        }
    }
}

/// The plugin, and where it leaves its counts.
pub struct Plugin {
    instructions: BTreeMap<u64, (String, String)>,
    library: PathBuf,
    mark: u64,
    counts: PathBuf,
}

impl Plugin {
    /// Builds the plugin and reads the disassembly of an image.
    ///
    /// # Errors
    /// Where it does not build, or the image has no marks.
    pub fn new(image: &Path) -> Result<Self> {
        run_command(cargo().args(["build", "--package", "xtask", "--example", "mix"]))?;
        let library = target_dir().join("debug/examples/libmix.so");
        let mark = Image::read(image)?.address(MARK)?;
        let mut objdump = program("arm-none-eabi-objdump");
        let listing = output(objdump.args(["--disassemble", "--no-show-raw-insn"]).arg(image))?;
        let line = |line| {
            let (address, mnemonic, operands) = instruction(line)?;
            Some((address, (mnemonic.to_owned(), operands.to_owned())))
        };
        let instructions = listing.lines().filter_map(line).collect();
        Ok(Self { instructions, library, mark, counts: image.with_extension("mix") })
    }

    /// Options of the emulator that load it.
    pub fn options(&self) -> Vec<String> {
        let Self { library, mark, counts, .. } = self;
        let plugin = format!("{},mark={mark},out={}", library.display(), counts.display());
        vec!["-plugin".into(), plugin]
    }

    /// The mixes of the rows that the program has told, in their order.
    ///
    /// # Errors
    /// Where the counts cannot be read or are not those of the rows.
    pub fn mixes(&self, costs: &[Cost]) -> Result<Vec<Mix>> {
        let text = std::fs::read_to_string(&self.counts)
            .with_context(|| format!("cannot read {}", self.counts.display()))?;
        let mixes = mixes(&text, &self.instructions)?;
        if mixes.len() != costs.len() {
            bail!("the plugin counted {} pairs, the program {}", mixes.len(), costs.len());
        }
        for (cost, mix) in costs.iter().zip(&mixes) {
            let (counted, timed) = (mix.instructions(), cost.mean as f64);
            let apart = if cost.precision == "f64" { APART_IN_SOFTWARE } else { APART };
            if (counted - timed).abs() > apart * timed + 2.0 {
                let name = cost.name();
                bail!("{name}: {counted:.1} instructions by address, {timed} by SysTick");
            }
        }
        Ok(mixes)
    }
}

/// The mixes in the plugin's lines `MARK ADDRESS COUNT`.
fn mixes(text: &str, known: &BTreeMap<u64, (String, String)>) -> Result<Vec<Mix>> {
    let mut mixes: Vec<Mix> = Vec::new();
    for line in text.lines() {
        let mut words = line.split(' ').map(str::parse::<u64>);
        let (Some(Ok(mark)), Some(Ok(address)), Some(Ok(count)), None) =
            (words.next(), words.next(), words.next(), words.next())
        else {
            bail!("cannot read the plugin's line `{line}`");
        };
        // Counts before the first mark are never written.
        let Some(place) = mark.checked_sub(1) else { bail!("cannot read `{line}`") };
        let (row, part) = ((place / MARKS) as usize, place % MARKS);
        if part == MARKS - 1 {
            continue;
        }
        if mixes.len() <= row {
            mixes.resize(row + 1, Mix::default());
        }
        let Some((mnemonic, operands)) = known.get(&address) else {
            bail!("at {address:#x} the image has no instruction");
        };
        let sign = if part == 0 { -1.0 } else { 1.0 };
        mixes[row].add(mnemonic, operands, sign * count as f64 / CALLS as f64);
    }
    Ok(mixes)
}

/// Writes the rows.
///
/// # Errors
/// Where the file cannot be written.
pub fn write(toolchain: &Toolchain, costs: &[Cost], mixes: &[Mix]) -> Result<()> {
    let head = format!(
        "# Instructions of a step on a Cortex-M4F by class, the mean of {CALLS} steps; cycles are an \
         estimate by the table of the Technical Reference Manual, memory without wait states. Written \
         by `cargo xtask cost`, {}.\n",
        toolchain.describe_compiler()?
    );
    std::fs::write(root().join(FILE), head + &csv(costs, mixes))
        .with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    Ok(())
}

fn csv(costs: &[Cost], mixes: &[Mix]) -> String {
    let classes = Class::ALL.map(Class::name).join(",");
    let mut text =
        format!("scene,scheme,precision,{classes},estimated_cycles_least,estimated_cycles_most\n");
    for (cost, mix) in costs.iter().zip(mixes) {
        let counts = mix.classes.map(|count| format!("{count:.0}")).join(",");
        let [least, most] = mix.cycles();
        let name = cost.name().replace(' ', ",");
        let _ = writeln!(text, "{name},{counts},{least},{most}");
    }
    text
}

/// Runs the programs that count and returns their rows with their mixes.
///
/// # Errors
/// Where building, running or reading fails.
pub fn measure(toolchain: &Toolchain) -> Result<(Vec<Cost>, Vec<Mix>)> {
    firmware::build_all(toolchain, &PROGRAMS)?;
    let (mut costs, mut mixes) = (Vec::new(), Vec::new());
    for program in PROGRAMS {
        let plugin = Plugin::new(&firmware::build(toolchain, program)?)?;
        let lines = firmware::execute_with(toolchain, program, false, &[], &plugin.options())?;
        let counted = row::parse(&lines)?;
        mixes.extend(plugin.mixes(&counted)?);
        costs.extend(counted);
    }
    Ok((costs, mixes))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known() -> BTreeMap<u64, (String, String)> {
        let all = [(16, "vmul.f32", "s0, s1, s2"), (20, "bx", "lr"), (22, "ldr", "r0, [r1]")];
        all.map(|(address, m, o)| (address, (m.to_owned(), o.to_owned()))).into_iter().collect()
    }

    #[test]
    fn an_empty_call_is_subtracted_and_what_lies_between_is_nobodys() {
        // Two rows; the second has a load more.
        let text = "1 20 64\n2 16 640\n2 20 64\n3 22 7\n4 20 64\n5 16 640\n5 20 64\n5 22 64\n";
        let mixes = mixes(text, &known()).unwrap();
        assert_eq!(mixes.iter().map(Mix::instructions).collect::<Vec<_>>(), [10.0, 11.0]);
        assert_eq!(mixes.iter().map(Mix::cycles).collect::<Vec<_>>(), [[10, 20], [11, 22]]);
        assert_eq!(mixes[0].arithmetic(), 1.0);
        let cost = Cost::parse("cost four-bar dbd f32 100000 10 10 10 600 800 400").unwrap();
        let rows = csv(&[cost], &mixes[..1]);
        assert_eq!(rows.lines().last(), Some("four-bar,dbd,f32,10,0,0,0,0,0,0,0,10,20"));
    }

    #[test]
    fn what_is_not_the_plugins_is_refused() {
        for wrong in ["1 20\n", "1 20 x\n", "1 20 64 2\n", "1 24 64\n"] {
            assert!(mixes(wrong, &known()).is_err(), "{wrong}");
        }
    }
}
