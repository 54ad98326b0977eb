//! Texts of numbers, units and names, and the arithmetic between them.
//!
//! `(text, names) => quantity, or a fault with its position`. One pass from left to right:
//!
//! ```text
//! sum     = product (("+" | "-") product)*
//! product = factor (("*" | "/") factor)*
//! factor  = ("+" | "-")* value power?
//! value   = number unit? | unit | name | function? "(" sum ")"
//! unit    = name of a unit power?
//! power   = ("^" whole number) | raised digits
//! ```
//!
//! `·`, `×` and a point between units are `*`, `÷` is `/`, `−` is `-`.

use std::ops::Range;

use crate::quantity::decimal::Decimal;
use crate::quantity::dimension::Dimension;
use crate::quantity::fault::Fault;
use crate::quantity::function::{self, Function};
use crate::quantity::operand::{Operand, Worth};
use crate::quantity::scope::Scope;
use crate::quantity::unit::{self, Scale, Unit};
use crate::quantity::word::{begins_word, word};
use crate::quantity::{Quantity, scope};
use crate::shortened::shortened;

/// Deepest nesting of brackets; far below the limit of a thread's smallest stack.
const DEEPEST: usize = 32;

/// Largest exponent of a unit.
const HIGHEST: u64 = 9;

/// The value of a text with the names of a scope.
pub(crate) fn within(text: &str, scope: Option<&Scope>) -> Result<Quantity, Fault> {
    let mut parser = Parser { text, place: 0, scope, depth: 0, has_number: false };
    let found = parser.sum()?;
    if let Some(left) = parser.next() {
        return Err(match left {
            ')' => parser.fault(1, "unmatched `)`", "add the missing `(` or remove this `)`"),
            _ => parser.unexpected(left),
        });
    }
    if !parser.has_number {
        let help = format!("add a number: \"1 {}\"", shortened(text.trim()));
        return Err(Fault::new(found.place, "unit without a number", help));
    }
    let value = found.value();
    if !value.is_finite() {
        return Err(Fault::too_large(found.place));
    }
    Ok(Quantity { value, dimension: found.dimension })
}

struct Parser<'t> {
    text: &'t str,
    place: usize,
    scope: Option<&'t Scope>,
    /// Open brackets.
    depth: usize,
    /// Whether there was anything but units.
    has_number: bool,
}

impl<'t> Parser<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.place..]
    }

    /// The next character that is not blank.
    fn next(&mut self) -> Option<char> {
        let rest = self.rest();
        self.place += rest.len() - rest.trim_start().len();
        self.rest().chars().next()
    }

    /// A fault of the given number of bytes from here on.
    fn fault(&self, length: usize, message: impl Into<String>, help: impl Into<String>) -> Fault {
        Fault::new(self.place..self.place + length, message, help)
    }

    /// The fault of an unexpected character.
    fn unexpected(&self, found: char) -> Fault {
        let length = found.len_utf8();
        match found {
            ',' => self.fault(length, "comma in a number", "use a decimal point: 0.5"),
            '^' | '²' | '³' => {
                let help = "put the base in brackets: (L^2)^3, (5 mm^2)^2";
                self.fault(length, "a power of a power is ambiguous", help)
            }
            _ => {
                let message = format!("unexpected `{found}` in a value");
                self.fault(
                    length,
                    message,
                    "expected numbers, units, names of [parameters], + - * \
                                             / ( )",
                )
            }
        }
    }

    fn sum(&mut self) -> Result<Operand<'t>, Fault> {
        let mut sum = self.product()?;
        loop {
            let subtracted = match self.next() {
                Some('+') => false,
                Some('-' | '−') => true,
                _ => return Ok(sum),
            };
            self.skip();
            let right = self.product()?;
            sum = sum.plus(right, subtracted)?;
        }
    }

    fn product(&mut self) -> Result<Operand<'t>, Fault> {
        let mut product = self.factor()?;
        loop {
            let divided = match self.next() {
                Some('*' | '·' | '⋅' | '×') => false,
                Some('/' | '÷') => true,
                Some('.') if self.rest()[1..].starts_with(begins_word) => false,
                Some(c) if begins_word(c) || c == '(' || Decimal::begins(self.rest()).is_some() => {
                    return Err(self.no_sign(&product));
                }
                _ => return Ok(product),
            };
            self.skip();
            let right = self.factor()?;
            if divided && product.dimension.is_none() && right.has_unit() {
                return Err(self.two_ways(&product, &right));
            }
            product = product.times(right, divided)?;
        }
    }

    /// The fault of `1 / 2 mm`, which may mean half a millimetre or 500 1/m.
    fn two_ways(&self, left: &Operand<'_>, right: &Operand<'_>) -> Fault {
        let text = |place: Range<usize>| shortened(&self.text[place]).into_owned();
        let place = left.place.start..right.place.end;
        let divided = text(right.place.clone());
        let before = text(place.start..right.place.start);
        let unit = divided.trim_start_matches(|c: char| !begins_word(c) || "eE".contains(c));
        let number = divided[..divided.len() - unit.len()].trim_end();
        let message = format!("`{}` is ambiguous", text(place.clone()));
        Fault::new(place, message, format!("use {before}({divided}) or {before}{number} * {unit}"))
    }

    /// The fault of two operands without an operator between them.
    fn no_sign(&self, left: &Operand<'_>) -> Fault {
        let rest = self.rest();
        let length = match Decimal::begins(rest) {
            Some((_, length)) => length,
            None => word(rest).len().max(1),
        };
        let right = &rest[..length];
        if begins_word(right.chars().next().unwrap_or(' ')) && self.known(right).is_none() {
            return self.unknown(right);
        }
        let left = shortened(self.text[left.place.clone()].trim()).into_owned();
        let message = format!("missing operator between `{left}` and `{}`", shortened(right));
        let help = match right {
            "(" => format!("add `*`: {left} * ("),
            _ => format!("add `*`: {left} * {}", shortened(right)),
        };
        self.fault(length, message, help)
    }

    fn factor(&mut self) -> Result<Operand<'t>, Fault> {
        let mut start = None;
        let mut is_negative = false;
        while let Some(sign @ ('+' | '-' | '−')) = self.next() {
            start = start.or(Some(self.place));
            is_negative ^= sign != '+';
            self.skip();
        }
        let operand = self.raised()?;
        let place = start.unwrap_or(operand.place.start)..operand.place.end;
        let operand = Operand { place, ..operand };
        Ok(if is_negative { operand.negated() } else { operand })
    }

    /// A value with its exponent, if any; a unit has already read its own.
    fn raised(&mut self) -> Result<Operand<'t>, Fault> {
        let base = self.atom()?;
        if base.is_bare && matches!(base.worth, Worth::Unit(_)) || base.has_unit() {
            return Ok(base);
        }
        let start = self.place;
        let (is_negative, size, length) = power(self.rest());
        if length == 0 {
            return Ok(base);
        }
        match size.filter(|size| (1..=function::HIGHEST).contains(size)) {
            Some(size) => {
                self.place += length;
                let size = size as i8;
                function::power(base, if is_negative { -size } else { size }, self.place)
            }
            None => {
                let help = format!(
                    "use a whole exponent from 1 to {0} or -1 to -{0}: L^2; for a root use sqrt(A)",
                    function::HIGHEST
                );
                let place = base.place.start..start + length;
                Err(Fault::new(place, "invalid exponent of a value", help))
            }
        }
    }

    fn atom(&mut self) -> Result<Operand<'t>, Fault> {
        let Some(first) = self.next() else {
            let before = self.text.trim_end().len();
            let message = if before == 0 { "empty value" } else { "missing number or name" };
            return Err(Fault::new(before..before, message, "e.g. \"30 deg\", \"2 * L + 5 mm\""));
        };
        let start = self.place;
        if let Some((number, length)) = Decimal::begins(self.rest()) {
            self.place += length;
            self.has_number = true;
            return self.measured(number, start);
        }
        if first == '(' {
            return self.bracket();
        }
        if !begins_word(first) {
            return Err(match first {
                ')' | '*' | '/' => self.fault(
                    1,
                    format!("missing number or name before `{first}`"),
                    "e.g. (2 * L) / 3",
                ),
                _ => self.unexpected(first),
            });
        }
        let word = word(self.rest());
        match self.known(word) {
            Some(Known::Unit(unit)) => {
                let (scale, dimension) = self.unit(unit)?;
                let place = start..self.place;
                Ok(Operand { worth: Worth::Unit(scale), dimension, place, is_bare: true })
            }
            Some(Known::Name(quantity)) => {
                self.place += word.len();
                self.has_number = true;
                let worth = Worth::Computed(quantity.value);
                let (dimension, place) = (quantity.dimension, start..self.place);
                Ok(Operand { worth, dimension, place, is_bare: true })
            }
            Some(Known::Function(function)) => {
                self.place += word.len();
                self.has_number = true;
                if self.next() != Some('(') {
                    let message = format!("missing argument of function `{word}`");
                    let help = format!("give the argument in brackets: {word}(…)");
                    return Err(Fault::new(start..start + word.len(), message, help));
                }
                let argument = self.bracket()?;
                let place = start..self.place;
                Ok(Operand { place, ..function.of(argument)? })
            }
            None => Err(self.unknown(word)),
        }
    }

    /// A number with its unit, if any.
    fn measured(&mut self, number: Decimal<'t>, start: usize) -> Result<Operand<'t>, Fault> {
        let (mut scale, mut dimension, mut end) = (Scale::ONE, Dimension::default(), self.place);
        if self.next().is_some_and(begins_word) {
            let word = word(self.rest());
            match self.known(word) {
                Some(Known::Unit(unit)) => {
                    (scale, dimension) = self.unit(unit)?;
                    end = self.place;
                }
                // The product reports the missing operator.
                Some(Known::Name(_) | Known::Function(_)) => {}
                None => return Err(self.unknown(word)),
            }
        }
        let worth = Worth::Written { number, scale, is_negative: false };
        Ok(Operand { worth, dimension, place: start..end, is_bare: true })
    }

    fn bracket(&mut self) -> Result<Operand<'t>, Fault> {
        let start = self.place;
        if self.depth == DEEPEST {
            let message = format!("brackets are nested more than {DEEPEST} deep");
            return Err(self.fault(1, message, "move a part of it to [parameters]"));
        }
        self.depth += 1;
        self.skip();
        let inner = self.sum()?;
        match self.next() {
            Some(')') => self.skip(),
            None => return Err(Fault::new(start..start + 1, "unclosed `(`", "add `)`")),
            Some(found) => return Err(self.unexpected(found)),
        }
        self.depth -= 1;
        // A unit in brackets remains a unit: N·m/(s²·rad).
        Ok(Operand { place: start..self.place, is_bare: false, ..inner })
    }

    /// A unit with its exponent.
    fn unit(&mut self, unit: &'static Unit) -> Result<(Scale, Dimension), Fault> {
        let start = self.place;
        self.place += unit.name.len();
        let (is_negative, size, length) = power(self.rest());
        let power = match size {
            _ if length == 0 => Some(1),
            Some(0) | None => None,
            Some(size) if size > HIGHEST => None,
            Some(size) => Some(size),
        };
        let beyond = || {
            let help = format!("use a whole exponent from 1 to {HIGHEST}: m^2, s^-1");
            Fault::new(start..self.place + length, "invalid exponent of a unit", help)
        };
        let power = power.ok_or_else(beyond)?;
        let (mut scale, mut dimension) = (Scale::ONE, Dimension::default());
        for _ in 0..power {
            scale = scale.times(unit.scale, is_negative).ok_or_else(beyond)?;
            let sign = if is_negative { -1 } else { 1 };
            dimension = dimension.times(unit.dimension, sign).ok_or_else(beyond)?;
        }
        self.place += length;
        Ok((scale, dimension))
    }

    /// The meaning of a word.
    fn known(&self, word: &str) -> Option<Known> {
        let is_hidden = unit::HIDDEN.contains(&word)
            && self.scope.is_some_and(|scope| scope.row(word).is_some());
        if let (false, Some(unit)) = (is_hidden, unit::find(word)) {
            return Some(Known::Unit(unit));
        }
        if word == scope::PI.0 {
            let value = scope::PI.1;
            return Some(Known::Name(Quantity { value, dimension: Dimension::default() }));
        }
        let named = self.scope.and_then(|scope| scope.get(word)).map(Known::Name);
        named.or_else(|| function::find(word).map(Known::Function))
    }

    /// The fault of an unknown word.
    fn unknown(&self, word: &str) -> Fault {
        let shown = shortened(word);
        let Some(scope) = self.scope else {
            let help = Scope::default().help(word);
            return self.fault(word.len(), format!("unknown unit `{shown}`"), help);
        };
        let message = format!("`{shown}` is neither a unit nor one of [parameters]");
        self.fault(word.len(), message, scope.help(word))
    }

    fn skip(&mut self) {
        self.place += self.rest().chars().next().map_or(0, char::len_utf8);
    }
}

/// The meaning of a word.
enum Known {
    Unit(&'static Unit),
    Name(Quantity),
    Function(Function),
}

/// The exponent at the beginning of a text: whether it is negative, its magnitude (`None` if not a number), and its
/// length in bytes, 0 without an exponent.
fn power(text: &str) -> (bool, Option<u64>, usize) {
    let blank = text.len() - text.trim_start().len();
    let Some(power) = text[blank..].strip_prefix('^') else { return raised(text) };
    let sign = usize::from(power.starts_with(['+', '-']));
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(&power[sign..]);
    let fraction = power[sign + whole..].strip_prefix('.').map_or(0, digits);
    let size = if fraction == 0 { power[sign..sign + whole].parse().ok() } else { None };
    let length = sign + whole + if fraction == 0 { 0 } else { 1 + fraction };
    (power.starts_with('-'), size, blank + 1 + length)
}

/// The same for superscript digits.
fn raised(text: &str) -> (bool, Option<u64>, usize) {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let unsigned = text.strip_prefix('⁻').unwrap_or(text);
    let (mut size, mut length) = (0_u64, 0);
    for c in unsigned.chars() {
        let Some(digit) = DIGITS.iter().position(|raised| *raised == c) else { break };
        size = size.saturating_mul(10).saturating_add(digit as u64);
        length += c.len_utf8();
    }
    let sign = text.len() - unsigned.len();
    match length {
        0 if sign == 0 => (false, None, 0),
        0 => (true, None, sign),
        _ => (sign > 0, Some(size), sign + length),
    }
}
