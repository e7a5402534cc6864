//! `--certificate` as users run it: what is written, and what is refused. That Coq accepts what is written is tested in
//! `model-core/tests/certificate` and by `.ci/certificates`.

#[path = "../support/mod.rs"]
mod support;

use support::{Folder, Run};

fn folder(name: &str) -> Folder {
    let folder = Folder::new(&format!("certificate_{name}"));
    folder.copy("examples/mobile-lidar/mobile-lidar.chain").copy("examples/mobile-lidar/paper.toml");
    folder
}

fn refused(run: &Run, why: &str) {
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{}", run.stderr);
    assert!(run.stderr.contains(why), "{}", run.stderr);
}

#[test]
fn the_papers_equations_are_written_with_their_verdicts_and_the_library_beside_them() {
    let folder = folder("paper");
    let run = folder.trueaxis(&["check", "paper.toml", "--certificate", "paper.v"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert_eq!(folder.names(), ["TrueAxis.v", "mobile-lidar.chain", "paper.toml", "paper.v"]);
    let text = folder.read("paper.v");
    assert!(
        text.contains("Module equation_6.") && text.contains("Print Assumptions equation_6.differs."),
        "{text}"
    );
    assert!(
        text.contains("Module equation_7.") && text.contains("Print Assumptions equation_7.holds."),
        "{text}"
    );
    // The other ten claims are comparisons and counts, and both the file and the command say so.
    assert_eq!(text.matches("(* Not certified: ").count(), 10, "{text}");
    assert_eq!(run.stderr.matches("not certified: ").count(), 10, "{}", run.stderr);
    assert_eq!(folder.read("TrueAxis.v"), proof::LIBRARY);
}

#[test]
fn the_library_goes_where_it_is_wanted() {
    let folder = folder("library");
    let run = folder.trueaxis(&["derive", "mobile-lidar.chain", "--certificate-library", "Lib.v"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(folder.read("Lib.v"), proof::LIBRARY);
    let arguments = ["identify", "mobile-lidar.chain", "--observable", "pointing", "--certificate", "c.v"];
    let run = folder.trueaxis(&[&arguments[..], &["--certificate-library", "Lib.v"]].concat());
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(folder.names(), ["Lib.v", "c.v", "mobile-lidar.chain", "paper.toml"]);
}

#[test]
fn nothing_is_written_where_nothing_can_be_certified() {
    let folder = folder("nothing");
    folder.write(
        "counts.toml",
        "chain = \"mobile-lidar.chain\"\n[[claim]]\nname = \"30\"\ncount = { errors = \"*\", equals = 30 }\n",
    );
    folder.write(
        "steep.chain",
        "chain C { body a on ground { motion: Rz(q); motion_error: Rx(e*cos(25*q)); } observe o: direction(0, 1, 0) of a; }",
    );
    let names = folder.names();
    refused(
        &folder.trueaxis(&["check", "counts.toml", "--certificate", "c.v"]),
        "none of the claims of this file can be certified. Nothing is written",
    );
    refused(
        &folder.trueaxis(&["derive", "steep.chain", "--certificate", "c.v"]),
        "no certificate of o: a formula contains the sine or cosine of 25 times an angle. Certificates go up to 24 times. Nothing is written",
    );
    assert_eq!(folder.names(), names);
}

/// One claim that cannot be certified does not keep the others from it.
#[test]
fn what_cannot_be_certified_is_said_beside_what_is() {
    let folder = folder("some");
    folder.write(
        "some.toml",
        concat!(
            "chain = \"mobile-lidar.chain\"\n",
            "[[claim]]\nname = \"half\"\nequal = ['tan(beta/2)', 'sin(beta)/(1 + cos(beta))']\n",
            "[[claim]]\nname = \"double\"\nequal = ['\\sin 2\\alpha', '2 \\cos\\alpha \\sin\\alpha']\n",
            "[[claim]]\nname = \"other\"\nequal = ['cos(alpha + beta)', 'cos(alpha)*cos(beta) + sin(alpha)*sin(beta)']\n",
        ),
    );
    let run = folder.trueaxis(&["check", "some.toml", "--certificate", "c.v"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(run.stderr.starts_with("not certified: half: certificates speak of"), "{}", run.stderr);
    let text = folder.read("c.v");
    for said in
        ["(* Not certified: half: ", "Print Assumptions double.holds.", "Print Assumptions other.differs."]
    {
        assert!(text.contains(said), "{said}: {text}");
    }
}

/// An orientation is no vector. Certificates speak of vectors.
#[test]
fn an_observable_that_cannot_be_certified_leaves_the_others() {
    let folder = folder("turned");
    folder.write(
        "turned.chain",
        "chain C { body a on ground { motion: Rz(q); motion_error: Rx(e); } observe o: direction(0, 1, 0) of a; \
         observe turned: orientation of a; }",
    );
    let run = folder.trueaxis(&["derive", "turned.chain", "--certificate", "c.v"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(
        run.stderr.starts_with(
            "not certified: turned: certificates speak of vectors, and not of the rotation x of an orientation"
        ),
        "{}",
        run.stderr
    );
    assert!(folder.read("c.v").ends_with("Print Assumptions o.holds.\n"), "{}", folder.read("c.v"));
    let run = folder.trueaxis(&["derive", "turned.chain", "--observable", "turned", "--certificate", "d.v"]);
    refused(&run, "no certificate of turned: certificates speak of vectors, and not of the rotation x");
}

#[test]
fn names_that_coq_does_not_read_are_refused() {
    let folder = folder("names");
    let names = folder.names();
    for name in ["my-proof.v", "proof.txt", "1.v", "-"] {
        refused(
            &folder.trueaxis(&["derive", "mobile-lidar.chain", "--certificate", name]),
            "a word of letters",
        );
    }
    refused(
        &folder.trueaxis(&["derive", "mobile-lidar.chain", "--certificate", "TrueAxis.v"]),
        "name the certificate otherwise",
    );
    assert_eq!(folder.names(), names);
}

#[test]
fn a_file_of_the_users_is_not_taken_for_the_library() {
    let folder = folder("in_the_way");
    folder.write("TrueAxis.v", "(* my own work *)\n");
    let names = folder.names();
    refused(
        &folder.trueaxis(&["derive", "mobile-lidar.chain", "--certificate", "c.v"]),
        "is in the way of the library",
    );
    assert_eq!((folder.names(), folder.read("TrueAxis.v").as_str()), (names, "(* my own work *)\n"));
}

/// Numbers at readings and matrices are certified. What is measured or counted is said with its reason.
#[test]
fn numbers_are_certified_and_what_is_no_theorem_has_a_reason() {
    let folder = folder("numbers");
    folder.write(
        "arm.chain",
        "chain Arm { const l: length = 0.8; body a on ground { motion: Rz(q); motion_error: Rz(e); position: Tx(l); } \
         observe tip: point(0, 0, 0) of a; }",
    );
    let value = |number: &str| {
        format!(
            "[[claim]]\nname = \"number {number}\"\nobservable = \"tip\"\n\
             value = {{ at = {{ q = \"90 deg\" }}, errors = {{ e = \"0.01 deg\" }}, equals = [\"{number} um\", \"0.0 um\", \"0 mm\"] }}\n"
        )
    };
    let frame = "[[claim]]\nname = \"frame\"\nbody = \"a\"\nframe = '\\begin{bmatrix} \\cos q & -\\sin q & 0 \\\\ \
                 \\sin q & \\cos q & 0 \\\\ 0 & 0 & 1 \\end{bmatrix}'\n";
    let bound = "[[claim]]\nname = \"bound\"\nobservable = \"tip\"\nbound = { errors = { e = \"1 mrad\" }, at_most = \"1 mm\" }\n";
    let claims = ["chain = \"arm.chain\"\n", &value("-139.6"), &value("-139.7"), frame, bound].concat();
    folder.write("arm.toml", &claims);
    let run = folder.trueaxis(&["check", "arm.toml", "--certificate", "c.v"]);
    assert_eq!(run.code, 1, "{}", run.stderr);
    assert!(run.stderr.contains("not certified: bound: the bound comes from interval"), "{}", run.stderr);
    let text = folder.read("c.v");
    for said in [
        "Definition q : R := 1 / 2 * PI.",
        "Definition e : R := 1 / 18000 * PI.",
        "(- 349 / 2500000)",
        "Print Assumptions number_139_6.holds.",
        "Print Assumptions number_139_7.differs.",
        "Print Assumptions frame_x_axis.holds.",
        "Print Assumptions frame_z_axis.holds.",
    ] {
        assert!(text.contains(said), "{said}: {text}");
    }
    folder.write("wrong.toml", ["chain = \"arm.chain\"\n", &value("1e999999999")].concat());
    let wrong = folder.trueaxis(&["check", "wrong.toml", "--certificate", "wrong.v"]);
    assert!(wrong.code == 2 && wrong.stderr.contains("wrong.toml:"), "{}", wrong.stderr);
    let json = folder.trueaxis(&["check", "arm.toml", "--format", "json"]);
    assert!(json.stdout.contains(r#""equation": ["#), "{}", json.stdout);
}
