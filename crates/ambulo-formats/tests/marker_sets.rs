//! Sets of markers in a separate file.

use ambulo_formats::osim::{OsimMarkerSet, OsimModel};

/// As OpenSim 2 and 3 write it: padded text, comments, and elements for display.
const OLD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<OpenSimDocument Version="20302">
  <MarkerSet name="walk">
    <objects>
      <Marker name="ASIS">
        <!--Body segment in the model on which the marker resides.-->
        <body> pelvis </body>
        <location>   0.02000000   0.03000000   0.12800000 </location>
        <fixed> true </fixed>
        <VisibleObject name=""><show_axes> false </show_axes></VisibleObject>
      </Marker>
      <Marker name="KNEE"><body>femur_r</body><location>0 -0.4 0.05</location></Marker>
    </objects>
    <groups/>
  </MarkerSet>
</OpenSimDocument>"#;

/// As OpenSim 4 writes it: frames by socket, one of them an offset frame of a joint.
const NEW: &str = r#"<OpenSimDocument Version="40500"><MarkerSet name="walk"><objects>
      <Marker name="ASIS"><socket_parent_frame>/bodyset/pelvis</socket_parent_frame>
        <location>0.02 0.03 0.128</location><fixed>true</fixed></Marker>
      <Marker name="KNEE"><socket_parent_frame>/jointset/hip/femur_offset</socket_parent_frame>
        <location>0 -0.3 0.05</location></Marker>
    </objects></MarkerSet></OpenSimDocument>"#;

const MODEL: &str = r#"<OpenSimDocument Version="40000"><Model name="leg"><BodySet><objects>
    <Body name="pelvis"><mass>10</mass></Body><Body name="femur_r"><mass>8</mass></Body></objects></BodySet>
  <JointSet><objects>
    <WeldJoint name="root"><socket_parent_frame>/ground</socket_parent_frame>
      <socket_child_frame>/bodyset/pelvis</socket_child_frame></WeldJoint>
    <PinJoint name="hip"><socket_parent_frame>/bodyset/pelvis</socket_parent_frame><socket_child_frame>femur_offset</socket_child_frame>
      <coordinates><Coordinate name="hip_flexion"/></coordinates>
      <frames><PhysicalOffsetFrame name="femur_offset"><socket_parent>/bodyset/femur_r</socket_parent>
        <translation>0 -0.1 0</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame></frames></PinJoint>
  </objects></JointSet>
  <MarkerSet><objects>
    <Marker name="ASIS"><socket_parent_frame>/bodyset/femur_r</socket_parent_frame><location>9 9 9</location></Marker>
    <Marker name="SACR"><socket_parent_frame>/bodyset/pelvis</socket_parent_frame><location>-0.1 0 0</location></Marker>
  </objects></MarkerSet></Model></OpenSimDocument>"#;

fn model() -> OsimModel {
    OsimModel::read(MODEL.as_bytes()).unwrap()
}

fn set(text: &str) -> OsimMarkerSet {
    OsimMarkerSet::read(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn refusal(text: &str) -> String {
    let read = OsimMarkerSet::read(text.as_bytes()).and_then(|set| model().with_marker_set(&set));
    read.expect_err(text).to_string()
}

/// Markers of the model with the set: name, body, place, fixed.
fn placed(text: &str) -> Vec<(String, String, [f64; 3], bool)> {
    let with = model().with_marker_set(&set(text)).unwrap();
    with.markers.into_iter().map(|m| (m.name, m.body, m.location_m, m.fixed)).collect()
}

#[test]
fn sets_of_both_layouts_replace_markers_by_name_and_keep_the_others() {
    let expected = [
        ("ASIS".to_owned(), "pelvis".to_owned(), [0.02, 0.03, 0.128], true),
        ("SACR".to_owned(), "pelvis".to_owned(), [-0.1, 0.0, 0.0], false),
        ("KNEE".to_owned(), "femur_r".to_owned(), [0.0, -0.4, 0.05], false),
    ];
    assert_eq!(placed(OLD), expected);
    assert_eq!(placed(NEW), expected);
}

#[test]
fn a_set_without_its_document_and_the_set_of_a_model_are_read() {
    let bare =
        OLD.lines().skip(2).take_while(|line| !line.contains("</OpenSimDocument>")).collect::<Vec<_>>().join("\n");
    assert_eq!(set(&bare).markers.len(), 2);
    assert_eq!(set(MODEL).markers[1].name, "SACR");
}

#[test]
fn a_name_that_comes_twice_is_reported_and_the_later_marker_used() {
    let set = set(&OLD.replace("KNEE", "ASIS"));
    assert_eq!(set.markers.len(), 1);
    assert_eq!(set.markers[0].frame, "femur_r");
    assert!(set.remarks[0].to_string().contains("line 12: marker `ASIS` is also on line 5"), "{:?}", set.remarks);
}

#[test]
fn refusals_name_line_marker_and_what_is_missing() {
    let of = |from: &str, to: &str| refusal(&OLD.replace(from, to));
    for (message, words) in [
        (
            of("femur_r", "femur_l"),
            ["line 12", "Marker name=\"KNEE\"", "`femur_l`, which the model `leg` does not have"],
        ),
        (of("<body>femur_r</body>", ""), ["line 12", "no <body>", "the name of the body"]),
        (of("<location>0 -0.4 0.05</location>", ""), ["line 12", "no <location>", "x y z in metres"]),
        (of("0 -0.4 0.05", "0 -0.4"), ["line 12", "2 numbers", "three numbers"]),
        (of("name=\"KNEE\"", ""), ["line 12", "no name", "as in the recording"]),
        (
            refusal("<OpenSimDocument Version=\"40000\"><ScaleTool/></OpenSimDocument>"),
            ["<ScaleTool>", "a <MarkerSet>", ""],
        ),
        (refusal("<MarkerSet><objects/></MarkerSet>"), ["no <Marker>", "at least one", ""]),
        (refusal("PathFileType 4"), ["a marker file (.trc)", "expected an XML document", ""]),
        (refusal(" \n"), ["empty", "<MarkerSet>", ""]),
    ] {
        assert!(words.iter().all(|word| message.contains(word)), "{words:?} are not all in: {message}");
    }
}

#[test]
fn a_set_cut_anywhere_is_refused_without_a_panic() {
    for end in 0..NEW.len() {
        assert!(OsimMarkerSet::read(&NEW.as_bytes()[..end]).is_err(), "{end}");
    }
}
