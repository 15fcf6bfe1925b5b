//! Figures of a run: their lines show the numbers of the run's files, with the signs of normative data.

use crate::shared_data;
use crate::svg_reader::{Figure, Panel};
use crate::workbench::Workbench;
use ambulo::findings::Findings;
use ambulo::model::{Model, Side};
use ambulo::numerics::correlation;
use ambulo_report::internals::{ClinicalNames, ClinicalQuantity, band, clinical_quantities};
use ambulo_results::Convention;
use std::collections::BTreeMap;

/// Figures over the gait cycle.
const CYCLE_FIGURES: [&str; 6] = ["kinematics", "moments", "powers", "ground_forces", "sagittal_2col", "sagittal_1col"];

/// `cycles.csv`: values by quantity, side and cycle; and the meaning of the coordinates.
struct Cycles(BTreeMap<(String, String, usize), Vec<f64>>, ClinicalNames);

impl Cycles {
    fn read(bench: &Workbench) -> Cycles {
        let text = bench.text("out/cycles.csv");
        let body = if bench.exists("out/subject.osim") { "out/subject.osim" } else { "out/figure.osim" };
        let model = Model::from_osim(bench.text(body).as_bytes(), &mut Findings::default()).unwrap();
        let mut rows: BTreeMap<_, Vec<f64>> = BTreeMap::new();
        for line in text.lines().skip(1) {
            let cells: Vec<&str> = line.split(',').collect();
            let key = (cells[0].to_owned(), cells[1].to_owned(), cells[2].parse().unwrap());
            rows.entry(key).or_default().push(cells[4].parse().unwrap());
        }
        Cycles(rows, ClinicalNames::of_model(&model))
    }

    fn quantities(&self) -> Vec<ClinicalQuantity> {
        clinical_quantities(&self.1, |name| self.0.keys().any(|(quantity, _, _)| quantity == name))
    }

    /// The mean over a side's cycles as a panel shows it; `None` without any.
    fn mean(&self, quantity: &ClinicalQuantity, side: Side, mass_kg: f64) -> Option<Vec<f64>> {
        let factor = quantity.factor(mass_kg, side);
        let of_side =
            self.0.iter().filter(|((name, letter, _), _)| *name == quantity.columns[side] && letter == side.letter());
        let curves: Vec<&Vec<f64>> = of_side.map(|(_, values)| values).collect();
        let count = curves.len() as f64;
        (!curves.is_empty())
            .then(|| (0..101).map(|i| factor * curves.iter().map(|c| c[i]).sum::<f64>() / count).collect())
    }
}

fn figure(bench: &Workbench, name: &str) -> Figure {
    Figure::read(&bench.text(&format!("out/figures/{name}.svg")))
}

/// Correlation of the drawn mean with the normative mean, for both sides.
fn with_band(bench: &Workbench, id: &str, speed: f64) -> Vec<f64> {
    let cycles = Cycles::read(bench);
    let mass_kg = bench.json("out/summary.json")["mass_kg"].as_f64().unwrap();
    let quantity = cycles.quantities().into_iter().find(|q| q.id == id).unwrap_or_else(|| panic!("no {id}"));
    let expected = band(id, speed, Convention::Opensim).unwrap().mean;
    let means = Side::BOTH.into_iter().filter_map(|side| cycles.mean(&quantity, side, mass_kg));
    means.map(|mean| correlation(&mean.iter().copied().step_by(2).collect::<Vec<f64>>(), &expected)).collect()
}

/// One hundredth of a point in the panel's numbers.
fn place(panel: &Panel) -> f64 {
    0.01 * (panel.up[1] - panel.up[0]) / (panel.place[3] - panel.place[1])
}

#[test]
fn figures_show_the_numbers_of_the_cycles_with_the_usual_clinical_signs() {
    let bench = Workbench::empty("figures_walk");
    bench.run(&["walk", "--cycles", "2", "--convention", "opensim", "-o", "out"]).done();
    let cycles = Cycles::read(&bench);
    let mass_kg = bench.json("out/summary.json")["mass_kg"].as_f64().unwrap();
    let quantities = cycles.quantities();
    let mut compared = 0;
    for name in CYCLE_FIGURES {
        for panel in &figure(&bench, name).panels {
            let quantity = quantities.iter().find(|q| q.id == panel.id).unwrap();
            for line in panel.lines.iter().filter(|line| line.role != "infeasible") {
                let letter = line.side.letter().to_owned();
                let factor = quantity.factor(mass_kg, line.side);
                let expected = match line.role.as_str() {
                    "mean" => cycles.mean(quantity, line.side, mass_kg).unwrap(),
                    _ => cycles.0[&(quantity.columns[line.side].clone(), letter, line.number)]
                        .iter()
                        .map(|x| factor * x)
                        .collect(),
                };
                assert_eq!(line.points.len(), 101, "{name}, {}", panel.id);
                for (percent, ([_, y], wanted)) in line.points.iter().zip(&expected).enumerate() {
                    assert!((y - wanted).abs() < place(panel), "{name}, {} at {percent} %: {y}, {wanted}", panel.id);
                }
                compared += 1;
            }
        }
    }
    assert!(compared > 60, "{compared}");

    // Speed of the gait `free`. The required correlation is far above that of a reversed sign.
    let speed = bench.json("out/summary.json")["walk"]["speed_dimensionless"].as_f64().unwrap();
    let alike = [
        ("hip_flexion_angle", 0.95),
        ("knee_flexion_angle", 0.95),
        ("ankle_dorsiflexion_angle", 0.9),
        ("hip_flexion_moment", 0.85),
        ("knee_flexion_moment", 0.75),
        ("ankle_dorsiflexion_moment", 0.9),
        ("hip_flexion_power", 0.8),
        ("knee_flexion_power", 0.65),
        ("ankle_dorsiflexion_power", 0.8),
        ("ground_force_vertical", 0.95),
        ("ground_force_fore_aft", 0.95),
    ];
    for (id, least) in alike {
        let found = with_band(&bench, id, speed);
        assert!(found.len() == 2 && found.iter().all(|r| *r > least), "{id}: {found:?}");
    }
    // The plantarflexion moment peaks before the opposite foot strike, at 48 % in the source.
    let ankle = quantities.iter().find(|q| q.id == "ankle_dorsiflexion_moment").unwrap();
    for side in Side::BOTH {
        let mean = cycles.mean(ankle, side, mass_kg).unwrap();
        let peak = (0..101).max_by(|a, b| mean[*a].total_cmp(&mean[*b])).unwrap();
        assert!((40..=54).contains(&peak) && mean[peak] > 1.0, "{side}: {} N.m/kg at {peak} %", mean[peak]);
    }
}

#[test]
fn frontal_and_transverse_signs_agree_with_normative_curves_on_both_sides() {
    let Some(data) = shared_data::data() else { return };
    let folder = data.join("opensim-rajagopal-walk");
    let path = |name: &str| folder.join(name).display().to_string();
    let bench = Workbench::empty("figures_3d");
    let [markers, model, forces, loads] =
        ["markers_walk.trc", "subject_walk_scaled.osim", "grf_walk.mot", "grf_walk.xml"].map(path);
    let run = bench.run(&["forces", &markers, "--model", &model, "--grf", &forces, "--loads", &loads, "-o", "out"]);
    assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
    let alike = [
        "pelvis_obliquity_angle",
        "pelvis_rotation_angle",
        "hip_adduction_angle",
        "hip_adduction_moment",
        "hip_flexion_angle",
        "knee_flexion_angle",
        "ankle_dorsiflexion_angle",
        "ankle_dorsiflexion_moment",
    ];
    for id in alike {
        let found = with_band(&bench, id, 0.42);
        assert!(found.len() == 2 && found.iter().all(|r| *r > 0.6), "{id}: {found:?}");
    }
    // Feet are pushed towards the middle in single support.
    let cycles = Cycles::read(&bench);
    let lateral = cycles.quantities().into_iter().find(|q| q.id == "ground_force_lateral").unwrap();
    for side in Side::BOTH {
        let mean = cycles.mean(&lateral, side, 1.0).unwrap();
        assert!(mean[20..45].iter().all(|x| *x > 0.0), "{side}: {:?}", &mean[20..45]);
    }
}

#[test]
fn a_prediction_is_drawn_with_its_uncertainty_and_the_measured_forces() {
    let bench = Workbench::new("figures_prediction");
    let run = bench.forces(&["--predict"]);
    assert!(matches!(run.code, Some(0 | 1)), "{}", run.stderr);
    let prediction = figure(&bench, "prediction");
    let ids: Vec<&str> = prediction.panels.iter().map(|panel| panel.id.as_str()).collect();
    assert_eq!(ids, ["vertical", "fore_aft", "lateral"]);
    let model_gravity = 9.80665;
    let weight = bench.json("out/summary.json")["mass_kg"].as_f64().unwrap() * model_gravity;
    let table = bench.table("out/grf.mot");
    let vertical = &prediction.panels[0];
    for (line, column) in vertical.lines.iter().filter(|line| line.role == "predicted").zip(["r", "l"]) {
        let column = table.column(&format!("ground_force_{column}_vy")).unwrap();
        assert_eq!(line.points.len(), column.len());
        for ([_, y], newton) in line.points.iter().zip(column).filter(|(_, newton)| **newton > 20.0) {
            assert!((y - newton / weight).abs() < 1e-3 + place(vertical), "{y} instead of {newton} N");
        }
    }
    assert!(vertical.lines.iter().any(|line| line.role == "measured"));
    let quality = figure(&bench, "quality");
    assert_eq!(quality.panels.len(), 2);
    assert!(quality.texts.iter().any(|text| text.contains("% of body weight")), "{:?}", quality.texts);
}

#[test]
fn a_trial_without_forces_or_cycles_has_the_figures_that_it_can_have() {
    let bench = Workbench::new("figures_missing");
    bench.run(&["forces", "walk.mot", "--model", "figure.osim", "--no-ground", "-o", "out"]);
    assert!(
        bench.exists("out/moments.sto")
            && !bench.exists("out/figures/moments.svg")
            && !bench.exists("out/figures/quality.svg")
    );
    bench.forces(&["--from", "0.6", "--to", "0.9"]);
    assert!(bench.exists("out/grf.mot") && !bench.exists("out/figures/kinematics.svg"));
    assert_eq!(figure(&bench, "quality").panels.len(), 2);
}

#[test]
fn the_name_of_a_model_is_escaped() {
    let bench = Workbench::new("figures_name");
    let text = bench.text("figure.osim");
    let name = text.split("<Model name=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap().to_owned();
    bench.edit(
        "figure.osim",
        &format!("<Model name=\"{name}\""),
        "<Model name=\"&lt;script&gt;alert(1)&lt;/script&gt; &amp; co\"",
    );
    bench.forces(&[]);
    for name in CYCLE_FIGURES.into_iter().chain(["quality"]) {
        let figure = figure(&bench, name);
        assert!(!figure.elements.iter().any(|element| element == "script"), "{name}");
        assert!(
            figure.texts.iter().any(|text| text.contains("<script>alert(1)</script> & co")),
            "{name}: {:?}",
            figure.texts
        );
    }
}
