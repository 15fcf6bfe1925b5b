//! Values that several tools have: paths, time ranges, members of sets, and the names of elements that are not read.

use crate::error::{Error, Remark, quoted};
use crate::xml;
use roxmltree::Node;

/// A path with `/` between its parts; `None` if it is blank or `Unassigned`, as OpenSim writes it.
pub(super) fn path(node: Node<'_, '_>, tag: &str) -> Option<String> {
    let pieces = xml::child(node, tag)?.children().filter(Node::is_text).filter_map(|piece| piece.text());
    let text: String = pieces.collect();
    let text = text.trim();
    (!text.is_empty() && !text.eq_ignore_ascii_case("unassigned")).then(|| text.replace('\\', "/"))
}

/// Start and end of a time range [s]; infinite numbers leave it open.
pub(super) fn time_range(node: Node<'_, '_>) -> Result<Option<[f64; 2]>, Error> {
    let Some(child) = xml::child(node, "time_range") else { return Ok(None) };
    let words: Vec<&str> = child.text().unwrap_or_default().split_whitespace().collect();
    let numbers: Option<Vec<f64>> =
        words.iter().map(|word| word.parse::<f64>().ok().filter(|number| !number.is_nan())).collect();
    match numbers.as_deref() {
        Some([]) => Ok(None),
        Some([from, to]) if from <= to => Ok(Some([*from, *to])),
        _ => Err(xml::error_at(child, quoted(&words.join(" ")), "start and end in seconds, the start first")),
    }
}

/// The members of a set with this tag; a set in a separate file that was not put in its place is rejected.
pub(super) fn members<'a, 'i>(node: Node<'a, 'i>, set: &str) -> Result<Vec<Node<'a, 'i>>, Error> {
    let Some(set) = xml::child(node, set) else { return Ok(Vec::new()) };
    if let Some(file) = set.attribute("file") {
        let expected = "the set itself. hint: copy the content of that file in here";
        return Err(xml::error_at(set, format!("file=\"{file}\", another file"), expected));
    }
    Ok(xml::child(set, "objects").into_iter().flat_map(|objects| xml::elements(objects)).collect())
}

/// Whether a member of a set is switched on.
pub(super) fn applies(node: Node<'_, '_>) -> Result<bool, Error> {
    Ok(xml::boolean(node, "apply")?.unwrap_or(true))
}

/// A weight: a finite number, zero or more.
pub(super) fn weight(node: Node<'_, '_>) -> Result<f64, Error> {
    match xml::number(node, "weight")? {
        Some(weight) if weight < 0.0 => Err(xml::error_at(node, format!("the weight {weight}"), "zero or more")),
        weight => Ok(weight.unwrap_or(1.0)),
    }
}

/// The child elements whose tag an earlier child has.
fn elements_again<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    let earlier = |n: &Node<'_, '_>| n.prev_siblings().skip(1).any(|other| other.tag_name() == n.tag_name());
    xml::elements(node).filter(earlier)
}

/// Names of elements of a tool: elements that are read, and elements that are ignored on purpose.
pub(super) struct Known<'a> {
    pub(super) read: &'a [&'a str],
    pub(super) unused: &'a [&'a str],
}

/// Names the elements with content that were not read, and the elements that occur twice.
pub(super) fn remark_on_others(node: Node<'_, '_>, known: &Known<'_>, remarks: &mut Vec<Remark>) {
    let is_filled =
        |n: &Node<'_, '_>| xml::elements(*n).next().is_some() || n.text().is_some_and(|text| !text.trim().is_empty());
    let tag = |n: Node<'_, '_>| n.tag_name().name().to_owned();
    let others = || xml::elements(node).filter(is_filled).filter(|n| !known.read.contains(&n.tag_name().name()));
    let unused: Vec<String> = others().map(tag).filter(|t| known.unused.contains(&t.as_str())).collect();
    if !unused.is_empty() {
        let message = format!("<{}>: not used: {}", node.tag_name().name(), unused.join(", "));
        remarks.push(Remark::of_line(xml::line_of(node), message));
    }
    for twice in elements_again(node).filter(|n| known.read.contains(&n.tag_name().name())) {
        let message = format!(
            "<{}>: the element <{}> occurs twice; the first is read, this one is not",
            node.tag_name().name(),
            tag(twice)
        );
        remarks.push(Remark::of_line(xml::line_of(twice), message));
    }
    for unknown in others().filter(|n| !known.unused.contains(&n.tag_name().name())) {
        let message =
            format!("<{}>: the element <{}> is not known and was not read", node.tag_name().name(), tag(unknown));
        remarks.push(Remark::of_line(xml::line_of(unknown), message));
    }
}
