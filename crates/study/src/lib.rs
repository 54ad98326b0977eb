//! Studies of a scene: speed against accuracy, sweeps, reference solutions.
//!
//! `scene => reference solution over a window => points (error, energy, cost) => fronts, chart, sentences`. The modules
//! in dependency order:
//!
//! - [`reference`](mod@reference): the same equations in plain Rust, without force code of the kernel.
//! - [`plot`]: axes, curves and maps as SVG.
//! - [`sweep`]: one scene, many values, one row per case.
//! - [`modes`](mod@modes): small vibrations about a pose.
//! - [`compliance`]: deflections of joints under the forces at t = 0.
//! - [`stability`](mod@stability): the largest stable step of a method about a pose.
//! - [`point`]: points and their Pareto front.
//! - [`costs`]: counted cost of a step on the target.
//! - [`estimate`]: estimated cost for any scene, by its bodies and elements.
//! - [`grid`]: the times compared, and the steps that reach them.
//! - [`frame`](mod@frame): options of a study.
//! - [`ways`]: all methods for a scene, and their ladders of steps.
//! - [`limits`]: largest stable and advised steps.
//! - [`measure`]: error of a method at a step.
//! - [`timing`]: cost of a step on a host.
//! - [`variants`](mod@variants): other models of the mechanism, and the difference of their motion.
//! - [`cache`]: cached results.
//! - [`order`]: observed convergence orders and their limits.
//! - [`survey`](mod@survey): all points, in parallel.
//! - [`need`]: cost of the paper's scheme at an accuracy.
//! - [`words`]: texts of steps, costs and steppers.
//! - [`advice`]: choices in sentences.
//! - [`recommend`](mod@recommend): one method for a scene on a microcontroller.
//! - [`precisions`]: cost of the precisions on the target, in a sentence.
//! - [`ideal`](mod@ideal): approximation of ideal joints: stiffness, scheme and step.
//! - [`variants_table`]: the scene and its variants as a table.
//! - [`front_table`]: the Pareto front as a table.
//! - [`command`]: command line of a measured run.
//! - [`chart`], [`page`]: chart and page for people.
//! - [`files`]: writes them and `trade.csv`.
//! - [`paper`]: the results of the method's paper, measured again.

pub mod advice;
pub mod cache;
pub mod chart;
pub mod command;
pub mod compliance;
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
