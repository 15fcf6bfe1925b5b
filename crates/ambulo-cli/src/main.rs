//! The `ambulo` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(ambulo_cli::command(std::env::args_os()))
}
