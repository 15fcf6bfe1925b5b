//! Reports a panic for what it is: a bug in Ambulo.

use std::io::Write;

/// From now on, a panic prints what to do and ends the program with exit code 2, as every other failure.
pub fn install() {
    std::panic::set_hook(Box::new(|panic| {
        // Standard error may be closed, which is no reason to panic again.
        let _ = writeln!(std::io::stderr(), "{}", message(&panic.to_string()));
        std::process::exit(2);
    }));
}

fn message(panic: &str) -> String {
    format!(
        "error: this is a bug in ambulo {}: {panic}\n  hint: report it at {}/issues with this message, the command \
         that you typed and, if possible, its input files",
        env!("AMBULO_VERSION"),
        env!("CARGO_PKG_REPOSITORY"),
    )
}
