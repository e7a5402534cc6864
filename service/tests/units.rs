//! Headers, studies, errors files and declarations read each unit alike, and refuse in the same words what could be two.
#![allow(clippy::unwrap_used)]

use model_core::Chain;
use model_core::unit::{Measures, Unit};
use proptest::prelude::*;
use service::Source;
use service::errors_file::values;
use study::Study;
use tables::formats::{ColumnName, DataError, Input, ReadAs};

/// A chain with an angle and a length: `const size: angle = 1 deg;` stands in it where a constant is asked for.
fn chain(constant: &str) -> Result<Chain, String> {
    let text = format!(
        "chain Slide {{ {constant} body slide on ground {{ motion: Rz(q), Tx(u); motion_error: Rz(dq), Tx(du); }} \
         observe tip: point(0, 0.1, 0) of slide; }}"
    );
    Chain::from_text(&text).map_err(|mistakes| mistakes.to_string())
}

/// The names of the joint and the error that measure an angle or a length.
fn names(measures: Measures) -> [&'static str; 2] {
    if measures == Measures::Angle { ["q", "dq"] } else { ["u", "du"] }
}

fn in_header(unit: &str, measures: Measures) -> Result<f64, String> {
    let read = ReadAs { measures, stated: None, declared: Some("q") };
    ColumnName::parse(&format!("q [{unit}]")).factor(read, "f.csv").map_err(|error| error.to_string())
}

fn in_study(unit: &str, measures: Measures) -> Result<f64, String> {
    let [name, _] = names(measures);
    let other = if name == "q" { "u" } else { "q" };
    let text = format!(
        "chain = \"slide.chain\"\ndata = \"d.csv\"\n[columns]\n{name} = {{ column = \"c\", unit = {} }}\n{other} = {{ column = \
         \"{other}\" }}\n[observed]\nkind = \"point\"\nx = {{ column = \"x\" }}\ny = {{ column = \"y\" }}\nz = {{ column = \"z\" }}\n",
        toml::Value::String(unit.to_owned())
    );
    let chain = chain("")?;
    let plan = Study::from_text(&text).and_then(|study| study.plan(&chain)).map_err(|why| why.to_string())?;
    let data = format!("c,{other},x,y,z\n1,0,0,0,0\n2,0,0,0,0\n");
    let mut open = |_: &str| -> Result<Input<'static>, DataError> { Ok(data.clone().into_bytes().into()) };
    let loaded = plan.load(&mut open).map_err(|error| error.to_string())?;
    let column = loaded.observations.poses.column(chain.find_symbol(name).unwrap()).unwrap();
    assert_eq!(column[1], 2.0 * column[0]);
    Ok(column[0])
}

fn in_errors_file(unit: &str, measures: Measures) -> Result<f64, String> {
    let ([_, name], chain) = (names(measures), chain("")?);
    let text = format!("{name} = {}\n", toml::Value::String(format!("1 {unit}")));
    let values = values(&Source::of_text("e.toml", &text), &chain, &|_| {}).map_err(|why| why.to_string())?;
    Ok(values[chain.find_symbol(name).unwrap().index()])
}

fn in_chain(unit: &str, measures: Measures) -> Result<f64, String> {
    let kind = if measures == Measures::Angle { "angle" } else { "length" };
    let chain = chain(&format!("const size: {kind} = 1 {unit};"))?;
    Ok(chain.symbol(chain.find_symbol("size").unwrap()).value.unwrap())
}

/// What the tokens of a declaration can be.
fn is_word(unit: &str) -> bool {
    unit.chars().all(char::is_alphanumeric) && unit.chars().next().is_some_and(char::is_alphabetic)
}

#[test]
fn each_spelling_is_read_alike_everywhere() {
    for unit in Unit::all().filter(|unit| matches!(unit.measures(), Measures::Angle | Measures::Length)) {
        for spelling in unit.spellings() {
            let (measures, size) = (unit.measures(), Ok(unit.in_si()));
            assert_eq!(in_header(spelling, measures), size, "header, {spelling}");
            assert_eq!(in_study(spelling, measures), size, "study, {spelling}");
            assert_eq!(in_errors_file(spelling, measures), size, "errors file, {spelling}");
            if is_word(spelling) {
                let written = in_chain(spelling, measures).unwrap();
                approx::assert_relative_eq!(written, unit.in_si(), max_relative = 1e-15);
            }
        }
    }
}

#[test]
fn what_has_two_meanings_is_refused_alike_everywhere() {
    for spelling in ["h", "hrs", "s", "sec", "min", "d", "grad", "r", "mil", "'", "\"", "NM"] {
        let why = Unit::read(spelling, None).unwrap_err().to_string();
        for measures in [Measures::Angle, Measures::Length] {
            for (place, read) in [
                ("header", in_header(spelling, measures)),
                ("study", in_study(spelling, measures)),
                ("errors file", in_errors_file(spelling, measures)),
                ("chain", if is_word(spelling) { in_chain(spelling, measures) } else { Err(why.clone()) }),
            ] {
                assert!(
                    read.as_ref().is_err_and(|said| said.contains(&why)),
                    "{place}, {spelling}: {read:?}"
                );
            }
        }
    }
}

/// A unit of something else is told what is wanted.
#[test]
fn a_unit_of_something_else_is_refused_everywhere() {
    for (unit, measures) in [("mm", Measures::Angle), ("deg", Measures::Length), ("°C", Measures::Angle)] {
        for read in [in_header(unit, measures), in_study(unit, measures), in_errors_file(unit, measures)] {
            assert!(read.as_ref().is_err_and(|said| said.contains("is wanted: write")), "{unit}: {read:?}");
        }
    }
    assert!(in_chain("K", Measures::Angle).is_err_and(|said| said.contains("measures a temperature")));
}

#[test]
fn the_book_lists_every_spelling() {
    let page = include_str!("../../docs/src/calibration/observations.md");
    for unit in Unit::all() {
        for spelling in unit.spellings() {
            assert!(page.contains(&format!("`{spelling}`")), "`{spelling}` is not in the page on units");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever stands for a unit is read to the same number, or refused, by each.
    #[test]
    fn any_text_is_read_alike(text in "[a-zA-Zµμ°′″]{1,6}", is_angle: bool) {
        let measures = if is_angle { Measures::Angle } else { Measures::Length };
        let header = in_header(&text, measures).ok();
        prop_assert_eq!(in_study(&text, measures).ok(), header);
        prop_assert_eq!(in_errors_file(&text, measures).ok(), header);
    }
}
