//! Every public number says its unit.
//!
//! `kernel, scene, plant, golden, node: sources => nothing, where the comment of every public field that
//! holds numbers has a unit in brackets`. What has none says \[1\].

use std::fs;
use std::path::{Path, PathBuf};

use dbd_tests::results::path;
use quote::ToTokens as _;
use syn::visit::{Visit, visit_field};
use syn::{Expr, ExprLit, Field, GenericArgument, Lit, Meta, PathArguments, Type, Visibility};

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

/// The comment of a field.
fn comment(field: &Field) -> String {
    let lines = field.attrs.iter().filter_map(|attribute| {
        let Meta::NameValue(pair) = &attribute.meta else { return None };
        let Expr::Lit(ExprLit { lit: Lit::Str(text), .. }) = &pair.value else { return None };
        pair.path.is_ident("doc").then(|| text.value())
    });
    lines.collect()
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
            let comment = comment(field);
            if !(comment.contains("\\[") && comment.contains("\\]")) {
                let name = field.ident.as_ref().map_or_else(String::new, ToString::to_string);
                self.without.push(format!("{name}: {}", field.ty.to_token_stream()));
            }
        }
        visit_field(self, field);
    }
}

fn sources(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap().path();
        if entry.is_dir() {
            sources(&entry, files);
        } else if entry.extension().is_some_and(|extension| extension == "rs") {
            files.push(entry);
        }
    }
}

#[test]
fn every_public_number_has_a_unit() {
    let (mut all, mut wrong) = (0, Vec::new());
    for name in CRATES {
        let mut files = Vec::new();
        sources(&path(name).join("src"), &mut files);
        for file in files {
            if ANY_UNIT.iter().any(|end| file.ends_with(end)) {
                continue;
            }
            let mut fields = Fields::default();
            fields.visit_file(&syn::parse_file(&fs::read_to_string(&file).unwrap()).unwrap());
            all += fields.all;
            wrong.extend(fields.without.iter().map(|field| format!("{}: {field}", file.display())));
        }
    }
    assert!(wrong.is_empty(), "{} of {all} have no unit:\n{}", wrong.len(), wrong.join("\n"));
    assert!(all > 100, "{all}");
}
