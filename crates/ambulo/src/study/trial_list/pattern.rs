//! Patterns of paths: `?` is one letter, `*` any part of a name, `**` any part of a path, `**/` any folders or none.

use std::fmt;

/// A pattern.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    text: String,
    parts: Vec<Part>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Letter(char),
    AnyLetter,
    Name,
    Path,
    Folders,
}

impl fmt::Display for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Pattern {
    /// Reads a pattern; any text is one.
    pub fn new(text: &str) -> Pattern {
        let (mut parts, mut rest) = (Vec::new(), text);
        while let Some(letter) = rest.chars().next() {
            let known = [("**/", Part::Folders), ("**", Part::Path), ("*", Part::Name), ("?", Part::AnyLetter)];
            let found = known.into_iter().find(|(sign, _)| rest.starts_with(sign));
            let (length, part) =
                found.map_or((letter.len_utf8(), Part::Letter(letter)), |(sign, part)| (sign.len(), part));
            parts.push(part);
            rest = &rest[length..];
        }
        Pattern { text: text.to_owned(), parts }
    }

    /// Whether a whole path fits. All places of the pattern that the letters so far can have reached are followed
    /// together, so that the cost is at most the length of the pattern times the length of the path.
    pub fn matches(&self, path: &str) -> bool {
        let mut reached = vec![false; self.parts.len() + 1];
        self.reach(&mut reached, 0);
        for letter in path.chars() {
            let mut next = vec![false; reached.len()];
            for (place, part) in self.parts.iter().enumerate().filter(|(place, _)| reached[*place]) {
                match part {
                    Part::Letter(own) if *own == letter => self.reach(&mut next, place + 1),
                    Part::AnyLetter if letter != '/' => self.reach(&mut next, place + 1),
                    Part::Name if letter != '/' => self.reach(&mut next, place),
                    Part::Path => self.reach(&mut next, place),
                    Part::Folders => {
                        if letter == '/' {
                            self.reach(&mut next, place + 1);
                        }
                        next[place] = true;
                    }
                    _ => {}
                }
            }
            reached = next;
        }
        reached[self.parts.len()]
    }

    /// Marks a place, and those behind parts that may be empty.
    fn reach(&self, reached: &mut [bool], mut place: usize) {
        let may_be_empty = |part: &Part| matches!(part, Part::Name | Part::Path | Part::Folders);
        // Places behind one that was reached before are marked already.
        while !std::mem::replace(&mut reached[place], true) && self.parts.get(place).is_some_and(may_be_empty) {
            place += 1;
        }
    }
}
