//! What a step may cost: each goal beside its figure.
//!
//! `rows => lines`. A goal judges nothing: what is kept is judged by the baseline.

use std::fmt::Write as _;

use super::row::Cost;

/// What of a row.
#[derive(Clone, Copy)]
enum Figure {
    /// Instructions of a step, mean.
    Instructions,
    /// \[bytes\] plant and stack, beside the const model.
    Ram,
    /// \[bytes\] code and model.
    Flash,
}

/// Scene, scheme and precision; the figure; the most that it is to be.
const GOALS: &[(&str, Figure, u64)] = &[
    ("hexagon leapfrog f32", Figure::Instructions, 4_500),
    ("hexagon-bushing leapfrog f32", Figure::Instructions, 2_800),
    ("hexagon-planar leapfrog f32", Figure::Instructions, 1_100),
    ("hexagon-damped semi-implicit-euler-explicit f32", Figure::Instructions, 5_000),
    ("3ruu-bushing leapfrog f32", Figure::Instructions, 9_000),
    ("double-wishbone leapfrog f32", Figure::Instructions, 12_000),
    ("cart-pendulum leapfrog f32", Figure::Instructions, 6_000),
    ("gripper leapfrog f32", Figure::Instructions, 24_000),
    ("double-wishbone leapfrog-joint-wise f32", Figure::Instructions, 12_000),
    ("cart-pendulum leapfrog-joint-wise f32", Figure::Instructions, 6_000),
    ("gripper leapfrog-joint-wise f32", Figure::Instructions, 24_000),
    ("hexagon leapfrog fixed", Figure::Instructions, 7_625),
    ("3ruu generalized-alpha f32", Figure::Instructions, 45_000),
    ("six-bar generalized-alpha f32", Figure::Instructions, 16_000),
    ("six-bar-planar generalized-alpha f32", Figure::Instructions, 5_000),
    ("3ruu leapfrog f32", Figure::Ram, 4 * 1024),
    ("3ruu leapfrog f32", Figure::Flash, 32 * 1024),
];

/// The goals with the rows' figures; `-` where a row or its figure is not known.
pub fn table(costs: &[Cost]) -> String {
    let mut text =
        format!("{:<50} {:<12} {:>8} {:>8}\n", "scene scheme precision", "figure", "goal", "now");
    for (name, figure, most) in GOALS {
        let cost = costs.iter().find(|cost| cost.name() == *name);
        let now = cost.and_then(|cost| figure.of(cost));
        let (shown, reached) = match now {
            Some(now) => (now.to_string(), if now <= *most { "reached" } else { "" }),
            None => ("-".to_owned(), ""),
        };
        let line = format!("{name:<50} {:<12} {most:>8} {shown:>8} {reached}", figure.name());
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text
}

impl Figure {
    const fn name(self) -> &'static str {
        match self {
            Self::Instructions => "instructions",
            Self::Ram => "RAM [B]",
            Self::Flash => "flash [B]",
        }
    }

    fn of(self, cost: &Cost) -> Option<u64> {
        match self {
            Self::Instructions => Some(cost.mean),
            Self::Ram => Some(cost.plant + cost.stack),
            Self::Flash => cost.text.map(|text| text + cost.model),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_goal_stands_beside_its_figure() {
        let line = "cost 3ruu leapfrog f32 100000 9000 9000 8800 1900 3400 600";
        let mut cost = Cost::parse(line).unwrap();
        let known = |cost: &Cost| table(std::slice::from_ref(cost));
        let line = |text: &str, figure: &str| {
            let line = text.lines().find(|line| line.starts_with("3ruu") && line.contains(figure));
            line.unwrap().split_whitespace().skip(3).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(line(&known(&cost), "RAM"), "RAM [B] 4096 2500 reached");
        assert_eq!(line(&known(&cost), "flash"), "flash [B] 32768 -");
        cost.text = Some(30_000);
        assert_eq!(line(&known(&cost), "flash"), "flash [B] 32768 33400");
    }
}
