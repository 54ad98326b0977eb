//! The trade-off study of the same scene in a run's folder.
//!
//! `OUT/SCENE/trade.{json,svg} => advice and chart for the run's page`. A study of another version of the
//! scene's file, or with other changed values, does not apply and is omitted, as is an unreadable one.

use std::path::Path;

use dbd_report::data::Survey;
use dbd_scene::Scene;
use dbd_scene::file::read_text;
use serde::Deserialize;
use serde_json::json;

use crate::report::SetValue;
use crate::terminal::SceneFile;

/// \[bytes\] larger charts are not included in another page.
const LARGEST_CHART: usize = 500_000;

/// The keys of `trade.json` that are read.
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

/// The study in a folder, if it belongs to this version of a scene's file with the same changed values.
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
