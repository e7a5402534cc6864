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

/// The answer of a study whose rows stand in two files.
fn answer(folder: &Folder, files: [&str; 2]) -> serde_json::Value {
    let study = format!(
        "chain = \"shaft.chain\"\ndata = {files:?}\n[observed]\nkind = \"direction\"\n[hold_out]\nfolds = 3\n"
    );
    folder.write("s.toml", study);
    let run = words(folder, "calibrate s.toml --dry-run --format json");
    done(&run);
    let mut report: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
    report.as_object_mut().expect("an object").remove("provenance");
    report
}

/// Two files with half of the rows each, and the second once more with its columns turned round, beside one that nobody asked for.
fn halves(name: &str) -> Folder {
    let folder = Folder::new(name);
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
    folder
}

#[test]
fn files_whose_columns_differ_in_order_are_read_by_their_own_headers() {
    let folder = halves("tables-orders");
    let named = |second: &str| {
        folder.write("second.csv", folder.read(second));
        answer(&folder, ["a.csv", "second.csv"])
    };
    assert_eq!(named("b.csv"), named("c.csv"));
}

/// The same of Parquet files, and of one beside a file of separated values.
#[cfg(feature = "parquet")]
#[test]
fn parquet_files_whose_columns_differ_in_order_are_read_by_their_own_headers() {
    let folder = halves("tables-orders-parquet");
    // What observes nothing of the data passes their columns on as they are.
    folder.write("other.chain", SHAFT.replace("observe mark", "observe other"));
    for name in ["a", "b", "c"] {
        let convert = format!(
            "eval other.chain --errors e.toml --data {name}.csv --quantity value --out {name}.parquet"
        );
        done(&words(&folder, &convert));
    }
    let named = |first: &str, second: &str| {
        std::fs::copy(folder.0.join(second), folder.0.join("second.parquet")).expect("copied");
        answer(&folder, [first, "second.parquet"])
    };
    let (turned, straight) = (named("a.parquet", "c.parquet"), named("a.parquet", "b.parquet"));
    assert_eq!(turned, straight);
    assert_eq!(named("a.csv", "c.parquet"), named("a.csv", "b.parquet"));
}
