//! Recordings of gait laboratories with Plug-in-Gait's results.
//!
//! The files are not part of the repository. They are searched in `shared/data` next to it, or in `$AMBULO_DATA/data`.

pub(crate) use crate::shared_data::data as folder;
use ambulo::findings::Findings;
use ambulo::kinematics::calibration::{BodyMeasurements, PersonMeasurements};
use ambulo::model::Side;
use ambulo::model::anthropometry::SegmentTable;
use ambulo::motion::{MarkerRecording, markers_from_c3d};
use ambulo::spatial::{Mat3, Vec3};
use ambulo_formats::c3d::C3d;
use std::path::Path;

/// A subject: a standing trial and a walk.
pub(crate) struct Subject {
    pub(crate) name: &'static str,
    pub(crate) standing: File,
    pub(crate) walk: File,
    pub(crate) person: PersonMeasurements,
}

/// A C3D file and its markers in world axes.
pub(crate) struct File {
    pub(crate) c3d: C3d,
    pub(crate) markers: MarkerRecording,
}

/// All three laboratories are z up, walking along +y.
pub(crate) fn world_from_lab() -> Mat3 {
    Mat3::from_rows(&[Vec3::y().transpose(), Vec3::z().transpose(), Vec3::x().transpose()])
}

impl File {
    fn read(path: &Path) -> File {
        let (c3d, _) = C3d::read(&std::fs::read(path).unwrap()).unwrap();
        let markers = markers_from_c3d(&c3d, &mut Findings::default()).unwrap().rotated(&world_from_lab());
        File { c3d, markers }
    }

    /// A number of the group PROCESSING, unchanged.
    pub(crate) fn processing(&self, name: &str) -> Option<f64> {
        self.c3d.parameters.get("PROCESSING", name)?.numbers()?.first().copied()
    }

    /// A computed point of the file in world axes [m].
    pub(crate) fn point(&self, name: &str) -> Vec<Vec3> {
        let point = self.c3d.point(name).unwrap_or_else(|| panic!("no point {name}"));
        point.positions.iter().map(|p| world_from_lab() * Vec3::from(*p) * 1e-3).collect()
    }

    /// The first of Plug-in-Gait's three angles, such as flexion [deg].
    pub(crate) fn angle(&self, name: &str, side: Side) -> Option<Vec<f64>> {
        let name = format!("{}{name}", if side == Side::Right { "R" } else { "L" });
        // Some files name them LHipAnglesV, with V the version of the model.
        let point = self.c3d.point(&name).or_else(|| self.c3d.point(&format!("{name}V")))?;
        Some(point.positions.iter().map(|p| p[0]).collect())
    }
}

fn subject(name: &'static str, table: SegmentTable, standing: &str, walk: &str) -> Option<Subject> {
    let folder = folder()?;
    let [standing, walk] = [standing, walk].map(|file| File::read(&folder.join(file)));
    let mass = standing.processing("Bodymass").unwrap();
    let height = standing.processing("Height").map(|mm| 0.001 * mm);
    let measurements = BodyMeasurements::from_processing(|name| standing.processing(name));
    Some(Subject { name, standing, walk, person: PersonMeasurements { table, mass, height, measurements } })
}

pub(crate) fn woman() -> Option<Subject> {
    let folder = "biomechzoo-HC032A";
    let [standing, walk] = ["HC032A01.c3d", "HC032A03.c3d"].map(|file| format!("{folder}/{file}"));
    subject("HC032A", SegmentTable::DeLevaFemale, &standing, &walk)
}

pub(crate) fn child() -> Option<Subject> {
    let folder = "biomechzoo-HC002D";
    let [standing, walk] = ["HC002D02.c3d", "HC002D06.c3d"].map(|file| format!("{folder}/{file}"));
    subject("HC002D", SegmentTable::DeLevaFemale, &standing, &walk)
}

pub(crate) fn adult() -> Option<Subject> {
    let folder = "btkdata-pig-adult3plates";
    let [standing, walk] = ["PiG_Calibration3_FF.c3d", "PiG_Motion3_FF.c3d"].map(|file| format!("{folder}/{file}"));
    subject("PiG adult", SegmentTable::DeLevaMale, &standing, &walk)
}

/// Walks with a turn of about 45 degrees, of the woman and of the child.
pub(crate) fn turning() -> Vec<Subject> {
    let read =
        |subject: Option<Subject>, walk: &str| Some(Subject { walk: File::read(&folder()?.join(walk)), ..subject? });
    let walks = [read(woman(), "biomechzoo-HC032A/HC032A18.c3d"), read(child(), "biomechzoo-HC002D/HC002D25.c3d")];
    walks.into_iter().flatten().collect()
}

pub(crate) fn everyone() -> Vec<Subject> {
    [woman(), child(), adult()].into_iter().flatten().collect()
}
