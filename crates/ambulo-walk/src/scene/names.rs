//! Names in a scene file and the parts that they refer to.

use super::SceneError;
use crate::toml_reader::{Table, Value, listed, nearest};
use std::collections::BTreeMap;

/// The part to which a joint or closure is attached.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Attachment {
    /// The world.
    World,
    /// A body of the scene: its index in [`SceneFile::bodies`](super::SceneFile::bodies).
    Body(usize),
    /// A body of a figure, written `figure/body`.
    FigureBody {
        /// Index in [`SceneFile::figures`](super::SceneFile::figures).
        figure: usize,
        /// Name of the body in the figure's model.
        body: String,
    },
}

/// A part that can be in contact.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ContactPartner {
    /// A body of the scene: its index in [`SceneFile::bodies`](super::SceneFile::bodies).
    Body(usize),
    /// An obstacle: its index in [`SceneFile::obstacles`](super::SceneFile::obstacles).
    Obstacle(usize),
    /// Every body of a figure: its index in [`SceneFile::figures`](super::SceneFile::figures).
    Figure(usize),
    /// A body of a figure, written `figure/body`.
    FigureBody {
        /// Index in [`SceneFile::figures`](super::SceneFile::figures).
        figure: usize,
        /// Name of the body in the figure's model.
        body: String,
    },
}

/// The part that a name refers to, with its index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Item {
    Body(usize),
    Obstacle(usize),
    Figure(usize),
    Joint(usize),
    Closure(usize),
}

/// A set of unique names.
#[derive(Default)]
pub(super) struct Names {
    items: BTreeMap<String, (Item, usize)>,
}

impl Names {
    /// Reads the `name` of a table and registers the part.
    pub(super) fn declare(&mut self, table: &Table<'_>, item: Item) -> Result<String, SceneError> {
        let value = table.need("name", "a name")?;
        let name = value.text()?;
        let free = |c: char| !c.is_control() && c != '/' && c != ':';
        if name.is_empty() || name.trim() != name || name == "world" || !name.chars().all(free) {
            let expected =
                "a name that is not empty and not \"world\", without / and :, without leading or trailing spaces";
            return Err(value.wrong(expected));
        }
        if let Some((_, line)) = self.items.get(name) {
            let error = value.wrong(&format!("a unique name; this one is also in line {line}"));
            return Err(
                error.hint("names are unique among bodies, obstacles and figures, and among joints and closures")
            );
        }
        self.items.insert(name.to_owned(), (item, value.line()));
        Ok(name.to_owned())
    }

    /// As `declare`, but first rejects keys other than these, so that a misspelt `name` is reported as such.
    pub(super) fn declare_first(&mut self, table: &Table<'_>, keys: &[&str], item: Item) -> Result<String, SceneError> {
        table.only(&[keys])?;
        self.declare(table, item)
    }

    pub(super) fn find(&self, name: &str) -> Option<Item> {
        self.items.get(name).map(|(item, _)| *item)
    }

    /// Reads the attachment of a joint or closure.
    pub(super) fn carrier(&self, value: &Value<'_>) -> Result<Attachment, SceneError> {
        let name = value.text()?;
        if name == "world" {
            return Ok(Attachment::World);
        }
        if let Some((figure, body)) = self.figure_body(name) {
            return Ok(Attachment::FigureBody { figure, body });
        }
        match self.find(name) {
            Some(Item::Body(body)) => Ok(Attachment::Body(body)),
            found => Err(self.unfit(value, name, "\"world\", a body, or \"figure/body\"", found)),
        }
    }

    /// Reads the name of a body of the scene.
    pub(super) fn body(&self, value: &Value<'_>) -> Result<usize, SceneError> {
        let name = value.text()?;
        match self.find(name) {
            Some(Item::Body(body)) => Ok(body),
            found => Err(self.unfit(value, name, "a body of the scene", found)),
        }
    }

    /// Reads the name of a part that can be in contact.
    pub(super) fn partner(&self, value: &Value<'_>) -> Result<ContactPartner, SceneError> {
        let name = value.text()?;
        if let Some((figure, body)) = self.figure_body(name) {
            return Ok(ContactPartner::FigureBody { figure, body });
        }
        match self.find(name) {
            Some(Item::Body(body)) => Ok(ContactPartner::Body(body)),
            Some(Item::Obstacle(obstacle)) => Ok(ContactPartner::Obstacle(obstacle)),
            Some(Item::Figure(figure)) => Ok(ContactPartner::Figure(figure)),
            found => Err(self.unfit(value, name, "a body, an obstacle, a figure, or \"figure/body\"", found)),
        }
    }

    fn figure_body(&self, name: &str) -> Option<(usize, String)> {
        let (figure, body) = name.split_once('/')?;
        match self.find(figure) {
            Some(Item::Figure(figure)) if !body.trim().is_empty() => Some((figure, body.to_owned())),
            _ => None,
        }
    }

    /// The error for a name that refers to nothing or to another kind of part.
    pub(super) fn unfit(&self, value: &Value<'_>, name: &str, expected: &str, found: Option<Item>) -> SceneError {
        let error = value.wrong(expected);
        let kind = match found {
            None => {
                return match nearest(name, self.items.keys().map(String::as_str)) {
                    Some(near) => error.hint(&format!("did you mean \"{near}\"?")),
                    None if self.items.is_empty() => error,
                    None => error.hint(&format!("the names are {}", listed(self.items.keys().map(String::as_str)))),
                };
            }
            Some(Item::Body(_)) => "a body",
            Some(Item::Obstacle(_)) => "an obstacle; joints connect bodies, if necessary a body on a driven joint",
            Some(Item::Figure(_)) => "a figure; name one of its bodies as \"figure/body\"",
            Some(Item::Joint(_)) => "a joint",
            Some(Item::Closure(_)) => "a closure",
        };
        error.hint(&format!("\"{name}\" is {kind}"))
    }
}
