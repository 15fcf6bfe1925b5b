//! Motions of Xsens MVN, in files made by hand. No file of MVN is among the shared recordings.

use ambulo_formats::mvnx::Mvnx;

/// A file of three segments and three frames.
fn file() -> String {
    r#"<?xml version="1.0" encoding="UTF-8"?>
<!-- Uncomment this part to use the DTD.
<!DOCTYPE mvnx SYSTEM "http://www.xsens.com/mvn/mvnx/schema.dtd">
-->
<mvnx xmlns="http://www.xsens.com/mvn/mvnx" version="4">
  <mvn version="2019.0.0" build="some build"/>
  <comment></comment>
  <subject label="MVN System 1" frameRate="60" segmentCount="3" recDate="Tue Nov 13 05:17:11.827 2018" configuration="LowerBody">
    <segments>
      <segment label="Pelvis" id="1"><points>
        <point label="jRightHip"><pos_b>0.000110 -0.095115 0.001080</pos_b></point>
      </points></segment>
      <segment label="RightUpperLeg" id="2"><points>
        <point label="jRightKnee"><pos_s>-0.000048 0.000000 -0.395876</pos_s></point>
      </points></segment>
      <segment label="RightLowerLeg" id="3"/>
    </segments>
    <sensors><sensor label="Pelvis"/></sensors>
    <joints><joint label="jRightHip"><connector1>Pelvis/jRightHip</connector1><connector2>RightUpperLeg/jRightHip</connector2></joint></joints>
    <footContactDefinition>
      <contactDefinition label="RightFoot_Toe" index="1"/>
      <contactDefinition label="RightFoot_Heel" index="0"/>
    </footContactDefinition>
    <frames segmentCount="3" sensorCount="1" jointCount="1">
      <frame time="0" tc="00:00:00:00" ms="0" type="tpose">
        <orientation>1 0 0 0 1 0 0 0 1 0 0 0</orientation>
        <position>0 0 0.86 0 -0.1 0.86 0 -0.1 0.47</position>
      </frame>
      <frame time="0" index="0" tc="04:17:11:50" type="normal">
        <orientation>1 0 0 0 0.707107 0 0.707107 0 1 0 0 0</orientation>
        <position>0 0 0.86 0 -0.1 0.86 0 -0.1 0.47</position>
        <footContacts>1 0</footContacts>
      </frame>
      <frame time="17" index="1" tc="04:17:11:51" type="normal">
        <orientation>1 0 0 0 1 0 0 0 1 0 0 0</orientation>
        <position>0 0 0.87 0 -0.1 0.86 0 -0.1 0.47</position>
        <footContacts>1 1</footContacts>
      </frame>
      <frame time="50" index="3" tc="04:17:11:53" type="normal">
        <orientation>1 0 0 0 1 0 0 0 1 0 0 0</orientation>
        <position>0 0 0.88 0 -0.1 0.86 0 -0.1 0.47</position>
      </frame>
    </frames>
  </subject>
  <securityCode code="x"/>
</mvnx>
"#
    .to_owned()
}

fn read(text: &str) -> Mvnx {
    let (mvnx, remarks) = Mvnx::read(text.as_bytes()).unwrap();
    assert!(remarks.is_empty(), "{remarks:?}");
    mvnx
}

/// The error after replacing the first `from` by `to`.
fn refused(from: &str, to: &str) -> String {
    let text = file();
    assert!(text.contains(from), "{from}");
    Mvnx::read(text.replacen(from, to, 1).as_bytes()).unwrap_err().to_string()
}

#[test]
fn a_file_is_read_with_segments_points_joints_and_frames() {
    let mvnx = read(&file());
    assert_eq!([mvnx.version.as_str(), &mvnx.software, &mvnx.subject], ["4", "2019.0.0", "MVN System 1"]);
    assert_eq!([mvnx.configuration.as_str(), &mvnx.recorded_on], ["LowerBody", "Tue Nov 13 05:17:11.827 2018"]);
    assert!((mvnx.rate_hz - 60.0).abs() < 1e-12);
    let labels: Vec<&str> = mvnx.segments.iter().map(|segment| segment.label.as_str()).collect();
    assert_eq!(labels, ["Pelvis", "RightUpperLeg", "RightLowerLeg"]);
    assert_eq!(mvnx.point("Pelvis", "jRightHip"), Some([0.000110, -0.095115, 0.001080]));
    assert_eq!(mvnx.point("RightUpperLeg", "jRightKnee"), Some([-0.000048, 0.0, -0.395876]), "version 3");
    assert_eq!(mvnx.point("RightLowerLeg", "jRightKnee"), None);
    assert_eq!(mvnx.joints[0].child, "RightUpperLeg/jRightHip");
    assert_eq!(mvnx.contacts, ["RightFoot_Heel", "RightFoot_Toe"], "in the order of their numbers");
    assert_eq!(mvnx.calibration.len(), 1);
    assert_eq!(mvnx.calibration[0].0, "tpose");
    let numbers: Vec<u64> = mvnx.frames.iter().map(|frame| frame.index).collect();
    assert_eq!(numbers, [0, 1, 3]);
    let pose = mvnx.frames[0].poses[1];
    let half = 0.5f64.sqrt();
    let off = pose.orientation.iter().zip([half, 0.0, half, 0.0]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 1e-12, "a quaternion of six decimals has length 1: {:?}", pose.orientation);
    assert!(pose.position.iter().zip([0.0, -0.1, 0.86]).all(|(a, b)| (a - b).abs() < 1e-15));
    assert_eq!(mvnx.frames[0].contacts, [true, false]);
    assert!(mvnx.frames[2].contacts.is_empty());
}

#[test]
fn prefixes_document_types_and_encodings_change_nothing() {
    let plain = read(&file());
    let mut prefixed = file().replace("xmlns=", "xmlns:m=");
    for begin in ["<", "</"] {
        for tag in [
            "mvn",
            "subject",
            "segment",
            "point",
            "pos_",
            "joint",
            "connector",
            "footCont",
            "contactD",
            "frame",
            "orient",
            "position",
            "comment",
            "sensor",
            "securityCode",
        ] {
            prefixed = prefixed.replace(&format!("{begin}{tag}"), &format!("{begin}m:{tag}"));
        }
    }
    assert!(prefixed.contains("<m:frame "));
    assert_eq!(read(&prefixed), plain);

    let typed = file().replace("<!-- Uncomment this part to use the DTD.", "").replace("-->", "");
    assert_eq!(read(&typed), plain, "a document type that names a file");

    let wide = |unit: fn(u16) -> [u8; 2]| file().encode_utf16().map(unit).collect::<Vec<_>>().concat();
    let files = [
        [b"\xef\xbb\xbf".as_slice(), file().as_bytes()].concat(),
        [b"\xff\xfe".as_slice(), &wide(u16::to_le_bytes)].concat(),
        [b"\xfe\xff".as_slice(), &wide(u16::to_be_bytes)].concat(),
    ];
    for bytes in files {
        assert_eq!(Mvnx::read(&bytes).unwrap().0, plain);
    }
    let latin: Vec<u8> = file().replace("MVN System 1", "M\u{fc}ller").chars().map(|c| c as u8).collect();
    assert_eq!(Mvnx::read(&latin).unwrap().0.subject, "M\u{fc}ller");
}

#[test]
fn poses_that_do_not_belong_to_the_segments_are_refused_with_frame_and_line() {
    let text = refused("1 0 0 0 0.707107 0 0.707107 0 1 0 0 0", "1 0 0 0 0.707107 0 0.707107 0");
    let wanted =
        "line 30, element <orientation>: found 8 numbers in frame 0; expected 12: w x y z for each of the 3 segments";
    assert!(text.starts_with(wanted), "{text}");
    let text = refused("<position>0 0 0.87", "<position>0 0 0.87 5");
    assert!(text.contains("<position>: found 10 numbers in frame 1; expected 9: x y z for each"), "{text}");
    let text = refused("1 0 0 0 0.707107 0 0.707107 0", "1 0 0 0 0 0 0 0");
    let wanted = "found the quaternion 0 0 0 0 of length 0.000 for `RightUpperLeg` in frame 0; expected a rotation: w \
        x y z of length 1";
    assert!(text.contains(wanted), "{text}");
    let text = refused("1 0 0 0 0.707107 0 0.707107 0", "1 0 0 0 nan 0 0 0");
    assert!(text.contains("found `nan`; expected finite numbers"), "{text}");
    let text = refused("<orientation>1 0 0 0 1 0 0 0 1 0 0 0</orientation>", "");
    assert!(text.contains("found <position> but no <orientation> in the calibration pose `tpose`"), "{text}");
    let text = refused("<footContacts>1 0<", "<footContacts>1 0 0<");
    assert!(text.contains("found 3 flags in frame 0; expected 2, one for each contact"), "{text}");
    let text = refused("-0.095115 0.001080", "-0.095115");
    assert!(text.contains("element <pos_b>") && text.contains("expected three numbers x y z in metres"), "{text}");
}

#[test]
fn frames_that_repeat_or_are_missing_are_told() {
    let text = refused(r#"index="1" t"#, r#"index="0" t"#);
    assert!(text.contains("<frame>: found index 0 after index 0; expected frames with increasing numbers"), "{text}");
    let text = refused(r#"time="17""#, r#"time="0""#);
    assert!(
        text.contains("found time 0 ms in frame 1 after 0 ms in frame 0; expected frames at increasing times"),
        "{text}"
    );
    let text = refused(r#"index="1" t"#, r#"index="one" t"#);
    assert!(text.contains("found index=`one`; expected the number of the frame"), "{text}");
    let slow = file().replace(r#"time="50""#, r#"time="90""#);
    let (mvnx, remarks) = Mvnx::read(slow.as_bytes()).unwrap();
    assert_eq!(mvnx.frames.len(), 3);
    assert!(remarks[0].message.starts_with("1 frames state another time than their number"), "{remarks:?}");
    let numbered = |number: u64| (format!(r#"index="{number}" t"#), format!(r#"index="{}" t"#, number + 600));
    let later = [0, 1, 3].map(numbered).iter().fold(file(), |text, (from, to)| text.replace(from, to));
    assert_eq!(read(&later).frames[0].index, 600, "the middle of a take, with times from its beginning");
}

#[test]
fn documents_of_another_kind_are_refused_with_what_was_expected() {
    let text = |bytes: &[u8]| Mvnx::read(bytes).unwrap_err().to_string();
    assert_eq!(text(b" \n"), "the file is empty; expected an XML document with the element <mvnx>");
    assert!(text(b"MVN").contains("expected an XML document"), "{}", text(b"MVN"));
    assert!(text(b"<osim/>").contains("element <osim>: found this element as the outermost one; expected <mvnx>"));
    assert!(text(b"<mvnx/>").contains("found no <subject>"));
    assert!(text(&file().as_bytes()[..1500]).contains("not a readable XML document"));
    let bomb = file().replace("<!-- Uncomment", "<!DOCTYPE mvnx [<!ENTITY a \"b\">]><!-- Uncomment");
    assert!(text(bomb.as_bytes()).contains("not a readable XML document"), "{}", text(bomb.as_bytes()));
    assert!(
        refused(r#"frameRate="60""#, r#"frameRate="0""#).contains("found frameRate=`0`; expected the frame rate in Hz")
    );
    assert!(
        refused(r#"label="RightUpperLeg""#, r#"label="Pelvis""#).contains("expected a label that no other segment has")
    );
    assert!(
        refused(
            r#"<contactDefinition label="RightFoot_Toe" index="1"/>"#,
            r#"<contactDefinition label="RightFoot_Toe" index="0"/>"#
        )
        .contains("expected each of 0 to 1 once")
    );
    assert!(refused("<frame ", "<part ").contains("not a readable XML document"));
    let unrecorded = file().replace(r#"type="normal""#, r#"type="npose""#);
    assert!(text(unrecorded.as_bytes()).contains("<frames>: found no frame of the type `normal`"));
}
