//! Motions of BIDS data sets: both tables together, missing values, and refusals.

use ambulo_formats::bids_motion::{BidsChannel, BidsMotion};

const CHANNELS: &str = "name\tcomponent\ttype\ttracked_point\tunits\tsampling_frequency\tstatus
LASI_x\tx\tPOS\tLASI\tmm\t100\tgood
LASI_y\ty\tPOS\tLASI\tmm\t100\tgood
LASI_z\tz\tpos\tLASI\tmm\t100\tbad
knee\tn/a\tJNTANG\tRightKnee\tdeg\tn/a\tn/a
";

#[test]
fn both_tables_are_read_together() {
    let read = BidsMotion::read(b"1\t2\t3\t-10\nn/a\t5\t6\t\n", CHANNELS.as_bytes()).unwrap();
    assert_eq!((read.rate_hz, read.frames(), read.channels.len()), (Some(100.0), 2, 4));
    assert!(read.columns[0][1].is_nan() && read.columns[3][1].is_nan());
    assert_eq!((&read.columns[1][..], read.columns[3][0]), (&[2.0, 5.0][..], -10.0));
    let z = BidsChannel {
        name: "LASI_z".into(),
        component: "z".into(),
        kind: "POS".into(),
        tracked_point: "LASI".into(),
        units: "mm".into(),
        is_bad: true,
    };
    assert_eq!((&read.channels[2], read.channels[3].component.as_str()), (&z, ""));
}

#[test]
fn the_reason_of_a_refusal_is_the_true_one() {
    let refused = |motion: &str, channels: &str| {
        BidsMotion::read(motion.as_bytes(), channels.as_bytes()).unwrap_err().to_string()
    };
    let text = refused("1\t2\t3\n", CHANNELS);
    assert!(text.contains("line 1: found 3 values; expected 4, one for each row of the table of channels"), "{text}");
    let text = refused("LASI_x\tLASI_y\tLASI_z\tknee\n1\t2\t3\t4\n", CHANNELS);
    assert!(text.contains("found `LASI_x`; expected a number or n/a; this table has no heading"), "{text}");
    let text = refused("1\n", "name\tunits\nx\tmm\n");
    assert!(text.contains("at least name and type"), "{text}");
    for (motion, channels) in [("", CHANNELS), ("1\t2\t3\t4\n", ""), ("1\n", "name\ttype\n")] {
        assert!(BidsMotion::read(motion.as_bytes(), channels.as_bytes()).is_err(), "{motion:?} {channels:?}");
    }
}
