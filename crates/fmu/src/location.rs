//! The folder of an FMU's resources, from an importer's argument.
//!
//! `file:///tmp/a%20b/resources => /tmp/a b/resources`. FMI 2 gives a URI, FMI 3 a path; importers mix them up.

use std::path::PathBuf;

/// The folder given by a URI or a path.
///
/// # Errors
/// The log message: it is not a local folder.
pub fn folder(location: &str) -> Result<PathBuf, String> {
    let Some(rest) = location.strip_prefix("file:") else {
        if location.is_empty() || location.contains("://") {
            return Err(format!("resource location \"{location}\" is not a folder"));
        }
        return Ok(PathBuf::from(location));
    };
    let path = match rest.strip_prefix("//") {
        Some(rest) => {
            let (host, path) = rest.split_at(rest.find('/').unwrap_or(rest.len()));
            if !(host.is_empty() || host == "localhost") {
                return Err(format!("resource location \"{location}\" is on another machine"));
            }
            path
        }
        None => rest,
    };
    // A drive letter follows the slash.
    let path = if cfg!(windows) { path.strip_prefix('/').unwrap_or(path) } else { path };
    Ok(PathBuf::from(decoded(path)))
}

/// With `%20` as a space.
fn decoded(path: &str) -> String {
    let (bytes, mut all, mut at) = (path.as_bytes(), Vec::new(), 0);
    while at < bytes.len() {
        let code = (bytes[at] == b'%').then(|| path.get(at + 1..at + 3)).flatten();
        match code.and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) => {
                all.push(byte);
                at += 3;
            }
            None => {
                all.push(bytes[at]);
                at += 1;
            }
        }
    }
    String::from_utf8_lossy(&all).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_a_uri_or_a_path() {
        for (location, path) in [
            ("file:///tmp/a%20b/resources", "/tmp/a b/resources"),
            ("file:/tmp/x/", "/tmp/x/"),
            ("file://localhost/tmp/%C3%A4", "/tmp/ä"),
            ("/tmp/100%/", "/tmp/100%/"),
            ("file:///tmp/100%", "/tmp/100%"),
        ] {
            assert_eq!(folder(location), Ok(PathBuf::from(path)));
        }
        for location in ["", "http://a/b", "file://server/b"] {
            assert!(folder(location).is_err(), "{location}");
        }
    }
}
