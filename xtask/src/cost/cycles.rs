//! What class an instruction is of, and how many cycles it may take.
//!
//! `(mnemonic, operands) => class, least and most cycles`, by the Technical Reference Manual of the
//! Cortex-M4, DDI 0439, tables 3-1 and 7-1: memory without wait states. Of a load or store of one
//! word the least is what it takes among others of its kind; of a branch that of one that is not
//! taken; of floating-point arithmetic the most is one more, where the next instruction waits for it.

/// Classes of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Floating-point additions, multiplications, conversions.
    Arithmetic,
    /// Floating-point divisions and square roots.
    Division,
    /// Floating-point comparisons, their flags.
    Comparison,
    /// Moves from, to and between floating-point registers.
    Move,
    /// Loads and stores of floating-point registers.
    FloatMemory,
    /// Other loads and stores.
    Memory,
    /// Branches, calls, returns, conditions of what follows.
    Branch,
    /// Everything else: addresses, counters, soft floating point.
    Integer,
}

impl Class {
    /// All, in the order of the columns.
    pub const ALL: [Self; 8] = [
        Self::Arithmetic,
        Self::Division,
        Self::Comparison,
        Self::Move,
        Self::FloatMemory,
        Self::Memory,
        Self::Branch,
        Self::Integer,
    ];

    /// Its column.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Arithmetic => "fp_arithmetic",
            Self::Division => "fp_divide_root",
            Self::Comparison => "fp_compare",
            Self::Move => "fp_move",
            Self::FloatMemory => "fp_load_store",
            Self::Memory => "load_store",
            Self::Branch => "branch",
            Self::Integer => "integer",
        }
    }
}

/// Cycles that a pipeline takes to be filled again.
const REFILL: [u64; 2] = [1, 3];

/// The class of an instruction, its least and its most cycles.
pub fn of(mnemonic: &str, operands: &str) -> (Class, [u64; 2]) {
    let stem = mnemonic.split('.').next().unwrap_or(mnemonic);
    let begins = |beginnings: &[&str]| beginnings.iter().any(|name| stem.starts_with(name));
    let count = registers(operands);
    let to_pc = writes_pc(stem, operands);
    let with_refill = |[least, most]: [u64; 2]| match to_pc {
        true => [least + REFILL[0], most + REFILL[1]],
        false => [least, most],
    };
    if stem.starts_with('v') {
        return if begins(&["vldm", "vstm", "vpush", "vpop"]) {
            (Class::FloatMemory, [1 + count, 1 + count])
        } else if begins(&["vldr", "vstr"]) {
            // Of two words one more.
            let words = 1 + u64::from(operands.starts_with('d'));
            (Class::FloatMemory, [words, 1 + words])
        } else if begins(&["vdiv", "vsqrt"]) {
            (Class::Division, [14, 15])
        } else if begins(&["vcmp", "vmrs", "vmsr"]) {
            (Class::Comparison, [1, 1])
        } else if begins(&["vmov"]) {
            // Two core registers take two.
            let core = operands.split(',').filter(|operand| is_core(operand)).count() as u64;
            (Class::Move, [core.max(1), core.max(1)])
        } else if begins(&["vmla", "vmls", "vnmla", "vnmls", "vfma", "vfms", "vfnm"]) {
            (Class::Arithmetic, [3, 4])
        } else {
            (Class::Arithmetic, [1, 2])
        };
    }
    if begins(&["ldm", "stm", "push", "pop"]) {
        return (Class::Memory, with_refill([1 + count, 1 + count]));
    }
    if begins(&["ldrd", "strd"]) {
        return (Class::Memory, [3, 3]);
    }
    if begins(&["ldr", "str"]) {
        return (Class::Memory, with_refill([1, 2]));
    }
    if is_branch(stem) {
        let conditional = begins(&["cb"]) || is_conditional(stem);
        let least = if conditional { 1 } else { 1 + REFILL[0] };
        return (Class::Branch, [least, 1 + REFILL[1]]);
    }
    if begins(&["tbb", "tbh"]) {
        return (Class::Branch, [2 + REFILL[0], 2 + REFILL[1]]);
    }
    // A condition may be read together with what follows it.
    if stem.starts_with("it") {
        return (Class::Branch, [0, 1]);
    }
    if begins(&["udiv", "sdiv"]) {
        return (Class::Integer, [2, 12]);
    }
    (Class::Integer, with_refill([1, 1]))
}

/// How many registers a list in braces names.
fn registers(operands: &str) -> u64 {
    let list = operands.split_once('{').and_then(|(_, list)| list.split_once('}'));
    let Some((list, _)) = list else { return 0 };
    let number = |register: &str| -> Option<u64> {
        register.trim().trim_start_matches(|c: char| c.is_ascii_alphabetic()).parse().ok()
    };
    let words = |part: &str| {
        let width = if part.trim().starts_with('d') { 2 } else { 1 };
        let count = match part.split_once('-') {
            Some((from, to)) => number(to).zip(number(from)).map_or(1, |(to, from)| 1 + to - from),
            None => 1,
        };
        width * count
    };
    list.split(',').map(words).sum()
}

/// A register of the core's, as an operand.
fn is_core(operand: &str) -> bool {
    let operand = operand.trim();
    ["sl", "fp", "ip", "sp", "lr"].contains(&operand)
        || operand.strip_prefix('r').is_some_and(|number| number.parse::<u8>().is_ok())
}

/// What loads or moves into the program counter.
fn writes_pc(stem: &str, operands: &str) -> bool {
    let loads = stem.starts_with("ldm") || stem.starts_with("pop");
    let stores = stem.starts_with("st") || stem.starts_with("push") || stem.starts_with("cmp");
    (loads && operands.contains("pc}")) || (!stores && operands.starts_with("pc,"))
}

/// `b`, `bl`, `bx`, `blx`, `cbz`, `cbnz`, with conditions or without.
fn is_branch(stem: &str) -> bool {
    let rest = ["blx", "bx", "bl", "b"].iter().find_map(|name| {
        let rest = stem.strip_prefix(name)?;
        (rest.is_empty() || CONDITIONS.contains(&rest)).then_some(())
    });
    rest.is_some() || stem == "cbz" || stem == "cbnz"
}

fn is_conditional(stem: &str) -> bool {
    !["b", "bl", "bx", "blx"].contains(&stem)
}

const CONDITIONS: [&str; 14] =
    ["eq", "ne", "cs", "cc", "mi", "pl", "vs", "vc", "hi", "ls", "ge", "lt", "gt", "le"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instructions_have_their_class_and_cycles() {
        for (mnemonic, operands, class, cycles) in [
            ("vmul.f32", "s0, s1, s2", Class::Arithmetic, [1, 2]),
            ("vmla.f32", "s0, s1, s2", Class::Arithmetic, [3, 4]),
            ("vcvt.f32.s32", "s0, s0", Class::Arithmetic, [1, 2]),
            ("vnegmi.f32", "s0, s0", Class::Arithmetic, [1, 2]),
            ("vsqrt.f32", "s0, s0", Class::Division, [14, 15]),
            ("vdiv.f32", "s0, s1, s2", Class::Division, [14, 15]),
            ("vcmp.f32", "s0, #0.0", Class::Comparison, [1, 1]),
            ("vmrs", "APSR_nzcv, fpscr", Class::Comparison, [1, 1]),
            ("vmov", "r0, s1", Class::Move, [1, 1]),
            ("vmov", "r0, r1, d8", Class::Move, [2, 2]),
            ("vmov.f32", "s0, #112\t; 0x3f800000", Class::Move, [1, 1]),
            ("vldr", "s0, [r0, #4]", Class::FloatMemory, [1, 2]),
            ("vldr", "d8, [r0, #8]", Class::FloatMemory, [2, 3]),
            ("vldmia", "r0!, {s0-s3}", Class::FloatMemory, [5, 5]),
            ("vpush", "{d8-d15}", Class::FloatMemory, [17, 17]),
            ("ldr.w", "r0, [r1, #12]", Class::Memory, [1, 2]),
            ("ldr.w", "pc, [sp], #4", Class::Memory, [2, 5]),
            ("ldrd", "r0, r1, [sp]", Class::Memory, [3, 3]),
            ("stmdb", "sp!, {r4, r5, r6, r7, r8, lr}", Class::Memory, [7, 7]),
            ("push", "{r4-r7, lr}", Class::Memory, [6, 6]),
            ("pop", "{r7, pc}", Class::Memory, [4, 6]),
            ("b.n", "20000 <a>", Class::Branch, [2, 4]),
            ("bne.w", "20000 <a>", Class::Branch, [1, 4]),
            ("bls.n", "20000 <a>", Class::Branch, [1, 4]),
            ("bl", "20000 <a>", Class::Branch, [2, 4]),
            ("bx", "lr", Class::Branch, [2, 4]),
            ("cbz", "r0, 20000 <a>", Class::Branch, [1, 4]),
            ("tbb", "[pc, r0]", Class::Branch, [3, 5]),
            ("ite", "eq", Class::Branch, [0, 1]),
            ("bic.w", "r0, r1, r2", Class::Integer, [1, 1]),
            ("bfi", "r0, r1, #1, #2", Class::Integer, [1, 1]),
            ("umull", "r0, r1, r2, r3", Class::Integer, [1, 1]),
            ("udiv", "r0, r1, r2", Class::Integer, [2, 12]),
            ("mov", "pc, r2", Class::Integer, [2, 4]),
            ("cmp", "r0, #1", Class::Integer, [1, 1]),
        ] {
            assert_eq!(of(mnemonic, operands), (class, cycles), "{mnemonic} {operands}");
        }
    }
}
