//! Settings of a controller by the names that they have in scenes.

use ambulo_walk::control::ControlSettings;
use ambulo_walk::internals::rounded;
use ambulo_walk::tuning::Gain;

#[test]
fn a_gain_changes_its_own_setting_alone() {
    for gain in Gain::ALL {
        let mut settings = ControlSettings::default();
        gain.check(&settings).unwrap();
        gain.set(&mut settings, gain.bounds[1]);
        let same = |other: &Gain| (other.value(&settings) - other.value(&ControlSettings::default())).abs() < 1e-12;
        let changed: Vec<&str> = Gain::ALL.iter().filter(|other| !same(other)).map(|other| other.name).collect();
        assert_eq!(changed, [gain.name]);
        gain.set(&mut settings, 2.0 * gain.bounds[1]);
        let error = gain.check(&settings).unwrap_err().to_string();
        assert!(error.contains(gain.name) && error.contains(gain.unit), "{error}");
    }
}

#[test]
fn gains_are_found_by_name() {
    assert_eq!(Gain::named(&["damping", "height"]).unwrap().len(), 2);
    assert_eq!(Gain::usual(false).len() + 1, Gain::usual(true).len());
    for (names, expected) in
        [(vec!["hight"], "one of `stiffness`"), (vec!["height", "height"], "`height` twice"), (vec![], "no gain")]
    {
        let error = Gain::named(&names).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn the_table_of_the_usual_settings_is_empty_and_numbers_are_short() {
    let mut settings = ControlSettings::default();
    assert_eq!(Gain::table(&settings, None, &[]), "control = {}");
    assert_eq!(Gain::table(&settings, None, &Gain::named(&["damping"]).unwrap()), "control = { damping = 0.1 }");
    settings.costs.angle = 5.25 * 1_f64.to_radians();
    settings.stiffness = 123.4;
    assert_eq!(Gain::table(&settings, None, &[]), "control = { stiffness = 123.4, costs = { angle_deg = 5.25 } }");
    settings.costs = ControlSettings::default().costs;
    settings.delay_s = 0.04;
    let expected = "control = { stiffness = 123.4, delay = 0.04, torques = \"mine.toml\" }";
    assert_eq!(Gain::table(&settings, Some("mine.toml"), &[]), expected);
    assert_eq!(rounded(0.123_456).to_bits(), 0.1235_f64.to_bits());
}
