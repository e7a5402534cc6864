//! Reading a claims file without a disk.

use std::ops::Range;

use claims::file::{Claims, Edge, File};
use model_core::budget::{JointRange, Path};
use model_core::{Chain, Mistake, Quantity};

/// Numbers in SI, arc seconds, degrees and micrometres; no paths.
struct Plain;

impl Edge for Plain {
    fn quantity(&self, text: &str, _: Quantity) -> Result<f64, String> {
        let (number, unit) = text.trim().split_once(' ').unwrap_or((text.trim(), ""));
        let factor = match unit {
            "" | "rad" | "m" => 1.0,
            "deg" => std::f64::consts::PI / 180.0,
            "arcsec" => std::f64::consts::PI / 648_000.0,
            "mm" => 1e-3,
            "um" => 1e-6,
            other => return Err(format!("unknown unit {other}")),
        };
        number.parse::<f64>().map(|number| number * factor).map_err(|error| error.to_string())
    }

    fn example(&self, _: Quantity) -> String {
        "1 mm".to_owned()
    }

    fn path(&self, _: &Chain, _: &str) -> Result<Path, Mistake<Range<usize>>> {
        Err(Mistake::new(0..0, "no paths here"))
    }

    fn range(&self, _: &Chain, _: &str) -> Result<JointRange, String> {
        Err("no ranges here".to_owned())
    }
}

/// What is said of each claim of a file, by its name: `holds`, `differs`, or the first mistake.
pub fn verdicts(chain: &str, file: &str) -> Vec<(String, String)> {
    let claims = claims_of(chain, file);
    let (checked, undecided) = claims.check();
    let mut found: Vec<(String, String)> = checked
        .iter()
        .map(|one| (one.claim.name.clone(), if one.verdict.holds() { "holds" } else { "differs" }.to_owned()))
        .collect();
    for one in claims.unread.iter().chain(&undecided) {
        found.push((one.name.clone(), one.mistakes[0].message.clone()));
    }
    found.extend(claims.mistakes.iter().map(|mistake| ("file".to_owned(), mistake.message.clone())));
    found
}

/// What a file with claims that have no verdict is asked for.
#[allow(dead_code, reason = "mutants are asked for nothing")]
pub fn help(chain: &str, file: &str) -> String {
    let claims = claims_of(chain, file);
    let (_, undecided) = claims.check();
    let mistakes = claims.unread.iter().chain(&undecided).flat_map(|one| &one.mistakes);
    mistakes.filter_map(|mistake| mistake.help.clone()).collect::<Vec<_>>().join("; ")
}

fn claims_of(chain: &str, file: &str) -> Claims {
    let parsed: File = toml::from_str(file).unwrap_or_else(|error| panic!("{file}: {error}"));
    let text = match &parsed.dh {
        Some(table) => {
            claims::file::declaration_of_dh(table.get_ref()).unwrap_or_else(|mistake| panic!("{mistake:?}"))
        }
        None if chain.is_empty() => claims::file::declaration_of_formulas(&parsed),
        None => chain.to_owned(),
    };
    let chain = Chain::symbolic_from_text(&text).unwrap_or_else(|mistakes| panic!("{text}\n{mistakes}"));
    Claims::read(file, &parsed, &chain, &Plain)
}

/// The one verdict of a file with one claim.
#[allow(dead_code, reason = "papers have many claims")]
pub fn verdict(chain: &str, file: &str) -> String {
    let found = verdicts(chain, file);
    assert_eq!(found.len(), 1, "{found:?}");
    found[0].1.clone()
}
