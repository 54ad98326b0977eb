//! `[[point_on_line]]`: a point of the second body projected onto a line of the first.

use dbd_kernel::Vec3;

use crate::assembly::{Assembly, Lines, Points};
use crate::between::Between;
use crate::error::SceneError;
use crate::pair::Pair;
use crate::points::PlaceOf;
use crate::spring;
use crate::target::{Elements, Target};
use crate::text::{Direction, Number, Table};

pub(crate) const KEYS: &[&str] =
    &["name", "between", "line_point", "line_direction", "point", "free_length", "clearance"];

/// A point closer to its line than this fraction of the free length counts as on it and gives no direction.
const COINCIDENT: f64 = 1e-9;

/// Reads all points on lines in scene order and names them for messages.
pub(crate) fn read_all(
    root: &Table<'_>,
    assembly: &mut Assembly,
    elements: &mut Elements,
) -> Result<Vec<String>, SceneError> {
    let mut labels = Vec::new();
    for table in root.list("point_on_line")? {
        table.only(&[KEYS, spring::KEYS])?;
        let target = Target::PointOnLine(assembly.groups().len());
        elements.read_optional(&table, "point_on_line", target)?;
        let pair = table.required("between", Between(assembly))?;
        let place = |body| PlaceOf { assembly, body };
        let line_point = table.required("line_point", place(pair.a))?;
        let direction = assembly.of_written(pair.a, table.required("line_direction", Direction)?);
        let tip = table.required("point", place(pair.b))?;
        let spring = spring::read(&table, spring::AXIAL)?;
        let free_length = table.required("free_length", Number::not_negative("m"))?;
        if distance(assembly, &pair, (line_point, direction), tip) <= COINCIDENT * free_length
            && free_length > 0.0
        {
            let help = "move the point off the line, or use `free_length = 0` for a spring that is \
                isotropic across the line";
            let problem = "lies on the line, but `free_length` is not 0";
            return Err(table.refuse_value("point", problem, help));
        }
        let points = Points { centres: &[line_point], tips: &[tip], shared: false };
        assembly
            .add_lines(&pair, points, Lines { direction, free_length }, spring)
            .map_err(|defect| defect.refuse(&table))?;
        labels.push(pair.label(&table));
    }
    Ok(labels)
}

/// \[m\] distance of a point of the second body from a line of the first.
fn distance(
    assembly: &Assembly,
    pair: &Pair,
    (line_point, direction): (Vec3<f64>, Vec3<f64>),
    point: Vec3<f64>,
) -> f64 {
    let d = assembly.place(pair.b, point) - assembly.place(pair.a, line_point);
    let d = assembly.vector_in(pair.a, d);
    let e = d - direction * d.dot(direction);
    libm::sqrt(e.dot(e))
}

#[cfg(test)]
mod tests {
    use dbd_kernel::model::Law;
    use dbd_kernel::{BodyIndex, Vec3};

    use crate::example;

    #[test]
    fn points_and_line_are_taken_as_given_and_come_after_all_else() {
        let scene = example::with(
            "[[point_on_line]]\nbetween = [\"arm\", \"hand\"]\nline_point = [0, 0.02, 0]\n\
             line_direction = [3, 0, 4]\npoint = [0.015, 0.02, 0]\nstiffness = 4e5\ndamping = 2\n\
             free_length = 0.01\n[[tsda]]\nbetween = [\"world\", \"hand\"]\n\
             points = [[1, 2, 3], [0, 0, 0]]\nstiffness = 8\nfree_length = 1\n\
             [[point_on_line]]\nbetween = [\"hand\", \"world\"]\nline_point = [0, 0, 0]\n\
             line_direction = [0, -2, 0]\npoint = [0, 0, 0]\nstiffness = 1\nfree_length = 0",
        );
        let model = &scene.model;
        let laws: Vec<_> = model.groups.iter().map(|group| group.law).collect();
        assert_eq!(laws, [Law::Tsda, Law::PointOnLine, Law::PointOnLine]);
        assert_eq!(model.points[2..4], [Vec3::new(0.0, 0.02, 0.0), Vec3::new(0.015, 0.02, 0.0)]);
        assert_eq!(model.lines[0].direction, Vec3::new(0.6, 0.0, 0.8));
        assert_eq!((model.lines[0].stiffness, model.lines[0].free_length), (4e5, 0.01));
        assert_eq!(model.lines[1].direction, Vec3::new(0.0, -1.0, 0.0));
        assert_eq!(model.lines[1].free_length, 0.0);
        assert_eq!((model.dampers.as_slice(), model.tsda_count()), (&[2.0][..], 3));
        assert_eq!((model.groups[2].a, model.groups[2].b), (BodyIndex(1), BodyIndex::WORLD));
    }
}
