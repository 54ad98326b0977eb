//! The program as a shell meets it: exit codes, signals, standard input, an empty folder, a full
//! disk.

use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

/// The program in a folder.
fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_host-sim"));
    command.current_dir(folder).args(arguments).stdin(Stdio::null());
    command
}

fn call(folder: &Path, arguments: &[&str]) -> Output {
    program(folder, arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// One ball that flies for so long.
fn ball(duration: &str) -> String {
    format!(
        "name = \"ball\"\nduration = {duration}\nstep = 1e-3\n[[body]]\nname = \"b\"\nmass = 1\n\
         inertia = [1, 1, 1]\nposition = [0, 0, 0]\n"
    )
}

#[test]
fn an_installed_program_brings_its_scenes() {
    let here = tempfile::tempdir().unwrap();
    let listed = call(here.path(), &["list", "--json"]);
    assert_eq!(listed.status.code(), Some(0));
    let scenes: Vec<Value> = serde_json::from_slice(&listed.stdout).unwrap();
    let ships = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes")).unwrap().count();
    assert_eq!(scenes.len(), ships);
    assert!(scenes.iter().all(|scene| scene["from"] == "built in"));
    let ran = call(here.path(), &["run", "four-bar", "--duration", "1ms"]);
    assert_eq!(ran.status.code(), Some(0), "{}", text(&ran.stderr));
    assert_eq!(names(&here.path().join("out")), ["four-bar"]);

    // A file of one's own comes before, and the list says so.
    fs::create_dir(here.path().join("scenes")).unwrap();
    fs::write(here.path().join("scenes/four-bar.toml"), ball("1")).unwrap();
    let listed = call(here.path(), &["list"]);
    let lines = || text(&listed.stdout).lines();
    let line = |name: &str| lines().find(|line| line.starts_with(name)).unwrap().to_owned();
    assert!(line("four-bar ").contains("scenes/") && line("four-bar ").contains(" 1 body "));
    assert!(line("3rrr ").contains("built in"));
    assert_eq!(lines().count(), ships);
}

#[test]
fn a_scene_comes_from_standard_input() {
    let here = tempfile::tempdir().unwrap();
    let calls: [&[&str]; 3] = [&["run", "-"], &["check", "-"], &["export", "-"]];
    for arguments in calls {
        let with = |scene: &str| -> Output {
            let mut command = program(here.path(), arguments);
            command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
            let mut child = command.spawn().unwrap();
            child.stdin.take().unwrap().write_all(scene.as_bytes()).unwrap();
            child.wait_with_output().unwrap()
        };
        let done = with(&ball("0.01"));
        assert_eq!(done.status.code(), Some(0), "{arguments:?}: {}", text(&done.stderr));
        let refused = with(&ball("-1"));
        assert_eq!(refused.status.code(), Some(2));
        assert!(text(&refused.stderr).contains("standard input:2:12"), "{}", text(&refused.stderr));
    }
    // It has no file's name, but one of its own.
    assert_eq!(names(&here.path().join("out")), ["ball"]);
}

#[test]
fn a_reader_that_has_gone_is_no_failure() {
    let here = tempfile::tempdir().unwrap();
    // More than a pipe holds.
    for arguments in [&["export", "macpherson"][..], &["list"], &["check", "four-bar"]] {
        let mut command = program(here.path(), arguments);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let done = child.wait_with_output().unwrap();
        assert_eq!((done.status.code(), text(&done.stderr)), (Some(0), ""), "{arguments:?}");
    }
}

/// Nothing is coloured in a pipe unasked; the command line goes before the environment.
#[test]
fn colours_are_for_terminals_unless_they_are_asked_for() {
    let here = tempfile::tempdir().unwrap();
    let coloured = |arguments: &[&str], variables: &[(&str, &str)]| {
        let mut command = program(here.path(), arguments);
        for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
            command.env_remove(name);
        }
        let done = command.envs(variables.iter().copied()).output().unwrap();
        [done.stdout, done.stderr].map(|bytes| bytes.contains(&0x1b))
    };
    let check = ["check", "four-bar"];
    let asked = ["check", "four-bar", "--color", "always"];
    assert_eq!(coloured(&check, &[]), [false; 2]);
    assert_eq!(coloured(&asked, &[]), [true, false]);
    assert_eq!(coloured(&asked, &[("NO_COLOR", "1")]), [true, false]);
    let forced = [("CLICOLOR_FORCE", "1")];
    assert_eq!(coloured(&check, &forced), [true, false]);
    assert_eq!(coloured(&["check", "four-bar", "--color=never"], &forced), [false; 2]);
    assert_eq!(coloured(&["check", "none"], &forced), [false, true]);
    assert_eq!(coloured(&["run", "--help"], &forced), [true, false]);
    assert_eq!(coloured(&["run", "--help"], &[]), [false; 2]);
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_written_end_with_1() {
    let here = tempfile::tempdir().unwrap();
    fs::write(here.path().join("ball.toml"), ball("0.01")).unwrap();
    let calls: [&[&str]; 8] = [
        &["export", "four-bar"],
        &["list"],
        &["list", "--json"],
        &["check", "four-bar"],
        &["run", "ball.toml"],
        &["run", "ball.toml", "--json"],
        &["completions", "bash"],
        &["--help"],
    ];
    for arguments in calls {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut command = program(here.path(), arguments);
        let done = command.stdout(full).stderr(Stdio::piped()).output().unwrap();
        assert_eq!(done.status.code(), Some(1), "{arguments:?}");
        let said = text(&done.stderr);
        assert!(said.contains("cannot write to standard output: No space left"), "{said}");
    }
}

/// What Bash itself makes of the script.
#[cfg(target_os = "linux")]
#[test]
fn bash_completes_commands_options_and_scenes() {
    let here = tempfile::tempdir().unwrap();
    let script = call(here.path(), &["completions", "bash"]);
    assert_eq!(script.status.code(), Some(0));
    fs::write(here.path().join("script"), &script.stdout).unwrap();
    let complete = r#"
        source ./script
        set -- $(complete -p host-sim)
        while [ "$1" != -F ]; do shift; done
        function=$2 COMP_WORDS=(host-sim $WORDS) COMP_CWORD=$(wc -w <<< "$WORDS")
        "$function" host-sim "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}"
        echo "${COMPREPLY[*]}""#;
    for (words, offered) in [
        ("r", "reproduce run relax report"),
        ("run four", "four-bar"),
        ("trade five", "five-bar-a five-bar-b"),
        ("run four-bar --overw", "--overwrite"),
        ("run four-bar --scheme leap", "leapfrog"),
        // Files, which Bash offers where there is nothing else.
        ("run ./scr", ""),
    ] {
        let mut bash = Command::new("bash");
        bash.current_dir(here.path()).env("WORDS", words).args(["-c", complete]);
        let done = bash.output().unwrap();
        assert_eq!(text(&done.stdout).trim(), offered, "{words}: {}", text(&done.stderr));
    }
}

#[cfg(unix)]
#[test]
fn a_signal_leaves_nothing_half_written() {
    use std::os::unix::process::ExitStatusExt as _;

    let here = tempfile::tempdir().unwrap();
    // A thousand million steps.
    fs::write(here.path().join("ball.toml"), ball("1e6")).unwrap();
    let results = here.path().join("out/ball");
    for (signal, number) in [("HUP", 1), ("INT", 2), ("QUIT", 3), ("TERM", 15)] {
        let run = ["run", "ball.toml", "--every", "1s"];
        let mut command = program(here.path(), &run);
        // Whoever runs the tests in the background may ignore these signals, and a child inherits that.
        if cfg!(target_os = "linux") {
            command = Command::new("env");
            command.args(["--default-signal", env!("CARGO_BIN_EXE_host-sim")]).args(run);
            command.current_dir(here.path()).stdin(Stdio::null());
        }
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let begun = Instant::now();
        while !(results.is_dir() && names(&results).iter().any(|n| n.starts_with(".trace.csv."))) {
            assert!(begun.elapsed() < Duration::from_secs(120), "no trace is begun");
            std::thread::sleep(Duration::from_millis(5));
        }
        send(signal, &mut child);
        let status = child.wait().unwrap();
        assert_eq!(names(&results), [""; 0], "{signal}");
        // A shell says 130 or 143 of it.
        assert_eq!(status.signal(), Some(number));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_closed_terminal_does_not_end_a_run_that_ignores_it() {
    let here = tempfile::tempdir().unwrap();
    fs::write(here.path().join("ball.toml"), ball("1e6")).unwrap();
    let results = here.path().join("out/ball");
    let mut command = Command::new("sh");
    command.args([
        "-c",
        "trap '' HUP; exec \"$0\" run ball.toml --every 1s",
        env!("CARGO_BIN_EXE_host-sim"),
    ]);
    command.current_dir(here.path()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().unwrap();
    let begun = Instant::now();
    while !results.is_dir() {
        assert!(begun.elapsed() < Duration::from_secs(120), "no trace is begun");
        std::thread::sleep(Duration::from_millis(5));
    }
    send("HUP", &mut child);
    std::thread::sleep(Duration::from_millis(300));
    let ended = child.try_wait().unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(ended.is_none(), "{ended:?}");
}

#[cfg(unix)]
fn send(signal: &str, child: &mut Child) {
    let process = child.id().to_string();
    let sent = Command::new("sh").args(["-c", "kill -s $0 $1", signal, &process]).status().unwrap();
    assert!(sent.success());
}

/// The environment blesses a golden file, in words; a build server's does not.
#[test]
fn a_golden_file_is_blessed_by_the_environment() {
    let here = tempfile::tempdir().unwrap();
    fs::write(here.path().join("ball.toml"), ball("0.1")).unwrap();
    let run = |variables: &[(&str, &str)], more: &[&str]| {
        let arguments = ["run", "ball.toml", "--every", "10ms", "--golden", "ball.golden"];
        let mut command = program(here.path(), &[&arguments[..], more].concat());
        command.env_remove("CI").env_remove("DBD_BLESS");
        let done = command.envs(variables.iter().copied()).output().unwrap();
        (done.status.code(), text(&done.stderr).to_owned())
    };
    let (bless, file) = (("DBD_BLESS", "golden"), here.path().join("ball.golden"));
    for variables in [&[][..], &[("DBD_BLESS", "1")], &[bless, ("CI", "true")]] {
        assert_eq!(run(variables, &[]).0, Some(2), "{variables:?}");
        assert!(!file.exists() && !here.path().join("out").exists());
    }
    let (code, said) = run(&[bless], &["--golden-band", "1"]);
    assert!(code == Some(2) && said.contains("without --golden-band"), "{said}");
    let (code, said) = run(&[bless, ("CI", "false")], &["--quiet"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("note: blessed: ball.golden is rewritten"), "{said}");
    assert!(fs::read_to_string(&file).unwrap().lines().count() == 12 + 11 + 1);
    assert_eq!(run(&[], &[]), (Some(0), String::new()));
}

/// A scene that is watched is checked at each save, whatever becomes of it meanwhile, and Ctrl-C ends it as it ends
/// any program.
#[cfg(unix)]
#[test]
fn a_watched_scene_is_checked_at_each_save() {
    use std::io::{BufRead as _, BufReader};
    use std::os::unix::process::ExitStatusExt as _;

    let here = tempfile::tempdir().unwrap();
    let file = here.path().join("ball.toml");
    fs::write(&file, ball("1")).unwrap();
    let arguments =
        ["check", "ball.toml", "--watch", "--svg", "ball.svg", "--write", "long.toml", "--json"];
    let mut command = program(here.path(), &arguments);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
    // All that is said up to the end of a check.
    let mut next = || {
        let mut said = String::new();
        for line in lines.by_ref() {
            said += &(line.unwrap() + "\n");
            if said.contains("Ctrl-C ends") {
                break;
            }
        }
        said
    };
    assert!(next().contains("check 1 of ball.toml: OK"));
    let long = || fs::read_to_string(here.path().join("long.toml")).unwrap();
    assert!(long().contains("duration = 1\n"));

    // Broken in place, mended by a file that takes its place, gone for good, back again.
    fs::write(&file, ball("-1")).unwrap();
    let said = next();
    assert!(
        said.contains("ball.toml:2:12") && said.contains("check 2 of ball.toml: refused"),
        "{said}"
    );
    let other = here.path().join("other");
    fs::write(&other, ball("2")).unwrap();
    fs::rename(&other, &file).unwrap();
    let said = next();
    assert!(said.contains("check 3 of ball.toml: OK"), "{said}");
    assert!(long().contains("duration = 2\n") && here.path().join("ball.svg").exists());
    fs::remove_file(&file).unwrap();
    let said = next();
    assert!(said.contains("ball.toml") && said.contains("refused"), "{said}");
    fs::write(&file, ball("3")).unwrap();
    let said = next();
    assert!(said.contains("check 5 of ball.toml: OK"), "{said}");
    assert!(long().contains("duration = 3\n"));

    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().signal(), Some(2));
    for (arguments, said) in [
        (&["check", "four-bar", "--watch"][..], "--watch needs a scene file"),
        (&["check", "-", "--watch"], "--watch needs a scene file"),
        (&["check", "four-baa", "--watch"], "did you mean four-bar?"),
        (&["check", "none.toml", "--watch"], "none.toml"),
        (&["check", "ball.toml", "--watch", "--svg", "-"], "both write to standard output"),
        (&["check", "ball.toml", "--watch", "--write", "./ball.toml"], "the watched scene"),
    ] {
        let done = call(here.path(), arguments);
        assert_eq!(done.status.code(), Some(2), "{arguments:?}");
        assert!(text(&done.stderr).contains(said), "{arguments:?}: {}", text(&done.stderr));
    }
}
