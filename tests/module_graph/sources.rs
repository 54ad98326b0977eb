//! Which module of a crate uses which, read from its sources.
//!
//! `lib.rs, of a program main.rs, and what its mod lines reach => modules, arrows`. A path that begins with `crate`, `super`,
//! `self` or a module of the same file is an arrow, in `use` lines, code and macros alike; comments,
//! strings and what is compiled for tests alone are not read. A name that a module takes in or
//! hands on stands for the module that defines it. A `pub use` of what lies in the module's own
//! folder hands on and is no arrow.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Attribute, Item, UseTree, Visibility};

/// A path of names within a crate, from its root.
pub type Names = Vec<String>;

/// The text of a file of the crate by its path below `src`, `None` where there is none.
pub type Files<'f> = &'f dyn Fn(&str) -> Option<String>;

/// The modules of one crate and their arrows.
#[derive(Default)]
pub struct Sources {
    /// The documentation of `lib.rs`.
    pub doc: String,
    /// Each module, the root too, with its file below `src`.
    pub modules: BTreeMap<Names, String>,
    /// From a module to one that it uses, with the first path that says so.
    pub arrows: BTreeMap<(Names, Names), String>,
    /// What a module takes in under a name: an absolute path.
    imports: BTreeMap<Names, BTreeMap<String, Names>>,
    /// From a module to an absolute path, not yet followed to where its end is defined.
    paths: BTreeSet<(Names, Names)>,
}

impl Sources {
    /// Reads the crate in a folder.
    pub fn of_crate(folder: &Path) -> Self {
        Self::read(&|file| std::fs::read_to_string(folder.join("src").join(file)).ok())
    }

    /// Reads a crate.
    ///
    /// # Panics
    /// Where a file is missing or is no Rust.
    pub fn read(files: Files<'_>) -> Self {
        let mut sources = Self::default();
        let root = if files("lib.rs").is_some() { "lib.rs" } else { "main.rs" };
        sources.file(files, Vec::new(), root.into(), "");
        for (from, path) in std::mem::take(&mut sources.paths) {
            let to = sources.defined_in(&path, 0);
            // A folder's module and what lies in it are told apart, the root and all below it too.
            if from != to {
                sources.arrows.entry((from, to)).or_insert_with(|| path.join("::"));
            }
        }
        sources
    }

    /// Reads a module's file; those of its own modules lie in `folder`.
    fn file(&mut self, files: Files<'_>, module: Names, path: String, folder: &str) {
        let text = files(&path).unwrap_or_else(|| panic!("{path} is missing"));
        let syntax = syn::parse_file(&text).unwrap_or_else(|error| panic!("{path}: {error}"));
        if module.is_empty() {
            self.doc = syntax.attrs.iter().filter_map(doc_line).collect();
        }
        self.modules.insert(module.clone(), path);
        self.items(files, &module, &module, &syntax.items, folder);
    }

    /// Reads items that stand in `at`, an inline module or `module` itself.
    fn items(
        &mut self,
        files: Files<'_>,
        module: &Names,
        at: &Names,
        items: &[Item],
        folder: &str,
    ) {
        let mut own = BTreeSet::new();
        for item in items.iter().filter(|item| !for_tests_alone(item)) {
            let Item::Mod(child) = item else { continue };
            let name = child.ident.to_string();
            let within = [&at[..], std::slice::from_ref(&name)].concat();
            own.insert(name.clone());
            // A file of elsewhere uses what any user does.
            if child.attrs.iter().any(|attribute| attribute.path().is_ident("path")) {
                continue;
            }
            if let Some((_, items)) = &child.content {
                self.items(files, module, &within, items, &format!("{folder}{name}/"));
            } else {
                let beside = format!("{folder}{name}.rs");
                let inside = format!("{folder}{name}/mod.rs");
                let path = if files(&beside).is_some() { beside } else { inside };
                self.file(files, within, path, &format!("{folder}{name}/"));
            }
        }
        for item in items.iter().filter(|item| !for_tests_alone(item)) {
            match item {
                Item::Mod(_) => {}
                // An exported macro is known by its name at the root.
                Item::Macro(line)
                    if line
                        .attrs
                        .iter()
                        .any(|attribute| attribute.path().is_ident("macro_export")) =>
                {
                    if let Some(name) = line.ident.as_ref().map(ToString::to_string) {
                        let path = [&module[..], std::slice::from_ref(&name)].concat();
                        self.imports.entry(Names::new()).or_default().insert(name, path);
                    }
                }
                Item::Use(line) => {
                    let mut taken = Vec::new();
                    flatten(&line.tree, &mut Vec::new(), &mut taken);
                    for (name, path) in taken {
                        let Some(path) = absolute(&path, at, &own) else { continue };
                        let handed_on = !matches!(line.vis, Visibility::Inherited);
                        if !(handed_on && path.len() > at.len() && path.starts_with(at)) {
                            self.paths.insert((module.clone(), path.clone()));
                        }
                        self.imports.entry(at.clone()).or_default().insert(name, path);
                    }
                }
                other => {
                    let mut found = Vec::new();
                    paths_in(other.to_token_stream(), &own, &mut found);
                    let absolute = |path: Names| absolute(&path, at, &own);
                    let found = found.into_iter().filter_map(absolute);
                    self.paths.extend(found.map(|path| (module.clone(), path)));
                }
            }
        }
    }

    /// The module that defines the end of an absolute path.
    fn defined_in(&self, path: &[String], followed: usize) -> Names {
        let mut module = Names::new();
        for (i, name) in path.iter().enumerate() {
            let next = [&module[..], std::slice::from_ref(name)].concat();
            if self.modules.contains_key(&next) {
                module = next;
                continue;
            }
            let import = self.imports.get(&module).and_then(|names| names.get(name));
            return match import {
                Some(import) if followed < 16 => {
                    let whole = [&import[..], &path[i + 1..]].concat();
                    self.defined_in(&whole, followed + 1)
                }
                _ => module,
            };
        }
        module
    }
}

/// A line of documentation.
fn doc_line(attribute: &Attribute) -> Option<String> {
    let syn::Meta::NameValue(pair) = &attribute.meta else { return None };
    let syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) = &pair.value else {
        return None;
    };
    pair.path.is_ident("doc").then(|| text.value() + "\n")
}

/// Whether an item is compiled for tests alone.
fn for_tests_alone(item: &Item) -> bool {
    let attributes = match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::ExternCrate(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => return false,
    };
    attributes.iter().any(|attribute| {
        let syn::Meta::List(list) = &attribute.meta else { return false };
        let words = list.tokens.to_string();
        attribute.path().is_ident("cfg")
            && !words.contains("not")
            && words.split(|c: char| !c.is_alphanumeric()).any(|word| word == "test")
    })
}

/// The names that a `use` takes in, each with its path as it is written.
fn flatten(tree: &UseTree, before: &mut Names, taken: &mut Vec<(String, Names)>) {
    let mut take = |name: String, last: Option<String>| {
        taken.push((name, before.iter().cloned().chain(last).collect()));
    };
    match tree {
        UseTree::Path(path) => {
            before.push(path.ident.to_string());
            flatten(&path.tree, before, taken);
            before.pop();
        }
        UseTree::Name(name) if name.ident == "self" => {
            take(before.last().cloned().unwrap_or_default(), None);
        }
        UseTree::Name(name) => take(name.ident.to_string(), Some(name.ident.to_string())),
        UseTree::Rename(name) => take(name.rename.to_string(), Some(name.ident.to_string())),
        UseTree::Glob(_) => take("*".into(), None),
        UseTree::Group(group) => {
            for tree in &group.items {
                flatten(tree, before, taken);
            }
        }
    }
}

/// A path from the crate's root, `None` where it leads out of the crate. It stands in the module
/// `at`, which declares the modules `own`.
fn absolute(path: &[String], at: &Names, own: &BTreeSet<String>) -> Option<Names> {
    let mut base = at.clone();
    let mut rest = path;
    match path.first()?.as_str() {
        "crate" => {
            base.clear();
            rest = &path[1..];
        }
        "self" => rest = &path[1..],
        "super" => {}
        first if own.contains(first) => {}
        _ => return None,
    }
    while let Some("super") = rest.first().map(String::as_str) {
        base.pop();
        rest = &rest[1..];
    }
    base.extend(rest.iter().cloned());
    Some(base)
}

/// All paths in code that begin within the crate.
fn paths_in(tokens: TokenStream, own: &BTreeSet<String>, found: &mut Vec<Names>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let colons = |i: usize| {
        let colon = |i| matches!(tokens.get(i), Some(TokenTree::Punct(p)) if p.as_char() == ':');
        colon(i) && colon(i + 1)
    };
    for (i, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Group(group) => paths_in(group.stream(), own, found),
            TokenTree::Ident(first) if colons(i + 1) => {
                let first = first.to_string();
                let begins = matches!(first.as_str(), "crate" | "super" | "self");
                let goes_on = i >= 2 && colons(i - 2);
                // `pub(in path)` says who may see, not what is used.
                let seen_by = i >= 1 && tokens[i - 1].to_string() == "in" && tokens.len() <= 8;
                if (begins || own.contains(&first)) && !goes_on && !seen_by {
                    rest_of(&tokens[i + 1..], vec![first], found);
                }
            }
            _ => {}
        }
    }
}

/// The paths that go on with `::` and a name or a group of them.
fn rest_of(tokens: &[TokenTree], mut path: Names, found: &mut Vec<Names>) {
    let mut tokens = tokens;
    while let [TokenTree::Punct(a), TokenTree::Punct(b), next, rest @ ..] = tokens {
        if a.as_char() != ':' || b.as_char() != ':' {
            break;
        }
        match next {
            TokenTree::Ident(name) => path.push(name.to_string()),
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                let comma = |t: &TokenTree| matches!(t, TokenTree::Punct(p) if p.as_char() == ',');
                for part in inner.split(comma).filter(|part| !part.is_empty()) {
                    let mut path = path.clone();
                    path.push(part[0].to_string());
                    rest_of(&part[1..], path, found);
                }
                return;
            }
            _ => break,
        }
        tokens = rest;
    }
    found.push(path);
}
