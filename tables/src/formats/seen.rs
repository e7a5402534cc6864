//! Which form a file has, seen from its beginning.

use super::{DataError, FORMS, WholeFile, tpoint};

/// How much of a file is looked at.
pub(super) const PEEK: u64 = 64 * 1024;

/// The form that a beginning shows, of a file of this name; none of a table of separated values.
///
/// # Errors
/// It shows two.
pub(super) fn form(head: &[u8], source: &str) -> Result<Option<&'static WholeFile>, DataError> {
    // Captions may be in any code page; what a form is known by is ASCII.
    let text = String::from_utf8_lossy(head);
    let text = text.trim_start_matches('\u{feff}');
    let mut seen = FORMS.iter().filter(|form| (form.looks)(text));
    match (seen.next(), seen.next()) {
        (None, _) if is_dat(source) && !is_separated(text) => Ok(Some(&tpoint::FORM)),
        (one, None) => Ok(one),
        (Some(one), Some(other)) => {
            let (file, one, other) = (source.to_owned(), one.name, other.name);
            Err(DataError::TwoForms { file, one, other })
        }
        (None, Some(_)) => unreachable!("the second follows the first"),
    }
}

/// Whether a file has the ending that TPOINT's files have.
fn is_dat(source: &str) -> bool {
    source.rsplit_once('.').is_some_and(|(_, ending)| ending.eq_ignore_ascii_case("dat"))
}

/// Whether the first two lines are cut into as many cells by a letter that no line of TPOINT has.
fn is_separated(text: &str) -> bool {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let (Some(header), Some(row)) = (lines.next(), lines.next()) else { return false };
    [',', ';', '\t', '|'].into_iter().any(|separator| {
        let count = |line: &str| line.matches(separator).count();
        count(header) > 0 && count(header) == count(row)
    })
}

/// The comments above a header.
pub(super) fn comments(head: &[u8]) -> String {
    let text = String::from_utf8_lossy(head);
    let lines = text.trim_start_matches('\u{feff}').lines();
    let above = lines.take_while(|line| line.trim().is_empty() || line.starts_with('#'));
    above.map(|line| format!("{line}\n")).collect()
}
