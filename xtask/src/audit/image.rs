//! The contents of a linked image: symbols, functions and calls.
//!
//! `ELF => symbols, functions by address`, read from GNU binutils' listings.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, Result, bail};

use crate::command::{output, program};

/// A linked image.
#[derive(Debug, Default)]
pub struct Image {
    symbols: Vec<Symbol>,
    functions: BTreeMap<u64, Function>,
}

#[derive(Debug, PartialEq)]
struct Symbol {
    address: u64,
    /// The first address after it, if its size is known.
    end: Option<u64>,
    /// Demangled.
    name: String,
}

/// A function of an image.
#[derive(Debug, Default, PartialEq)]
pub struct Function {
    /// Demangled names: bodies that are equal may be one function.
    pub names: Vec<String>,
    /// \[bytes\] code with its literals, up to the next function.
    pub size: u64,
    /// The distinct mnemonics of its instructions.
    pub mnemonics: BTreeSet<String>,
    /// Its branches whose destination is in a register or in memory, without returns and the jumps of a
    /// table within it.
    pub indirect: BTreeSet<String>,
    /// Where its branches lead, outside of itself.
    pub(super) calls: BTreeSet<u64>,
}

impl Image {
    /// Reads an image.
    ///
    /// # Errors
    /// Where the tools cannot read it.
    pub fn read(elf: &Path) -> Result<Self> {
        let names = output(program("arm-none-eabi-nm").args(["--demangle", "-S"]).arg(elf))?;
        let listing = output(
            program("arm-none-eabi-objdump")
                .args(["--disassemble", "--demangle", "--no-show-raw-insn"])
                .arg(elf),
        )?;
        let symbols = symbols(&names);
        let image = Self { functions: functions(&listing, &symbols), symbols };
        if image.symbols.is_empty() || image.functions.is_empty() {
            bail!("{} contains no symbols or no code", elf.display());
        }
        Ok(image)
    }

    /// Demangled names of all symbols.
    pub fn symbols(&self) -> impl Iterator<Item = &str> {
        self.symbols.iter().map(|symbol| symbol.name.as_str())
    }

    /// Where the symbol of this name lies.
    ///
    /// # Errors
    /// If it is missing.
    pub fn address(&self, name: &str) -> Result<u64> {
        let symbol = self.symbols.iter().find(|symbol| symbol.name == name);
        Ok(symbol.with_context(|| format!("the image has no `{name}`"))?.address)
    }

    /// The function of this name and all that it reaches by calls.
    ///
    /// # Errors
    /// Where there is no function of the name.
    pub fn reach(&self, name: &str) -> Result<Vec<&Function>> {
        // By symbol: two functions of one body may share an address.
        let root = self.symbols.iter().find(|symbol| symbol.name == name);
        let root = root.with_context(|| format!("the image has no function `{name}`"))?;
        let (mut waiting, mut found) = (vec![root.address], BTreeMap::new());
        while let Some(address) = waiting.pop() {
            if let Some(function) = self.functions.get(&address)
                && found.insert(address, function).is_none()
            {
                waiting.extend(&function.calls);
            }
        }
        Ok(found.into_values().collect())
    }
}

/// The symbols of `nm`'s lines `ADDRESS [SIZE] KIND NAME`.
fn symbols(names: &str) -> Vec<Symbol> {
    let symbol = |line: &str| {
        let (address, rest) = line.split_once(' ')?;
        let address = u64::from_str_radix(address, 16).ok()?;
        let (size, rest) = match rest.split_once(' ')? {
            (size, rest) if size.len() > 1 => (u64::from_str_radix(size, 16).ok(), rest),
            _ => (None, rest),
        };
        let (_kind, name) = rest.split_once(' ')?;
        Some(Symbol { address, end: size.map(|size| address + size), name: name.to_owned() })
    };
    names.lines().filter_map(symbol).collect()
}

/// The functions of a listing, with all names that the symbols give them. What lies beyond a
/// function's known end is the linker's padding, which may read as a branch.
fn functions(listing: &str, symbols: &[Symbol]) -> BTreeMap<u64, Function> {
    let ends: BTreeMap<u64, Option<u64>> =
        symbols.iter().map(|symbol| (symbol.address, symbol.end)).collect();
    let mut functions: BTreeMap<u64, Function> = BTreeMap::new();
    let (mut start, mut end) = (0, 0);
    for line in listing.lines() {
        if let Some((address, name)) = header(line) {
            start = address;
            let mut names = vec![name];
            let others = symbols.iter().filter(|symbol| symbol.address == start);
            names.extend(others.map(|symbol| symbol.name.clone()));
            names.dedup();
            functions.insert(start, Function { names, ..Function::default() });
        } else if let Some((address, mnemonic, operands)) = instruction(line) {
            // A lone instruction of four bytes at the very end counts two too few; padding hides
            // it everywhere else.
            end = address + 2;
            let padding = ends.get(&start).copied().flatten().is_some_and(|last| address >= last);
            if let (Some(function), false) = (functions.get_mut(&start), padding) {
                function.mnemonics.insert(mnemonic.to_owned());
                function.calls.extend(branch(mnemonic, operands));
                function.indirect.extend(indirect(mnemonic, operands));
            }
        }
    }
    let starts: Vec<u64> = functions.keys().copied().collect();
    let enclosing = |address: u64| starts.iter().rev().find(|&&start| start <= address).copied();
    for (i, start) in starts.iter().enumerate() {
        let next = starts.get(i + 1).copied().unwrap_or(end);
        if let Some(function) = functions.get_mut(start) {
            function.size = next.saturating_sub(*start);
            function.calls = function.calls.iter().filter_map(|&call| enclosing(call)).collect();
            function.calls.remove(start);
        }
    }
    functions
}

/// `00020000 <name>:`
fn header(line: &str) -> Option<(u64, String)> {
    let (address, name) = line.strip_suffix(">:")?.split_once(" <")?;
    Some((u64::from_str_radix(address, 16).ok()?, name.to_owned()))
}

/// `   20000:<tab>bl<tab>24b70 <name+0x2>`
pub fn instruction(line: &str) -> Option<(u64, &str, &str)> {
    let mut columns = line.splitn(3, '\t');
    let address = columns.next()?.trim().strip_suffix(':')?;
    let address = u64::from_str_radix(address, 16).ok()?;
    Some((address, columns.next()?.trim(), columns.next().unwrap_or("")))
}

/// Where a branch with a fixed destination leads. Compare-and-branch stays in its function.
fn branch(mnemonic: &str, operands: &str) -> Option<u64> {
    let stem = mnemonic.split('.').next().unwrap_or(mnemonic);
    if !(stem.starts_with('b') && stem.len() <= 3) {
        return None;
    }
    let (address, _) = operands.split_once(" <")?;
    u64::from_str_radix(address.trim(), 16).ok()
}

/// A branch without a fixed destination that is no return, as it is written.
fn indirect(mnemonic: &str, operands: &str) -> Option<String> {
    // The disassembler's remarks follow a semicolon.
    let operands = operands.split(';').next().unwrap_or_default().trim();
    let exchanges = mnemonic.starts_with("bx") || mnemonic.starts_with("blx");
    let to_register = exchanges && operands != "lr" && !operands.contains('<');
    // The stack holds return addresses alone.
    let loads =
        mnemonic.starts_with("ldm") && operands.contains("pc") && !operands.starts_with("sp");
    let writes = operands.starts_with("pc,") && !operands.contains("[sp");
    (to_register || loads || writes).then(|| format!("{mnemonic} {operands}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LISTING: &str = "
00020000 <roots::dbd_f32>:
   20000:\tpush\t{r7, lr}
   20002:\tbl\t20010 <<A as B>::step>
   20006:\tbne.n\t20000 <roots::dbd_f32>
   20008:\tpop\t{r7, pc}

00020010 <<A as B>::step>:
   20010:\tvmul.f32\ts0, s0, s0
   20014:\tb.w\t20020 <leaf>

00020020 <leaf>:
   20020:\tbic\tr0, r1, r2
   20024:\tbx\tlr

00020026 <other>:
   20026:\tbx\tlr
";

    #[test]
    fn calls_are_followed_and_sizes_end_at_the_next_function() {
        let symbols = symbols("00020000 00000010 t roots::dbd_f32\n");
        let image = Image { functions: functions(LISTING, &[]), symbols };
        let reach = image.reach("roots::dbd_f32").unwrap();
        let names: Vec<&str> = reach.iter().map(|f| f.names[0].as_str()).collect();
        assert_eq!(names, ["roots::dbd_f32", "<A as B>::step", "leaf"]);
        assert_eq!(reach.iter().map(|f| f.size).collect::<Vec<_>>(), [16, 16, 6]);
        assert!(reach[1].mnemonics.contains("vmul.f32"));
        assert!(image.reach("nothing").is_err());
    }

    #[test]
    fn names_keep_their_spaces() {
        let symbols = symbols("00020010 t <A as B>::step\n         U free\n");
        let name = "<A as B>::step".to_owned();
        assert_eq!(symbols, [Symbol { address: 0x20010, end: None, name }]);
    }

    #[test]
    fn padding_beyond_a_function_is_no_branch() {
        let listing = "
00020000 <short>:
   20000:\tbx\tlr
   20002:\tbmi.n\t20004 <next>

00020004 <next>:
   20004:\tbx\tlr
";
        let known = symbols("00020000 00000002 t short\n00020004 00000002 t next\n");
        let functions = functions(listing, &known);
        assert!(functions[&0x20000].calls.is_empty());
        assert!(!functions[&0x20000].mnemonics.contains("bmi.n"));
    }

    #[test]
    fn a_function_has_all_its_names() {
        let known = symbols("00020024 00000002 t leaf\n00020026 t other\n00020026 t twin\n");
        assert_eq!(functions(LISTING, &known)[&0x20026].names, ["other", "twin"]);
    }

    #[test]
    fn a_branch_to_a_register_is_indirect_and_a_return_is_not() {
        for (mnemonic, operands) in [
            ("blx", "r3"),
            ("bxne", "ip"),
            ("mov", "pc, r2"),
            ("ldr.w", "pc, [r0, r1, lsl #2]"),
            ("ldmia.w", "r0!, {r4, pc}"),
        ] {
            assert!(indirect(mnemonic, operands).is_some(), "{mnemonic} {operands}");
        }
        for (mnemonic, operands) in [
            ("bx", "lr"),
            ("blx", "20010 <leaf>"),
            ("ldr.w", "pc, [sp], #4"),
            ("ldmia.w", "sp!, {r4, pc}"),
            ("pop", "{r7, pc}"),
            ("tbb", "[pc, r0]"),
            ("ldr", "r0, [pc, #16]\t; (20030 <leaf>)"),
        ] {
            assert_eq!(indirect(mnemonic, operands), None, "{mnemonic} {operands}");
        }
    }
}
