//! Line numbers of the tables of a scene.

use crate::text::Table;

/// Lines from 1, per kind in scene order.
#[derive(Clone, Debug, Default)]
pub(crate) struct FileLines {
    pub(crate) bodies: Vec<usize>,
    pub(crate) joints: Vec<usize>,
    pub(crate) tsdas: Vec<usize>,
    /// The rows of the TSDAs that are groups of the model, each by its first.
    pub(crate) raw_tsdas: Vec<usize>,
    pub(crate) points_on_lines: Vec<usize>,
    pub(crate) torsion_springs: Vec<usize>,
    pub(crate) interactions: Vec<usize>,
    pub(crate) couplings: Vec<usize>,
    pub(crate) inputs: Vec<usize>,
    pub(crate) readouts: Vec<usize>,
}

impl FileLines {
    /// The lines of all tables of the scene.
    pub(crate) fn of(root: &Table<'_>, raw_tsdas: Vec<usize>) -> Self {
        Self {
            bodies: root.lines("body"),
            joints: root.lines("joint"),
            raw_tsdas,
            tsdas: root.lines("tsda"),
            points_on_lines: root.lines("point_on_line"),
            torsion_springs: root.lines("torsion_spring"),
            interactions: root.lines("interaction"),
            couplings: root.lines("coupling"),
            inputs: root.lines("input"),
            readouts: root.lines("readout"),
        }
    }
}

impl FileLines {
    /// The lines of raw elements: TSDAs, then points on lines.
    pub(crate) fn raws(&self) -> impl Iterator<Item = &usize> {
        let tsdas = self.raw_tsdas.iter().filter_map(|row| self.tsdas.get(*row));
        tsdas.chain(&self.points_on_lines)
    }
}

/// Position of an interaction in the scene: kind and number of its table.
pub(crate) type LawPlace = (&'static str, usize);
