//! Program `laws`: hashes of scenes with laws, see `firmware::laws` (target only). The image of the other programs has
//! no room for them.
#![cfg_attr(target_os = "none", no_std, no_main)]

use firmware::console::exit;

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    exit(firmware::hash::run_to_the_end(|hashing| firmware::laws::for_each(hashing)))
}

#[cfg(not(target_os = "none"))]
fn main() -> ! {
    firmware::say!("a host has these hashes in tests/bits/laws.csv");
    exit(false)
}
