//! Hashes of files, and the record of a run.

use ambulo_cli::internals::{Record, hash};

#[test]
fn a_hash_is_the_sha_256_of_the_standard() {
    assert_eq!(hash(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

#[test]
fn a_record_that_names_a_file_outside_of_its_folder_is_none() {
    let of = |name: &str| Record::from_summary(format!(r#"{{"run_id": "1", "files": {{"{name}": "2"}}}}"#).as_bytes());
    assert!(of("figures/energy.svg").is_some());
    assert_eq!([of("../mine.txt"), of("/etc/passwd"), of("")], [None, None, None]);
    assert_eq!(Record::from_summary(b"{}"), None);
}
