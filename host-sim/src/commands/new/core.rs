//! The cores that a firmware project is written for.
//!
//! `core => values of templates`: target, machine of QEMU, start-up code, counter of instructions, a chip with a probe.

use clap::ValueEnum;
use dbd_study::recommend::Mcu;

use super::filled;

/// A core of a microcontroller, with the machine of QEMU that has it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Core {
    /// All real numbers by software
    #[value(name = "cortex-m0plus")]
    CortexM0Plus,
    /// Single precision in hardware
    #[default]
    CortexM4f,
    /// Double precision in hardware, too
    CortexM7,
    /// Single precision in hardware
    CortexM33,
    /// RISC-V with single precision in hardware
    Rv32imafc,
}

/// What differs between cores.
struct Values {
    name: &'static str,
    /// Its class of microcontrollers.
    mcu: &'static str,
    target: &'static str,
    /// The machine of QEMU.
    machine: &'static str,
    /// The package of Debian with it.
    package: &'static str,
    /// The beginning of its call, before the options that all machines share.
    runner: &'static str,
    /// Origins of its flash and RAM.
    memory: [&'static str; 2],
    /// A line of cargo's configuration for the compiler, or nothing.
    flags: &'static str,
    /// Crates of start-up code.
    crates: &'static str,
    start: &'static str,
    /// Further lines of the linker script `memory.x`.
    regions: &'static str,
    /// The linker's scripts.
    scripts: &'static str,
    counter: &'static str,
    /// Instructions of a tick, ticks of an instruction: SysTick at 25 MHz, of the AN505 at 20 MHz.
    ticks: [&'static str; 2],
    /// An instruction takes 2^shift ns of virtual time: one of RISC-V's counter.
    shift: &'static str,
    /// Whether roots by its FPU need the kernel's feature `fpu`.
    fpu: bool,
    /// A chip of this core as probe-rs names it, the origins and sizes of its memories.
    chip: [&'static str; 3],
}

/// Instructions of a step by SysTick, which counts 25 million ticks a second, and by the counter of RISC-V.
const SYSTICK: &str = include_str!("../../../templates/firmware/counter-cortex-m.rs.in");
const MINSTRET: &str = include_str!("../../../templates/firmware/counter-riscv.rs.in");

const CORTEX_M: Values = Values {
    name: "Cortex-M4F",
    mcu: "cortex-m4f",
    target: "thumbv7em-none-eabihf",
    machine: "mps2-an386",
    package: "qemu-system-arm",
    runner: r#""qemu-system-arm", "-M", "mps2-an386""#,
    memory: ["0x00000000", "0x20000000"],
    flags: "",
    crates: "cortex-m = \"0.7\"\ncortex-m-rt = \"0.7\"\n",
    start: "cortex_m_rt",
    regions: "",
    scripts: r#""-Tlink.x""#,
    counter: SYSTICK,
    ticks: ["5 / 8", "1.6"],
    shift: "6",
    fpu: false,
    chip: ["STM32F405RGTx", "FLASH at 0x08000000, 1024K", "RAM at 0x20000000, 128K"],
};

impl Core {
    fn values(self) -> Values {
        match self {
            Self::CortexM0Plus => Values {
                name: "Cortex-M0+",
                mcu: "cortex-m0plus",
                target: "thumbv6m-none-eabi",
                // A Cortex-M3, which has all its instructions: QEMU's machines of a Cortex-M0 have too little memory.
                machine: "mps2-an385",
                runner: r#""qemu-system-arm", "-M", "mps2-an385""#,
                chip: ["STM32G0B1RETx", "FLASH at 0x08000000, 512K", "RAM at 0x20000000, 144K"],
                ..CORTEX_M
            },
            Self::CortexM4f => CORTEX_M,
            Self::CortexM7 => Values {
                name: "Cortex-M7",
                mcu: "cortex-m7-double",
                machine: "mps2-an500",
                runner: r#""qemu-system-arm", "-M", "mps2-an500""#,
                flags: "rustflags = [\"-C\", \"target-cpu=cortex-m7\"]\n",
                fpu: true,
                chip: ["STM32H743ZITx", "FLASH at 0x08000000, 2048K", "RAM at 0x24000000, 512K"],
                ..CORTEX_M
            },
            Self::CortexM33 => Values {
                name: "Cortex-M33",
                mcu: "cortex-m33",
                target: "thumbv8m.main-none-eabihf",
                machine: "mps2-an505",
                runner: r#""qemu-system-arm", "-M", "mps2-an505""#,
                memory: ["0x10000000", "0x38000000"],
                ticks: ["25 / 32", "1.28"],
                chip: ["STM32H563ZITx", "FLASH at 0x08000000, 2048K", "RAM at 0x20000000, 640K"],
                ..CORTEX_M
            },
            Self::Rv32imafc => Values {
                name: "RISC-V RV32IMAFC",
                mcu: "rv32imafc",
                target: "riscv32imafc-unknown-none-elf",
                machine: "virt",
                package: "qemu-system-misc",
                runner: r#""qemu-system-riscv32", "-M", "virt", "-cpu", "rv32,d=false", "-bios", "none""#,
                memory: ["0x80000000", "0x80400000"],
                crates: "riscv = \"0.16\"\nriscv-rt = \"0.18\"\n",
                start: "riscv_rt",
                regions: "\nREGION_ALIAS(\"REGION_TEXT\", FLASH);\nREGION_ALIAS(\"REGION_RODATA\", FLASH);\n\
                          REGION_ALIAS(\"REGION_DATA\", RAM);\nREGION_ALIAS(\"REGION_BSS\", RAM);\n\
                          REGION_ALIAS(\"REGION_HEAP\", RAM);\nREGION_ALIAS(\"REGION_STACK\", RAM);",
                scripts: r#""-Tmemory.x", "-Tlink.x""#,
                counter: MINSTRET,
                shift: "0",
                fpu: true,
                chip: ["CH32V303CBT6", "FLASH at 0x08000000, 128K", "RAM at 0x20000000, 32K"],
                ..CORTEX_M
            },
        }
    }

    /// Its class of microcontrollers.
    pub(super) fn mcu(self) -> &'static Mcu {
        Mcu::of_name(self.values().mcu).expect("a known class")
    }

    /// Its name for people.
    pub(super) fn title(self) -> &'static str {
        self.values().name
    }

    /// Values of templates, with the kernel as a dependency.
    pub(super) fn placeholders(self, kernel: &str) -> Vec<(&'static str, String)> {
        let all = self.values();
        let [instructions, ticks] = all.ticks;
        let counter = [("instructions", instructions.to_owned()), ("ticks", ticks.to_owned())];
        let fpu = if all.fpu { with_feature("fpu", kernel) } else { String::new() };
        let linker = all.target.to_uppercase().replace(['-', '.'], "_");
        let [flash, ram] = all.memory;
        let [chip, chip_flash, chip_ram] = all.chip;
        let values = [
            ("core", all.name),
            ("target", all.target),
            ("machine", all.machine),
            ("package", all.package),
            ("runner", all.runner),
            ("shift", all.shift),
            ("flash", flash),
            ("ram", ram),
            ("flags", all.flags),
            ("start_crates", all.crates),
            ("start", all.start),
            ("regions", all.regions),
            ("scripts", all.scripts),
            ("linker", &linker),
            ("counter", &filled(all.counter, &counter)),
            ("fpu", &fpu),
            ("chip", chip),
            ("chip_memory", &format!("{chip_flash}; {chip_ram}")),
        ];
        values.map(|(name, value)| (name, value.to_owned())).to_vec()
    }
}

/// The line of the kernel with a feature, in the dependencies of the chip.
fn with_feature(feature: &str, kernel: &str) -> String {
    let place = match kernel.strip_prefix('{').and_then(|rest| rest.strip_suffix('}')) {
        Some(table) => table.trim().to_owned(),
        None => format!("version = {kernel}"),
    };
    format!(
        "# Square roots by the core's FPU.\ndbd-kernel = {{ {place}, features = [{feature:?}] }}\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kernel_gets_its_feature_from_wherever_it_comes() {
        let line = |kernel| with_feature("fpu", kernel);
        assert!(line("\"0.1.0\"").ends_with("{ version = \"0.1.0\", features = [\"fpu\"] }\n"));
        let path = line("{ path = \"/a\" }");
        assert!(path.ends_with("{ path = \"/a\", features = [\"fpu\"] }\n"), "{path}");
    }
}
