//! A browser without a screen, driven by its DevTools protocol.
//!
//! `page, script => value`. One Chromium serves all pages, each in a tab of its own. What the pages
//! log and request is kept.

use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use tempfile::TempDir;
use tungstenite::{Message, WebSocket, client};

/// Names of the program, the first that there is.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];
/// WebGL by the processor; nothing that the program would ask its maker for.
const OPTIONS: [&str; 13] = [
    "--headless",
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--hide-scrollbars",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-dev-shm-usage",
    "--no-first-run",
    "--remote-debugging-port=0",
    "about:blank",
];
/// What takes longer hangs.
const PATIENCE: Duration = Duration::from_secs(60);

/// A running browser; it ends with this value.
pub struct Browser {
    process: Child,
    socket: WebSocket<TcpStream>,
    next: u64,
    session: Option<String>,
    /// What the pages logged as errors, and what they requested beside their own file.
    pub complaints: Vec<String>,
    _profile: TempDir,
}

/// How a page is shown.
#[derive(Clone, Copy)]
pub struct Screen {
    /// [pixels].
    pub width: u32,
    /// [pixels].
    pub height: u32,
    /// Whether the reader asked for dark colours.
    pub dark: bool,
    /// Whether the reader asked for little motion.
    pub calm: bool,
}

impl Browser {
    /// Starts it.
    ///
    /// # Panics
    /// Where none is installed or it does not start.
    pub fn start() -> Self {
        let program = find().expect("no Chromium is installed: apt-get install chromium");
        let profile = tempfile::tempdir().unwrap();
        let mut process = Command::new(program)
            .args(OPTIONS)
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let Some((port, path)) = address(profile.path()) else {
            let _ = process.kill();
            panic!("Chromium did not start");
        };
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let (socket, _) = client(format!("ws://127.0.0.1:{port}{path}"), stream).unwrap();
        let (next, session, complaints) = (1, None, Vec::new());
        Self { process, socket, next, session, complaints, _profile: profile }
    }

    /// Opens a page in a new tab and waits until it says that it is ready.
    pub fn open(&mut self, page: &Path, screen: Screen) {
        self.open_after("", page, screen);
    }

    /// The same in a browser that a script has changed before.
    pub fn open_after(&mut self, script: &str, page: &Path, screen: Screen) {
        if self.session.is_some() {
            self.call("Page.close", json!({}));
        }
        self.session = None;
        let target = self.call("Target.createTarget", json!({ "url": "about:blank" }));
        let attached = json!({ "targetId": target["targetId"], "flatten": true });
        let attached = self.call("Target.attachToTarget", attached);
        self.session = attached["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log", "Network"] {
            self.call(&format!("{domain}.enable"), json!({}));
        }
        self.show(screen);
        self.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": script }));
        self.call("Page.navigate", json!({ "url": format!("file://{}", page.display()) }));
        self.wait("window.dbd && dbd.ready === true", "the page is set up");
    }

    /// Changes screen and wishes of the reader.
    pub fn show(&mut self, screen: Screen) {
        let Screen { width, height, dark, calm } = screen;
        let metrics = json!({
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600,
        });
        self.call("Emulation.setDeviceMetricsOverride", metrics);
        let value =
            |wanted, yes: &str, no: &str| if wanted { yes.to_owned() } else { no.to_owned() };
        let features = json!({ "features": [
            { "name": "prefers-color-scheme", "value": value(dark, "dark", "light") },
            { "name": "prefers-reduced-motion", "value": value(calm, "reduce", "no-preference") },
        ] });
        self.call("Emulation.setEmulatedMedia", features);
    }

    /// The value of a script, promises awaited.
    ///
    /// # Panics
    /// Where the script throws.
    pub fn run(&mut self, script: &str) -> Value {
        let asked = json!({ "expression": script, "awaitPromise": true, "returnByValue": true });
        let answer = self.call("Runtime.evaluate", asked);
        let thrown = &answer["exceptionDetails"];
        assert!(thrown.is_null(), "`{script}` threw {thrown}");
        answer["result"]["value"].clone()
    }

    /// Waits until a script is true.
    ///
    /// # Panics
    /// Where it never is.
    pub fn wait(&mut self, script: &str, what: &str) {
        let start = Instant::now();
        while self.run(script) != Value::Bool(true) {
            assert!(
                start.elapsed() < PATIENCE,
                "never so: {what}; complaints: {:?}",
                self.complaints
            );
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Presses a key, with Shift where asked.
    pub fn press(&mut self, key: &str) {
        let text = if key.chars().count() == 1 { key } else { "" };
        for kind in ["keyDown", "keyUp"] {
            let event = json!({ "type": kind, "key": key, "code": code(key), "text": text });
            self.call("Input.dispatchKeyEvent", event);
        }
    }

    /// Moves the mouse to a point of the window [pixels], with the left button held where asked.
    pub fn mouse(&mut self, kind: &str, x: f64, y: f64, held: bool) {
        // What is let go is a button, too.
        let button = if held || kind == "mouseReleased" { "left" } else { "none" };
        let buttons = u8::from(held);
        let event = json!({
            "type": kind, "x": x, "y": y, "button": button, "buttons": buttons, "clickCount": u8::from(held),
        });
        self.call("Input.dispatchMouseEvent", event);
    }

    /// What the window shows, as PNG.
    pub fn picture(&mut self) -> Vec<u8> {
        let found = self.call("Page.captureScreenshot", json!({ "format": "png" }));
        STANDARD.decode(found["data"].as_str().unwrap()).unwrap()
    }

    fn call(&mut self, method: &str, parameters: Value) -> Value {
        let id = self.next;
        self.next += 1;
        let mut message = json!({ "id": id, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        self.socket.send(Message::text(message.to_string())).unwrap();
        loop {
            let Message::Text(text) = self.socket.read().unwrap() else { continue };
            let mut answer: Value = serde_json::from_str(&text).unwrap();
            if answer["id"] == id {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].take();
            }
            self.complaints.extend(complaint(&answer));
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// What of an event should not be: an error, a warning, a request beyond the page.
fn complaint(event: &Value) -> Option<String> {
    let parameters = &event["params"];
    let level = |value: &Value| matches!(value.as_str(), Some("error" | "warning" | "assert"));
    match event["method"].as_str()? {
        "Runtime.exceptionThrown" => Some(parameters["exceptionDetails"].to_string()),
        "Runtime.consoleAPICalled" if level(&parameters["type"]) => {
            Some(parameters["args"].to_string())
        }
        "Log.entryAdded" if level(&parameters["entry"]["level"]) => {
            Some(parameters["entry"]["text"].to_string()).filter(|text| !of_the_driver(text))
        }
        "Network.requestWillBeSent" => {
            let address = parameters["request"]["url"].as_str().unwrap_or_default();
            let own =
                ["file:", "data:", "blob:", "about:"].iter().any(|own| address.starts_with(own));
            (!own).then(|| format!("it asked for {address}"))
        }
        _ => None,
    }
}

/// WebGL in software says so, and that reading pixels back is slow there.
fn of_the_driver(text: &str) -> bool {
    text.contains("GL Driver Message") || text.contains("software WebGL")
}

/// What the protocol calls a key.
fn code(key: &str) -> String {
    match key {
        " " => "Space".into(),
        key if key.len() == 1 => format!("Key{}", key.to_uppercase()),
        key => key.into(),
    }
}

/// The program, where there is one.
fn find() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let named = |name: &str| {
        std::env::split_paths(&path).map(|dir| dir.join(name)).find(|file| file.is_file())
    };
    NAMES.into_iter().find_map(named)
}

/// Where the browser listens: it writes a file that says so.
fn address(profile: &Path) -> Option<(u16, String)> {
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        let text = std::fs::read_to_string(profile.join("DevToolsActivePort")).unwrap_or_default();
        let mut lines = text.lines();
        if let (Some(port), Some(path)) = (lines.next(), lines.next()) {
            return Some((port.parse().ok()?, path.to_owned()));
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    None
}
