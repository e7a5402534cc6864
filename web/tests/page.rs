//! What the page does before and behind its module: it packs messages as the module reads them, and changes columns in a study that `init`
//! wrote.

use std::fs;
use std::path::Path;
use std::process::Command;

use web::Message;

/// What a script prints that has a file of the page beside it, as a module of this name.
fn printed(name: &str, script: &str) -> Option<String> {
    let node = testkit::tool(testkit::NODE)?;
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("page-{name}"));
    fs::create_dir_all(&folder).expect("a folder for the test");
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("page").join(format!("{name}.js"));
    fs::copy(page, folder.join("own.mjs")).expect("a file of the page");
    fs::write(folder.join("run.mjs"), script).expect("a script");
    let out = Command::new(node).arg(folder.join("run.mjs")).output().expect("node runs");
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    Some(String::from_utf8(out.stdout).expect("UTF-8"))
}

#[test]
fn the_page_packs_messages_as_the_module_reads_them() {
    let message = Message::default().with("do", "begin").with("table:ü.csv", vec![0, 10, 255]).with("", "");
    let hex: String = message.to_bytes().iter().map(|byte| format!("{byte:02x}")).collect();
    let script = r#"
        import { decoded, encoded, text } from "./own.mjs";
        const bytes = encoded([["do", "begin"], ["table:ü.csv", new Uint8Array([0, 10, 255])], ["", ""]]);
        const back = decoded(bytes);
        console.log(Buffer.from(bytes).toString("hex"), text(back, "do"), [...back.get("table:ü.csv")].join(), text(back, "none") === "");
    "#;
    let Some(printed) = printed("message", script) else { return };
    assert_eq!(printed, format!("{hex} begin 0,10,255 true\n"));
}

#[test]
fn the_page_changes_one_column_of_a_study_and_nothing_else() {
    let script = r#"
        import { columnsOf, withColumn } from "./own.mjs";
        const study = `chain = "m.chain"\ndata = { column = "no" }\n\n[columns]\nazimuth   = { column = "az [deg]", unit = "deg" }\ntemperature = { column = 'a "b"' }\n
[observed]\nkind = "direction"\nx = { column = "\\u00e9" }\n\n[fit]\nother = { column = "no" }\n`;
        const lines = columnsOf(study);
        console.log(JSON.stringify(lines.map(({ table, key, column, unit }) => [table, key, column, unit ?? null])));
        const changed = withColumn(withColumn(study, lines[0], 'q"1', "rad"), lines[2], "east", "");
        console.log(JSON.stringify(changed.split("\n").filter((line, at) => line !== study.split("\n")[at])));
    "#;
    let Some(printed) = printed("study", script) else { return };
    let expected = concat!(
        r#"[["columns","azimuth","az [deg]","deg"],["columns","temperature","a \"b\"",null],["observed","x","é",null]]"#,
        "\n",
        r#"["azimuth   = { column = \"q\\\"1\", unit = \"rad\" }","x = { column = \"east\" }"]"#,
        "\n"
    );
    assert_eq!(printed, expected);
}
