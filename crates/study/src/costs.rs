//! Counted cost of a step on Cortex-M4F: the table `docs/costs.csv`.
//!
//! `(scene, scheme, newton, damping, precision, orientation) => instructions per step`. The table
//! is part of the binary; `cargo xtask cost` measures it, see `docs/target.md`. A count applies to the shipped scene: a
//! scene of the same name with other bodies or elements has another cost.

use std::collections::BTreeMap;

use serde::Deserialize;

/// The table as shipped.
const TABLE: &str = include_str!("../costs.csv");

/// The only orientation representation that is counted.
const ORIENTATION: &str = "quaternion";

/// Instructions per step on Cortex-M4F by scene, scheme and precision.
#[derive(Clone, Debug)]
pub struct Costs {
    rows: BTreeMap<(String, String, String), f64>,
}

/// The columns that are read.
#[derive(Deserialize)]
struct Row {
    scene: String,
    /// With `+1` for a Newton iteration, `-` and another damping than the scheme's own.
    scheme: String,
    precision: String,
    instructions_mean: f64,
}

impl Costs {
    /// The counts that the binary was built with.
    ///
    /// # Panics
    /// Never: a test reads the table.
    #[must_use]
    pub fn shipped() -> Self {
        Self::read(TABLE).expect("the table is read by a test")
    }

    /// No counts at all.
    #[must_use]
    pub fn none() -> Self {
        Self { rows: BTreeMap::new() }
    }

    fn read(table: &str) -> Result<Self, csv::Error> {
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let rows = reader.deserialize().map(|row| {
            let Row { scene, scheme, precision, instructions_mean } = row?;
            Ok(((scene, scheme, precision), instructions_mean))
        });
        Ok(Self { rows: rows.collect::<Result<_, csv::Error>>()? })
    }

    /// Instructions per step, the mean of the counted steps; `None` if not counted.
    ///
    /// `newton` is the number of Newton iterations, `damping` the damping mode if it is not the scheme's default.
    #[must_use]
    pub fn instructions_per_step(
        &self,
        scene: &str,
        scheme: &str,
        newton: Option<u32>,
        damping: Option<&str>,
        precision: &str,
        orientation: &str,
    ) -> Option<f64> {
        if orientation != ORIENTATION {
            return None;
        }
        let mut scheme = scheme.to_owned();
        if let Some(newton) = newton.filter(|newton| *newton > 0) {
            scheme += &format!("+{newton}");
        }
        if let Some(damping) = damping {
            scheme += &format!("-{damping}");
        }
        self.rows.get(&(scene.to_owned(), scheme, precision.to_owned())).copied()
    }

    /// Instructions of a step relative to leapfrog in f32, median of the scenes of which both were counted; `None` if
    /// there is none.
    #[must_use]
    pub fn over_leapfrog(
        &self,
        scheme: &str,
        newton: Option<u32>,
        precision: &str,
        orientation: &str,
    ) -> Option<f64> {
        let of = |scene: &str, (scheme, newton, precision): (&str, Option<u32>, &str)| {
            self.instructions_per_step(scene, scheme, newton, None, precision, orientation)
        };
        let scenes = self.rows.keys().map(|(scene, ..)| scene.as_str());
        let mut scenes: Vec<&str> = scenes.collect();
        scenes.dedup();
        let ratio = |scene: &&str| {
            let leapfrog = of(scene, ("leapfrog", None, "f32"))?;
            Some(of(scene, (scheme, newton, precision))? / leapfrog)
        };
        let mut ratios: Vec<f64> = scenes.iter().filter_map(ratio).collect();
        ratios.sort_by(f64::total_cmp);
        // Dampers cost nothing with a matrix, so damped scenes lower the median of the undamped ones.
        let row = match scheme.starts_with("generalized-alpha") {
            true => ratios.len() * 2 / 3,
            false => ratios.len() / 2,
        };
        ratios.get(row).copied()
    }
}

#[cfg(test)]
mod tests {
    use dbd_plant::{Named as _, SchemeName};

    use super::*;

    const CHARTED: [&str; 9] = [
        "four-bar",
        "five-bar-a",
        "five-bar-b",
        "six-bar",
        "3rrr",
        "crank-slider",
        "3ruu",
        "hexagon",
        "double-wishbone",
    ];

    fn plain(costs: &Costs, scene: &str, scheme: &str, precision: &str) -> Option<f64> {
        costs.instructions_per_step(scene, scheme, None, None, precision, ORIENTATION)
    }

    #[test]
    fn every_row_of_the_table_is_one_of_the_map() {
        assert_eq!(Costs::shipped().rows.len(), TABLE.lines().count() - 1);
    }

    #[test]
    fn a_row_is_found_by_its_names() {
        let table = "scene,scheme,precision,step_s,instructions_mean,more\n\
                     a,dbd,f32,1e-4,300,\na,dbd+1,f32,1e-4,400,7\na,leapfrog-explicit,f64,1e-4,200,\n";
        let costs = Costs::read(table).unwrap();
        let get = |scheme, newton, explicit: bool, precision, orientation| {
            let damping = explicit.then_some("explicit");
            costs.instructions_per_step("a", scheme, newton, damping, precision, orientation)
        };
        assert_eq!(get("dbd", None, false, "f32", "quaternion"), Some(300.0));
        assert_eq!(get("dbd", Some(0), false, "f32", "quaternion"), Some(300.0));
        assert_eq!(get("dbd", Some(1), false, "f32", "quaternion"), Some(400.0));
        assert_eq!(get("leapfrog", None, true, "f64", "quaternion"), Some(200.0));
        for missing in [
            get("dbd", Some(2), false, "f32", "quaternion"),
            get("dbd", None, true, "f32", "quaternion"),
            get("dbd", None, false, "f64", "quaternion"),
            get("dbd", None, false, "f32", "euler-321"),
            get("leapfrog", None, false, "f64", "quaternion"),
            costs.instructions_per_step("b", "dbd", None, None, "f32", "quaternion"),
        ] {
            assert_eq!(missing, None);
        }
        assert!(Costs::read("scene,scheme,precision\na,dbd,f32\n").is_err());
    }

    #[test]
    fn every_scheme_of_a_charted_scene_was_counted() {
        let costs = Costs::shipped();
        // Of the scheme of three solves a few models of each precision were counted.
        let counted_in_part = SchemeName::GeneralizedAlpha3;
        for scheme in SchemeName::ALL.iter().filter(|scheme| **scheme != counted_in_part) {
            let name = scheme.name();
            for scene in CHARTED {
                for precision in ["f32", "f64"] {
                    let count = plain(&costs, scene, name, precision);
                    assert!(count.is_some(), "{scene} {name} {precision}");
                }
            }
        }
        let explicit = |scheme| {
            let damping = Some("explicit");
            costs.instructions_per_step(
                "double-wishbone",
                scheme,
                None,
                damping,
                "f32",
                ORIENTATION,
            )
        };
        assert!(explicit("leapfrog").is_some() && explicit("semi-implicit-euler").is_some());
    }

    /// Without damper passes a step costs little more than its evaluations.
    #[test]
    fn counts_grow_with_the_evaluations() {
        let costs = Costs::shipped();
        for scene in CHARTED.into_iter().filter(|scene| *scene != "double-wishbone") {
            let one = plain(&costs, scene, "leapfrog", "f32").unwrap();
            for (scheme, evaluations) in [
                ("dbd-p1", 2.0),
                ("dbd", 3.0),
                ("dbd-p2", 3.0),
                ("pefrl", 4.0),
                ("rk4", 4.0),
                ("blanes-moan-s6", 6.0),
            ] {
                let ratio = plain(&costs, scene, scheme, "f32").unwrap() / one;
                assert!(
                    (0.7 * evaluations..1.3 * evaluations).contains(&ratio),
                    "{scene} {scheme}: {ratio}"
                );
            }
            let dbd = plain(&costs, scene, "dbd", "f32").unwrap();
            let iterated =
                costs.instructions_per_step(scene, "dbd", Some(1), None, "f32", ORIENTATION);
            let ratio = iterated.unwrap() / dbd;
            assert!((1.25..1.5).contains(&ratio), "{scene}: {ratio}");
        }
    }
}
