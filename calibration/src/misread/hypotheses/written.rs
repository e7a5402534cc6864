//! A line to write into a study, in parts: two mistakes of one column make one line.

use super::{Line, quoted};

#[derive(Debug, Clone)]
pub(in crate::misread) struct Written {
    pub table: &'static str,
    pub key: String,
    /// The column of the file.
    pub column: String,
    /// What stands behind the column's name: `unit` and `"gon"`.
    pub how: Vec<(&'static str, String)>,
}

impl Written {
    pub fn line(&self) -> Line {
        let how: String = self.how.iter().map(|(key, value)| format!(", {key} = {value}")).collect();
        Line {
            table: self.table,
            text: format!("{} = {{ column = {}{how} }}", self.key, quoted(&self.column)),
        }
    }

    /// Lines of two mistakes, the second made of columns as the first reads them.
    pub fn merged(first: &[Self], second: &[Self]) -> Vec<Self> {
        let mut all = first.to_vec();
        for own in second {
            match all.iter_mut().find(|known| known.table == own.table && known.key == own.key) {
                Some(known) => {
                    let is_new = |(key, _): &&(&str, String)| known.how.iter().all(|(known, _)| known != key);
                    let new: Vec<_> = own.how.iter().filter(is_new).cloned().collect();
                    known.how.extend(new);
                }
                None => all.push(own.clone()),
            }
        }
        all
    }
}
