//! Files that somebody changed on purpose: cut off, spliced, with a footer that lies or is encrypted. Each is read as it should be, or
//! refused with a sentence.

use super::{Reader, Writer};
use crate::formats::{Cells, Column, Form, Kept, Options, TableReader as _, Texts, Wanted};

const FILES: [&[u8]; 6] = [
    include_bytes!("../../../tests/reference/snappy.parquet"),
    include_bytes!("../../../tests/reference/zstd.parquet"),
    include_bytes!("../../../tests/reference/checked.parquet"),
    include_bytes!("../../../tests/reference/types.parquet"),
    include_bytes!("../../../tests/reference/half.parquet"),
    include_bytes!("../../../tests/reference/interval.parquet"),
];

/// Every column as labels, as far as the file can be read.
fn read(bytes: &[u8]) -> Result<Vec<Cells>, String> {
    let mut reader =
        Reader::new(bytes.into(), "run.parquet", &Options::default()).map_err(|error| error.to_string())?;
    let columns = 0..reader.header().len();
    let wanted: Vec<Wanted> = columns.map(|column| Wanted { column, form: Form::Label }).collect();
    reader.read(&wanted, usize::MAX).map(|chunk| chunk.columns).map_err(|error| error.to_string())
}

/// It is read, or the sentence says of which file.
fn is_read_or_refused(bytes: &[u8], what: &str) {
    if let Err(why) = read(bytes) {
        assert!(why.starts_with("run.parquet: ") && why.len() < 5000, "{what}: {why}");
    }
}

#[test]
fn files_that_are_cut_off_are_refused() {
    for file in FILES {
        for end in 0..file.len() {
            assert!(read(&file[..end]).is_err(), "{end} of {} bytes", file.len());
        }
    }
}

#[test]
fn halves_of_two_files_are_no_panic() {
    for (first, second) in FILES.iter().flat_map(|first| FILES.iter().map(move |second| (first, second))) {
        for at in (4..first.len()).step_by(17) {
            let behind = second.len().saturating_sub(at.min(second.len()));
            is_read_or_refused(
                &[&first[..at], &second[second.len() - behind..]].concat(),
                "its end at its place",
            );
            is_read_or_refused(&[&first[..at], &second[second.len() / 2..]].concat(), "its second half");
        }
        // A whole file behind another: its table of contents points into the first.
        is_read_or_refused(&[*first, *second].concat(), "one behind another");
    }
}

#[test]
fn an_encrypted_footer_is_said_to_be_one() {
    let mut file = FILES[0].to_vec();
    let end = file.len() - 4;
    file[..4].copy_from_slice(b"PARE");
    file[end..].copy_from_slice(b"PARE");
    let why = read(&file).expect_err("there is no key");
    assert!(why.contains("encrypted"), "{why}");
}

#[test]
fn statistics_that_lie_change_nothing() {
    let file = FILES[0];
    // The smallest and the largest of the numbers, as the footer says them.
    let footer =
        file.len() - 8 - u32::from_le_bytes([file[file.len() - 8], file[file.len() - 7], 0, 0]) as usize;
    let mut lying = file.to_vec();
    let mut lies = 0;
    for at in footer..file.len() - 16 {
        for number in [1.5_f64, -4.0] {
            if file[at..at + 8] == number.to_le_bytes() {
                lying[at..at + 8].copy_from_slice(&1e300_f64.to_le_bytes());
                lies += 1;
            }
        }
    }
    assert!(lies >= 2, "{lies}");
    assert_eq!(read(&lying), read(file));
}

/// Counts and places of the footer, each replaced by extreme ones: rows, values, sizes, offsets.
#[test]
fn numbers_of_the_footer_that_lie_are_no_panic() {
    for file in FILES {
        let footer = u32::from_le_bytes([file[file.len() - 8], file[file.len() - 7], 0, 0]) as usize;
        for at in file.len() - 8 - footer..file.len() - 8 {
            for lie in [0x00, 0x01, 0x02, 0x7e, 0x7f, 0x80, 0xfe, 0xff] {
                let mut lying = file.to_vec();
                lying[at] = lie;
                is_read_or_refused(&lying, "a byte of the footer");
            }
        }
    }
}

#[test]
fn names_that_command_a_terminal_come_through_and_are_shown() {
    let name = "az\u{1b}]0;x\u{7}\u{202e}\nerror: b";
    let mut writer = Writer::new(vec![name.to_owned()]);
    let texts: Texts = ["1", "\u{9b}31m"].into_iter().collect();
    let mut file = writer.rows(vec![Column::Kept(Kept::Texts(texts))], 2).expect("rows");
    file.extend(writer.finish().expect("a file"));
    let mut reader = Reader::new(file.into(), "run.parquet", &Options::default()).expect("a file");
    assert_eq!(reader.header()[0].full, name);
    let wanted = [Wanted { column: 0, form: Form::Number(1.0) }];
    let why = reader.read(&wanted, 2).expect_err("a cell is no number").to_string();
    assert!(!why.contains(model_core::escape::is_unseen), "{why:?}");
}

/// A table of very many columns goes through.
#[test]
fn many_columns_go_through() {
    const COLUMNS: usize = 100_000;
    let names = (0..COLUMNS).map(|column| format!("c{column}")).collect();
    let mut writer = Writer::new(names);
    let columns = (0..COLUMNS).map(|column| Column::Numbers(vec![column as f64, 0.5])).collect();
    let mut file = writer.rows(columns, 2).expect("rows");
    file.extend(writer.finish().expect("a file"));
    let mut reader = Reader::new(file.into(), "run.parquet", &Options::default()).expect("a file");
    assert_eq!(reader.header().len(), COLUMNS);
    let wanted = [Wanted { column: COLUMNS - 1, form: Form::Number(1.0) }];
    let chunk = reader.read(&wanted, usize::MAX).expect("numbers");
    assert_eq!(chunk.columns, [Cells::Numbers(vec![(COLUMNS - 1) as f64, 0.5])]);
}
