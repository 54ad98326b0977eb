//! What holds for every scene: joints assemble without strain, and no text makes the reader fail.

use dbd_scene::Scene;
use miette::Diagnostic as _;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const FOUR_BAR: &str = include_str!("../../../../scenes/four-bar.toml");
const POINTS: &str = include_str!("../../../../tests/fuzz/corpus/scene/points.toml");

/// A direction with its reference, as they stand in a scene.
fn direction() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-1.0..1.0_f64)
        .prop_filter("a direction", |v| v.iter().map(|c| c * c).sum::<f64>() > 1e-4)
}

/// The same cases on every run; one that fails is shrunk and printed.
fn cases() -> ProptestConfig {
    let rng_seed = RngSeed::Fixed(2297);
    ProptestConfig { failure_persistence: None, rng_seed, ..Default::default() }
}

proptest! {
    #![proptest_config(cases())]

    /// However its bodies lie, a joint's springs are at free length to the rounding of its
    /// coordinates.
    #[test]
    fn joints_assemble_at_free_length(
        at in prop::array::uniform3(-10.0..10.0_f64),
        axis in direction(),
        centres in prop::array::uniform2(prop::array::uniform3(-10.0..10.0_f64)),
        turns in prop::array::uniform2((direction(), -7.0..7.0_f64)),
        span in 0.01..2.0_f64,
        ring in prop::option::of(0.01..2.0_f64),
    ) {
        let mut text = "name = \"p\"\nduration = 1\n".to_owned();
        for (i, (centre, (axis, angle))) in centres.iter().zip(turns).enumerate() {
            text += &format!(
                "[[body]]\nname = \"b{i}\"\nmass = 1\ninertia = [1, 1, 1]\nposition = {centre:?}\n\
                 orientation = {{ axis = {axis:?}, angle = {angle:?} }}\n"
            );
        }
        let normal = axis.iter().position(|c| c.abs() > 1e-3).map_or([0.0, 0.0, 1.0], |i| {
            // Two components swapped, one negated, the third 0: normal to the axis.
            let mut normal = [0.0; 3];
            normal[i] = -axis[(i + 1) % 3];
            normal[(i + 1) % 3] = axis[i];
            normal
        });
        let ring = ring.map(|ring| format!("ring = {ring:?}\n")).unwrap_or_default();
        text += &format!(
            "[[joint]]\nname = \"r\"\ntype = \"revolute\"\nbetween = [\"b0\", \"b1\"]\nat = {at:?}\n\
             stiffness = 1\naxis = {axis:?}\nspan = {span:?}\n{ring}\
             [[joint]]\nname = \"s\"\ntype = \"spherical\"\nbetween = [\"b1\", \"world\"]\nat = {at:?}\n\
             stiffness = 1\narm = {span:?}\n\
             [[joint]]\nname = \"c\"\ntype = \"cylindrical\"\nbetween = [\"b0\", \"b1\"]\nat = {at:?}\n\
             stiffness = 1\naxis = {axis:?}\nspan = {span:?}\noffset = 0.3\n\
             [[joint]]\nname = \"t\"\ntype = \"translational\"\nbetween = [\"world\", \"b1\"]\nat = {at:?}\n\
             stiffness = 1\naxis = {axis:?}\nspan = {span:?}\noffset = 0.02\ngauge = 0.1\n\
             [[joint]]\nname = \"f\"\ntype = \"fixed\"\nbetween = [\"b1\", \"world\"]\nat = {at:?}\n\
             stiffness = 1\naxis = {axis:?}\nspan = 0.5\narm = {span:?}\n\
             [[joint]]\nname = \"u\"\ntype = \"universal\"\nbetween = [\"b1\", \"b0\"]\nat = {at:?}\n\
             stiffness = 1\naxes = [{axis:?}, {normal:?}]\nspan = {span:?}\n{ring}\
             spider = {{ mass = 1, inertia = [1, 1, 1] }}\n"
        );
        let scene = Scene::parse(&text, "p").map_err(|e| TestCaseError::fail(e.to_string()))?;
        for joint in &scene.joints {
            // Some tens of roundings of coordinates of up to 35 m.
            prop_assert!(joint.assembly_error < 1e-13, "{}: {:e}", joint.name, joint.assembly_error);
        }
    }

    /// A scene with some bytes put in, taken out or repeated is read or refused with a place
    /// within it, a reason and a remedy; never a panic.
    #[test]
    fn a_damaged_scene_is_read_or_refused(
        is_of_points in any::<bool>(),
        start in 0..FOUR_BAR.len(),
        length in 0..60_usize,
        insert in "[\\[\\]{}=,.\"'#a-z0-9 \n\\-_\u{e9}]{0,20}",
    ) {
        let whole = if is_of_points { POINTS } else { FOUR_BAR };
        let start = start % whole.len();
        let floor = |i: usize| (0..=i.min(whole.len())).rev().find(|i| whole.is_char_boundary(*i));
        let (start, end) = (floor(start).unwrap_or(0), floor(start + length).unwrap_or(0));
        let text = format!("{}{insert}{}", &whole[..start], &whole[end..]);
        if let Err(error) = Scene::parse(&text, "damaged.toml") {
            let (line, column) = error.line().zip(error.column()).unwrap_or_default();
            let width = text.split('\n').nth(line - 1).map(|line| line.chars().count());
            prop_assert!(width.is_some_and(|width| column <= width + 1), "{line}:{column}");
            prop_assert!(!error.message().is_empty() && !error.help().is_empty());
            // Rendering needs the span to lie on character boundaries of the text.
            let span = error.labels().and_then(|mut labels| labels.next()).map(|label| *label.inner());
            let span = span.map(|span| span.offset()..span.offset() + span.len());
            prop_assert!(span.clone().and_then(|span| text.get(span)).is_some(), "{span:?}");
            let shown = error.source_code().map(|code| code.read_span(&(0, 0).into(), 0, 0));
            let name = shown.and_then(Result::ok).and_then(|shown| shown.name().map(str::to_owned));
            prop_assert_eq!(name.as_deref(), Some("damaged.toml"));
        }
    }
}

/// Brackets nested without end exhaust no stack.
#[test]
fn deep_nesting_is_refused() {
    for text in ["[".repeat(100_000), format!("x = {}", "[".repeat(100_000)), "{a=".repeat(50_000)]
    {
        assert!(Scene::parse(&text, "deep.toml").is_err());
    }
}
