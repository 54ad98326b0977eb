//! Values of texts, and errors of invalid ones.

use super::*;

fn value(text: &str) -> f64 {
    let found = evaluate(text);
    found.unwrap_or_else(|fault| panic!("{text}: {fault} ({})", fault.help)).value
}

fn scope(values: &[(&str, f64, &str)]) -> Scope {
    let mut scope = Scope::of(values.iter().map(|(name, ..)| (*name).to_owned()));
    for (row, (_, value, unit)) in values.iter().enumerate() {
        scope.set(row, Quantity { value: *value, dimension: dimension_of(unit) });
    }
    scope
}

#[test]
fn a_number_with_its_units_is_the_nearest_double() {
    for (text, expected) in [
        ("20us", 2e-5),
        ("20 µs", 2e-5),
        ("0.02 ms", 2e-5),
        ("0.1us", 1e-7),
        ("9 kN/mm", 9e6),
        ("9kN / mm", 9e6),
        ("9 kN·mm^-1", 9e6),
        ("7850 kg/m^3", 7850.0),
        ("7.85 g/cm³", 7850.0),
        ("50 N*m/rad", 50.0),
        ("50 N.m/rad", 50.0),
        ("50 N·m·rad⁻¹", 50.0),
        ("12 cm^2", 12e-4),
        ("36 km/h", 10.0),
        ("0.1 in", 2.54e-3),
        ("3.3 ft", 1.005_84),
        ("0.7 lb", 0.317_514_659),
        ("10 lbf", 44.482_216_152_605),
        ("210 GPa", 2.1e11),
        ("2.5 bar", 2.5e5),
        ("1.5 h", 5400.0),
        ("3 m/min*min", 3.0),
        ("30 deg", 30.0_f64.to_radians()),
        ("30°", 30.0_f64.to_radians()),
        ("-77.7 deg", (-77.7_f64).to_radians()),
        ("1 turn", core::f64::consts::TAU),
        ("1.5e-3", 1.5e-3),
        ("+1E+3 ms", 1.0),
        (".02ms", 2e-5),
        ("2.e1us", 2e-5),
        ("1e-999999999999999999999 kg", 0.0),
        ("pi", core::f64::consts::PI),
    ] {
        assert_eq!(value(text).to_bits(), expected.to_bits(), "{text}: {:?}", value(text));
    }
    assert!((value("60 rpm") - core::f64::consts::TAU).abs() < 1e-15);
    // A product would round twice and miss the nearest number.
    assert_ne!(value("20us"), 20.0 * 1e-6);
}

#[test]
fn signs_bind_as_in_arithmetic_and_units_closest_of_all() {
    for (text, expected) in [
        ("1 + 2 * 3", 7.0),
        ("(1 + 2) * 3", 9.0),
        ("2 - 3 - 4", -5.0),
        ("2 - (3 - 4)", 3.0),
        ("16 / 4 / 2", 2.0),
        ("16 / 4 * 2", 8.0),
        ("-2 * -3", 6.0),
        ("1 - -1", 2.0),
        ("1 −− 1", 2.0),
        ("- - -1", -1.0),
        ("2 × 3 ÷ 4", 1.5),
        ("1 / (2 mm)", 500.0),
        ("1 / 2 * mm", 5e-4),
        ("5 N / 2 mm", 2500.0),
        ("(5 / 2) * N / mm", 2500.0),
        ("1 m + 2 mm", 1.002),
        ("mm * 5", 0.005),
        ("6 kN / (2 mm * 3)", 1e6),
    ] {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn names_stand_for_their_quantities_and_are_marked() {
    let scope = scope(&[("L", 0.3, "m"), ("k", 9e6, ""), ("ω_2", 2.0, "rad/s"), ("idle", 1.0, "")]);
    for (text, expected, unit) in [
        ("2 * L + 5 mm", 0.605, "m"),
        ("k / 2", 4.5e6, ""),
        ("k * N/m", 9e6, "N/m"),
        ("L * L * 2700 kg/m^3", 0.3 * 0.3 * 2700.0, "kg/m"),
        ("-L / L", -1.0, ""),
        ("ω_2 * L / rad", 0.6, "m/s"),
    ] {
        let found = within(text, Some(&scope)).unwrap_or_else(|fault| panic!("{text}: {fault}"));
        assert_eq!((found.value, found.dimension), (expected, dimension_of(unit)), "{text}");
    }
    let used: Vec<_> = scope.iter().map(|(_, _, used)| used).collect();
    assert_eq!(used, [true, true, true, false]);
}

/// The displayed dimension of every unit reads back to the same dimension.
#[test]
fn units_and_dimensions_are_what_they_are_shown_as() {
    for unit in unit::UNITS {
        assert_eq!(unit::find(unit.name).map(|found| found.dimension), Some(unit.dimension));
        let shown = unit.dimension.to_string();
        let read = evaluate(&format!("1 * {shown}").replace("* 1/", "/"));
        assert_eq!(
            read.map(|one| (one.value, one.dimension)),
            Ok((1.0, unit.dimension)),
            "{shown}"
        );
        // A parameter may have the name of one of these, and hides it.
        let is_hidden = unit::HIDDEN.contains(&unit.name);
        let wanted = if is_hidden { Ok(()) } else { Err(NameFault::Unit) };
        assert!(check_name(unit.name) == wanted, "{}", unit.name);
    }
    for (unit, shown) in [
        ("kg·m²", "kg·m²"),
        ("N·m·s/rad", "N·m·s/rad"),
        ("J/rad", "N·m/rad"),
        ("1/s", "1/s"),
        ("Hz^2", "1/s²"),
        ("m/s²", "m/s²"),
        ("rad/s", "rad/s"),
        ("A", "A"),
        ("W/A", "V"),
        ("V/A", "ohm"),
        ("V·s/A", "H"),
        ("V·s", "N·m/A"),
        ("N·m/A/rad", "kg·m²/(s²·A·rad)"),
        ("kg*rad/m/s^2", "kg·rad/(m·s²)"),
        ("mm^-1*s^-1", "1/(m·s)"),
        ("", ""),
    ] {
        let found = evaluate(&format!("2 * 1 {unit}").replace("1 1/", "1/")).unwrap();
        assert_eq!(found.dimension.to_string(), shown, "{unit}");
    }
}

#[test]
fn values_have_powers_roots_and_angles_sines() {
    let scope = scope(&[("L", 0.3, "m"), ("sin", 4.0, ""), ("a", 3.0, "m"), ("b", 4.0, "m")]);
    for (text, expected, shown) in [
        ("L^2", 0.3 * 0.3, "m²"),
        ("L²", 0.3 * 0.3, "m²"),
        ("2 * L ^3", 2.0 * (0.3 * 0.3 * 0.3), "m³"),
        ("-L^2", -(0.3 * 0.3), "m²"),
        ("(-L)^2", 0.3 * 0.3, "m²"),
        ("L^-2", 1.0 / (0.3 * 0.3), "1/m²"),
        ("(2 mm)^2", 0.002 * 0.002, "m²"),
        ("2 mm^2", 2e-6, "m²"),
        ("2^9", 512.0, ""),
        ("sqrt(a^2 + b^2)", 5.0, "m"),
        ("sqrt(2)", core::f64::consts::SQRT_2, ""),
        // Whole degrees are exact.
        ("L * cos(60 deg)", 0.15, "m"),
        ("tan(45°)", 1.0, ""),
        ("cos(-90 deg)", 0.0, ""),
        ("cos(0.5)", 0.5_f64.cos(), ""),
        ("atan(b / b)", core::f64::consts::FRAC_PI_4, "rad"),
        ("asin(-1)", -core::f64::consts::FRAC_PI_2, "rad"),
        ("acos(cos(60 deg))", (60.0_f64).to_radians(), "rad"),
        // A parameter hides a function of the same name.
        ("sin * 2", 8.0, ""),
    ] {
        let found = within(text, Some(&scope)).unwrap_or_else(|fault| panic!("{text}: {fault}"));
        assert!(
            (found.value - expected).abs() <= f64::EPSILON * expected.abs(),
            "{text}: {}",
            found.value
        );
        assert_eq!(found.dimension.to_string(), shown, "{text}");
    }
    // A square root twice is the fourth root; what was measured in rad² has a root in rad.
    assert_eq!(evaluate("sqrt(sqrt(16 m^4))").unwrap().value, 2.0);
    assert_eq!(evaluate("sqrt(4 rad^2)").unwrap().dimension.to_string(), "rad");
}

#[test]
fn what_is_wrong_is_named_at_its_place() {
    let scope =
        scope(&[("length", 0.3, "m"), ("k", 9e6, ""), ("huge", 1e300, ""), ("nil", 0.0, "m")]);
    for (text, at, message, help) in [
        ("", "", "empty value", "30 deg"),
        ("  ", "", "empty value", "30 deg"),
        ("2 * lenght", "lenght", "`lenght` is neither a unit nor one of", "did you mean `length`?"),
        ("5 knm", "knm", "`knm` is neither", "did you mean `kNm`?"),
        ("5 KG", "KG", "`KG` is neither", "did you mean `kg`?"),
        ("3 m/s2", "s2", "`s2` is neither", "did you mean `s^2`?"),
        ("5 q", "q", "`q` is neither", "known parameters: length, k, huge, nil; known units:"),
        ("2 length", "length", "missing operator between `2` and `length`", "add `*`: 2 * length"),
        ("2(3)", "(", "missing operator between `2` and `(`", "2 * ("),
        ("5 m s", "s", "missing operator between `5 m` and `s`", "5 m * s"),
        ("length 3", "3", "missing operator between `length` and `3`", "length * 3"),
        ("1.2.3", ".3", "missing operator between `1.2` and `.3`", "`*`"),
        ("1,5", ",", "comma in a number", "0.5"),
        ("length^", "length^", "invalid exponent of a value", "L^2"),
        ("length^0", "length^0", "invalid exponent of a value", "from 1 to 9"),
        ("length^10", "length^10", "invalid exponent of a value", "sqrt(A)"),
        ("length^0.5", "length^0.5", "invalid exponent of a value", "sqrt(A)"),
        ("5 m^0.5", "m^0.5", "invalid exponent of a unit", "from 1 to 9"),
        ("(length)^2^2", "^", "a power of a power", "(L^2)^3"),
        ("nil^-2", "nil^-2", "division by 0", "another base"),
        ("huge^2", "huge^2", "too large", "1.8e308"),
        ("(1 m^9)^9", "(1 m^9)^9", "exponent of the unit is too high", "at most 24"),
        ("sqrt(length)", "(length)", "a value in m has no square root", "a * a"),
        ("sqrt(-4)", "(-4)", "square root of -4", "0 or more"),
        ("sqrt 4", "sqrt", "missing argument", "sqrt(…)"),
        ("sqrt()", ")", "or name before `)`", ""),
        ("sqrt(4", "(", "unclosed `(`", ")"),
        ("2 sqrt(4)", "sqrt", "missing operator between `2` and `sqrt`", "2 * sqrt"),
        ("sin(2 m)", "(2 m)", "a value in m is not an angle", "sin(30 deg)"),
        ("tan(90 deg)", "(90 deg)", "the tangent is infinite", "another angle"),
        ("asin(2)", "(2)", "out of range", "from -1 to 1"),
        ("atan(2 mm)", "(2 mm)", "a value in m is not a ratio", "rise / run"),
        ("exp(2)", "exp", "`exp` is neither", ""),
        ("sin(1e400)", "(1e400)", "too large", "1.8e308"),
        ("5 m^", "m^", "invalid exponent of a unit", "from 1 to 9"),
        ("5 m^0", "m^0", "invalid exponent of a unit", "from 1 to 9"),
        ("5 m^10", "m^10", "invalid exponent of a unit", "m^2"),
        ("5 m^99999999999999999999", "m^99999999999999999999", "invalid exponent of a unit", "m^2"),
        ("5 m²³", "m²³", "invalid exponent of a unit", "m^2"),
        ("5 h^9", "h^9", "invalid exponent of a unit", ""),
        ("5 m^9*m^9*m^9", "5 m^9*m^9*m^9", "exponent of the unit is too high", "at most 24"),
        ("2 * ", "", "missing number or name", ""),
        ("2 * / 3", "/", "or name before `/`", ""),
        ("(2 * 3", "(", "unclosed `(`", ")"),
        ("2 * 3)", ")", "unmatched `)`", "add the missing"),
        ("()", ")", "or name before `)`", ""),
        ("2 + $", "$", "unexpected `$` in a value", "+ - * /"),
        ("2.", "", "", ""),
        ("kN/mm", "kN/mm", "unit without a number", "\"1 kN/mm\""),
        ("length + 2", "2", "a plain number and a value in m", "\"5 m\""),
        ("k - 2 mm", "k", "a plain number and a value in m", "`* m` after a name"),
        ("2 N + 3 m", "3 m", "a value in m and one in N", "one dimension"),
        ("3 / 0", "0", "division by 0", "another divisor"),
        ("3 / (2 - 2)", "(2 - 2)", "division by 0", "another divisor"),
        ("3 m / nil", "nil", "division by 0", "another divisor"),
        ("2 + 1 / 2 mm", "1 / 2 mm", "`1 / 2 mm` is ambiguous", "1 / (2 mm) or 1 / 2 * mm"),
        ("k / 20us", "k / 20us", "is ambiguous", "k / (20us) or k / 20 * us"),
        ("1 + huge * huge", "huge * huge", "too large", "1.8e308"),
        ("1e308 * 10", "1e308 * 10", "too large", "1.8e308"),
        ("1e999", "1e999", "too large", "1.8e308"),
        ("1 / 1e999", "1e999", "too large", "1.8e308"),
        ("1 N / 1e999 mm", "1e999 mm", "too large", "1.8e308"),
        ("-1e308 - 1e308", "-1e308 - 1e308", "too large", "1.8e308"),
        ("1e306 km", "1e306 km", "too large", "1.8e308"),
        ("2 × length²³", "length²³", "invalid exponent of a value", "from 1 to 9"),
    ] {
        let Err(fault) = within(text, Some(&scope)) else {
            assert!(message.is_empty(), "{text}");
            continue;
        };
        assert_eq!(&text[fault.place.clone()], at, "{text}: {fault}");
        assert!(fault.message.contains(message), "{text}: {fault}");
        assert!(fault.help.contains(help), "{text}: {}", fault.help);
    }
    // Without parameters the message does not mention them.
    assert_eq!(evaluate("5 kn").unwrap_err().message, "unknown unit `kn`");
}

/// A stack is 8 MiB, or 2 in a thread: brackets are limited, everything else goes along the text.
#[test]
fn long_texts_take_no_stack() {
    let deep = |n: usize| format!("{}1{}", "(".repeat(n), ")".repeat(n));
    assert_eq!(value(&deep(32)), 1.0);
    for n in [33, 100_000] {
        let fault = evaluate(&deep(n)).unwrap_err();
        assert_eq!(fault.message, "brackets are nested more than 32 deep");
        assert_eq!(fault.place, 32..33);
    }
    assert_eq!(value(&format!("1{}", " + 1".repeat(20_000))), 20_001.0);
    assert_eq!(value(&format!("{}1", "-".repeat(100_000))), 1.0);
    assert_eq!(value(&format!("{}.5 in", "0".repeat(100_000))), 0.0127);
    for text in ["1*".repeat(50_000), "m".repeat(100_000), "1(".repeat(50_000), "(".repeat(99_999)]
    {
        let fault = evaluate(&text).unwrap_err();
        assert!(fault.message.len() + fault.help.len() < 600, "{fault}");
    }
}

#[test]
fn endless_units_are_refused() {
    let many = |unit: &str, n: usize| unit.repeat(n).trim_end_matches('*').to_owned();
    // π to the power of -128, and its inverse, which exceeds an i8.
    let turns = many("rad/turn*", 128);
    for text in
        [format!("1/({turns})"), format!("1*{turns}/turn"), format!("1 {}", many("h/s*", 6))]
    {
        let fault = evaluate(&text).unwrap_err();
        assert!(fault.message.contains("exponent of the unit is too high"), "{text}: {fault}");
    }
    assert_eq!(value(&format!("5e-451 {}", many("km/m*", 150))), 0.5);
}

#[test]
fn words_are_what_could_be_names() {
    let found: Vec<_> = words("2e3*L_1 + 5mm/ω - 2.5e x2 (é)²").collect();
    assert_eq!(found, ["L_1", "mm", "ω", "e", "x2", "é"]);
    for name in ["L", "_", "k_1", "ω", "leg2", "nanometre"] {
        assert_eq!(check_name(name), Ok(()), "{name}");
    }
    for name in ["", "1a", "a-b", "a b", "a.b", "k²", "inf", "nan", "a°"] {
        assert_eq!(check_name(name), Err(NameFault::NoWord), "{name}");
    }
    assert_eq!(check_name("pi"), Err(NameFault::Constant));
}
