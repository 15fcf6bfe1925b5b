//! Sagittal joint moments of seven children at the default settings, compared with those of Plug-in-Gait in the same
//! C3D files (group POINT, `RHipMoment` and its like, N.mm/kg although the unit field states N.mm), while each foot is
//! on its plate.
//!
//! `cargo test -p ambulo plug_in_gait -- --show-output` prints the comparison, with other filters of the forces as
//! well.

use crate::memo::Memo;
use crate::shared_data;
use ambulo::findings::Findings;
use ambulo::model::Side;
use ambulo::model::anthropometry::SegmentTable;
use ambulo::motion::filter::LowPass;
use ambulo::motion::interpolate;
use ambulo::study::{
    self, ForceFilter, LaboratoryFile, MarkerBody, MarkerSource, Outcome, Settings, Source, StandingTrial, Tracking,
};
use ambulo_formats::c3d::C3d;
use std::path::Path;
use std::sync::Arc;

/// A person with a standing trial and a straight walk.
pub(crate) struct Person {
    pub(crate) name: &'static str,
    standing: &'static str,
    walk: &'static str,
    mass_kg: f64,
    height_m: f64,
}

const fn person(name: &'static str, trials: [&'static str; 2], mass_kg: f64, height_m: f64) -> Person {
    Person { name, standing: trials[0], walk: trials[1], mass_kg, height_m }
}

pub(crate) const PEOPLE: [Person; 7] = [
    person("HC032A", ["01", "03"], 60.3, 1.58),
    person("HC002D", ["02", "06"], 32.1, 1.45),
    person("HC030A", ["01", "05"], 45.8, 1.48),
    person("HC031A", ["01", "06"], 27.7, 1.33),
    person("HC033A", ["01", "10"], 51.5, 1.605),
    person("HC036A", ["01", "10"], 33.0, 1.34),
    person("HC055A", ["01", "09"], 32.0, 1.44),
];

/// A joint: our coordinate, their point, the sign between them, and the limits of the mean over all legs: least r,
/// largest RMS difference [N.m/kg].
struct Joint {
    ours: &'static str,
    theirs: &'static str,
    sign: f64,
    least_r: f64,
    largest_rms: f64,
}

const JOINTS: [Joint; 3] = [
    Joint { ours: "hip_flexion", theirs: "HipMoment", sign: -1.0, least_r: 0.97, largest_rms: 0.13 },
    Joint { ours: "knee_angle", theirs: "KneeMoment", sign: 1.0, least_r: 0.955, largest_rms: 0.085 },
    Joint { ours: "ankle_angle", theirs: "AnkleMoment", sign: -1.0, least_r: 0.99, largest_rms: 0.085 },
];

/// Correlation and RMS difference [N.m/kg].
#[derive(Clone, Copy)]
pub(crate) struct Agreement {
    pub(crate) r: f64,
    pub(crate) rms: f64,
}

impl Person {
    fn file(&self, folder: &Path, trial: &str) -> Vec<u8> {
        let Person { name, .. } = self;
        std::fs::read(folder.join(format!("biomechzoo-{name}/{name}{trial}.c3d"))).unwrap()
    }

    /// The walk and the standing trial, read once in a process: its copies share the body of the standing trial, as
    /// the trials of a visit do.
    pub(crate) fn source(&self, folder: &Path) -> Source {
        static ALL: Memo<Source> = Memo::new();
        let read = |trial| LaboratoryFile::from_c3d(self.file(folder, trial), trial, &mut Findings::default()).unwrap();
        let (mass_kg, height_m) = (Some(self.mass_kg), Some(self.height_m));
        let make = || {
            Source::markers(MarkerSource {
                trial: read(self.walk),
                standing: Some(Arc::new(StandingTrial::new(read(self.standing)))),
                body: MarkerBody::BuiltIn { table: SegmentTable::DeLevaMale, mass_kg, height_m, set: None },
                plates: Vec::new(),
            })
        };
        ALL.get(self.name.to_owned(), make).clone()
    }

    /// The outcome at the default settings and its findings, computed once in a process.
    pub(crate) fn computed(&self, folder: &Path) -> &'static (Outcome, Findings) {
        static ALL: Memo<(Outcome, Findings)> = Memo::new();
        ALL.get(self.name.to_owned(), || {
            let mut findings = Findings::default();
            (study::run(self.source(folder), &Settings::default(), &mut findings).unwrap(), findings)
        })
    }

    /// One joint of one leg while its foot is on a plate.
    fn agreement(&self, outcome: &Outcome, walk: &C3d, joint: &Joint, side: Side) -> Agreement {
        let Some(Tracking::Markers(tracked)) = &outcome.tracking else { panic!("no markers") };
        let stances = tracked.body.on_plates.measured_stances(side);
        let is_on_plate = |t: f64| stances.iter().any(|[from, to]| (*from..=*to).contains(&t));
        let id = outcome.body.coordinate(&format!("{}_{}", joint.ours, side.letter())).unwrap();
        let (grid, column) = (outcome.analysis.trajectory.grid(), &outcome.analysis.forces.generalized[id.index()]);
        let letter = if side == Side::Right { "R" } else { "L" };
        let theirs = &walk.point(&format!("{letter}{}", joint.theirs)).unwrap().positions;
        let start_s = tracked.body.plates[0].times[0];
        let pair = |(frame, moment): (usize, &[f64; 3])| {
            let t = start_s + frame as f64 / walk.point_rate_hz;
            let moment = 1e-3 * moment[0];
            let is_meant = moment.is_finite() && is_on_plate(t) && t <= grid.end_s();
            is_meant.then(|| (joint.sign * interpolate(&grid.times(), column, t) / self.mass_kg, moment))
        };
        agreement(&theirs.iter().enumerate().filter_map(pair).collect::<Vec<_>>())
    }
}

pub(crate) fn agreement(pairs: &[(f64, f64)]) -> Agreement {
    assert!(pairs.len() > 40, "only {} frames", pairs.len());
    let n = pairs.len() as f64;
    let (ma, mb) = (pairs.iter().map(|p| p.0).sum::<f64>() / n, pairs.iter().map(|p| p.1).sum::<f64>() / n);
    let sum = |f: &dyn Fn(f64, f64) -> f64| pairs.iter().map(|(a, b)| f(*a, *b)).sum::<f64>();
    let r = sum(&|a, b| (a - ma) * (b - mb)) / (sum(&|a, _| (a - ma).powi(2)) * sum(&|_, b| (b - mb).powi(2))).sqrt();
    Agreement { r, rms: (sum(&|a, b| (a - b).powi(2)) / n).sqrt() }
}

/// Every leg of every person, by joint, in the order of [`JOINTS`].
fn compared(folder: &Path, settings: &Settings) -> [Vec<Agreement>; 3] {
    let mut found = [const { Vec::new() }; 3];
    for person in &PEOPLE {
        let own;
        let outcome = if *settings == Settings::default() {
            &person.computed(folder).0
        } else {
            own = study::run(person.source(folder), settings, &mut Findings::default()).unwrap();
            &own
        };
        let (walk, _) = C3d::read(&person.file(folder, person.walk)).unwrap();
        for (joint, list) in JOINTS.iter().zip(&mut found) {
            list.extend(Side::BOTH.map(|side| person.agreement(outcome, &walk, joint, side)));
        }
    }
    found
}

fn mean(list: &[Agreement]) -> Agreement {
    let mean = |of: &dyn Fn(&Agreement) -> f64| list.iter().map(of).sum::<f64>() / list.len() as f64;
    Agreement { r: mean(&|a| a.r), rms: mean(&|a| a.rms) }
}

fn print(label: &str, found: &[Vec<Agreement>; 3]) {
    for (joint, list) in JOINTS.iter().zip(found) {
        let Agreement { r, rms } = mean(list);
        let low = list.iter().filter(|leg| leg.r < 0.95).count();
        let legs = list.len();
        println!("{label:<12} {:<12} r {r:.4}  RMS {rms:.4} N.m/kg, {low} of {legs} legs with r below .95", joint.ours);
    }
}

#[test]
fn moments_at_the_default_settings_are_those_of_plug_in_gait() {
    let Some(folder) = shared_data::data() else { return };
    let found = compared(&folder, &Settings::default());
    print("default", &found);
    for (joint, list) in JOINTS.iter().zip(&found) {
        let Agreement { r, rms } = mean(list);
        assert!(r >= joint.least_r && rms <= joint.largest_rms, "{}: r {r:.4}, RMS {rms:.4}", joint.ours);
    }
}

#[test]
fn forces_filtered_as_the_motion_lose_what_follows_foot_strike() {
    let Some(folder) = shared_data::data() else { return };
    for cutoff_hz in [6.0, 12.0, 20.0] {
        let force_filter = ForceFilter::LowPass(LowPass { cutoff_hz, ..LowPass::MOTION });
        let found = compared(&folder, &Settings { force_filter, ..Settings::default() });
        print(&format!("{cutoff_hz} Hz"), &found);
        assert_eq!(mean(&found[0]).r < 0.97, cutoff_hz < 20.0, "the hip shows the loss");
    }
}
