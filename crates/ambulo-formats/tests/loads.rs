//! Reading and writing external loads.

use ambulo_formats::external_loads::{ExternalForce, ExternalLoads};
use proptest::prelude::*;

const OLD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<OpenSimDocument Version="20302">
  <ExternalLoads name="walk">
    <defaults>
      <ExternalForce name="default"><applied_to_body>nowhere</applied_to_body></ExternalForce>
    </defaults>
    <objects>
      <!-- one foot -->
      <ExternalForce name="right">
        <isDisabled> false </isDisabled>
        <applied_to_body> calcn_r </applied_to_body>
        <force_expressed_in_body> ground </force_expressed_in_body>
        <force_identifier><!-- the right one --> ground_force_v </force_identifier>
        <point_identifier> ground_force_p </point_identifier>
        <torque_identifier>  </torque_identifier>
        <data_source_name> Unassigned </data_source_name>
      </ExternalForce>
    </objects>
    <groups/>
    <datafile> walk_grf.mot </datafile>
  </ExternalLoads>
</OpenSimDocument>"#;

fn read(text: &str) -> (ExternalLoads, Vec<String>) {
    let (loads, remarks) = ExternalLoads::read(text.as_bytes()).unwrap();
    (loads, remarks.iter().map(ToString::to_string).collect())
}

fn walk() -> ExternalLoads {
    ExternalLoads {
        name: "walk".into(),
        datafile: Some("walk_grf.mot".into()),
        forces: vec![ExternalForce {
            name: "right".into(),
            enabled: true,
            applied_to_body: "calcn_r".into(),
            force_expressed_in_body: "ground".into(),
            point_expressed_in_body: "ground".into(),
            force_identifier: Some("ground_force_v".into()),
            point_identifier: Some("ground_force_p".into()),
            torque_identifier: None,
        }],
    }
}

#[test]
fn an_old_document_is_read_without_its_defaults() {
    assert_eq!(read(OLD), (walk(), vec![]));
}

#[test]
fn a_new_document_is_read() {
    let text = OLD.replace("<isDisabled> false </isDisabled>", "<appliesForce>true</appliesForce>");
    assert_eq!(read(&text), (walk(), vec![]));
    assert_eq!(read(text.replace("20302", "40000").as_str()), (walk(), vec![]));
}

#[test]
fn a_document_may_lack_the_outer_element() {
    let start = OLD.find("<ExternalLoads").unwrap();
    let end = OLD.find("</OpenSimDocument>").unwrap();
    assert_eq!(read(&OLD[start..end]), (walk(), vec![]));
}

#[test]
fn a_force_can_be_disabled_in_either_way() {
    for off in ["<isDisabled>true</isDisabled>", "<appliesForce>false</appliesForce>"] {
        let (loads, remarks) = read(&OLD.replace("<isDisabled> false </isDisabled>", off));
        assert!(!loads.forces[0].enabled, "{off}");
        assert_eq!(remarks, ["line 9: <ExternalForce> `right` is disabled"]);
    }
}

#[test]
fn of_a_body_path_the_last_part_is_kept() {
    assert_eq!(read(&OLD.replace(" calcn_r ", "/bodyset/calcn_r").replace(" ground ", "/ground")).0, walk());
}

#[test]
fn what_is_not_read_is_remarked() {
    let (_, remarks) = read(&OLD.replace("Unassigned", "other.sto").replace("ground_force_p", ""));
    assert_eq!(
        remarks,
        [
            "line 9: <ExternalForce> `right` has no point columns; OpenSim lets the force act at the body's origin",
            "line 9: <ExternalForce> `right` names its own data source `other.sto`, which was not read; <datafile> was \
             used"
        ]
    );
    let (_, remarks) = read(&OLD.replace("ground_force_v", "").replace(" walk_grf.mot ", "Unassigned"));
    assert_eq!(
        remarks,
        [
            "line 9: <ExternalForce> `right` has neither force nor torque columns; it has no effect",
            "line 3: <ExternalLoads> `walk` names no <datafile>; the file of forces must be given separately"
        ]
    );
    let kinematics = "<groups/><external_loads_model_kinematics_file>ik.mot</external_loads_model_kinematics_file>";
    let (_, remarks) = read(&OLD.replace("<groups/>", kinematics));
    assert_eq!(remarks, Vec::<String>::new(), "it has no effect on forces in the axes of the ground");
    let turned = kinematics.to_owned() + "<!-- -->";
    let of_foot = OLD.replace("<groups/>", &turned).replacen("> ground <", ">calcn_r<", 1);
    let said = "names a kinematics file, which was not read; the motion that is analysed turns the forces";
    assert!(read(&of_foot).1.iter().any(|remark| remark.contains(said)));
    let (_, remarks) = read("<ExternalLoads><objects/><datafile>a.mot</datafile></ExternalLoads>");
    assert_eq!(remarks, ["line 1: <ExternalLoads> nothing holds no force"]);
}

fn word() -> impl Strategy<Value = String> {
    "[a-zA-Z0-9_<>&\"'äß.]([a-zA-Z0-9_<>&\"' äß.]{0,10}[a-zA-Z0-9_<>&\"'äß.])?"
        .prop_filter("OpenSim's word for nothing", |word| !word.eq_ignore_ascii_case("unassigned"))
}

fn any_force() -> impl Strategy<Value = ExternalForce> {
    let identifier = || prop::option::of(word());
    let names = (word(), any::<bool>(), word(), word(), word());
    (names, identifier(), identifier(), identifier()).prop_map(|(names, force, point, torque)| ExternalForce {
        name: names.0,
        enabled: names.1,
        applied_to_body: names.2,
        force_expressed_in_body: names.3,
        point_expressed_in_body: names.4,
        force_identifier: force,
        point_identifier: point,
        torque_identifier: torque,
    })
}

proptest! {
    #[test]
    fn a_written_document_reads_back_the_same(
        name in word(), datafile in prop::option::of(word()), forces in prop::collection::vec(any_force(), 0..4),
    ) {
        let loads = ExternalLoads { name, datafile, forces };
        let (read, _) = ExternalLoads::read(&loads.write()).unwrap();
        prop_assert_eq!(read, loads);
    }
}
