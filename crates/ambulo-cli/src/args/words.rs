//! Words of a command line.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Words; each option and each value is one word.
pub(super) struct Words(pub(super) Vec<OsString>);

impl Words {
    pub(super) fn value(&mut self, option: &str, value: Option<impl ToString>) {
        self.0.extend(value.into_iter().flat_map(|value| [option.into(), value.to_string().into()]));
    }

    pub(super) fn path(&mut self, option: &str, path: Option<&PathBuf>) {
        self.0.extend(path.into_iter().flat_map(|path| [option.into(), path.clone().into_os_string()]));
    }

    pub(super) fn flag(&mut self, option: &str, is_given: bool) {
        self.0.extend(is_given.then(|| option.into()));
    }

    /// A file without an option; its name is never read as an option.
    pub(super) fn input(&mut self, path: &Path) {
        let is_like_an_option = path.as_os_str().as_encoded_bytes().starts_with(b"-");
        let path = if is_like_an_option { Path::new(".").join(path) } else { path.to_owned() };
        self.0.push(path.into_os_string());
    }
}

/// The words of a line as a shell would split them.
pub(super) fn split(line: &str) -> Vec<OsString> {
    let (mut words, mut word, mut quote) = (Vec::new(), None::<String>, None);
    for c in line.chars() {
        match quote {
            Some(mark) if c == mark => quote = None,
            Some(_) => word.get_or_insert_default().push(c),
            None if c == '"' || c == '\'' => {
                word.get_or_insert_default();
                quote = Some(c);
            }
            None if c.is_whitespace() => words.extend(word.take()),
            None => word.get_or_insert_default().push(c),
        }
    }
    words.extend(word);
    words.into_iter().map(OsString::from).collect()
}

/// A word as a shell takes it: in quotes if it has characters that are unusual in paths.
pub(super) fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./,:+@%=".contains(c);
    let mark = if cfg!(windows) { '"' } else { '\'' };
    match word.chars().all(is_plain) && !word.is_empty() {
        true => word.to_owned(),
        false => format!("{mark}{}{mark}", word.replace('\'', if cfg!(windows) { "'" } else { "'\\''" })),
    }
}
