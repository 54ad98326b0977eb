//! Random expressions compared with a second evaluation on the tree from which the text was written; and arbitrary
//! texts.

use std::cell::Cell;

use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};

use super::*;

/// An expression as a tree.
#[derive(Clone, Debug)]
enum Tree {
    /// `count · 10^ten` of a unit.
    Number(u32, i32, usize),
    Name(usize),
    Negative(Box<Tree>),
    Power(Box<Tree>, i32),
    Root(Box<Tree>),
    /// `+`, `-`, `*` or `/`.
    Of(char, Box<(Tree, Tree)>),
}

/// Units, their power of ten relative to SI, and their powers of m, kg, s, rad.
const UNITS: [(&str, i32, [i32; 4]); 10] = [
    ("", 0, [0; 4]),
    ("", 0, [0; 4]),
    ("m", 0, [1, 0, 0, 0]),
    ("mm", -3, [1, 0, 0, 0]),
    ("kN", 3, [1, 1, -2, 0]),
    ("us", -6, [0, 0, 1, 0]),
    ("mm^2", -6, [2, 0, 0, 0]),
    ("rad", 0, [0, 0, 0, 1]),
    ("kN/mm", 6, [0, 1, -2, 0]),
    ("g·cm²/rad", -7, [2, 1, 0, -1]),
];

/// Names, their values and their powers.
const NAMES: [(&str, f64, &str, [i32; 4]); 4] = [
    ("L", 0.3, "m", [1, 0, 0, 0]),
    ("k_1", -7e3, "", [0; 4]),
    ("ω", 12.5, "rad/s", [0, 0, -1, 1]),
    ("none", 0.0, "kg", [0, 1, 0, 0]),
];

fn trees() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        4 => (0..1_000_000_u32, -6..7_i32, 0..UNITS.len())
            .prop_map(|(count, ten, unit)| Tree::Number(count, ten, unit)),
        2 => (0..NAMES.len()).prop_map(Tree::Name),
    ];
    leaf.prop_recursive(5, 24, 2, |inner| {
        let pair = (inner.clone(), inner.clone());
        // Most random sums mix dimensions; this one adds a multiple of the same value.
        let like = (prop::sample::select(vec!['+', '-']), 0..50_u32, inner.clone());
        let like = like.prop_map(|(sign, count, tree)| {
            let times = Tree::Of('*', (Tree::Number(count, 0, 0), tree.clone()).into());
            Tree::Of(sign, (tree, times).into())
        });
        prop_oneof![
            1 => inner.clone().prop_map(|tree| Tree::Negative(tree.into())),
            1 => (inner.clone(), prop::sample::select(vec![-3, -2, -1, 1, 2, 3, 5]))
                .prop_map(|(tree, power)| Tree::Power(tree.into(), power)),
            1 => inner.prop_map(|tree| Tree::Root(Tree::Power(tree.into(), 2).into())),
            4 => (prop::sample::select(vec!['*', '*', '/', '/', '+']), pair)
                .prop_map(|(sign, pair)| Tree::Of(sign, pair.into())),
            3 => like,
        ]
    })
}

/// Value and powers; `None` where undefined.
fn evaluated(tree: &Tree) -> Option<(f64, [i32; 4])> {
    let (value, powers) = match tree {
        Tree::Number(count, ten, unit) => {
            let (_, of_unit, powers) = UNITS[*unit];
            // Both are exact up to 10^22, and one operation rounds once.
            let power = 10_f64.powi((ten + of_unit).abs());
            let count = f64::from(*count);
            (if ten + of_unit < 0 { count / power } else { count * power }, powers)
        }
        Tree::Name(name) => (NAMES[*name].1, NAMES[*name].3),
        Tree::Negative(tree) => {
            let (value, powers) = evaluated(tree)?;
            (-value, powers)
        }
        Tree::Power(tree, power) => {
            let (value, powers) = evaluated(tree)?;
            if value == 0.0 && *power < 0 {
                return None;
            }
            let product = (1..power.abs()).fold(value, |product, _| product * value);
            let value = if *power < 0 { 1.0 / product } else { product };
            (value, powers.map(|of_unit| of_unit * power))
        }
        Tree::Root(tree) => {
            let (value, powers) = evaluated(tree)?;
            if value < 0.0 || powers.iter().any(|power| power % 2 != 0) {
                return None;
            }
            (value.sqrt(), powers.map(|power| power / 2))
        }
        Tree::Of(sign, pair) => {
            let (left, of_left) = evaluated(&pair.0)?;
            let (right, of_right) = evaluated(&pair.1)?;
            let sum: [i32; 4] = std::array::from_fn(|i| of_left[i] + of_right[i]);
            let difference: [i32; 4] = std::array::from_fn(|i| of_left[i] - of_right[i]);
            match sign {
                '+' if of_left == of_right => (left + right, of_left),
                '-' if of_left == of_right => (left - right, of_left),
                '*' => (left * right, sum),
                '/' if right != 0.0 => (left / right, difference),
                _ => return None,
            }
        }
    };
    (value.is_finite() && powers.iter().all(|power| power.abs() <= 24)).then_some((value, powers))
}

/// The text of a tree: brackets where they are needed, and blanks by the bits of `blanks`.
fn written(tree: &Tree, blanks: u64) -> String {
    let blank = |bit: u32| if blanks.rotate_right(bit) & 1 == 0 { " " } else { "" };
    let inner = |tree: &Tree| written(tree, blanks.rotate_left(7));
    let closed = |tree: &Tree| format!("({}{})", blank(3), inner(tree));
    match tree {
        Tree::Number(count, ten, unit) => {
            format!("{count}e{ten}{}{}", blank(1), UNITS[*unit].0)
        }
        Tree::Name(name) => NAMES[*name].0.to_owned(),
        Tree::Negative(tree) => match **tree {
            Tree::Of(..) => format!("-{}", closed(tree)),
            _ => format!("-{}{}", blank(2), inner(tree)),
        },
        Tree::Power(tree, power) => format!("{}{}^{power}", closed(tree), blank(6)),
        Tree::Root(tree) => format!("sqrt{}{}", blank(6), closed(tree)),
        Tree::Of(sign, pair) => {
            let is_product = matches!(sign, '*' | '/');
            let is_sum = |tree: &Tree| matches!(tree, Tree::Of('+' | '-', _));
            let left = match &pair.0 {
                left if is_product && is_sum(left) => closed(left),
                left => inner(left),
            };
            let right = match &pair.1 {
                // A unit belongs to its number, so operands after an operator need brackets.
                right @ (Tree::Number(..) | Tree::Negative(_)) if is_product => closed(right),
                right @ Tree::Of(..) if is_product || is_sum(right) => closed(right),
                right => inner(right),
            };
            format!("{left}{}{sign}{}{right}", blank(4), blank(5))
        }
    }
}

fn cases() -> ProptestConfig {
    let rng_seed = RngSeed::Fixed(1799);
    ProptestConfig { failure_persistence: None, rng_seed, cases: 512, ..Default::default() }
}

#[test]
fn a_text_has_the_value_of_its_tree() {
    let mut scope = Scope::of(NAMES.iter().map(|(name, ..)| (*name).to_owned()));
    for (row, (_, value, unit, _)) in NAMES.iter().enumerate() {
        scope.set(row, Quantity { value: *value, dimension: dimension_of(unit) });
    }
    let with_value = Cell::new(0);
    let check = |(tree, blanks): (Tree, u64)| {
        let text = written(&tree, blanks);
        let found = within(&text, Some(&scope));
        let Some((value, [metre, kilogram, second, radian])) = evaluated(&tree) else {
            prop_assert!(found.is_err(), "{text}: {found:?}");
            return Ok(());
        };
        let found = found.map_err(|fault| TestCaseError::fail(format!("{text}: {fault}")))?;
        let dimension = Dimension::new(metre as i8, kilogram as i8, second as i8, radian as i8);
        prop_assert_eq!(found.dimension, dimension, "{}", &text);
        prop_assert_eq!(found.value.to_bits(), value.to_bits(), "{}", &text);
        with_value.set(with_value.get() + 1);
        Ok(())
    };
    let run = TestRunner::new(cases()).run(&(trees(), any::<u64>()), check);
    run.unwrap_or_else(|failure| panic!("{failure}"));
    assert!(with_value.get() > 200, "{} of 512 have a value", with_value.get());
}

proptest! {
    #![proptest_config(cases())]

    /// A value that is finite, or a fault within the text on whole characters.
    #[test]
    fn any_text_has_a_value_or_a_fault(
        words in prop::collection::vec("[ -~]{0,3}|[0-9.e+-]{1,6}|k?N|mm|s\\^-?[0-9]|²|⁻|°|µs|é|\\(|\\)|\\*|/|L", 0..12),
    ) {
        let text = words.concat();
        let mut scope = Scope::of(std::iter::once("L".to_owned()));
        scope.set(0, Quantity { value: 0.3, dimension: dimension_of("m") });
        match within(&text, Some(&scope)) {
            Ok(found) => prop_assert!(found.value.is_finite(), "{text}"),
            Err(fault) => {
                prop_assert!(text.get(fault.place.clone()).is_some(), "{text}: {:?}", fault.place);
                prop_assert!(!fault.message.is_empty() && !fault.help.is_empty());
            }
        }
    }

    /// A number as it is printed is that number, and a decimal unit behind it shifts its point.
    #[test]
    fn numbers_read_as_they_are_printed(value in prop::num::f64::POSITIVE | prop::num::f64::SUBNORMAL) {
        for text in [format!("{value:?}"), format!("{value:e}"), format!("{value} km / km")] {
            prop_assert_eq!(evaluate(&text).map(|found| found.value), Ok(value), "{}", text);
        }
    }
}
