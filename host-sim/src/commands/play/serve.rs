//! A page served on this machine, and its scene as the file changes.
//!
//! `(page, file) => URL; GET => page, or the file's text`. The server listens only on the loopback address, and answers
//! only requests with the token in the URL and this address as host, so that no other page and no other user of
//! the machine can read a scene.

use std::path::Path;

use dbd_play::page::Page;
use dbd_scene::file::read_text;
use serde_json::json;
use tiny_http::{Header, Method, Request, Response, Server, StatusCode};

use crate::commands::play::{PlayError, made};
use crate::terminal::SceneFile;

/// Serves a page until a signal ends the program; `on_ready` is called with its URL.
///
/// # Errors
/// If the port is in use or the module is invalid.
pub fn serve(
    page: Page,
    module: &[u8],
    file: &Path,
    port: Option<u16>,
    on_ready: &mut dyn FnMut(&str),
) -> Result<(), PlayError> {
    let port = port.unwrap_or(0);
    let refused = |reason: String| PlayError::Serve { port, reason };
    let token = token().map_err(|error| refused(error.to_string()))?;
    let page = Page { reload: Some(format!("/{token}/scene")), ..page };
    let html = made(&page, module)?;
    let server = Server::http(("127.0.0.1", port)).map_err(|error| refused(error.to_string()))?;
    let bound = server.server_addr().to_ip().map_or(port, |address| address.port());
    let site = Site { html, token, port: bound };
    on_ready(&format!("http://127.0.0.1:{bound}/{}/", site.token));
    for request in server.incoming_requests() {
        let answer = site.answer(&request, file);
        // A closed browser needs no answer.
        let _ = request.respond(answer);
    }
    Ok(())
}

/// 128 random bits in hexadecimal.
fn token() -> Result<String, getrandom::Error> {
    let mut bits = [0; 16];
    getrandom::fill(&mut bits)?;
    Ok(format!("{:032x}", u128::from_be_bytes(bits)))
}

struct Site {
    html: String,
    token: String,
    port: u16,
}

impl Site {
    fn answer(&self, request: &Request, file: &Path) -> Response<std::io::Cursor<Vec<u8>>> {
        let host = request.headers().iter().find(|header| header.field.equiv("Host"));
        let names = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let known = host.is_some_and(|host| names.iter().any(|name| host.value.as_str() == name));
        let path = request.url();
        let rest = path.strip_prefix('/').and_then(|path| path.strip_prefix(&self.token));
        match rest {
            Some(rest) if known && *request.method() == Method::Get => match rest {
                "/" | "" => answer(200, "text/html; charset=utf-8", self.html.clone()),
                "/scene" => match read_text(file) {
                    Ok(text) => {
                        let version = SceneFile::new(String::new(), String::new(), &text).hash;
                        let said = json!({ "version": version, "text": text });
                        answer(200, "application/json", said.to_string())
                    }
                    Err(reason) => {
                        let said = json!({ "error": format!("cannot read the file: {reason}") });
                        answer(200, "application/json", said.to_string())
                    }
                },
                _ => answer(404, "text/plain", "page not found\n".into()),
            },
            _ => answer(403, "text/plain", "the URL lacks its token\n".into()),
        }
    }
}

fn answer(status: u16, kind: &str, text: String) -> Response<std::io::Cursor<Vec<u8>>> {
    let headers = [
        ("Content-Type", kind),
        ("Cache-Control", "no-store"),
        ("Referrer-Policy", "no-referrer"),
        ("X-Content-Type-Options", "nosniff"),
    ];
    let response = Response::from_data(text).with_status_code(StatusCode(status));
    headers.into_iter().fold(response, |response, (name, value)| {
        match Header::from_bytes(name, value) {
            Ok(header) => response.with_header(header),
            Err(()) => response,
        }
    })
}
