//! The named values of a C3D file: groups of parameters, each with a type and a shape.

use std::fmt;

/// Everything of the parameter section, in the order of the file.
///
/// Names are compared without regard to case. After reading, these are the file's values; when a [`super::C3d`] is
/// written, those that repeat its other fields (`POINT:USED`, `ANALOG:RATE`, labels, events ...) are replaced.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Parameters {
    /// The groups: `POINT`, `ANALOG`, `FORCE_PLATFORM`, `EVENT`, and groups of manufacturers.
    pub groups: Vec<Group>,
}

/// A group of parameters.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Group {
    /// Name as in the file.
    pub name: String,
    /// Description in the file; usually empty.
    pub description: String,
    /// Whether the group is locked (its name has a negative length).
    pub locked: bool,
    /// Parameters of the group.
    pub parameters: Vec<Parameter>,
}

/// One parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Name as in the file.
    pub name: String,
    /// Description in the file; usually empty.
    pub description: String,
    /// Whether the parameter is locked.
    pub locked: bool,
    /// Shape, first index fastest (as Fortran has it); empty for a single value. For texts, the length of the texts is
    /// left out.
    pub dimensions: Vec<usize>,
    /// The values, as many as the product of the dimensions.
    pub values: Values,
}

/// The values of a parameter, by type.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Type -1: texts, without the blanks at their end.
    Texts(Vec<String>),
    /// Type 1: bytes.
    Bytes(Vec<u8>),
    /// Type 2: 16-bit integers. Counts above 32767 appear as negative numbers; see [`Parameter::counts`].
    Integers(Vec<i16>),
    /// Type 4: reals.
    Reals(Vec<f32>),
}

impl Values {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Values::Texts(values) => values.len(),
            Values::Bytes(values) => values.len(),
            Values::Integers(values) => values.len(),
            Values::Reals(values) => values.len(),
        }
    }

    /// Whether there is no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Parameter {
    /// A parameter with one value or a list, without description, not locked. The only dimension is the number of
    /// values.
    pub fn list(name: &str, values: Values) -> Parameter {
        let dimensions = vec![values.len()];
        Parameter { name: name.into(), description: String::new(), locked: false, dimensions, values }
    }

    /// A parameter with a single value: the first of `values`.
    pub fn single(name: &str, values: Values) -> Parameter {
        Parameter { dimensions: vec![], ..Parameter::list(name, values) }
    }

    /// The texts; `None` for numbers.
    pub fn texts(&self) -> Option<&[String]> {
        match &self.values {
            Values::Texts(texts) => Some(texts),
            _ => None,
        }
    }

    /// All values as numbers, integers with their sign; `None` for texts.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        Some(match &self.values {
            Values::Texts(_) => return None,
            Values::Bytes(values) => values.iter().copied().map(f64::from).collect(),
            Values::Integers(values) => values.iter().copied().map(f64::from).collect(),
            Values::Reals(values) => values.iter().copied().map(f64::from).collect(),
        })
    }

    /// All values as whole numbers from zero, integers read as unsigned; `None` for texts and if a value is not a whole
    /// number.
    pub fn counts(&self) -> Option<Vec<usize>> {
        match &self.values {
            Values::Texts(_) => None,
            Values::Bytes(values) => Some(values.iter().copied().map(usize::from).collect()),
            Values::Integers(values) => Some(values.iter().map(|value| usize::from(value.cast_unsigned())).collect()),
            Values::Reals(values) => values.iter().map(|&value| whole(value)).collect(),
        }
    }
}

/// A real that is a whole number from zero to 2^31.
fn whole(value: f32) -> Option<usize> {
    const LARGEST: f32 = 2_147_483_648.0;
    (value.fract().abs() < f32::MIN_POSITIVE && (0.0..=LARGEST).contains(&value)).then_some(value as usize)
}

impl Group {
    /// The first parameter with this name.
    pub fn get(&self, name: &str) -> Option<&Parameter> {
        self.parameters.iter().find(|parameter| parameter.name.eq_ignore_ascii_case(name))
    }
}

impl Parameters {
    /// The first group with this name.
    pub fn group(&self, name: &str) -> Option<&Group> {
        self.groups.iter().find(|group| group.name.eq_ignore_ascii_case(name))
    }

    /// The parameter `group:name`.
    pub fn get(&self, group: &str, name: &str) -> Option<&Parameter> {
        let groups = self.groups.iter().filter(|candidate| candidate.name.eq_ignore_ascii_case(group));
        groups.filter_map(|candidate| candidate.get(name)).next()
    }

    /// The first value of `group:name` as a number.
    pub fn number(&self, group: &str, name: &str) -> Option<f64> {
        self.get(group, name)?.numbers()?.first().copied()
    }

    /// The first value of `group:name` as a whole number from zero, an integer read as unsigned.
    pub fn count(&self, group: &str, name: &str) -> Option<usize> {
        self.get(group, name)?.counts()?.first().copied()
    }

    /// The first value of `group:name` as text.
    pub fn text(&self, group: &str, name: &str) -> Option<&str> {
        self.get(group, name)?.texts()?.first().map(String::as_str)
    }

    /// The texts of `group:name`, `name2`, `name3`, concatenated: files hold more than 255 values in this way.
    pub fn texts(&self, group: &str, name: &str) -> Vec<&str> {
        self.numbered(group, name).into_iter().filter_map(Parameter::texts).flatten().map(String::as_str).collect()
    }

    /// The numbers of `group:name`, `name2`, `name3`, concatenated.
    pub fn numbers(&self, group: &str, name: &str) -> Vec<f64> {
        self.numbered(group, name).into_iter().filter_map(Parameter::numbers).flatten().collect()
    }

    /// Sets a parameter of the group with this name; the group is added if there is none.
    pub fn set(&mut self, group: &str, parameter: Parameter) {
        let parameters = &mut self.group_or_new(group).parameters;
        match parameters.iter_mut().find(|old| old.name.eq_ignore_ascii_case(&parameter.name)) {
            Some(old) => *old = parameter,
            None => parameters.push(parameter),
        }
    }

    /// Sets a group: replaces the one with the same name, or appends it.
    pub(crate) fn set_group(&mut self, group: Group) {
        let name = group.name.clone();
        *self.group_or_new(&name) = group;
    }

    fn group_or_new(&mut self, name: &str) -> &mut Group {
        let place = self.groups.iter().position(|group| group.name.eq_ignore_ascii_case(name));
        let place = place.unwrap_or_else(|| {
            self.groups.push(Group { name: name.into(), ..Group::default() });
            self.groups.len() - 1
        });
        &mut self.groups[place]
    }

    /// `group:name`, then `name2`, `name3`, up to the first that is missing.
    /// Counts of the format have 16 bits: 65535 values are 257 lists of 255.
    fn numbered(&self, group: &str, name: &str) -> Vec<&Parameter> {
        (1usize..=257).map_while(|number| self.get(group, &numbered_name(name, number))).collect()
    }
}

/// `LABELS`, `LABELS2`, `LABELS3` ...
pub(crate) fn numbered_name(name: &str, number: usize) -> String {
    if number == 1 { name.to_owned() } else { format!("{name}{number}") }
}

impl fmt::Display for Parameter {
    /// The values, separated by spaces, as in the file.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<String> = match &self.values {
            Values::Texts(texts) => texts.iter().map(|text| format!("\"{text}\"")).collect(),
            Values::Bytes(values) => values.iter().map(ToString::to_string).collect(),
            Values::Integers(values) => values.iter().map(ToString::to_string).collect(),
            Values::Reals(values) => values.iter().map(ToString::to_string).collect(),
        };
        f.write_str(&words.join(" "))
    }
}
