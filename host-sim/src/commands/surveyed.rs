//! What a survey of the same scene has left beside a run's results.
//!
//! `OUT/SCENE/trade.{json,svg} => advice and chart for the run's page`. A survey of another text of the
//! scene's file, or with other values changed, says nothing about the run and is left out, as one is that cannot be read.

use std::path::Path;

use dbd_report::data::Survey;
use dbd_scene::Scene;
use dbd_scene::file::read_text;
use serde::Deserialize;
use serde_json::json;

use crate::report::SetValue;
use crate::terminal::SceneFile;

/// \[bytes\] a chart beyond is not taken into another page.
const LARGEST_CHART: usize = 500_000;

/// What of `trade.json` is read.
#[derive(Deserialize)]
struct Found {
    scene_hash: String,
    #[serde(default)]
    set: Vec<serde_json::Value>,
    #[serde(default)]
    advice: Vec<Advised>,
}

#[derive(Deserialize)]
struct Advised {
    sentence: String,
    command: String,
}

/// The survey in a folder, where it is of this text of a scene's file with the same values changed.
#[must_use]
pub fn surveyed(folder: &Path, scene: &Scene, file: &SceneFile) -> Option<Survey> {
    let text = read_text(folder.join("trade.json")).ok()?;
    let found: Found = serde_json::from_str(&text).ok()?;
    let set: Vec<_> = SetValue::of(scene).iter().map(|value| json!(value)).collect();
    if found.scene_hash != file.hash || found.set != set {
        return None;
    }
    let chart = read_text(folder.join("trade.svg")).ok()?;
    let chart =
        Some(chart).filter(|chart| chart.starts_with("<svg ") && chart.len() <= LARGEST_CHART);
    let advice = found.advice.into_iter().map(|advised| (advised.sentence, advised.command));
    Some(Survey { advice: advice.collect(), chart, page: "trade.html".into() })
}
