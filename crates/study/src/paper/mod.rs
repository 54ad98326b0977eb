//! The results of Franco & Degani (Appl. Sci. 2026, 16, 2297), measured again.
//!
//! `(items, scenes) => findings: the paper's value, the measured one, a verdict`. Every number is measured by the call;
//! only the paper's values and the tolerances are constants.
//!
//! - `context`: scenes, methods, errors.
//! - [`finding`]: rows, verdicts, curves.
//! - [`fit`]: straight lines and planes through points.
//! - [`drift`]: energy drift of a run.
//! - `counts`, `costs`, `spectrum`, `steps`, `offsets`, `chains`, `crank`, `bars`, `trade_off`: the items.
//! - [`plot`]: curves as an SVG in the paper's axes.
//! - [`page`]: pages for people.
//! - [`store`]: cached findings.

mod bars;
mod chains;
mod context;
mod costs;
mod counts;
mod crank;
pub mod drift;
pub mod finding;
pub mod fit;
mod offsets;
pub mod page;
pub mod plot;
mod spectrum;
mod steps;
pub mod store;
mod trade_off;

pub use context::{Context, PaperError, Scenes, TEN};
pub use finding::{Curve, Finding, Plot, Row, Verdict};
pub use spectrum::{Kick, kick};

/// An item of the paper.
#[derive(Clone, Copy)]
pub struct Item {
    /// Its name on the command line.
    pub name: &'static str,
    /// Where the paper has it.
    pub place: &'static str,
    /// Title.
    pub title: &'static str,
    /// Whether it is measured by default: it takes seconds and contains no times.
    pub quick: bool,
    /// The scenes that it needs.
    pub scenes: &'static [&'static str],
    measure: fn(&Context<'_>) -> Result<Finding, PaperError>,
}

impl Item {
    /// Measures it.
    ///
    /// # Errors
    /// [`PaperError`].
    pub fn measure(&self, scenes: &Scenes<'_>) -> Result<Finding, PaperError> {
        (self.measure)(&Context { scenes }).map(|finding| Finding {
            item: self.name.into(),
            place: self.place.into(),
            title: self.title.into(),
            ..finding
        })
    }
}

/// All items in the paper's order.
pub const ITEMS: [Item; 16] = [
    Item {
        name: "chains",
        place: "section 2.2",
        title: "Open and closed chain of ten links: cost and acceleration",
        quick: true,
        scenes: &["chain-closed", "chain-open-60", "chain-open-30"],
        measure: chains::chains,
    },
    Item {
        name: "fig-4",
        place: "section 2.4, Fig. 4",
        title: "Spectrum of the 3RUU after free lengths change by 1 mm",
        quick: true,
        scenes: &["3ruu"],
        measure: spectrum::spectrum,
    },
    Item {
        name: "factor",
        place: "section 3.2",
        title: "Ball on a spring: the factor between a prototype and compiled code",
        quick: false,
        scenes: &["spring-ball"],
        measure: costs::factor,
    },
    Item {
        name: "table-7a",
        place: "Table 7a",
        title: "Number of equations of ten systems",
        quick: true,
        scenes: &TEN,
        measure: counts::equations,
    },
    Item {
        name: "table-7b",
        place: "Table 7b",
        title: "Bodies and TSDAs of ten systems, and the fit through the paper's times",
        quick: true,
        scenes: &TEN,
        measure: counts::elements,
    },
    Item {
        name: "fig-17",
        place: "section 4.1, Fig. 17",
        title: "Time of a step over the number of equations",
        quick: false,
        scenes: &TEN,
        measure: costs::growth,
    },
    Item {
        name: "fig-18",
        place: "section 4.2, Fig. 18",
        title: "Largest step over frequency",
        quick: false,
        scenes: &["four-bar", "five-bar-a", "five-bar-b", "six-bar", "3rrr", "3ruu"],
        measure: steps::largest,
    },
    Item {
        name: "fig-18-pose",
        place: "section 4.2, Fig. 18",
        title: "Largest step of the four-bar and the 3RRR as they ship",
        quick: true,
        scenes: &["four-bar", "3rrr"],
        measure: steps::shipped,
    },
    Item {
        name: "table-8",
        place: "section 4.3, Table 8",
        title: "3RRR: error over stiffness and step",
        quick: false,
        scenes: &["3rrr"],
        measure: offsets::offsets,
    },
    Item {
        name: "crank-slider",
        place: "section 4.4.1",
        title: "Crank-slider: energy, speed, force, offset and rotation of the slider",
        quick: true,
        scenes: &["crank-slider"],
        measure: crank::motion,
    },
    Item {
        name: "fig-19",
        place: "section 4.4.1, Fig. 19",
        title: "Crank-slider: a step of constant size near the dead centres",
        quick: true,
        scenes: &["crank-slider"],
        measure: crank::dead_centres,
    },
    Item {
        name: "fig-20",
        place: "section 4.4.2, Fig. 20",
        title: "Crank-slider: rate of energy loss over the step",
        quick: false,
        scenes: &["crank-slider"],
        measure: crank::plateau,
    },
    Item {
        name: "fig-23",
        place: "section 4.5, Fig. 23, abstract",
        title: "Four-, five- and six-bar: energy drift over simulation time per real time",
        quick: false,
        scenes: &["four-bar", "five-bar-b", "six-bar"],
        measure: bars::bars,
    },
    Item {
        name: "kt",
        place: "section 4.6",
        title: "Kinematic topology value of both five-bars",
        quick: true,
        scenes: &["five-bar-a", "five-bar-b"],
        measure: bars::topology_value,
    },
    Item {
        name: "fig-25",
        place: "section 4.6, Fig. 25",
        title: "Five-bar, topologies A and B: energy drift over simulation time per real time",
        quick: false,
        scenes: &["five-bar-a", "five-bar-b"],
        measure: bars::topologies,
    },
    Item {
        name: "fig-26",
        place: "section 4.7, Fig. 26",
        title: "Step at which a matrix solver costs as much",
        quick: false,
        scenes: &["macpherson", "four-bar", "five-bar-b", "six-bar", "3rrr", "3ruu", "two-3ruu"],
        measure: trade_off::equal_cost,
    },
];

/// The item of a name.
#[must_use]
pub fn item(name: &str) -> Option<&'static Item> {
    ITEMS.iter().find(|item| item.name == name)
}
