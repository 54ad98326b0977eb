//! Every public number says its unit.
//!
//! `kernel, scene, plant, golden, node: sources => nothing, where the comment of every public field that
//! holds numbers has a unit in brackets`. What has none says \[1\].

use quote::ToTokens as _;
use syn::visit::{Visit, visit_field};
use syn::{Field, GenericArgument, PathArguments, Type, Visibility};

use crate::words::sources::{documentation, sources_below};

/// Crates whose types users meet.
const CRATES: [&str; 5] =
    ["kernel", "crates/scene", "crates/plant", "crates/golden", "crates/node"];
/// Files whose types are numbers of any unit: vectors, constants of arithmetic, a precision.
const ANY_UNIT: [&str; 4] = [
    "kernel/src/vector.rs",
    "kernel/src/plane.rs",
    "kernel/src/real.rs",
    "kernel/src/approximate.rs",
];
/// What a number is called in the sources.
const NUMBERS: [&str; 5] = ["f64", "f32", "R", "Real", "Local"];
/// What holds numbers of one unit.
const HOLDERS: [&str; 5] = ["Vec3", "Quaternion", "Option", "Vec", "RealOf"];

/// Whether a type is numbers and nothing else.
fn holds_numbers(of: &Type) -> bool {
    match of {
        Type::Array(array) => holds_numbers(&array.elem),
        Type::Slice(slice) => holds_numbers(&slice.elem),
        Type::Reference(reference) => holds_numbers(&reference.elem),
        Type::Tuple(tuple) => !tuple.elems.is_empty() && tuple.elems.iter().all(holds_numbers),
        Type::Path(named) => {
            let Some(last) = named.path.segments.last() else { return false };
            let name = last.ident.to_string();
            if NUMBERS.contains(&name.as_str()) {
                return true;
            }
            let PathArguments::AngleBracketed(inner) = &last.arguments else { return false };
            let mut types = inner.args.iter().filter_map(|argument| match argument {
                GenericArgument::Type(of) => Some(of),
                _ => None,
            });
            HOLDERS.contains(&name.as_str()) && types.any(holds_numbers)
        }
        _ => false,
    }
}

/// The public fields of a file that hold numbers: how many, and those without a unit.
#[derive(Default)]
struct Fields {
    all: usize,
    without: Vec<String>,
}

impl<'s> Visit<'s> for Fields {
    fn visit_field(&mut self, field: &'s Field) {
        if matches!(field.vis, Visibility::Public(_)) && holds_numbers(&field.ty) {
            self.all += 1;
            let comment = documentation(&field.attrs);
            if !(comment.contains("\\[") && comment.contains("\\]")) {
                let name = field.ident.as_ref().map_or_else(String::new, ToString::to_string);
                self.without.push(format!("{name}: {}", field.ty.to_token_stream()));
            }
        }
        visit_field(self, field);
    }
}

#[test]
fn every_public_number_has_a_unit() {
    let (mut all, mut wrong) = (0, Vec::new());
    for name in CRATES {
        for (file, text) in sources_below(&format!("{name}/src")) {
            if ANY_UNIT.contains(&file.as_str()) {
                continue;
            }
            let mut fields = Fields::default();
            fields.visit_file(&syn::parse_file(&text).unwrap());
            all += fields.all;
            wrong.extend(fields.without.iter().map(|field| format!("{file}: {field}")));
        }
    }
    assert!(wrong.is_empty(), "{} of {all} have no unit:\n{}", wrong.len(), wrong.join("\n"));
    assert!(all > 100, "{all}");
}
