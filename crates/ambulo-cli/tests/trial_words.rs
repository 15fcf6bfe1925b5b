//! Options of `ambulo forces` for every trial of a folder.

use ambulo::job::trials::TrialFiles;
use ambulo::study::StatedSize;
use ambulo_cli::internals::trial_command;

#[test]
fn the_command_has_the_files_and_sizes_of_the_trial_once() {
    let trial = TrialFiles {
        recording: "set/walk 1.c3d".into(),
        standing: Some("set/it's.c3d".into()),
        size: StatedSize { mass_kg: Some(70.5), height_m: None },
        ..TrialFiles::default()
    };
    if cfg!(unix) {
        let command = trial_command(&["--predict", "--mass", "80", "--from=0.5"], &trial).unwrap();
        let expected =
            r"ambulo forces 'set/walk 1.c3d' --predict --from=0.5 --static 'set/it'\''s.c3d' --mass 70.5 --output page";
        assert_eq!(command, expected);
        let command = trial_command(&["--static=other.c3d", "--mass=80"], &trial).unwrap();
        assert_eq!(command, "ambulo forces 'set/walk 1.c3d' --static=other.c3d --mass 70.5 --output page");
    }
}

#[test]
fn the_folder_of_a_trial_is_not_chosen_after_the_dashes() {
    for words in [["-o", "there"], ["--keep", "grf"]] {
        let refused = trial_command(&words, &TrialFiles::default()).unwrap_err();
        assert!(refused.to_string().contains("ambulo batch [OPTIONS] -- OPTIONS"), "{refused}");
    }
}
