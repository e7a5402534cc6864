//! What the set-up of a study can see of the errors, in words and as JSON.

use std::fmt::Write as _;
use std::path::Path;

use model_core::{Chain, SymbolId};
use network::{SetUp, Visible, identify};
use report::words::remedy_would_show;
use serde_json::{Value, json};
use service::Source;
use tables::formats::{DataError, Input};

use crate::failure::Failure;
use crate::{source, table_files, terminal};
use model_core::names::listed;

/// Opens a data file by its path, and by where it is to be had if it is not there.
pub type OpenData<'a> = dyn FnMut(&str, Option<&str>) -> Result<Input<'static>, DataError> + 'a;

/// A set-up, with the chain that its errors belong to.
pub struct SetUpSeen {
    chain: Chain,
    set_up: SetUp,
}

impl SetUpSeen {
    /// Reads a study with its chain and its data.
    ///
    /// # Errors
    /// What is wrong with one of them.
    pub fn of_study(text: &Source, open: &mut OpenData<'_>) -> Result<Self, Failure> {
        let study = text.study()?;
        let chain = source::read_beside(text, Path::new(study.chain.get_ref()))?.chain(&terminal::warn)?;
        let plan = study.plan(&chain).map_err(|mistakes| text.mistakes(&mistakes))?;
        let loaded =
            plan.load(&mut |path| open(path, plan.data_from.as_deref())).map_err(table_files::failure)?;
        let loaded = loaded.without_repeats();
        loaded.doubtful.iter().for_each(terminal::warn);
        loaded.remarks.iter().for_each(terminal::warn);
        loaded.of_files.iter().for_each(terminal::warn);
        let set_up = identify(&plan.chain, &loaded.observations, &plan.fit)
            .map_err(|error| Failure::Input(error.to_string()))?;
        Ok(Self { chain: plan.chain, set_up })
    }

    /// In words.
    pub fn text(&self) -> String {
        let SetUp { rows, stations, objects, now, remedies } = &self.set_up;
        let mut text = format!("{rows} rows");
        if objects[0] > 0 {
            let _ = write!(text, ", {}, {}", counted(*stations, "station"), counted(*objects, "object"));
        }
        let _ = writeln!(
            text,
            ": they determine {} of {} errors",
            combinations(now.combinations.len()),
            now.errors
        );
        self.errors(&mut text, "each by itself", &now.alone);
        let several: Vec<String> =
            now.combinations.iter().filter(|one| one.len() > 1).map(|one| self.sum(one)).collect();
        if !several.is_empty() {
            text.push_str("  only together:\n");
            several.iter().for_each(|sum| text.push_str(&format!("    {sum}\n")));
        }
        self.errors(&mut text, "not at all", &now.hidden);
        for (remedy, seen) in remedies {
            let more: Vec<SymbolId> =
                seen.alone.iter().filter(|error| !now.alone.contains(error)).copied().collect();
            let _ = write!(text, "{}: {}", remedy_would_show(*remedy), combinations(seen.combinations.len()));
            if !more.is_empty() {
                let _ = write!(
                    text,
                    ", with {} by {}",
                    self.names(&more),
                    if more.len() == 1 { "itself" } else { "themselves" }
                );
            }
            text.push('\n');
        }
        text
    }

    /// For programs.
    pub fn json(&self) -> Value {
        let SetUp { rows, stations, objects, now, remedies } = &self.set_up;
        let would: Vec<Value> = remedies
            .iter()
            .map(|(remedy, seen)| {
                let mut value = self.visible(seen);
                value["with"] = Value::from(remedy_would_show(*remedy));
                value
            })
            .collect();
        let place = |[all, unknown]: [usize; 2]| json!({ "count": all, "unknown": unknown });
        let mut value = self.visible(now);
        value["rows"] = Value::from(*rows);
        value["stations"] = place(*stations);
        value["objects"] = place(*objects);
        value["would_show_more"] = Value::from(would);
        json!({ "set_up": value })
    }

    fn visible(&self, seen: &Visible) -> Value {
        let name = |id: &SymbolId| Value::from(self.chain.symbol(*id).name.as_str());
        let combination = |one: &Vec<(SymbolId, f64)>| {
            let parts = one.iter().map(|(id, factor)| json!({ "error": name(id), "factor": factor }));
            parts.collect::<Vec<_>>()
        };
        json!({
            "declared": seen.errors,
            "determined": seen.combinations.len(),
            "estimable": seen.combinations.iter().map(combination).collect::<Vec<_>>(),
            "alone": seen.alone.iter().map(name).collect::<Vec<_>>(),
            "not_shown": seen.hidden.iter().map(name).collect::<Vec<_>>(),
        })
    }

    fn errors(&self, text: &mut String, what: &str, errors: &[SymbolId]) {
        if !errors.is_empty() {
            let _ = writeln!(text, "  {what}: {}", self.names(errors));
        }
    }

    fn names(&self, errors: &[SymbolId]) -> String {
        listed(errors.iter().map(|id| self.chain.symbol(*id).name.as_str()))
    }

    /// `dtheta_y3 + db2 - 0.5 da4`
    fn sum(&self, combination: &[(SymbolId, f64)]) -> String {
        let mut text = String::new();
        for (at, (id, factor)) in combination.iter().enumerate() {
            let sign = match (at, *factor < 0.0) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            let size = factor.abs();
            let size = if size == 1.0 { String::new() } else { format!("{} ", rounded(size)) };
            let _ = write!(text, "{sign}{size}{}", self.chain.symbol(*id).name);
        }
        text
    }
}

/// Four significant digits.
fn rounded(size: f64) -> String {
    let digits = 3 - size.log10().floor().clamp(-12.0, 3.0) as i32;
    let text = format!("{size:.*}", digits.unsigned_abs() as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

fn combinations(count: usize) -> String {
    format!("{count} {}", if count == 1 { "combination" } else { "combinations" })
}

/// `4 stations (3 unknown)`
fn counted([all, unknown]: [usize; 2], what: &str) -> String {
    let plural = if all == 1 { "" } else { "s" };
    match unknown {
        0 => format!("{all} known {what}{plural}"),
        _ if unknown == all => format!("{all} unknown {what}{plural}"),
        _ => format!("{all} {what}{plural} ({unknown} unknown)"),
    }
}
