//! Known names of elements and attributes, so that misspelt ones are reported.
//!
//! `tree => unknown names`. Names are those of MuJoCo's XML reference. Attributes are checked where a scene uses them;
//! those that affect only rendering, the solver or the file size are skipped.

use dbd_scene::nearest;

use crate::element::Element;
use crate::error::Fault;
use crate::omission::{Kind, Omissions};

/// Sections of `<mujoco>`; the unchecked ones come second.
const SECTIONS: &[&str] = &[
    "compiler",
    "option",
    "default",
    "worldbody",
    "contact",
    "tendon",
    "equality",
    "actuator",
    "sensor",
    "keyframe",
    "asset",
];
const PASSED_OVER: &[&str] =
    &["size", "statistic", "visual", "custom", "extension", "deformable", "include"];

/// Elements allowed in a body or a frame.
const BODY: &[&str] = &[
    "body",
    "frame",
    "inertial",
    "joint",
    "freejoint",
    "geom",
    "site",
    "camera",
    "light",
    "plugin",
    "composite",
    "flexcomp",
    "attach",
    "replicate",
];

const POSE: &[&str] = &["pos", "quat", "axisangle", "euler", "xyaxes", "zaxis"];

/// Attributes of an actuator with a linear law, in any form.
const ACTUATOR: &[&str] = &[
    "actdim",
    "actearly",
    "actlimited",
    "actrange",
    "armature",
    "biasprm",
    "biastype",
    "body",
    "class",
    "cranklength",
    "cranksite",
    "ctrllimited",
    "ctrlrange",
    "damping",
    "dampratio",
    "delay",
    "dynprm",
    "dyntype",
    "ffrange",
    "forcelimited",
    "forcerange",
    "gainprm",
    "gaintype",
    "gear",
    "group",
    "inheritrange",
    "input",
    "interp",
    "joint",
    "jointinparent",
    "kp",
    "kv",
    "lengthrange",
    "name",
    "nsample",
    "refsite",
    "site",
    "slidersite",
    "tendon",
    "timeconst",
    "user",
    "velrange",
];

/// Attributes of a tendon.
const TENDON: &[&str] = &[
    "actuatorfrclimited",
    "actuatorfrcrange",
    "armature",
    "class",
    "damping",
    "frictionloss",
    "group",
    "limited",
    "margin",
    "material",
    "name",
    "range",
    "rgba",
    "solimpfriction",
    "solimplimit",
    "solreffriction",
    "solreflimit",
    "springlength",
    "springyield",
    "stiffness",
    "user",
    "width",
];

/// The attributes of elements that are read: section, element, names, whether it has a pose.
type Known = (&'static str, &'static str, &'static [&'static str], bool);

const ATTRIBUTES: &[Known] = &[
    (
        "",
        "compiler",
        &[
            "alignfree",
            "angle",
            "assetdir",
            "autolimits",
            "balanceinertia",
            "boundinertia",
            "boundmass",
            "conflict",
            "convexhull",
            "coordinate",
            "discardvisual",
            "eulerseq",
            "exactmeshinertia",
            "fitaabb",
            "fusestatic",
            "inertiafromgeom",
            "inertiagrouprange",
            "meshdir",
            "passthrough",
            "savecanonical",
            "savecompiled",
            "saveinertial",
            "settotalmass",
            "strippath",
            "texturedir",
            "usethread",
        ],
        false,
    ),
    (
        "",
        "option",
        &[
            "actuatorgroupdisable",
            "apirate",
            "ccd_iterations",
            "ccd_tolerance",
            "collision",
            "cone",
            "density",
            "gravity",
            "impratio",
            "integrator",
            "iterations",
            "jacobian",
            "ls_iterations",
            "ls_tolerance",
            "magnetic",
            "mpr_iterations",
            "mpr_tolerance",
            "noslip_iterations",
            "noslip_tolerance",
            "o_friction",
            "o_margin",
            "o_solimp",
            "o_solref",
            "sdf_initpoints",
            "sdf_iterations",
            "sleep_tolerance",
            "solver",
            "timestep",
            "tolerance",
            "viscosity",
            "wind",
        ],
        false,
    ),
    ("worldbody", "worldbody", &["name"], true),
    (
        "worldbody",
        "body",
        &["childclass", "fuse", "gravcomp", "mocap", "name", "simple", "sleep", "user"],
        true,
    ),
    ("worldbody", "frame", &["name", "childclass"], true),
    ("worldbody", "inertial", &["mass", "diaginertia", "fullinertia"], true),
    (
        "worldbody",
        "joint",
        &[
            "actuatorfrclimited",
            "actuatorfrcrange",
            "actuatorgravcomp",
            "armature",
            "axis",
            "class",
            "damping",
            "frictionloss",
            "group",
            "limited",
            "margin",
            "name",
            "pos",
            "range",
            "ref",
            "solimpfriction",
            "solimplimit",
            "solreffriction",
            "solreflimit",
            "springdamper",
            "springref",
            "springyield",
            "stiffness",
            "type",
            "user",
        ],
        false,
    ),
    ("worldbody", "freejoint", &["align", "group", "name"], false),
    (
        "worldbody",
        "geom",
        &[
            "adhesion",
            "castshadow",
            "class",
            "conaffinity",
            "condim",
            "contype",
            "density",
            "fitscale",
            "fluidcoef",
            "fluidshape",
            "friction",
            "fromto",
            "gap",
            "group",
            "hfield",
            "margin",
            "mass",
            "material",
            "mesh",
            "name",
            "priority",
            "rgba",
            "shellinertia",
            "size",
            "solimp",
            "solmix",
            "solref",
            "surfacevel",
            "type",
            "user",
        ],
        true,
    ),
    (
        "worldbody",
        "site",
        &["class", "fromto", "group", "material", "mesh", "name", "rgba", "size", "type", "user"],
        true,
    ),
    (
        "equality",
        "connect",
        &[
            "active", "anchor", "body1", "body2", "class", "name", "site1", "site2", "solimp",
            "solref",
        ],
        false,
    ),
    (
        "equality",
        "weld",
        &[
            "active",
            "anchor",
            "body1",
            "body2",
            "class",
            "name",
            "relpose",
            "site1",
            "site2",
            "solimp",
            "solref",
            "torquescale",
        ],
        false,
    ),
    (
        "equality",
        "joint",
        &["active", "class", "joint1", "joint2", "name", "polycoef", "solimp", "solref"],
        false,
    ),
    ("actuator", "motor", ACTUATOR, false),
    ("actuator", "position", ACTUATOR, false),
    ("actuator", "velocity", ACTUATOR, false),
    ("actuator", "general", ACTUATOR, false),
    ("tendon", "spatial", TENDON, false),
    ("tendon", "fixed", TENDON, false),
    (
        "asset",
        "mesh",
        &[
            "builtin",
            "class",
            "content_type",
            "face",
            "file",
            "inertia",
            "material",
            "maxhullvert",
            "name",
            "normal",
            "params",
            "refpos",
            "refquat",
            "scale",
            "smoothnormal",
            "texcoord",
            "vertex",
        ],
        false,
    ),
];

/// Equalities; a scene has a counterpart of the first three.
pub(crate) const EQUALITIES: &[&str] =
    &["connect", "weld", "joint", "tendon", "flex", "flexvert", "flexstrain", "distance"];

/// Lists elements and attributes with unknown names.
///
/// # Errors
/// If a section has an unknown name: all its contents would be omitted.
pub(crate) fn check(root: &Element, omissions: &mut Omissions) -> Result<(), Fault> {
    for section in &root.children {
        let name = section.name.as_str();
        if PASSED_OVER.contains(&name) {
            continue;
        }
        if !SECTIONS.contains(&name) {
            let known = SECTIONS.iter().chain(PASSED_OVER).copied();
            let meant = nearest(name, known).map(|meant| format!(": did you mean <{meant}>?"));
            let help = format!("expected a section of MJCF{}", meant.unwrap_or_default());
            return Err(Fault::at(section.place, format!("unknown section <{name}>"), help));
        }
        attributes(section, if name == "worldbody" { name } else { "" }, omissions);
        match name {
            "worldbody" => bodies(section, omissions),
            "equality" => {
                children(section, EQUALITIES, omissions);
                section.children.iter().for_each(|child| attributes(child, name, omissions));
            }
            "actuator" | "tendon" | "asset" => {
                section.children.iter().for_each(|child| attributes(child, name, omissions))
            }
            "default" => defaults(section, omissions),
            _ => {}
        }
    }
    Ok(())
}

fn bodies(body: &Element, omissions: &mut Omissions) {
    children(body, BODY, omissions);
    for child in &body.children {
        attributes(child, "worldbody", omissions);
        if matches!(child.name.as_str(), "body" | "frame") {
            bodies(child, omissions);
        }
    }
}

fn defaults(class: &Element, omissions: &mut Omissions) {
    for child in &class.children {
        match child.name.as_str() {
            "default" => defaults(child, omissions),
            "joint" | "geom" | "site" => attributes(child, "worldbody", omissions),
            "mesh" => attributes(child, "asset", omissions),
            "motor" | "position" | "velocity" | "general" => {
                attributes(child, "actuator", omissions);
            }
            _ => {}
        }
    }
}

/// Lists child elements with unknown names.
pub(crate) fn children(element: &Element, known: &[&str], omissions: &mut Omissions) {
    for child in element.children.iter().filter(|child| !known.contains(&child.name.as_str())) {
        let meant = nearest(&child.name, known.iter().copied());
        let meant = meant.map_or(String::new(), |meant| format!(", did you mean <{meant}>?"));
        let what = format!("<{}> in <{}>{meant}", child.name, element.name);
        omissions.add(Kind::Unknown, child.place, what);
    }
}

fn attributes(element: &Element, section: &str, omissions: &mut Omissions) {
    let found = ATTRIBUTES.iter().find(|(of, name, ..)| *of == section && *name == element.name);
    let Some((_, _, own, with_pose)) = found else { return };
    let pose = if *with_pose { POSE } else { &[] };
    let known = || own.iter().chain(pose).copied();
    for attribute in &element.attributes {
        if known().any(|name| name == attribute.name) {
            continue;
        }
        let meant = nearest(&attribute.name, known());
        let meant = meant.map_or(String::new(), |meant| format!(", did you mean `{meant}`?"));
        let what = format!("`{}` of {}{meant}", attribute.name, element.called());
        omissions.add(Kind::Unknown, attribute.place, what);
    }
}
