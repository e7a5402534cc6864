//! Tables of a report as separated values.

use std::io::{self, Write};

use tables::formats::{Texts, Written, write_row, write_rows};

use crate::residuals::Cells;

/// Columns as separated values, row by row below their names; a cell is empty where there is no number.
///
/// # Errors
/// What takes the bytes refuses them.
pub fn write_csv(columns: &[(String, Cells<'_>)], out: &mut dyn Write) -> io::Result<()> {
    write_row(out, columns.iter().map(|(name, _)| name.as_str()))?;
    let texts: Vec<Option<Texts>> = columns
        .iter()
        .map(|(_, cells)| if let Cells::Texts(texts) = cells { Some(texts.iter().collect()) } else { None })
        .collect();
    let rows = columns.first().map_or(0, |(_, cells)| match cells {
        Cells::Rows(numbers) => numbers.len(),
        Cells::Texts(texts) => texts.len(),
        Cells::Numbers(numbers) => numbers.len(),
        Cells::Residuals(numbers) => numbers.len(),
    });
    let written = columns.iter().zip(&texts).map(|((_, cells), texts)| match (cells, texts) {
        (Cells::Rows(numbers), _) => Written::Counts(numbers),
        (Cells::Numbers(numbers), _) => Written::Numbers(numbers),
        (Cells::Residuals(numbers), _) => Written::Residuals(numbers),
        (Cells::Texts(_), Some(texts)) => Written::Texts(texts),
        (Cells::Texts(_), None) => unreachable!("texts were gathered above"),
    });
    write_rows(out, &written.collect::<Vec<_>>(), rows)
}
