//! What a root must not reach: the checks, each with the fault that proves it.
//!
//! `functions that a root reaches => findings`. A check sees names, mnemonics and indirect
//! branches; it knows no root and no image.

use super::image::Function;

/// A thing that must not be there.
pub struct Check {
    /// What it is.
    pub name: &'static str,
    /// The planted root's name after `audit.planted.`.
    pub plant: &'static str,
    /// Whether it is looked for in what is of single precision throughout alone.
    pub single_only: bool,
    /// What is found in a function, in words.
    pub findings: fn(&Function) -> Vec<String>,
}

/// All checks.
pub const CHECKS: [Check; 5] = [
    Check { name: "panic", plant: "index", single_only: false, findings: panics },
    Check { name: "allocation", plant: "box", single_only: false, findings: allocations },
    Check { name: "fused multiply-add", plant: "fused", single_only: false, findings: fused },
    Check {
        name: "soft float in an f32 step",
        plant: "soft-float",
        single_only: true,
        findings: soft_float,
    },
    // Behind one, anything could hide: the other checks follow fixed branches only.
    Check { name: "indirect call", plant: "pointer", single_only: false, findings: indirect },
];

fn panics(function: &Function) -> Vec<String> {
    let named = named(function, &["panic", "unwrap", "unwind", "core::fmt", "slice_index"]);
    named.into_iter().chain(instructions(function, &["udf"])).collect()
}

fn allocations(function: &Function) -> Vec<String> {
    let parts = ["__rust_alloc", "__rg_alloc", "__rust_no_alloc", "GlobalAlloc", "alloc::"];
    named(function, &parts)
}

fn named(function: &Function, parts: &[&str]) -> Vec<String> {
    let bad = |name: &&String| parts.iter().any(|part| name.contains(part));
    function.names.iter().filter(bad).cloned().collect()
}

fn instructions(function: &Function, beginnings: &[&str]) -> Vec<String> {
    let bad = |mnemonic: &&String| beginnings.iter().any(|begin| mnemonic.starts_with(begin));
    function.mnemonics.iter().filter(bad).map(|found| within(found, function)).collect()
}

fn within(found: &str, function: &Function) -> String {
    let name = function.names.first().map_or("a function without a name", String::as_str);
    format!("{found} in {name}")
}

/// A fused operation rounds once where the host rounds twice. `vmla`, which LLVM emits, is not
/// fused: it rounds the product.
fn fused(function: &Function) -> Vec<String> {
    instructions(function, &["vfma", "vfms", "vfnma", "vfnms"])
}

fn soft_float(function: &Function) -> Vec<String> {
    function.names.iter().filter(|name| is_soft_float(name)).cloned().collect()
}

fn indirect(function: &Function) -> Vec<String> {
    function.indirect.iter().map(|branch| within(branch, function)).collect()
}

/// The run-time routines of single and double precision, by the names of the Arm run-time ABI
/// and by those of the compiler's library.
fn is_soft_float(name: &str) -> bool {
    if let Some(routine) = name.strip_prefix("__aeabi_") {
        // `d…`, `f…`: arithmetic; `cd…`, `cf…`: comparison; `…2d`, `…2f`: conversion.
        return routine.starts_with(['d', 'f', 'c'])
            || routine.ends_with("2d")
            || routine.ends_with("2f");
    }
    let stem = name.rsplit("::").next().unwrap_or(name);
    ["df2", "df3", "sf2", "sf3", "sidf", "sisf", "didf", "disf", "dfsi", "sfsi", "dfdi", "sfdi"]
        .iter()
        .any(|end| stem.starts_with("__") && stem.ends_with(end))
        || name.contains("compiler_builtins::float")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn function(name: &str, mnemonics: &[&str]) -> Function {
        let mut function = Function { names: vec![name.to_owned()], ..Function::default() };
        function.mnemonics.extend(mnemonics.iter().map(|&mnemonic| mnemonic.to_owned()));
        function
    }

    #[test]
    fn soft_float_routines_are_known_by_name() {
        for name in [
            "__aeabi_dmul",
            "__aeabi_f2d",
            "__aeabi_i2d",
            "__aeabi_dcmplt",
            "__adddf3",
            "compiler_builtins::float::mul::__muldf3",
            "compiler_builtins::float::cmp::cmp::<f64>",
        ] {
            assert!(is_soft_float(name), "{name}");
        }
        for name in ["__aeabi_memclr4", "__aeabi_memcpy", "__aeabi_uldivmod", "libm::math::sqrtf"] {
            assert!(!is_soft_float(name), "{name}");
        }
    }

    #[test]
    fn panics_are_known_by_name_and_by_trap() {
        assert!(!panics(&function("core::panicking::panic_bounds_check", &[])).is_empty());
        assert!(!panics(&function("step", &["udf", "bx"])).is_empty());
        assert!(panics(&function("step", &["bx"])).is_empty());
    }

    #[test]
    fn rounding_twice_is_not_fused() {
        assert!(fused(&function("step", &["vmla.f32"])).is_empty());
        assert_eq!(fused(&function("step", &["vfma.f32"])), ["vfma.f32 in step"]);
    }
}
