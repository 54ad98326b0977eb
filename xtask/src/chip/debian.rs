//! Installing Debian packages: done if permitted, else reported.

use anyhow::{Context as _, Result, bail};

use crate::command::{find, output, program};

/// Installs packages, or names the packages to install.
///
/// # Errors
/// Where this is not Debian, not root, or the installation failed; `purpose` and `otherwise`,
/// a remedy that does not need Debian, become part of the message.
pub fn install(purpose: &str, packages: &[&str], otherwise: &str) -> Result<()> {
    let packages_line = packages.join(" ");
    if find("apt-get").is_none() {
        bail!("{purpose} is missing: {otherwise} (on Debian: apt-get install {packages_line})");
    }
    if output(program("id").arg("-u")).map(|id| id.trim() != "0").unwrap_or(true) {
        bail!("{purpose} is missing: sudo apt-get install {packages_line}; or {otherwise}");
    }
    println!("installing {packages_line} for {purpose}");
    // The package lists of a fresh machine are empty or old, and old lists offer old compilers. A
    // machine without a mirror may have the packages all the same: the installation decides.
    let refreshed = apt(&["update"], &[]);
    if let Err(error) = &refreshed {
        println!("the package lists could not be refreshed: {error:#}");
    }
    apt(&["install"], packages)
        .with_context(|| format!("{purpose} is missing and could not be installed; {otherwise}"))
}

fn apt(action: &[&str], packages: &[&str]) -> Result<()> {
    // Its many lines are of interest only where it fails, and then they are part of the error.
    output(
        program("apt-get")
            // Another installation may hold the lock for a while.
            .args(["-qq", "-o", "DPkg::Lock::Timeout=300", "-y", "--no-install-recommends"])
            .args(action)
            .args(packages)
            .env("DEBIAN_FRONTEND", "noninteractive"),
    )
    .map(drop)
}
