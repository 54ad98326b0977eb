//! The target `snapshot`: bytes that are said to be a plant's state.
//!
//! `bytes => restore => refusal, or steps`. The first bytes choose a plant; what is left is the
//! snapshot, or changes of a valid one, whose checksum may be set right again: else nearly all would
//! be refused by that alone. What is refused changes nothing; what is taken can be stepped, and is
//! given back as it was.

use std::sync::LazyLock;

use arbitrary::Unstructured;
use dbd_plant::{AnyPlant, Method, PlantError, PrecisionName, SchemeName, plant};
use dbd_scene::Scene;
use fastrand::Rng;

use crate::corpus::SMALL;
use crate::numbers::{EDGES, below, byte, one_in};
use crate::scene::running_is_finite;
use crate::stepper::bytes;
use crate::target::{Finding, Reach, Target};

/// Snapshots.
pub struct SnapshotTarget;

impl Target for SnapshotTarget {
    fn name(&self) -> &'static str {
        "snapshot"
    }

    fn share(&self) -> f64 {
        0.1
    }

    fn block(&self) -> u64 {
        10_000
    }

    fn input(&self, random: &mut Rng) -> Vec<u8> {
        let most = if random.u8(..8) == 0 { 1200 } else { 60 };
        bytes(random, most)
    }

    fn execute(&self, input: &[u8]) -> Result<Reach, Finding> {
        let mut bytes = Unstructured::new(input);
        let scene = &SCENES[below(&mut bytes, SCENES.len())];
        let method = method(&mut bytes);
        let mut plant = match plant(scene, &method, STEP) {
            Ok(plant) => plant,
            // Memories of laws and driven bodies are not for every scheme, and no law for comparison.
            Err(
                PlantError::Memory { .. } | PlantError::Laws { .. } | PlantError::Driven { .. },
            ) => return Ok(Reach::Refused),
            Err(error) => return Err(Finding::new("a plant", error)),
        };
        let _ = plant.advance(u64::from(byte(&mut bytes) % 4));
        let Ok(valid) = plant.snapshot() else { return Ok(Reach::Refused) };
        let wanted = wanted(&mut bytes, &valid);
        let before = plant.hash();
        if plant.restore(&wanted).is_err() {
            let unchanged = plant.hash() == before && plant.status().is_ok();
            Finding::unless(unchanged, "a refused snapshot changes nothing", || {
                format!("{method:?}")
            })?;
            return Ok(Reach::Refused);
        }
        running_is_finite(plant.as_ref(), plant.status().is_ok(), &plant.state())?;
        given_back(plant.as_mut(), &wanted)?;
        for _ in 0..3 {
            let status = plant.step();
            running_is_finite(plant.as_ref(), status.is_ok(), &plant.state())?;
            for readout in &scene.readouts {
                let _ = plant.read(&readout.readout);
            }
            let _ = plant.energy();
        }
        Ok(Reach::Taken)
    }
}

/// \[s\] the step of all plants.
const STEP: f64 = 1e-4;

/// The scenes whose states are taken.
static SCENES: LazyLock<Vec<Scene>> = LazyLock::new(|| {
    SMALL.iter().filter_map(|text| Scene::parse(text, "snapshot.toml").ok()).collect()
});

fn method(bytes: &mut Unstructured<'_>) -> Method {
    use dbd_plant::Named as _;
    let scheme = SchemeName::ALL[below(bytes, SchemeName::ALL.len())];
    let precision = if one_in(bytes, 2) { PrecisionName::F64 } else { PrecisionName::F32 };
    Method::new(scheme, None, precision).unwrap_or_default()
}

/// The bytes to restore from.
fn wanted(bytes: &mut Unstructured<'_>, valid: &[u8]) -> Vec<u8> {
    let how = byte(bytes);
    if how.is_multiple_of(8) {
        let rest = bytes.len();
        return bytes.bytes(rest).unwrap_or_default().to_vec();
    }
    let mut wanted = valid.to_vec();
    for _ in 0..1 + byte(bytes) % 4 {
        change(&mut wanted, bytes);
    }
    if how % 8 > 1 {
        seal(&mut wanted);
    }
    wanted
}

/// A byte, a word or the length.
fn change(snapshot: &mut Vec<u8>, bytes: &mut Unstructured<'_>) {
    let at = usize::from(bytes.arbitrary::<u16>().unwrap_or(0)) % snapshot.len().max(1);
    let kind = byte(bytes) % 16;
    let word: [u8; 8] = match kind {
        0..=2 => bytes.arbitrary().unwrap_or([255; 8]),
        3..=6 => EDGES[below(bytes, EDGES.len())].to_le_bytes(),
        7 | 8 => {
            let [a, b, c, d] = (EDGES[below(bytes, EDGES.len())] as f32).to_le_bytes();
            [a, b, c, d, a, b, c, d]
        }
        9 => [0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff, 0x7f],
        10 => [0, 0, 0, 0x80, 0, 0, 0, 0x80],
        11 => [0xff; 8],
        12 => {
            snapshot.truncate(at);
            return;
        }
        13 => {
            snapshot.push(byte(bytes));
            return;
        }
        _ => {
            if let Some(here) = snapshot.get_mut(at) {
                *here ^= 1 << (byte(bytes) % 8);
            }
            return;
        }
    };
    // Words lie at multiples of two from the header on.
    let at = at & !1;
    let wide = if kind.is_multiple_of(2) { 4 } else { 8 };
    for (here, new) in snapshot.iter_mut().skip(at).take(wide).zip(word) {
        *here = new;
    }
}

/// Sets the checksum right: CRC-32, the last four bytes.
fn seal(snapshot: &mut [u8]) {
    let Some((covered, checksum)) = snapshot.split_last_chunk_mut::<4>() else { return };
    *checksum = crc32fast::hash(covered).to_le_bytes();
}

/// What was taken and is not driven by tables is the next snapshot.
fn given_back(plant: &mut dyn AnyPlant, wanted: &[u8]) -> Result<(), Finding> {
    let again = plant.snapshot().map_err(|e| Finding::new("a restored plant has a snapshot", e))?;
    let model = plant.model();
    let driven = !model.sources.is_empty() || model.inputs.iter().any(|input| input.knots > 0);
    Finding::unless(driven || again == wanted, "a snapshot is given back as it was", || {
        format!("{:?}", plant.method())
    })
}
