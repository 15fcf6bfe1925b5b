//! A bare C3D gives muscle forces and the load of the knee: three persons of two laboratories, one of them a child.

use super::contact::{Peaks, peaks};
use crate::people::Person;
use crate::shared_data;
use ambulo_body::dynamics::LoadSeries;
use ambulo_body::findings::Findings;
use ambulo_body::kinematics::Trajectory;
use ambulo_body::kinematics::calibration::{BodyMeasurements, PersonMeasurements, Trial, calibrate};
use ambulo_body::kinematics::marker_fit::{FitSettings, fit_markers};
use ambulo_body::model::anthropometry::SegmentTable;
use ambulo_body::model::marker_set::MarkerSet;
use ambulo_body::model::{Model, Side};
use ambulo_body::motion::{PlateRecording, PlateSettings, interpolate, markers_from_c3d, plates_from_c3d};
use ambulo_body::spatial::{Mat3, Vec3, Wrench};
use ambulo_formats::c3d::C3d;
use ambulo_muscles::built_in::muscle_set;

/// A walk with plates, z up along +y.
struct Laboratory {
    folder: &'static str,
    standing: &'static str,
    walk: &'static str,
    table: SegmentTable,
    mass: f64,
    height: f64,
    /// The foot on each plate.
    feet: &'static [Side],
    /// When every foot on the floor is on a plate [s]: README of the recordings.
    window: [f64; 2],
    /// Sides whose loaded part of the stance is within the window.
    sides: &'static [Side],
}

const LABORATORIES: [Laboratory; 3] = [
    Laboratory {
        folder: "biomechzoo-HC032A",
        standing: "HC032A01.c3d",
        walk: "HC032A03.c3d",
        table: SegmentTable::DeLevaFemale,
        mass: 60.3,
        height: 1.58,
        feet: &[Side::Left, Side::Right],
        window: [1.80, 2.70],
        sides: &[Side::Right, Side::Left],
    },
    Laboratory {
        folder: "biomechzoo-HC002D",
        standing: "HC002D02.c3d",
        walk: "HC002D06.c3d",
        table: SegmentTable::DeLevaFemale,
        mass: 32.1,
        height: 1.45,
        feet: &[Side::Left, Side::Right],
        window: [1.88, 2.72],
        sides: &[Side::Right, Side::Left],
    },
    Laboratory {
        folder: "btkdata-pig-adult3plates",
        standing: "PiG_Calibration3_FF.c3d",
        walk: "PiG_Motion3_FF.c3d",
        table: SegmentTable::DeLevaMale,
        mass: 72.3,
        height: 1.76,
        feet: &[Side::Left, Side::Right, Side::Left],
        window: [7.98, 9.45],
        sides: &[Side::Right, Side::Left],
    },
];

/// World axes: x forward, y up, z to the right.
fn world_from_lab() -> Mat3 {
    Mat3::from_rows(&[Vec3::y().transpose(), Vec3::z().transpose(), Vec3::x().transpose()])
}

impl Laboratory {
    fn file(&self, name: &str) -> Option<C3d> {
        let path = shared_data::data()?.join(self.folder).join(name);
        Some(C3d::read(&std::fs::read(path).unwrap()).unwrap().0)
    }

    fn person(&self) -> Option<(Person, Vec<PlateRecording>)> {
        let [standing, walk] = [self.file(self.standing)?, self.file(self.walk)?];
        let findings = &mut Findings::default();
        let [still, moving] = [&standing, &walk]
            .map(|file| markers_from_c3d(file, &mut Findings::default()).unwrap().rotated(&world_from_lab()));
        let known = MarkerSet::recognise(still.markers.iter().map(|m| m.name.as_str())).unwrap();
        let Laboratory { table, mass, height, .. } = *self;
        let millimetres = |name: &str| standing.parameters.get("PROCESSING", name)?.numbers()?.first().copied();
        let measurements = BodyMeasurements::from_processing(millimetres);
        let person = PersonMeasurements { table, mass, height: Some(height), measurements };
        let body = calibrate(&still, Trial::Standing, &known, &person, findings).unwrap();
        let settings = FitSettings { weights: body.weights.clone(), ..FitSettings::default() };
        let fit = fit_markers(&body.human.model, &moving, &settings, findings).unwrap();
        let plates = plates_from_c3d(&walk, PlateSettings::default(), findings).unwrap();
        let folder = shared_data::data()?.join(self.folder);
        Some((Person { folder, model: body.human.model, walk: fit.motion }, plates))
    }

    fn ground(&self, model: &Model, plates: &[PlateRecording], trajectory: &Trajectory) -> Vec<LoadSeries> {
        let series = plates.iter().zip(self.feet).map(|(plate, side)| {
            let at = |values: &[Vec3], time: f64| {
                let one = |k: usize| {
                    let column: Vec<f64> = values.iter().map(|v| v[k]).collect();
                    interpolate(&plate.times, &column, time)
                };
                world_from_lab() * Vec3::new(one(0), one(1), one(2))
            };
            let times = trajectory.grid().times();
            let wrench = |time: &f64| Wrench { force: at(&plate.force, *time), moment: at(&plate.moment, *time) };
            LoadSeries {
                body: model.anatomy().feet().unwrap()[*side],
                points: vec![Vec3::zeros(); times.len()],
                wrenches: times.iter().map(wrench).collect(),
            }
        });
        series.collect()
    }
}

/// OpenSim's static optimisation has knee peaks of 3.6 to 4.3 body weights with Gait2392 and with Rajagopal's model
/// (`contact`): those of other adults and of a child are not far from them.
#[test]
fn walks_of_three_laboratories_load_the_knee_with_two_to_five_body_weights() {
    for laboratory in LABORATORIES {
        let Some((person, plates)) = laboratory.person() else { return };
        let set = muscle_set(&person.model).unwrap();
        println!("{}:", laboratory.folder);
        let trajectory = person.trajectory(laboratory.window);
        let ground = laboratory.ground(&person.model, &plates, &trajectory);
        let Peaks { joints, reserve } = peaks(&person.model, &set, &trajectory, &ground);
        for side in laboratory.sides {
            let [hip, knee, ankle] = joints[*side];
            println!("  {side}: hip {hip:.2}, knee {knee:.2}, ankle {ankle:.2} body weights");
            assert!((2.0..5.0).contains(&knee), "{} {side} {knee}", laboratory.folder);
        }
        println!("  largest reserve {reserve:.1} N.m");
    }
}
