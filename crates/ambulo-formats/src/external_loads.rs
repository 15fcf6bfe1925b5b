//! OpenSim `ExternalLoads` documents: which columns of a force file act on which body.
//!
//! Read: documents of OpenSim 2 and 3 (`<isDisabled>`, a `<defaults>` block) and of OpenSim 4 (`<appliesForce>`), also
//! without the `<OpenSimDocument>` around them. Written: a document that OpenSim 4 loads.
//! Not handled, and rejected: `<PrescribedForce>`, which OpenSim 1 and early 2 had in place of `<ExternalForce>`.
//! Not handled, with a remark: a force with a separate data source, and a kinematics file for turning its forces.
//! Pinned by: tests/loads.rs, tests/malformed.rs, tests/real_files.rs

use crate::error::{Error, Remark, quoted};
use crate::xml::{self, escaped};
use roxmltree::Node;

/// Forces from one data file, and the bodies on which they act.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExternalLoads {
    /// Name of the set.
    pub name: String,
    /// Storage file with the columns, as written in the document: usually relative to the document.
    pub datafile: Option<String>,
    /// The forces, in the document's order.
    pub forces: Vec<ExternalForce>,
}

/// One force with its point of application and its free moment, given as columns of the data file.
///
/// An identifier is the prefix of three column names: `ground_force_v` means `ground_force_vx`,
/// `ground_force_vy` and `ground_force_vz`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExternalForce {
    /// Name of the force.
    pub name: String,
    /// Whether the force acts at all.
    pub enabled: bool,
    /// Body on which the force acts.
    pub applied_to_body: String,
    /// Body in whose axes force and moment are given; `ground` for the laboratory.
    pub force_expressed_in_body: String,
    /// Body from whose origin, in whose axes, the point is given; `ground` for the laboratory.
    pub point_expressed_in_body: String,
    /// Columns of the force \[N\].
    pub force_identifier: Option<String>,
    /// Columns of the point of application \[m\].
    pub point_identifier: Option<String>,
    /// Columns of the free moment \[N.m\].
    pub torque_identifier: Option<String>,
}

const GROUND: &str = "ground";

impl ExternalForce {
    /// A force on a body, force and point given in ground axes, in columns that share a prefix: `ground_force_r_` means
    /// for `ground_force_r_vx`, `ground_force_r_px`, `ground_torque_r_x` and their like.
    pub fn with_prefix(name: &str, body: &str, prefix: &str) -> ExternalForce {
        ExternalForce {
            name: name.to_owned(),
            enabled: true,
            applied_to_body: body.to_owned(),
            force_expressed_in_body: "ground".to_owned(),
            point_expressed_in_body: "ground".to_owned(),
            force_identifier: Some(format!("{prefix}v")),
            point_identifier: Some(format!("{prefix}p")),
            torque_identifier: Some(prefix.replacen("force", "torque", 1)),
        }
    }
}

impl ExternalLoads {
    /// Reads an `ExternalLoads` document.
    pub fn read(bytes: &[u8]) -> Result<(ExternalLoads, Vec<Remark>), Error> {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err(Error::Empty { expected: "an XML document with an <ExternalLoads> element" });
        }
        let text = xml::document_text(bytes);
        let document = xml::parse(&text)?;
        let node = find_loads(document.root_element())?;
        let mut remarks = Vec::new();
        let loads = ExternalLoads {
            name: name_of(node),
            datafile: assigned(node, "datafile"),
            forces: read_forces(node, &mut remarks)?,
        };
        if loads.datafile.is_none() {
            remarks.push(remark(node, "names no <datafile>; the file of forces must be given separately"));
        }
        // It turns forces that are stated in the axes of a moving body; forces in ground axes do not need it.
        let is_ground = |body: &str| body.rsplit('/').next().is_some_and(|name| name.eq_ignore_ascii_case("ground"));
        let is_turned = loads.forces.iter().any(|force| !is_ground(&force.force_expressed_in_body));
        if is_turned && assigned(node, "external_loads_model_kinematics_file").is_some() {
            let text = "names a kinematics file, which was not read; the motion that is analysed turns the forces";
            remarks.push(remark(node, text));
        }
        Ok((loads, remarks))
    }

    /// Writes a document that OpenSim 4 loads.
    pub fn write(&self) -> Vec<u8> {
        let forces: String = self.forces.iter().map(write_force).collect();
        let mut out =
            String::from("<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"40000\">\n");
        out.push_str(&format!("\t<ExternalLoads name=\"{}\">\n", escaped(&self.name)));
        out.push_str(&format!("\t\t<objects>\n{forces}\t\t</objects>\n\t\t<groups />\n"));
        out.push_str(&element("\t\t", "datafile", self.datafile.as_deref().unwrap_or_default()));
        out.push_str("\t</ExternalLoads>\n</OpenSimDocument>\n");
        out.into_bytes()
    }
}

fn find_loads<'a, 'i>(root: Node<'a, 'i>) -> Result<Node<'a, 'i>, Error> {
    const EXPECTED: &str = "an <ExternalLoads> document";
    match root.tag_name().name() {
        "ExternalLoads" => Ok(root),
        "OpenSimDocument" => xml::child(root, "ExternalLoads").ok_or_else(|| {
            let found = xml::elements(root).next().map_or("nothing".into(), |e| format!("<{}>", e.tag_name().name()));
            xml::error_at(root, found, EXPECTED)
        }),
        other => Err(xml::error_at(root, format!("the outermost element <{other}>"), EXPECTED)),
    }
}

fn read_forces(node: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<Vec<ExternalForce>, Error> {
    let Some(objects) = xml::child(node, "objects") else {
        return Err(xml::error_at(node, "no <objects>".into(), "<objects> that holds <ExternalForce> elements"));
    };
    let forces = xml::elements(objects).map(|force| read_force(force, remarks)).collect::<Result<Vec<_>, _>>()?;
    if forces.is_empty() {
        remarks.push(remark(node, "holds no force"));
    }
    Ok(forces)
}

fn read_force(node: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<ExternalForce, Error> {
    if !node.has_tag_name("ExternalForce") {
        let expected = "<ExternalForce>; open the document in OpenSim 3 or 4 and save it again";
        return Err(xml::error_at(node, format!("<{}>", node.tag_name().name()), expected));
    }
    let Some(applied_to_body) = body(node, "applied_to_body") else {
        return Err(xml::error_at(node, "no <applied_to_body>".into(), "the name of the body on which it acts"));
    };
    let disabled = xml::boolean(node, "isDisabled")?.unwrap_or(false);
    let force = ExternalForce {
        name: name_of(node),
        enabled: xml::boolean(node, "appliesForce")?.unwrap_or(!disabled),
        applied_to_body,
        force_expressed_in_body: body(node, "force_expressed_in_body").unwrap_or_else(|| GROUND.into()),
        point_expressed_in_body: body(node, "point_expressed_in_body").unwrap_or_else(|| GROUND.into()),
        force_identifier: assigned(node, "force_identifier"),
        point_identifier: assigned(node, "point_identifier"),
        torque_identifier: assigned(node, "torque_identifier"),
    };
    remarks.extend(remarks_on(node, &force));
    Ok(force)
}

fn remarks_on(node: Node<'_, '_>, force: &ExternalForce) -> Vec<Remark> {
    let mut remarks = Vec::new();
    if !force.enabled {
        remarks.push(remark(node, "is disabled"));
    }
    if force.force_identifier.is_none() && force.torque_identifier.is_none() {
        remarks.push(remark(node, "has neither force nor torque columns; it has no effect"));
    } else if force.force_identifier.is_some() && force.point_identifier.is_none() {
        remarks.push(remark(node, "has no point columns; OpenSim lets the force act at the body's origin"));
    }
    if let Some(source) = assigned(node, "data_source_name") {
        let text = format!("names its own data source {}, which was not read; <datafile> was used", quoted(&source));
        remarks.push(remark(node, &text));
    }
    remarks
}

fn remark(node: Node<'_, '_>, what: &str) -> Remark {
    let line = node.document().text_pos_at(node.range().start).row as usize;
    let message = format!("<{}> {} {what}", node.tag_name().name(), quoted(&name_of(node)));
    Remark::of_line(line, message)
}

fn name_of(node: Node<'_, '_>) -> String {
    node.attribute("name").unwrap_or_default().trim().to_owned()
}

/// Text of the child with this tag, without comments; `None` if it is blank or `Unassigned`, as OpenSim writes it.
fn assigned(node: Node<'_, '_>, tag: &str) -> Option<String> {
    let pieces = xml::child(node, tag)?.children().filter(Node::is_text).filter_map(|piece| piece.text());
    let text: String = pieces.collect();
    let text = text.trim();
    (!text.is_empty() && !text.eq_ignore_ascii_case("unassigned")).then(|| text.to_owned())
}

/// Body name; of a path (`/bodyset/calcn_r`) the last part.
fn body(node: Node<'_, '_>, tag: &str) -> Option<String> {
    let path = assigned(node, tag)?;
    let name = path.trim_end_matches('/').rsplit('/').next().unwrap_or_default().trim();
    (!name.is_empty()).then(|| name.to_owned())
}

fn write_force(force: &ExternalForce) -> String {
    let properties = [
        ("appliesForce", if force.enabled { "true" } else { "false" }),
        ("applied_to_body", &force.applied_to_body),
        ("force_expressed_in_body", &force.force_expressed_in_body),
        ("point_expressed_in_body", &force.point_expressed_in_body),
        ("force_identifier", force.force_identifier.as_deref().unwrap_or_default()),
        ("point_identifier", force.point_identifier.as_deref().unwrap_or_default()),
        ("torque_identifier", force.torque_identifier.as_deref().unwrap_or_default()),
    ];
    let elements: String = properties.iter().map(|(tag, text)| element("\t\t\t\t", tag, text)).collect();
    format!("\t\t\t<ExternalForce name=\"{}\">\n{elements}\t\t\t</ExternalForce>\n", escaped(&force.name))
}

fn element(indent: &str, tag: &str, text: &str) -> String {
    format!("{indent}<{tag}>{}</{tag}>\n", escaped(text))
}
