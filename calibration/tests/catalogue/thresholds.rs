//! The page of the book on thresholds is written from the tables that decide.
//!
//! `UPDATE_THRESHOLDS=1 cargo test -p trueaxis-calibration --test catalogue thresholds` writes it anew.

use std::fmt::Write as _;

use calibration::thresholds::{of_contests, of_held_out, of_misread};
use evidence::policy::Threshold;

use crate::support::root;

const MOST: usize = 100;

fn table(page: &mut String, rows: &[Threshold]) {
    page.push_str("| name | value | decides | source |\n|---|---|---|---|\n");
    for row in rows {
        let meaning = row.meaning.trim_end_matches('.');
        let _ = writeln!(page, "| `{}` | {} | {} | {} |", row.name, shown(row.value), meaning, row.source);
    }
}

/// `0.05`, `1e-7`: whatever is shorter to read.
fn shown(value: f64) -> String {
    let is_small = value != 0.0 && value.abs() < 1e-3;
    if is_small { format!("{value:e}") } else { format!("{}", (value * 1e4).round() / 1e4) }
}

fn page() -> String {
    let mut page = String::from(
        "# The numbers that decide\n\n\
         <!-- Written by the tables: UPDATE_THRESHOLDS=1 cargo test -p trueaxis-calibration --test catalogue thresholds -->\n\n\
         The report depends on numbers: how much better an explanation must be, how large a value may be. This page \
         lists them. Each has its source: a paper, or the simulation that chose it. `policy` in `report.json` has those that \
         decided in one calibration.\n\n\
         A *nat* is a unit of evidence: one nat makes odds 2.7 times larger. *Prototype* means programs in NumPy by which the method \
         was chosen before it was written here, on simulated data. *Specification* means a judgement, without a measurement.\n\n\
         An effect is accepted if it predicts held-out data better. This one, of `examples/objects/walls.toml`, does so by an eighth:\n\n\
         ![Error on held-out data, before and after the effect](thresholds.svg)\n\n\
         ```sh\n\
         trueaxis calibrate examples/objects/walls.toml --out result\n\
         ```\n\n\
         `result/report.json` has the numbers that decided, under `policy`.\n\n\
         ## Misread columns\n\n\
         These numbers decide whether a column is called misread, and whether a value is too large to be a finding.\n\n",
    );
    table(&mut page, of_misread());
    page.push_str(
        "\n## Held-out data\n\n\
         These numbers decide which of the [models](../calibration/report.md#the-models) is written, how each fold is fitted, and which \
         figure is too large to be printed.\n\n",
    );
    table(&mut page, of_held_out());
    page.push_str(
        "\n## The contest of effects\n\n\
         These numbers decide which explanation of a residual is reported. `name_margin` grows where a study asks for fewer false \
         alarms: `[search] false_alarm = 0.01` adds the logarithm of five.\n\n",
    );
    table(&mut page, &of_contests());
    page
}

#[test]
fn the_page_lists_the_numbers_that_decide() {
    let (path, text) = (root().join("docs/src/diagnosis/thresholds.md"), page());
    if std::env::var_os("UPDATE_THRESHOLDS").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == text,
        "stale: UPDATE_THRESHOLDS=1 cargo test -p trueaxis-calibration --test catalogue thresholds"
    );
}

#[test]
fn every_number_has_a_name_of_its_own_and_a_source() {
    let all: Vec<Threshold> =
        of_contests().into_iter().chain([of_misread(), of_held_out()].concat()).collect();
    assert!(all.len() <= MOST, "{}", all.len());
    for (number, own) in all.iter().enumerate() {
        assert!(own.value.is_finite() && !own.meaning.is_empty() && !own.source.is_empty(), "{own:?}");
        assert!(all[..number].iter().all(|other| other.name != own.name), "{own:?}");
    }
}
