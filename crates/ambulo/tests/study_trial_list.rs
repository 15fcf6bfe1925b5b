//! Statements of a laboratory about the files of a folder of trials (`trials.toml`).

use ambulo::study::{StatedTrial, TrialList};

const LIST: &str = "
    [[trial]]
    files = \"ann/*\"
    person = \"Ann\"
    mass = 61.5
    static = \"ann/still.c3d\"
    [[trial]]
    files = \"ann/late/**\"
    mass = 62
    exclude = \"partial hits\"
";

#[test]
fn the_last_statement_about_a_file_counts() {
    let list = TrialList::from_toml(LIST).unwrap();
    assert_eq!(list.of("ben/walk.c3d"), StatedTrial::default());
    let walk = list.of("ann/walk.c3d");
    assert_eq!((walk.person.as_deref(), walk.mass_kg), (Some("Ann"), Some(61.5)));
    assert_eq!(walk.paths().collect::<Vec<_>>(), ["ann/still.c3d"]);
    let late = list.of("ann/late/walk.c3d");
    assert_eq!((late.person, late.mass_kg, late.excluded.as_deref()), (None, Some(62.0), Some("partial hits")));
    let both = TrialList::from_toml("[[trial]]\nfiles='*'\nmass=1\nheight=2\n[[trial]]\nfiles='a'\nmass=3").unwrap();
    assert_eq!((both.of("a").mass_kg, both.of("a").height_m), (Some(3.0), Some(2.0)));
}

#[test]
fn an_entry_that_fits_no_file_is_named_with_its_line() {
    let list = TrialList::from_toml(LIST).unwrap();
    list.check_files(["ann/a.c3d", "ann/late/b.c3d"].into_iter()).unwrap();
    let error = list.check_files(["ann/a.c3d"].into_iter()).unwrap_err().to_string();
    assert!(error.contains("line 8") && error.contains("`ann/late/**`"), "{error}");
}

#[test]
fn a_mistake_is_named_with_its_place_and_what_was_expected() {
    for (text, expected) in [
        ("[[trial]]\nmass = 60", "`files`"),
        ("[[trial]]\nfiles = \"\"", "not empty"),
        ("[[trial]]\nfiles = \"*\"\nmass = -1", "above zero"),
        ("[[trial]]\nfiles = \"*\"\nmas = 60", "did you mean `mass`"),
        ("[[trial]]\nfiles = \"*\"\nstatic = 3", "a text in quotes"),
        ("[[trials]]\nfiles = \"*\"", "`trial`"),
        ("trial = 3", "[[trial]]"),
        ("[[trial", "not TOML"),
    ] {
        let error = TrialList::from_toml(text).unwrap_err().to_string();
        assert!(error.starts_with("line ") && error.contains(expected), "{text}: {error}");
    }
    assert_eq!(TrialList::from_toml("").unwrap(), TrialList::default());
}
