//! The book: its figures and tables, its contents, links and manners, and the README's.

mod chart;
mod contents;
mod engines;
mod figures;
mod measures;
mod peers;
mod rounding;
mod units;
