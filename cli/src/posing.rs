//! Readings to set for whole poses: `apply --solve --pose`.

use model_core::names::listed;
use model_core::{Chain, ObservableId, ObservableKind, SymbolId, SymbolKind};
use observe::SiUnit;
use report::words::numbers::told;
use service::apply::{self, Outside, Place, PoseForm, REACHED, Search, Solved, Solver, nominal_pose};
use service::evaluation::{Evaluator, Exactness, Quantity, readings_of};
use service::ranges::Range;
use service::source::observables;
use tables::formats::{Column, Kept, Texts};

use crate::failure::Failure;
use crate::over_table::{Opened, OverTable};
use crate::solving::joint_column;
use crate::terminal;

/// Rows that a warning names.
const NAMED: usize = 5;

/// Writes the readings of the joints that bring a body where a table of poses wants it, row by row, with what remains.
///
/// # Errors
/// The table or the model has a mistake, or the place cannot be written.
pub fn solve(over: &OverTable, form: PoseForm, ranges: &[Range], opened: Opened) -> Result<(), Failure> {
    let Opened { chain, values, found, instrument, mut table } = opened;
    let point = point(&chain, &over.observable)?;
    let readings = readings_of(&chain, point);
    let joints: Vec<SymbolId> =
        readings.iter().copied().filter(|&id| chain.symbol(id).kind == SymbolKind::Joint).collect();
    let has_starts = form == PoseForm::Joints || table.has(&chain, &joints);
    let search = Search { values: &values, found: &found, limits: ranges, has_starts };
    let mut solver = Solver::of_pose(&chain, point, search)?;
    table.want(&chain, &solver.given)?;
    for (name, quantity) in form.columns(&chain, point) {
        table.want_other(&name, quantity)?;
    }
    let headings = instrument.as_ref().and_then(|instrument| instrument.headings.as_ref());
    let of_study = headings.zip(table.source_of_study());
    let columns: Vec<_> =
        solver.joints.iter().map(|&joint| joint_column(&chain, joint, &table, of_study, true)).collect();
    let name = &chain.observable(point).name;
    let mut added: Vec<String> = columns.iter().map(|column| column.heading.clone()).collect();
    added.extend([
        format!("{name}_remaining [m]"),
        format!("{name}_turn_remaining [rad]"),
        format!("{name}_solved"),
    ]);
    let nominal = (form == PoseForm::Joints).then(|| nominal_pose(&chain, point, &values));
    let mut outside = Outside::new(found.clone());
    let checked = Evaluator::new(&chain, vec![point], Exactness::Exact, Quantity::Value, &values);
    let mut before = 0_usize;
    let mut missed: Vec<(usize, String)> = Vec::new();
    let (mut lost, mut singular) = (0_usize, 0_usize);
    let source = table.source().to_owned();
    over.write(table, &added, Place::OfTheirName, |rows| {
        let wanted: Vec<f64> = match &nominal {
            Some(nominal) => {
                let readings: Vec<_> = rows.readings.iter().map(|(id, own)| (*id, own.as_slice())).collect();
                let shown = nominal.columns(&readings, rows.count)?;
                (0..rows.count).flat_map(|row| shown.iter().map(move |column| column[row])).collect()
            }
            None => {
                let mut wanted = Vec::with_capacity(12 * rows.count);
                for row in 0..rows.count {
                    let pose = form.read(&rows.others, row).map_err(|why| {
                        Failure::Input(format!("{source}: row {}: {why}", before + row + 1))
                    })?;
                    wanted.extend(pose);
                }
                wanted
            }
        };
        let solved = solver.solve(&rows.readings, &wanted)?;
        let inputs = rows.readings.iter().filter(|(id, _)| !solver.joints.contains(id));
        let set = inputs.map(|(id, own)| (*id, own.as_slice()));
        let set = set.chain(solver.joints.iter().copied().zip(solved.joints.iter().map(Vec::as_slice)));
        outside.see(&chain, &set.collect::<Vec<_>>(), &checked)?;
        let words: Vec<&str> = (0..rows.count).map(|row| word(&solved, row)).collect();
        for (row, word) in words.iter().enumerate() {
            singular += usize::from(*word == SINGULAR);
            if !solved.is_reached(row) {
                lost += 1;
                if missed.len() < NAMED {
                    let [far, turn] =
                        [(solved.remaining[row], SiUnit::METRE), (solved.turn[row], SiUnit::RAD)]
                            .map(|(value, unit)| told(value, unit));
                    missed.push((before + row + 1, format!("{word}, {far} and {turn} remain")));
                }
            }
        }
        before += rows.count;
        let joints = columns.iter().zip(&solved.joints);
        let mut out: Vec<Vec<f64>> =
            joints.map(|(column, own)| own.iter().map(|si| column.packed(*si)).collect()).collect();
        out.extend([solved.remaining, solved.turn]);
        let mut out = apply::numbers(out);
        let mut texts = Texts::default();
        words.iter().for_each(|word| texts.push(word));
        out.push(Column::Kept(Kept::Texts(texts)));
        Ok(out)
    })?;
    outside.warning(&chain).iter().for_each(terminal::warn);
    if singular > 0 {
        terminal::warn(format_args!(
            "{singular} of {before} poses are reached at a singular place of the joints: the readings jump there. Move these poses a little"
        ));
    }
    if lost > 0 {
        let rows: Vec<String> = missed.iter().map(|(row, why)| format!("row {row} ({why})")).collect();
        let more = if lost > rows.len() { format!(" and {} more", lost - rows.len()) } else { String::new() };
        terminal::warn(format_args!(
            "{lost} of {before} poses are not reached to {}: {}{more}. The readings come nearest. Move these poses, or widen --range",
            told(REACHED, SiUnit::METRE),
            rows.join(", ")
        ));
    }
    Ok(())
}

const SINGULAR: &str = "singular";

/// What became of a row.
fn word(solved: &Solved, row: usize) -> &'static str {
    match (solved.is_reached(row), solved.is_singular[row], solved.is_at_limit[row]) {
        (true, true, _) => SINGULAR,
        (true, false, _) => "yes",
        (false, _, true) => "at a limit",
        (false, _, false) => "out of reach",
    }
}

/// The point of the body that is brought to its pose.
fn point(chain: &Chain, named: &[String]) -> Result<ObservableId, Failure> {
    let is_point = |&id: &ObservableId| {
        let shown = chain.observable(id);
        shown.is_vector() && shown.kind == ObservableKind::Point
    };
    let all = observables(chain, named)?;
    let points: Vec<ObservableId> = all.iter().copied().filter(is_point).collect();
    match points.as_slice() {
        [one] if named.is_empty() || all.len() == 1 => Ok(*one),
        [] => Err(Failure::Input(
            "a pose is that of a body with an observed point, and there is none: declare `observe tip: point(0, 0, 0) of BODY;`, or name one with \
             --observable"
                .to_owned(),
        )),
        several => {
            let names = listed(several.iter().map(|&id| chain.observable(id).name.as_str()));
            Err(Failure::Input(format!("say whose body is brought to the pose, by one of {names}: --observable NAME")))
        }
    }
}
