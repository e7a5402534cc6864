//! Tables: separated values, observations of telescopes, Parquet, and what is begun from one.

use init::{Look, Names};
use service::Refusal;
use tables::dh::Dh;
use tables::formats::{self, ColumnName, Form, Kept, Options, Site, TableReader, Wanted, write_row};
use tables::ur::Deltas;

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

/// A file of observations in the form of another program, with numbers wanted of every column.
pub fn observations(input: &[u8]) {
    let site = Some(Site { latitude_deg: 48.0, longitude_deg: 11.0 });
    for (file, site) in [("f.dat", None), ("f.csv", site), ("f.sbet", None)] {
        match formats::open(input, file, &Options { site, ..Options::default() }) {
            Ok(reader) => every_column(reader, Form::Number(2.0)),
            Err(error) => is_seen(&Refusal::of(error).to_string()),
        }
    }
}

/// What describes a robot: a table of links, or what is added to an arm.
pub fn robot(input: &[u8]) {
    let text = super::text(input);
    let described = Dh::of(&text, "f.csv").map_err(|error| error.to_string()).and_then(|table| {
        let described = init::robot::described(&init::links::dh("f", &table), None);
        described.map_err(|refused| refused.to_string())
    });
    let described = described.or_else(|_| {
        let deltas = Deltas::of(&text).map_err(|error| error.to_string())?;
        let arm =
            init::links::ur("f", &deltas, Some("UR5e")).and_then(|arm| init::robot::described(&arm, None));
        arm.map_err(|refused| refused.to_string())
    });
    match described {
        Ok(described) => {
            let chain = model_core::Chain::from_text(&described.chain);
            assert!(chain.is_ok(), "what was made of a description is read again: {}", described.chain);
        }
        Err(told) => is_seen(&told),
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
            let names = Names { chain: "f.chain", data: "f.csv", command: "f", site: None, trajectory: None };
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
