//! The largest and the smallest models: what fits a small chip, and what a PC takes.

use std::fmt::Write as _;

use dbd_kernel::{Dbd, F32, F64, Leapfrog, Model, Pefrl, Plant, Rk4};
use dbd_scene::Scene;
use dbd_tests::page::{block, figure, grouped, table};
use dbd_tests::results::cost;

use crate::extremes_mechanics::{End, UNDAMPED, Way, body, each, follow, scene_of, single};

/// A chain of links of 0.1 m and 0.1 kg on spherical joints, folded to and fro in one place.
fn chain(links: usize) -> Result<Scene, String> {
    let mut text = "name = \"chain\"\nduration = 1\ngravity = [0, -9.81, 0]\n".to_owned();
    for i in 0..links {
        let _ = write!(
            text,
            "[[body]]\nname = \"{i}\"\nmass = 0.1\ninertia = [8e-5, 8e-5, 8e-5]\nposition = [0.05, 0, 0]\n"
        );
    }
    for i in 0..links {
        let before = if i == 0 { "world".to_owned() } else { (i - 1).to_string() };
        let at = if i % 2 == 0 { 0.0 } else { 0.1 };
        let _ = write!(
            text,
            "[[joint]]\nname = \"{i}\"\ntype = \"spherical\"\nbetween = [\"{before}\", \"{i}\"]\n\
             at = [{at}, 0, 0]\nstiffness = 1e5\narm = 0.02\n"
        );
    }
    Scene::parse(&text, "chain.toml").map_err(|why| why.to_string())
}

/// \[s\] 1/ω of a link on two joints, with its turns, and some more.
const STEP: f64 = 5e-5;

/// The last link of a long folded chain falls freely until it hears of the support.
fn falls(links: usize, ways: &[Way], steps: u64) -> Vec<[End; 2]> {
    let scene = chain(links).unwrap();
    assert_eq!(scene.model.bodies.len(), links);
    each(ways, |way, method| {
        let end = follow(&scene, method, STEP, steps, 1, |t, state| {
            (state.bodies[links - 1].position.y + 0.5 * 9.81 * t * t).abs()
        });
        let bound = match way {
            // Of first order: h·g·t/2.
            Way::Dbd => 0.6 * STEP * 9.81 * steps as f64 * STEP,
            _ if single(method) => 1e-6,
            _ => 1e-12,
        };
        assert!(end.is_within(bound), "{links} {method:?} {end:?}");
        end
    })
}

/// So much of a chip's memory, in bytes.
const FLASH: usize = 256 * 1024;
const RAM: usize = 64 * 1024;
/// Bytes left to start-up, logging and the caller in either.
const SPARE: usize = 8 * 1024;

/// Bytes of the constant model of a chain, and of its plant.
macro_rules! bytes {
    ($p:ty, $scheme:ty, $n:literal, $points:literal, $tsdas:literal) => {{
        type Chain = Model<$p, $n, $n, $points, $tsdas, 0, 0, 0, 1>;
        [size_of::<Chain>(), size_of::<Plant<&'static Chain, $scheme>>()]
    }};
}

#[test]
fn the_largest_chain_that_fits_a_chip() {
    // The sizes are those that were counted on the target, but for pointers of twice the size.
    let counted = cost("hanging-chain", "leapfrog", "f32");
    let [model, plant] = bytes!(F32, Leapfrog, 20, 80, 60);
    assert_eq!(model as f64, counted.number("rodata_bytes"));
    let counted = counted.number("plant_ram_bytes");
    assert!((0.0..=8.0).contains(&(plant as f64 - counted)), "{plant}");

    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut largest = Vec::new();
    macro_rules! row {
        ($p:ty, $precision:literal, $scheme:ty, $name:literal) => {{
            let [one, two] = [bytes!($p, $scheme, 20, 80, 60), bytes!($p, $scheme, 40, 160, 120)];
            let each = [0, 1].map(|i| (two[i] - one[i]) as f64 / 20.0);
            let row = cost("four-bar", $name, $precision);
            let [code, stack] = ["text_bytes", "stack_bytes"].map(|column| row.number(column));
            let left = [(FLASH - SPARE) as f64 - code, (RAM - SPARE) as f64 - stack];
            let links = [0, 1].map(|i| ((left[i] - one[i] as f64) / each[i]).floor() as usize + 20);
            let fits = links[0].min(links[1]);
            largest.push(fits);
            let mut cells = vec![format!("{}, {}", $name, $precision)];
            cells.extend(each.map(|bytes| figure(bytes, 3)));
            cells.extend(links.map(|links| grouped(&links.to_string())));
            cells.push(grouped(&fits.to_string()));
            rows.push(cells);
        }};
    }
    row!(F32, "f32", Leapfrog, "leapfrog");
    row!(F32, "f32", Pefrl, "pefrl");
    row!(F32, "f32", Rk4, "rk4");
    row!(F32, "f32", Dbd, "dbd");
    row!(F64, "f64", Leapfrog, "leapfrog");
    let head =
        ["", "flash per link [B]", "RAM per link [B]", "links in flash", "in RAM", "largest"];
    block("docs/extremes.md", "largest", &table(&head, &rows));

    // What was extrapolated is so: a chain of that size, to a hundredth.
    let [model, plant] = bytes!(F32, Leapfrog, 400, 1600, 1200);
    assert!(largest[0] >= 400 && model < FLASH && plant < RAM, "{largest:?} {model} {plant}");
    let share = plant as f64 / 400.0 * largest[0] as f64 / (RAM - SPARE) as f64;
    assert!((0.97..1.01).contains(&share), "{share}");
    // And it runs, as any chain does.
    let _ = falls(largest[0], &[Way::Leapfrog], 100);
}

/// One body and nothing else, and one on a spring.
#[test]
fn the_smallest_models() {
    let [flash, ram] = {
        type Alone = Model<F32, 1>;
        [size_of::<Alone>(), size_of::<Plant<&'static Alone, Leapfrog>>()]
    };
    assert!(flash <= 128 && ram <= 256, "{flash} {ram}");
    let scene = scene_of(&[body("b", 1.0, 0.0) + "velocity = [1, 0, 0]\n"]);
    each(&UNDAMPED, |way, method| {
        let end = follow(&scene, method, 0.125, 800, 8, |t, state| {
            (state.bodies[0].position.x - t).abs()
        });
        // Whole steps of an eighth are exact; the parts of pefrl's are not.
        let grid: f64 = if single(method) { f32::EPSILON.into() } else { f64::EPSILON };
        let bound = if way == Way::Pefrl { 100.0 * grid * 3_200.0 } else { 0.0 };
        assert!(end.is_within(bound), "{method:?} {end:?}");
        end
    });
    let refused = Scene::parse("name = \"none\"\nduration = 1\n", "none.toml");
    let why = refused.unwrap_err().to_string();
    assert!(why.contains("no bodies"), "{why}");
}

/// \[kB\] the most memory that this process had, where the system tells.
fn peak() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.trim().parse().ok()
}

#[test]
fn ten_thousand_bodies_on_a_pc() {
    let before = peak();
    let ways = [Way::Leapfrog, Way::Rk4];
    let links = 10_000;
    falls(links, &ways, 20);
    let most = 200.0;
    if let (Some(before), Some(after)) = (before, peak()) {
        assert!(after - before < 1e3 * most, "{} MB", (after - before) / 1e3);
    }
}
