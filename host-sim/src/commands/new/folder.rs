//! A folder of files that appears whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::Builder;

/// Writes files, named by their path below the folder, which must not exist yet.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] where something has the folder's name; whatever keeps a file from
/// being written. Nothing is left behind then.
pub fn write(folder: &Path, files: &[(PathBuf, String)]) -> io::Result<()> {
    // A dangling link exists, too.
    if folder.symlink_metadata().is_ok() {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    let beside = folder.parent().filter(|beside| *beside != Path::new(""));
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    let mut builder = Builder::new();
    let prefix = format!(".{name}.");
    builder.prefix(&prefix);
    #[cfg(unix)]
    {
        // Like any folder a program makes, not private as temporary ones are by default.
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(fs::Permissions::from_mode(0o777));
    }
    let unfinished = builder.tempdir_in(beside.unwrap_or(Path::new(".")))?;
    for (path, text) in files {
        let path = unfinished.path().join(path);
        fs::create_dir_all(path.parent().unwrap_or(unfinished.path()))?;
        fs::write(path, text)?;
    }
    fs::rename(unfinished.path(), folder)?;
    // It has been renamed, so there is no temporary folder to remove.
    let _ = unfinished.keep();
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_appears_whole_or_not_at_all() {
        let here = tempfile::tempdir().unwrap();
        let folder = here.path().join("new");
        let file = |name: &str| (PathBuf::from(name), name.to_owned());
        // A file cannot lie below a file: the second fails when the first is written.
        assert!(write(&folder, &[file("a"), file("a/b")]).is_err());
        assert_eq!(fs::read_dir(here.path()).unwrap().count(), 0);
        write(&folder, &[file("a"), file("b/c")]).unwrap();
        assert_eq!(fs::read_to_string(folder.join("b/c")).unwrap(), "b/c");
        let again = write(&folder, &[file("d")]).unwrap_err();
        assert_eq!(again.kind(), io::ErrorKind::AlreadyExists);
        assert!(!folder.join("d").exists());
        assert_eq!(fs::read_dir(here.path()).unwrap().count(), 1);
        assert!(write(&here.path().join("none/new"), &[file("a")]).is_err());
    }
}
