//! Golden trajectories: compared, blessed, damaged.

mod compare;
mod damage;
mod files;
mod shared;
