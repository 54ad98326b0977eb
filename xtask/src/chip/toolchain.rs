//! The compiler for another target: one of three methods, and its cargo command.
//!
//! 1. prebuilt: the host's toolchain has the target's libraries.
//! 2. rust-src: it has the library sources, from which cargo builds `core`.
//! 3. debian: Debian's compiler and its matching library sources.
//!
//! Nothing is downloaded through rustup on the user's behalf.

use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::chip::debian;
use crate::command::{cargo, cargo_at, find, output, program, target_dir};

/// The variable that selects one method.
const OVERRIDE: &str = "DBD_TOOLCHAIN";
const DEBIAN_PACKAGES: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];
const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_CARGO: &str = "/usr/bin/cargo";
const DEBIAN_SYSROOT: &str = "/usr";
/// Below a sysroot: present where the library sources are.
const LIBRARY_SOURCE: &str = "lib/rustlib/src/rust/library/core/src/lib.rs";

/// A compiler for one target.
#[derive(Clone, Debug)]
pub struct Toolchain {
    way: Way,
    target: String,
    linker: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    Prebuilt,
    RustSrc,
    Debian,
}

impl Toolchain {
    /// Finds the first method that works for the target; Debian's packages are installed last.
    ///
    /// # Errors
    /// If no method works, or the selected one does not; the remedies are named.
    pub fn find(target: &str) -> Result<Self> {
        Self::with_linker(target, None)
    }

    /// The same for a target that has a linker of its own.
    ///
    /// # Errors
    /// As [`Toolchain::find`].
    pub fn with_linker(target: &str, own: Option<PathBuf>) -> Result<Self> {
        let demanded = demanded()?;
        let sysroot = host_sysroot()?;
        let way = match demanded {
            Some(way) => way,
            None if has_prebuilt(target) => Way::Prebuilt,
            None if sysroot.join(LIBRARY_SOURCE).is_file() => Way::RustSrc,
            None => Way::Debian,
        };
        match way {
            Way::Prebuilt if !has_prebuilt(target) => {
                bail!("{OVERRIDE}=prebuilt: the target is missing: rustup target add {target}");
            }
            Way::RustSrc if !sysroot.join(LIBRARY_SOURCE).is_file() => {
                bail!(
                    "{OVERRIDE}=rust-src: its sources are missing: rustup component add rust-src"
                );
            }
            Way::Debian => complete_debian(target)?,
            _ => {}
        }
        let linker = match way {
            _ if own.is_some() => own,
            // The toolchain that has the target has its linker too.
            Way::Prebuilt => None,
            Way::RustSrc | Way::Debian => Some(linker(&sysroot)?),
        };
        Ok(Self { way, target: target.to_owned(), linker })
    }

    /// The line that names the chosen method.
    ///
    /// # Errors
    /// Where the compiler does not run.
    pub fn describe(&self) -> Result<String> {
        Ok(format!("target toolchain: {} for {}", self.describe_compiler()?, self.target))
    }

    /// The compiler's name, version and method, on which instruction counts depend.
    ///
    /// # Errors
    /// Where the compiler does not run.
    pub fn describe_compiler(&self) -> Result<String> {
        let (name, mut rustc) = match self.way {
            Way::Prebuilt => ("prebuilt", host_rustc()),
            Way::RustSrc => ("rust-src", host_rustc()),
            Way::Debian => ("debian", program(DEBIAN_RUSTC)),
        };
        let version = output(self.clean(rustc.arg("--version")))?;
        let version = version.split_whitespace().take(2).collect::<Vec<_>>().join(" ");
        Ok(format!("{version} ({name})"))
    }

    /// The manifest of the library sources that it builds, `None` where it builds none.
    ///
    /// # Errors
    /// Where the compiler does not run.
    pub fn library_manifest(&self) -> Result<Option<PathBuf>> {
        let below = |sysroot: &Path| sysroot.join("lib/rustlib/src/rust/library/Cargo.toml");
        Ok(match self.way {
            Way::Prebuilt => None,
            Way::RustSrc => Some(below(&host_sysroot()?)),
            Way::Debian => Some(below(Path::new(DEBIAN_SYSROOT))),
        })
    }

    /// The triple of its target.
    pub fn target(&self) -> &str {
        &self.target
    }

    /// Where its images lie.
    pub fn target_dir(&self) -> PathBuf {
        match self.way {
            // Two compilers must not share one directory.
            Way::Debian => target_dir().join("debian"),
            Way::Prebuilt | Way::RustSrc => target_dir(),
        }
    }

    /// Where the images of a profile lie.
    pub fn images(&self, profile: &str) -> PathBuf {
        self.target_dir().join(&self.target).join(profile)
    }

    /// `cargo SUBCOMMAND` for the target; `libraries` as for build-std: `core`, `core,alloc`, `std,…`.
    pub fn cargo(&self, subcommand: &str, libraries: &str) -> Command {
        let mut command = match self.way {
            Way::Debian => cargo_at(DEBIAN_CARGO),
            Way::Prebuilt | Way::RustSrc => cargo(),
        };
        self.clean(&mut command);
        command.arg(subcommand);
        if self.way == Way::Debian {
            command.env("RUSTC", DEBIAN_RUSTC).env("CARGO_TARGET_DIR", self.target_dir());
        }
        if self.way != Way::Prebuilt {
            // build-std is unstable, the libraries it builds are those of this very compiler.
            command.env("RUSTC_BOOTSTRAP", "1").args(["-Z", &format!("build-std={libraries}")]);
        }
        if let Some(linker) = &self.linker {
            let name = self.target.to_uppercase().replace(['-', '.'], "_");
            command.env(format!("CARGO_TARGET_{name}_LINKER"), linker);
        }
        command.args(["--target", &self.target]);
        command
    }

    /// `cargo SUBCOMMAND` for several targets, a command for all that are had in the same way: cargo then
    /// builds for them side by side.
    pub fn cargo_for(toolchains: &[Self], subcommand: &str, libraries: &str) -> Vec<Command> {
        let mut commands: Vec<(Way, Command)> = Vec::new();
        for toolchain in toolchains {
            match commands.iter_mut().find(|(way, _)| *way == toolchain.way) {
                Some((_, command)) => drop(command.args(["--target", &toolchain.target])),
                None => commands.push((toolchain.way, toolchain.cargo(subcommand, libraries))),
            }
        }
        commands.into_iter().map(|(_, command)| command).collect()
    }

    /// `cargo SUBCOMMAND` for the machine that it runs on, with the same compiler.
    pub fn host_cargo(&self, subcommand: &str) -> Command {
        let mut command = match self.way {
            Way::Debian => cargo_at(DEBIAN_CARGO),
            Way::Prebuilt | Way::RustSrc => cargo(),
        };
        self.clean(&mut command);
        command.arg(subcommand).env("CARGO_TARGET_DIR", self.target_dir());
        if self.way == Way::Debian {
            command.env("RUSTC", DEBIAN_RUSTC);
        }
        if self.way != Way::Prebuilt {
            // As for the target: what a variable changes would be built twice.
            command.env("RUSTC_BOOTSTRAP", "1");
        }
        command
    }

    /// Debian's compiler must not see what rustup set for the host's.
    fn clean<'c>(&self, command: &'c mut Command) -> &'c mut Command {
        if self.way == Way::Debian {
            for variable in ["RUSTUP_TOOLCHAIN", "LD_LIBRARY_PATH", "CARGO", "RUSTC_WRAPPER"] {
                command.env_remove(variable);
            }
        }
        command
    }
}

fn demanded() -> Result<Option<Way>> {
    match std::env::var(OVERRIDE).as_deref() {
        Err(_) | Ok("") => Ok(None),
        Ok("prebuilt") => Ok(Some(Way::Prebuilt)),
        Ok("rust-src") => Ok(Some(Way::RustSrc)),
        Ok("debian") => Ok(Some(Way::Debian)),
        Ok(other) => bail!("{OVERRIDE}={other}: expected prebuilt, rust-src or debian"),
    }
}

fn host_rustc() -> Command {
    program(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

fn host_sysroot() -> Result<PathBuf> {
    let sysroot = output(host_rustc().args(["--print", "sysroot"]))?;
    Ok(PathBuf::from(sysroot.trim()))
}

fn has_prebuilt(target: &str) -> bool {
    let Ok(dir) = output(host_rustc().args(["--print", "target-libdir", "--target", target]))
    else {
        return false;
    };
    let Ok(files) = std::fs::read_dir(dir.trim()) else {
        return false;
    };
    files.filter_map(Result::ok).any(|file| {
        let name = file.file_name();
        let name = name.to_string_lossy();
        name.starts_with("libcore-") && name.ends_with(".rlib")
    })
}

/// Installs Debian's compiler where it is missing or older than the workspace demands.
fn complete_debian(target: &str) -> Result<()> {
    let needed = Version::parse(env!("CARGO_PKG_RUST_VERSION"))
        .context("rust-version is not set in Cargo.toml")?;
    let instead = format!("rustup target add {target}");
    if debian_version().is_none_or(|version| version < needed) {
        let purpose = format!("a compiler for {target}, version {needed} or later,");
        debian::install(&purpose, &DEBIAN_PACKAGES, &instead)?;
    }
    match debian_version() {
        Some(version) if version >= needed => Ok(()),
        Some(version) => bail!(
            "Debian's compiler for {target} is {version}, {needed} or later is needed: \
             apt-get install {} from a newer Debian or its security updates; or {instead}",
            DEBIAN_PACKAGES.join(" ")
        ),
        None => bail!("the packages {} contain no compiler", DEBIAN_PACKAGES.join(" ")),
    }
}

/// The version of Debian's compiler, where it is complete.
fn debian_version() -> Option<Version> {
    let source = Path::new(DEBIAN_SYSROOT).join(LIBRARY_SOURCE);
    let files = [Path::new(DEBIAN_RUSTC), Path::new(DEBIAN_CARGO), &source];
    if !files.iter().all(|file| file.is_file()) {
        return None;
    }
    let version = output(program(DEBIAN_RUSTC).arg("--version")).ok()?;
    Version::parse(version.split_whitespace().nth(1)?)
}

/// A compiler's version: major and minor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Version(u32, u32);

impl Version {
    fn parse(text: &str) -> Option<Self> {
        let mut parts = text.split('.').map(str::parse);
        match (parts.next(), parts.next()) {
            (Some(Ok(major)), Some(Ok(minor))) => Some(Self(major, minor)),
            _ => None,
        }
    }
}

impl fmt::Display for Version {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.0, self.1)
    }
}

/// An LLVM linker: the host toolchain's own, else one on PATH, else Debian's.
fn linker(sysroot: &Path) -> Result<PathBuf> {
    let version = output(host_rustc().arg("-vV"))?;
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    let host = host.context("`rustc -vV` prints no host")?;
    let own = sysroot.join("lib/rustlib").join(host).join("bin/rust-lld");
    if own.is_file() {
        return Ok(own);
    }
    if find("ld.lld").is_none() {
        debian::install("the linker lld", &["lld"], "install LLVM's lld")?;
    }
    find("ld.lld").context("the linker ld.lld is not on PATH")
}

#[cfg(test)]
mod tests {
    use super::Version;

    #[test]
    fn versions_are_ordered_by_number() {
        let version = |text| Version::parse(text).expect("it is one");
        assert!(version("1.85.0") < version("1.89"));
        assert!(version("1.100.0") > version("1.96.0-beta.1"));
        assert_eq!(Version::parse("rustc"), None);
    }
}
