//! Files of one study whose columns stand in another order, or beside others: each is read by its own header.

use super::support::Folder;
use super::{done, words};

const SHAFT: &str = "chain Shaft {
    body shaft on ground { motion: Rz(reading); motion_error: Rz(index); }
    observe mark: direction(0, 1, 0) of shaft;
}
";

/// A line's cells in another order, with one more among them.
fn turned(line: &str, more: &str) -> String {
    let mut cells: Vec<&str> = line.split(',').rev().collect();
    cells.insert(1, more);
    cells.join(",") + "\n"
}

#[test]
fn files_whose_columns_differ_in_order_are_read_by_their_own_headers() {
    let folder = Folder::new("tables-orders");
    folder.write("shaft.chain", SHAFT).write("e.toml", "index = \"3 arcsec\"\n");
    done(&words(
        &folder,
        "simulate shaft.chain --errors e.toml --poses 40 --noise 1arcsec --seed 1 --out all.csv",
    ));
    let all = folder.read("all.csv");
    let (header, rows) = all.split_once('\n').expect("a header");
    let rows: Vec<&str> = rows.lines().collect();
    let (first, second) = rows.split_at(20);
    let table = |rows: &[&str]| format!("{header}\n{}\n", rows.join("\n"));
    let other: String = second.iter().map(|row| turned(row, "1e9")).collect();
    folder
        .write("a.csv", table(first))
        .write("b.csv", table(second))
        .write("c.csv", turned(header, "free") + &other);
    let answer = |second: &str| {
        folder.write("second.csv", folder.read(second));
        folder.write(
            "s.toml",
            "chain = \"shaft.chain\"\ndata = [\"a.csv\", \"second.csv\"]\n[observed]\nkind = \"direction\"\n[hold_out]\nfolds = 3\n",
        );
        let run = words(&folder, "calibrate s.toml --dry-run --format json");
        done(&run);
        let mut report: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
        report.as_object_mut().expect("an object").remove("provenance");
        report
    };
    assert_eq!(answer("b.csv"), answer("c.csv"));
}
