//! Every kind of claim besides a whole vector: one that holds, one that does not, one that is mistyped. What is claimed was
//! worked out by hand.

use super::support::{Folder, Run};

/// A pointer in a plane: e and f are one and the same, n does nothing.
const CHAIN: &str = "chain Pointer {
    body arm on ground { motion: Rz(q); motion_error: Rz(e), Rz(f), Ry(g), Rx(n); }
    observe tip: direction(1, 0, 0) of arm;
}";

fn check(name: &str, chain: &str, claim: &str) -> Run {
    let folder = Folder::new(&format!("check_kinds_{name}"));
    let claims = format!("chain = \"pointer.chain\"\n[[claim]]\nname = \"it\"\n{claim}\n");
    folder.write("pointer.chain", chain).write("claims.toml", claims);
    folder.trueaxis(&["check", "claims.toml"])
}

struct Kind {
    name: &'static str,
    holds: &'static [&'static str],
    fails: &'static [&'static str],
    /// With what is said of it.
    mistyped: &'static [(&'static str, &'static str)],
}

const KINDS: [Kind; 9] = [
    Kind {
        name: "total",
        holds: &[r"total = '\sqrt{(e + f)^2 + g^2}'", "keep = [\"g\"]\ntotal = '\\sqrt{g^2}'"],
        fails: &[r"total = '\sqrt{e^2 + f^2 + g^2}'"],
        mistyped: &[(r"total = '\sqrt{e^2 + h^2}'", "h"), (r"total = '\sqrt{e^2'", "{")],
    },
    Kind {
        name: "size",
        holds: &[
            r#"size = { errors = { e = "10 arcsec" }, measure = "sup", at_most = "10.001 arcsec", at_least = "9.999 arcsec" }
               range = ["q=0..360 deg"]"#,
            r#"size = { errors = { e = "3 arcsec", g = "4 arcsec" }, measure = "rms", combine = "rss", at_most = "5.001 arcsec", at_least = "4.999 arcsec" }
               path = "q=t""#,
            r#"size = { errors = { e = "3 arcsec", g = "4 arcsec" }, measure = "sup", combine = "sum", at_least = "6.999 arcsec" }
               path = "q=t""#,
            r#"size = { errors = { n = "1 deg" }, measure = "percentile 95", at_most = "1e-9 arcsec" }
               range = ["q=0..360 deg"]"#,
        ],
        fails: &[
            r#"size = { errors = { e = "10 arcsec" }, measure = "sup", at_most = "9.9 arcsec" }
               range = ["q=0..360 deg"]"#,
            r#"size = { errors = { e = "3 arcsec", g = "4 arcsec" }, measure = "rms", combine = "rss", at_most = "4.9 arcsec" }
               path = "q=t""#,
        ],
        mistyped: &[
            (
                r#"size = { errors = { e = "10 arcsec" }, measure = "supp", at_most = "9 arcsec" }
                   path = "q=t""#,
                "unknown measure `supp`",
            ),
            (
                r#"size = { errors = { e = "10 arcsec" }, measure = "sup" }
                   path = "q=t""#,
                "says no size",
            ),
            (
                r#"size = { errors = { ee = "10 arcsec" }, measure = "sup", at_most = "9 arcsec" }
                   path = "q=t""#,
                "ee",
            ),
        ],
    },
    Kind {
        name: "bound",
        holds: &[r#"bound = { errors = { "*" = "1 arcmin" }, at_most = 1e-6 }"#],
        fails: &[r#"bound = { errors = { "*" = "1 arcmin" }, at_most = 1e-9 }"#],
        mistyped: &[(r#"bound = { errors = { "*" = "1 arcmn" }, at_most = 1e-6 }"#, "arcmn")],
    },
    Kind {
        name: "rank",
        holds: &[r#"rank = { errors = "*", equals = 2 }"#, r#"rank = { errors = ["e", "f"], equals = 1 }"#],
        fails: &[r#"rank = { errors = "*", equals = 3 }"#],
        mistyped: &[(r#"rank = { errors = "h*", equals = 3 }"#, "`h*`")],
    },
    Kind {
        name: "confounded",
        holds: &[r#"confounded = ["e", "f"]"#, r#"confounded = ["n"]"#],
        fails: &[r#"confounded = ["e", "g"]"#],
        mistyped: &[(r#"confounded = ["e", "gg"]"#, "`gg`")],
    },
    Kind {
        name: "separable",
        holds: &[r#"separable = ["g"]"#, "keep = [\"e\", \"g\"]\nseparable = [\"e\"]"],
        fails: &[r#"separable = ["e"]"#, r#"separable = ["n"]"#],
        mistyped: &[(r#"separable = [""]"#, "``")],
    },
    Kind {
        name: "exact",
        holds: &[
            "keep = [\"e\"]\norder = \"exact\"\ncomponents = ['cos(q + e) - cos(q)', 'sin(q + e) - sin(q)', '0']",
            "keep = [\"g\"]\norder = \"exact\"\ncomponents = ['(cos(g) - 1)*cos(q)', '(cos(g) - 1)*sin(q)', '-sin(g)']",
        ],
        fails: &[
            "keep = [\"e\"]\norder = \"exact\"\ncomponents = ['cos(q - e) - cos(q)', 'sin(q + e) - sin(q)', '0']",
        ],
        mistyped: &[("keep = [\"e\"]\norder = \"exat\"\ncomponents = ['0', '0', '0']", "exact")],
    },
    Kind {
        name: "component",
        holds: &["component = \"z\"\ncomponents = '-g'", "component = \"x\"\ncomponents = '-(e + f)*sin(q)'"],
        fails: &["component = \"z\"\ncomponents = 'g'"],
        mistyped: &[
            ("component = \"w\"\ncomponents = '-g'", "`w`"),
            ("component = \"z\"\ncomponents = ['0', '0', '-g']", "component"),
        ],
    },
    Kind {
        name: "faces",
        holds: &[
            "faces = { second = { q = \"q + pi\" }, take = \"mean\" }\ncomponents = ['0', '0', '-g']",
            "faces = { second = { q = \"q + pi\" }, take = \"difference\" }\ncomponents = ['-2*(e + f)*sin(q)', '2*(e + f)*cos(q)', '0']",
        ],
        fails: &[
            "faces = { second = { q = \"q + pi\" }, take = \"half difference\" }\ncomponents = ['-(e + f)*sin(q)', '(e + f)*cos(q)', '-g']",
        ],
        mistyped: &[
            ("faces = { second = { q = \"q + pi\" }, take = \"men\" }\ncomponents = ['0', '0', '-g']", "men"),
            (
                "faces = { second = { p = \"q + pi\" }, take = \"mean\" }\ncomponents = ['0', '0', '-g']",
                "`p`",
            ),
        ],
    },
];

fn seen(claim: &str) -> String {
    format!("observable = \"tip\"\n{claim}")
}

#[test]
fn what_holds_holds_what_does_not_differs_and_what_is_mistyped_is_named() {
    for Kind { name, holds, fails, mistyped } in KINDS {
        for (index, claim) in holds.iter().enumerate() {
            let run = check(&format!("{name}_holds_{index}"), CHAIN, &seen(claim));
            assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{claim}: {}", run.stdout);
            assert!(run.stdout.ends_with("1 of 1 claims hold\n"), "{claim}: {}", run.stdout);
        }
        for (index, claim) in fails.iter().enumerate() {
            let run = check(&format!("{name}_fails_{index}"), CHAIN, &seen(claim));
            assert_eq!((run.code, run.stderr.as_str()), (1, ""), "{claim}: {}", run.stdout);
            assert!(run.stdout.starts_with("differs"), "{claim}: {}", run.stdout);
        }
        for (index, (claim, said)) in mistyped.iter().enumerate() {
            let run = check(&format!("{name}_mistyped_{index}"), CHAIN, &seen(claim));
            assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{claim}: {}", run.stdout);
            assert!(
                run.stderr.contains("claims.toml:") && run.stderr.contains(said),
                "{claim}: {}",
                run.stderr
            );
        }
    }
}

/// Constants without a value are symbols in formulas; claims about numbers name them.
#[test]
fn constants_without_a_value_stand_in_formulas_and_in_no_number() {
    let chain = CHAIN.replace("body arm", "const reach: length; body arm").replace(
        "observe tip: direction(1, 0, 0)",
        "observe end: point(reach, 0, 0) of arm; observe tip: direction(1, 0, 0)",
    );
    let on_end = |claim: &str| format!("observable = \"end\"\n{claim}");
    let right = "components = ['-reach*(e + f)*sin(q)', 'reach*(e + f)*cos(q)', '-reach*g']";
    for (name, claim, code) in [
        ("unvalued_holds", right, 0),
        ("unvalued_differs", &right.replace("'-reach*g'", "'-g'"), 1),
        ("unvalued_rank", r#"rank = { errors = "*", equals = 2 }"#, 0),
        ("unvalued_total", r"total = '\sqrt{\mathrm{reach}^2 ((e + f)^2 + g^2)}'", 0),
    ] {
        let run = check(name, &chain, &on_end(claim));
        assert_eq!((run.code, run.stderr.as_str()), (code, ""), "{claim}: {}", run.stdout);
    }
    for claim in [
        "size = { errors = { e = 1e-5 }, measure = \"sup\", at_most = 1e-4 }\npath = \"q=t\"",
        "bound = { errors = { e = 1e-5 }, at_most = 1e-4 }",
        "compare = { error = \"e\", against = \"g\", size = 1e-5, measure = \"sup\", at_most = 2 }\npath = \"q=t\"",
    ] {
        let run = check("unvalued_numbers", &chain, &on_end(claim));
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{claim}");
        assert!(run.stderr.contains("the constant `reach` has no value"), "{claim}: {}", run.stderr);
    }
}

/// Formulas pasted from papers, with azimuth and altitude as symbols, and angles at the pole left out of them.
#[test]
fn a_papers_azimuth_is_read_in_its_own_symbols() {
    let chain = "chain Mount {
        body base on ground { position_error: Rx(tx), Ry(ty); motion: Rz(az); motion_error: Rz(ia); }
        body tube on base { position_error: Rx(npae); motion: Ry(-el); motion_error: Ry(-ie), Rz(ca); }
        observe sky: azimuth, elevation of direction(1, 0, 0) of tube;
    }";
    let claim = r"observable = 'sky'
components = '''
\begin{aligned}
\Delta A &= A_0 + C_A \sec E - N \tan E - (T_x \cos A + T_y \sin A) \tan E, \\[2pt]
\Delta E &= E_0 + T_x \sin A - T_y \cos A.
\end{aligned}'''
[symbols]
'A_0' = 'ia'
'E_0' = 'ie'
'C_A' = 'ca'
'N' = 'npae'
'T_x' = 'tx'
'T_y' = 'ty'
'A' = 'az'
'E' = 'el'";
    let run = check("azimuth", chain, claim);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    let run = check("azimuth_cosine", chain, &claim.replace(r"- (T_x \cos A", r"+ (T_x \cos A"));
    assert_eq!(run.code, 1, "{}", run.stderr);
}

/// Two joints and an error of each; the rotation vector of Rx(e) Rz(q) Ry(f) is worked out by hand.
const TURNED: &str = "chain Turned {
    body arm on ground { position_error: Rx(e); motion: Rz(q); motion_error: Ry(f); }
    observe turned: orientation of arm;
}";

#[test]
fn a_printed_matrix_of_a_small_rotation_is_compared_entry_by_entry() {
    // ω = (e − f sin q, f cos q, 0).
    let matrix = |entries: [&str; 9]| {
        let [xx, xy, xz, yx, yy, yz, zx, zy, zz] = entries;
        format!(
            r"components = '\begin{{pmatrix}} {xx} & {xy} & {xz} \\ {yx} & {yy} & {yz} \\ {zx} & {zy} & {zz} \end{{pmatrix}}'"
        )
    };
    let right = ["1", "0", r"f\cos q", "0", "1", r"-e + f\sin q", r"-f\cos q", r"e - f\sin q", "1"];
    let run = check("matrix", TURNED, &matrix(right));
    assert_eq!(run.code, 0, "{run}");
    let mut added = right;
    (added[0], added[4], added[8]) = ("0", "0", "0");
    let run = check("matrix_added", TURNED, &matrix(added));
    assert_eq!(run.code, 0, "{run}");
    for (place, entries) in
        [(5, "23, 31, 12"), (1, "23, 31, 12"), (7, "32, 13, 21"), (3, "32, 13, 21"), (4, "entry 22")]
    {
        let mut wrong = right;
        wrong[place] = r"2 e + f\sin q";
        let run = check(&format!("matrix_{place}"), TURNED, &matrix(wrong));
        assert_eq!(run.code, 1, "{run}");
        let differs: Vec<&str> = run.stdout.lines().filter(|line| line.starts_with("differs")).collect();
        assert!(matches!(differs.as_slice(), [one] if one.contains(entries)), "{place}: {run}");
    }
    let run = check("matrix_order", TURNED, &format!("order = 2\n{}", matrix(right)));
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("to first order"), "{run}");
    let mut unread = right;
    unread[2] = r"h\cos q";
    let run = check("matrix_unread", TURNED, &matrix(unread));
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("unknown symbol `h`"), "{run}");
}
