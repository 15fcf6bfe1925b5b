//! Which columns of which file are the ground forces, from what the user typed.

use crate::args::{FootColumns, ForcesArgs};
use crate::files;
use ambulo::findings::{Code, Findings};
use ambulo::model::{BySide, Model};
use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use ambulo_formats::table::Table;
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};

/// Measured ground forces as a table, and what its columns mean.
pub(super) struct GroundTable {
    pub(super) path: PathBuf,
    pub(super) table: Table,
    pub(super) loads: ExternalLoads,
}

/// Column prefixes that laboratories use, right and left; tried in this order when nothing was said.
const USUAL_PREFIXES: [(&str, &str); 4] = [
    ("ground_force_r_", "ground_force_l_"),
    ("R_ground_force_", "L_ground_force_"),
    ("ground_force_", "1_ground_force_"),
    ("ground_force_", "l_ground_force_"),
];

pub(super) fn read(args: &ForcesArgs, model: &Model, findings: &mut Findings) -> Result<GroundTable> {
    let loads = args.loads.as_deref().map(|path| read_loads(path, findings)).transpose()?;
    let path = match (&args.grf, &loads) {
        (Some(path), _) => path.clone(),
        (None, Some(loads)) => data_file(args.loads.as_deref(), loads)?,
        (None, None) => {
            bail!("no ground forces were given; expected --grf FILE with --loads XML or --right and --left")
        }
    };
    let (table, remarks) = files::read_table(&path)?;
    files::note_remarks(&path.display().to_string(), &remarks, findings);
    let loads = match loads {
        Some(loads) => loads,
        None if args.right.is_some() || args.left.is_some() => named(args),
        None => usual(model, &table, &path, findings)?,
    };
    Ok(GroundTable { path, table, loads })
}

fn read_loads(path: &Path, findings: &mut Findings) -> Result<ExternalLoads> {
    let shown = path.display().to_string();
    let (loads, remarks) = ExternalLoads::read(&files::read(path)?).with_context(|| shown.clone())?;
    files::note_remarks(&shown, &remarks, findings);
    Ok(loads)
}

/// The data file that the loads name: relative to them, or else a file of that name beside them.
fn data_file(xml: Option<&Path>, loads: &ExternalLoads) -> Result<PathBuf> {
    let Some(named) = &loads.datafile else {
        bail!("the external loads name no <datafile>; expected --grf FILE");
    };
    let folder = xml.and_then(Path::parent).unwrap_or(Path::new(""));
    let named = Path::new(named);
    let beside = named.file_name().map(|name| folder.join(name));
    let candidates = [Some(folder.join(named)), beside];
    match candidates.into_iter().flatten().find(|path| path.is_file()) {
        Some(path) => Ok(path),
        None => bail!(
            "the external loads name the data file `{}`, which is not there. hint: give it with --grf",
            named.display()
        ),
    }
}

fn named(args: &ForcesArgs) -> ExternalLoads {
    let feet = [("right", &args.right), ("left", &args.left)];
    let forces = feet.into_iter().filter_map(|(side, foot)| {
        foot.as_ref().map(|FootColumns { body, prefix }| ExternalForce::with_prefix(side, body, prefix))
    });
    ExternalLoads { name: "feet".into(), datafile: None, forces: forces.collect() }
}

/// Usual prefixes on the model's feet; what was taken is a finding.
fn usual(model: &Model, table: &Table, path: &Path, findings: &mut Findings) -> Result<ExternalLoads> {
    let has = |prefix: &str| table.column(&format!("{prefix}vx")).is_some();
    let columns = USUAL_PREFIXES.iter().find(|(right, left)| has(right) && has(left));
    let feet = model.anatomy().feet().map(|feet| feet.map(|body| model.bodies()[body.index()].name.as_str()));
    let (Some((right_prefix, left_prefix)), Some(BySide { right: right_foot, left: left_foot })) = (columns, feet)
    else {
        bail!(
            "{}: the columns of the two feet were not recognised among {}. hint: name them with --right BODY:PREFIX and --left BODY:PREFIX, or give --loads XML",
            path.display(),
            table.names().join(", ")
        );
    };
    let message =
        format!("taken as ground forces: `{right_prefix}...` on {right_foot}, `{left_prefix}...` on {left_foot}");
    findings.report(Code::LoadsGuessed, message);
    let forces = vec![
        ExternalForce::with_prefix("right", right_foot, right_prefix),
        ExternalForce::with_prefix("left", left_foot, left_prefix),
    ];
    Ok(ExternalLoads { name: "feet".into(), datafile: None, forces })
}
