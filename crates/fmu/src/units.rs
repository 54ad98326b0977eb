//! SI units in terms of base units.
//!
//! `N·m·s/rad => name N.m.s/rad, exponents of kg, m, s, A, rad`: the name in Modelica's notation, which importers read.

/// The base units used, as attributes of FMI's `BaseUnit`.
pub const BASE: [&str; 5] = ["kg", "m", "s", "A", "rad"];

/// A unit's name in Modelica's notation.
#[must_use]
pub fn modelica(unit: &str) -> String {
    unit.replace('·', ".").replace('²', "2").replace('³', "3")
}

/// A unit's exponents of [`BASE`]; `None` if it contains another unit.
#[must_use]
pub fn exponents(unit: &str) -> Option<[i32; 5]> {
    let mut sum = [0; 5];
    for (side, part) in unit.split('/').enumerate() {
        let sign = if side == 0 { 1 } else { -1 };
        for factor in part.split('·') {
            let (name, power) = match factor.strip_suffix('²') {
                Some(name) => (name, 2),
                None => factor.strip_suffix('³').map_or((factor, 1), |name| (name, 3)),
            };
            let of_base = match name {
                "kg" => [1, 0, 0, 0, 0],
                "m" => [0, 1, 0, 0, 0],
                "s" => [0, 0, 1, 0, 0],
                "rad" => [0, 0, 0, 0, 1],
                "Hz" => [0, 0, -1, 0, 0],
                "N" => [1, 1, -2, 0, 0],
                "J" => [1, 2, -2, 0, 0],
                "W" => [1, 2, -3, 0, 0],
                "Pa" => [1, -1, -2, 0, 0],
                "A" => [0, 0, 0, 1, 0],
                "V" => [1, 2, -3, -1, 0],
                "ohm" => [1, 2, -3, -2, 0],
                "H" => [1, 2, -2, -2, 0],
                "1" => [0; 5],
                _ => return None,
            };
            for (sum, exponent) in sum.iter_mut().zip(of_base) {
                *sum += sign * power * exponent;
            }
        }
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::{exponents, modelica};

    #[test]
    fn units_are_products_of_base_units() {
        assert_eq!(exponents("N·m·s/rad"), Some([1, 2, -1, 0, -1]));
        assert_eq!(exponents("kg·m²"), Some([1, 2, 0, 0, 0]));
        assert_eq!(exponents("m/s²"), Some([0, 1, -2, 0, 0]));
        // A volt is a newton metre per second and ampere, so a motor's back-EMF and torque constants are equal.
        assert_eq!(exponents("V"), exponents("N·m/s/A"));
        assert_eq!(exponents("V·s"), exponents("N·m/A"));
        assert_eq!(exponents("furlong"), None);
        assert_eq!(modelica("kg·m²"), "kg.m2");
    }
}
