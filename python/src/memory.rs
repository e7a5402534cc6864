//! Memory for results, asked for before they are computed: where the system has none, it ends the process.

use model_core::{Chain, ObservableId};
use trueaxis_cli::library::{self, Column, Failure};

/// Refuses a table whose result would not fit into memory: the observables that are named, or all that it has readings of.
///
/// # Errors
/// The system would not give so much.
pub fn require_room(chain: &Chain, names: &[String], columns: &[(&str, Column<'_>)]) -> Result<(), Failure> {
    let rows = columns.first().map_or(0, |(_, column)| column.rows());
    // Behind the name of a reading its unit may stand.
    let is_there = |name: &str| columns.iter().any(|(column, _)| column.starts_with(name));
    let is_wanted = |id: ObservableId| match names {
        [] => library::readings_of(chain, id).iter().all(|&id| is_there(&chain.symbol(id).name)),
        names => names.contains(&chain.observable(id).name),
    };
    let wanted = (0u16..).map(ObservableId).zip(&chain.observables).filter(|(id, _)| is_wanted(*id));
    let numbers: usize = wanted.map(|(_, observable)| observable.shown.len()).sum();
    // A column that grows has room for up to twice its rows, and is copied.
    if library::has_room(rows.saturating_mul(2 * numbers + 1)) {
        return Ok(());
    }
    Err(Failure::Input(format!(
        "the table: {numbers} numbers for each of its {rows} rows do not fit into memory: give fewer rows at once"
    )))
}
