//! Set-ups of OpenSim's tools.

use ambulo_formats::setup::{
    CoordinateTarget, CoordinateTask, HeadingSensor, InverseDynamicsSetup, InverseKinematicsSetup, ManualScale,
    MarkerTask, MeasuredSegment, Measurement, ScaleSetup, ScalingMethod, Setup,
};

const SCALE: &str = r#"<?xml version="1.0" encoding="UTF-8" ?>
<OpenSimDocument Version="30000">
  <ScaleTool name="person">
    <mass> 72.6 </mass>
    <height>1800</height>
    <GenericModelMaker>
      <model_file> ..\models\generic.osim </model_file>
      <marker_set_file>Unassigned</marker_set_file>
    </GenericModelMaker>
    <ModelScaler>
      <apply>true</apply>
      <scaling_order> measurements manualScale </scaling_order>
      <MeasurementSet><objects>
        <Measurement name="thigh">
          <MarkerPairSet><objects><MarkerPair><markers> RASI RKNE </markers></MarkerPair></objects><groups/></MarkerPairSet>
          <BodyScaleSet><objects><BodyScale name="femur_r"><axes> X Z</axes></BodyScale></objects></BodyScaleSet>
        </Measurement>
        <Measurement name="off"><apply>false</apply></Measurement>
      </objects></MeasurementSet>
      <ScaleSet><objects>
        <Scale><scales> 1.1 1 0.9 </scales><segment>toes_r</segment><apply>true</apply></Scale>
        <Scale><scales> 2 2 2 </scales><segment>toes_l</segment><apply>false</apply></Scale>
      </objects></ScaleSet>
      <marker_file>static.trc</marker_file>
      <time_range> 1 2.5</time_range>
      <preserve_mass_distribution>true</preserve_mass_distribution>
      <output_model_file>scaled.osim</output_model_file>
    </ModelScaler>
    <MarkerPlacer><apply>false</apply></MarkerPlacer>
  </ScaleTool>
</OpenSimDocument>"#;

const KINEMATICS: &str = r#"<OpenSimDocument Version="40000"><InverseKinematicsTool name="walk">
    <model_file>scaled.osim</model_file>
    <accuracy>1e-5</accuracy>
    <IKTaskSet><objects>
      <IKMarkerTask name="RASI"><apply>true</apply><weight>10</weight></IKMarkerTask>
      <IKMarkerTask name="LASI"><apply>false</apply><weight>10</weight></IKMarkerTask>
      <IKCoordinateTask name="mtp_r"><weight>5</weight><value_type>manual_value</value_type><value>0.1</value></IKCoordinateTask>
      <IKCoordinateTask name="hip_r"><weight>2</weight><value_type>from_file</value_type></IKCoordinateTask>
      <IKCoordinateTask name="knee_r"><apply>true</apply></IKCoordinateTask>
    </objects></IKTaskSet>
    <marker_file>walk.trc</marker_file>
    <coordinate_file></coordinate_file>
    <time_range> -Inf Inf</time_range>
    <colour>blue</colour>
  </InverseKinematicsTool></OpenSimDocument>"#;

const DYNAMICS: &str = r#"<InverseDynamicsTool name="walk">
    <model_file> scaled.osim </model_file><time_range> 0.4 1.6 </time_range>
    <forces_to_exclude> muscles actuators </forces_to_exclude>
    <external_loads_file> loads.xml </external_loads_file><coordinates_file> ik.mot </coordinates_file>
    <lowpass_cutoff_frequency_for_coordinates> -1 </lowpass_cutoff_frequency_for_coordinates>
  </InverseDynamicsTool>"#;

fn read(text: &str) -> (Setup, Vec<String>) {
    let (setup, remarks) = Setup::read(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"));
    (setup, remarks.iter().map(ToString::to_string).collect())
}

#[test]
fn a_set_up_of_scaling_is_read() {
    let (Setup::Scale(setup), remarks) = read(SCALE) else { panic!("another tool") };
    let ScaleSetup { mass_kg, model_file, marker_set_file, scaler, placer } = setup;
    assert_eq!((mass_kg, model_file.as_deref(), marker_set_file), (Some(72.6), Some("../models/generic.osim"), None));
    let scaler = scaler.unwrap();
    assert_eq!(scaler.order, [ScalingMethod::Measurements, ScalingMethod::Manual]);
    let thigh = Measurement {
        name: "thigh".into(),
        pairs: vec![["RASI".into(), "RKNE".into()]],
        bodies: vec![MeasuredSegment { body: "femur_r".into(), axes: [true, false, true] }],
    };
    assert_eq!(scaler.measurements, [thigh]);
    assert_eq!(scaler.manual, [ManualScale { body: "toes_r".into(), factors: [1.1, 1.0, 0.9] }]);
    assert_eq!((scaler.marker_file.as_deref(), scaler.time_range), (Some("static.trc"), Some([1.0, 2.5])));
    assert!(scaler.preserve_mass_distribution && placer.is_none());
    let unused = ["line 3: <ScaleTool>: not used: height", "line 10: <ModelScaler>: not used: output_model_file"];
    assert_eq!(remarks, unused);
}

#[test]
fn a_set_up_of_inverse_kinematics_is_read() {
    let (Setup::InverseKinematics(setup), remarks) = read(KINEMATICS) else { panic!("another tool") };
    let InverseKinematicsSetup { marker_file, coordinate_file, time_range, tasks, .. } = setup;
    assert_eq!((marker_file.as_deref(), coordinate_file), (Some("walk.trc"), None));
    assert_eq!(time_range, Some([f64::NEG_INFINITY, f64::INFINITY]));
    assert_eq!(tasks.markers, [MarkerTask { marker: "RASI".into(), weight: 10.0 }]);
    let task =
        |coordinate: &str, line, weight, target| CoordinateTask { coordinate: coordinate.into(), line, weight, target };
    let expected = [
        task("mtp_r", 7, 5.0, CoordinateTarget::Value(0.1)),
        task("hip_r", 8, 2.0, CoordinateTarget::FromFile),
        task("knee_r", 9, 1.0, CoordinateTarget::Default),
    ];
    assert_eq!(tasks.coordinates, expected);
    let unknown = "line 14: <InverseKinematicsTool>: the element <colour> is not known and was not read";
    assert_eq!(remarks, ["line 1: <InverseKinematicsTool>: not used: accuracy", unknown]);
}

#[test]
fn a_set_up_of_inverse_dynamics_is_read_without_its_document() {
    let expected = InverseDynamicsSetup {
        model_file: Some("scaled.osim".into()),
        coordinates_file: Some("ik.mot".into()),
        external_loads_file: Some("loads.xml".into()),
        cutoff_hz: None,
        time_range: Some([0.4, 1.6]),
        forces_to_exclude: vec!["muscles".into(), "actuators".into()],
    };
    assert_eq!(read(DYNAMICS), (Setup::InverseDynamics(expected), vec![]));
    let (Setup::InverseDynamics(setup), _) = read(&DYNAMICS.replace("-1", "6")) else { panic!("another tool") };
    assert_eq!(setup.cutoff_hz, Some(6.0));
}

#[test]
fn an_element_that_occurs_twice_is_reported() {
    let twice = KINEMATICS.replace("<colour>", "<time_range> 1 2</time_range><colour>");
    let (Setup::InverseKinematics(setup), remarks) = read(&twice) else { panic!("another tool") };
    assert_eq!(setup.time_range, Some([f64::NEG_INFINITY, f64::INFINITY]));
    let expected = "<InverseKinematicsTool>: the element <time_range> occurs twice; the first is read, this one is not";
    assert!(remarks.iter().any(|remark| remark.contains(expected)), "{remarks:?}");
    assert!(read(KINEMATICS).1.iter().all(|remark| !remark.contains("twice")));
}

#[test]
fn refusals_name_line_element_and_what_is_allowed() {
    let of = |text: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        Setup::read(text.replace(from, to).as_bytes()).unwrap_err().to_string()
    };
    for (message, words) in [
        (of(SCALE, "ScaleTool", "CMCTool"), ["line 2", "<CMCTool>", "<InverseDynamicsTool>"]),
        (of(SCALE, "measurements manualScale", "stature"), ["line 12", "`stature`", "`measurements`, `manualScale`"]),
        (of(SCALE, "RASI RKNE", "R ASI RKNE"), ["line 15", "3 names", "without spaces"]),
        (of(SCALE, "X Z", "XZ"), ["line 16", "`XZ`", "X, Y and Z"]),
        (of(SCALE, "1.1 1 0.9", "1.1 0 0.9"), ["line 21", "the factor 0", "above zero"]),
        (of(SCALE, "1 2.5", "2.5 1"), ["line 25", "`2.5 1`", "the start first"]),
        (
            of(SCALE, "<MeasurementSet>", "<MeasurementSet file=\"set.xml\">"),
            ["line 13", "file=\"set.xml\": another file", "a file with the element <MeasurementSet>"],
        ),
        (of(KINEMATICS, "<weight>10</weight>", "<weight>-1</weight>"), ["line 5", "the weight -1", "zero or more"]),
        (of(KINEMATICS, "manual_value", "guess"), ["line 7", "`guess`", "from_file"]),
        (of(KINEMATICS, "IKMarkerTask", "OrientationTask"), ["line 5", "<OrientationTask>", "<IKCoordinateTask>"]),
        (of(DYNAMICS, "-1", "six"), ["line 5", "`six`", "finite numbers"]),
    ] {
        assert!(words.iter().all(|word| message.contains(word)), "{words:?} are not all in: {message}");
    }
    assert!(Setup::read(b" \n").unwrap_err().to_string().contains("the file is empty"));
    assert!(Setup::read(b"PathFileType").unwrap_err().to_string().contains("XML"));
}

#[test]
fn a_set_up_cut_anywhere_is_refused_without_a_panic() {
    for end in 0..SCALE.trim_end().len() {
        assert!(Setup::read(&SCALE.as_bytes()[..end]).is_err(), "{end}");
    }
}

// ---- Sets in other files, and older documents ----

const TASKS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<OpenSimDocument Version="20302">
  <IKTaskSet name="walk">
    <objects>
      <IKMarkerTask name="RASI"><weight>10</weight></IKMarkerTask>
      <IKCoordinateTask name="hip_r"><weight>2</weight><value_type>from_file</value_type></IKCoordinateTask>
    </objects>
  </IKTaskSet>
</OpenSimDocument>"#;

/// A set-up of inverse kinematics with its tasks in another file, as OpenSim 2 wrote it.
fn old_kinematics(tool: &str, more: &str) -> String {
    format!(
        "<OpenSimDocument Version=\"20302\">\n<{tool} name=\"walk\">\n<model_file>scaled.osim</model_file>\n\
         <IKTaskSet file=\"tasks\\walk.xml\" />\n{more}\n</{tool}></OpenSimDocument>"
    )
}

fn with_tasks(text: &str, tasks: &str) -> Result<(Setup, Vec<String>), String> {
    let mut load = |file: &str| match file {
        "tasks/walk.xml" => Ok(tasks.as_bytes().to_vec()),
        other => Err(format!("there is no {other}")),
    };
    let (setup, remarks) = Setup::read_with(text.as_bytes(), &mut load).map_err(|error| error.to_string())?;
    Ok((setup, remarks.iter().map(ToString::to_string).collect()))
}

#[test]
fn sets_in_files_of_their_own_are_put_in_their_places() {
    for tool in ["InverseKinematicsTool", "InverseKinemtaticsTool"] {
        let text = old_kinematics(
            tool,
            "<marker_file>walk.trc</marker_file><time_range>0.4 1.6</time_range><colour>blue</colour>",
        );
        let (Setup::InverseKinematics(setup), remarks) = with_tasks(&text, TASKS).unwrap() else {
            panic!("another tool")
        };
        assert_eq!(setup.tasks.markers, [MarkerTask { marker: "RASI".into(), weight: 10.0 }]);
        assert!(setup.tasks.follow_file());
        assert_eq!((setup.marker_file.as_deref(), setup.time_range), (Some("walk.trc"), Some([0.4, 1.6])));
        // The lines of the document are those that it has without the set.
        assert!(remarks[0].contains("line 5") && remarks[0].contains("<colour>"), "{remarks:?}");
    }
    let text = old_kinematics("InverseKinematicsTool", "");
    let refused = |text: &str, tasks: &str, words: &[&str]| {
        let error = with_tasks(text, tasks).unwrap_err();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    };
    refused(&text.replace("walk.xml", "run.xml"), TASKS, &["line 4", "there is no tasks/run.xml", "<IKTaskSet>"]);
    refused(&text, "<OpenSimDocument/>", &["line 4", "no element <IKTaskSet>"]);
    refused(&text, "<IKTaskSet", &["line 4", "tasks/walk.xml"]);
    refused(&text, &TASKS.replace("name=\"walk\"", "file=\"a.xml\""), &["names a further file, a.xml"]);
    let many = text.replace("<IKTaskSet", &format!("{}<IKTaskSet", "<IKTaskSet file=\"tasks/walk.xml\"/>".repeat(20)));
    refused(&many, TASKS, &["more than 16 sets"]);
    refused(&text, &TASKS.replace(">10<", ">-1<"), &["line 4", "RASI", "the weight -1"]);
}

#[test]
fn the_trial_of_an_old_tool_has_its_files() {
    let trials = |number: usize| {
        let trial = "<IKTrial name=\"t\"><marker_file>walk.trc</marker_file><time_range>0 1</time_range></IKTrial>";
        old_kinematics("IKTool", &format!("<IKTrialSet><objects>{}</objects></IKTrialSet>", trial.repeat(number)))
    };
    let (Setup::InverseKinematics(setup), _) = with_tasks(&trials(1), TASKS).unwrap() else { panic!("another tool") };
    assert_eq!((setup.marker_file.as_deref(), setup.time_range), (Some("walk.trc"), Some([0.0, 1.0])));
    assert!(with_tasks(&trials(2), TASKS).unwrap_err().contains("2 trials in <IKTrialSet>"));
}

// ---- Sensors ----

const PLACER: &str = r#"<OpenSimDocument Version="40000"><IMUPlacer>
    <model_file>figure.osim</model_file>
    <base_imu_label>pelvis_imu</base_imu_label>
    <base_heading_axis>-Z</base_heading_axis>
    <sensor_to_opensim_rotations>-1.5 0 0.5</sensor_to_opensim_rotations>
    <orientation_file_for_calibration>standing.sto</orientation_file_for_calibration>
    <output_model_file>calibrated.osim</output_model_file>
  </IMUPlacer></OpenSimDocument>"#;

const SENSORS: &str = r#"<OpenSimDocument Version="40600"><IMUInverseKinematicsTool name="walk">
    <model_file>calibrated.osim</model_file>
    <sensor_to_opensim_rotations>-1.5 0 0.5</sensor_to_opensim_rotations>
    <orientations_file>walk.sto</orientations_file>
    <time_range>-Inf 2</time_range>
    <OrientationWeightSet><objects><OrientationWeight name="torso_imu"><weight>0.5</weight></OrientationWeight></objects></OrientationWeightSet>
  </IMUInverseKinematicsTool></OpenSimDocument>"#;

#[test]
fn set_ups_of_sensors_are_read() {
    let (Setup::SensorPlacer(placer), remarks) = read(PLACER) else { panic!("another tool") };
    assert_eq!(placer.heading, Some(HeadingSensor { sensor: "pelvis_imu".into(), axis: 2, is_negative: true }));
    assert_eq!((placer.earth_rad, placer.orientations_file.as_deref()), ([-1.5, 0.0, 0.5], Some("standing.sto")));
    assert!(remarks[0].contains("not used: output_model_file"), "{remarks:?}");
    let blank = PLACER.replace(">pelvis_imu<", "><").replace("-1.5 0 0.5", "");
    let (Setup::SensorPlacer(placer), _) = read(&blank) else { panic!("another tool") };
    assert_eq!((placer.heading, placer.earth_rad), (None, [0.0; 3]));
    let error = Setup::read(PLACER.replace(">-Z<", ">up<").as_bytes()).unwrap_err().to_string();
    assert!(error.contains("line 4") && error.contains("`up`") && error.contains("x, -x"), "{error}");
    let (Setup::SensorKinematics(setup), _) = read(SENSORS) else { panic!("another tool") };
    assert_eq!(setup.weights, [("torso_imu".to_owned(), 0.5)]);
    assert_eq!(
        (setup.orientations_file.as_deref(), setup.time_range),
        (Some("walk.sto"), Some([f64::NEG_INFINITY, 2.0]))
    );
}
