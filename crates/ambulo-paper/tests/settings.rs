//! Settings: files, names, and what they change.

use ambulo_paper::internals::{CLAIMS, statement};
use ambulo_paper::{
    Claim, ClaimKind, Evidence, FRICTION, Footwear, GAITS, KNOTS, NAMED, OpenKind, Scope, Setting, TrialSettings,
    claims, former_tally, number, open_values, paper_human, tally,
};
use ambulo_walk::gait::{Gait, Pelvis};
use std::fs;
use std::path::{Path, PathBuf};

fn named(name: &str) -> Setting {
    Setting::named(name).unwrap().unwrap()
}

fn refused(text: &str) -> String {
    Setting::from_toml(text).unwrap_err().to_string()
}

/// The folder in which users find the settings.
fn shipped() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/paper")
}

#[test]
fn a_setting_is_read_as_it_is_written() {
    for (name, text) in NAMED {
        let setting = named(name);
        assert_eq!(setting.name, name);
        assert_eq!(Setting::from_toml(&setting.to_toml()).unwrap(), setting);
        let own = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("data/settings/{name}.toml"));
        for path in [own, shipped().join(format!("{name}.toml"))] {
            if std::env::var_os("AMBULO_WRITE").is_some() {
                fs::create_dir_all(path.parent().unwrap()).unwrap();
                fs::write(&path, setting.to_toml()).unwrap();
                continue;
            }
            let found = fs::read_to_string(&path).unwrap_or_default();
            assert!(found == setting.to_toml(), "{} is old: AMBULO_WRITE=1 writes it", path.display());
            assert_eq!(text, setting.to_toml());
        }
    }
    let drawn = Setting::drawn(3, 4);
    assert_eq!(Setting::from_toml(&drawn.to_toml()).unwrap().values(), drawn.values());
}

#[test]
fn a_file_may_list_the_claims_that_count_or_counted() {
    let statements = CLAIMS.map(|id| statement(id).unwrap());
    for (id, statement) in CLAIMS.iter().zip(statements) {
        assert!(statement.could_fail(), "{id}");
    }
}

#[test]
fn a_file_may_leave_out_values() {
    let setting = Setting::from_toml("[figure]\nstature_m = 1.7\n").unwrap();
    let default = Setting::papers_results().unwrap();
    assert!((setting.of("stature_m") - 1.7).abs() < 1e-12 && setting.holds.is_none());
    assert_eq!(setting.values()[1..], default.values()[1..]);
    let knot = "[knots.knee]\n\"swing peak\" = { angle_deg = 2.5 }\n";
    let changed = Setting::from_toml(knot).unwrap();
    let other = changed.values().iter().zip(default.values()).filter(|(a, b)| (*a - *b).abs() > 1e-12).count();
    assert_eq!(other, 1);
}

#[test]
fn unknown_keys_and_values_out_of_range_are_refused_with_their_line() {
    assert!(refused("[figure]\nstatur_m = 1.7\n").contains("line 2, `figure.statur_m`: unknown key"));
    assert!(refused("[figure]\nstatur_m = 1.7\n").contains("did you mean `stature_m`?"));
    assert!(refused("[figures]\n").contains("unknown key"));
    assert!(refused("[knots.toe]\n").contains("unknown key"));
    assert!(refused("[knots.knee]\n\"swing peek\" = {}\n").contains("did you mean `swing peak`?"));
    assert!(refused("[knots.knee]\n\"swing peak\" = { angle = 1 }\n").contains("unknown key"));
    assert!(refused("[figure]\nstature_m = 3\n").contains("found 3; expected 1.65 to 1.95 m"));
    assert!(refused("[figure]\ntoe_spheres = 1\n").contains("expected true or false"));
    assert!(refused("holds = [\"c9\"]\n").contains("expected one of"));
}

#[test]
fn every_value_has_a_range_a_source_and_a_reason() {
    assert!(open_values().len() >= 45);
    for open in open_values() {
        assert!(open.source.len() > 10 && open.why.len() > 10, "{}", open.name());
        if let OpenKind::Number([least, most]) | OpenKind::Positive([least, most]) = open.kind {
            assert!(least < most, "{}", open.name());
        }
    }
    for (name, _) in NAMED {
        let setting = named(name);
        let allowed = open_values().iter().zip(setting.values()).all(|(open, value)| open.allows(*value));
        assert!(allowed, "{name} has a value that is not plausible");
    }
}

#[test]
fn the_default_is_of_plausible_people() {
    let setting = Setting::papers_results().unwrap();
    // Table 1 taken literally, two spheres of each foot, a slow walk with all angles of its speed.
    assert!(setting.of("foot_of_table_1_from_the_ankle") > 0.5 && setting.of("toe_spheres") < 0.5);
    assert!((0.5..=0.62).contains(&setting.of("standard_step_m")));
    assert!(setting.of("short_step_length") >= 0.38, "torques are not lower because accelerations are");
    let knots = &setting.values()[open_values().len() - 2 * KNOTS.len()..];
    let within = |knot: &[f64]| knot[0].abs() <= 8.0 && knot[1].abs() <= 5.0;
    assert!(knots.chunks(2).all(within), "{knots:?}");
}

#[test]
fn the_setting_of_children_walks_the_built_in_gaits() {
    let setting = named("schwartz-children");
    for name in GAITS {
        let built_in = Gait::named(name).unwrap();
        assert_eq!(setting.gait(&built_in), Gait { pelvis: Pelvis::Vertical, ..built_in.clone() });
    }
}

#[test]
fn the_former_default_has_its_former_counts() {
    let setting = named("schwartz-children");
    let evidence = Evidence::gather(&mut |trial: &TrialSettings<'_>| setting.walk(trial), Scope::Full, None).unwrap();
    let judged = claims(&evidence, None);
    assert_eq!(former_tally(&judged), [10, 22]);
    let lost = setting.lost(&judged).unwrap();
    assert!(lost.is_empty(), "{lost:?}");
    assert_eq!(tally(&judged)[0], setting.holds.unwrap().len());
}

#[test]
fn a_claim_that_no_longer_holds_is_reported() {
    let claim = |id: &'static str, pass| {
        let kind = ClaimKind::Paper;
        let (paper, criterion, headline, note) = ("", "", "", String::new());
        Claim {
            id,
            kind,
            paper,
            criterion,
            headline,
            paper_mode: Vec::new(),
            corrected: None,
            pass,
            note,
            former: None,
            experiment: None,
        }
    };
    let mut setting = Setting::drawn(1, 1);
    setting.holds = Some(vec!["c1".into(), "e1".into()]);
    assert_eq!(setting.lost(&[claim("c1", true), claim("e1", false)]), Some(vec!["e1".to_owned()]));
    assert_eq!(setting.lost(&[claim("c1", true), claim("e1", true)]), Some(Vec::new()));
    assert_eq!(setting.judged(&[claim("c1", true), claim("e1", false)]).holds, Some(vec!["c1".to_owned()]));
    setting.holds = None;
    assert_eq!(setting.lost(&[]), None);
}

/// A figure of 100 kg of the same density has thicker segments and soles, also if its stature is changed.
#[test]
fn another_stature_keeps_the_density_of_a_heavier_figure() {
    let setting = named("schwartz-children");
    let stature = open_values().iter().position(|open| open.key == "stature_m").unwrap();
    let taller = setting.with(stature, 1.75);
    let mut mode = |trial: &TrialSettings<'_>| taller.walk(trial);
    let evidence = Evidence::gather(&mut mode, Scope::Sampled, None).unwrap();
    let judged = claims(&evidence, None);
    let swing = judged.iter().find(|claim| claim.id == "f2").unwrap();
    assert!(number(&swing.paper_mode, "dense_100_kg_swing_difference_percent") > 0.5, "{}", swing.note);
}

#[test]
fn each_value_changes_the_walk() {
    let (human, setting) = (paper_human().unwrap(), named("schwartz-children"));
    for (place, open) in open_values().iter().enumerate() {
        let name = ["short", "long", "goose"].into_iter().find(|name| open.key.starts_with(name));
        let gait = Gait::named(name.unwrap_or("standard")).unwrap();
        let shoes = if open.key.starts_with("soft") { Footwear::Soft } else { Footwear::Rigid };
        let trial = TrialSettings { gait: &gait, human: &human, shoes, friction: FRICTION, rate_hz: 200.0, cycles: 3 };
        let other = match open.kind {
            OpenKind::Switch(_) => 1.0 - setting.values()[place],
            OpenKind::Number([least, most]) | OpenKind::Positive([least, most]) => 0.7 * least + 0.3 * most,
        };
        let changed = setting.with(place, other);
        if open.key == "angles_of_the_step" {
            // Both readings are the same at 0.75 m.
            continue;
        }
        let [own, changed] = [&setting, &changed].map(|setting| setting.walk(&trial).unwrap());
        assert!(own.recording.efforts != changed.recording.efforts, "{}", open.name());
    }
}
