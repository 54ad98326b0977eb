//! Requests and answers in JSON between a page and its plant.
//!
//! `{"do": …} => answer | {"error": …}`. Steps and frames have separate calls, [`Desk::advance`] and [`Desk::frame`].

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use dbd_plant::instance::Settings;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::refused::Refused;
use crate::session::{Change, Grab, Opened, Session, Set};

/// A request of a page.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "do", rename_all = "lowercase", deny_unknown_fields)]
enum Request {
    Open {
        file: String,
        text: String,
        #[serde(default)]
        settings: Settings,
        #[serde(default)]
        set: Set,
    },
    Change {
        text: Option<String>,
        settings: Option<Settings>,
        set: Option<Set>,
    },
    Input {
        row: usize,
        value: f64,
    },
    Reset {},
    Grab {
        body: usize,
        point: [f64; 3],
        target: [f64; 3],
        speed: f64,
    },
    Release {},
    Mark {},
    Rewind {
        mark: usize,
    },
    Save {},
    Restore {
        base64: String,
    },
    Diagnose {},
    Watch {
        rows: Vec<usize>,
    },
    Row {},
    Table {},
    Scene {},
}

/// Answer to a request that opens or changes a plant.
#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    opened: Opened,
    /// Whether the run restarted at t = 0.
    restarted: bool,
    /// Why it does.
    why: Option<String>,
}

/// Where requests are answered.
#[derive(Default)]
pub struct Desk {
    session: Option<Session>,
}

impl Desk {
    /// Answers a request of JSON in JSON.
    pub fn ask(&mut self, request: &str) -> String {
        let answer = serde_json::from_str(request)
            .map_err(|error| {
                Refused::new(format!("not a valid request: {error}"), "see dbd_play::ask")
            })
            .and_then(|request| self.answer(request))
            .unwrap_or_else(|refused| json!({ "error": refused }));
        answer.to_string()
    }

    /// Advances by the given number of steps; returns the number done.
    pub fn advance(&mut self, steps: u64) -> u64 {
        self.session.as_mut().map_or(0, |session| session.advance(steps))
    }

    /// The present frame; empty where nothing is open.
    pub fn frame(&mut self) -> &[f64] {
        self.session.as_mut().map_or(&[], Session::frame)
    }

    fn answer(&mut self, request: Request) -> Result<Value, Refused> {
        if let Request::Open { file, text, settings, set } = request {
            let session = Session::open(Change { file, text, settings, set })?;
            let opened = session.opened();
            self.session = Some(session);
            return Ok(json!(Answer { opened, restarted: true, why: None }));
        }
        let nothing = || Refused::new("no scene is open", "open a scene first");
        let session = self.session.as_mut().ok_or_else(nothing)?;
        match request {
            Request::Open { .. } => {}
            Request::Change { text, settings, set } => {
                let mut asked = session.asked().clone();
                asked.text = text.unwrap_or(asked.text);
                asked.settings = settings.unwrap_or(asked.settings);
                asked.set = set.unwrap_or(asked.set);
                let why = session.change(asked)?;
                let opened = session.opened();
                return Ok(json!(Answer { opened, restarted: why.is_some(), why }));
            }
            Request::Input { row, value } => session.set_input(row, value)?,
            Request::Reset {} => session.reset(),
            Request::Grab { body, point, target, speed } => {
                session.grab(Some(Grab { body, point, target, speed }))?;
            }
            Request::Release {} => session.grab(None)?,
            Request::Mark {} => {
                let (marks, [first, last]) = session.mark();
                return Ok(json!({ "marks": marks, "first": first, "last": last }));
            }
            Request::Rewind { mark } => {
                session.rewind(mark)?;
                return Ok(now(session));
            }
            Request::Save {} => {
                let (bytes, name) = (session.save()?, &session.instance().scene().name);
                let file = format!("{name}.snapshot");
                return Ok(json!({ "base64": STANDARD.encode(bytes), "file": file }));
            }
            Request::Restore { base64 } => {
                let damaged =
                    |_| Refused::new("the text is not valid base64", "give a saved snapshot");
                session.restore(&STANDARD.decode(base64).map_err(damaged)?)?;
                return Ok(now(session));
            }
            Request::Diagnose {} => {
                return Ok(match session.diagnose() {
                    Some((text, help)) => json!({ "text": text, "help": help }),
                    None => json!({ "text": null, "help": null }),
                });
            }
            Request::Watch { rows } => {
                session.watch(rows)?;
                return Ok(json!({ "layout": session.layout() }));
            }
            Request::Row {} => return Ok(json!({ "values": session.instance().values() })),
            Request::Table {} => return Ok(json!({ "toml": session.replay() })),
            Request::Scene {} => {
                let (text, set) = session.scene_text();
                return Ok(json!({ "text": text, "set": set.trim_start() }));
            }
        }
        Ok(json!({}))
    }
}

/// State that may differ from the page's after going back in time.
fn now(session: &Session) -> Value {
    let instance = session.instance();
    let inputs: Vec<_> =
        (0..instance.inputs().len()).map(|row| instance.input_value(row)).collect();
    json!({ "time": instance.time(), "set": session.asked().set, "inputs": inputs, "opened": session.opened() })
}
