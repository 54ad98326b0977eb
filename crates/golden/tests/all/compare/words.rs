//! What no column shows, and any bit of a state that is another.

use dbd_golden::{Bands, Component, Mismatch, Moment, Recording, Tolerance};
use dbd_kernel::words::{Word, WordSource, WordVisitor, Words};
use dbd_kernel::{F32, F64, Geometry, ModelOwner, State};
use dbd_scene::SceneModel;
use proptest::prelude::*;

use super::{TEXT, difference};
use crate::shared::{plant, scene};

/// A moment whose numbers are another's and whose hash is not.
struct Hidden<'p, M>(&'p M);

impl<M: Moment> Moment for Hidden<'_, M> {
    fn steps_done(&self) -> u64 {
        self.0.steps_done()
    }
    fn state_hash(&self) -> u64 {
        self.0.state_hash() ^ 1
    }
    fn body_numbers(&self, row: usize) -> Option<[f64; 13]> {
        self.0.body_numbers(row)
    }
    fn turn_count(&self, spring: usize) -> Option<i32> {
        self.0.turn_count(spring)
    }
}

/// Of other precisions a state may hold words that no column shows.
#[test]
fn what_no_column_shows_is_found_by_the_hash() {
    let of = scene("four-bar");
    let plant = plant::<F32>(&of);
    let mut recording = Recording::of_scene(&of, &plant, 50, &[]).unwrap();
    recording.sample(&Hidden(&plant), &[]).unwrap();
    let refused = recording.compare(&TEXT, &Tolerance::Bits).unwrap_err();
    assert!(refused.to_string().contains("the hash of the stored state differs"), "{refused}");
    assert_eq!(difference(refused).component, Component::State);
    // It is none of the bands' business; the run is short all the same.
    let within = recording.compare(&TEXT, &Tolerance::Within(Bands::all(0.0)));
    assert_eq!(*within.unwrap_err(), Mismatch::Sample { golden: Some(50), present: None });
}

/// The words of a state, one bit of them flipped.
struct Flipped {
    words: Vec<Word>,
    at: usize,
}

impl WordVisitor for Flipped {
    fn word(&mut self, word: Word) {
        self.words.push(word);
    }
}

impl WordSource for Flipped {
    fn take(&mut self, size: usize) -> u64 {
        let word = self.words[self.at];
        self.at += 1;
        assert_eq!(word.size(), size);
        word.bits()
    }
}

/// A state as a moment.
struct At<'s, M: ModelOwner>(&'s State<M>);

impl<M: ModelOwner<Precision = P>, P: Geometry> Moment for At<'_, M> {
    fn steps_done(&self) -> u64 {
        self.0.step
    }
    fn state_hash(&self) -> u64 {
        self.0.hash()
    }
    fn body_numbers(&self, row: usize) -> Option<[f64; 13]> {
        let (x, q, v, w) = self.0.bodies.as_ref().get(row)?.to_f64();
        let mut numbers = x.into_iter().chain(q).chain(v).chain(w);
        Some([0.0; 13].map(|_| numbers.next().unwrap()))
    }
    fn turn_count(&self, spring: usize) -> Option<i32> {
        self.0.turns.as_ref().get(spring).copied()
    }
}

/// Whether a flipped bit of a word is found in a sample, and in the component that it is of.
fn flipped<P: Geometry>(word: prop::sample::Index, bit: prop::sample::Index) {
    let of = scene("four-bar");
    let mut plant = plant::<P>(&of);
    plant.advance(10).unwrap();
    let mut golden = Recording::of_scene(&of, &plant, 50, &[]).unwrap();
    golden.look(&plant).unwrap();
    let mut state: State<SceneModel<P>> = plant.state().clone();
    let mut words = Flipped { words: Vec::new(), at: 0 };
    state.visit(&mut words);
    let place = word.index(words.words.len());
    let word = &mut words.words[place];
    let mask = 1_u64 << bit.index(8 * word.size());
    *word = match *word {
        Word::F32(x) => Word::F32(f32::from_bits(x.to_bits() ^ mask as u32)),
        Word::F64(x) => Word::F64(f64::from_bits(x.to_bits() ^ mask)),
        Word::I32(x) => Word::I32(x ^ mask as i32),
        Word::U64(x) => Word::U64(x ^ mask),
    };
    state.fill(&mut words);
    let mut run = Recording::of_scene(&of, &plant, 50, &[]).unwrap();
    run.sample(&At(&state), &[]).unwrap();
    let mismatch = run.compare(&golden.text(), &Tolerance::Bits).unwrap_err();
    match *mismatch {
        Mismatch::Sample { .. } => assert_eq!(place, 3 * 13 + 2),
        Mismatch::Difference(found) => {
            assert_eq!((found.differing, found.equal), (1, None));
            let expected = match place.checked_sub(39) {
                Some(spring) => Component::Turns { spring },
                None => {
                    let body = of.body_names[place / 13].clone();
                    Component::Body { body, column: place % 13 }
                }
            };
            assert_eq!(found.component, expected);
        }
        other => panic!("{other}"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_flipped_bit_of_a_state_is_found(word in any::<prop::sample::Index>(), bit in any::<prop::sample::Index>()) {
        flipped::<F32>(word, bit);
        flipped::<F64>(word, bit);
    }

    /// Numbers of any bits, in both precisions, read back as they were.
    #[test]
    fn a_record_reads_back(bits in prop::collection::vec(any::<u64>(), 13 * 3), values in prop::collection::vec(any::<f64>(), 2)) {
        struct Any<'b>(&'b [u64], bool);
        impl Moment for Any<'_> {
            fn steps_done(&self) -> u64 {
                self.0[0]
            }
            fn state_hash(&self) -> u64 {
                self.0[1]
            }
            fn body_numbers(&self, row: usize) -> Option<[f64; 13]> {
                let bits = self.0.get(13 * row..13 * (row + 1))?;
                let number = |bits: u64| if self.1 { f64::from(f32::from_bits(bits as u32)) } else { f64::from_bits(bits) };
                Some(std::array::from_fn(|i| number(bits[i])))
            }
            fn turn_count(&self, spring: usize) -> Option<i32> {
                Some(self.0[spring] as i32)
            }
        }
        let of = scene("four-bar");
        let record = |single: bool| {
            let bodies = ["crank", "coupler", "rocker"];
            let mut record = match single {
                true => Recording::of_plant("a", &plant::<F32>(&of), 1, &bodies, &["u", "v"]),
                false => Recording::of_plant("a", &plant::<F64>(&of), 1, &bodies, &["u", "v"]),
            }.unwrap();
            record.sample(&Any(&bits, single), &values).unwrap();
            record
        };
        for single in [false, true] {
            let recorded = record(single);
            let compared = recorded.compare(&recorded.text(), &Tolerance::Bits);
            prop_assert!(compared.is_ok(), "{:?}\n{}", compared, recorded.text());
        }
    }
}
