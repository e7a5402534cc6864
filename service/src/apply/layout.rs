//! The columns of a table that leaves: those of the input, and those that were computed, each at its place.

use std::io::{self, Write};

use tables::formats::{self, Column, Kept, Written};

use crate::readings::ReadingsTable;
use crate::refusal::Refusal;

/// Where columns that are computed stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Behind all of the input.
    Behind,
    /// Where the input has a column of their name, else behind.
    OfTheirName,
}

/// Where a column of the output comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Origin {
    Input(usize),
    Computed(usize),
}

/// The columns of the output in order.
pub struct Layout {
    /// The names of the columns.
    pub header: Vec<String>,
    /// Which columns of the input are not in the output, since what was computed has their names.
    pub is_replaced: Vec<bool>,
    order: Vec<Origin>,
}

impl Layout {
    /// The columns of a table with others that are added.
    #[must_use]
    pub fn of(table: &ReadingsTable<'_>, added: &[String], place: Place) -> Self {
        let is_replaced = table.replaced_by(added);
        let order = order(table, added, &is_replaced, place);
        let name = |from: &Origin| match *from {
            Origin::Input(at) => table.header()[at].full.clone(),
            Origin::Computed(at) => added[at].clone(),
        };
        Self { header: order.iter().map(name).collect(), is_replaced, order }
    }

    /// Which column of the input each is.
    #[must_use]
    pub fn kept(&self) -> Vec<Option<usize>> {
        let of = |from: &Origin| if let Origin::Input(at) = from { Some(*at) } else { None };
        self.order.iter().map(of).collect()
    }

    /// Some rows, from those of the input and what was computed of them.
    #[must_use]
    pub fn rows(&self, kept: Vec<Kept>, computed: Vec<Column>) -> Vec<Column> {
        let mut kept: Vec<Option<Kept>> = kept.into_iter().map(Some).collect();
        let mut computed: Vec<Option<Column>> = computed.into_iter().map(Some).collect();
        let columns = self.order.iter().filter_map(|from| match *from {
            Origin::Input(at) => kept[at].take().map(Column::Kept),
            Origin::Computed(at) => computed[at].take(),
        });
        columns.collect()
    }
}

fn order(table: &ReadingsTable<'_>, added: &[String], is_replaced: &[bool], place: Place) -> Vec<Origin> {
    let of_name = |name: &String| match place {
        Place::Behind => None,
        Place::OfTheirName => table.replaced_by(std::slice::from_ref(name)).iter().position(|is| *is),
    };
    let at: Vec<Option<usize>> = added.iter().map(of_name).collect();
    let here = |column: usize| at.iter().position(|own| *own == Some(column)).map(Origin::Computed);
    let columns = is_replaced.iter().enumerate().filter_map(|(column, is_replaced)| {
        if *is_replaced { here(column) } else { Some(Origin::Input(column)) }
    });
    let mut all: Vec<Origin> = columns.collect();
    for computed in (0..added.len()).map(Origin::Computed) {
        if !all.contains(&computed) {
            all.push(computed);
        }
    }
    all
}

/// Columns of numbers.
#[must_use]
pub fn numbers(columns: Vec<Vec<f64>>) -> Vec<Column> {
    columns.into_iter().map(Column::Numbers).collect()
}

/// Writes some rows as separated values; within, what the writer says.
///
/// # Errors
/// A cell that came from elsewhere has no text.
pub fn write_separated(
    out: &mut dyn Write,
    columns: &[Column],
    rows: usize,
) -> Result<io::Result<()>, Refusal> {
    let texts = columns.iter().map(|column| match column {
        Column::Kept(kept) => kept.texts().map(Some).map_err(Refusal::of),
        Column::Numbers(_) => Ok(None),
    });
    let texts = texts.collect::<Result<Vec<_>, _>>()?;
    let written = columns.iter().zip(&texts).map(|(column, texts)| match (column, texts) {
        (Column::Numbers(numbers), _) => Written::Numbers(numbers),
        (Column::Kept(_), Some(texts)) => Written::Texts(texts),
        (Column::Kept(_), None) => unreachable!("kept cells have texts"),
    });
    Ok(formats::write_rows(out, &written.collect::<Vec<_>>(), rows))
}

/// How many of some rows that were computed are not finite.
#[must_use]
pub fn not_finite(computed: &[Column], count: usize) -> usize {
    let is_finite = |row: &usize| {
        computed.iter().all(|column| match column {
            Column::Numbers(numbers) => numbers[*row].is_finite(),
            Column::Kept(_) => true,
        })
    };
    (0..count).filter(|row| !is_finite(row)).count()
}

/// What to warn of where rows are not finite, of which so many take a reading from a row that is not there.
#[must_use]
pub fn not_finite_warnings(rows: usize, unread: usize) -> Vec<String> {
    let of_unread = (unread > 0).then(|| {
        format!(
            "{unread} rows take a reading from a row before or behind that the file does not have (`shift` in the study): what is computed of \
             them is NaN"
        )
    });
    let poles = rows.saturating_sub(unread);
    let of_poles = (poles > 0)
        .then(|| format!("{poles} rows are not finite: the chain has a pole there, or a number too large"));
    of_unread.into_iter().chain(of_poles).collect()
}
