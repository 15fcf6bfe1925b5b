//! `ambulo view`: opens the page of a result folder in the browser.

use super::report::write_page;
use super::result_folder::{ResultFolder, read_checked};
use crate::args::Existing;
use crate::args::ViewArgs;
use crate::{Completion, printer};
use ambulo::job::ending;
use ambulo_results::{PAGE, SESSION_PAGE};
use anyhow::{Result, bail};
use std::path::{Path, PathBuf};

pub(crate) fn run(args: &ViewArgs) -> Result<Completion> {
    let page = page(&args.page)?;
    // The browser may run in another folder.
    let page = page.canonicalize().unwrap_or(page);
    let opened = has_screen() && open(&page);
    printer::view(&page, opened, args.print)?;
    Ok(Completion::Passed)
}

/// The page to open; it is written if a result folder has none.
fn page(path: &Path) -> Result<PathBuf> {
    let shown = path.display();
    if path.is_dir() {
        let folder = ResultFolder::of_any_run(path)?;
        if folder.has(SESSION_PAGE) {
            _ = folder.checked(SESSION_PAGE)?;
            return Ok(path.join(SESSION_PAGE));
        }
        let page = path.join(PAGE);
        match page.is_file() {
            true => _ = folder.checked(PAGE)?,
            false => write_page(&[path], Existing::Kept)?,
        }
        return Ok(page);
    }
    match ending(path).as_str() {
        _ if !path.exists() => {
            bail!("{shown}: there is no such file or folder. hint: `ambulo demo -o demo`, then `ambulo view demo`")
        }
        "html" | "htm" => read_checked(path).map(|_| path.to_owned()),
        "c3d" | "trc" | "bvh" => bail!(
            "{shown}: this is a recording, not a page; expected a result folder or .html. hint: `ambulo forces {shown} \
             -o out`, then `ambulo view out`"
        ),
        _ => bail!("{shown}: this is not a page; expected a result folder or .html"),
    }
}

/// Opens a page in the browser; returns whether one was found.
#[cfg(not(target_family = "wasm"))]
fn open(page: &Path) -> bool {
    open::that_detached(page).is_ok()
}

/// Inside a browser there is none to start.
#[cfg(target_family = "wasm")]
fn open(_: &Path) -> bool {
    false
}

/// Whether a browser could show a page. On Linux without a display, a text browser would open in the terminal.
fn has_screen() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let declined = std::env::var_os("BROWSER").is_some_and(|browser| browser == "none");
    !declined && (!cfg!(target_os = "linux") || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY"))
}
