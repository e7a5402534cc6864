//! The decimal mark of a file: a point, or a comma where no comma separates; never both.

use super::error::clipped;

/// A number as text has it: with a decimal comma where no comma separates.
pub(super) fn parse(text: &str, separator: u8) -> Option<f64> {
    text.parse().ok().or_else(|| with_comma(text, separator))
}

fn with_comma(text: &str, separator: u8) -> Option<f64> {
    let decimal_comma = separator != b',' && text.contains(',') && !text.contains('.');
    if decimal_comma { text.replacen(',', ".", 1).parse().ok() } else { None }
}

/// All of some cells as numbers, with one decimal mark among them; none where one is no number, or where both marks stand. What
/// separated the cells is gone from them, so that a comma in one separates nothing.
pub fn numbers(cells: &[String]) -> Option<Vec<f64>> {
    const NO_COMMA: u8 = b'\n';
    let mut marks = Marks::default();
    cells.iter().map(|cell| marks.read(cell, NO_COMMA)?.ok()).collect()
}

/// The first number with each mark. A file with both has commas between thousands, and which are which is not for us to guess.
#[derive(Debug, Clone, Default)]
pub(super) struct Marks {
    point: Option<String>,
    comma: Option<String>,
}

impl Marks {
    /// The number of a text, or why its mark is not that of the numbers before; none where it is no number.
    pub fn read(&mut self, text: &str, separator: u8) -> Option<Result<f64, String>> {
        let number = match text.parse() {
            Ok(number) => {
                if separator != b',' && self.point.is_none() && text.contains('.') {
                    self.point = Some(text.to_owned());
                }
                number
            }
            Err(_) => {
                let number = with_comma(text, separator)?;
                self.comma.get_or_insert_with(|| text.to_owned());
                number
            }
        };
        Some(self.mixed(text).map_or(Ok(number), Err))
    }

    /// Takes up those of rows further down; whether they are mixed now.
    pub fn merge(&mut self, below: Self) -> bool {
        self.point = self.point.take().or(below.point);
        self.comma = self.comma.take().or(below.comma);
        self.point.is_some() && self.comma.is_some()
    }

    fn mixed(&self, text: &str) -> Option<String> {
        let (point, comma) = (self.point.as_ref()?, self.comma.as_ref()?);
        let other = if text == comma { point } else { comma };
        Some(format!(
            "`{}` and, further up, `{}`: is the comma a decimal mark, or does it part thousands? Write all numbers with a decimal point, \
             and none with a comma",
            clipped(text),
            clipped(other)
        ))
    }
}
