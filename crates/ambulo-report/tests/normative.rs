//! Normative bands: values of the source, interpolated between its speeds, with the signs of the panels.

use ambulo_report::internals::{
    BAND_SAMPLES, Bands, ClinicalNames, NormalRange, band, clinical_quantities, dimensionless_speed, time_distance,
};
use ambulo_results::Convention;

const TIMES: &str = include_str!("../data/normative/schwartz2008.toml");
const CURVES: &str = include_str!("../data/normative/schwartz2008_curves.csv");
/// Dimensionless speeds that were measured.
const SPEEDS: [f64; 5] = [0.172, 0.290, 0.429, 0.560, 0.694];
const FREE: f64 = 0.429;
/// Quantities that were measured from another zero or by another method, or that the source lacks.
const BANDLESS: [&str; 10] = [
    "subtalar_angle",
    "trunk_lean_angle",
    "trunk_obliquity_angle",
    "trunk_rotation_angle",
    "hip_rotation_moment",
    "knee_rotation_moment",
    "ankle_inversion_moment",
    "ankle_rotation_moment",
    "ground_force_lateral",
    "none",
];

fn mean(id: &str, speed: f64) -> Vec<f64> {
    band(id, speed, Convention::Opensim).unwrap().mean
}

/// The largest value with its percent of the cycle.
fn peak(values: &[f64], sign: f64) -> (f64, f64) {
    let (i, x) = values.iter().enumerate().max_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1))).unwrap();
    (*x, 2.0 * i as f64)
}

#[test]
fn every_quantity_has_a_band_or_a_reason() {
    let all = clinical_quantities(&ClinicalNames::usual(), |_| true);
    for quantity in &all {
        let known = band(quantity.id, FREE, Convention::Opensim);
        assert_eq!(known.is_none(), BANDLESS.contains(&quantity.id), "{}", quantity.id);
        for speed in SPEEDS {
            let Some(band) = band(quantity.id, speed, Convention::Opensim) else { continue };
            assert!(band.mean.len() == BAND_SAMPLES && band.sd.len() == BAND_SAMPLES && !band.outside_of_speeds);
            assert!(band.mean.iter().all(|x| x.is_finite()) && band.sd.iter().all(|sd| *sd >= 0.0), "{}", quantity.id);
            assert!(band.sd.iter().any(|sd| *sd > 0.0), "{}", quantity.id);
            for words in ["children", "Schwartz", "2008", "CC BY-SA 4.0"] {
                assert!(band.citation.contains(words), "{}", band.citation);
            }
        }
    }
    assert!(
        band("hip_flexion_angle", f64::NAN, Convention::Opensim).is_none()
            && band("", FREE, Convention::Opensim).is_none()
    );
}

/// Peaks at the free speed as shared by the source: value and percent of the cycle. The signs are those of the panels.
#[test]
fn peaks_are_where_the_source_has_them() {
    const TILT: f64 = 11.7;
    let peaks = [
        ("ankle_dorsiflexion_moment", 1.0, 1.23, 48.0),
        ("hip_flexion_moment", 1.0, 0.73, 2.0),
        ("hip_flexion_moment", -1.0, -0.62, 50.0),
        ("hip_adduction_moment", 1.0, 0.49, 18.0),
        ("knee_flexion_moment", 1.0, 0.37, 12.0),
        ("ankle_dorsiflexion_power", 1.0, 2.80, 54.0),
        ("knee_flexion_power", -1.0, -0.98, 92.0),
        ("ground_force_vertical", 1.0, 1.10, 14.0),
        ("ground_force_fore_aft", 1.0, 0.19, 52.0),
        ("ground_force_fore_aft", -1.0, -0.16, 10.0),
        ("knee_flexion_angle", 1.0, 59.1, 72.0),
        ("hip_flexion_angle", -1.0, -5.8 - TILT, 52.0),
        ("ankle_dorsiflexion_angle", -1.0, -19.8, 64.0),
        ("hip_adduction_angle", 1.0, 5.2, 18.0),
        ("pelvis_obliquity_angle", 1.0, 4.07, 16.0),
        ("pelvis_rotation_angle", 1.0, 4.45, 2.0),
    ];
    for (id, sign, value, percent) in peaks {
        let (found, at) = peak(&mean(id, FREE), sign);
        assert!(
            (found - value).abs() < 0.01 * value.abs().max(1.0) && (at - percent).abs() < 1e-9,
            "{id}: {found} at {at} %"
        );
    }
}

#[test]
fn between_the_speeds_a_straight_line_and_outside_the_nearest() {
    for pair in SPEEDS.windows(2) {
        let middle = mean("knee_flexion_moment", 0.25 * pair[0] + 0.75 * pair[1]);
        let (low, high) = (mean("knee_flexion_moment", pair[0]), mean("knee_flexion_moment", pair[1]));
        for i in 0..BAND_SAMPLES {
            assert!((middle[i] - 0.25 * low[i] - 0.75 * high[i]).abs() < 1e-12, "{i}");
        }
    }
    for (outside, nearest) in [(0.05, 0.172), (1.1, 0.694)] {
        let (found, expected) = (
            band("hip_flexion_power", outside, Convention::Opensim).unwrap(),
            band("hip_flexion_power", nearest, Convention::Opensim).unwrap(),
        );
        assert!(found.outside_of_speeds && found.mean == expected.mean && found.sd == expected.sd);
        assert!(found.citation.contains("nearest"), "{}", found.citation);
    }
    // Kinetics grow with speed: a band of another speed is another band.
    assert!(peak(&mean("hip_flexion_moment", 0.694), 1.0).0 > 2.0 * peak(&mean("hip_flexion_moment", 0.172), 1.0).0);
}

#[test]
fn times_and_distances_of_an_adults_free_walk() {
    let (leg, gravity): (f64, f64) = (0.935, 9.80665);
    let speed = FREE * (gravity * leg).sqrt();
    assert!((dimensionless_speed(speed, gravity, leg).unwrap() - FREE).abs() < 1e-12);
    let table = time_distance(FREE, leg, gravity);
    let find = |id: &str| table.iter().find(|row| row.id == id).unwrap_or_else(|| panic!("no {id}"));
    let mean = |id: &str| find(id).mean.unwrap();
    // Cadence times step length is the speed.
    assert!((mean("cadence") / 60.0 * mean("step_length") - speed).abs() < 1e-9);
    assert!((mean("cadence") - 109.8).abs() < 0.1 && (mean("step_length") - 0.710).abs() < 0.001);
    assert!((mean("stride_length") - 2.0 * mean("step_length")).abs() < 1e-12);
    let [low, high] = find("stance").range.unwrap();
    assert!(
        [mean("stance") - 59.0, low - 55.0, high - 63.0].iter().all(|off| off.abs() < 1e-9),
        "{:?}",
        find("stance")
    );
    assert!((mean("stance") + mean("swing") - 100.0).abs() < 1e-9);
    assert!((mean("double_support") - 19.0).abs() < 1e-9);
    let ordered = |row: &NormalRange| {
        row.range.is_none_or(|[low, high]| low < high && row.mean.is_none_or(|m| low < m && m < high))
    };
    assert!(table.iter().all(ordered), "{table:?}");
    assert!(table.iter().all(|row| row.source.contains("children") || row.source.contains("all ages")));
    // Beyond the speeds measured cadence and step still make the speed.
    for beyond in [0.08, 0.9] {
        let table = time_distance(beyond, leg, gravity);
        let mean = |id: &str| table.iter().find(|row| row.id == id).unwrap().mean.unwrap();
        let speed: f64 = beyond * (gravity * leg).sqrt();
        assert!((mean("cadence") / 60.0 * mean("step_length") - speed).abs() < 1e-9, "{beyond}");
    }
    for bad in [[0.0, leg, gravity], [FREE, 0.0, gravity], [FREE, leg, f64::NAN], [-1.0, leg, gravity]] {
        assert!(time_distance(bad[0], bad[1], bad[2]).is_empty(), "{bad:?}");
    }
    assert!(dimensionless_speed(1.0, 9.8, 0.0).is_none() && dimensionless_speed(-1.0, 9.8, 1.0).is_none());
}

#[test]
fn each_curve_is_read_to_its_place_and_a_missing_or_short_one_is_named() {
    let bands = Bands::read(TIMES, CURVES).unwrap();
    let of = |name: &str| bands.curves.iter().find(|(known, _)| *known == name).map(|(_, curves)| curves).unwrap();
    // The first and the last line of the file, and means and deviations that differ.
    assert_eq!((of("pelvis_tilt_angle").mean[0][0], of("pelvis_tilt_angle").sd[0][0]), (11.8, 5.15));
    let last: Vec<&str> = CURVES.lines().last().unwrap().split(',').collect();
    assert_eq!(last[..3], ["ground_force_fore_aft", "sd", "0.694"]);
    assert_eq!(of("ground_force_fore_aft").sd[4][50].to_string(), last[53]);
    let without = CURVES.lines().filter(|line| !line.starts_with("knee_flexion_moment,sd,0.429")).collect::<Vec<_>>();
    assert!(Bands::read(TIMES, &without.join("\n")).unwrap_err().contains("no `knee_flexion_moment`"));
    let line = CURVES.lines().nth(1).unwrap();
    let (short, _) = line.rsplit_once(',').unwrap();
    assert!(Bands::read(TIMES, &CURVES.replacen(line, short, 1)).unwrap_err().contains(short));
}
