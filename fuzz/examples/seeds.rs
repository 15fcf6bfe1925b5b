//! Writes the small files from which the fuzzer starts, `corpus/<target>/`: made by our own writers, or ours anyway.
//!
//! `cargo run --manifest-path fuzz/Cargo.toml --example seeds`

use ambulo::findings::Findings;
use ambulo::simulation::scene::{Scene, SceneFile, SceneSettings};
use ambulo_formats::b3d::{
    B3d, ContactFrames, Header, MissingForce, Pass, PassFrames, TrialFrames, TrialHeader, TrialPass,
};
use ambulo_formats::bvh::{Bvh, Channel as BvhChannel, Joint};
use ambulo_formats::c3d::{C3d, Channel, Encoding, Event, EventPlace, Platform, Point, Processor, Rotation, Storage};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::npz::{Array, Data, Npz};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::{OrientationTable, Table};
use ambulo_formats::trc::{Marker, Trc};
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    for processor in Processor::ALL {
        for storage in [Storage::Integer, Storage::Real] {
            let name = format!("{processor:?}-{storage:?}.c3d").to_lowercase();
            save("c3d", &name, &c3d(processor, storage).write()?)?;
        }
    }
    save("c3d", "empty.c3d", &C3d::new(100.0, "mm").write()?)?;
    save("c3d", "poses.c3d", &poses().write()?)?;
    save("trc", "two.trc", &trc()?.write())?;
    let columns = vec![("time".into(), vec![0.0, 0.01]), ("knee_angle_r".into(), vec![-12.5, f64::NAN])];
    let mut table = Table::new("Coordinates", columns)?;
    table.in_degrees = Some(true);
    save("storage", "two.mot", &table.write_storage())?;
    save("csv", "two.csv", &table.write_csv())?;
    let (loads, _) = ExternalLoads::read(LOADS.as_bytes())?;
    save("external_loads", "one.xml", &loads.write())?;
    save("setup", "scale.xml", SCALE_SETUP.as_bytes())?;
    save("setup", "sensors.xml", SENSOR_SETUP.as_bytes())?;
    save("setup", "placer.xml", PLACER_SETUP.as_bytes())?;
    save("setup", "old.xml", OLD_SETUP.as_bytes())?;
    copy("osim", "crates/ambulo/tests/testdata/opensim_bushings/bushings.osim")?;
    save("osim", "two.osim", &OsimModel::read(OSIM.as_bytes())?.write()?)?;
    save("bvh", "leg.bvh", &bvh()?.write())?;
    save("b3d", "two.b3d", &subject().write()?)?;
    save("npz", "stand.npz", &smpl().write()?)?;
    save("bids_motion", "points.txt", points().as_bytes())?;
    save("mvnx", "legs.mvnx", mvnx().as_bytes())?;
    save("orientations", "legs.sto", orientations().write()?.as_slice())?;
    save("gait", "slow.toml", b"speed = 0.9\nheight = 1.7\nstyle = \"1997\"\n[pelvis]\nrotation = 1.5\n")?;
    for name in ["pendulum", "four-bar", "carry", "top"] {
        copy("scene", &format!("examples/{name}.toml"))?;
    }
    for name in ["pendulum", "four-bar", "top", "pile", "slope"] {
        copy("scene_run", &format!("examples/{name}.toml"))?;
    }
    copy("scene_run", "crates/ambulo-paper/data/scenes/grasp.toml")?;
    save("saved_state", "top.json", &saved()?)?;
    save("thresholds", "weak.toml", THRESHOLDS.as_bytes())?;
    save("result_folder", "events.csv", b"time,side,event\n0.5,right,foot strike\n1.1,right,foot off\n")?;
    save(
        "result_folder",
        "summary.json",
        b"{\"format\":1,\"version\":\"0\",\"mass_kg\":70.5,\"files\":[{\"name\":\"grf.mot\"}]}",
    )?;
    save("study_coordinates", "sway.mot", &sway()?.write_storage())?;
    save("study_markers", "legs.c3d", &legs().write()?)?;
    save("study_markers", "poses.c3d", &posed_legs().write()?)?;
    for name in ["keypoints", "oxford-foot"] {
        copy("marker_set", &format!("crates/ambulo-body/data/markers/{name}.toml"))?;
    }
    Ok(())
}

/// Two frames of the lower body, standing, with contacts of the feet.
fn mvnx() -> String {
    let names = ["Pelvis", "RightUpperLeg", "RightLowerLeg", "RightFoot", "LeftUpperLeg", "LeftLowerLeg", "LeftFoot"];
    let heel = |side: &str| {
        format!("<points><point label=\"p{side}HeelFoot\"><pos_b>-0.036 0 -0.085</pos_b></point></points>")
    };
    let points = |name: &str| name.strip_suffix("Foot").map_or_else(String::new, heel);
    let segments: String =
        names.iter().map(|name| format!("<segment label=\"{name}\">{}</segment>", points(name))).collect();
    let frame = |index: usize| {
        let q = format!("0.9998 0 {} 0 ", 0.02 * index as f64);
        let turns = format!("1 0 0 0 {}", q.repeat(names.len() - 1));
        let legs = [-0.1, 0.1].map(|y| format!("0 {y} 0.9 0 {y} 0.5 0 {y} 0.08 ")).concat();
        format!(
            "<frame time=\"{}\" index=\"{index}\" type=\"normal\"><orientation>{turns}</orientation><position>0 0 0.9 {legs}</position><footContacts>1 {index}</footContacts></frame>",
            10 * index
        )
    };
    format!(
        "<mvnx version=\"4\"><subject frameRate=\"100\"><segments>{segments}</segments><footContactDefinition><contactDefinition label=\"LeftFoot_Heel\" index=\"0\"/><contactDefinition label=\"RightFoot_Heel\" index=\"1\"/></footContactDefinition><frames>{}{}</frames></subject></mvnx>",
        frame(0),
        frame(1)
    )
}

/// Sensors on the legs in three rows; the knees bend.
fn orientations() -> OrientationTable {
    let turned = |angle: f64| Some([(angle / 2.0).cos(), 0.0, (angle / 2.0).sin(), 0.0]);
    let path = |bend: f64| [0.0, 0.5, 1.0].map(|share| turned(bend * share)).to_vec();
    let sensors = [
        ("pelvis", 0.0),
        ("femur_r", -0.2),
        ("tibia_r", 0.8),
        ("calcn_r", 0.8),
        ("femur_l", 0.0),
        ("tibia_l", 0.5),
        ("calcn_l", 0.5),
    ];
    OrientationTable {
        rate_hz: Some(100.0),
        times: vec![0.0, 0.01, 0.02],
        sensors: sensors.map(|(body, bend)| (format!("{body}_imu"), path(bend))).to_vec(),
        lines: Vec::new(),
    }
}

/// The state of the scene of the target after some steps.
fn saved() -> Result<Vec<u8>, Box<dyn Error>> {
    let text = fs::read_to_string(here().join("../examples/top.toml"))?;
    let mut load = |path: &str| Err(format!("no file {path}"));
    let mut findings = Findings::default();
    let mut scene = Scene::build(&SceneFile::parse(&text)?, SceneSettings::default(), &mut load, &mut findings)?;
    for _ in 0..10 {
        scene.step(&mut findings)?;
    }
    Ok(serde_json::to_vec(&scene.save())?)
}

const SCALE_SETUP: &str = "<ScaleTool name=\"s\"><mass>70</mass><GenericModelMaker><model_file>m.osim</model_file></GenericModelMaker>\
    <ModelScaler><scaling_order>measurements manualScale</scaling_order><MeasurementSet><objects><Measurement name=\"thigh\">\
    <MarkerPairSet><objects><MarkerPair><markers>A B</markers></MarkerPair></objects></MarkerPairSet><BodyScaleSet><objects>\
    <BodyScale name=\"f\"><axes>X Y</axes></BodyScale></objects></BodyScaleSet></Measurement></objects></MeasurementSet><ScaleSet><objects>\
    <Scale><scales>1 2 3</scales><segment>f</segment></Scale></objects></ScaleSet><time_range>0 1</time_range></ModelScaler>\
    <MarkerPlacer><IKTaskSet><objects><IKMarkerTask name=\"A\"><weight>2</weight></IKMarkerTask><IKCoordinateTask name=\"q\">\
    <value_type>manual_value</value_type><value>1</value></IKCoordinateTask></objects></IKTaskSet></MarkerPlacer></ScaleTool>\n";

const SENSOR_SETUP: &str = "<IMUInverseKinematicsTool><orientations_file>w.sto</orientations_file><time_range>0 2</time_range>\
    <OrientationWeightSet><objects><OrientationWeight name=\"p\"><weight>0.5</weight></OrientationWeight></objects></OrientationWeightSet>\
    </IMUInverseKinematicsTool>\n";

const PLACER_SETUP: &str = "<IMUPlacer><model_file>a.osim</model_file><base_imu_label>p</base_imu_label><base_heading_axis>-z\
    </base_heading_axis><sensor_to_opensim_rotations>-1.5 0 0</sensor_to_opensim_rotations>\
    <orientation_file_for_calibration>s.sto</orientation_file_for_calibration></IMUPlacer>\n";

/// The target takes this document as the file of its set as well, in which the first set is the one below the trials.
const OLD_SETUP: &str = "<IKTool><IKTrialSet><objects><IKTrial><marker_file>a.trc</marker_file></IKTrial></objects></IKTrialSet>\
    <x><IKTaskSet><objects><IKMarkerTask name=\"A\"><weight>1</weight></IKMarkerTask></objects></IKTaskSet></x>\
    <IKTaskSet file=\"a.xml\"/></IKTool>\n";

const THRESHOLDS: &str = "shortest_s = 0.05\nskip = [\"power\"]\n[person]\nmass_kg = 60.0\n[strength]\nshare = 0.8\n\
    [friction]\navailable = 0.5\n[support]\nacceleration_ratio = 1.5\n";

/// A subject with two frames, the model of the target of models, a marker and a foot on the ground.
fn subject() -> B3d {
    let two = |x: f64| vec![[x, 0.5, 0.25]; 2];
    let contact = ContactFrames { force: two(700.0), centre_of_pressure: two(0.1), moment: two(0.0) };
    let positions = vec![vec![0.1, 0.2]; 2];
    let pass = PassFrames { positions, mass_centre: Vec::new(), contacts: vec![contact] };
    let trial = TrialHeader {
        name: "walk".into(),
        frames: 2,
        step_s: 0.01,
        missing_force: vec![MissingForce(0), MissingForce(5)],
        passes: vec![TrialPass::default()],
        ..TrialHeader::default()
    };
    let header = Header {
        coordinates: 2,
        passes: vec![Pass { model: OSIM.into(), ..Pass::default() }],
        contact_bodies: vec!["foot".into()],
        markers: vec!["HEEL".into()],
        trials: vec![trial],
        ..Header::default()
    };
    B3d { header, trials: vec![TrialFrames { markers: vec![two(1.0)], passes: vec![pass] }] }
}

/// Two frames of a person who stands, in arrays of the SMPL family.
fn smpl() -> Npz {
    let zeros =
        |shape: &[usize]| Array { shape: shape.to_vec(), data: Data::Numbers(vec![0.0; shape.iter().product()]) };
    let rate = Array { shape: Vec::new(), data: Data::Numbers(vec![60.0]) };
    let gender = Array { shape: Vec::new(), data: Data::Text("neutral".into()) };
    let arrays = [("poses", zeros(&[2, 72])), ("trans", zeros(&[2, 3])), ("mocap_framerate", rate), ("gender", gender)];
    Npz { arrays: arrays.map(|(name, array)| (name.to_owned(), array)).into() }
}

/// Channels of four tracked points, an empty line, and two frames.
fn points() -> String {
    let channel = |k: usize| format!("c{k}\t{}\tPOS\tP{}\tmm\tgood\n", ["x", "y", "z"][k % 3], k / 3);
    let channels: String = (0..12).map(channel).collect();
    let row = (0..12).map(|k| k.to_string()).collect::<Vec<_>>().join("\t");
    format!("name\tcomponent\ttype\ttracked_point\tunits\tstatus\n{channels}\n{row}\n{row}\n")
}

/// Someone of 1.65 m who sways and bends the knees.
fn sway() -> Result<Table, ambulo_formats::Error> {
    let times: Vec<f64> = (0..80).map(|k| 0.02 * f64::from(k)).collect();
    let wave = |size: f64, rate: f64| times.iter().map(|t| size * (rate * t).sin()).collect::<Vec<f64>>();
    let high: Vec<f64> = times.iter().map(|t| 0.84 + 0.01 * (2.0 * t).cos()).collect();
    let mut columns = vec![("time".to_owned(), times.clone()), ("pelvis_ty".to_owned(), high)];
    columns.push(("pelvis_tilt".to_owned(), wave(3.0, 1.0)));
    for side in ["r", "l"] {
        columns.push((format!("hip_flexion_{side}"), wave(10.0, 2.0)));
        columns.push((format!("knee_angle_{side}"), wave(-20.0, 2.0)));
        columns.push((format!("ankle_angle_{side}"), wave(10.0, 2.0)));
    }
    let mut table = Table::new("Coordinates", columns)?;
    table.in_degrees = Some(true);
    Ok(table)
}

/// Places of the markers of one leg of a person of 1.7 m: along the walk, to the right, up [mm].
const LEG: [(&str, [f64; 3]); 8] = [
    ("ASI", [100.0, 120.0, 950.0]),
    ("PSI", [-100.0, 50.0, 960.0]),
    ("THI", [40.0, 160.0, 700.0]),
    ("KNE", [0.0, 150.0, 480.0]),
    ("TIB", [20.0, 140.0, 300.0]),
    ("ANK", [0.0, 130.0, 80.0]),
    ("HEE", [-60.0, 90.0, 40.0]),
    ("TOE", [130.0, 100.0, 40.0]),
];

/// Legs that swing like pendulums under a pelvis in uniform motion.
fn legs() -> C3d {
    let mut record = C3d::new(50.0, "mm");
    for (letter, sense) in [("R", 1.0), ("L", -1.0)] {
        for (name, [ahead, aside, up]) in LEG {
            let at = |frame: u8| {
                let t = 0.02 * f64::from(frame);
                let swing = sense * 0.4 * (6.0 * t).sin() * (900.0 - f64::min(up, 900.0));
                [1000.0 * t + ahead + swing, -sense * aside, up]
            };
            record.points.push(Point::new(&format!("{letter}{name}"), (0..60).map(at).collect()));
        }
    }
    record
}

fn here() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

fn save(target: &str, name: &str, bytes: &[u8]) -> Result<(), Box<dyn Error>> {
    let folder = here().join("corpus").join(target);
    fs::create_dir_all(&folder)?;
    Ok(fs::write(folder.join(name), bytes)?)
}

fn copy(target: &str, path: &str) -> Result<(), Box<dyn Error>> {
    let path = here().join("..").join(path);
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or("file").to_owned();
    save(target, &name, &fs::read(path)?)
}

/// Two points, one of them lost for a frame, a platform, events in both places.
fn c3d(processor: Processor, storage: Storage) -> C3d {
    let mut record = C3d::new(50.0, "mm");
    record.encoding = Encoding { processor, storage, point_scale: 0.5, unsigned_analog: false };
    record.first_frame = 3;
    record.points = vec![
        Point::new("HEEL", vec![[1.0, 2.0, 3.0], [f64::NAN; 3]]),
        Point::new("TOE", vec![[0.5, 0.0, -3.0], [4.0, 5.0, 6.0]]),
    ];
    record.analog_rate_hz = 100.0;
    record.channels = vec![
        Channel { scale: -0.5, offset: 2048.0, ..Channel::new("FX", "N", vec![0.5, 1.0, 1.5, 2.0]) },
        Channel::new("FZ", "N", vec![-1.0, -2.0, -3.0, -4.0]),
    ];
    record.events = vec![
        Event::new("Foot Strike", "Left", 62.5),
        Event { place: EventPlace::Header, ..Event::new("RHS", "", 0.25) },
    ];
    record.set_platforms(&[Platform {
        kind: 4,
        corners: [[400.0, 600.0, 0.0], [0.0, 600.0, 0.0], [0.0; 3], [400.0, 0.0, 0.0]],
        origin: [0.0, 0.0, -40.0],
        channels: vec![Some(0), None, Some(1), None, None, None],
        calibration: vec![vec![1.0; 6]; 6],
        zero_frames: Some([1, 10]),
    }]);
    record
}

/// A pelvis and two stiff legs whose ankles swing, as poses of segments: x right, y forward, z up.
fn posed_legs() -> C3d {
    let mut record = C3d::new(50.0, "mm");
    record.rotation_rate_hz = 50.0;
    let mut push = |name: &str, place: &dyn Fn(f64) -> [f64; 4]| {
        let pose = |frame: u8| {
            let [x, y, z, lean] = place(0.02 * f64::from(frame));
            let (s, c) = lean.sin_cos();
            [[1.0, 0.0, 0.0, x], [0.0, c, -s, y], [0.0, s, c, z], [0.0, 0.0, 0.0, 1.0]]
        };
        record.rotations.push(Rotation::new(name, (0..60).map(pose).collect()));
    };
    push("pelvis_4X4", &|t| [0.0, 1000.0 * t, 900.0, 0.0]);
    for (side, sense) in [("r", 1.0), ("l", -1.0)] {
        let lean = move |t: f64| sense * 0.3 * (6.0 * t).sin();
        let along = move |t: f64, way: f64| {
            [90.0 * sense, 1000.0 * t + way * lean(t).sin(), 900.0 - way * lean(t).cos(), lean(t)]
        };
        push(&format!("{side}_thigh_4X4"), &|t| along(t, 0.0));
        push(&format!("{side}_shank_4X4"), &|t| along(t, 420.0));
        push(&format!("{side}_foot_4X4"), &|t| along(t, 830.0));
    }
    record
}

/// Poses of two segments without points.
fn poses() -> C3d {
    let pose = |x: f64| [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 900.0], [0.0, 0.0, 0.0, 1.0]];
    let mut record = C3d::new(50.0, "mm");
    record.rotation_rate_hz = 100.0;
    record.rotations = vec![
        Rotation::new("pelvis_4X4", vec![pose(0.0), pose(1.0), pose(2.0), [[f64::NAN; 4]; 4]]),
        Rotation::new("l_thigh_4X4", (0..4).map(|k| pose(f64::from(k))).collect()),
    ];
    record
}

fn trc() -> Result<Trc, ambulo_formats::Error> {
    let marker = |name: &str, x: f64| Marker { name: name.into(), positions_m: vec![[x, 0.5, 0.25], [f64::NAN; 3]] };
    Trc::new(100.0, vec![0.0, 0.01], vec![marker("HEEL", 1.0), marker("TOE", 2.0)])
}

fn bvh() -> Result<Bvh, ambulo_formats::Error> {
    let joint = |name: &str, parent, channels: &[BvhChannel], ends: &[[f64; 3]]| Joint {
        name: name.into(),
        parent,
        offset: [0.0, -10.5, 0.0],
        channels: channels.to_vec(),
        end_sites: ends.to_vec(),
    };
    let joints = vec![
        joint("Hips", None, &BvhChannel::ALL, &[]),
        joint("Knee", Some(0), &BvhChannel::ALL[3..], &[[0.0, -9.0, 1.0]]),
    ];
    Bvh::new(joints, 0.01, &[vec![0.5; 9], vec![-1.5; 9]])
}

const LOADS: &str = "<OpenSimDocument Version=\"40000\"><ExternalLoads name=\"walk\"><objects>\
    <ExternalForce name=\"right\"><applied_to_body>calcn_r</applied_to_body><force_identifier>f</force_identifier>\
    <point_identifier>p</point_identifier></ExternalForce></objects><datafile>a.mot</datafile></ExternalLoads>\
    </OpenSimDocument>";

const OSIM: &str = "<OpenSimDocument Version=\"40000\"><Model name=\"two\"><gravity>0 -9.81 0</gravity><BodySet><objects>\
    <Body name=\"a\"><mass>2</mass><mass_center>0 -0.2 0</mass_center><inertia>0.1 0.1 0.1 0 0 0</inertia></Body>\
    </objects></BodySet><JointSet><objects><PinJoint name=\"j\"><socket_parent_frame>p</socket_parent_frame>\
    <socket_child_frame>c</socket_child_frame><coordinates><Coordinate name=\"q\"><default_value>0.5</default_value>\
    <range>-1 1</range></Coordinate></coordinates><frames><PhysicalOffsetFrame name=\"p\"><socket_parent>/ground\
    </socket_parent><translation>0 1 0</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame>\
    <PhysicalOffsetFrame name=\"c\"><socket_parent>/bodyset/a</socket_parent><translation>0 0 0</translation>\
    <orientation>0 0 0</orientation></PhysicalOffsetFrame></frames></PinJoint></objects></JointSet></Model>\
    </OpenSimDocument>";
