//! What `cargo xtask bench` takes.

use crate::chain;
use clap::Parser;
use clap::builder::RangedU64ValueParser;

/// Bodies along a side of the nets where nobody says.
const NETS: [usize; 2] = [10, 32];

/// Measures what a step costs here: the kernel in turn with the std reference and a plain loop
#[derive(Clone, Debug, Parser)]
#[command(name = "bench", max_term_width = 100, after_help = include_str!("examples.txt"))]
pub struct BenchArguments {
    /// Scenes by name (see list), paths to .toml files or - for standard input [default: the ten systems of the
    /// paper's Table 7, and chains]
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Changes one value of the scenes by its path, as often as wanted, see run
    #[arg(long = "set", value_name = "PATH=VALUE", requires = "scenes")]
    pub set: Vec<String>,
    /// Links of chains, one chain each [default: 10,100,1000,10000 where no scene is named, else none]
    #[arg(
        long,
        value_name = "LINKS",
        value_delimiter = ',',
        value_parser = RangedU64ValueParser::<usize>::new().range(1..=chain::MAX as u64)
    )]
    pub chains: Option<Vec<usize>>,
    /// Bodies along a side of square nets of point masses, stepped by generalized-alpha [default: 10,32 where no
    /// scene is named, else none]
    #[arg(
        long,
        value_name = "BODIES",
        value_delimiter = ',',
        value_parser = RangedU64ValueParser::<usize>::new().range(2..=100)
    )]
    pub nets: Option<Vec<usize>>,
    /// Rounds in which each way is measured once
    #[arg(
        long,
        value_name = "N",
        default_value_t = 15,
        value_parser = RangedU64ValueParser::<usize>::new().range(3..=10_000)
    )]
    pub rounds: usize,
    /// Steps of a measurement [default: as many as take 2 ms]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    pub steps: Option<u64>,
    /// As JSON
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors, and with --json the result
    #[arg(long)]
    pub quiet: bool,
}

impl BenchArguments {
    /// Whether neither systems nor nets are named.
    pub fn by_default(&self) -> bool {
        self.scenes.is_empty() && self.chains.is_none() && self.nets.is_none()
    }

    /// Bodies along a side of the nets.
    pub fn nets(&self) -> Vec<usize> {
        let nets = self.by_default().then_some(&NETS[..]);
        self.nets.as_deref().or(nets).unwrap_or_default().to_vec()
    }
}
