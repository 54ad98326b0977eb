//! Every message of the project in one file, to be read as a whole.
//!
//! `sources => docs/validation/messages.txt`. A message is a text of three words and more in an attribute `error`,
//! `diagnostic` or `help`, in a macro that writes or formats, in an expression, or in the documentation of what `clap`
//! derives, which is its help; texts of panics, assertions and tests
//! are none, nor is what is written in another language (HTML, SVG, C, Rust, TOML). Placeholders stay as they are.

use std::fmt::Write as _;

use dbd_tests::page;
use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};

use crate::words::sources::{documentation, sources};

/// Macros whose texts are for developers.
const FOR_DEVELOPERS: [&str; 11] = [
    "assert",
    "assert_eq",
    "assert_ne",
    "debug_assert",
    "debug_assert_eq",
    "panic",
    "todo",
    "unimplemented",
    "unreachable",
    "cfg",
    "include_str",
];

/// Methods whose texts are for developers.
const OF_DEVELOPERS: [&str; 2] = ["expect", "expect_err"];

/// The messages of one file, in its order.
#[derive(Default)]
struct Messages(Vec<String>);

impl Messages {
    fn text(&mut self, text: &str) {
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        if is_message(&text) && !self.0.contains(&text) {
            self.0.push(text);
        }
    }

    fn tokens(&mut self, tokens: TokenStream) {
        for token in tokens {
            match token {
                TokenTree::Group(group) => self.tokens(group.stream()),
                TokenTree::Literal(literal) => {
                    if let Ok(text) = syn::parse_str::<syn::LitStr>(&literal.to_string()) {
                        self.text(&text.value());
                    }
                }
                TokenTree::Ident(_) | TokenTree::Punct(_) => {}
            }
        }
    }
}

fn is_of_tests(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        syn::Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string() == "test",
        _ => false,
    })
}

/// What `clap` derives, with its help in the documentation.
const OF_CLAP: [&str; 4] = ["Args", "Parser", "Subcommand", "ValueEnum"];

fn is_of_clap(attributes: &[syn::Attribute]) -> bool {
    let derives = attributes.iter().filter(|attribute| attribute.path().is_ident("derive"));
    derives.filter_map(|derive| derive.meta.require_list().ok()).any(|list| {
        let mut names = list.tokens.to_string();
        names.retain(|c| !c.is_whitespace());
        names.split(',').any(|name| OF_CLAP.contains(&name))
    })
}

impl<'s> Visit<'s> for Messages {
    fn visit_item_struct(&mut self, item: &'s syn::ItemStruct) {
        if is_of_clap(&item.attrs) {
            item.fields.iter().for_each(|field| self.text(&documentation(&field.attrs)));
        }
        visit::visit_item_struct(self, item);
    }

    fn visit_item_enum(&mut self, item: &'s syn::ItemEnum) {
        if is_of_clap(&item.attrs) {
            for variant in &item.variants {
                self.text(&documentation(&variant.attrs));
                variant.fields.iter().for_each(|field| self.text(&documentation(&field.attrs)));
            }
        }
        visit::visit_item_enum(self, item);
    }

    fn visit_item_mod(&mut self, item: &'s syn::ItemMod) {
        if !is_of_tests(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_attribute(&mut self, attribute: &'s syn::Attribute) {
        let names = ["error", "diagnostic", "help", "arg", "command", "label"];
        if let syn::Meta::List(list) = &attribute.meta
            && names.iter().any(|name| list.path.is_ident(name))
        {
            self.tokens(list.tokens.clone());
        }
    }

    fn visit_macro(&mut self, called: &'s syn::Macro) {
        let name = called.path.segments.last().unwrap().ident.to_string();
        if !FOR_DEVELOPERS.contains(&name.as_str()) {
            self.tokens(called.tokens.clone());
        }
    }

    fn visit_expr_method_call(&mut self, call: &'s syn::ExprMethodCall) {
        if !OF_DEVELOPERS.iter().any(|name| call.method == name) {
            visit::visit_expr_method_call(self, call);
        } else {
            self.visit_expr(&call.receiver);
        }
    }

    fn visit_lit_str(&mut self, text: &'s syn::LitStr) {
        self.text(&text.value());
    }
}

/// Whether a text is a sentence or part of one, and no program, page or picture.
fn is_message(text: &str) -> bool {
    let code = [
        "</", "/>", "<!", "::", "=>", "();", "#[", "//", " = {", "&&", "px;", "};", "*/", ".rs",
        "fn ", "{{", "<g", "<t",
    ];
    let word = |word: &&str| {
        let word = word.trim_matches(|c: char| !c.is_alphabetic());
        word.chars().count() > 1 && word.chars().all(|c| c.is_alphabetic() || c == '-' || c == '\'')
    };
    let outside = outside_placeholders(text);
    outside.split(' ').filter(word).count() >= 3 && !code.iter().any(|mark| text.contains(mark))
}

/// A text without what is between braces.
fn outside_placeholders(text: &str) -> String {
    let mut depth = 0;
    let kept = text.chars().filter(|c| {
        depth += i32::from(*c == '{');
        let outside = depth == 0;
        depth -= i32::from(*c == '}');
        outside
    });
    kept.collect()
}

/// The messages of a source, in its order.
pub fn messages(text: &str) -> Vec<String> {
    let mut found = Messages::default();
    found.visit_file(&syn::parse_file(text).unwrap());
    found.0
}

#[test]
fn the_listing_holds_every_message() {
    let mut listing = String::new();
    for (file, text) in sources() {
        let found = messages(&text);
        if !found.is_empty() {
            let _ = writeln!(listing, "{file}");
            for message in found {
                let _ = writeln!(listing, "    {message}");
            }
        }
    }
    let command = "cargo test -p dbd-tests --all-features --test pages listing";
    page::file("docs/validation/messages.txt", &listing, command);
}

#[test]
fn messages_are_told_from_other_texts() {
    let source = r##"
        #[derive(Error)]
        enum Wrong { #[error("the step {step} is not positive")] #[diagnostic(help("give a step above zero"))] Step }
        /// A comment is no message.
        #[derive(Debug, Args)]
        struct Arguments {
            /// Write a picture to this file
            svg: bool,
        }
        /// Nor is this comment here.
        fn f(x: Option<u8>) -> String {
            let _ = x.expect("this is for developers alone");
            assert!(true, "so is this one here");
            let _ = "<p>this is a page</p>";
            let _ = "a name";
            format!("joint `{}` has no axis at all", concat!("give it", " an axis"))
        }
        #[cfg(test)]
        mod tests { fn g() -> &'static str { "this is only a test" } }
    "##;
    let found = messages(source);
    let expected = [
        "the step {step} is not positive",
        "give a step above zero",
        "Write a picture to this file",
        "joint `{}` has no axis at all",
    ];
    assert_eq!(found, expected);
}
