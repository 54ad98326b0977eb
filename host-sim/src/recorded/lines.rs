//! A text of any size, line by line, with a check that it is unchanged.
//!
//! `file => lines, their numbers, a hash of all`. Only one line is in memory at a time. Line ends may have been
//! converted to those of another system; nothing else may differ.

use std::fs::File;
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};

use dbd_scene::file::open;

use crate::recorded::unreadable::Unreadable;
use crate::report::trace::TextHash;

/// The remedy for a file that another program has written.
const AS_WRITTEN: &str = "compare needs the file exactly as `run` wrote it; what a spreadsheet or an editor has saved \
                          is another";

/// The lines of a file.
#[derive(Debug)]
pub struct Lines {
    file: PathBuf,
    input: BufReader<File>,
    buffer: Vec<u8>,
    number: u64,
    whole: bool,
    hash: TextHash,
}

/// First bytes of files that are not UTF-8 text.
const BEGINNINGS: [(&[u8], &str); 5] = [
    (&[0xff, 0xfe], "the file is UTF-16"),
    (&[0xfe, 0xff], "the file is UTF-16"),
    (&[0xef, 0xbb, 0xbf], "the file begins with a byte order mark, which `run` does not write"),
    (&[0x1f, 0x8b], "the file is compressed (gzip)"),
    (b"PK", "the file is an archive (zip)"),
];

impl Lines {
    /// Opens a file.
    ///
    /// # Errors
    /// If it cannot be read, or its first bytes are not UTF-8 text.
    pub fn open(file: &Path) -> Result<Self, Unreadable> {
        let failed = |reason| Unreadable::system(file, &reason);
        let mut input = BufReader::new(open(file).map_err(failed)?);
        let start = input.fill_buf().map_err(failed)?;
        if start.is_empty() {
            return Err(Unreadable::new(file, "is empty"));
        }
        if let Some((_, what)) = BEGINNINGS.iter().find(|(bytes, _)| start.starts_with(bytes)) {
            let wrong = Unreadable::new(file, *what).at_line(1).at_column(1);
            return Err(wrong.with_remedy(AS_WRITTEN));
        }
        let (buffer, hash) = (Vec::new(), TextHash::default());
        Ok(Self { file: file.to_owned(), input, buffer, number: 0, whole: true, hash })
    }

    /// The next line without its end; `None` after the last. A trace has no line of more than `limit` bytes.
    ///
    /// # Errors
    /// Where it cannot be read, is longer, or is not UTF-8.
    pub fn next(&mut self, limit: u64) -> Result<Option<&str>, Unreadable> {
        self.buffer.clear();
        let read = (&mut self.input).take(limit + 2).read_until(b'\n', &mut self.buffer);
        if read.map_err(|reason| Unreadable::system(&self.file, &reason))? == 0 {
            return Ok(None);
        }
        self.number += 1;
        self.whole = self.buffer.pop_if(|byte| *byte == b'\n').is_some();
        if self.whole {
            self.buffer.pop_if(|byte| *byte == b'\r');
        } else if self.buffer.len() as u64 > limit {
            return Err(
                self.wrong(format!("the line is longer than {limit} bytes, the limit for a row"))
            );
        }
        self.hash.add(&self.buffer);
        if self.whole {
            self.hash.add(b"\n");
        }
        match std::str::from_utf8(&self.buffer) {
            Ok(line) => Ok(Some(line)),
            Err(error) => {
                let column = 1 + String::from_utf8_lossy(&self.buffer[..error.valid_up_to()])
                    .chars()
                    .count();
                let byte = self.buffer[error.valid_up_to()];
                let wrong =
                    self.wrong(format!("the byte {byte:#04x} is not UTF-8")).at_column(column);
                Err(wrong.with_remedy(AS_WRITTEN))
            }
        }
    }

    /// The file.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The number of the last line read, from 1.
    #[must_use]
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Whether the last line read had a line end; if not, the file was truncated within it.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.whole
    }

    /// The hash of all lines read, each with one byte for its end.
    #[must_use]
    pub fn hash(&self) -> TextHash {
        self.hash
    }

    /// An error in the last line read.
    #[must_use]
    pub fn wrong(&self, problem: impl Into<String>) -> Unreadable {
        Unreadable::new(&self.file, problem).at_line(self.number.max(1))
    }
}
