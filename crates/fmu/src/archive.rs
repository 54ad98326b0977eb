//! The FMU: an archive of the model description, the libraries, the resources and a documentation page.
//!
//! `(resource, version, libraries) => bytes`. The same input gives the same bytes.

use std::io::{Cursor, Write as _};

use dbd_plant::instance::{Blueprint, InstanceError, Settings};
use miette::Diagnostic;
use thiserror::Error;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use crate::description::Description;
use crate::page::page;
use crate::resource::Resource;
use crate::token::token;
use crate::xml::{Fmi, IDENTIFIER, model_description};

/// The name of the library file of a build.
pub const LIBRARY: &str = if cfg!(windows) {
    "dbd_fmu.dll"
} else if cfg!(target_os = "macos") {
    "libdbd_fmu.dylib"
} else {
    "libdbd_fmu.so"
};

/// A library for an FMU.
#[derive(Clone, Debug)]
pub struct Library {
    bytes: Vec<u8>,
    /// Its folder in FMI 2 and 3, and its file extension.
    place: (&'static str, &'static str, &'static str),
}

/// Why an FMU cannot be made.
#[derive(Debug, Error, Diagnostic)]
pub enum ArchiveError {
    /// The scene or its settings are refused.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Instance(#[from] InstanceError),
    /// A file is not a library of this version.
    #[error("{file} is not a library of dbd-fmu {}: {reason}", env!("CARGO_PKG_VERSION"))]
    #[diagnostic(help("build it with `cargo build --release -p dbd-fmu`"))]
    Library {
        /// The file.
        file: String,
        /// The problem.
        reason: &'static str,
    },
    /// The archive cannot be written.
    #[error("cannot create the archive: {0}")]
    Archive(#[from] zip::result::ZipError),
}

impl From<std::io::Error> for ArchiveError {
    fn from(error: std::io::Error) -> Self {
        Self::Archive(error.into())
    }
}

/// Text contained in every library of this version.
#[used]
static MARK: [u8; MARKED.len()] = {
    let (mut mark, mut at) = ([0; MARKED.len()], 0);
    while at < mark.len() {
        mark[at] = MARKED.as_bytes()[at];
        at += 1;
    }
    mark
};
const MARKED: &str = concat!("dbd-fmu reads resources of ", env!("CARGO_PKG_VERSION"));

impl Library {
    /// A library from its bytes; messages refer to it as `file`.
    ///
    /// # Errors
    /// [`ArchiveError::Library`].
    pub fn new(file: impl Into<String>, bytes: Vec<u8>) -> Result<Self, ArchiveError> {
        let file = file.into();
        let refuse = |reason| Err(ArchiveError::Library { file: file.clone(), reason });
        let machine =
            |at: usize| bytes.get(at..at + 2).map_or(0, |m| u16::from(m[0]) | u16::from(m[1]) << 8);
        let place = match bytes.get(..4) {
            Some(b"\x7fELF") if machine(18) == 62 => ("linux64", "x86_64-linux", "so"),
            Some(b"\x7fELF") if machine(18) == 183 => ("aarch64-linux", "aarch64-linux", "so"),
            Some([b'M', b'Z', ..]) => ("win64", "x86_64-windows", "dll"),
            Some(b"\xcf\xfa\xed\xfe") if machine(4) == 7 => ("darwin64", "x86_64-darwin", "dylib"),
            Some(b"\xcf\xfa\xed\xfe") => ("aarch64-darwin", "aarch64-darwin", "dylib"),
            _ => return refuse("not a 64-bit library for Linux, Windows or macOS"),
        };
        if !bytes.windows(MARK.len()).any(|part| part == MARK) {
            return refuse("it does not read the resources of this version");
        }
        Ok(Self { bytes, place })
    }
}

/// An FMU and its description.
#[derive(Clone, Debug)]
pub struct Fmu {
    /// The archive.
    pub bytes: Vec<u8>,
    /// Its description for importers.
    pub description: Description,
}

/// Makes an FMU from a scene. The scene is built first.
///
/// # Errors
/// [`ArchiveError`].
pub fn archive(
    blueprint: Blueprint,
    settings: Settings,
    fmi: Fmi,
    libraries: &[Library],
) -> Result<Fmu, ArchiveError> {
    let (resource, instance) = Resource::new(blueprint, settings)?;
    let description = Description::of(&instance)?;
    let token = token(&description, &resource, fmi);
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    let mut add = |name: &str, bytes: &[u8]| {
        zip.start_file(name, options)?;
        Ok::<_, ArchiveError>(zip.write_all(bytes)?)
    };
    add("modelDescription.xml", model_description(&description, fmi, &token).as_bytes())?;
    for library in libraries {
        let (two, three, ending) = library.place;
        let folder = if fmi == Fmi::Two { two } else { three };
        add(&format!("binaries/{folder}/{IDENTIFIER}.{ending}"), &library.bytes)?;
    }
    for (name, text) in resource.files() {
        add(&format!("resources/{name}"), text.as_bytes())?;
    }
    add("documentation/index.html", page(&description, &resource).as_bytes())?;
    Ok(Fmu { bytes: zip.finish()?.into_inner(), description })
}
