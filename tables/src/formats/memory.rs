//! Tables that a program holds in memory: named columns of numbers or texts, as a data frame hands them over.

use super::header::{ColumnName, unique};
use super::{Cell, Cells, Chunk, DataError, Form, Kept, TableReader, Wanted, clipped};

/// A column that somebody else holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Column<'a> {
    /// Numbers; NaN where the table has none.
    Numbers(&'a [f64]),
    /// Texts.
    Texts(&'a [String]),
    /// What is neither.
    Other {
        /// What tells the cells apart and puts them in order, where something does.
        labels: Option<&'a [f64]>,
        /// How many cells there are.
        rows: usize,
        /// What they are, and what to give instead.
        why: &'a str,
    },
}

impl Column<'_> {
    /// How many there are.
    #[must_use]
    pub fn rows(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Texts(texts) => texts.len(),
            Self::Other { rows, .. } => *rows,
        }
    }
}

/// A table in memory.
#[derive(Debug)]
pub struct Reader<'a> {
    source: String,
    header: Vec<ColumnName>,
    columns: Vec<Column<'a>>,
    rows: usize,
    /// Rows that have been read.
    row: usize,
}

impl<'a> Reader<'a> {
    /// A table of a name. Names of columns carry units as the headers of separated values do.
    ///
    /// # Errors
    /// No columns, a name twice, or columns of different lengths.
    pub fn new(
        source: &str,
        columns: impl IntoIterator<Item = (&'a str, Column<'a>)>,
    ) -> Result<Self, DataError> {
        let (header, columns): (Vec<ColumnName>, Vec<Column<'a>>) =
            columns.into_iter().map(|(name, column)| (ColumnName::parse(name), column)).unzip();
        let Some(rows) = columns.first().map(Column::rows) else {
            return Err(DataError::Unreadable {
                file: source.to_string(),
                why: "the table has no columns".to_string(),
            });
        };
        unique(&header, source)?;
        if let Some((name, other)) = header.iter().zip(&columns).find(|(_, column)| column.rows() != rows) {
            let why = format!(
                "column `{}` has {} rows, column `{}` has {rows}",
                clipped(&name.full),
                other.rows(),
                clipped(&header[0].full)
            );
            return Err(DataError::Unreadable { file: source.to_string(), why });
        }
        Ok(Self { source: source.to_string(), header, columns, rows, row: 0 })
    }

    fn number(&self, column: usize, row: usize) -> Result<f64, DataError> {
        let cell = || Cell {
            file: self.source.clone(),
            line: None,
            row: row as u64 + 1,
            column: self.header[column].full.clone(),
        };
        match self.columns[column] {
            Column::Numbers(numbers) if numbers[row].is_finite() => Ok(numbers[row]),
            Column::Numbers(numbers) => {
                Err(DataError::NotFinite { cell: cell(), text: format!("{:?}", numbers[row]) })
            }
            Column::Texts(texts) => {
                let text = texts[row].trim();
                match text.parse::<f64>() {
                    Ok(number) if number.is_finite() => Ok(number),
                    Ok(_) => Err(DataError::NotFinite { cell: cell(), text: clipped(text) }),
                    Err(_) if text.is_empty() => Err(DataError::EmptyCell { cell: cell() }),
                    Err(_) => Err(DataError::NotANumber { cell: cell(), text: clipped(text) }),
                }
            }
            Column::Other { why, .. } => Err(self.unusable(column, why)),
        }
    }

    fn unusable(&self, column: usize, why: &str) -> DataError {
        let (file, column) = (self.source.clone(), clipped(&self.header[column].full));
        DataError::UnusableColumn { file, column, why: why.to_string() }
    }
}

impl TableReader for Reader<'_> {
    fn source(&self) -> &str {
        &self.source
    }

    fn header(&self) -> &[ColumnName] {
        &self.header
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        let rows = self.row..self.rows.min(self.row.saturating_add(at_most));
        let texts = |column: usize| -> Result<Vec<String>, DataError> {
            match self.columns[column] {
                Column::Numbers(numbers) | Column::Other { labels: Some(numbers), .. } => {
                    Ok(numbers[rows.clone()].iter().map(|n| format!("{n:?}")).collect())
                }
                Column::Texts(texts) => Ok(texts[rows.clone()].to_vec()),
                Column::Other { labels: None, why, .. } => Err(self.unusable(column, why)),
            }
        };
        let columns = wanted
            .iter()
            .map(|want| match want.form {
                Form::Number(factor) => {
                    let numbers = rows.clone().map(|row| Ok(self.number(want.column, row)? * factor));
                    Ok(Cells::Numbers(numbers.collect::<Result<_, DataError>>()?))
                }
                Form::Label => Ok(Cells::Labels(texts(want.column)?)),
                Form::Kept => Ok(Cells::Kept(Kept::Texts(texts(want.column)?.iter().collect()))),
            })
            .collect::<Result<_, DataError>>()?;
        self.row = rows.end;
        Ok(Chunk { columns, rows: (rows.start as u64 + 1..=rows.end as u64).collect(), lines: Vec::new() })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const NUMBERS: Wanted = Wanted { column: 0, form: Form::Number(2.0) };

    #[test]
    fn a_table_is_read_in_chunks_as_a_file_is() {
        let names = ["Mars", "Moon", "Sun"].map(str::to_string);
        let mut reader = Reader::new(
            "frame",
            [("az_deg", Column::Numbers(&[1.5, -4.0, 0.125])), ("name", Column::Texts(&names))],
        )
        .unwrap();
        let wanted = [NUMBERS, Wanted { column: 1, form: Form::Label }];
        let mut read = || reader.read(&wanted, 2).unwrap();
        let labels = |labels: &[String]| Cells::Labels(labels.to_vec());
        assert_eq!(
            read(),
            Chunk {
                columns: vec![Cells::Numbers(vec![3.0, -8.0]), labels(&names[..2])],
                rows: vec![1, 2],
                lines: Vec::new()
            }
        );
        assert_eq!(
            read(),
            Chunk {
                columns: vec![Cells::Numbers(vec![0.25]), labels(&names[2..])],
                rows: vec![3],
                lines: Vec::new()
            }
        );
        assert!(read().rows.is_empty());
    }

    #[test]
    fn what_is_no_number_is_refused_where_somebody_wants_it() {
        let why = "holds truth values: give numbers";
        let table = |labels| {
            let other = Column::Other { labels, rows: 2, why };
            Reader::new("frame", [("az", other), ("el", Column::Numbers(&[1.0, 2.0]))]).unwrap()
        };
        let read = |labels, column, form| {
            table(labels).read(&[Wanted { column, form }], 5).map_err(|error| error.to_string())
        };
        let refused = Err("frame: column `az` holds truth values: give numbers".to_string());
        assert_eq!(read(Some(&[1.0, 0.0]), 0, Form::Number(1.0)), refused);
        assert_eq!(read(None, 0, Form::Label), refused);
        assert!(read(None, 1, Form::Number(1.0)).is_ok());
        let labels = read(Some(&[1.0, 0.0]), 0, Form::Label).unwrap().columns;
        assert_eq!(labels, [Cells::Labels(vec!["1.0".to_string(), "0.0".to_string()])]);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        let texts = ["1.5", " ", "x", "inf"].map(str::to_string);
        let message = |columns: &[(&str, Column<'_>)]| {
            Reader::new("frame", columns.iter().copied())
                .and_then(|mut reader| reader.read(&[NUMBERS], usize::MAX))
                .map_err(|error| error.to_string())
        };
        let cases: [(&[(&str, Column<'_>)], &str); 7] = [
            (&[], "frame: the table has no columns"),
            (
                &[("az", Column::Numbers(&[])), ("az", Column::Numbers(&[]))],
                "frame: column `az` is there twice",
            ),
            (
                &[("az", Column::Numbers(&[1.0])), ("el", Column::Numbers(&[]))],
                "frame: column `el` has 0 rows, column `az` has 1",
            ),
            (&[("az", Column::Numbers(&[1.0, f64::NAN]))], "frame: row 2, column `az`: `NaN` is not finite"),
            (&[("az", Column::Texts(&texts[..2]))], "frame: row 2, column `az`: the cell is empty"),
            (
                &[("az", Column::Texts(&texts[2..3]))],
                "frame: row 1, column `az`: `x` is no number: fill in a number, or leave the row out",
            ),
            (&[("az", Column::Texts(&texts[3..]))], "frame: row 1, column `az`: `inf` is not finite"),
        ];
        for (columns, expected) in cases {
            let told = message(columns).unwrap_err();
            assert!(told.starts_with(expected), "{told}");
        }
        assert!(message(&[("az", Column::Texts(&texts[..1]))]).is_ok());
    }
}
