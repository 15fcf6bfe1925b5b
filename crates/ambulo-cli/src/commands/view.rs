//! `ambulo view`: the page of a result folder in the browser.

use super::report::{PAGE, page_of_folders};
use crate::args::ViewArgs;
use crate::{Verdict, files, printer};
use anyhow::{Result, bail};
use std::path::{Path, PathBuf};

pub(crate) fn run(args: &ViewArgs) -> Result<Verdict> {
    let page = page(&args.page)?;
    // What a browser is given must not depend on the folder that it runs in.
    let page = page.canonicalize().unwrap_or(page);
    let opened = has_screen() && open::that_detached(&page).is_ok();
    printer::view(&page, opened, args.voice)?;
    Ok(Verdict::Accepted)
}

/// The page to be shown; a folder without one gets it.
fn page(asked: &Path) -> Result<PathBuf> {
    let shown = asked.display();
    if asked.is_dir() {
        let page = asked.join(PAGE);
        if !page.is_file() {
            files::write(&page, page_of_folders(&[asked])?.as_bytes())?;
        }
        return Ok(page);
    }
    match files::ending(asked).as_str() {
        _ if !asked.exists() => {
            bail!("{shown}: there is no such file or folder. hint: `ambulo demo -o demo`, then `ambulo view demo`")
        }
        "html" | "htm" => Ok(asked.to_owned()),
        "c3d" | "trc" | "bvh" => bail!(
            "{shown}: this is a recording and no page; expected a result folder or .html. hint: `ambulo forces {shown} -o out`, then `ambulo view out`"
        ),
        _ => bail!("{shown}: this is no page; expected a result folder or .html"),
    }
}

/// Whether a browser could show anything: on Linux a terminal may have no screen, and would get a text browser in its place.
fn has_screen() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let declined = std::env::var_os("BROWSER").is_some_and(|browser| browser == "none");
    !declined && (!cfg!(target_os = "linux") || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY"))
}
