//! A study whose columns are read otherwise than their headers say.

use model_core::escape::comments;

/// The study with a comment on how its columns are read, and with the lines that read them so, each with its table. A line takes the place
/// of the one with its key; without such a one it stays out.
#[must_use]
pub fn otherwise(study: &str, said: &[String], lines: &[(&str, &str)]) -> String {
    let key = |line: &str| line.split_once('=').map(|(key, _)| key.trim().to_owned());
    let mut table = "";
    let mut is_said = false;
    let mut text = String::new();
    for own in study.lines() {
        if let Some(name) = own.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            table = name;
            // Before the first table that is read otherwise, or of columns where none is.
            if !is_said && (lines.is_empty() || lines.iter().any(|(of, _)| *of == table)) {
                is_said = true;
                said.iter().for_each(|line| text.push_str(&format!("# {}\n", comments::line(line))));
            }
        }
        let otherwise = lines.iter().find(|(of, line)| *of == table && key(line) == key(own));
        text.push_str(otherwise.map_or(own, |(_, line)| line));
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    const STUDY: &str = "data = \"d\"\n\n[columns]\naz   = { column = \"a\" }\nelev = { column = \"e\" }\n\n[observed]\naz = { column = \"x\" }\n";

    #[test]
    fn lines_of_their_tables_are_exchanged_below_a_comment() {
        let said = ["Column `x` is in gon.".to_owned()];
        let text = otherwise(STUDY, &said, &[("observed", "az = { column = \"x\", unit = \"gon\" }")]);
        let (before, after) = STUDY.split_once("[observed]").expect("the table");
        assert!(after.contains("az"));
        let comment = "# Column `x` is in gon.\n";
        assert_eq!(text, format!("{before}{comment}[observed]\naz = {{ column = \"x\", unit = \"gon\" }}\n"));
    }

    #[test]
    fn where_nothing_is_exchanged_the_comment_stands_with_the_columns() {
        let text = otherwise(STUDY, &["One\nof two.".to_owned()], &[]);
        assert_eq!(text.replace(&format!("# {}\n", comments::line("One\nof two.")), ""), STUDY);
        assert!(text.contains("# One") && !text.contains("\nof two."), "{text}");
    }
}
