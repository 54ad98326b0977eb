//! `host-sim completions`: a script with which a shell completes commands, options and scenes.
//!
//! `(command line, names of scenes, shell) => script`. The names are the present ones.

use clap::Command;
use clap::builder::PossibleValuesParser;
use clap_complete::{Shell, generate};

/// The argument that takes a scene.
const SCENE: &str = "scene";

/// The script of a shell. For scene arguments it offers names and files.
#[must_use]
pub fn script(mut command: Command, names: &[String], shell: Shell) -> String {
    // Other names would need shell-specific quoting.
    let plain =
        |name: &&String| name.bytes().all(|b| b.is_ascii_alphanumeric() || b"._-".contains(&b));
    let names: Vec<&String> = names.iter().filter(plain).collect();
    let takers: Vec<String> = command
        .get_subcommands()
        .filter(|sub| sub.get_arguments().any(|argument| argument.get_id() == SCENE))
        .map(|sub| sub.get_name().to_owned())
        .collect();
    // Bash offers files by itself if no name fits.
    if shell == Shell::Bash {
        for taker in &takers {
            let names = PossibleValuesParser::new(names.iter().copied());
            command = command
                .mut_subcommand(taker, |sub| sub.mut_arg(SCENE, |scene| scene.value_parser(names)));
        }
    }
    let program = command.get_name().to_owned();
    let mut script = Vec::new();
    generate(shell, &mut command, &program, &mut script);
    let script = String::from_utf8_lossy(&script).into_owned();
    let names = names.iter().map(|name| name.as_str()).collect::<Vec<_>>().join(" ");
    match shell {
        // The generator calls a function by one name and its states by another where the program's
        // name holds a hyphen.
        Shell::Bash => {
            script.replace(&program.replace('-', "__subcmd__"), &program.replace('-', "__"))
        }
        Shell::Zsh => names_or_files(&script, &names),
        Shell::Fish => {
            let takers = takers.join(" ");
            format!(
                "{script}complete -c {program} -n \"__fish_seen_subcommand_from {takers}\" \
                 -a \"{names}\"\n"
            )
        }
        _ => script,
    }
}

/// Zsh's script with names in addition to files for a scene.
fn names_or_files(script: &str, names: &str) -> String {
    let offered = format!(":{{_alternative \"scenes:scene:({names})\" \"files:file:_files\"}}' \\");
    let line = |line: &str| match line.strip_suffix(":_files' \\") {
        Some(begin) if begin.starts_with("':scene ") => format!("{begin}{offered}\n"),
        _ => format!("{line}\n"),
    };
    script.lines().map(line).collect()
}

#[cfg(test)]
mod tests {
    use clap::{Arg, ValueHint};

    use super::*;

    #[test]
    fn every_shell_offers_the_scenes_that_need_no_quotes() {
        let scene = Arg::new(SCENE).required(true).help("A scene").value_hint(ValueHint::FilePath);
        let command = Command::new("sim").subcommand(Command::new("run").arg(scene));
        let names = ["four-bar", "3rrr", "it's"].map(str::to_owned);
        for (shell, offered) in [
            (Shell::Bash, "opts=\"-h --help four-bar 3rrr\""),
            (Shell::Zsh, "\"scenes:scene:(four-bar 3rrr)\" \"files:file:_files\""),
            (Shell::Fish, "from run\" -a \"four-bar 3rrr\""),
        ] {
            let script = script(command.clone(), &names, shell);
            assert!(script.contains(offered), "{shell}: {script}");
            assert!(!script.contains("it's"), "{shell}: {script}");
        }
    }
}
