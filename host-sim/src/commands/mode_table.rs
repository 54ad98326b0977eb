//! `host-sim modes`: the vibration modes of a scene about a pose, and the joint of the fastest mode.
//!
//! `(scene, options) => table; OUT/SCENE/{modes.csv,modes.json,modes.html,mass.mtx,stiffness.mtx,damping.mtx}`.

use std::fmt::Write as _;
use std::io;
use std::path::PathBuf;

use dbd_plant::digits::significant;
use dbd_report::data::{Mode, Run, Table as PageTable, Text};
use dbd_report::output::set::FileSet;
use dbd_report::packed::F32s;
use dbd_report::picture::{Mechanism, Paper, svg};
use dbd_report::{Data, page};
use dbd_scene::{Restless, Scene};
use dbd_study::modes::{
    Fastest, Matrices, ModeRow, ModesError, QUADRATIC, RatioSource, Table, remarks, table,
};
use dbd_study::paper::{Kick, PaperError, kick};
use miette::Diagnostic;
use serde::Serialize;
use thiserror::Error;

use crate::commands::folder::{Destination, FolderError};
use crate::terminal::Look;
use crate::terminal::text;

/// Why there are no modes, or they were not written.
#[derive(Debug, Error, Diagnostic)]
pub enum ModeTableError {
    /// The scene has no equilibrium.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Restless(#[from] Restless),
    /// There are no modes.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Modes(#[from] ModesError),
    /// No joint has the name.
    #[error("the scene has no joint `{name}` to kick; its joints: {known}")]
    #[diagnostic(help("--kick without a name uses the joint of the fastest mode"))]
    Joint {
        /// What was asked for.
        name: String,
        /// All names.
        known: String,
    },
    /// The fastest mode does not belong to a joint.
    #[error("the fastest mode does not belong to a joint, so no joint can be kicked")]
    #[diagnostic(help("name a joint: --kick=JOINT"))]
    NoJoint,
    /// The kicked scene cannot be run.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Kick(#[from] PaperError),
    /// The folder for the results cannot be made.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Folder(#[from] FolderError),
    /// Results cannot be written.
    #[error("cannot write the modes: {0}")]
    Write(io::Error),
}

/// What is asked for.
#[derive(Clone, Debug, Default)]
pub struct ModeOptions {
    /// How many of the lowest modes.
    pub count: usize,
    /// Whether about the static equilibrium.
    pub relax: bool,
    /// A joint to kick by the paper's procedure; an empty name is that of the fastest mode.
    pub kick: Option<String>,
}

/// The modes of a scene as they are printed.
#[derive(Clone, Debug, Serialize)]
pub struct ModeTable {
    /// The scene's name.
    pub scene: String,
    /// The scene's file, where results are written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene_file: Option<String>,
    /// The hash of its text, likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scene_hash: Option<String>,
    /// About which pose: `t = 0` or `rest`.
    pub pose: &'static str,
    /// \[kg\] of all bodies.
    pub total_mass: f64,
    /// The method for the damping ratios.
    pub damping_ratios: RatioSource,
    /// How many modes were found; fewer than six per body of large scenes.
    pub found: usize,
    /// \[Hz\] frequencies up to this one are rounding errors.
    pub resolution: f64,
    /// The lowest modes.
    pub modes: Vec<ModeRow>,
    /// The cause of the fastest mode.
    pub fastest: Option<Fastest>,
    /// The paper's procedure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kick: Option<Kick>,
    /// Limitations of the modes.
    pub remarks: Vec<String>,
}

/// The modes of a scene, with the scene about whose pose they are.
pub struct FoundModes {
    /// The scene, in equilibrium if requested.
    pub scene: Scene,
    /// What is printed.
    pub table: ModeTable,
    motions: Vec<Vec<[f64; 6]>>,
}

/// Finds the modes of a scene.
///
/// # Errors
/// [`ModeTableError`].
pub fn find(scene: &Scene, options: &ModeOptions) -> Result<FoundModes, ModeTableError> {
    let scene = if options.relax { dbd_scene::relaxed(scene)? } else { scene.clone() };
    let Table { rows, fastest, ratios, total_mass, modes, .. } = table(&scene, options.count)?;
    let kick = match &options.kick {
        Some(name) => Some(kicked(&scene, name, fastest.as_ref())?),
        None => None,
    };
    let motions = (0..rows.len()).map(|mode| modes.motion(&scene.model, mode)).collect();
    let table = ModeTable {
        scene: scene.name.clone(),
        scene_file: None,
        scene_hash: None,
        pose: if options.relax { "rest" } else { "t = 0" },
        total_mass,
        damping_ratios: ratios,
        found: modes.frequencies.len(),
        resolution: modes.resolution,
        modes: rows,
        fastest,
        kick,
        remarks: remarks(&scene, &modes)?,
    };
    Ok(FoundModes { scene, table, motions })
}

fn kicked(scene: &Scene, name: &str, fastest: Option<&Fastest>) -> Result<Kick, ModeTableError> {
    let joints = &scene.joints;
    let row = if name.is_empty() {
        let element = fastest.map_or("", |fastest| &fastest.element);
        let row = joints.iter().position(|joint| element == format!("joint `{}`", joint.name));
        row.ok_or(ModeTableError::NoJoint)?
    } else {
        let row = joints.iter().position(|joint| joint.name == name);
        row.ok_or_else(|| ModeTableError::Joint {
            name: name.to_owned(),
            known: joints.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>().join(", "),
        })?
    };
    Ok(kick(scene, row)?)
}

/// Columns of the printed table.
const HEAD: [&str; 9] = [
    "mode",
    "f [Hz]",
    "damping",
    "mass x [kg]",
    "mass y [kg]",
    "mass z [kg]",
    "of total",
    "moves most",
    "held by",
];

/// Those of the page's table.
const ON_PAGE: [usize; 4] = [0, 1, 2, 8];

/// Effective masses below this fraction of the total are rounding errors, as are such damping ratios.
const ROUNDING: f64 = 1e-9;

/// Three digits, 0 for rounding against a size.
fn above_rounding(value: f64, size: f64) -> String {
    if value.abs() < ROUNDING * size { "0".into() } else { significant(value, 3) }
}

fn percent(share: f64) -> String {
    format!("{} %", above_rounding(100.0 * share, 100.0))
}

fn ratio(row: &ModeRow) -> String {
    row.ratio.map_or_else(|| "–".into(), |ratio| above_rounding(ratio, 1.0))
}

fn held_by(row: &ModeRow) -> String {
    let one = |(name, share): &(String, f64)| format!("{name} {}", percent(*share));
    match row.elements.is_empty() {
        true => "–".into(),
        false => row.elements.iter().map(one).collect::<Vec<_>>().join(", "),
    }
}

impl ModeTable {
    fn line(row: &ModeRow) -> [String; 9] {
        let [x, y, z] = [0, 1, 2].map(|axis| match row.mass_share[axis] < ROUNDING {
            true => "0".to_owned(),
            false => significant(row.effective_mass[axis], 3),
        });
        let share = row.mass_share.iter().sum::<f64>() / 3.0;
        [
            row.number.to_string(),
            significant(row.frequency, 5),
            ratio(row),
            x,
            y,
            z,
            percent(share),
            format!("{} {}", row.body, percent(row.body_share)),
            held_by(row),
        ]
    }

    /// Names and texts about all modes.
    #[must_use]
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let source = match self.damping_ratios {
            RatioSource::QuadraticEigenproblem => "eigenvalues of the damped system".to_owned(),
            RatioSource::ModalDiagonal => format!(
                "diagonal of the damping matrix in the undamped modes, for more than {QUADRATIC} bodies or if the eigenvalues do not converge"
            ),
            RatioSource::Undamped => "none: the scene has no damping".to_owned(),
        };
        let mut rows = vec![
            ("scene", self.scene.clone()),
            ("about", format!("the pose at {}, without velocities", self.pose)),
            ("modes found", self.found.to_string()),
            ("total mass", format!("{} kg", significant(self.total_mass, 4))),
            ("damping ratios", source),
        ];
        if let Some(fastest) = &self.fastest {
            rows.push((
                "fastest mode",
                format!(
                    "{} Hz, {} of its strain energy in {}",
                    significant(fastest.frequency, 5),
                    percent(fastest.share),
                    fastest.element
                ),
            ));
            let solved = match (fastest.halved_solved, fastest.overlap, fastest.highest_then) {
                (Some(solved), Some(overlap), Some(highest)) => format!(
                    ", solved {} Hz (overlap of the shapes {}); the highest frequency is {} Hz then",
                    significant(solved, 5),
                    significant(overlap, 3),
                    significant(highest, 5)
                ),
                _ => String::new(),
            };
            let predicted = significant(fastest.halved_predicted, 5);
            rows.push(("with half its stiffness", format!("predicted {predicted} Hz{solved}")));
        }
        if let Some(kick) = &self.kick {
            rows.push(("kicked", kick.sentence()));
        }
        rows.extend(self.remarks.iter().map(|remark| ("warning", remark.clone())));
        rows
    }

    /// What people read.
    #[must_use]
    pub fn text(&self, look: Look) -> String {
        let lines: Vec<[String; 9]> = self.modes.iter().map(Self::line).collect();
        format!("{}\n{}", look.table(&self.rows()), look.columns(Some(HEAD), &lines))
    }

    /// A line per mode, shares of the elements as `NAME=share` in the last field.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = String::from(
            "mode,frequency_hz,damping_ratio,mass_x_kg,mass_y_kg,mass_z_kg,body,body_share,elements\n",
        );
        for row in &self.modes {
            let [x, y, z] = row.effective_mass;
            let ratio = row.ratio.map(|ratio| format!("{ratio:?}")).unwrap_or_default();
            let elements = row.elements.iter().map(|(name, share)| format!("{name}={share:?}"));
            let elements = elements.collect::<Vec<_>>().join("; ").replace('"', "\"\"");
            let body = row.body.replace('"', "\"\"");
            let _ = writeln!(
                text,
                "{},{:?},{ratio},{x:?},{y:?},{z:?},\"{body}\",{:?},\"{elements}\"",
                row.number, row.frequency, row.body_share
            );
        }
        text
    }
}

/// A symmetric matrix in the Matrix Market format: its lower half.
fn matrix_market(size: usize, entries: &[(usize, usize, f64)], comment: &str) -> String {
    let lower: Vec<_> = entries.iter().filter(|(row, column, _)| row >= column).collect();
    let mut text = format!(
        "%%MatrixMarket matrix coordinate real symmetric\n% {comment}\n{size} {size} {}\n",
        lower.len()
    );
    for (row, column, value) in lower {
        let _ = writeln!(text, "{} {} {value:e}", row + 1, column + 1);
    }
    text
}

impl FoundModes {
    /// Writes table, page and matrices; the folder.
    ///
    /// # Errors
    /// Where they cannot be written, or the folder holds results of another scene.
    pub fn write(&self, out: &Destination) -> Result<PathBuf, ModeTableError> {
        let folder = out.folder(&self.scene.name)?;
        let matrices = Matrices::of(&self.scene)?;
        let mut files = FileSet::new(&folder);
        let mut write =
            |name: &str, text: &str| files.write(name, text).map_err(ModeTableError::Write);
        write("modes.csv", &self.table.csv())?;
        write("modes.html", &page::html(&self.page()))?;
        let freedoms = "six degrees of freedom per body: translations along world axes, rotations about body axes";
        for (name, entries, unit) in [
            ("mass.mtx", &matrices.mass, "kg, kg m^2"),
            ("stiffness.mtx", &matrices.stiffness, "N/m, N, N m"),
            ("damping.mtx", &matrices.damping, "N s/m, N s, N m s"),
        ] {
            let text = matrix_market(matrices.size, entries, &format!("{unit}; {freedoms}"));
            write(name, &text)?;
        }
        let table = ModeTable {
            scene_file: Some(out.file.place.clone()),
            scene_hash: Some(out.file.hash.clone()),
            ..self.table.clone()
        };
        for (name, (_, picture)) in
            ["kick-spectrum.svg", "kick-scalogram.svg"].into_iter().zip(self.plots())
        {
            write(name, picture)?;
        }
        write("modes.json", &text::json(&table))?;
        files.finish().and_then(|whole| whole.publish()).map_err(ModeTableError::Write)?;
        Ok(folder)
    }

    fn plots(&self) -> &[(String, String)] {
        self.table.kick.as_ref().map_or(&[], |kick| &kick.plots)
    }

    fn page(&self) -> Data {
        let table = &self.table;
        let run = Run { mechanism: Some(Mechanism::of(&self.scene)), ..Run::default() };
        let mut data = Data::of_run(&self.scene.name, &self.scene.description, run);
        let pairs = table.modes.iter().zip(&self.motions);
        data.modes = pairs
            .map(|(row, motion)| Mode {
                frequency: row.frequency,
                shape: F32s(motion.iter().flatten().map(|part| *part as f32).collect()),
            })
            .collect();
        let of_page = |row: &ModeRow| {
            let line = ModeTable::line(row);
            let [mode, frequency, damping, held] = ON_PAGE.map(|column| line[column].clone());
            vec![format!("{mode}: {frequency}"), damping, held]
        };
        let rows = table.rows().into_iter().filter(|(name, _)| *name != "warning");
        data.text = Text {
            warnings: table.remarks.clone(),
            picture: Some(svg(&Mechanism::of(&self.scene), Paper::Page)),
            tables: vec![
                PageTable {
                    title: "Modes".into(),
                    // The page is too narrow for all columns; the other files contain them.
                    columns: ["mode: f [Hz]", HEAD[2], HEAD[8]].map(str::to_owned).to_vec(),
                    rows: table.modes.iter().map(of_page).collect(),
                },
                PageTable {
                    title: "Summary".into(),
                    columns: Vec::new(),
                    rows: rows.map(|(name, text)| vec![name.to_owned(), text]).collect(),
                },
            ],
            ..Text::default()
        };
        data
    }
}
