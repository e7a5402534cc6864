//! How a row is named: by its number and line as its file counts them, and by its own name.

use calibration::diagnose::SetAsideRow;

/// `row 12 (line 13)`, `row 12 (HR 5340, line 13 of night.csv)`.
#[must_use]
pub fn row(aside: &SetAsideRow) -> String {
    let line = match (aside.line, &aside.file) {
        (Some(line), Some(file)) => Some(format!("line {line} of {file}")),
        (Some(line), None) => Some(format!("line {line}")),
        (None, Some(file)) => Some(format!("of {file}")),
        (None, None) => None,
    };
    let about: Vec<String> = aside.id.iter().cloned().chain(line).collect();
    if about.is_empty() {
        return format!("row {}", aside.row);
    }
    format!("row {} ({})", aside.row, about.join(", "))
}
