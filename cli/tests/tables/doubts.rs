//! Numbers whose unit nothing says, or says in words that are no unit.

use crate::support::Folder;
use crate::{done, words};

const GANTRY: &str = "chain Gantry {
    const arm: length = 0.25;
    input range: length;
    input temperature;
    body carriage on ground { motion: Tx(u); motion_error: Tx(du + k*temperature); }
    body head on carriage { position: Tz(arm); motion: Rz(q); motion_error: Rz(dq); }
    observe tip: point(0, 0.1, range) of head;
}
";
const STUDY: &str = "chain = \"gantry.chain\"\ndata = \"data.csv\"\n[observed]\nkind = \"point\"\n[hold_out]\nfolds = 3\n\
    [search]\neffects = [\"encoder\"]\n[fit]\nestimate = [\"dq\", \"du\"]\n";

fn gantry(name: &str, header: &str, rows: &[&str]) -> Folder {
    let folder = Folder::new(name);
    folder.write("gantry.chain", GANTRY).write("e.toml", "dq = 1e-5\n").write("study.toml", STUDY);
    let row = |row: &&str| format!("{row},1,20,0.1,0.2,0.3\n");
    let rows: String = rows.iter().map(row).collect();
    folder.write("data.csv", format!("{header},range,temperature,tip_x,tip_y,tip_z\n{rows}"));
    folder
}

const COMMANDS: [&str; 3] = [
    "eval gantry.chain --errors e.toml --data data.csv --out out.csv",
    "apply gantry.chain --errors e.toml --data data.csv --out out.csv",
    "calibrate study.toml --out out",
];

#[test]
fn a_unit_that_is_none_is_refused_by_every_command() {
    for (at, header) in
        ["q [degz],u", "q [furlong],u", "q [],u", "q,u [furlong]", "q,u [MM]"].into_iter().enumerate()
    {
        let folder = gantry(&format!("no-unit-{at}"), header, &["1,0.1", "0.5,0.2"]);
        for command in COMMANDS {
            let run = words(&folder, command);
            assert_eq!(run.code, 2, "{header}, {command}: {run}");
            let units = if header.contains("u [") { "m, km" } else { "rad, mrad" };
            assert!(
                run.stderr.contains("is no unit") && run.stderr.contains(units),
                "{header}, {command}: {run}"
            );
            assert_eq!(folder.names().len(), 4, "nothing was written");
        }
    }
    // What a plain number is measured in is the user's business.
    let folder = gantry("kelvin", "q,u", &["1,0.1", "0.5,0.2"]);
    folder.write("data.csv", folder.read("data.csv").replace("temperature", "temperature [K]"));
    done(&words(&folder, COMMANDS[0]));
}

#[test]
fn bare_degrees_and_millimetres_are_cautioned_by_every_command() {
    let rows = ["44,0.1", "270,-0.2", "-30,0.3", "12,0.1", "100,0.2", "200,0.3"];
    let degrees = gantry("bare-degrees", "q,u", &rows);
    let millimetres = gantry(
        "bare-mm",
        "q,u",
        &rows.map(|row| match row.split_once(',') {
            Some(("270", _)) => "0.5,-310",
            _ => "1.5,120",
        }),
    );
    for (folder, caution) in [
        (&degrees, "column `q` reaches 270 and has no unit; it is taken as rad: if it is in deg"),
        (&millimetres, "column `u` reaches -310 and has no unit; it is taken as m: if it is in mm"),
    ] {
        for command in COMMANDS {
            let run = words(folder, command);
            assert!(run.stderr.contains(caution), "{command}: {run}");
            assert_eq!(run.stderr.matches("has no unit").count(), 1, "{command}: {run}");
        }
        let plain = folder.read("data.csv").replace("q,u", "q [rad],u [m]");
        folder.write("data.csv", plain);
        assert!(!done(&words(folder, COMMANDS[1])).contains("has no unit"));
    }
}

#[test]
fn bare_numbers_on_the_command_line_are_cautioned_where_they_are_hardly_si() {
    let folder = gantry("bare-arguments", "q,u", &["1,0.1"]);
    let simulate = |more: &[&str]| {
        let start =
            ["simulate", "gantry.chain", "--errors", "e.toml", "--poses", "3", "--seed", "1", "--out", "-"];
        let ranges = ["--range", "range=1..2 m", "--range", "temperature=0..30"];
        folder.trueaxis(&[&start[..], &ranges, more].concat())
    };
    let slide = ["--range", "u=0..1 m"];
    let noise = simulate(&[&slide[..], &["--noise", "2"]].concat());
    assert!(
        done(&noise).contains("--noise 2 has no unit and is taken as 2 m; did you mean --noise \"2 mm\"?"),
        "{noise}"
    );
    let range = simulate(&[&slide[..], &["--noise", "0.1 mm", "--range", "q=-30..60"]].concat());
    assert!(done(&range).contains("did you mean \"q=-30..60 deg\"?"), "{range}");
    let far = simulate(&["--noise", "0.1 mm", "--range", "u=0..900"]);
    assert!(done(&far).contains("did you mean \"u=0..900 mm\"?"), "{far}");
    assert_eq!(done(&simulate(&[&slide[..], &["--noise", "1e-5", "--range", "q=-3..3"]].concat())), "");
    folder.write("e.toml", "du = 1\ndq = 5\nk = 1e-3\n");
    let errors = done(&words(&folder, COMMANDS[0])).to_owned();
    assert!(
        errors.contains("did you mean du = \"1 mm\"?") && errors.contains("dq = \"5 arcsec\"?"),
        "{errors}"
    );
    assert_eq!(errors.matches("has no unit").count(), 2, "a small number is one of SI: {errors}");
}

#[test]
fn two_columns_for_one_joint_are_refused() {
    for (name, header) in [("two-a", "q,q [deg]"), ("two-b", "q [deg],q_deg"), ("two-c", "q (deg),q [rad]")] {
        let folder = gantry(name, &format!("{header},u"), &["1,1,0.1", "0.5,0.5,0.2"]);
        for command in COMMANDS {
            let run = words(&folder, command);
            assert_eq!(run.code, 2, "{command}: {run}");
            assert!(run.stderr.contains("are columns for `q`"), "{command}: {run}");
        }
    }
    // A study that names the one in full settles it.
    let folder = gantry("two-settled", "q,q [deg],u", &["1,57,0.1", "0.5,28,0.2", "0.1,6,0.4", "0.2,11,0.2"]);
    folder.write("study.toml", format!("{STUDY}[columns]\nq = \"q [deg]\"\n"));
    let run = words(&folder, COMMANDS[2]);
    assert!(!run.stderr.contains("columns for"), "{run}");
}

#[test]
fn a_joint_named_like_a_unit_asks_for_its_unit() {
    let folder = gantry("asks", "q_deg,u", &["10,0.1", "20,0.2"]);
    folder.write("gantry.chain", GANTRY.replace("(q)", "(q_deg)"));
    for command in COMMANDS {
        let run = words(&folder, command);
        assert_eq!(run.code, 2, "{command}: {run}");
        assert!(run.stderr.contains("`q_deg [deg]` or `q_deg [rad]`"), "{command}: {run}");
    }
}
