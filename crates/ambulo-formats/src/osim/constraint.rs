//! Constraints between coordinates or bodies.

use super::function::{self, OsimFunction};
use super::name_of;
use crate::error::{Error, quoted};
use crate::xml;
use roxmltree::Node;

/// A constraint of the model.
#[derive(Debug, Clone, PartialEq)]
pub enum OsimConstraint {
    /// `dependent = scale · function(independent)`.
    CoordinateCoupler {
        /// Name of the constraint.
        name: String,
        /// Line of the element, counted from 1.
        line: usize,
        /// The coordinate that leads.
        independent: String,
        /// The coordinate that follows.
        dependent: String,
        /// The function, including the scale factor.
        function: OsimFunction,
    },
    /// Any other constraint that is switched on; it closes a loop or couples bodies.
    Other {
        /// Tag of the element.
        kind: String,
        /// Name of the constraint.
        name: String,
        /// Line of the element, counted from 1.
        line: usize,
    },
    /// A constraint that is switched off.
    Off {
        /// Name of the constraint.
        name: String,
    },
}

pub(super) fn read(node: Node<'_, '_>) -> Result<OsimConstraint, Error> {
    let name = name_of(node).to_owned();
    let line = xml::line_of(node);
    let disabled = xml::boolean(node, "isDisabled")?.unwrap_or(false);
    if disabled || !xml::boolean(node, "isEnforced")?.unwrap_or(true) {
        return Ok(OsimConstraint::Off { name });
    }
    if !node.has_tag_name("CoordinateCouplerConstraint") {
        return Ok(OsimConstraint::Other { kind: node.tag_name().name().to_owned(), name, line });
    }
    let dependent = xml::text(node, "dependent_coordinate_name").unwrap_or_default().to_owned();
    let leaders = xml::text(node, "independent_coordinate_names").unwrap_or_default();
    let [independent] = leaders.split_whitespace().collect::<Vec<_>>()[..] else {
        let found =
            format!("{} in <independent_coordinate_names>, which {} follows", quoted(leaders), quoted(&dependent));
        let expected = "one name. hint: keep the coordinate that moves the other one most, and write the function at \
            the usual value of the rest";
        return Err(xml::error_at(node, found, expected));
    };
    let holder = xml::child(node, "coupled_coordinates_function");
    let function = match holder.map(function::held_by).transpose()?.flatten() {
        Some(function) => function,
        None => return Err(xml::error_at(node, "no function".into(), "a <coupled_coordinates_function>")),
    };
    let scale = xml::number(node, "scale_factor")?.unwrap_or(1.0);
    let function = OsimFunction::Multiplier { scale, function: Box::new(function) };
    Ok(OsimConstraint::CoordinateCoupler { name, line, independent: independent.to_owned(), dependent, function })
}
