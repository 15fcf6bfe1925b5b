//! How far figures of scenes walked, and whether they fell: the same steps and instants as the controller reports, and
//! distances of a known speed.

use crate::scene_walkers::{example, scene};
use ambulo::findings::{Code, Findings};
use ambulo::simulation::{FigureWalked, scene_walked};

/// How far the figure of a scene walked, and the findings of its run.
fn walked(text: &str) -> (FigureWalked, Findings) {
    let (mut scene, mut findings) = (scene(text), Findings::default());
    scene.run(&mut findings, |_| {}).unwrap();
    let mut all = scene_walked(&scene).unwrap();
    assert_eq!(all.len(), 1);
    (all.remove(0), findings)
}

#[test]
fn a_walker_covers_its_speed_times_the_time_in_steps_of_its_cadence() {
    let text =
        example("pushed-walker.toml").replace("duration = 8.0", "duration = 4.0").replace("rate = 4.2", "rate = 0");
    let (found, findings) = walked(&text);
    println!("{}", found.sentence());
    // 1.2 m/s for 4 s; the cadence of this walk is about 1.9 steps a second.
    assert!((found.distance_m - 4.8).abs() < 0.15, "{found:?}");
    assert!((7..=8).contains(&found.steps), "{found:?}");
    assert_eq!((found.fell_at_s, found.first_part.as_deref()), (None, None));
    assert!(!findings.has(Code::FigureFell) && found.sentence().starts_with("walked "));
}

#[test]
fn a_walker_who_is_struck_too_hard_falls_when_the_controller_says_so() {
    let text = example("pushed-walker.toml").replace("mass = 5\n", "mass = 60\n");
    let (found, findings) = walked(&text);
    println!("{}", found.sentence());
    let finding = findings.as_slice().iter().find(|finding| finding.code == Code::FigureFell).unwrap();
    assert!(finding.message.starts_with("`ann` fell; the muscles of "), "{}", finding.message);
    assert!(["hip", "knee"].contains(&found.first_part.as_deref().unwrap()), "{found:?}");
    assert!(found.sentence().starts_with(&format!("fell after {} steps at ", found.steps)), "{}", found.sentence());
    // Lighter, she walks on.
    assert_eq!(walked(&example("pushed-walker.toml").replace("duration = 8.0", "duration = 4.0")).0.fell_at_s, None);
}
