//! Studies of a scene: speed against accuracy, sweeps, reference solutions.
//!
//! `scene => truth over a window => points (error, energy, cost) => fronts, chart, sentences`. The
//! modules in the order in which they stand on each other:
//!
//! - [`reference`](mod@reference): the same equations in plain Rust, which share no force code with the kernel.
//! - [`plot`]: axes, curves and maps as SVG.
//! - [`sweep`]: one scene, many values, one row per case.
//! - [`modes`](mod@modes): small vibrations about a pose.
//! - [`stability`](mod@stability): the largest stable step of a method about a pose.
//! - [`point`]: what a point is, and which of them nothing beats.
//! - [`costs`]: what a step costs on the target, as counted.
//! - [`estimate`]: the same of any scene, by its bodies and elements.
//! - [`grid`]: the times compared, and the steps that reach them.
//! - [`frame`](mod@frame): what a survey is asked for.
//! - [`ways`]: all ways of stepping a scene, and their ladders of steps.
//! - [`limits`]: how long a step of each may be.
//! - [`measure`]: how far off a way is at a step.
//! - [`timing`]: what a step costs a host.
//! - [`variants`](mod@variants): other models of the mechanism, and how their motion differs.
//! - [`cache`]: results, kept as they come.
//! - [`order`]: how errors fall with the step, and what keeps them from it.
//! - [`survey`](mod@survey): all points, in parallel.
//! - [`need`]: what the paper's scheme costs at an accuracy.
//! - [`words`]: steps, costs and steppers as people read them.
//! - [`advice`]: what to choose, in sentences.
//! - [`recommend`](mod@recommend): one way of stepping a scene on a microcontroller.
//! - [`precisions`]: what rounding costs on the target, in a sentence.
//! - [`ideal`](mod@ideal): how stiff joints are that are meant to be ideal, and how to step them.
//! - [`variants_table`]: the scene beside its variants, as a table.
//! - [`front_table`]: what nothing beats, as a table.
//! - [`command`]: how to run it.
//! - [`chart`], [`page`]: what people look at.
//! - [`files`]: writes it and `trade.csv`.
//! - [`paper`]: the results of the method's paper, measured again.

pub mod advice;
pub mod cache;
pub mod chart;
pub mod command;
pub mod costs;
pub mod estimate;
pub mod files;
pub mod frame;
pub mod front_table;
pub mod grid;
pub mod ideal;
pub mod limits;
pub mod measure;
pub mod modes;
pub mod need;
pub mod order;
pub mod page;
pub mod paper;
pub mod plot;
pub mod point;
pub mod precisions;
pub mod recommend;
pub mod reference;
pub mod stability;
pub mod survey;
pub mod sweep;
pub mod timing;
pub mod variants;
pub mod variants_table;
pub mod ways;
pub mod words;

pub use frame::TradeOptions;
pub use point::{Machine, Point, Stepper, front};
pub use survey::{Phase, SurveyError, Trade, survey};
