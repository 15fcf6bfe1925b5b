//! Options of `ambulo stream`.

use ambulo::spatial::Vec3;
use ambulo_cli::internals::{lab_axes, stream_source};

#[test]
fn without_an_address_only_this_computer_can_connect() {
    let source = |text: &str| stream_source(text).map_err(|refused| refused.to_string());
    assert_eq!(source("tcp:5005").unwrap(), "Tcp(127.0.0.1:5005)");
    assert_eq!(source("udp:0.0.0.0:7").unwrap(), "Udp(0.0.0.0:7)");
    assert_eq!(source("stdin").unwrap(), "Stdin");
    for wrong in ["tcp", "tcp:", "tcp:70000", "serial:5", "udp:host:5", ""] {
        assert!(source(wrong).unwrap_err().contains("udp:PORT"), "{wrong}");
    }
}

#[test]
fn axes_of_a_laboratory_become_forward_up_and_right() {
    let rotated = |axes: &str, lab: [f64; 3]| lab_axes(axes).unwrap().0 * Vec3::from(lab);
    assert_eq!(rotated("+x,+y", [1.0, 2.0, 3.0]), Vec3::new(1.0, 2.0, 3.0));
    // z is up and y forward, so that x is right.
    assert_eq!(rotated("+y,+z", [1.0, 2.0, 3.0]), Vec3::new(2.0, 3.0, 1.0));
    assert_eq!(rotated("-y,z", [1.0, 2.0, 3.0]), Vec3::new(-2.0, 3.0, -1.0));
    assert_eq!(lab_axes("x,-Z").unwrap().1, "+x,-z");
    for wrong in ["x,x", "+y,-y", "x", "w,z", "", "x,y,z"] {
        assert!(lab_axes(wrong).unwrap_err().contains("+y,+z"), "{wrong}");
    }
}
