//! Reads figures back with an independent XML parser: panels with their axes, and lines as numbers.

#![allow(dead_code, reason = "each crate uses its own part")]

use ambulo::model::Side;
use roxmltree::{Document, Node};

/// A figure read from its file.
#[derive(Debug, Clone)]
pub(crate) struct Figure {
    pub(crate) title: String,
    pub(crate) width_mm: f64,
    pub(crate) view_box: [f64; 4],
    pub(crate) panels: Vec<Panel>,
    /// What is written, in order.
    pub(crate) texts: Vec<String>,
    /// Names of all elements.
    pub(crate) elements: Vec<String>,
}

#[derive(Debug, Clone)]
pub(crate) struct Panel {
    pub(crate) id: String,
    /// Left, top, right, bottom [pt].
    pub(crate) place: [f64; 4],
    /// Abscissas at the left and at the right.
    pub(crate) along: [f64; 2],
    /// Ordinates at bottom and top.
    pub(crate) up: [f64; 2],
    pub(crate) lines: Vec<Line>,
    /// How many grey bands.
    pub(crate) bands: usize,
}

/// A curve, in the numbers of its axes.
#[derive(Debug, Clone)]
pub(crate) struct Line {
    pub(crate) side: Side,
    /// `cycle`, `mean` or `infeasible`.
    pub(crate) role: String,
    /// Number of the cycle, or of cycles.
    pub(crate) number: usize,
    pub(crate) points: Vec<[f64; 2]>,
}

impl Figure {
    pub(crate) fn read(text: &str) -> Figure {
        let document = Document::parse(text).unwrap_or_else(|e| panic!("no XML: {e}\n{text}"));
        let root = document.root_element();
        let groups = root.descendants().filter(|node| node.has_tag_name("g") && node.has_attribute("data-up"));
        let of =
            |tag: &str| root.descendants().filter(|node| node.tag_name().name() == tag).map(words).collect::<Vec<_>>();
        Figure {
            title: of("title").remove(0),
            width_mm: root.attribute("width").unwrap().strip_suffix("mm").unwrap().parse().unwrap(),
            view_box: numbers(root, "viewBox"),
            panels: groups.map(panel).collect(),
            texts: of("text"),
            elements: root.descendants().map(|node| node.tag_name().name().to_owned()).collect(),
        }
    }
}

fn words(node: Node<'_, '_>) -> String {
    node.text().unwrap_or_default().to_owned()
}

fn numbers<const N: usize>(node: Node<'_, '_>, attribute: &str) -> [f64; N] {
    let cells = node.attribute(attribute).unwrap().split([' ', ',']);
    cells.map(|cell| cell.parse().unwrap()).collect::<Vec<f64>>().try_into().unwrap()
}

/// Names and points of the curves of all panels of a chart, in the numbers of their axes.
pub(crate) fn curves(text: &str) -> Vec<(String, Vec<[f64; 2]>)> {
    let document = Document::parse(text).unwrap_or_else(|e| panic!("no XML: {e}\n{text}"));
    let lines = document.descendants().filter(|node| node.has_tag_name("polyline") && node.has_attribute("data-name"));
    let curve = |line: Node<'_, '_>| {
        let group = line.parent().unwrap();
        (line.attribute("data-name").unwrap().to_owned(), points(group, line))
    };
    lines.map(curve).collect()
}

/// The points of a line in the numbers of its panel's axes.
fn points(group: Node<'_, '_>, line: Node<'_, '_>) -> Vec<[f64; 2]> {
    let [left, top, right, bottom] = numbers(group, "data-place");
    let (along, up): ([f64; 2], [f64; 2]) = (numbers(group, "data-along"), numbers(group, "data-up"));
    let number = |point: &str| {
        let (x, y) = point.split_once(',').unwrap();
        let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
        let across = (x - left) / (right - left);
        let high = (bottom - y) / (bottom - top);
        [along[0] + across * (along[1] - along[0]), up[0] + high * (up[1] - up[0])]
    };
    line.attribute("points").unwrap().split(' ').map(number).collect()
}

fn panel(group: Node<'_, '_>) -> Panel {
    let [left, top, right, bottom] = numbers(group, "data-place");
    let (along, up) = (numbers(group, "data-along"), numbers(group, "data-up"));
    let line = |node: Node<'_, '_>| {
        let cycle = node.attribute("data-cycle").or(node.attribute("data-cycles"));
        Line {
            side: if node.attribute("data-side") == Some("l") { Side::Left } else { Side::Right },
            role: node.attribute("data-role").unwrap().to_owned(),
            number: cycle.map_or(0, |text| text.parse().unwrap()),
            points: points(group, node),
        }
    };
    let of = |tag: &'static str| group.children().filter(move |node| node.has_tag_name(tag));
    Panel {
        id: group.attribute("id").unwrap().to_owned(),
        place: [left, top, right, bottom],
        along,
        up,
        lines: of("polyline").filter(|node| node.has_attribute("data-role")).map(line).collect(),
        bands: of("polygon").filter(|node| node.attribute("data-role") == Some("band")).count(),
    }
}
