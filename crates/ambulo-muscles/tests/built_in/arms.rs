//! Moment arms of the built-in body in walking, compared with those of Gait2392 and of Rajagopal's model.

use crate::muscle_models::{MuscleModel, State, Table, load, postures};
use crate::people;
use ambulo_body::model::anthropometry::{Build, SegmentTable};
use ambulo_body::model::full_body::full_body;
use ambulo_body::model::{Model, Side};
use ambulo_body::motion::{Motion, interpolate};
use ambulo_muscles::built_in::muscle_set;
use ambulo_muscles::path::PathWorkspace;
use ambulo_muscles::wrap::WrapRule;
use std::collections::BTreeMap;

/// Joints of a leg, and the coordinates that are compared: names are the same in all models.
const JOINTS: [(&str, &[&str]); 3] = [
    ("hip", &["hip_flexion", "hip_adduction", "hip_rotation"]),
    ("knee", &["knee_angle"]),
    ("ankle", &["ankle_angle", "subtalar_angle"]),
];

/// Names of Gait2392's muscles in Rajagopal's model; muscles that it divides otherwise are not among them.
const RAJAGOPAL: [(&str, &str); 34] = [
    ("glut_med1", "glmed1"),
    ("glut_med2", "glmed2"),
    ("glut_med3", "glmed3"),
    ("glut_min1", "glmin1"),
    ("glut_min2", "glmin2"),
    ("glut_min3", "glmin3"),
    ("glut_max1", "glmax1"),
    ("glut_max2", "glmax2"),
    ("glut_max3", "glmax3"),
    ("semimem", "semimem"),
    ("semiten", "semiten"),
    ("bifemlh", "bflh"),
    ("bifemsh", "bfsh"),
    ("sar", "sart"),
    ("add_long", "addlong"),
    ("add_brev", "addbrev"),
    ("tfl", "tfl"),
    ("grac", "grac"),
    ("iliacus", "iliacus"),
    ("psoas", "psoas"),
    ("peri", "piri"),
    ("rect_fem", "recfem"),
    ("vas_med", "vasmed"),
    ("vas_int", "vasint"),
    ("vas_lat", "vaslat"),
    ("med_gas", "gasmed"),
    ("lat_gas", "gaslat"),
    ("soleus", "soleus"),
    ("tib_post", "tibpost"),
    ("tib_ant", "tibant"),
    ("per_brev", "perbrev"),
    ("per_long", "perlong"),
    ("ext_dig", "edl"),
    ("ext_hal", "ehl"),
];

/// A published model with the postures of its walk.
struct Published {
    name: &'static str,
    muscles: MuscleModel,
    /// Sign of the arm about the knee: +1 if extension is positive.
    knee: f64,
}

impl Published {
    fn gait2392() -> Option<Published> {
        Some(Published { name: "gait2392", muscles: load("gait2392")?, knee: 1.0 })
    }

    fn rajagopal() -> Option<Published> {
        Some(Published { name: "rajagopal", muscles: load("rajagopal")?, knee: -1.0 })
    }

    /// The walking postures of the tables, with their times.
    fn walk(&self) -> Vec<(f64, State)> {
        let table = Table::read(&format!("postures_{}.csv", self.name)).unwrap();
        let all = postures(self.name, &self.muscles.model).unwrap();
        let walk = table.rows.iter().zip(all).filter(|(_, (kind, _))| kind == "walk");
        walk.map(|(row, (_, state))| (table.number(row, "time"), state)).collect()
    }

    /// Index of a muscle of the built-in body.
    fn muscle(&self, name: &str) -> Option<usize> {
        let (side, stem) = Side::split_name(name).unwrap();
        let theirs = match self.name {
            "rajagopal" => RAJAGOPAL.iter().find(|(own, _)| *own == stem)?.1,
            _ => &stem,
        };
        let theirs = format!("{theirs}_{}", side.letter());
        Some(self.muscles.set.muscles.iter().position(|known| known.name == theirs).unwrap())
    }
}

/// Differences of the moment arms of a muscle about a coordinate over the postures.
#[derive(Default, Clone, Copy)]
struct Difference {
    squares: f64,
    largest: f64,
    /// Sum of the published arm [m].
    published: f64,
    postures: usize,
}

type Differences = BTreeMap<(String, String), Difference>;

/// Differences by muscle and coordinate; `own` gives the state of the built-in body.
fn differences(published: &Published, model: &Model, own: impl Fn(f64, &State) -> State) -> Differences {
    let set = muscle_set(model).unwrap();
    let their_model = &published.muscles.model;
    let mut theirs = PathWorkspace::new(their_model, &published.muscles.set, WrapRule::Exact);
    let mut ours = PathWorkspace::new(model, &set, WrapRule::Exact);
    let mut found = Differences::new();
    for (time, state) in published.walk() {
        theirs.update(state.posture());
        ours.update(own(time, &state).posture());
        for (i, muscle) in set.muscles.iter().enumerate() {
            let Some(other) = published.muscle(&muscle.name) else { continue };
            let (side, _) = Side::split_name(&muscle.name).unwrap();
            for stem in JOINTS.iter().flat_map(|(_, stems)| *stems) {
                let name = format!("{stem}_{}", side.letter());
                let sign = if *stem == "knee_angle" { published.knee } else { 1.0 };
                // Rajagopal's model has no subtalar joint.
                let Some(theirs_id) = their_model.coordinate(&name) else { continue };
                let own = ours.arm(i, model.coordinate(&name).unwrap());
                let arm = sign * theirs.arm(other, theirs_id);
                if own.abs().max(arm.abs()) < 1e-9 {
                    continue;
                }
                let sum = found.entry((muscle.name.clone(), (*stem).to_owned())).or_default();
                sum.squares += (own - arm).powi(2);
                sum.largest = sum.largest.max((own - arm).abs());
                sum.published += arm;
                sum.postures += 1;
            }
        }
    }
    found
}

/// Prints a row per muscle and coordinate; returns rms and the largest difference of each joint [m].
fn show(label: &str, found: &Differences, all: bool) -> [[f64; 2]; 3] {
    println!("{label}: published moment arm (mean), difference of the built-in body (rms, largest) [mm]");
    let millimetres = |metres: f64| 1e3 * metres;
    for ((muscle, stem), sum) in found.iter().filter(|_| all) {
        let count = sum.postures as f64;
        let [mean, rms, largest] = [sum.published / count, (sum.squares / count).sqrt(), sum.largest].map(millimetres);
        println!("  {muscle:<12} {stem:<14} {mean:>6.1} {rms:>5.1} {largest:>5.1}");
    }
    JOINTS.map(|(joint, stems)| {
        let of_joint: Vec<_> = found.iter().filter(|((_, stem), _)| stems.contains(&stem.as_str())).collect();
        let worst = of_joint.iter().max_by(|a, b| a.1.largest.total_cmp(&b.1.largest)).unwrap();
        let mean_square = |sum: &Difference| sum.squares / sum.postures as f64;
        let rms = (of_joint.iter().map(|(_, sum)| mean_square(sum)).sum::<f64>() / of_joint.len() as f64).sqrt();
        let ((muscle, stem), sum) = worst;
        println!(
            "  {joint}: {} arms, rms {:.1} mm, worst {muscle} {stem} {:.1} mm",
            of_joint.len(),
            millimetres(rms),
            millimetres(sum.largest)
        );
        [rms, sum.largest]
    })
}

/// The state of a recorded motion at a time.
fn state_at(model: &Model, motion: &Motion, time: f64) -> State {
    let value = |id| motion.column(id).map_or(0.0, |column: &[f64]| interpolate(&motion.times, column, time));
    let q: Vec<f64> = model.coordinate_ids().map(value).collect();
    let qd = vec![0.0; q.len()];
    State::new(q, qd)
}

/// The body and the motion follow from markers alone: joint centres, axes and angles are not those of Gait2392.
#[test]
fn moment_arms_in_the_walk_of_subject01_are_within_10_mm_of_gait2392() {
    let (Some(published), Some(person)) = (Published::gait2392(), people::subject01()) else { return };
    let model = &person.model;
    let found = differences(&published, model, |time, _| state_at(model, &person.walk, time));
    let worst = show("subject01 by markers", &found, true);
    assert!(worst.iter().all(|[_, largest]| *largest < 0.010), "{worst:?}");
    // Without the markers on the spines the pelvis is taken to stand upright, which it does not in this recording.
    let (bodies, coordinates) = (model.bodies().to_vec(), model.coordinates().to_vec());
    let bare = Model::new(model.name(), model.gravity(), bodies, coordinates, Vec::new()).unwrap();
    let other = differences(&published, &bare, |time, _| state_at(&bare, &person.walk, time));
    assert!(show("without markers on the spines", &other, false)[0][1] > 0.010);
}

/// A body of usual proportions and the stature of the person, in the postures of Gait2392.
#[test]
fn moment_arms_of_usual_proportions_are_within_10_mm_of_gait2392() {
    let Some(published) = Published::gait2392() else { return };
    let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.8034, toe_joint: true };
    let model = full_body(&build).unwrap().model;
    let same = |_: f64, state: &State| {
        let value = |name: &str| published.muscles.model.coordinate(name).map_or(0.0, |id| state.q[id.index()]);
        let q: Vec<f64> = model.coordinates().iter().map(|c| value(&c.name)).collect();
        let qd = vec![0.0; q.len()];
        State::new(q, qd)
    };
    let worst = show("usual proportions", &differences(&published, &model, same), false);
    assert!(worst.iter().all(|[_, largest]| *largest < 0.010), "{worst:?}");
    // Those of a child of half the size are not.
    let child = full_body(&Build { mass: 15.0, height: 0.9, ..build }).unwrap().model;
    let worst = show("half the size", &differences(&published, &child, same), false);
    assert!(worst.iter().all(|[_, largest]| *largest > 0.010), "{worst:?}");
}

/// A second person with another published model: its muscles have other origins, its knee other axes and a patella, so
/// that arms differ by more. They agree on average.
#[test]
fn moment_arms_of_a_second_person_agree_with_rajagopals_model_on_average() {
    let (Some(published), Some(person)) = (Published::rajagopal(), people::rajagopal_walker()) else { return };
    let model = &person.model;
    let found = differences(&published, model, |time, _| state_at(model, &person.walk, time));
    let own = show("Rajagopal's walker by markers", &found, true);
    assert!(own.iter().all(|[rms, _]| *rms < 0.010), "{own:?}");
    // With left and right exchanged they agree less.
    let exchanged = |time: f64, _: &State| {
        let state = state_at(model, &person.walk, time);
        let other = |name: &str| match Side::split_name(name) {
            Some((side, stem)) => model.coordinate(&format!("{stem}_{}", side.other().letter())).unwrap().index(),
            None => model.coordinate(name).unwrap().index(),
        };
        let q = model.coordinates().iter().map(|c| state.q[other(&c.name)]).collect();
        State { q, ..state }
    };
    let other = show("sides exchanged", &differences(&published, model, exchanged), false);
    assert!(other[1][0] > own[1][0], "{own:?} {other:?}");
}
