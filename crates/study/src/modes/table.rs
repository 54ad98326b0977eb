//! The table of a scene's modes: frequencies, damping ratios, effective masses, and elements of each.
//!
//! `(scene, count) => rows, origin of the fastest mode`.

use dbd_kernel::{F64, State};
use dbd_scene::{Scene, SceneModel};
use nalgebra::DMatrix;
use serde::Serialize;

use super::shares::{Element, elements, softened, strain_shares};
use super::{MAX_BODIES, Modes, ModesError, damped, extremes, matrices, modes};

/// Bodies at most for the quadratic eigenproblem.
pub const QUADRATIC: usize = 60;

/// Highest modes that are found of more than [`MAX_BODIES`] bodies, to follow the fastest one as a joint softens.
const HIGHEST: usize = 6;

/// Elements that a row names.
const NAMED: usize = 3;

/// Where damping ratios come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum RatioSource {
    /// The eigenvalues of the damped system.
    QuadraticEigenproblem,
    /// The diagonal of the damping matrix in the undamped modes.
    ModalDiagonal,
    /// Nothing damps.
    Undamped,
}

/// A mode.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModeRow {
    /// Its number, from 1, among all modes in ascending order.
    pub number: usize,
    /// \[Hz\] undamped; negative for an unstable mode, 0 for a free one.
    pub frequency: f64,
    /// Damping ratio; `None` of modes without a frequency.
    pub ratio: Option<f64>,
    /// \[kg\] effective masses in translation along x, y and z.
    pub effective_mass: [f64; 3],
    /// The same as fractions of the total mass.
    pub mass_share: [f64; 3],
    /// The body that has most of the kinetic energy.
    pub body: String,
    /// Its fraction of the kinetic energy.
    pub body_share: f64,
    /// The three largest fractions of the strain energy, with the elements' names.
    pub elements: Vec<(String, f64)>,
}

/// Origin of the fastest mode.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fastest {
    /// \[Hz\] the highest frequency.
    pub frequency: f64,
    /// The element with most of its strain energy.
    pub element: String,
    /// Its fraction of the strain energy.
    pub share: f64,
    /// \[Hz\] of this mode with half the element's stiffness by first-order perturbation, `ω·√(1 − share/2)`.
    pub halved_predicted: f64,
    /// \[Hz\] of the mode that overlaps most with this one, solved with half the stiffness; `None` of an interaction,
    /// whose stiffness is its law's.
    pub halved_solved: Option<f64>,
    /// Overlap of the two shapes: 1 if they are equal.
    pub overlap: Option<f64>,
    /// \[Hz\] the highest frequency then, which may be of another mode.
    pub highest_then: Option<f64>,
}

/// The modes of a scene.
#[derive(Clone, Debug)]
pub struct Table {
    /// The requested lowest modes.
    pub rows: Vec<ModeRow>,
    /// The fastest mode; `None` where nothing vibrates.
    pub fastest: Option<Fastest>,
    /// Where the ratios come from.
    pub ratios: RatioSource,
    /// \[kg\] of all bodies.
    pub total_mass: f64,
    /// All modes that were found, ascending.
    pub modes: Modes,
    /// Whether these are all modes of the scene.
    pub is_complete: bool,
}

/// The `count` lowest modes of a scene about its pose at t = 0, at rest, and the origin of its fastest mode.
///
/// # Errors
/// If a torsion angle is undefined, numbers overflow, or an iteration does not converge.
pub fn table(scene: &Scene, count: usize) -> Result<Table, ModesError> {
    let model = &scene.model;
    let state = State::initial(model);
    let found = found(model, &state, count)?;
    let is_complete = found.frequencies.len() == 6 * model.bodies.len();
    let (ratios, source) = ratios(model, &state, &found)?;
    let total_mass: f64 = model.bodies.iter().map(|body| body.mass).sum();
    let elements = elements(scene);
    let shown = found.frequencies.len().min(count);
    let mut rows = Vec::with_capacity(shown);
    for (mode, ratio) in ratios.iter().enumerate().take(shown) {
        let shape = found.shapes.column(mode);
        let effective_mass = std::array::from_fn(|axis| {
            let along = model.bodies.iter().enumerate();
            let sum: f64 = along.map(|(row, body)| body.mass.sqrt() * shape[6 * row + axis]).sum();
            sum * sum
        });
        let kinetic = |row: usize| shape.rows(6 * row, 6).norm_squared();
        let bodies = (0..model.bodies.len()).map(|row| (row, kinetic(row)));
        let (row, body_share) = bodies.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
        let shares = match found.frequencies[mode] == 0.0 {
            true => Vec::new(),
            false => named(&elements, &strain_shares(model, &state, &elements, shape)?),
        };
        rows.push(ModeRow {
            number: mode + 1,
            frequency: found.frequencies[mode],
            ratio: *ratio,
            effective_mass,
            mass_share: effective_mass.map(|mass| mass / total_mass),
            body: scene.body_names[row].clone(),
            body_share,
            elements: shares,
        });
    }
    let fastest = fastest(model, &state, &elements, &found)?;
    Ok(Table { rows, fastest, ratios: source, total_mass, modes: found, is_complete })
}

/// All modes, or the lowest and the highest ones of many bodies.
fn found(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    count: usize,
) -> Result<Modes, ModesError> {
    match model.bodies.len() > MAX_BODIES {
        true => extremes(model, state, [count, HIGHEST]),
        false => modes(model, state),
    }
}

fn ratios(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    found: &Modes,
) -> Result<(Vec<Option<f64>>, RatioSource), ModesError> {
    let entries = matrices::damping(model, state)?;
    let is_damped = entries.iter().any(|entry| entry.2 != 0.0);
    let count = found.frequencies.len();
    let mut image = DMatrix::zeros(found.shapes.nrows(), count);
    for (row, column, value) in entries {
        for mode in 0..count {
            image[(row, mode)] += value * found.shapes[(column, mode)];
        }
    }
    let damping = found.shapes.transpose() * image;
    let damping = (&damping + damping.transpose()) * 0.5;
    if is_damped
        && model.bodies.len() <= QUADRATIC
        && let Some(ratios) = damped::by_eigenvalues(&found.frequencies, &damping)
    {
        return Ok((ratios, RatioSource::QuadraticEigenproblem));
    }
    let diagonal: Vec<f64> = damping.diagonal().iter().copied().collect();
    let source = if is_damped { RatioSource::ModalDiagonal } else { RatioSource::Undamped };
    Ok((damped::by_diagonal(&found.frequencies, &diagonal), source))
}

/// The largest fractions with their names.
fn named(elements: &[Element], shares: &[f64]) -> Vec<(String, f64)> {
    let mut pairs: Vec<(&Element, f64)> = elements.iter().zip(shares.iter().copied()).collect();
    pairs.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    let largest = pairs.into_iter().take(NAMED).filter(|(_, share)| share.abs() >= 1e-6);
    largest.map(|(element, share)| (element.name.clone(), share)).collect()
}

fn fastest(
    model: &SceneModel<F64>,
    state: &State<SceneModel<F64>>,
    elements: &[Element],
    found: &Modes,
) -> Result<Option<Fastest>, ModesError> {
    let Some(last) = found.frequencies.len().checked_sub(1) else { return Ok(None) };
    let frequency = found.frequencies[last];
    if frequency <= 0.0 {
        return Ok(None);
    }
    let shape = found.shapes.column(last);
    let shares = strain_shares(model, state, elements, shape)?;
    let pairs = elements.iter().zip(shares);
    let Some((element, share)) = pairs.max_by(|a, b| a.1.total_cmp(&b.1)) else {
        return Ok(None);
    };
    let mut fastest = Fastest {
        frequency,
        element: element.name.clone(),
        share,
        halved_predicted: frequency * (1.0 - 0.5 * share).max(0.0).sqrt(),
        halved_solved: None,
        overlap: None,
        highest_then: None,
    };
    if let Some(halved) = softened(model, element, 0.5) {
        let then = self::found(&halved, state, 1)?;
        let overlap = |mode: usize| then.shapes.column(mode).dot(&shape).abs();
        let modes = 0..then.frequencies.len();
        if let Some(mode) = modes.max_by(|a, b| overlap(*a).total_cmp(&overlap(*b))) {
            fastest.halved_solved = Some(then.frequencies[mode]);
            fastest.overlap = Some(overlap(mode));
            fastest.highest_then = then.frequencies.last().copied();
        }
    }
    Ok(Some(fastest))
}

/// The mass \[kg, kg·m²\], stiffness and damping matrices in six degrees of freedom per body: translations along the
/// world's axes, rotations about the body's. Entries of row, column and value, from 0, ascending by column and row.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices {
    /// 6 per body.
    pub size: usize,
    /// The diagonal of masses and principal inertias.
    pub mass: Vec<(usize, usize, f64)>,
    /// Symmetric part of the stiffness, both triangles.
    pub stiffness: Vec<(usize, usize, f64)>,
    /// Symmetric part of the damping, both triangles.
    pub damping: Vec<(usize, usize, f64)>,
}

impl Matrices {
    /// Of a scene about its pose at t = 0, at rest.
    ///
    /// # Errors
    /// If a torsion angle is undefined, or numbers overflow.
    pub fn of(scene: &Scene) -> Result<Self, ModesError> {
        let (model, state) = (&scene.model, State::initial(&scene.model));
        let roots = matrices::roots(model);
        let whole = |entries: Vec<matrices::Entry>| {
            let mut sum = std::collections::BTreeMap::new();
            for (row, column, value) in entries {
                let half = 0.5 * value / (roots[row] * roots[column]);
                *sum.entry((column, row)).or_insert(0.0) += half;
                *sum.entry((row, column)).or_insert(0.0) += half;
            }
            let sum = sum.into_iter().filter(|(_, value)| *value != 0.0);
            sum.map(|((column, row), value)| (row, column, value)).collect()
        };
        let masses = model
            .bodies
            .iter()
            .flat_map(|b| [b.mass, b.mass, b.mass, b.inertia.x, b.inertia.y, b.inertia.z]);
        let mass = masses.enumerate().map(|(row, mass)| (row, row, mass));
        Ok(Self {
            size: roots.len(),
            mass: mass.collect(),
            stiffness: whole(matrices::stiffness(model, &state)?),
            damping: whole(matrices::damping(model, &state)?),
        })
    }
}
