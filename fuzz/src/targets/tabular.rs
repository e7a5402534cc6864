//! Tables: separated values, observations of telescopes, Parquet, and what is begun from one.

use init::{Look, Names};
use service::Refusal;
use tables::formats::{self, ColumnName, Form, Kept, Options, TableReader, Wanted, write_row};

use super::is_seen;

/// Rows that are read of one table.
const ROWS: usize = 10_000;

/// Separated values: what is read is written, and read again it is the same.
pub fn separated(input: &[u8]) {
    let Ok(mut reader) = formats::open(input, "f.csv", &Options::default()) else { return };
    let names: Vec<String> = reader.header().iter().map(|name| name.full.clone()).collect();
    let wanted: Vec<Wanted> = (0..names.len()).map(|column| Wanted { column, form: Form::Kept }).collect();
    let Ok(chunk) = reader.read(&wanted, ROWS) else { return };
    let columns: Vec<Vec<String>> = chunk.columns.iter().map(texts).collect();
    let mut file = Vec::new();
    let mut write = |cells: &[&str]| {
        assert!(write_row(&mut file, cells.iter().copied()).is_ok(), "a vector takes all");
    };
    write(&names.iter().map(String::as_str).collect::<Vec<_>>());
    for row in 0..chunk.rows.len() {
        write(&columns.iter().map(|column| column[row].as_str()).collect::<Vec<_>>());
    }
    let again = formats::open(file.as_slice(), "f.csv", &Options::default());
    let Ok(mut again) = again else { unreachable!("what was written has a header") };
    let header: Vec<String> = again.header().iter().map(|name: &ColumnName| name.full.clone()).collect();
    assert_eq!(header, names, "the header is read again");
    let Ok(chunk) = again.read(&wanted, ROWS) else { unreachable!("what was written can be read") };
    assert_eq!(chunk.columns.iter().map(texts).collect::<Vec<_>>(), columns, "the rows are read again");
}

fn texts(cells: &formats::Cells) -> Vec<String> {
    let formats::Cells::Kept(kept) = cells else { unreachable!("what was wanted") };
    let Ok(texts) = Kept::texts(kept) else { unreachable!("texts are texts") };
    texts.iter().map(str::to_owned).collect()
}

/// Every column as numbers, and as labels.
fn every_column(mut reader: Box<dyn TableReader + '_>, form: Form) {
    let wanted: Vec<Wanted> = (0..reader.header().len()).map(|column| Wanted { column, form }).collect();
    if let Err(error) = reader.read(&wanted, ROWS) {
        is_seen(&Refusal::of(error).to_string());
    }
}

/// A file of telescope observations, with numbers wanted of every column.
pub fn observations(input: &[u8]) {
    for file in ["f.dat", "f.csv"] {
        match formats::open(input, file, &Options::default()) {
            Ok(reader) => every_column(reader, Form::Number(2.0)),
            Err(error) => is_seen(&Refusal::of(error).to_string()),
        }
    }
}

/// A Parquet file, its columns as numbers and as labels.
#[cfg(feature = "parquet")]
pub fn parquet(input: &[u8]) {
    for form in [Form::Number(2.0), Form::Label, Form::Kept] {
        match formats::open(input, "f.parquet", &Options::default()) {
            Ok(reader) => every_column(reader, form),
            Err(error) => is_seen(&Refusal::of(error).to_string()),
        }
    }
}

/// A table that an instrument is begun from, by its own template and by every other one: what is begun is read again.
pub fn begun(input: &[u8]) {
    let open = || formats::open(input.to_vec(), "f.csv", &Options::default());
    let Ok(mut reader) = open() else { return };
    let look = match Look::at(&mut *reader) {
        Ok(look) => look,
        Err(refused) => return is_seen(&refused.to_string()),
    };
    for template in std::iter::once(None).chain(init::templates::TEMPLATES.iter().map(Some)) {
        let drafted = init::draft(&look, template).and_then(|(_, draft)| {
            let names = Names { chain: "f.chain", data: "f.csv", command: "f" };
            let study = init::study(&draft, &look, names);
            init::hold(&draft, &study, &mut |_: &str| Ok(input.to_vec().into()))
        });
        if let Err(refused) = drafted {
            let told = refused.to_string();
            is_seen(&told);
            assert!(!told.contains("made of these data cannot be read again"), "{told}");
        }
    }
}
