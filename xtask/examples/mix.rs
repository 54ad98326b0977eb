//! A plugin of QEMU's that counts how often each instruction was executed between marks.
//!
//! `blocks of the guest as they are translated and run => lines "MARK ADDRESS COUNT"` in a file. Whoever runs
//! QEMU tells the address of a function that does nothing else: each call of it is a mark, and ends
//! what the mark before began. Built as a library for `cargo xtask cost`, by QEMU's interface of
//! plugins, version 1 (QEMU 4.2 to 8.2; `qemu-plugin.h`).
#![expect(unsafe_code, reason = "QEMU calls and is called through C")]

use std::collections::BTreeMap;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The version of the interface.
#[unsafe(no_mangle)]
pub static qemu_plugin_version: c_int = 1;

type Id = u64;
/// Blocks and instructions are QEMU's.
type Opaque = *mut c_void;

/// `QEMU_PLUGIN_CB_NO_REGS`.
const NO_REGISTERS: c_int = 0;
/// `QEMU_PLUGIN_INLINE_ADD_U64`.
const ADD: c_int = 0;

unsafe extern "C" {
    fn qemu_plugin_register_vcpu_tb_trans_cb(id: Id, call: extern "C" fn(Id, Opaque));
    fn qemu_plugin_register_vcpu_tb_exec_inline(block: Opaque, op: c_int, to: *mut u64, by: u64);
    fn qemu_plugin_register_vcpu_insn_exec_cb(
        instruction: Opaque,
        call: extern "C" fn(u32, Opaque),
        flags: c_int,
        data: Opaque,
    );
    fn qemu_plugin_tb_n_insns(block: Opaque) -> usize;
    fn qemu_plugin_tb_get_insn(block: Opaque, index: usize) -> Opaque;
    fn qemu_plugin_insn_vaddr(instruction: Opaque) -> u64;
}

/// A block that was translated.
struct Block {
    addresses: Vec<u64>,
    /// Never moved or freed: QEMU adds to it.
    runs: &'static mut u64,
}

/// What is known; one core runs.
struct Seen {
    mark: u64,
    marks: u64,
    blocks: Vec<Block>,
    to: Option<BufWriter<File>>,
}

static SEEN: Mutex<Seen> = Mutex::new(Seen { mark: 0, marks: 0, blocks: Vec::new(), to: None });

fn seen() -> MutexGuard<'static, Seen> {
    SEEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Reads `mark=ADDRESS` and `out=FILE`; 0 where both are there and the file can be made.
///
/// # Safety
/// QEMU's: `count` texts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qemu_plugin_install(
    id: Id,
    _: *const c_void,
    count: c_int,
    arguments: *const *const c_char,
) -> c_int {
    for i in 0..usize::try_from(count).unwrap_or(0) {
        // SAFETY: there are `count` of them, each ended by 0.
        let argument = unsafe { CStr::from_ptr(*arguments.add(i)) }.to_string_lossy();
        match argument.split_once('=') {
            Some(("mark", address)) => seen().mark = address.parse().unwrap_or(0),
            Some(("out", path)) => seen().to = File::create(path).ok().map(BufWriter::new),
            _ => return 1,
        }
    }
    let complete = seen().mark != 0 && seen().to.is_some();
    if !complete {
        return 1;
    }
    // SAFETY: as the interface asks for.
    unsafe { qemu_plugin_register_vcpu_tb_trans_cb(id, translated) };
    0
}

extern "C" fn translated(_: Id, block: Opaque) {
    let mut seen = seen();
    // SAFETY: the block is QEMU's for the time of this call, its instructions too.
    let addresses: Vec<u64> = unsafe {
        let instructions = 0..qemu_plugin_tb_n_insns(block);
        let instructions = instructions.map(|i| qemu_plugin_tb_get_insn(block, i));
        instructions
            .map(|instruction| {
                let address = qemu_plugin_insn_vaddr(instruction);
                if address == seen.mark {
                    let nothing = std::ptr::null_mut();
                    qemu_plugin_register_vcpu_insn_exec_cb(
                        instruction,
                        marked,
                        NO_REGISTERS,
                        nothing,
                    );
                }
                address
            })
            .collect()
    };
    let runs: &'static mut u64 = Box::leak(Box::new(0));
    // SAFETY: it is never freed.
    unsafe { qemu_plugin_register_vcpu_tb_exec_inline(block, ADD, runs, 1) };
    seen.blocks.push(Block { addresses, runs });
}

/// Writes what ran since the mark before.
extern "C" fn marked(_: u32, _: Opaque) {
    let Seen { marks, blocks, to, .. } = &mut *seen();
    let mut counts: BTreeMap<u64, u64> = BTreeMap::new();
    for block in blocks {
        // SAFETY: QEMU adds to it in between; its one core is here.
        let runs = unsafe { std::ptr::replace(&raw mut *block.runs, 0) };
        if runs > 0 {
            block.addresses.iter().for_each(|address| *counts.entry(*address).or_default() += runs);
        }
    }
    // What stands before the first mark belongs to nothing.
    if let Some(to) = to.as_mut().filter(|_| *marks > 0) {
        for (address, count) in counts {
            // Who reads the file sees that it is not whole.
            let _ = writeln!(to, "{marks} {address} {count}");
        }
        let _ = to.flush();
    }
    *marks += 1;
}
