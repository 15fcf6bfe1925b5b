//! Patterns of paths.

use ambulo::internals::Pattern;

#[test]
fn a_star_stays_in_its_folder_and_two_stars_do_not() {
    for (pattern, path, fits) in [
        ("a.c3d", "a.c3d", true),
        ("a.c3d", "ab.c3d", false),
        ("*.c3d", "walk 1.c3d", true),
        ("*.c3d", "x/walk.c3d", false),
        ("x/*", "x/walk.c3d", true),
        ("x/*", "x/y/walk.c3d", false),
        ("x/**", "x/y/walk.c3d", true),
        ("**/*.c3d", "walk.c3d", true),
        ("**/*.c3d", "x/y/walk.c3d", true),
        ("**/y/*.c3d", "x/y/walk.c3d", true),
        ("**/y/*.c3d", "xy/walk.c3d", false),
        ("walk?.c3d", "walk7.c3d", true),
        ("walk?.c3d", "walk.c3d", false),
        ("w*k*", "walk", true),
        ("\u{e4}*", "\u{e4}b", true),
        ("", "", true),
        ("", "a", false),
    ] {
        assert_eq!(Pattern::new(pattern).matches(path), fits, "{pattern} {path}");
    }
}

#[test]
fn no_pattern_takes_long() {
    assert!(!Pattern::new(&"*a".repeat(2000)).matches(&"a".repeat(1000)));
    assert!(Pattern::new(&"*".repeat(3001)).matches("a"));
}
