//! The key that ties a model description to its resources.
//!
//! `(description, resources) => token`: FNV-1a 64 over the model description and the resources. It detects mistakes,
//! not malice.

use crate::description::Description;
use crate::resource::Resource;
use crate::xml::{Fmi, model_description};

/// The token: 16 hexadecimal digits.
#[must_use]
pub fn token(description: &Description, resource: &Resource, fmi: Fmi) -> String {
    let [scene, plan] = resource.files().map(|(_, text)| text);
    // Each is terminated, so that text cannot move between them undetected.
    let all = [model_description(description, fmi, ""), scene, plan].join("\0");
    format!("{:016x}", hash(all.as_bytes()))
}

/// FNV-1a 64.
#[must_use]
pub(crate) fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}
