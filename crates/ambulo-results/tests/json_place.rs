//! Keys that lead to an error in JSON.

use ambulo_results::json_place;
use serde::Deserialize;
use serde::de::{Deserializer, Error};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "only errors are of interest")]
struct Run {
    name: String,
    trials: Vec<Trial>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "only errors are of interest")]
struct Trial {
    mass: f64,
    times: [u8; 2],
    #[serde(default, deserialize_with = "kilograms")]
    unit: Vec<String>,
    #[serde(default)]
    day: Day,
}

fn kilograms<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<String>, D::Error> {
    let units = Vec::<String>::deserialize(from)?;
    if units.iter().all(|unit| unit == "kg") { Ok(units) } else { Err(D::Error::custom("no kilograms")) }
}

#[derive(Debug, Default, Deserialize)]
#[serde(try_from = "u8")]
struct Day;

impl TryFrom<u8> for Day {
    type Error = String;

    fn try_from(day: u8) -> Result<Day, String> {
        if (1..=31).contains(&day) { Ok(Day) } else { Err("no day".to_owned()) }
    }
}

fn place(text: &str) -> String {
    let found = json_place(text.as_bytes(), &|text| serde_json::from_slice::<Run>(text).err());
    let keys = found.strip_prefix('`').and_then(|found| found.strip_suffix("`: "));
    keys.unwrap_or(&found).to_owned()
}

#[test]
fn the_keys_lead_to_the_error() {
    let good = r#"{"mass": 70, "times": [1, 2]}"#;
    let in_trial = |trial: &str| place(&format!("{{\n\"name\": \"a, \\\" b\", \"trials\": [{good},\n {trial}]}}"));
    for (trial, expected) in [
        (r#"{"mass": "70", "times": [1, 2]}"#, "trials[1].mass"),
        (r#"{"mass": [70], "times": [1, 2]}"#, "trials[1].mass"),
        (r#"{"mass": {"kg": 70}, "times": [1, 2]}"#, "trials[1].mass"),
        (r#"{"mass": null, "times": [1, 2]}"#, "trials[1].mass"),
        (r#"{"mass": 70, "times": [1, 256]}"#, "trials[1].times[1]"),
        (r#"{"mass": 70, "times": [1]}"#, "trials[1].times"),
        (r#"{"mass": 70, "times": [1, 2], "m\u00e4ss": 3}"#, "trials[1].mäss"),
        (r#"{"mass": 70}"#, "trials[1]"),
        ("70", "trials[1]"),
    ] {
        assert_eq!(in_trial(trial), expected, "{trial}");
    }
}

#[test]
fn errors_of_the_whole_have_no_keys() {
    for text in ["", "[]", "3", "{}", r#"{"name": "a"}"#] {
        assert_eq!(place(text), "", "{text}");
    }
    assert_eq!(place(r#"{"name": "a", "trials": []}"#), "", "nothing is wrong");
}

/// Errors of functions and of types that are read from others state no place of their own.
#[test]
fn errors_that_state_no_place_have_keys() {
    let text = r#"{"name": "a", "trials": [{"mass": 70, "times": [1, 2], "unit": ["kg", "lb"]}]}"#;
    assert_eq!(place(text), "trials[0].unit");
    let text = r#"{"name": "a", "trials": [{"mass": 70, "times": [1, 2], "day": 32}]}"#;
    assert_eq!(place(text), "trials[0].day");
}
