//! The trace of a run: a chain of hashes with ten of its links, and the last samples.

use dbd_kernel::words::{Fnv1a, Word, WordVisitor as _};
use heapless::HistoryBuf;

use crate::say;

/// Samples that the ring holds.
pub const KEPT: usize = 16;
/// Links of the chain that are printed.
const LINKS: u32 = 10;

/// What a tick of a controller saw and set, in whole millionths of SI units: they print alike on every
/// machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sample {
    /// Three numbers, which of them the loop says.
    pub millionths: [i32; 3],
    /// The same as bits.
    pub bits: [u32; 3],
}

impl Sample {
    /// The sample of three numbers.
    #[must_use]
    pub fn of(numbers: [f32; 3]) -> Self {
        // The conversion saturates.
        Self {
            millionths: numbers.map(|number| (number * 1e6) as i32),
            bits: numbers.map(f32::to_bits),
        }
    }
}

/// The trace of a run, of a fixed size.
#[derive(Debug)]
pub struct Trace {
    chain: u64,
    /// Ticks from link to link.
    every: u32,
    links: heapless::Vec<(u32, u64), { LINKS as usize + 1 }>,
    last: HistoryBuf<(u32, Sample), KEPT>,
    ticks: u32,
}

impl Trace {
    /// An empty trace of a run of the given number of ticks.
    #[must_use]
    pub fn new(ticks: u32) -> Self {
        Self {
            chain: 0,
            every: ticks.div_ceil(LINKS).max(1),
            links: heapless::Vec::new(),
            last: HistoryBuf::new(),
            ticks,
        }
    }

    /// A tick's sample and the hash of the state after it.
    pub fn push(&mut self, tick: u32, sample: Sample, hash: u64) {
        let mut chain = Fnv1a::new();
        chain.word(Word::U64(self.chain));
        chain.word(Word::U64(hash));
        for bits in sample.bits {
            chain.word(Word::U64(u64::from(bits)));
        }
        self.chain = chain.finish();
        if tick.is_multiple_of(self.every) || tick == self.ticks {
            // There is room for all that are due.
            let _ = self.links.push((tick, self.chain));
        }
        self.last.write((tick, sample));
    }

    /// Prints links and last samples.
    pub fn print(&self, name: &str) {
        for (tick, chain) in &self.links {
            say!("loop {} {} {:016x}", name, tick, chain);
        }
        for (tick, Sample { millionths: [a, b, c], bits: [x, y, z] }) in self.last.oldest_ordered()
        {
            say!("last {} {} {} {} {} {:08x} {:08x} {:08x}", name, tick, a, b, c, x, y, z);
        }
    }
}
