//! Size and shape of the product's source: `cargo xtask house [--baseline REV] [--list] [--wrap]`.
//!
//! Product is `crates/*/src` without items for tests; `xtask` and `viewer` are not counted. A function's lines run from
//! its signature to its closing brace. A private function is a free function without `pub`. Long lines are counted in
//! tests and `xtask`, too.

mod columns;
mod imports;
mod items;
mod pinned;
mod source;
mod surface;
pub(crate) mod tokens;

use crate::workspace::{self, Revision};
use columns::MOST_COLUMNS;
use items::{Function, Reach};
use source::{Crate, File};
use std::fs;
use std::path::Path;
use surface::{MOST_UNNAMED_FUNCTIONS, MOST_UNNAMED_TYPES, Public};
use tokens::Token;

/// Longest function that is allowed.
const LONGEST_FUNCTION: usize = 60;
/// Most long lines that are listed without `--list`.
const MOST_SHOWN: usize = 20;
/// Most lines of a crate, and of a module: a folder or a file in its `src`.
const LARGEST_CRATE: usize = 45_000;
const LARGEST_MODULE: usize = 13_000;

/// What is measured of a tree.
#[derive(Debug, Default)]
struct House {
    lines: usize,
    code_lines: usize,
    files: usize,
    types: usize,
    /// The crate and the module with most lines, tests included.
    largest_crate: Part,
    largest_module: Part,
    /// Lines of each function, sorted.
    function_lines: Vec<usize>,
    /// Functions above [`LONGEST_FUNCTION`], with place and lines.
    long_functions: Vec<String>,
    private_functions: usize,
    /// Private functions that are called once, with their place.
    called_once: Vec<String>,
    public_types: Public,
    public_functions: Public,
    /// Files of each circle.
    circles: Vec<String>,
    /// Test files that no test program contains.
    forgotten_tests: Vec<String>,
    /// Tests that comments name and that do not exist.
    missing_tests: Vec<String>,
    /// Lines over [`MOST_COLUMNS`].
    long_lines: Vec<String>,
}

/// A crate or a module by its path below `crates/`.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Part {
    lines: usize,
    path: String,
}

/// Measures the tree, and a revision next to it; fails where the tree exceeds a limit.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let mut words = words.iter().map(String::as_str);
    let (mut baseline, mut listed) = (None, false);
    while let Some(word) = words.next() {
        match word {
            "--baseline" => baseline = Some(words.next().ok_or("--baseline needs a revision, such as a commit")?),
            "--list" => listed = true,
            "--wrap" => wrap(&workspace::root())?,
            other => {
                return Err(format!(
                    "unknown option `{other}`\nhint: cargo xtask house [--baseline REV] [--list] [--wrap]"
                ));
            }
        }
    }
    let now = House::measure(&workspace::root())?;
    let before = match baseline {
        Some(revision) => Some((revision, House::measure(Revision::unpack(revision)?.folder())?)),
        None => None,
    };
    print!("{}", table(&now, before.as_ref().map(|(name, house)| (*name, house))));
    let [of_crates, of_modules] = [&now.largest_crate, &now.largest_module];
    println!(
        "\nlargest crate: {}, {} lines; largest module: {}, {} lines",
        of_crates.path, of_crates.lines, of_modules.path, of_modules.lines
    );
    print_list("functions over 60 lines", &now.long_functions);
    print_list("circles of files", &now.circles);
    print_list("test files that are not a module of tests/main.rs", &now.forgotten_tests);
    print_list("tests that a comment names (\"Pinned by\") and that do not exist", &now.missing_tests);
    let shown = if listed { now.long_lines.len() } else { now.long_lines.len().min(MOST_SHOWN) };
    print_list("lines over 120 columns (--list: all of them)", &now.long_lines[..shown]);
    if listed {
        print_list("private functions called once", &now.called_once);
        print_list("public types that no other crate names", &now.public_types.unnamed);
        print_list("public functions that no other crate names", &now.public_functions.unnamed);
    }
    now.judge()
}

#[expect(clippy::print_stdout, reason = "the lists are the command's result")]
fn print_list(title: &str, places: &[String]) {
    if !places.is_empty() {
        println!("\n{title}:\n  {}", places.join("\n  "));
    }
}

/// Breaks long comments and texts of all Rust source. Run `cargo fmt` afterwards.
fn wrap(workspace: &Path) -> Result<(), String> {
    for file in source::all(workspace)? {
        let text = columns::wrapped(&file.text).map_err(|e| format!("{}: {e}", file.path))?;
        if text != file.text {
            fs::write(workspace.join(&file.path), text).map_err(|e| format!("{}: cannot write: {e}", file.path))?;
        }
    }
    Ok(())
}

impl House {
    fn measure(workspace: &Path) -> Result<House, String> {
        let mut house = House::default();
        let crates = source::crates(workspace)?;
        for one in &crates {
            house.add(one);
        }
        [house.public_types, house.public_functions] = surface::public(&crates, &source::users(workspace)?);
        house.function_lines.sort_unstable();
        house.forgotten_tests = source::forgotten_tests(workspace)?;
        let all = source::all(workspace)?;
        house.missing_tests = pinned::missing(workspace, &all);
        for file in all {
            let lines = columns::long_lines(&file.text).into_iter();
            house.long_lines.extend(lines.map(|line| format!("{}:{line}", file.path)));
        }
        Ok(house)
    }

    fn add(&mut self, one: &Crate) {
        let (whole, modules) = parts(one);
        self.largest_crate = whole.max(std::mem::take(&mut self.largest_crate));
        self.largest_module =
            modules.into_iter().max().unwrap_or_default().max(std::mem::take(&mut self.largest_module));
        let all: Vec<Vec<Token<'_>>> = one.files.iter().map(|file| tokens::tokens(&file.text)).collect();
        let product: Vec<Vec<Token<'_>>> = all.iter().map(|tokens| tokens::without_tests(tokens)).collect();
        let place = |file: &File| format!("crates/{}/src/{}", one.name, file.path);
        for (i, file) in one.files.iter().enumerate() {
            self.files += 1;
            self.lines += file.text.lines().count();
            self.code_lines += code_lines(&all[i]);
            self.types += items::types(&product[i]).len();
            for function in items::functions(&product[i]) {
                self.function_lines.push(function.lines);
                let at = format!("{}:{} {}", place(file), function.line, function.name);
                if function.lines > LONGEST_FUNCTION {
                    self.long_functions.push(format!("{at}: {} lines", function.lines));
                }
                if function.reach == Reach::PrivateFree {
                    self.private_functions += 1;
                    if calls_within(&one.files, &product, i, &function) == 1 {
                        self.called_once.push(at);
                    }
                }
            }
        }
        for circle in imports::circles(&one.files, &product) {
            let path = |i: usize| one.files[i].path.as_str();
            let files: Vec<&str> = circle.files.iter().map(|&i| path(i)).collect();
            let uses = circle
                .uses
                .iter()
                .map(|(user, used, name)| format!("\n    {} uses {name} of {}", path(*user), path(*used)));
            self.circles.push(format!("{}: {}{}", one.name, files.join(" "), uses.collect::<String>()));
        }
    }

    /// An error if the tree exceeds a limit.
    fn judge(&self) -> Result<(), String> {
        let (long, circles) = (self.long_functions.len(), self.circles.len());
        if !self.forgotten_tests.is_empty() {
            return Err(
                "there are test files that never run\nhint: name them in the `tests/main.rs` next to them".to_owned()
            );
        }
        if !self.missing_tests.is_empty() {
            return Err(format!(
                "comments name {} tests that do not exist\nhint: name the file that has the test now; paths begin at \
                 the crate, at crates/ambulo or at crates",
                self.missing_tests.len()
            ));
        }
        for (part, what, most) in
            [(&self.largest_crate, "crate", LARGEST_CRATE), (&self.largest_module, "module", LARGEST_MODULE)]
        {
            if part.lines > most {
                let Part { lines, path } = part;
                return Err(format!(
                    "the {what} {path} has {lines} lines (allowed: {most})\nhint: give what it does besides its main \
                     duty a {what} of its own"
                ));
            }
        }
        if !self.long_lines.is_empty() {
            return Err(format!(
                "{} lines have more than {MOST_COLUMNS} columns\nhint: `cargo xtask house --wrap`, then `cargo fmt \
                 --all`; break the others by hand",
                self.long_lines.len()
            ));
        }
        if long > 0 || circles > 0 {
            return Err(format!(
                "{long} functions have more than {LONGEST_FUNCTION} lines (allowed: 0), {circles} circles of files \
                 (allowed: 0)\nhint: the lists above name them; divide the functions, or move what two files share \
                 into a third"
            ));
        }
        self.public_types.judge("types", MOST_UNNAMED_TYPES)?;
        self.public_functions.judge("functions", MOST_UNNAMED_FUNCTIONS)
    }

    /// The names and values of the table's rows.
    fn rows(&self) -> [(&'static str, usize); 17] {
        let share = |share: f64| {
            let last = self.function_lines.len().saturating_sub(1);
            self.function_lines.get((last as f64 * share).round() as usize).copied().unwrap_or(0)
        };
        [
            ("lines", self.lines),
            ("code lines", self.code_lines),
            ("files", self.files),
            ("types", self.types),
            ("lines of the largest crate", self.largest_crate.lines),
            ("lines of the largest module", self.largest_module.lines),
            ("functions", self.function_lines.len()),
            ("function lines, median", share(0.5)),
            ("function lines, p90", share(0.9)),
            ("function lines, longest", share(1.0)),
            ("functions over 60 lines", self.long_functions.len()),
            ("public types that no other crate names [%]", self.public_types.unnamed_percent()),
            ("public functions that no other crate names [%]", self.public_functions.unnamed_percent()),
            ("private functions", self.private_functions),
            ("private functions called once", self.called_once.len()),
            ("circles of files", self.circles.len()),
            ("lines over 120 columns", self.long_lines.len()),
        ]
    }
}

/// A crate and its modules.
fn parts(one: &Crate) -> (Part, Vec<Part>) {
    let mut modules = std::collections::BTreeMap::<&str, usize>::new();
    for file in &one.files {
        let module = file.path.split(['/', '.']).next().unwrap_or_default();
        *modules.entry(module).or_default() += file.text.lines().count();
    }
    let whole = Part { lines: modules.values().sum(), path: one.name.clone() };
    let part = |(module, lines)| Part { lines, path: format!("{}/src/{module}", one.name) };
    (whole, modules.into_iter().map(part).collect())
}

/// Lines with at least one token: neither blank nor only comment.
fn code_lines(tokens: &[Token<'_>]) -> usize {
    let (mut count, mut counted_to) = (0, 0);
    for token in tokens {
        let first = token.line.max(counted_to + 1);
        count += (token.last_line + 1).saturating_sub(first);
        counted_to = counted_to.max(token.last_line);
    }
    count
}

/// Calls of a private function of file `own`, in that file and in the modules inside.
fn calls_within(files: &[File], tokens: &[Vec<Token<'_>>], own: usize, function: &Function) -> usize {
    let module = files[own].module();
    let inside = files.iter().zip(tokens).filter(|(file, _)| file.module().starts_with(&module));
    inside.map(|(_, tokens)| items::calls(tokens, &function.name)).sum()
}

/// The measured values, with the change where there is a baseline.
fn table(now: &House, before: Option<(&str, &House)>) -> String {
    let mut text = String::new();
    let rows = now.rows();
    let mut line = |cells: [&str; 4]| {
        let [name, was, is, change] = cells;
        let row = match before {
            Some(_) => format!("{name:<46} {was:>12} {is:>10} {change:>10}"),
            None => format!("{name:<46} {is:>10}"),
        };
        text.push_str(row.trim_end());
        text.push('\n');
    };
    line(["", before.map_or("", |(name, _)| name), "this tree", "change"]);
    let earlier = before.map(|(_, house)| house.rows());
    for (i, (name, value)) in rows.iter().enumerate() {
        let was = earlier.map_or(*value, |earlier| earlier[i].1);
        let change = *value as i64 - was as i64;
        line([name, &was.to_string(), &value.to_string(), &format!("{change:+}")]);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_lines_are_those_with_code() {
        let source = "//! Head.\n\nfn f() {\n    // why\n    let a = \"x\n  y\";\n} fn g() {}\n";
        assert_eq!(code_lines(&tokens::tokens(source)), 4);
    }

    #[test]
    fn a_long_function_or_a_circle_exceeds_the_limits() {
        assert!(House::default().judge().is_ok());
        let house = House { circles: vec!["a b".to_owned()], ..House::default() };
        assert!(house.judge().is_err());
        let house = House { long_functions: vec!["f: 61 lines".to_owned()], ..House::default() };
        assert!(house.judge().is_err_and(|message| message.starts_with("1 functions have more than 60 lines")));
        let house = House { missing_tests: vec!["a.rs:1 tests/b.rs".to_owned()], ..House::default() };
        assert!(house.judge().is_err_and(|message| message.starts_with("comments name 1 tests that do not exist")));
        let house = House { long_lines: vec!["a.rs:1".to_owned()], ..House::default() };
        assert!(house.judge().is_err_and(|message| message.starts_with("1 lines have more than 120 columns")));
    }

    #[test]
    fn a_large_crate_or_module_exceeds_the_limits() {
        let file = |path: &str, lines: usize| File { path: path.to_owned(), text: "//\n".repeat(lines) };
        let one = Crate {
            name: "a".to_owned(),
            files: vec![file("lib.rs", 2), file("b/mod.rs", LARGEST_MODULE), file("b/c.rs", 1), file("d.rs", 5)],
        };
        let mut house = House::default();
        house.add(&one);
        assert_eq!(house.largest_crate, Part { lines: LARGEST_MODULE + 8, path: "a".to_owned() });
        assert_eq!(house.largest_module, Part { lines: LARGEST_MODULE + 1, path: "a/src/b".to_owned() });
        assert!(house.judge().is_err_and(|message| message.starts_with("the module a/src/b has 13001 lines")));
        house.largest_module.lines = LARGEST_MODULE;
        assert!(house.judge().is_ok());
        house.largest_crate.lines = LARGEST_CRATE + 1;
        assert!(house.judge().is_err_and(|message| message.starts_with("the crate a has 45001 lines")));
    }

    #[test]
    fn the_table_shows_the_change() {
        let [mut now, mut before] = [House::default(), House::default()];
        (now.lines, before.lines) = (90, 100);
        let text = table(&now, Some(("v1", &before)));
        assert!(
            text.contains("lines                                                   100         90        -10"),
            "{text}"
        );
    }
}
