//! `ambulo info`: describes the content of a file.

mod arrays;
mod bids;
mod bvh;
mod c3d;
mod markers;
mod model;
mod mvnx;
mod sensors;
mod sheet;
mod subject;
mod table;
mod template;

pub(crate) use sheet::Sheet;

use crate::args::InfoArgs;
use crate::{Completion, files, printer};
use ambulo::job::ending;
use ambulo_formats::external_loads::ExternalLoads;
use anyhow::{Context, Result, bail};
use std::path::Path;

pub(crate) fn run(args: &InfoArgs) -> Result<Completion> {
    let ending = ending(&args.file);
    // Of a .b3d only the header is read, and a BIDS motion is several files.
    if ["b3d", "tsv"].contains(&ending.as_str()) {
        if args.markers.is_some() {
            let shown = args.file.display();
            bail!("{shown}: --markers writes the marker set of a .c3d or .trc; a .{ending} lists its markers");
        }
        let sheet = if ending == "b3d" { subject::describe(&args.file) } else { bids::describe(&args.file) };
        printer::info(&sheet?, args.print)?;
        return Ok(Completion::Passed);
    }
    let bytes = files::read(&args.file)?;
    let mut sheet = describe(&args.file, &bytes).with_context(|| args.file.display().to_string())?;
    if let Some(target) = &args.markers {
        sheet.text("template", &template::write(args, target, &bytes)?);
    }
    printer::info(&sheet, args.print)?;
    Ok(Completion::Passed)
}

fn describe(path: &Path, bytes: &[u8]) -> Result<Sheet> {
    match ending(path).as_str() {
        "c3d" => c3d::describe(path, bytes),
        "trc" => markers::describe_trc(path, bytes),
        "bvh" => bvh::describe(path, bytes),
        "mvnx" => mvnx::describe(path, bytes),
        "npz" => arrays::describe(path, bytes),
        "osim" => model::describe(path, bytes),
        "mot" | "sto" => table::describe_storage(path, bytes),
        "csv" => table::describe_csv(path, bytes),
        "xml" => loads(bytes),
        ending => bail!(
            "unknown kind of file `.{ending}`; expected .c3d, .trc, .bvh, .mvnx, .npz, .b3d, _motion.tsv, .osim, .mot, \
             .sto, .csv or .xml (external loads)"
        ),
    }
}

fn loads(bytes: &[u8]) -> Result<Sheet> {
    let (loads, remarks) = ExternalLoads::read(bytes)?;
    let forces: Vec<String> = loads
        .forces
        .iter()
        .map(|f| {
            let columns = f.force_identifier.as_deref().unwrap_or("no columns");
            let switch = if f.enabled { "" } else { ", switched off" };
            format!("{}: {columns} on {}{switch}", f.name, f.applied_to_body)
        })
        .collect();
    let mut sheet = Sheet::of("external loads");
    sheet.text("name", &loads.name);
    sheet.value("data_file", loads.datafile);
    sheet.list("forces", forces);
    sheet.remarks(&remarks);
    Ok(sheet)
}
