//! Tables of columns: what is printed in LaTeX reads back as the columns of the first-order form.

#![allow(clippy::unwrap_used, reason = "a test may fail loudly")]

use claims::latex::{PrintedSymbols, read_formula};
use model_core::algebra::Poly;
use model_core::forms::{self, Table, TableError};
use model_core::print::{self, Style};
use model_core::{Chain, SymbolId, SymbolKind};

const ARM: &str = include_str!("../../examples/six-joint-arm/six-joint-arm.chain");
const LIDAR: &str = include_str!("../../examples/mobile-lidar/mobile-lidar.chain");

fn table(text: &str, observable: &str) -> (Chain, Table) {
    let chain = Chain::symbolic_from_text(text).unwrap();
    let table = forms::table(&chain, chain.find_observable(observable).unwrap(), print::is_short).unwrap();
    (chain, table)
}

/// The cells of every array in a text.
fn cells(latex: &str, array: usize) -> Vec<Vec<String>> {
    let body = latex.split("\\begin{array}").nth(array + 1).unwrap().split_once('}').unwrap().1;
    let body = body.split("\\end{array}").next().unwrap();
    body.split("\\\\").map(|line| line.split('&').map(|cell| cell.trim().to_owned()).collect()).collect()
}

/// The columns that the printed LaTeX of a table says, in the frame of the observable.
fn read_back(table: &Table) -> Vec<(SymbolId, [Poly; 3])> {
    let latex = print::table(table, Style::Latex);
    let chain = &table.chain;
    let mut symbols = PrintedSymbols::of_chain(chain);
    let mut parts: Vec<(SymbolId, Poly)> = Vec::new();
    let has_definitions = latex.matches("\\begin{array}").count() == 2;
    if has_definitions {
        for cell in cells(&latex, 0).into_iter().flatten() {
            let (name, formula) = cell.split_once(" = ").unwrap();
            let read =
                read_formula(formula, &symbols).unwrap_or_else(|why| panic!("{formula}: {}", why.message));
            match chain.symbols.iter().position(|symbol| symbol.latex == name) {
                Some(index) => {
                    let id = SymbolId(u16::try_from(index).unwrap());
                    parts.push((id, chain.amount(&read).unwrap()));
                }
                None => symbols.define(name, &read).unwrap(),
            }
        }
    }
    let value = |text: &str| {
        let read = read_formula(text, &symbols).unwrap_or_else(|why| panic!("{text}: {}", why.message));
        let poly = chain.amount(&read).unwrap();
        parts.iter().rev().fold(poly, |poly, (id, part)| poly.substitute(*id, part).unwrap())
    };
    let rows = cells(&latex, usize::from(has_definitions));
    rows.iter()
        .skip(1)
        .map(|row| {
            let error = row[0].trim_start_matches("\\hline").trim();
            let index = chain.symbols.iter().position(|symbol| symbol.latex == error).unwrap();
            let column: Vec<Poly> = row[1..].iter().map(|cell| value(cell)).collect();
            let turned = match &table.placement {
                None => column,
                Some(rows) => rows
                    .iter()
                    .map(|row| row.iter().zip(&column).fold(Poly::zero(), |sum, (a, b)| &sum + &(a * b)))
                    .collect(),
            };
            (SymbolId(u16::try_from(index).unwrap()), turned.try_into().unwrap())
        })
        .collect()
}

fn is_the_form(text: &str, observable: &str) {
    let (chain, table) = table(text, observable);
    let form = forms::derive(&chain, table.observable, 1).unwrap();
    let columns = read_back(&table);
    for (error, expected) in form.columns(&chain) {
        let found = columns.iter().find(|(id, _)| *id == error).map(|(_, column)| column.clone());
        assert_eq!(found.unwrap_or_default(), expected, "{observable} {}", chain.symbol(error).name);
    }
}

#[test]
fn printed_tables_read_back_as_the_form() {
    let arm = Chain::symbolic_from_text(ARM).unwrap();
    for observable in arm.observables.iter().filter(|observable| observable.is_vector()) {
        is_the_form(ARM, &observable.name);
    }
    for observable in ["pointing", "position", "target"] {
        is_the_form(LIDAR, observable);
    }
}

/// A page has some seventy lines of a hundred and twenty characters.
#[test]
fn a_six_joint_arm_fits_a_page() {
    let arm = Chain::symbolic_from_text(ARM).unwrap();
    let name = &arm.observables[0].name;
    let latex = print::table(&table(ARM, name).1, Style::Latex);
    assert!(latex.lines().count() <= 70, "{}", latex.lines().count());
    insta::assert_snapshot!(latex);
}

#[test]
fn readings_have_no_table() {
    let text = "chain C { body a on ground { motion: Rz(q); motion_error: Rz(e); } observe s: azimuth of direction(1, 0, 0) of a; }";
    let chain = Chain::from_text(text).unwrap();
    let error = forms::table(&chain, chain.find_observable("s").unwrap(), print::is_short).unwrap_err();
    assert!(matches!(error, TableError::Readings(_)));
    assert_eq!(chain.symbols_of(SymbolKind::Error).count(), 1);
}
