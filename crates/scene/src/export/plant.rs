//! Source of a plant's type and constructor.
//!
//! `(scene, scheme, precision) => type aliases, constructors`.

use super::names::{UNUSED, constant_name, quoted, type_name};
use super::number::SourceGeometry;
use super::precision::ExportPrecision;
use super::scheme::ExportScheme;
use crate::scene::Scene;

/// The scheme as a constant.
pub(super) fn scheme(scene: &Scene, scheme: &ExportScheme) -> String {
    format!(
        "/// The scheme of the plants: {}.\n{UNUSED}pub const {}_SCHEME: {} = {};\n",
        scheme.name(),
        constant_name(&scene.name),
        scheme.path,
        scheme.value,
    )
}

/// The plant type of a precision and its constructor.
pub(super) fn plant<P: SourceGeometry>(scene: &Scene, scheme: &ExportScheme) -> String {
    let (ty, constant) = (type_name(&scene.name), constant_name(&scene.name));
    let (precision, capitals, path) = (P::SUFFIX, P::SUFFIX.to_uppercase(), &scheme.path);
    let suffix = precision.to_lowercase();
    let planned = if scheme.has_matrix { ["Planned", "_PLANNED"] } else { [""; 2] };
    let (model, of) = (format!("{ty}{}{precision}", planned[0]), planned[1]);
    format!(
        "/// The scene {} stepped by {} in {name}.\n{UNUSED}\
         pub type {ty}Plant{precision} = dbd_kernel::generated::Plant<&'static {model}, {path}>;\n\
         /// A plant at its initial state, with the step [`{constant}_STEP`].\n///\n\
         /// # Errors\n/// Where {name} does not hold the step, which was looked at when this was \
         written.\n{UNUSED}#[inline]\n\
         pub fn plant_{suffix}() -> Result<{ty}Plant{precision}, dbd_kernel::generated::PlantError> {{\n    \
             dbd_kernel::generated::Plant::new(&{constant}{of}_{capitals}, {constant}_SCHEME, {constant}_STEP)\n\
         }}\n",
        quoted(&scene.name),
        scheme.name(),
        name = P::NAME,
    )
}

/// Names without a precision, where there is only one.
pub(super) fn only(scene: &Scene, precision: ExportPrecision) -> String {
    let (ty, suffix) = (type_name(&scene.name), precision.suffix());
    let call = suffix.to_lowercase();
    format!(
        "/// The scene's plant: its only precision is {}.\n{UNUSED}\
         pub type {ty}Plant = {ty}Plant{suffix};\n\
         /// A plant at its initial state.\n///\n\
         /// # Errors\n/// Those of [`plant_{call}`].\n{UNUSED}#[inline]\n\
         pub fn plant() -> Result<{ty}Plant, dbd_kernel::generated::PlantError> {{\n    \
             plant_{call}()\n\
         }}\n",
        precision.name(),
    )
}
