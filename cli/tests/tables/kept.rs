//! Rows and columns that nobody computes: none is lost, none is changed.

use proptest::prelude::*;

use crate::support::{Folder, run_in};
use crate::{column, done, words};

const SHAFT: &str = "chain Shaft {
    body shaft on ground { motion: Rz(-q); motion_error: Rz(-index); }
    observe mark: direction(0, 1, 0) of shaft;
}
";
const APPLY: &str = "apply shaft.chain --errors e.toml --data in.csv --out";

fn shaft(name: &str, table: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("shaft.chain", SHAFT).write("e.toml", "index = 1e-5\n").write("in.csv", table);
    folder
}

#[test]
fn labels_leave_as_they_came() {
    let labels = [
        "007",
        "+5",
        "1e5",
        "0x1F",
        "1763758800123456789",
        "12345678901234567890.5",
        "NaN",
        "# no comment",
        "a, b",
        "\"\"quoted\"\"",
        "  spaces  ",
        "-0",
        "1.50",
        "TRUE",
        "2026-11-21",
        "",
    ];
    let rows: String = labels.iter().map(|label| format!("\"{label}\",0.5\n")).collect();
    let folder = shaft("labels", &format!("label,q\n{rows}"));
    done(&words(&folder, &format!("{APPLY} out.csv")));
    let expected = labels.map(|label| label.replace("\"\"", "\""));
    assert_eq!(column(&folder.read("out.csv"), "label"), expected);
    #[cfg(feature = "parquet")]
    {
        for (command, data, out) in [
            (APPLY, "in.csv", "1.parquet"),
            (APPLY, "1.parquet", "2.parquet"),
            (APPLY, "2.parquet", "back.csv"),
        ] {
            done(&words(&folder, &format!("{} {out}", command.replace("in.csv", data))));
        }
        assert_eq!(folder.read("back.csv"), folder.read("out.csv"));
    }
}

#[cfg(feature = "parquet")]
#[test]
fn types_of_a_parquet_file_stay() {
    let folder = shaft("types", "stamp,serial,q\n1763758800123456789,007,0.5\n-5,008,0.25\n");
    done(&words(&folder, &format!("{APPLY} 1.parquet")));
    done(&words(&folder, &format!("{} 2.parquet", APPLY.replace("in.csv", "1.parquet"))));
    done(&words(&folder, &format!("{} out.csv", APPLY.replace("in.csv", "2.parquet"))));
    let out = folder.read("out.csv");
    assert_eq!(column(&out, "stamp"), ["1763758800123456789", "-5"]);
    assert_eq!(column(&out, "serial"), ["007", "008"]);
}

#[test]
fn a_stray_quote_swallows_nothing() {
    for (name, table) in [
        ("quote-a", "note,q\nx,0.1\n\"stray,0.2\ny,0.3\n"),
        ("quote-b", "note,q\nx,0.1\n\"stray,0.2\ny,0.3\nz\",0.4\n"),
        ("quote-c", "q,note\n0.1,\"stray\n0.2,y\n0.3,z\"\n"),
        ("quote-d", "q,note\n0.1,\"a\"b\n"),
        ("quote-e", "\"q,note\n0.1,a\n0.2,b\n"),
    ] {
        let folder = shaft(name, table);
        let run = words(&folder, &format!("{APPLY} out.csv"));
        assert_eq!(run.code, 2, "{name}: {run}");
        assert!(run.stderr.contains("quote") && run.stderr.contains("line"), "{name}: {run}");
        assert!(!folder.names().contains(&"out.csv".to_owned()), "{name}");
    }
}

#[test]
fn rows_that_begin_like_a_comment_are_rows() {
    let folder = shaft("comments", "# made by hand\nname,q\n#1,0.1\n\"# 2\",0.2\n3,0.3\n");
    done(&words(&folder, &format!("{APPLY} out.csv")));
    assert_eq!(column(&folder.read("out.csv"), "name"), ["#1", "# 2", "3"]);
    // Our own output, read again.
    done(&words(&folder, &format!("{} again.csv", APPLY.replace("in.csv", "out.csv"))));
    assert_eq!(folder.read("again.csv"), folder.read("out.csv"));
    // Where it is said, they are comments; where it is not, a remark is asked about.
    done(&words(&folder, &format!("{APPLY} out.csv --comment #")));
    assert_eq!(column(&folder.read("out.csv"), "name"), ["# 2", "3"]);
    folder.write("in.csv", "name,q\n1,0.1\n# the motor stalled\n2,0.2\n");
    let run = words(&folder, &format!("{APPLY} out.csv"));
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("line 3") && run.stderr.contains("--comment"), "{run}");
}

#[test]
fn a_decimal_comma_is_read_again() {
    let folder = shaft("comma", "q [deg];note\n10,5;a\n-3,25;b,c\n");
    done(&words(&folder, &format!("{APPLY} out.csv")));
    done(&words(&folder, &format!("{} again.csv", APPLY.replace("in.csv", "out.csv"))));
    assert_eq!(folder.read("again.csv"), folder.read("out.csv"));
    assert_eq!(column(&folder.read("out.csv"), "q [deg]"), ["10.5", "-3.25"]);
    assert_eq!(column(&folder.read("out.csv"), "note"), ["a", "b,c"]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn as_many_rows_leave_as_came(
        labels in proptest::collection::vec("[a-z0-9 ,;|\t'#%.é-]{0,5}|\"[a-z0-9 ;#\r\n]{0,6}\"", 1..20),
    ) {
        // Quoted or not, with anything but a separator outside quotes.
        let cell = |label: &String| if label.starts_with('"') { label.clone() } else { label.replace([',', '"'], "_") };
        let rows: String = labels.iter().map(|label| format!("{},0.5\n", cell(label))).collect();
        let folder = shaft("as-many", "");
        let arguments = ["apply", "shaft.chain", "--errors", "e.toml", "--data", "-", "--out", "-"];
        let once = run_in(&folder.0, &arguments, &format!("label,q\n{rows}"));
        prop_assert_eq!(once.code, 0, "{}", once);
        let twice = run_in(&folder.0, &arguments, &once.stdout);
        prop_assert_eq!(&twice.stdout, &once.stdout);
        // One row a label: each ends with the three components of the same direction.
        let tail = once.stdout.lines().last().and_then(|line| line.split_once(",0.5,")).map(|(_, tail)| tail);
        let tail = format!(",0.5,{}", tail.unwrap_or_default());
        prop_assert_eq!(once.stdout.matches(&tail).count(), labels.len(), "{}", once);
    }
}
