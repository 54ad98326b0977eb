//! Files that a user or another file names.
//!
//! `path => bytes, text`. Only regular files of limited size are read: a device or pipe may be endless, and opening
//! it may block.

use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::Path;

/// \[byte\] maximum size of a text file.
pub const MAX_BYTES: u64 = 64 << 20;

/// Opens a regular file to read it.
///
/// # Errors If it cannot be opened or is not a regular file.
pub fn open(path: impl AsRef<Path>) -> io::Result<File> {
    // Before opening, which may block indefinitely; and after it, because the path may have changed.
    check_kind(&fs::metadata(path.as_ref())?)?;
    let file = File::open(path)?;
    check_kind(&file.metadata()?)?;
    Ok(file)
}

fn check_kind(metadata: &Metadata) -> io::Result<()> {
    match (metadata.is_file(), metadata.is_dir()) {
        (true, _) => Ok(()),
        (_, true) => Err(io::Error::other("it is a folder, not a regular file")),
        _ => Err(io::Error::other("it is not a regular file")),
    }
}

/// The bytes of a regular file of at most `limit` bytes.
///
/// # Errors If it cannot be read, is not a regular file, or is larger.
pub fn read(path: impl AsRef<Path>, limit: u64) -> io::Result<Vec<u8>> {
    let file = open(path)?;
    // Files known to be too large are not read.
    if file.metadata()?.len() > limit {
        return Err(too_large(limit));
    }
    limited(file, limit)
}

/// The text of a regular file of at most [`MAX_BYTES`].
///
/// # Errors If it cannot be read, is not a regular file, is larger, or is not UTF-8.
pub fn read_text(path: impl AsRef<Path>) -> io::Result<String> {
    text(read(path, MAX_BYTES)?)
}

/// The text of a stream of at most [`MAX_BYTES`], such as standard input.
///
/// # Errors If it cannot be read, is longer, or is not UTF-8.
pub fn read_stream(stream: impl Read) -> io::Result<String> {
    text(limited(stream, MAX_BYTES)?)
}

fn limited(stream: impl Read, limit: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    stream.take(limit.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Err(too_large(limit));
    }
    Ok(bytes)
}

fn too_large(limit: u64) -> io::Error {
    io::Error::other(format!("it is larger than {} MiB", limit >> 20))
}

fn text(bytes: Vec<u8>) -> io::Result<String> {
    let wrong = |_| io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8 text");
    String::from_utf8(bytes).map_err(wrong)
}
