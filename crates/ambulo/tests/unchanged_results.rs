//! Results of whole studies do not change unnoticed: every number of an outcome is compared with that of a recorded
//! run.
//!
//! A number that changes is not wrong for that: whoever changes it on purpose records the new ones (AMBULO_WRITE=1) and
//! says why. What is right is tested elsewhere, against laws, plates and other programs, with bounds that a small
//! defect can hide in.

use crate::plug_in_gait::PEOPLE;
use crate::shared_data::data;
use ambulo::findings::Findings;
use ambulo::gait::Gait;
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::motion::Motion;
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalkSettings, synthesise};
use ambulo::study::{self, GroundSettings, Outcome, Settings, Source};
use std::collections::BTreeMap;
use std::fmt::{Debug, Write as _};
use std::path::Path;

/// Difference of two statistics, relative to the root mean square of the numbers, that is none: iterations end at about
/// 1e-9.
const SAME: f64 = 1e-6;
/// Numbers below this are rounding.
const NOTHING: f64 = 1e-9;

/// The numbers and words of a value's `Debug` text, by the names of the fields that lead to them.
#[derive(Default)]
struct Contents {
    numbers: BTreeMap<String, Vec<f64>>,
    words: BTreeMap<String, String>,
}

impl Contents {
    fn add(&mut self, name: &str, value: &dyn Debug) {
        let mut path = vec![name.to_owned()];
        for line in format!("{value:#?}").lines() {
            let depth = (line.len() - line.trim_start().len()) / 4 + 1;
            let line = line.trim().trim_end_matches(',');
            let (field, content) = match line.split_once(": ") {
                Some((field, content)) if field.chars().all(|c| c.is_alphanumeric() || c == '_') => (field, content),
                _ => ("", line),
            };
            path.truncate(depth);
            path.resize(depth, String::new());
            path.push(field.to_owned());
            let place = path.iter().filter(|part| !part.is_empty()).cloned().collect::<Vec<_>>().join(".");
            match content.parse::<f64>() {
                Ok(number) => self.numbers.entry(place).or_default().push(number),
                Err(_) if content.ends_with(['{', '(', '[']) || content.starts_with(['}', ')', ']']) => (),
                Err(_) => *self.words.entry(place).or_default() += content,
            }
        }
    }

    /// One line per name: how many numbers, their root mean square, and a sum in which each has another weight; or a
    /// checksum of the words.
    fn lines(&self, study: &str) -> BTreeMap<String, String> {
        let mut lines = BTreeMap::new();
        for (name, numbers) in &self.numbers {
            let known: Vec<f64> = numbers.iter().copied().filter(|x| x.is_finite()).collect();
            let square = known.iter().map(|x| x * x).sum::<f64>() / known.len().max(1) as f64;
            let pattern: f64 = known.iter().enumerate().map(|(k, x)| x * (1.0 + k as f64).sin()).sum();
            let text = format!("{} {:e} {:e}", numbers.len(), square.sqrt(), pattern / known.len().max(1) as f64);
            lines.insert(format!("{study} {name}"), text);
        }
        for (name, words) in &self.words {
            let sum =
                words.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3));
            lines.insert(format!("{study} {name} (words)"), format!("{sum:016x}"));
        }
        lines
    }
}

fn contents(outcome: &Outcome) -> Contents {
    let mut contents = Contents::default();
    contents.add("analysis", &outcome.analysis);
    let powers = outcome.analysis.powers(&outcome.body);
    contents.add("powers", &outcome.body.coordinate_ids().map(|id| powers.column(id)).collect::<Vec<_>>());
    contents.add("activity", &outcome.activity);
    contents.add("times_and_distances", &outcome.times_and_distances);
    contents.add("prediction", &outcome.prediction);
    contents.add("mass", &outcome.mass);
    contents.add("quality", &outcome.quality);
    contents.add("verdict", &outcome.verdict);
    contents
}

/// Statistics that differ.
fn differences(found: &BTreeMap<String, String>, recorded: &BTreeMap<String, String>) -> Vec<String> {
    let mut differences = Vec::new();
    for name in found.keys().chain(recorded.keys().filter(|name| !found.contains_key(*name))) {
        let (new, old) = (found.get(name), recorded.get(name));
        if !new.zip(old).is_some_and(|(new, old)| is_same(new, old)) {
            differences.push(format!("{name}: {}, recorded {}", text(new), text(old)));
        }
    }
    differences
}

fn text(of: Option<&String>) -> &str {
    of.map_or("nothing", String::as_str)
}

fn is_same(new: &str, old: &str) -> bool {
    let numbers = |line: &str| -> Vec<f64> { line.split(' ').filter_map(|word| word.parse().ok()).collect() };
    let (a, b) = (numbers(new), numbers(old));
    if new == old {
        return true;
    }
    let [count_a, rms_a, pattern_a] = a[..] else { return false };
    let [count_b, rms_b, pattern_b] = b[..] else { return false };
    let allowed = SAME * rms_a.max(rms_b) + NOTHING;
    (count_a - count_b).abs() < 0.5 && (rms_a - rms_b).abs() < allowed && (pattern_a - pattern_b).abs() < allowed
}

/// Compares the outcomes of a study with recorded ones.
fn compare(study: &str, outcome: &Outcome) {
    let found = contents(outcome).lines(study);
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/testdata/unchanged_results").join(format!("{study}.txt"));
    if std::env::var_os("AMBULO_WRITE").is_some() {
        let mut text = String::new();
        found.iter().for_each(|(name, line)| writeln!(text, "{name} = {line}").unwrap());
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
    }
    let text = std::fs::read_to_string(&path).unwrap();
    let pair = |line: &str| line.split_once(" = ").map(|(name, line)| (name.to_owned(), line.to_owned()));
    let recorded = text.lines().filter_map(pair).collect();
    let differences = differences(&found, &recorded);
    assert!(differences.is_empty(), "results changed (AMBULO_WRITE=1 records them anew):\n{}", differences.join("\n"));
}

fn predicted() -> Settings {
    Settings { ground: GroundSettings::Predicted, ..Settings::default() }
}

#[test]
fn a_walk_with_plates() {
    let Some(data) = data() else { return };
    let source = PEOPLE[0].source(&data);
    compare("plates", &study::run(source, &Settings::default(), &mut Findings::default()).unwrap());
}

#[test]
fn a_walk_whose_plates_are_compared_with_a_prediction() {
    let Some(data) = data() else { return };
    let source = PEOPLE[0].source(&data);
    compare("prediction", &study::run(source, &predicted(), &mut Findings::default()).unwrap());
}

#[test]
fn a_synthetic_walk_as_coordinates() {
    let build = Build::usual(SegmentTable::DeLevaMale);
    let gait = Gait::named("free").unwrap();
    let settings =
        SyntheticWalkSettings { gait: &gait, build, mode: SyntheticMode::Optimal, cycles: 3, rate_hz: 100.0 };
    let walk = synthesise(&settings, &mut Findings::default()).unwrap();
    let (model, trajectory) = (walk.human.model, walk.trajectory);
    let columns = model.coordinate_ids().map(|id| Some(trajectory.values(id).to_vec())).collect();
    let motion = Motion { origin: "walk".to_owned(), times: trajectory.grid().times(), columns };
    let source = Source::coordinates(model, motion);
    compare("synthetic", &study::run(source, &predicted(), &mut Findings::default()).unwrap());
}

#[test]
fn a_number_that_changes_is_seen() {
    #[derive(Debug)]
    #[expect(dead_code, reason = "only their text is read")]
    struct Pair {
        forces: [f64; 3],
        name: &'static str,
    }
    let lines = |forces, name| {
        let mut contents = Contents::default();
        contents.add("pair", &vec![Pair { forces, name }]);
        contents.lines("study")
    };
    let recorded = lines([1.0, 2.0, 3.0], "walk");
    assert_eq!(recorded.keys().collect::<Vec<_>>(), ["study pair.forces", "study pair.name (words)"]);
    for (changed, same) in [
        (lines([1.0, 2.0, 3.0 + 1e-8], "walk"), true),
        (lines([1.0, 2.0, 3.001], "walk"), false),
        (lines([1.0, 3.0, 2.0], "walk"), false),
        (lines([1.0, 2.0, 3.0], "run"), false),
    ] {
        assert_eq!(differences(&changed, &recorded).is_empty(), same, "{changed:?}");
    }
    assert_eq!(differences(&BTreeMap::new(), &recorded).len(), 2);
}
