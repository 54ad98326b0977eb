//! Numbers from bytes: mostly those of a mechanism, at times those at the ends of what a number can
//! hold.

use arbitrary::Unstructured;

/// Where arithmetic has its edges.
pub const EDGES: [f64; 28] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::EPSILON,
    f64::MIN_POSITIVE,
    5e-324,
    f64::MAX,
    f64::MIN,
    1e308,
    1e300,
    1e155,
    1e154,
    1e-154,
    1e-155,
    1e-300,
    3.402_823_5e38,
    3.5e38,
    1e19,
    1.4e-45,
    1.2e-38,
    1e-46,
    1.8e19,
    4_294_967_296.0,
    9_223_372_036_854_775_808.0,
    18_446_744_073_709_551_616.0,
    std::f64::consts::PI,
    std::f64::consts::FRAC_PI_2,
];

/// How far from a mechanism's the numbers of one input lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wildness {
    /// Of order 1.
    Tame,
    /// Now and then of any order.
    Mixed,
    /// At the edges.
    Wild,
}

impl Wildness {
    /// One of the three.
    pub fn of(bytes: &mut Unstructured<'_>) -> Self {
        match byte(bytes) % 4 {
            0 | 1 => Self::Tame,
            2 => Self::Mixed,
            _ => Self::Wild,
        }
    }
}

/// The next byte; 0 beyond the end.
pub fn byte(bytes: &mut Unstructured<'_>) -> u8 {
    bytes.arbitrary().unwrap_or(0)
}

/// Whether the next byte is one of so many.
pub fn one_in(bytes: &mut Unstructured<'_>, n: u8) -> bool {
    byte(bytes).is_multiple_of(n)
}

/// A number below `n`, which is at most 256.
pub fn below(bytes: &mut Unstructured<'_>, n: usize) -> usize {
    usize::from(byte(bytes)) % n.max(1)
}

fn short(bytes: &mut Unstructured<'_>) -> f64 {
    f64::from(bytes.arbitrary::<i16>().unwrap_or(0)) / 32768.0
}

/// A number of any sign. Not finite only where the input is wild, and then seldom.
pub fn number(bytes: &mut Unstructured<'_>, wildness: Wildness) -> f64 {
    let class = byte(bytes);
    let edge = match wildness {
        Wildness::Tame => 0,
        Wildness::Mixed => 20,
        Wildness::Wild => 120,
    };
    if class < edge {
        return match class % 8 {
            // Any bits.
            0 => f64::from_bits(bytes.arbitrary().unwrap_or(0)),
            // Any order.
            1..=3 => short(bytes) * power_of_ten(i32::from(byte(bytes) as i8) * 5 / 2),
            _ => {
                let edge = EDGES[below(bytes, EDGES.len())];
                if one_in(bytes, 2) { edge } else { -edge }
            }
        };
    }
    match class % 8 {
        0 => 0.0,
        1 => f64::from(byte(bytes) as i8),
        2 if wildness != Wildness::Tame => {
            short(bytes) * power_of_ten(i32::from(byte(bytes) as i8) / 8)
        }
        _ => 2.0 * short(bytes),
    }
}

fn power_of_ten(exponent: i32) -> f64 {
    10.0_f64.powi(exponent)
}

/// A number that is not negative.
pub fn size(bytes: &mut Unstructured<'_>, wildness: Wildness) -> f64 {
    number(bytes, wildness).abs()
}

/// A number above 0 where it is tame: what a mass is.
pub fn amount(bytes: &mut Unstructured<'_>, wildness: Wildness) -> f64 {
    let size = size(bytes, wildness);
    if wildness == Wildness::Tame { 0.01 + size } else { size }
}

/// Three numbers.
pub fn triple(bytes: &mut Unstructured<'_>, wildness: Wildness) -> [f64; 3] {
    std::array::from_fn(|_| number(bytes, wildness))
}
