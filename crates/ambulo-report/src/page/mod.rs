//! The report page: one offline HTML file, made from the files of a result folder.
//!
//! [`Folder`] reads the files, `session` turns them into the content of the page, `block` stores the numbers, `shell`
//! puts data and the viewer's bundle into one file. The bundle is built from `viewer/` (`npm run build` there) and
//! committed, so that no Rust build needs npm.

mod block;
mod contract;
mod live;
pub(crate) mod session;
mod shell;
#[cfg(feature = "contract")]
pub(crate) mod typescript;
mod view;

use ambulo_results::{Folder, ResultsError};
use contract::FORMAT;

pub use block::Block;
pub use contract::*;
pub use live::live_page;

/// Writes `report.html` for a folder, compared with up to two other folders.
///
/// # Errors
/// A folder without a `summary.json` of this program; a table that cannot be read.
pub fn report_page(folders: &[Folder<'_>]) -> Result<String, ResultsError> {
    let mut block = Block::default();
    let mut sessions =
        folders.iter().map(|folder| session::session(folder, &mut block)).collect::<Result<Vec<_>, _>>()?;
    if folders.len() > 1 {
        // Several runs may belong to one recording, so they are named by their folders.
        for (session, folder) in sessions.iter_mut().zip(folders) {
            session.name.clone_from(&folder.name);
        }
    }
    let title = sessions.iter().map(|session| session.name.as_str()).collect::<Vec<_>>().join(" / ");
    let page = Page { format: FORMAT, program: env!("CARGO_PKG_VERSION").to_owned(), title, sessions };
    shell::html(&page, &block, shell::Kind::Report)
}
