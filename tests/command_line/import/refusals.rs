//! What is refused, where, and how it looks on the command line.

use std::fs;
use std::path::Path;

use dbd_import::{ImportError, Kind, Options, import_text};
use host_sim::cli::main_with;
use host_sim::terminal::{Console, Exit};

/// A text's refusal: line, column, what is wrong, what would be right.
fn refusal(text: &str) -> (usize, usize, String, String) {
    match import_text(text, "test.xml", Path::new(""), &Options::default()) {
        Err(ImportError::Refused(refusal)) => {
            (refusal.line, refusal.column, refusal.message.clone(), refusal.help.clone())
        }
        other => panic!("{text}: {other:?}"),
    }
}

/// A text with a hinged body, beside which these stand: in the body, in the world, in `<mujoco>`.
fn with(in_body: &str, in_world: &str, beside: &str) -> String {
    format!(
        "<mujoco>\n<worldbody>\n<body name='a'>\n<joint name='h'/>\n\
         <inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>\n{in_body}\n</body>\n{in_world}\n\
         </worldbody>\n{beside}\n</mujoco>"
    )
}

#[test]
fn what_is_wrong_is_named_with_its_place() {
    let body = |inner: &str| {
        format!("<mujoco><worldbody><body name='a'>{inner}</body></worldbody></mujoco>")
    };
    for (text, line, message, help) in [
        ("<sdf/>".into(), 1, "root element is <sdf>", "URDF"),
        (with("", "", "<actuators/>"), 10, "unknown section <actuators>", "<actuator>"),
        (with("<geom size='x'/>", "", ""), 6, "`size` contains \"x\"", "numbers"),
        (with("<geom size='nan'/>", "", ""), 6, "`size` contains \"nan\"", "numbers"),
        (with("<geom type='bx'/>", "", ""), 6, "`type` is \"bx\"", "\"box\""),
        (with("<geom type='box' size='1 1'/>", "", ""), 6, "`size` of a box is", "3 numbers > 0"),
        (with("<geom class='bar'/>", "", ""), 6, "unknown class \"bar\"", "<default>"),
        (with("", "<body name='a'/>", ""), 8, "`a` is already defined in line 3", "unique"),
        (with("<body><joint name='h'/></body>", "", ""), 6, "already used in line 4", "unique"),
        (with("<body name='b'><freejoint/></body>", "", ""), 6, "free joint", "world"),
        (with("<body quat='0 0 0 0'/>", "", ""), 6, "`quat` is 0", "length"),
        (with("<body quat='1 0 0 0' euler='0 0 0'/>", "", ""), 6, "given twice", "one of"),
        (with("", "<joint/>", ""), 8, "belong to the world", "<body>"),
        (with("", "", "<include file='none.xml'/>"), 10, "cannot read none.xml", "folder"),
        (with("", "", "<include/>"), 10, "has no `file`", "file"),
        (with("", "", "<compiler coordinate='global'/>"), 10, "global", "local"),
        (with("", "", "<compiler eulerseq='xyw'/>"), 10, "`eulerseq` is \"xyw\"", "three of"),
        (
            with("", "", "<equality><connect body1='b' anchor='0 0 0'/></equality>"),
            10,
            "unknown body `b`",
            "`a`",
        ),
        (with("", "", "<equality><connect body1='a'/></equality>"), 10, "no `anchor`", "site1"),
        (with("", "", "<actuator><motor joint='g'/></actuator>"), 10, "unknown joint `g`", "`h`"),
        (body(""), 1, "nothing moves", "<joint>"),
        (body("<joint/>"), 1, "moves and has no mass", "<inertial>"),
        (
            body("<joint/><inertial pos='0 0 0' mass='1'/>"),
            1,
            "principal moments 0",
            "boundinertia",
        ),
        (
            body("<joint/><inertial pos='0 0 0' mass='1' diaginertia='1 1 3'/>"),
            1,
            "exceeds",
            "balance",
        ),
        (body("<joint axis='0 0 0'/>"), 1, "`axis` is 0", "length"),
        (body("<joint stiffness='-1'/>"), 1, "`stiffness` is -1", "≥ 0"),
        (
            body("<inertial pos='0 0 0' mass='1' euler='1 0 0' fullinertia='1 1 1 0 0 0'/>"),
            1,
            "`fullinertia`",
            "one",
        ),
        ("<mujoco><default><default/></default></mujoco>".into(), 1, "has no `class`", "name"),
        ("<mujoco/>".into(), 1, "has no bodies", "<worldbody>"),
    ] {
        let (found, _, said, remedy) = refusal(&text);
        assert_eq!(found, line, "{text}: {said}");
        assert!(said.contains(message), "{text}: {said}");
        assert!(remedy.contains(help), "{text}: {remedy}");
    }
}

/// Each thing that has no counterpart, with its line and its size.
#[test]
fn what_has_no_counterpart_is_listed_by_line_with_its_size() {
    let text = with(
        "<joint name='second' type='slide' axis='1 0 0'/><joint name='third' type='slide' axis='0 1 1'/>\n\
         <geom name='ball' size='0.1'/>\n\
         <body name='b' gravcomp='1'><joint name='j' type='ball'/><geom size='0.2' contype='0' conaffinity='0'/>\
         <body name='tip' gravcomp='1' mass='3'><geom type='mesh' mesh='m'/></body></body>\n\
         <body name='d'><joint name='k' stiffness='1 0.5' armature='0.01' frictionloss='0.2' range='-45 45'/>\
         <geom size='0.1' contype='0' conaffinity='0' fluidshape='ellipsoid'/></body>",
        "<geom name='floor' type='plane' size='1 1 1'/>\n<body name='hand' mocap='true'/>\n<replicate count='3'/>",
        "<option viscosity='0.002'/>\n\
         <tendon><spatial name='cord' stiffness='7'><site site='x'/></spatial></tendon>\n\
         <equality><joint name='mimic' joint1='h' joint2='k' polycoef='0 2 1 0 0'/></equality>\n\
         <actuator><motor name='m' joint='h' armature='0.1'/><intvelocity name='p' joint='h' kp='9'/></actuator>",
    );
    let Err(ImportError::Omitted { omissions, .. }) =
        import_text(&text, "test.xml", Path::new(""), &Options::default())
    else {
        panic!();
    };
    let found: Vec<(usize, Kind, &str)> =
        omissions.iter().map(|o| (o.line, o.kind, o.what.as_str())).collect();
    let expected = [
        (
            6,
            Kind::Joints,
            "body `a` has hinge `h`, slide `second`, slide `third`: a scene has no exact equivalent; \
             `--carriers 0.01` is accurate to about 1 % of its mass; if ignored, only the first joint is kept",
        ),
        (8, Kind::Unknown, "`mass` of body `tip`"),
        (
            8,
            Kind::Mesh,
            "geom, mesh: its mass in body `tip`: mesh `m`, unknown mesh `m`; give an <inertial>; MuJoCo writes those of \
             meshes: <compiler saveinertial=\"true\"/>, then `mj_saveLastXML`",
        ),
        (8, Kind::Contact, "geom, mesh: may touch 1 other"),
        (9, Kind::Spring, "hinge `k`: stiffness [1.0, 0.5], which is not linear"),
        (9, Kind::Fluid, "geom, sphere, radius 0.1 m: drag of a medium"),
        (11, Kind::Contact, "geom `floor`, plane: may touch 1 other"),
        (12, Kind::Mocap, "mocap body `hand` stays fixed"),
        (13, Kind::Generated, "<replicate>, which generates parts that are not in the file"),
        (15, Kind::Fluid, "viscosity 0.002 Pa·s of the medium"),
        (
            16,
            Kind::Tendon,
            "spatial `cord`: 1 points or joints stiffness 7: only springs between two sites are supported",
        ),
        (
            17,
            Kind::Equality,
            "joint `mimic`: joint1 h, joint2 k, polycoef 0 2 1 0 0: only linear couplings are supported",
        ),
        (18, Kind::Armature, "motor `m`: armature 0.1 kg·m²"),
        (
            18,
            Kind::Actuator,
            "intvelocity `p`, joint h, kp 9: integrates its control: integrate in the caller and drive a <position>",
        ),
    ];
    assert_eq!(found, expected);
    // All of them together can be left out.
    let ignored = Kind::ALL.to_vec();
    let all = Options { ignored, ..Options::default() };
    assert_eq!(import_text(&text, "test.xml", Path::new(""), &all).unwrap().omitted.len(), 14);
}

/// What is turned off in the file is not missed.
#[test]
fn what_the_file_turns_off_is_not_listed() {
    let text = with(
        "<body><joint range='-1 1' frictionloss='1' stiffness='3'/><geom size='0.1'/></body>",
        "<geom size='1'/>",
        "<option><flag contact='disable' limit='disable' frictionloss='disable' spring='disable'/></option>",
    );
    let made = import_text(&text, "test.xml", Path::new(""), &Options::default()).unwrap();
    assert!(made.omitted.is_empty() && !made.scene.contains("torsion_spring"));
    assert!(!made.scene.contains("limits") && !made.scene.contains("friction"), "{}", made.scene);
}

/// Files include each other once, from the folder of the first.
#[test]
fn files_that_are_included_keep_their_places() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    file("round.xml", "<mujocoinclude><include file='round.xml'/></mujocoinclude>");
    file(
        "limit.xml",
        "<mujocoinclude>\n\n<joint name='k' actuatorfrcrange='-1 1'/></mujocoinclude>",
    );
    let made = |text: &str| import_text(text, "test.xml", folder.path(), &Options::default());
    let Err(ImportError::Refused(refusal)) = made("<mujoco><include file='round.xml'/></mujoco>")
    else {
        panic!();
    };
    assert!(refusal.message.contains("round.xml is included a second time"), "{refusal}");
    let text = with("<body><include file='limit.xml'/><geom size='1'/></body>", "", "");
    let Err(ImportError::Omitted { omissions, .. }) = made(&text) else { panic!() };
    assert!(omissions[0].file.ends_with("limit.xml"), "{omissions:?}");
    assert_eq!((omissions.len(), omissions[0].line), (1, 3));
}

/// Calls the command line: exit code, standard output, standard error.
fn call(arguments: &[&str]) -> (Exit, String, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::plain(&mut out, &mut err);
    let line = ["host-sim", "import"].iter().chain(arguments);
    let exit = main_with(line, &mut console);
    (exit, String::from_utf8(out).unwrap(), String::from_utf8(err).unwrap())
}

#[test]
fn the_command_refuses_lists_and_writes() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (xml, toml) = (path("a.xml"), path("a.toml"));
    fs::write(
        &xml,
        with(
            "<body name='b'><joint name='k' actuatorfrcrange='-1 1'/><geom size='1'/></body>",
            "",
            "",
        ),
    )
    .unwrap();
    let (exit, out, err) = call(&[&xml, "--out", &toml]);
    assert_eq!((exit, out.as_str()), (Exit::Refused, ""));
    assert!(err.contains("a.xml:6") && err.contains("actuators -1 to 1 N·m"), "{err}");
    assert!(err.contains("--ignore limit"), "{err}");
    assert!(!Path::new(&toml).exists());
    let (exit, out, _) = call(&[&xml, "--list"]);
    assert_eq!((exit, out.lines().count()), (Exit::Done, 1));
    let (exit, out, err) = call(&[&xml, "--ignore", "limit", "--out", &toml]);
    assert_eq!((exit, out.as_str()), (Exit::Done, ""), "{err}");
    assert!(err.contains("note: left out"), "{err}");
    assert!(fs::read_to_string(&toml).unwrap().contains("name = \"a\""));
    // Again, and not over another's file.
    assert_eq!(call(&[&xml, "--ignore", "all", "--out", &toml]).0, Exit::Done);
    fs::write(&toml, "name = \"mine\"\n").unwrap();
    let (exit, _, err) = call(&[&xml, "--ignore", "all", "--out", &toml]);
    assert_eq!(exit, Exit::Refused);
    assert!(err.contains("was not written by host-sim import"), "{err}");
    for wrong in [
        &["--ignore", "limits"][..],
        &["--stiffness", "0"],
        &["--stiffness", "nan"],
        &["--damping", "-1"],
    ] {
        assert_eq!(call(&[&[xml.as_str()], wrong].concat()).0, Exit::Refused, "{wrong:?}");
    }
    let (exit, _, err) = call(&[&path("none.xml")]);
    assert!(exit == Exit::Refused && err.contains("cannot read"), "{err}");
    // A size at which no joint can be made: what is written can be run, or is not written.
    let (exit, _, err) = call(&[&xml, "--ignore", "all", "--span", "1e-300"]);
    assert!(exit == Exit::Refused && err.contains("invalid scene from"), "{err}");
}

/// A triangle of two links whose sites do not meet by `gap` [m] wherever the links are turned.
fn triangle(gap: f64) -> String {
    let reach = 0.4 + gap;
    format!(
        "<mujoco><worldbody><site name='pin' pos='{reach} 0 0'/>\
         <body name='a'><joint axis='0 1 0'/><inertial pos='0.1 0 0' mass='1' diaginertia='1 1 1'/>\
         <body name='b' pos='0.2 0 0'><joint axis='0 1 0'/>\
         <inertial pos='0.1 0 0' mass='1' diaginertia='1 1 1'/><site name='tip' pos='0.2 0 0'/>\
         </body></body></worldbody>\
         <equality><connect name='loop' site1='pin' site2='tip'/></equality></mujoco>"
    )
}

/// Loops close up to a fraction of the mechanism's size or to what is stated; where one does not, its scene
/// is written even so.
#[test]
fn loops_close_within_a_tolerance() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (xml, toml) = (path("a.xml"), path("a.toml"));
    let written = || fs::read_to_string(&toml).unwrap_or_default();
    fs::write(&xml, triangle(1e-6)).unwrap();
    let (exit, _, err) = call(&[&xml, "--out", &toml]);
    assert_eq!(exit, Exit::Done, "{err}");
    assert!(err.contains("loops open by up to 1.0e-6 m"), "{err}");
    dbd_scene::Scene::parse(&written(), "a").unwrap();
    let (exit, _, err) = call(&[&xml, "--out", &toml, "--tolerance", "1e-9"]);
    assert_eq!(exit, Exit::Refused);
    assert!(err.contains("remains open by") && err.contains("--tolerance"), "{err}");
    assert!(written().contains("tolerance = 1e-9") && written().contains("[[joint]]"));
    assert!(dbd_scene::Scene::parse(&written(), "a").is_err());
    fs::remove_file(&toml).unwrap();
    fs::write(&xml, triangle(0.05)).unwrap();
    let (exit, _, err) = call(&[&xml, "--out", &toml]);
    assert!(exit == Exit::Refused && err.contains("remains open by"), "{err}");
    assert!(written().contains("name = \"loop\""));
    // As the message says.
    let given = err.split("--tolerance ").nth(1).unwrap().split('`').next().unwrap();
    let (exit, _, err) = call(&[&xml, "--out", &toml, "--tolerance", given]);
    assert_eq!(exit, Exit::Done, "{given}: {err}");
}

/// An include reads regular files of the model's folder, and shows no text of one that is no XML.
#[test]
fn includes_stay_in_the_folder_and_show_no_other_text() {
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("model");
    fs::create_dir(&folder).unwrap();
    fs::write(outer.path().join("secret"), "secret line\n").unwrap();
    fs::write(folder.join("key"), "secret line\n").unwrap();
    fs::write(folder.join("half"), "<mujoco><secret></mujoco>\n").unwrap();
    fs::create_dir(folder.join("sub")).unwrap();
    let outside = outer.path().join("secret").display().to_string();
    let named = |file: &str| {
        let text = with("", "", &format!("<include file='{file}'/>"));
        match import_text(&text, "test.xml", &folder, &Options::default()) {
            Err(ImportError::Refused(refusal)) => {
                let shown = format!("{} {}", refusal.message, refusal.help);
                assert!(!shown.contains("secret line") && !shown.contains("<secret>"), "{shown}");
                // What is shown beside the message is the text that includes.
                assert_eq!(refusal.line, 10);
                shown
            }
            other => panic!("{file}: {other:?}"),
        }
    };
    assert!(named("../secret").contains("outside"));
    assert!(named(&outside).contains("outside"));
    assert!(named("/dev/zero").contains("outside"));
    assert!(named("sub").contains("regular"));
    assert!(named("key").contains("line 1"));
    assert!(named("half").contains("line 1"));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(&outside, folder.join("link")).unwrap();
        assert!(named("link").contains("outside"));
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let mut console = Console::plain(&mut out, &mut err);
        assert_eq!(main_with(["host-sim", "check", "/dev/zero"], &mut console), Exit::Refused);
        assert!(String::from_utf8(err).unwrap().contains("regular"));
        let (exit, _, err) = call(&["/dev/zero"]);
        assert!(exit == Exit::Refused && err.contains("regular"), "{err}");
    }
}

#[test]
fn attributes_of_an_element_are_limited() {
    let many: String = (0..2000).map(|number| format!(" a{number}=''")).collect();
    let (line, _, message, _) = refusal(&format!("<mujoco{many}/>"));
    assert_eq!((line, message.as_str()), (1, "the element has more than 1000 attributes"));
}
