//! `cargo xtask real-time`: which configuration keeps up with a controller, as docs/results/real-time.csv.
//!
//! `practical scenes × microcontrollers × rates, host-sim advise => rows`.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use anyhow::{Context as _, Result, bail};
use serde_json::Value;

use crate::built::{build, host_sim};
use crate::command::{cargo, program, root};

const FILE: &str = "docs/results/real-time.csv";
const HEAD: &str =
    "scene,mcu,rate_hz,model,scheme,damping,precision,step_s,error_m,instructions,load\n";
const SCENES: [&str; 12] = [
    "scenes/cart-pendulum.toml",
    "scenes/gripper.toml",
    "scenes/double-wishbone.toml",
    "scenes/macpherson.toml",
    "scenes/delta-pick-and-place.toml",
    "docs/examples/balance-robot/balance-robot.toml",
    "docs/examples/crane/crane.toml",
    "docs/examples/gate-opener/gate-opener.toml",
    "docs/examples/grasp/grasp.toml",
    "docs/examples/quadrotor/quadrotor.toml",
    "docs/examples/quarter-car/quarter-car.toml",
    "docs/examples/wiper/wiper.toml",
];
const MCUS: [&str; 2] = ["cortex-m4f", "cortex-m7-double"];
const RATES: [u32; 3] = [1_000, 4_000, 10_000];

/// Asks for all and writes the file.
///
/// # Errors
/// Where the command line does not build, a scene has no advice, or writing fails.
pub fn run() -> Result<()> {
    let built = build(cargo().args(["build", "--release", "--package", "host-sim"]))?;
    let host_sim = host_sim(&built)?;
    let asked: Vec<(&str, &str, u32)> = SCENES
        .iter()
        .flat_map(|scene| MCUS.iter().flat_map(|mcu| RATES.map(|rate| (*scene, *mcu, rate))))
        .collect();
    let (next, rows) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let place = next.fetch_add(1, Ordering::Relaxed);
                    let Some(one) = asked.get(place) else { break };
                    let row = advised(&host_sim, *one);
                    println!("{one:?}: {row:?}");
                    rows.lock().unwrap_or_else(PoisonError::into_inner).insert(place, row);
                }
            });
        }
    });
    let rows = rows.into_inner().unwrap_or_else(PoisonError::into_inner);
    let rows: Result<Vec<String>> = rows.into_values().collect();
    let text = format!("# Advice for controllers; written by `cargo xtask real-time`.\n{HEAD}");
    std::fs::write(root().join(FILE), text + &rows?.concat())
        .with_context(|| format!("cannot write {FILE}"))?;
    println!("written: {FILE}");
    crate::provenance::note(&[FILE])
}

/// The row of an advice, whether it keeps up or not.
fn advised(host_sim: &Path, (scene, mcu, rate): (&str, &str, u32)) -> Result<String> {
    let mut command = program(host_sim);
    command.arg("advise").arg(root().join(scene)).args(["--mcu", mcu, "--json", "--rate"]);
    let output = command.arg(format!("{rate}Hz")).output().context("cannot run host-sim")?;
    let json: Value = serde_json::from_slice(&output.stdout).with_context(|| {
        format!("no advice for {scene}: {}", String::from_utf8_lossy(&output.stderr))
    })?;
    row(&json, rate)
}

fn row(json: &Value, rate: u32) -> Result<String> {
    let way = &json["way"];
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let number = |name: &str| {
        way[name].as_f64().with_context(|| format!("the advice has no number `{name}`"))
    };
    let names = ["model", "scheme", "damping", "precision"].map(|name| text(&way[name])).join(",");
    let [scene, mcu] = ["scene", "mcu"].map(|name| text(&json[name]));
    if [&scene, &mcu].iter().any(|name| name.is_empty()) {
        bail!("the advice names no scene or microcontroller");
    }
    let (step, error) = (number("step")?, number("error")?);
    let (count, load) = (number("instructions")?, number("load")?);
    Ok(format!("{scene},{mcu},{rate},{names},{step:?},{error:.3e},{count:.0},{load:.4}\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_advice_is_a_row_or_an_error() {
        let way = serde_json::json!({
            "model": "planar", "scheme": "leapfrog", "damping": null, "precision": "f32",
            "step": 0.00025, "error": 1.25e-5, "instructions": 2000.0, "load": 0.125,
        });
        let mut json = serde_json::json!({ "scene": "a", "mcu": "cortex-m4f", "way": way });
        let line = "a,cortex-m4f,4000,planar,leapfrog,,f32,0.00025,1.250e-5,2000,0.1250\n";
        assert_eq!(row(&json, 4_000).unwrap(), line);
        json["way"]["load"] = Value::Null;
        assert!(row(&json, 4_000).is_err());
    }
}
