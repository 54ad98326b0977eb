//! macOS links an extension module only where it is said that the interpreter brings Python's symbols. maturin says it
//! for the crate that it builds; cargo also links this one where a user's crate depends on it.

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
