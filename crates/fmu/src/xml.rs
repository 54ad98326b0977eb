//! `modelDescription.xml` of FMI 2.0.4 and 3.0.2.
//!
//! `(description, version, token) => XML`.

use std::fmt::Write as _;

use crate::description::{Description, Role, Variable};
use crate::units::{BASE, exponents, modelica};

/// A version of FMI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fmi {
    /// FMI 2.0.4.
    Two,
    /// FMI 3.0.2.
    Three,
}

/// The name of the library file, without extension.
pub const IDENTIFIER: &str = "dbd_fmu";
/// The log categories: names and descriptions.
pub const CATEGORIES: [(&str, &str); 1] = [("logStatusError", "rejected calls and failures")];

/// A text escaped for an XML attribute or element.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut all = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => all += "&amp;",
            '<' => all += "&lt;",
            '>' => all += "&gt;",
            '"' => all += "&quot;",
            // XML 1.0 allows no other control characters.
            '\t' | '\n' | '\r' => all.push(' '),
            _ if letter.is_control() => all.push('\u{fffd}'),
            _ => all.push(letter),
        }
    }
    all
}

/// The model description.
#[must_use]
pub fn model_description(of: &Description, fmi: Fmi, token: &str) -> String {
    let (version, key) = match fmi {
        Fmi::Two => ("2.0", "guid"),
        Fmi::Three => ("3.0", "instantiationToken"),
    };
    let naming = if of.is_structured { "structured" } else { "flat" };
    let (name, description) = (escaped(&of.name), escaped(&of.description));
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"{version}\" \
         modelName=\"{name}\" {key}=\"{token}\" description=\"{description}\" \
         generationTool=\"dbd-fmu {}\" variableNamingConvention=\"{naming}\">\n",
        env!("CARGO_PKG_VERSION"),
    );
    let able = "canHandleVariableCommunicationStepSize=\"true\" \
                canBeInstantiatedOnlyOncePerProcess=\"false\"";
    xml += &match fmi {
        Fmi::Two => format!(
            "  <CoSimulation modelIdentifier=\"{IDENTIFIER}\" {able} canGetAndSetFMUstate=\"true\" \
             canSerializeFMUstate=\"true\" canNotUseMemoryManagementFunctions=\"true\" \
             providesDirectionalDerivative=\"true\"/>\n"
        ),
        Fmi::Three => format!(
            "  <CoSimulation modelIdentifier=\"{IDENTIFIER}\" {able} canGetAndSetFMUState=\"true\" \
             canSerializeFMUState=\"true\" providesDirectionalDerivatives=\"true\" \
             fixedInternalStepSize=\"{:?}\"/>\n",
            of.step
        ),
    };
    xml += &units(of);
    xml += "  <LogCategories>\n";
    for (name, what) in CATEGORIES {
        let _ = writeln!(xml, "    <Category name=\"{name}\" description=\"{what}\"/>");
    }
    let _ = writeln!(
        xml,
        "  </LogCategories>\n  <DefaultExperiment startTime=\"0.0\" stopTime=\"{:?}\" stepSize=\"{:?}\"/>",
        of.duration, of.communication_step
    );
    xml += "  <ModelVariables>\n";
    for (reference, variable) in of.variables.iter().enumerate() {
        xml += &variable_of(variable, reference, fmi);
    }
    xml += "  </ModelVariables>\n  <ModelStructure>\n";
    xml += &structure(of, fmi);
    xml + "  </ModelStructure>\n</fmiModelDescription>\n"
}

fn units(of: &Description) -> String {
    let mut names: Vec<&str> = of.variables.iter().map(|variable| variable.unit.as_str()).collect();
    names.retain(|name| !name.is_empty());
    names.sort_unstable();
    names.dedup();
    let mut xml = "  <UnitDefinitions>\n".to_owned();
    for name in names {
        let _ = write!(xml, "    <Unit name=\"{}\"", escaped(&modelica(name)));
        match exponents(name) {
            Some(exponents) => {
                xml += "><BaseUnit";
                for (base, exponent) in BASE.iter().zip(exponents).filter(|(_, e)| *e != 0) {
                    let _ = write!(xml, " {base}=\"{exponent}\"");
                }
                xml += "/></Unit>\n";
            }
            None => xml += "/>\n",
        }
    }
    xml + "  </UnitDefinitions>\n"
}

fn variable_of(variable: &Variable, reference: usize, fmi: Fmi) -> String {
    let Variable { name, role, unit, start, range, description } = variable;
    let (name, description) = (escaped(name), escaped(description));
    let kind = match role {
        Role::Time => "causality=\"independent\" variability=\"continuous\"",
        Role::Input(_) => "causality=\"input\" variability=\"continuous\"",
        Role::Output(..) => {
            "causality=\"output\" variability=\"continuous\" initial=\"calculated\""
        }
        Role::Parameter(_) => "causality=\"parameter\" variability=\"fixed\" initial=\"exact\"",
    };
    let head = format!(
        "name=\"{name}\" valueReference=\"{reference}\" description=\"{description}\" {kind}"
    );
    let mut number = String::new();
    if !unit.is_empty() {
        let _ = write!(number, " unit=\"{}\"", escaped(&modelica(unit)));
    }
    for (word, bound) in
        ["min", "max"].into_iter().zip(range).filter(|(_, bound)| bound.is_finite())
    {
        let _ = write!(number, " {word}=\"{bound:?}\"");
    }
    if let Some(start) = start {
        let _ = write!(number, " start=\"{start:?}\"");
    }
    match fmi {
        Fmi::Two => format!("    <ScalarVariable {head}><Real{number}/></ScalarVariable>\n"),
        Fmi::Three => format!("    <Float64 {head}{number}/>\n"),
    }
}

/// Outputs, each with its direct dependencies if known.
fn structure(of: &Description, fmi: Fmi) -> String {
    let (mut outputs, mut initial) = (String::new(), String::new());
    for (reference, variable) in of.variables.iter().enumerate() {
        let Role::Output(_, is_direct) = variable.role else { continue };
        let known = if is_direct { "" } else { " dependencies=\"\"" };
        match fmi {
            Fmi::Two => {
                let index = reference + 1;
                let _ = writeln!(outputs, "      <Unknown index=\"{index}\"{known}/>");
                let _ = writeln!(initial, "      <Unknown index=\"{index}\"/>");
            }
            Fmi::Three => {
                let _ = writeln!(outputs, "    <Output valueReference=\"{reference}\"{known}/>");
                let _ = writeln!(initial, "    <InitialUnknown valueReference=\"{reference}\"/>");
            }
        }
    }
    match fmi {
        Fmi::Two => format!(
            "    <Outputs>\n{outputs}    </Outputs>\n    <InitialUnknowns>\n{initial}    </InitialUnknowns>\n"
        ),
        Fmi::Three => outputs + &initial,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_min_and_max() {
        let variable = |range| Variable {
            name: "motor".into(),
            role: Role::Input(0),
            unit: "V".into(),
            start: Some(0.0),
            range,
            description: String::new(),
        };
        for fmi in [Fmi::Two, Fmi::Three] {
            let bounded = variable_of(&variable([-24.0, 24.0]), 1, fmi);
            assert!(bounded.contains(" min=\"-24.0\" max=\"24.0\" start=\"0.0\""), "{bounded}");
            let free = variable_of(&variable([f64::NEG_INFINITY, f64::INFINITY]), 1, fmi);
            assert!(!free.contains("min=") && !free.contains("max="), "{free}");
        }
    }
}
