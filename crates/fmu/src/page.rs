//! The page of an FMU's `documentation/`.
//!
//! `(description, resource) => HTML`: the scene, its method and all variables.

use std::fmt::Write as _;

use crate::description::{Description, Role};
use crate::resource::Resource;
use crate::xml::escaped;

/// The page.
#[must_use]
pub fn page(of: &Description, resource: &Resource) -> String {
    let settings = &resource.settings;
    let asked = |name: &Option<String>, else_: &str| escaped(name.as_deref().unwrap_or(else_));
    let (name, description) = (escaped(&of.name), escaped(&of.description));
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>{name}</title></head>\n<body>\n\
         <h1>{name}</h1>\n<p>{description}</p>\n\
         <p>A plant of Discrete Body Dynamics for co-simulation. Its step is {:?} s; communication steps are whole \
         numbers of it, others are refused. Scheme: {}. Damping: {}. Precision: {}. Inputs are held until they are \
         set again. Parameters are fixed once initialisation has ended.</p>\n\
         <table>\n<tr><th>variable<th>reference<th>kind<th>unit<th>start<th>what it is</tr>\n",
        of.step,
        asked(&settings.scheme, "the default"),
        asked(&settings.damping, "the default of the scheme"),
        asked(&settings.precision, "f64"),
    );
    for (reference, variable) in of.variables.iter().enumerate() {
        let kind = match variable.role {
            Role::Time => "independent",
            Role::Input(_) => "input",
            Role::Output(..) => "output",
            Role::Parameter(_) => "parameter",
        };
        let start = variable.start.map(|start| format!("{start:?}")).unwrap_or_default();
        let _ = writeln!(
            html,
            "<tr><td>{}<td>{reference}<td>{kind}<td>{}<td>{start}<td>{}</tr>",
            escaped(&variable.name),
            escaped(&variable.unit),
            escaped(&variable.description),
        );
    }
    html + "</table>\n</body>\n</html>\n"
}
