//! The scenes' models, const and in flash, as the build script wrote them.

/// `scenes/four-bar.toml`.
pub mod four_bar {
    include!(concat!(env!("OUT_DIR"), "/four-bar.rs"));
}

/// `scenes/cart-pendulum.toml`.
pub mod cart_pendulum {
    include!(concat!(env!("OUT_DIR"), "/cart-pendulum.rs"));
}
