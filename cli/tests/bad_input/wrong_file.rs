//! The right command with the wrong one of the files that belong together.

use crate::{mount, refused};

#[test]
fn a_declaration_where_a_study_claims_or_errors_are_needed() {
    let folder = mount("declaration-for-a-study");
    for asked in [
        &["calibrate", "mount.chain"][..],
        &["check", "mount.chain"],
        &["bound", "mount.chain", "--sizes", "mount.chain"],
    ] {
        let run = folder.trueaxis(asked);
        let told = refused(&run);
        assert!(told.contains("`mount.chain` is a declaration; needed here is a file in TOML"), "{run}");
        assert!(told.contains("chain = \"mount.chain\""), "{run}");
        assert_eq!(told.lines().count(), 1, "{run}");
    }
}

#[test]
fn a_table_where_a_text_is_needed() {
    let folder = mount("table-for-a-text");
    folder.write("sky.csv", "azimuth [deg];elevation [deg]\n10,5;20\n11,5;30\n");
    for asked in [
        &["calibrate", "sky.csv"][..],
        &["check", "sky.csv"],
        &["derive", "sky.csv"],
        &["bound", "mount.chain", "--sizes", "sky.csv"],
    ] {
        let run = folder.trueaxis(asked);
        let told = refused(&run);
        assert!(told.contains("`sky.csv` is a table of data: begin with `trueaxis init sky.csv`"), "{run}");
        assert_eq!(told.lines().count(), 1, "{run}");
    }
}

#[test]
fn a_study_where_a_declaration_is_needed() {
    let folder = mount("study-for-a-declaration");
    folder.write("study.toml", "chain = \"mount.chain\"\ndata = \"poses.csv\"\n");
    for asked in [
        &["derive", "study.toml"][..],
        &["eval", "study.toml", "--errors", "e.toml", "--data", "poses.csv", "--out", "out.csv"],
    ] {
        let run = folder.trueaxis(asked);
        let told = refused(&run);
        assert!(told.contains("`study.toml` is no declaration, but names one: give `mount.chain`"), "{run}");
    }
}

#[test]
fn a_study_where_errors_or_a_table_are_needed() {
    let folder = mount("study-for-errors");
    folder.write("study.toml", "chain = \"mount.chain\"\ndata = \"poses.csv\"\n");
    for asked in [&["bound", "mount.chain", "--sizes", "study.toml"][..], &["check", "study.toml"]] {
        let run = folder.trueaxis(asked);
        assert!(refused(&run).contains("`study.toml` is a study: give it to `trueaxis calibrate`"), "{run}");
    }
    for file in ["study.toml", "mount.chain"] {
        let run = folder.trueaxis(&["init", file]);
        assert!(refused(&run).contains(&format!("`{file}` is no table: give the table")), "{run}");
    }
}

/// A mistake in either is still shown where it stands.
#[test]
fn a_mistake_in_the_right_file_has_its_place() {
    let folder = mount("mistake-in-the-right-file");
    folder.write("study.toml", "chain = \"mount.chain\"\ndate = \"poses.csv\"\n");
    assert!(refused(&folder.trueaxis(&["calibrate", "study.toml"])).contains("study.toml:2:1"));
    folder.write("wrong.chain", crate::MOUNT.replace("Rx(index)", "Rx(index"));
    assert!(refused(&folder.trueaxis(&["derive", "wrong.chain"])).contains("wrong.chain:"));
}

/// Sixty bodies have no closed form that anybody would read; what needs none is said.
#[test]
fn a_chain_too_long_for_a_closed_form() {
    let folder = mount("long");
    let mut text = String::from("chain Long {\n");
    for body in 0..60 {
        let below = if body == 0 { "ground".to_owned() } else { format!("b{}", body - 1) };
        let [turns, off] = [0, 1].map(|more| ["x", "y", "z"][(body + more) % 3]);
        text.push_str(&format!(
            "body b{body} on {below} {{ position: Tz(0.1); motion: R{turns}(q{body}); motion_error: R{off}(e{body}); }}\n"
        ));
    }
    folder.write("long.chain", text + "observe tip: point(0, 0, 0) of b59;\n}\n");
    let run = folder.trueaxis(&["derive", "long.chain"]);
    assert!(refused(&run).contains("too long for a closed form, which `bound`, `eval`"), "{run}");
}

/// What is compressed is named by how, whatever it is called, and says what to do.
#[test]
fn a_file_that_is_no_text_is_named_as_what_it_is() {
    let folder = mount("compressed");
    folder.write(
        "study.toml",
        "chain = \"mount.chain\"\ndata = \"poses.csv\"\n[observed]\nkind = \"direction\"\n",
    );
    let eval = ["eval", "mount.chain", "--errors", "e.toml", "--data", "poses.csv", "--out", "out.csv"];
    for (bytes, words) in [
        (&b"\x1F\x8B\x08\0\0"[..], "poses.csv: this is compressed with gzip: unpack it first, with `gunzip`"),
        (b"\x28\xB5\x2F\xFD\0", "this is compressed with zstd"),
        (b"PK\x03\x04\x14", "this is a ZIP archive, or a spreadsheet"),
        (b"PAR1\x15\x04", "this is a Parquet file: give it as a file whose name ends in .parquet"),
    ] {
        folder.write("poses.csv", bytes);
        for asked in [&eval[..], &["calibrate", "study.toml"], &["init", "poses.csv", "--out", "new.toml"]] {
            let run = folder.trueaxis(asked);
            assert!(refused(&run).contains(words), "{run}");
        }
    }
    folder.write("poses.csv", "azimuth [deg],elevation [deg]\n10,20\n");
    let out = ["eval", "mount.chain", "--errors", "e.toml", "--data", "poses.csv", "--out", "out.csv.gz"];
    let told = refused(&folder.trueaxis(&out)).to_owned();
    assert!(
        told.contains("`out.csv.gz`: tables are read and written as .csv or .parquet, and not compressed"),
        "{told}"
    );
}

#[test]
fn a_text_where_a_table_is_needed_and_json_where_a_declaration_is() {
    let folder = mount("text-for-a-table");
    folder.write("study.toml", "chain = \"mount.chain\"\ndata = \"poses.csv\"\n");
    folder.write("report.json", "{ \"verdict\": \"explained\" }\n");
    for file in ["study.toml", "mount.chain"] {
        let asked = ["eval", "mount.chain", "--errors", "e.toml", "--data", file, "--out", "out.csv"];
        let run = folder.trueaxis(&asked);
        assert!(
            refused(&run).contains(&format!("`{file}`: this is a text of trueaxis, and a table")),
            "{run}"
        );
    }
    let run = folder.trueaxis(&["derive", "report.json"]);
    assert!(
        refused(&run).contains("give `instrument.toml`, which `calibrate` writes beside its report"),
        "{run}"
    );
}

#[test]
fn an_empty_study_and_a_table_that_is_not_there_say_how_to_begin() {
    let folder = mount("empty-study");
    folder.write("empty.toml", "# to be written\n");
    let run = folder.trueaxis(&["calibrate", "empty.toml"]);
    assert!(refused(&run).contains("`empty.toml` is empty: `trueaxis init TABLE.csv` writes"), "{run}");
    let run = folder.trueaxis(&["init", "nowhere.csv"]);
    assert_eq!(refused(&run).matches("nowhere.csv").count(), 1, "{run}");
    folder.write("my sky.csv", "azimuth [deg];elevation [deg]\n10,5;20\n11,5;30\n");
    let run = folder.trueaxis(&["calibrate", "my sky.csv"]);
    assert!(refused(&run).contains("`trueaxis init 'my sky.csv'`"), "{run}");
}

/// What was typed for a number is answered with a number to write.
#[test]
fn numbers_that_are_none() {
    let folder = mount("numbers");
    let simulate = ["simulate", "mount.chain", "--errors", "e.toml", "--noise", "1 arcsec", "--out", "o.csv"];
    for (own, words) in [
        (["--poses", "ten", "--seed", "1"], "write a whole number from 1 on, such as 100"),
        (["--poses", "-3", "--seed", "1"], "write a whole number from 1 on, such as 100"),
        (["--poses", "10", "--seed", "-1"], "a seed is a whole number from 0 to 18446744073709551615"),
    ] {
        let run = folder.trueaxis(&[&simulate[..], &own[..]].concat());
        assert!(refused(&run).contains(words), "{run}");
    }
    let run = folder.trueaxis(&["derive", "mount.chain", "--order", "7"]);
    assert!(refused(&run).contains("write a whole number from 1 to 3"), "{run}");
}
