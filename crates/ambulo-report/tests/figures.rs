//! Figures over the gait cycle: lines show the numbers of the rows, names are escaped, missing parts are left out.

use crate::svg_reader::{Figure, Line};
use ambulo::model::Side;
use ambulo_report::internals::ClinicalNames;
use ambulo_report::{CycleFigures, Mark};
use ambulo_results::Convention;
use ambulo_results::CycleRow;

const MASS_KG: f64 = 62.5;
/// Places are written to a hundredth of a point: half of that, in panels of at least 70 points.
const PLACE: f64 = 0.005 / 70.0;

fn row(quantity: &str, unit: &'static str, side: Side, cycle: usize, wave: impl Fn(f64) -> f64) -> CycleRow {
    let values = (0..=100).map(|percent| wave(f64::from(percent) / 100.0)).collect();
    let foot_off_percent = Some(60.0 + cycle as f64);
    CycleRow { quantity: quantity.to_owned(), side, cycle, unit, values, foot_off_percent }
}

/// Waves of both sides, `cycles` each, no two the same.
fn rows(sides: &[Side], cycles: usize) -> Vec<CycleRow> {
    let mut rows = Vec::new();
    for &side in sides {
        for cycle in 1..=cycles {
            let late = if side == Side::Left { 0.07 } else { 0.0 } + 0.01 * cycle as f64;
            let wave = move |size: f64| move |t: f64| size * (std::f64::consts::TAU * (t - late)).sin();
            let mut add = |quantity: &str, unit, size: f64| rows.push(row(quantity, unit, side, cycle, wave(size)));
            add("pelvis_list_angle", "deg", 4.0);
            add("hip_flexion_angle", "deg", 30.0);
            add("hip_flexion_moment", "N.m", 50.0);
            add("hip_flexion_power", "W", 60.0);
            add("knee_angle_moment", "N.m", 20.0);
            add("ground_force_vertical", "BW", 1.1);
            add("ground_force_lateral", "BW", 0.06);
            rows.push(row("knee_angle_angle", "deg", side, cycle, |t| -60.0 * (3.0 * t).sin().abs()));
        }
    }
    rows
}

fn draw(rows: &[CycleRow], caption: &str, marks: &[Mark]) -> Vec<(String, Figure)> {
    let figures = CycleFigures {
        rows,
        names: &ClinicalNames::usual(),
        convention: Convention::Opensim,
        mass_kg: MASS_KG,
        caption,
        marks,
        speed_dimensionless: Some(0.4),
    };
    let read = |file: ambulo_results::OutputFile<'_>| {
        (file.name.clone(), Figure::read(std::str::from_utf8(&file.bytes().unwrap()).unwrap()))
    };
    figures.files().unwrap().into_iter().map(read).collect()
}

fn named<'f>(figures: &'f [(String, Figure)], name: &str) -> &'f Figure {
    let wanted = format!("figures/{name}");
    &figures.iter().find(|(found, _)| *found == wanted).unwrap_or_else(|| panic!("no {name}")).1
}

/// The displayed value of a row: unit, sign and mass as in docs/CONVENTIONS.md.
fn shown(id: &str, side: Side) -> (&'static str, f64) {
    let own = if side == Side::Right { -1.0 } else { 1.0 };
    match id {
        "pelvis_obliquity_angle" => ("pelvis_list_angle", own),
        "hip_flexion_angle" => ("hip_flexion_angle", 1.0),
        "knee_flexion_angle" => ("knee_angle_angle", -1.0),
        "hip_flexion_moment" => ("hip_flexion_moment", -1.0 / MASS_KG),
        "knee_flexion_moment" => ("knee_angle_moment", 1.0 / MASS_KG),
        "hip_flexion_power" => ("hip_flexion_power", 1.0 / MASS_KG),
        "ground_force_vertical" => ("ground_force_vertical", 1.0),
        "ground_force_lateral" => ("ground_force_lateral", own),
        other => panic!("a panel `{other}` of no row"),
    }
}

fn assert_same(line: &Line, height: f64, expected: &[f64], what: &str) {
    assert_eq!(line.points.len(), expected.len(), "{what}");
    for (percent, ([x, y], wanted)) in line.points.iter().zip(expected).enumerate() {
        assert!((x - percent as f64).abs() < 100.0 * PLACE, "{what}: {x} instead of {percent} %");
        assert!((y - wanted).abs() <= 1.01 * PLACE * height, "{what} at {percent} %: {y} instead of {wanted}");
    }
}

#[test]
fn every_line_is_a_row_in_clinical_sign_and_the_thick_one_their_mean() {
    let rows = rows(&Side::BOTH, 3);
    let figures = draw(&rows, "someone", &[]);
    let mut compared = 0;
    for (name, figure) in &figures {
        for panel in &figure.panels {
            let height = panel.up[1] - panel.up[0];
            for line in &panel.lines {
                let (quantity, factor) = shown(&panel.id, line.side);
                let of = |cycle: usize| {
                    rows.iter().find(|r| r.quantity == quantity && r.side == line.side && r.cycle == cycle)
                };
                let values = |cycle: usize| of(cycle).unwrap().values.iter().map(|x| factor * x).collect::<Vec<f64>>();
                let what = format!("{name}, {}, {}, {}", panel.id, line.side, line.role);
                let expected = match line.role.as_str() {
                    "cycle" => values(line.number),
                    "mean" => {
                        let all = [values(1), values(2), values(3)];
                        (0..=100).map(|i| all.iter().map(|v| v[i]).sum::<f64>() / 3.0).collect()
                    }
                    other => panic!("{what}: {other}"),
                };
                assert_same(line, height, &expected, &what);
                compared += 1;
            }
        }
    }
    // Eight quantities, two sides, three cycles and a mean; the sagittal quantities once or twice more.
    assert_eq!(compared, 8 * (8 + 5 + 3));
    assert_eq!(figures.len(), 6);
}

#[test]
fn bands_foot_off_and_units_are_drawn_and_the_source_is_named() {
    let figures = draw(&rows(&Side::BOTH, 2), "someone", &[]);
    let moments = named(&figures, "moments.svg");
    assert!(moments.panels.iter().all(|panel| panel.bands == 1), "{:?}", moments.panels);
    let forces = named(&figures, "ground_forces.svg");
    let bands: Vec<_> = forces.panels.iter().map(|panel| (panel.id.as_str(), panel.bands)).collect();
    assert_eq!(bands, [("ground_force_vertical", 1), ("ground_force_lateral", 0)]);
    for words in ["extensor →", "← flexor", "N·m/kg", "gait cycle (%)", "foot off", "right, mean of 2 cycles"] {
        assert!(moments.texts.iter().any(|text| text == words), "{words}: {:?}", moments.texts);
    }
    assert!(moments.texts.iter().any(|text| text.contains("children") && text.contains("Schwartz")));
    // Without a speed there is no band, and a note reports it.
    let rows = rows(&Side::BOTH, 2);
    let bandless = CycleFigures {
        rows: &rows,
        names: &ClinicalNames::usual(),
        convention: Convention::Opensim,
        mass_kg: MASS_KG,
        caption: "",
        marks: &[],
        speed_dimensionless: None,
    };
    let file = bandless.files().unwrap().remove(0);
    let figure = Figure::read(std::str::from_utf8(&file.bytes().unwrap()).unwrap());
    assert!(figure.panels.iter().all(|panel| panel.bands == 0));
    assert!(figure.texts.iter().any(|text| text.contains("the walking speed is not known")), "{:?}", figure.texts);
}

#[test]
fn a_run_is_not_compared_with_walks() {
    let mut rows = rows(&Side::BOTH, 1);
    rows.iter_mut().for_each(|row| row.foot_off_percent = Some(38.0));
    for (name, figure) in draw(&rows, "someone", &[]) {
        assert!(figure.panels.iter().all(|panel| panel.bands == 0), "{name}");
        assert!(
            figure.texts.iter().any(|text| text.contains("stance is shorter than half")),
            "{name}: {:?}",
            figure.texts
        );
    }
}

#[test]
fn figures_have_the_widths_of_journals() {
    let figures = draw(&rows(&Side::BOTH, 1), "someone", &[]);
    for (name, figure) in &figures {
        let expected = if name.contains("1col") { 85.0 } else { 178.0 };
        assert!((figure.width_mm - expected).abs() < 0.01, "{name}: {} mm", figure.width_mm);
        assert!((figure.view_box[2] * 25.4 / 72.0 - figure.width_mm).abs() < 0.01, "{name}: a unit is a point");
        for panel in &figure.panels {
            let [left, top, right, bottom] = panel.place;
            let inside = left > 0.0 && top > 0.0 && right < figure.view_box[2] && bottom < figure.view_box[3];
            assert!(inside && right - left > 60.0 && bottom - top >= 80.0, "{name}: {:?}", panel.place);
        }
    }
}

#[test]
fn infeasible_parts_are_red_in_their_panel_and_cycle() {
    let mark = |quantity: Option<&str>, percent| Mark {
        quantity: quantity.map(str::to_owned),
        side: Side::Left,
        cycle: 2,
        percent,
    };
    let marks = [mark(Some("knee_angle_moment"), [10.5, 30.0]), mark(None, [80.0, 100.0])];
    let rows = rows(&Side::BOTH, 2);
    let figures = draw(&rows, "someone", &marks);
    let moments = named(&figures, "moments.svg");
    let panel = |id: &str| moments.panels.iter().find(|panel| panel.id == id).unwrap();
    let red = |id: &str| panel(id).lines.iter().filter(|line| line.role == "infeasible").collect::<Vec<_>>();
    // The knee has both marks, the hip only the one that concerns the whole body.
    assert_eq!((red("knee_flexion_moment").len(), red("hip_flexion_moment").len()), (2, 1));
    let on_curve = red("knee_flexion_moment")[0];
    assert!(on_curve.side == Side::Left && on_curve.number == 2);
    let ends = [on_curve.points[0], on_curve.points[on_curve.points.len() - 1]];
    let values = &rows
        .iter()
        .find(|r| r.quantity == "knee_angle_moment" && r.side == Side::Left && r.cycle == 2)
        .unwrap()
        .values;
    let expected = [[10.5, 0.5 * (values[10] + values[11]) / MASS_KG], [30.0, values[30] / MASS_KG]];
    for (found, expected) in ends.iter().zip(expected) {
        assert!(
            (found[0] - expected[0]).abs() < 0.01 && (found[1] - expected[1]).abs() < 1e-3,
            "{found:?} {expected:?}"
        );
    }
    assert!(moments.texts.iter().any(|text| text == "red: not feasible"));
    let without = draw(&rows, "someone", &[]);
    assert!(!named(&without, "moments.svg").texts.iter().any(|text| text.contains("feasible")));
}

#[test]
fn a_name_stays_text() {
    let evil = "<script>alert(1)</script> & \"x\" 'y' ]]> \u{0}\u{1b}";
    for (name, figure) in draw(&rows(&Side::BOTH, 1), evil, &[]) {
        assert!(figure.elements.iter().all(|element| element != "script"), "{name}");
        assert!(figure.texts.iter().any(|text| text.contains("<script>alert(1)</script> & \"x\" 'y' ]]>")), "{name}");
        assert!(figure.title.contains("<script>"), "{name}: {}", figure.title);
    }
}

#[test]
fn one_leg_one_quantity_or_none_is_drawn_as_such() {
    let figures = draw(&rows(&[Side::Left], 1), "someone", &[]);
    for (name, figure) in &figures {
        assert!(figure.panels.iter().flat_map(|panel| &panel.lines).all(|line| line.side == Side::Left), "{name}");
        assert!(figure.texts.iter().any(|text| text == "left, 1 cycle"), "{name}: {:?}", figure.texts);
        assert!(!figure.texts.iter().any(|text| text.starts_with("right,") || text == "single cycles"), "{name}");
    }
    // Angles alone: no figure of anything else.
    let angles: Vec<CycleRow> = rows(&Side::BOTH, 1).into_iter().filter(|row| row.unit == "deg").collect();
    let names: Vec<String> = draw(&angles, "someone", &[]).into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["figures/kinematics.svg", "figures/sagittal_2col.svg"]);
    assert!(draw(&[], "someone", &[]).is_empty());
    // A locked joint and the sideways force of a planar figure are no curves.
    let still = [row("hip_flexion_angle", "deg", Side::Right, 1, |_| 5.0)];
    assert!(draw(&still, "someone", &[]).is_empty());
}

#[test]
fn gaps_break_a_line_and_hundreds_of_cycles_are_thinned() {
    let mut broken = rows(&[Side::Right], 1);
    broken.retain(|row| row.quantity == "hip_flexion_angle");
    broken[0].values[40] = f64::NAN;
    let figures = draw(&broken, "someone", &[]);
    let lines = &named(&figures, "kinematics.svg").panels[0].lines;
    assert_eq!(lines.iter().map(|line| line.points.len()).collect::<Vec<_>>(), [40, 60]);
    let many = rows(&Side::BOTH, 200);
    let figures = draw(&many, "someone", &[]);
    let moments = named(&figures, "moments.svg");
    let count = moments.panels[0].lines.iter().filter(|line| line.role == "cycle").count();
    assert!((30..=60).contains(&count), "{count} lines");
    assert!(moments.texts.iter().any(|text| text.contains("means are over all")), "{:?}", moments.texts);
    assert!(moments.texts.iter().any(|text| text == "left, mean of 200 cycles"));
}
