//! The page around the plant: one self-contained file.
//!
//! `(scenes, settings, module) => HTML`. It contains the compressed WebAssembly module, the worker that runs it and the
//! scripts that display it, and works from a disk as from any web host.

use std::io::{self, Write as _};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use dbd_plant::instance::Settings;
use dbd_report::output;
use dbd_report::page::{STAGE, STYLES, script_json};
use flate2::Compression;
use flate2::write::GzEncoder;
use serde::Serialize;

use crate::session::Set;

/// The file of the module.
pub const MODULE: &str = "dbd_play.wasm";

/// The format of the data that the scripts read.
const FORMAT: u32 = 1;

/// How a module of WebAssembly begins.
const MAGIC: &[u8] = b"\0asm";

/// The style of this page, in addition to that of reports.
const STYLE: &str = include_str!("../web/play.css");
/// The body of the page.
const BODY: &str = include_str!("../web/play.html");
/// The worker that runs the module.
const WORKER: &str = include_str!("../web/worker.js");
/// Scripts of the page in order, without those that draw a mechanism.
const SCRIPTS: &[&str] = &[
    include_str!("../web/vendor/codemirror.min.js"),
    include_str!("../web/engine.js"),
    include_str!("../web/session.js"),
    include_str!("../web/fields.js"),
    include_str!("../web/live.js"),
    include_str!("../web/trails.js"),
    include_str!("../web/view.js"),
    include_str!("../web/grab.js"),
    include_str!("../web/transport.js"),
    include_str!("../web/inputs.js"),
    include_str!("../web/parameters.js"),
    include_str!("../web/method.js"),
    include_str!("../web/plot.js"),
    include_str!("../web/curves.js"),
    include_str!("../web/editor.js"),
    include_str!("../web/save.js"),
    include_str!("../web/main.js"),
];

/// A scene of a page.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SceneText {
    /// Its name in a menu.
    pub name: String,
    /// Name of its text in messages.
    pub file: String,
    /// Description.
    pub description: String,
    /// The scene in TOML.
    pub text: String,
}

/// Initial content of a page.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Page {
    /// One scene, or those of a menu; the first is shown.
    pub scenes: Vec<SceneText>,
    /// How they are stepped.
    pub settings: Settings,
    /// Numbers of the first scene given otherwise, by their paths.
    pub set: Set,
    /// \[1\] simulated time per time that is watched; `None` where the page chooses.
    pub speed: Option<f64>,
    /// Where the text of the first scene is served as it changes; `None` where nobody serves it.
    pub reload: Option<String>,
}

/// The page as HTML.
///
/// # Errors
/// Where `module` is no module of WebAssembly.
pub fn html(page: &Page, module: &[u8]) -> io::Result<String> {
    #[derive(Serialize)]
    struct Data<'p> {
        format: u32,
        version: &'static str,
        #[serde(flatten)]
        page: &'p Page,
    }
    if !module.starts_with(MAGIC) {
        return Err(io::Error::other("not a WebAssembly module"));
    }
    let mut packer = GzEncoder::new(Vec::new(), Compression::best());
    packer.write_all(module)?;
    let packed = STANDARD.encode(packer.finish()?);
    let data = Data { format: FORMAT, version: env!("CARGO_PKG_VERSION"), page };
    let title = match page.scenes.as_slice() {
        [one] => &one.name,
        _ => "Playground",
    };
    let body = format!(
        "{BODY}\n<script type=\"application/json\" id=\"play\">{}</script>\n\
         <script type=\"text/plain\" id=\"worker\">\n{WORKER}</script>\n\
         <script type=\"text/plain\" id=\"module\">{packed}</script>",
        script_json(&data)
    );
    Ok(output::page::html(title, &[STYLES, &[STYLE]].concat(), &body, &[STAGE, SCRIPTS].concat()))
}
