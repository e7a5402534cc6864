//! Tables whose numbers have a decimal point here and a comma there.

use tables::formats::csv::Reader;
use tables::formats::{Form, Options, TableReader, Wanted};

/// So many rows that several processors read them.
const MANY: usize = 100_000;

fn read(text: &str) -> Result<usize, String> {
    let mut reader =
        Reader::new(text.as_bytes(), "data.tsv", &Options::default()).map_err(|error| error.to_string())?;
    let wanted = [Wanted { column: 0, form: Form::Number(1.0) }];
    reader.read(&wanted, usize::MAX).map(|chunk| chunk.rows.len()).map_err(|error| error.to_string())
}

#[test]
fn both_marks_in_one_file_are_refused_at_the_first_of_the_other() {
    let many = |number: &str| format!("{number}\tMars\n").repeat(MANY);
    for (first, other) in [("987.5", "1,234"), ("1,234", "987.5")] {
        let told = read(&format!("az\tname\n{}{}", many(first), many(other)));
        let place = format!("data.tsv: line {}, row {}, column `az`: `{other}`", MANY + 2, MANY + 1);
        assert!(told.as_ref().is_err_and(|why| why.starts_with(&place)), "{told:?}");
        assert_eq!(read(&format!("az\tname\n{}", many(first))), Ok(MANY));
    }
}

/// A comma that separates is no mark, and whole numbers have none.
#[test]
fn one_mark_is_enough() {
    assert_eq!(read("az,name\n987.5,x\n12,\"1,234\"\n"), Ok(2));
    assert_eq!(read("az;name\n987,5;x\n12;y\n"), Ok(2));
    assert_eq!(read("az\tname\n987.5\tx\n12\ty\n"), Ok(2));
}
