//! Command lines: commands, options, values and scenes, at random and at times nonsense.

use std::ffi::OsString;

use fastrand::Rng;

use crate::corpus::{SHIPPED, SMALL};
use crate::edges::CHANGES;

/// Arguments and the scene file that lies beside them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Arguments {
    /// The arguments after the program's name.
    pub words: Vec<OsString>,
    /// The content of `scene.toml`, and of standard input.
    pub scene: Vec<u8>,
}

impl Arguments {
    /// What bytes say: a count, so many lengths and words, the rest is the scene.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        let (count, mut rest) = bytes.split_first().map_or((0, bytes), |(n, rest)| (*n, rest));
        let mut words = Vec::new();
        for _ in 0..count {
            let Some(([low, high], after)) = rest.split_first_chunk::<2>() else { break };
            let length = usize::from(u16::from_le_bytes([*low, *high])).min(after.len());
            let (word, after) = after.split_at(length);
            words.push(os_string(word));
            rest = after;
        }
        Self { words, scene: rest.to_vec() }
    }

    /// The bytes that say so.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        let count = self.words.len().min(255);
        let mut bytes = vec![count as u8];
        for word in &self.words[..count] {
            let word = word.as_encoded_bytes();
            let length = word.len().min(usize::from(u16::MAX));
            bytes.extend_from_slice(&(length as u16).to_le_bytes());
            bytes.extend_from_slice(&word[..length]);
        }
        bytes.extend_from_slice(&self.scene);
        bytes
    }
}

#[cfg(unix)]
fn os_string(bytes: &[u8]) -> OsString {
    use std::os::unix::ffi::OsStringExt as _;
    // No process takes a zero byte in an argument.
    OsString::from_vec(bytes.iter().copied().filter(|byte| *byte != 0).collect())
}

#[cfg(not(unix))]
fn os_string(bytes: &[u8]) -> OsString {
    String::from_utf8_lossy(bytes).replace('\0', "").into()
}

/// The command whose file is a sweep's.
pub const SWEEP: &str = "sweep";

/// Commands with the options and flags that are theirs: rows of [`OPTIONS`], flags.
const COMMANDS: &[(&str, &[usize], &[&str])] = &[
    ("run", &[0, 1, 2, 5, 6, 7, 8, 9, 10], &["--json", "--quiet", "--overwrite"]),
    ("run", &[0, 1, 1, 2, 6, 8, 10, 15], &["--json", "--quiet", "--overwrite"]),
    ("run", &[1, 6, 8], &["--json", "--quiet"]),
    ("check", &[15, 15], &["--json"]),
    ("check", &[5, 6, 7, 8, 15], &["--stability", "--json"]),
    ("check", &[13, 14], &["--json"]),
    ("export", &[8, 15], &[]),
    ("trade", &[3, 4, 10], &["--json", "--quiet", "--overwrite"]),
    (
        SWEEP,
        &[10, 11, 12],
        &["--json", "--quiet", "--overwrite", "--merge", "--partial", "--reports"],
    ),
    ("list", &[], &["--json"]),
    ("completions", &[], &[]),
];

/// Options with a value, and what may come after them beside anything else.
const OPTIONS: &[(&str, &[&str])] = &[
    ("--step", TIMES),
    ("--duration", TIMES),
    ("--every", TIMES),
    ("--window", TIMES),
    ("--period", TIMES),
    ("--newton", &["0", "1", "2", "8", "9", "-1", "4294967295", "4294967296", "x", ""]),
    (
        "--scheme",
        &[
            "dbd",
            "dbd-p1",
            "dbd-p2",
            "leapfrog",
            "rk4",
            "pefrl",
            "blanes-moan-s6",
            "semi-implicit-euler",
            "euler",
            "",
        ],
    ),
    ("--damping", &["sweeps", "explicit", "none"]),
    ("--precision", &["f64", "f32", "fixed", "f32-micromath", "f16", "all"]),
    ("--orientation", &["quaternion", "euler-321", "x"]),
    (
        "--out",
        &[
            "out",
            "folder",
            "file",
            "file/below",
            "taken",
            "",
            ".",
            "..",
            "a/b/c",
            "/dev/null",
            "/dev/null/x",
            "/proc/none",
            "é\n",
            "-",
            "--",
            "CON",
        ],
    ),
    (
        "--shard",
        &["1/1", "1/2", "2/2", "3/3", "1/8", "1/99", "2/3", "1/1", "0/1", "2/1", "/", "1/-1"],
    ),
    ("--jobs", &["1", "2", "1", "2", "1", "2", "1", "2", "0", "-1", "x", "18446744073709551616"]),
    ("--svg", &["-"]),
    ("--write", &["-"]),
    ("--set", CHANGES),
];

const FLAGS: &[&str] = &[
    "--json",
    "--quiet",
    "--overwrite",
    "--stability",
    "--help",
    "-h",
    "--version",
    "-V",
    "--",
    "-",
    "--nothing",
    "-x",
    "--json=1",
    "",
];

const TIMES: &[&str] = &[
    "1ms",
    "10ms",
    "0.1s",
    "1s",
    "20us",
    "100us",
    "1us",
    "0.5",
    "1e-3",
    "2e-3s",
    "3ms",
    "7ms",
    "0.3s",
    "1e-20",
    "1e-300",
    "5e-324",
    "1e300",
    "1e308s",
    "1e999",
    "0",
    "-1",
    "-1ms",
    "nan",
    "inf",
    "1e",
    "s",
    "",
    "1 ms",
    "١ms",
    "1e-2147483648ns",
    "1e2147483647s",
    "0.1234567890123456",
    "9007199254740993ns",
    "1e12s",
    "1e6",
];

/// So many values of an option are right, mostly.
const GOOD: usize = 8;

const SHELLS: &[&str] = &["bash", "zsh", "fish", "elvish", "powershell", "sh", ""];

const NAMES: &[&str] = &[
    "four-bar",
    "spring-ball",
    "gyroscope",
    "crank-slider",
    "cart-pendulum",
    "four-ba",
    "file",
    "folder",
    "folder/",
    "none.toml",
    "./scene.toml",
    "../scene.toml",
    "/dev/null",
    "é",
    "a\0b",
    "taken/scene/summary.json",
    ".toml",
];

fn pick<'l>(list: &[&'l str], random: &mut Rng) -> &'l str {
    list[random.usize(..list.len())]
}

/// A scene that is valid and small.
pub fn valid_scene(random: &mut Rng) -> Vec<u8> {
    let list = if random.u8(..8) > 0 { &SMALL } else { &SHIPPED };
    list[random.usize(..list.len())].clone().into_bytes()
}

/// What a sweep's file begins with where it is short to run.
pub const SHORT_SWEEP: &str = "duration = \"1ms\"\nstep = \"0.1ms\"\n";

/// Lines before the axes, axes; some of them right.
const SWEEPS: [&[&str]; 2] = [
    &[
        "scene = \"spring-ball\"",
        "scene = \"cart-pendulum\"",
        "scene = \"scene.toml\"",
        "precision = \"f32\"",
        "statistics = [\"rms\", \"max\"]",
        "columns = [\"energy.*\"]",
        "columns = [\"*.x\", \"é?\"]",
        "set = [\"gravity=[0, 0, 1]\", \"body.*.mass=2\"]",
        "set = [\"=\", \"a\"]",
        "sample = { kind = \"random\", count = 3, seed = 1 }",
        "sample = { kind = \"latin-hypercube\", count = 5, seed = 18446744073709551615 }",
        "paired = [[\"scheme\", \"newton\"]]",
        "every = \"0.3ms\"",
        "nothing = 1",
    ],
    &[
        "scheme = [\"rk4\", \"dbd\"]",
        "newton = [\"own\", 2]",
        "damping = [\"own\", \"explicit\"]",
        "precision = [\"f32\", \"f64\"]",
        "\"body.*.mass\" = { from = 0.5, to = 2, count = 3 }",
        "\"body.*.mass\" = { from = \"1 kg\", to = \"2 kg\", scale = \"log\" }",
        "\"tsda.*.stiffness\" = { from = 1e3, to = 1e300, count = 2, scale = \"logarithmic\" }",
        "\"gravity[1]\" = [-9.81, 0]",
        "gravity = [[0, 0, 0], [1e308, 0, nan]]",
        "name = [\"a,\\\"b\\n\", \"é\"]",
        "\"a..b\" = [1]",
        "x = { from = 1, to = 2, count = 1000001 }",
        "load.1.until = []",
    ],
];

/// A sweep's file of few cases, some of them right.
pub fn sweep(random: &mut Rng) -> Vec<u8> {
    let mut text = SHORT_SWEEP.to_owned();
    for (lines, most) in SWEEPS.into_iter().zip([4, 4]) {
        for _ in 0..random.usize(1..most) {
            text += pick(lines, random);
            text.push('\n');
        }
        if !text.contains("[axes]") {
            text += "[axes]\n";
        }
    }
    let mut bytes = text.into_bytes();
    if random.u8(..4) == 0 {
        let at = random.usize(..bytes.len());
        bytes[at] = random.u8(..);
    }
    bytes
}

/// Arguments, of which most are right by themselves.
pub fn random(random: &mut Rng) -> Vec<OsString> {
    let mut words: Vec<Vec<u8>> = Vec::new();
    let mut push = |word: &str| words.push(word.as_bytes().to_vec());
    let (command, own, flags) = COMMANDS[random.usize(..COMMANDS.len())];
    push(command);
    match random.u8(..16) {
        _ if command == "list" => {}
        _ if command == "completions" => push(pick(SHELLS, random)),
        0..=11 => push("scene.toml"),
        12..=14 => push(pick(NAMES, random)),
        _ => {}
    }
    // Most of them once: what is given twice is refused.
    let mut own = own.to_vec();
    random.shuffle(&mut own);
    for row in own.into_iter().take(random.usize(..4)) {
        let (option, values) = OPTIONS[row];
        let good = random.usize(..values.len().min(GOOD));
        let value = if random.u8(..4) == 0 { pick(values, random) } else { values[good] };
        if random.bool() {
            push(option);
            push(value);
        } else {
            push(&format!("{option}={value}"));
        }
    }
    flags.iter().filter(|_| random.u8(..3) == 0).for_each(|flag| push(flag));
    if random.u8(..8) == 0 {
        // Somebody else's.
        match random.u8(..3) {
            0 => push(pick(FLAGS, random)),
            1 => push(pick(NAMES, random)),
            _ => {
                let (option, _) = OPTIONS[random.usize(..OPTIONS.len())];
                push(option);
                push(pick(TIMES, random));
            }
        }
    }
    if random.u8(..8) == 0 {
        spoil(&mut words, random);
    }
    words.iter().map(|word| os_string(word)).collect()
}

/// Other order, other bytes, less, more or much longer.
fn spoil(words: &mut Vec<Vec<u8>>, random: &mut Rng) {
    let at = random.usize(..words.len());
    match random.u8(..6) {
        0 => random.shuffle(words),
        1 => drop(words.remove(at)),
        2 => words.push(words[at].clone()),
        3 => words[at] = words[at].repeat(random.usize(..2000)),
        4 => words[at].push(random.u8(..)),
        _ => words[at] = (0..random.usize(..40)).map(|_| random.u8(..)).collect(),
    }
    if words.is_empty() {
        words.push(Vec::new());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_read_back_from_their_bytes() {
        let mut source = Rng::with_seed(7);
        for _ in 0..1000 {
            let arguments = Arguments { words: random(&mut source), scene: b"name".to_vec() };
            assert_eq!(Arguments::of(&arguments.bytes()), arguments);
        }
        assert_eq!(Arguments::of(&[]), Arguments::default());
        assert_eq!(Arguments::of(&[3, 200]).words.len(), 0);
    }
}
