//! A skeleton in motion (`.bvh`), on the built-in body. No file of this kind has forces, a mass or a unit.

use super::{Origin, Reading, Recorded, coordinates, loaded};
use crate::args::ForcesArgs;
use crate::files;
use ambulo::analysis::feasibility::Person;
use ambulo::findings::Code;
use ambulo::kinematics::retarget::retarget;
use ambulo::model::anthropometry::Build;
use ambulo::motion::skeleton::skeleton_from_bvh;
use ambulo_formats::bvh::Bvh;
use ambulo_results::SubjectSummary;
use anyhow::{Context, Result, bail};

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Recorded> {
    let shown = args.input.display().to_string();
    refuse_what_has_no_use(args)?;
    let Some(mass) = args.subject.mass else {
        bail!("{shown}: a BVH states no body mass; expected --mass KG");
    };
    let (bvh, remarks) = Bvh::read(&files::read(&args.input)?).with_context(|| shown.clone())?;
    files::note_remarks(&shown, &remarks, &mut reading.findings);
    reading.clock.lap("read_skeleton");
    let skeleton =
        skeleton_from_bvh(&bvh, &shown, args.subject.height, &mut reading.findings).with_context(|| shown.clone())?;
    let table = args.subject.figure.parse().context("--figure")?;
    let build = Build { table, mass, height: skeleton.height_m, toe_joint: true };
    let body = retarget(&build, &skeleton, &mut reading.findings).with_context(|| shown.clone())?;
    reading.clock.lap("markers");
    if !args.no_ground {
        let message = "a BVH has no ground forces; they are predicted from the motion";
        reading.findings.report(Code::GroundPredicted, message);
    }
    Ok(Recorded {
        origin: Origin::Skeleton(Box::new(SubjectSummary::of_skeleton(&skeleton.statement, &body.fit))),
        plates: Vec::new(),
        mass_is_stated: true,
        input: coordinates::input(args, None),
        person: Person::of_human(&body.human),
        motion: body.fit.motion,
        model: loaded(body.human.model, args)?,
    })
}

fn refuse_what_has_no_use(args: &ForcesArgs) -> Result<()> {
    let given = [
        ("--model", args.model.is_some()),
        ("--grf", args.grf.is_some()),
        ("--loads", args.loads.is_some()),
        ("--static", args.subject.still.is_some()),
        ("--markers", args.subject.markers.is_some()),
        ("--plate", !args.subject.plate.is_empty()),
    ];
    match given.iter().find(|(_, given)| *given) {
        Some((option, _)) => bail!(
            "{}: {option} has no use for a .bvh, whose skeleton goes onto the built-in body and has no measured forces; expected --mass and --height",
            args.input.display()
        ),
        None => Ok(()),
    }
}
