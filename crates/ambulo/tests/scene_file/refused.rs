//! The errors of scene files that are invalid.

use super::{ANN, GOOD, parse, person, refusal, said, said_with};
use ambulo::simulation::scene::SceneError;

#[test]
fn text_that_is_no_toml_is_rejected_with_its_line() {
    let error = refusal("step = 0.001\nduration 2.0\n");
    assert_eq!((error.line, error.key.as_str()), (2, ""));
    assert!(error.to_string().starts_with("line 2: this is not TOML: "), "{error}");
    assert!(error.message.contains(". hint: "), "{error}");
    assert_eq!(refusal("step = 0.001\nstep = 0.002\n").line, 2);
    assert_eq!(refusal("step = 0.001\ntitle = \"open\nduration = 1\n").line, 2);
}

#[test]
fn an_unknown_key_is_rejected_with_those_that_are_known() {
    assert_eq!(
        said("mass = 2\n", "mas = 2\n"),
        "line 15, `body[1].mas`: unknown key; expected `name`, `mass`, `inertia`, `position`, `rotation`, \
         `velocity`, `angular_velocity_deg`, `angular_velocity`, `shape`. hint: did you mean `mass`?"
    );
    assert_eq!(
        said("friction = 0.9", "frcition = 0.9"),
        "line 6, `material.rubber.frcition`: unknown key; expected `law`, `friction`, `restitution`. \
         hint: did you mean `friction`?"
    );
    assert!(said("[[event]]", "[[evnt]]").starts_with("line 49, `evnt`: unknown key; expected `title`"));
    assert!(said("[[event]]", "[[evnt]]").ends_with("hint: did you mean `event`?"));
    assert!(said("[0, 0.8, 0]", "[0, 0.8, 0]\naxis = [0, 0, 1]").starts_with("line 41, `joint[2].axis`: unknown key"));
}

#[test]
fn a_missing_key_is_rejected_with_its_meaning() {
    assert_eq!(
        said("step = 0.001\n", ""),
        "line 1, `step`: found no `step`; expected the time step [s], such as 0.001"
    );
    assert_eq!(said("mass = 2\n", ""), "line 13, `body[1].mass`: found no `mass`; expected the mass [kg]");
    assert_eq!(
        said("inertia = [0.02, 0.001, 0.02]\n", ""),
        "line 19, `body[2].inertia`: found no `inertia`; expected the moments about the mass centre [xx, yy, zz] \
         [kg.m²]. hint: `inertia` is optional for a body with shapes, which is then taken as uniform"
    );
    assert_eq!(
        said("name = \"knee\"\n", "nmae = \"knee\"\n"),
        "line 35, `joint[2].name`: found no `name`; expected a name. hint: is `nmae` meant to be `name`?"
    );
    assert_eq!(
        refusal("step = 1\nduration = 1\n").to_string(),
        "line 1, `body`: found no `body`; expected at least one [[body]] or [[figure]]"
    );
}

/// Tables that only dotted keys make have no header to point at.
#[test]
fn a_missing_key_of_a_dotted_table_is_placed() {
    let said = said("limits = { lower_deg = -30, upper_deg = 90 }", "motor.target_deg = 5");
    assert!(said.starts_with("line 33, `joint[1].coordinate.motor.stiffness`: found no `stiffness`"), "{said}");
}

#[test]
fn masses_and_inertias_that_no_body_has_are_rejected() {
    assert_eq!(
        said("mass = 2\n", "mass = -2\n"),
        "line 15, `body[1].mass`: found -2; expected a number above zero. hint: a solid that forces do not move is an \
         [[obstacle]]"
    );
    assert!(said("mass = 2\n", "mass = 0\n").starts_with("line 15, `body[1].mass`: found 0; expected a number above"));
    let inertia = |numbers: &str| said("[0.02, 0.001, 0.02]", numbers);
    assert_eq!(
        inertia("[0.02, 0, 0.02]"),
        "line 22, `body[2].inertia`: found [0.02, 0, 0.02]; expected an inertia above zero about every axis; the \
         smallest \
         principal moment is 0e0 kg.m². hint: the moment of a thin rod about its axis is m r²/2"
    );
    assert!(inertia("[0.02, 0.001, 0.01]").contains("expected an inertia that a body can have; principal moments"));
    assert!(inertia("[[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]").contains("expected a symmetric matrix"));
    assert!(inertia("[[1, 0, 0], [0, 1, 0], [0, 0, \"1\"]]").starts_with("line 22, `body[2].inertia[3][3]`: found"));
    assert!(inertia("[1, 2]").ends_with("expected three moments [xx, yy, zz] or three rows of three [kg.m²]"));
    parse(&GOOD.replace("[0.02, 0.001, 0.02]", "[[1, 0.1, 0], [0.1, 1, 0], [0, 0, 1]]"));
    let aside = said("size = [0.1, 0.4, 0.1]", "size = [0.1, 0.4, 0.1], at = [0, 0.1, 0]");
    assert_eq!(
        aside,
        "line 13, `body[1]`: found shapes whose common centre is [0.000000, 0.100000, 0.000000]; expected it at the \
         body's \
         origin, its mass centre. hint: move the shapes, or give `inertia` if the body is not uniform"
    );
}

#[test]
fn numbers_that_are_not_finite_are_rejected() {
    for bad in ["nan", "inf", "-inf", "1e400", "1e16"] {
        assert_eq!(
            said("[0, 1.0, 0]", &format!("[0, {bad}, 0]")),
            format!(
                "line 16, `body[1].position[2]`: found {bad}; expected a number. hint: numbers are finite and at most \
                 1e15 \
                 in size"
            )
        );
    }
    assert!(
        said("mass = 2\n", "mass = nan\n").starts_with("line 15, `body[1].mass`: found nan; expected a number above")
    );
}

#[test]
fn steps_and_durations_must_be_above_zero() {
    let step = |text: &str| said("step = 0.001", text);
    assert_eq!(step("step = 0"), "line 2, `step`: found 0; expected a number above zero");
    assert_eq!(step("step = -0.001"), "line 2, `step`: found -0.001; expected a number above zero");
    assert_eq!(step("step = 3"), "line 2, `step`: found 3; expected a step of at most 2 s, the duration");
    assert!(step("step = 1e-12").contains("expected at most 1e9 steps"));
    assert_eq!(said("duration = 2.0", "duration = 0"), "line 3, `duration`: found 0; expected a number above zero");
    assert_eq!(
        step("step = 0.001\noutput_rate = 2000"),
        "line 3, `output_rate`: found 2000; expected at most one row per step, 1000 Hz"
    );
}

#[test]
fn values_of_another_kind_are_rejected() {
    assert_eq!(
        said("mass = 2\n", "mass = \"2\"\n"),
        "line 15, `body[1].mass`: found \"2\"; expected a number above zero. hint: write numbers without quotes; a \
         solid \
         that forces do not move is an [[obstacle]]"
    );
    assert_eq!(said("title = \"Good\"", "title = 5"), "line 1, `title`: found 5; expected a text in quotes");
    assert_eq!(
        said("[0, 1.0, 0]", "[0, 1.0]"),
        "line 16, `body[1].position`: found [0, 1.0]; expected three numbers [x, y, z]"
    );
    assert_eq!(
        said("step = 0.001", "step = 0.001\nprojection = \"yes\""),
        "line 3, `projection`: found \"yes\"; expected true or false"
    );
    assert_eq!(
        refusal("step = 1\nduration = 1\nbody = 3\n").to_string(),
        "line 3, `body`: found 3; expected tables, each under the header [[body]]"
    );
    assert_eq!(
        said("kind = \"ball\"\nparent", "kind = \"bal\"\nparent"),
        "line 37, `joint[2].kind`: found \"bal\"; expected one of \"weld\", \"revolute\", \"universal\", \"ball\", \
         \"prismatic\", \"planar\", \"free\". hint: did you mean \"ball\"?"
    );
    let axis = said("axis = [0, 0, 1]", "axis = [0, 0, 0]");
    assert_eq!(axis, "line 31, `joint[1].axis`: found [0, 0, 0]; expected a direction [x, y, z] longer than zero");
}

#[test]
fn unknown_names_are_rejected() {
    assert_eq!(
        said("parent = \"upper\"", "parent = \"uper\""),
        "line 38, `joint[2].parent`: found \"uper\"; expected \"world\", a body, or \"figure/body\". \
         hint: did you mean \"upper\"?"
    );
    assert_eq!(
        said("child = \"lower\"", "child = \"shin\""),
        "line 39, `joint[2].child`: found \"shin\"; expected a body of the scene. \
         hint: the names are `floor`, `lower`, `upper`"
    );
    assert_eq!(
        said("second = \"world\"", "second = \"floor\""),
        "line 46, `closure[1].second`: found \"floor\"; expected \"world\", a body, or \"figure/body\". hint: \
         \"floor\" \
         is an obstacle; joints connect bodies, if necessary a body on a driven joint"
    );
    assert_eq!(
        said("material = \"rubber\"", "material = \"ruber\""),
        "line 11, `obstacle[1].material`: found \"ruber\"; expected one of \"default\", \"rubber\". \
         hint: did you mean \"rubber\"?"
    );
    assert!(
        said("remove = \"string\"", "remove = \"rope\"").contains("expected a closure or a joint. hint: the names")
    );
    let events = said("remove = \"string\"", "add = \"knee\"");
    assert_eq!(events, "line 51, `event[1].add`: found \"knee\"; expected a closure. hint: \"knee\" is a joint");
    assert!(said_with("[output]\nplot = [\"joint:kne\"]\n").ends_with("hint: did you mean \"knee\"?"));
}

#[test]
fn a_name_given_twice_is_rejected() {
    assert_eq!(
        said("name = \"lower\"", "name = \"upper\""),
        "line 20, `body[2].name`: found \"upper\"; expected a unique name; this one is also in line 14. \
         hint: names are unique among bodies, obstacles and figures, and among joints and closures"
    );
    assert!(said("name = \"floor\"", "name = \"upper\"").starts_with("line 9, `obstacle[1].name`: found \"upper\""));
    assert!(said("name = \"string\"", "name = \"hip\"").starts_with("line 43, `closure[1].name`: found \"hip\""));
    for bad in ["", "world", "a/b", "a:b", " a"] {
        let said = said("name = \"lower\"", &format!("name = \"{bad}\""));
        assert!(said.starts_with("line 20, `body[2].name`: found "), "{said}");
        assert!(said.contains("expected a name that is not empty and not \"world\", without / and :"), "{said}");
    }
}

#[test]
fn joints_that_form_no_tree_are_rejected() {
    assert_eq!(
        said("parent = \"world\"", "parent = \"lower\""),
        "line 28, `joint[1].parent`: found \"lower\"; expected a chain of parents without a cycle; found \
         upper -> lower -> upper. hint: close the loop with a [[closure]]"
    );
    assert!(said("parent = \"world\"", "parent = \"upper\"").contains("without a cycle; found upper -> upper"));
    assert_eq!(
        said("child = \"lower\"", "child = \"upper\""),
        "line 39, `joint[2].child`: found \"upper\"; expected the child of one joint; this body is already the \
         child of \"hip\" (line 25). hint: close the loop with a [[closure]]"
    );
}

#[test]
fn a_cycle_without_the_first_joint_is_detected() {
    let bodies: String =
        (0..5).map(|i| format!("[[body]]\nname = \"b{i}\"\nmass = 1\ninertia = [1, 1, 1]\n")).collect();
    let joints: String = [("b1", "b0"), ("b2", "b1"), ("b3", "b2"), ("b1", "b3")]
        .iter()
        .enumerate()
        .map(|(i, (parent, child))| {
            format!("[[joint]]\nname = \"j{i}\"\nkind = \"weld\"\nparent = \"{parent}\"\nchild = \"{child}\"\n")
        })
        .collect();
    let error = refusal(&format!("step = 1\nduration = 1\n{bodies}{joints}"));
    assert_eq!((error.line, error.key.as_str()), (31, "joint[2].parent"));
    assert!(error.message.contains("without a cycle; found b1 -> b2 -> b3 -> b1"), "{error}");
}

#[test]
fn coordinates_that_contradict_themselves_are_rejected() {
    let coordinate = |text: &str| said("limits = { lower_deg = -30, upper_deg = 90 }", text);
    assert_eq!(
        coordinate("limits = { lower_deg = 30, upper_deg = -90 }"),
        "line 33, `joint[1].coordinate.limits`: found { lower_deg = 30, upper_deg = -90 }; expected a lower limit \
         below \
         the upper one"
    );
    assert!(coordinate("limits = { lower_deg = 30, upper_deg = 90 }").contains("expected limits around the value at"));
    assert_eq!(
        coordinate("start_deg = 5\nstart = 0.1"),
        "line 33, `joint[1].coordinate.start_deg`: found both `start_deg` and `start`; expected one of them. \
         hint: `_deg` is in degrees"
    );
    assert_eq!(
        coordinate("drive_deg = 5\nstart_deg = 5"),
        "line 34, `joint[1].coordinate.start_deg`: found 5; expected no such key together with a drive. \
         hint: the drive determines value and rate at time zero"
    );
    assert!(coordinate("drive_max = 5").contains("`joint[1].coordinate.drive`: found no `drive`"));
    assert!(coordinate("motor = { target_deg = 5 }").contains("found no `stiffness`"));
    let twice = GOOD.replace("limits = { lower_deg = -30, upper_deg = 90 }", "rate = 1");
    let error = refusal(&twice.replace("mass = 2\n", "mass = 2\nvelocity = [0, 0, 0]\n"));
    assert_eq!(
        error.to_string(),
        "line 34, `joint[1].coordinate.rate`: found 1; expected no rate, as body \"upper\" has its own velocity (line \
         13). \
         hint: remove one of them"
    );
    let second = said("[joint.coordinate]", "[[joint.coordinate]]\n[[joint.coordinate]]");
    assert_eq!(
        second,
        "line 33, `joint[1].coordinate[2]`: found coordinate 2; expected at most 1. \
         hint: docs/SCENES.md lists the free motions of each kind of joint"
    );
    let sliding = GOOD.replace("kind = \"revolute\"", "kind = \"prismatic\"");
    assert_eq!(
        refusal(&sliding).to_string(),
        "line 33, `joint[1].coordinate.limits.lower_deg`: found -30; expected `lower` in metres. \
         hint: this coordinate is a translation"
    );
}

#[test]
fn functions_that_are_none_are_rejected() {
    let drive =
        |function: &str| said("limits = { lower_deg = -30, upper_deg = 90 }", &format!("drive_deg = {function}"));
    assert_eq!(
        drive("\"fast\""),
        "line 33, `joint[1].coordinate.drive_deg`: found \"fast\"; expected a number, or one of { sine = … }, \
         { ramp = … \
         }, { stops = … }, { points = … }, { motion = … }"
    );
    assert!(drive("{ sine = { amplitude = 1 } }").contains("drive_deg.sine.frequency_hz`: found no `frequency_hz`"));
    assert!(drive("{ sine = { amplitude = 1, frequency_hz = 0 } }").contains("found 0; expected a number above zero"));
    assert!(drive("{ sine = { amplitude = 1, frequency_hz = 1 }, from = 1 }").contains("drive_deg.from`: unknown key"));
    assert!(drive("{ stops = [[0, 0]], points = [[0, 0]] }").contains("expected a number, or one of"));
    assert!(
        drive("{ ramp = { from = 0, to = 1, start = 1, end = 1 } }").contains("expected an instant after `start`, 1 s")
    );
    assert!(
        drive("{ stops = [[0, 0], [0, 1]] }").contains("drive_deg.stops[2]`: found [0, 1]; expected a time after 0 s")
    );
    assert!(drive("{ stops = [] }").contains("expected a list of at least 1 [time, value]"));
    assert_eq!(
        drive("{ points = [[0, 0], [1, 5]] }"),
        "line 33, `joint[1].coordinate.drive_deg.points`: found [[0, 0], [1, 5]]; expected points that cover 0 s to \
         2 s (`duration`); these cover 0 s to 1 s. hint: `stops` is constant before its first and after its last time"
    );
    assert!(drive("{ motion = \"a.mot\", column = \"b\" }").contains("hint: the file states whether its angles are"));
    assert!(drive("{ motion = \"a.mot\" }").contains("expected a recording under the key without `_deg`"));
}

#[test]
fn shapes_that_are_none_are_rejected() {
    let shape = |shape: &str| said("{ kind = \"box\", size = [0.1, 0.4, 0.1] }", shape);
    assert_eq!(
        shape("{ kind = \"sphere\", radius = 0 }"),
        "line 17, `body[1].shape.radius`: found 0; expected a number above zero"
    );
    assert!(shape("{ kind = \"plane\" }").contains("one of \"sphere\", \"capsule\", \"box\", \"convex\""));
    assert!(shape("{ kind = \"sphere\", size = [1, 1, 1] }").contains("expected `kind`, `material`, `radius`, `at`"));
    assert!(shape("{ kind = \"box\", size = [1, -1, 1] }").contains("`body[1].shape.size[2]`: found -1"));
    assert!(shape("{ kind = \"capsule\", from = [0, 0, 0], to = [0, 0, 0], radius = 1 }").contains("is a sphere"));
    let flat = "{ kind = \"convex\", points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]] }";
    assert!(shape(flat).contains("expected at least four points [x, y, z], not all in one plane"));
    let solid = "{ kind = \"convex\", points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] }";
    assert!(shape(solid).ends_with("hint: the inertia of a convex shape is not computed"));
    let ground = "[[obstacle]]\nname = \"hill\"\nkind = \"height-field\"\nsize = [1, 1]\nheights = [[0, 1], [0]]\n";
    assert!(
        said_with(ground).starts_with("line 56, `obstacle[2].heights`: found [[0, 1], [0]]; expected at least two")
    );
}

#[test]
fn materials_that_are_none_are_rejected() {
    let rubber = |text: &str| said("friction = 0.9", text);
    assert_eq!(
        rubber("friction = 0.9\nrestitution = 1.5"),
        "line 7, `material.rubber.restitution`: found 1.5; expected a coefficient of restitution from 0 to 1"
    );
    assert!(
        rubber("friction = -1").starts_with("line 6, `material.rubber.friction`: found -1; expected a number, zero")
    );
    assert!(rubber("law = \"regularised\"\nfriction = 1").contains("found no `stiffness`"));
    assert!(rubber("law = \"hunt-crossley\"\nfriction = 1").contains("expected `law`, `stiffness`, `dissipation`"));
    assert!(rubber("law = \"soft\"").contains("expected one of \"rigid\", \"regularised\", \"hunt-crossley\""));
}

#[test]
fn closures_that_are_open_are_rejected() {
    let string = |text: &str| said("at = [0, 0.4, 0]", text);
    assert_eq!(
        string("on_first = [0, -0.2, 0]\non_second = [0, 0.5, 0]"),
        "line 48, `closure[1].on_second`: found [0, 0.5, 0]; expected points that coincide at the start, within 1 mm; \
         they are \
         0.1000 m apart. hint: move the bodies, or set active = false and add the closure by an [[event]]"
    );
    parse(&GOOD.replace("at = [0, 0.4, 0]", "on_first = [0, -0.2, 0]\non_second = [0, 0.4, 0]"));
    assert!(string("").contains("found no `at`; expected the point [m]"));
    assert!(string("at = [0, 0, 0]\non_first = [0, 0, 0]").contains("expected either `at`, or `on_first` and"));
    assert!(said("second = \"world\"", "second = \"lower\"").contains("expected another body than `first`"));
    let free = said("kind = \"ball\"\nfirst", "kind = \"free\"\nfirst");
    assert_eq!(free, "line 44, `closure[1].kind`: found \"free\"; expected a kind with a constraint; `free` has none");
}

#[test]
fn events_that_change_nothing_are_rejected() {
    assert_eq!(
        said("time = 1.0", "time = 2.5"),
        "line 50, `event[1].time`: found 2.5; expected an instant from 0 to 2 s, the duration"
    );
    assert_eq!(
        said("remove = \"string\"", "add = \"string\""),
        "line 51, `event[1].add`: found \"string\"; expected a closure that is not active at 1 s already. \
         hint: with active = false a closure is inactive until an event adds it"
    );
    let again = said_with("[[event]]\ntime = 1.5\nremove = \"string\"\n");
    assert_eq!(
        again,
        "line 54, `event[2].remove`: found \"string\"; expected a closure or joint that is active at 1.5 s"
    );
    assert!(said("time = 1.0", "time = 1.0\nadd = \"knee\"").contains("expected either `add` or `remove`"));
    parse(&format!("{GOOD}[[event]]\ntime = 1.5\nadd = \"string\"\n[[event]]\ntime = 1.5\nremove = \"knee\"\n"));
}

#[test]
fn figures_and_pairs_that_make_no_sense_are_rejected() {
    let figure = |text: &str| said_with(&format!("[[figure]]\nname = \"walker\"\n{text}\n"));
    assert_eq!(
        figure(""),
        "line 52, `figure[1].model`: found no `model`; expected the path of an .osim file, or `build` with a table, a \
         mass \
         and a height"
    );
    assert!(figure("model = \"a.osim\"\ndrive = \"all\"").contains("`figure[1].motion`: found no `motion`"));
    assert!(figure("model = \"a.osim\"\nmotion = \"\"").contains("expected a text that is not empty"));
    assert!(figure("model = \"a.osim\"\ndrive = \"some\"").contains("expected \"all\", \"none\", or a list"));
    let ignore = |pair: &str| said_with(&format!("[[ignore]]\npair = {pair}\n"));
    assert_eq!(ignore("[\"upper\"]"), "line 53, `ignore[1].pair`: found [\"upper\"]; expected two names");
    assert!(ignore("[\"upper\", \"upper\"]").contains("expected two different names"));
    assert!(ignore("[\"upper\", \"flor\"]").ends_with("hint: did you mean \"floor\"?"));
}

#[test]
fn an_error_from_later_reads_the_same_way() {
    let error =
        SceneError::new(7, "figure[1].model", "found no file `a.osim`").hint("paths begin at the scene's folder");
    assert_eq!(
        error.to_string(),
        "line 7, `figure[1].model`: found no file `a.osim`. hint: paths begin at the scene's folder"
    );
}
#[test]
fn built_figures_that_make_no_sense_are_rejected() {
    let said = |build: &str, more: &str| refusal(&person(build, more)).to_string();
    let cases = [
        ("60", "", "line 4, `figure[1].build`: found 60; expected { table = …, mass = …, height = … }"),
        ("{ mass = 60 }", "", "line 4, `figure[1].build.table`: found no `table`; expected the table of segments"),
        (
            "{ table = \"de-leva-woman\", mass = 60, height = 1.65 }",
            "",
            "`figure[1].build.table`: found \"de-leva-woman\"; expected one of \"faure-1997\"",
        ),
        (
            "{ table = \"faure-1997\", mass = 60, height = 165 }",
            "",
            "line 4, `figure[1].build`: the height is 165 m; expected 0.4 to 2.5 m. hint: metres",
        ),
        (ANN, "model = \"a.osim\"", "`figure[1].model`: unknown key"),
        (ANN, "walk = { gait = \"trot\" }", "line 6, `figure[1].walk.gait`: found \"trot\"; expected a path that ends"),
        (ANN, "walk = { speed = -1 }", "`figure[1].walk.speed`: found -1; expected a number, zero or more"),
        (ANN, "walk = { phase = 1 }", "`figure[1].walk.phase`: found 1; expected a share of the cycle"),
        (
            ANN,
            "walk = { mode = \"curve\" }",
            "expected one of \"corrected\", \"optimal\", \"curves\". hint: did you mean \"curves\"?",
        ),
        (
            ANN,
            "walk = { mode = \"corrected\" }\ncontrol = { recovery_steps = false }",
            "found false; expected no such key for a planar figure: recovery steps need three dimensions",
        ),
        (ANN, "walk = { mode = \"optimal\" }\ncontrol = { recovery_steps = 1 }", "found 1; expected true or false"),
        (ANN, "arms = { left = { abduction_deg = 120 } }", "expected an angle away from the trunk, up to 90 degrees"),
        (
            ANN,
            "arms = { left = { damping = 2 } }",
            "`figure[1].arms.left.damping`: found 2; expected no such key without",
        ),
        (ANN, "shoes = \"clog\"", "line 6, `figure[1].shoes`: found \"clog\"; expected one of \"default\""),
        (
            ANN,
            "[[figure.coordinate]]\nname = \"arm_flex\"",
            "line 7, `figure[1].coordinate[1].name`: found \"arm_flex\"",
        ),
        (
            ANN,
            "[[figure.coordinate]]\nname = \"arm_flex_l\"\nfollow = { stiffness = 1 }",
            "`figure[1].coordinate[1].follow`: found { stiffness = 1 }; expected no such key without a `walk` to \
             follow",
        ),
        (
            ANN,
            "walk = {}\n[[figure.coordinate]]\nname = \"arm_flex_l\"\ndrive = 0\nfollow = { stiffness = 1 }",
            "`figure[1].coordinate[1].follow`: found { stiffness = 1 }; expected no such key together with a drive or \
             a motor",
        ),
        (
            ANN,
            "[[figure.coordinate]]\nname = \"arm_flex_l\"\n[[figure.coordinate]]\nname = \"arm_flex_l\"",
            "`figure[1].coordinate[2].name`: found \"arm_flex_l\" twice; the first one is in line 6",
        ),
        (ANN, "[[figure.coordinate]]\nname = \"pelvis_tx\"\nstart_deg = 1", "expected `start` in metres"),
    ];
    for (build, more, expected) in cases {
        let found = said(build, more);
        assert!(found.contains(expected), "{found}\n{expected}");
    }
}
