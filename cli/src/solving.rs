//! Readings to set: `apply --solve`.

use model_core::names::listed;
use model_core::{Chain, ObservableId, Quantity as Measures, SymbolId, SymbolKind};
use service::apply::{self, AsMeasured, Outside, Place, REACHED, Search, Seen, Solver, in_vectors, numbers};
use service::evaluation::{Evaluator, Exactness, Quantity, readings_of};
use service::ranges::Range;
use service::readings::{ReadingsTable, factor_of};
use service::sensitivity::without_errors;
use service::source::observables;
use study::{Conversion, Headings};
use tables::formats::ColumnName;

use crate::failure::Failure;
use crate::over_table::{Opened, OverTable};
use crate::terminal;

/// Writes the readings of the joints that point where a table of targets wants: in the columns, units and notation of the study's data, where
/// an instrument file says them and the targets stand in those of what was observed; else under the declared names.
///
/// # Errors
/// The table or the model has a mistake, or the place cannot be written.
pub fn solve(
    over: &OverTable,
    form: Option<apply::As>,
    correction: bool,
    limits: &[Range],
    opened: Opened,
) -> Result<(), Failure> {
    let Opened { chain, values, found, instrument, mut table } = opened;
    let as_measured = instrument.as_ref().filter(|_| form.is_none()).and_then(|instrument| {
        let source = table.source_of_study()?;
        let seen = AsMeasured::of(instrument, source)?;
        let named = over.observable.iter().all(|name| chain.observable(seen.observable).name == *name);
        let (chain, values) = in_vectors(instrument)?;
        (named && seen.has_targets() && table.has_observed()).then_some((seen, source, chain, values))
    });
    // With the study's own inputs behind its symbols, and observables that show vectors.
    let (chain, values, as_measured) = match as_measured {
        Some((seen, source, chain, values)) => (chain, values, Some((seen, source))),
        None => (chain, values, None),
    };
    let named = match &as_measured {
        Some((seen, _)) => vec![seen.observable],
        None => observables(&chain, &over.observable)?,
    };
    let observable = match named.as_slice() {
        [one] => *one,
        several => {
            let names = listed(several.iter().map(|&id: &ObservableId| chain.observable(id).name.as_str()));
            return Err(Failure::Input(format!("say which of {names} is wanted: --observable NAME")));
        }
    };
    if !chain.observable(observable).is_vector() {
        let name = &chain.observable(observable).name;
        return Err(Failure::Input(format!(
            "`{name}` shows single readings; joints are solved for a whole direction or point: name one with --observable"
        )));
    }
    let seen = Seen::new(&chain, observable, form.unwrap_or(apply::As::Vector), true)?;
    let readings = readings_of(&chain, observable);
    let joints: Vec<SymbolId> =
        readings.into_iter().filter(|&id| chain.symbol(id).kind == SymbolKind::Joint).collect();
    let has_starts = table.has(&chain, &joints);
    let search = Search { values: &values, found: &found, limits, has_starts };
    let mut solver = Solver::new(&chain, observable, search)?;
    table.want(&chain, &solver.given)?;
    if as_measured.is_some() {
        table.want_observed()?;
    } else {
        for (name, quantity) in seen.read_names(&chain) {
            table.want_other(&name, quantity)?;
        }
    }
    // What the readings would be without the errors: the correction is the difference.
    let without = without_errors(&chain, &values);
    let mut ideal = correction
        .then(|| {
            Solver::new(
                &chain,
                observable,
                Search { values: &without, found: &found, limits: &[], has_starts: true },
            )
        })
        .transpose()?;
    let unit = |joint: SymbolId| chain.symbol(joint).quantity;
    let name = |joint: SymbolId| &chain.symbol(joint).name;
    // How the study's data have the readings of a joint.
    let headings = instrument.as_ref().and_then(|instrument| instrument.headings.as_ref());
    let of_study = headings.zip(as_measured.as_ref().map(|(_, source)| *source));
    let headed: Vec<JointColumn> =
        solver.joints.iter().map(|&joint| joint_column(&chain, joint, &table, of_study, false)).collect();
    let mut added: Vec<String> = headed.iter().map(|column| column.heading.clone()).collect();
    if correction {
        added.extend(solver.joints.iter().map(|&joint| match unit(joint) {
            Measures::Angle => format!("{}_correction [arcsec]", name(joint)),
            other => with_unit(&format!("{}_correction", name(joint)), other),
        }));
    }
    let quantity = model_core::budget::unit(&chain, observable);
    added.push(format!("{}_remaining [{quantity}]", chain.observable(observable).name));
    let mut outside = Outside::new(found.clone());
    let checked = Evaluator::new(&chain, vec![observable], Exactness::Exact, Quantity::Value, &values);
    let (mut missed, mut farthest, mut count) = (0, 0.0_f64, 0);
    let place = if as_measured.is_some() { Place::OfTheirName } else { Place::Behind };
    over.write(table, &added, place, |rows| {
        let columns: Vec<&[f64]> = rows.others.iter().map(Vec::as_slice).collect();
        let target = |row: usize| match &as_measured {
            Some((seen, _)) => seen.target(&columns, row).unwrap_or([f64::NAN; 3]),
            None => seen.vector(&columns, row),
        };
        let wanted: Vec<[f64; 3]> = (0..rows.count).map(target).collect();
        let solved = solver.solve(&rows.readings, wanted.as_flattened())?;
        let inputs = rows.readings.iter().filter(|(id, _)| !solver.joints.contains(id));
        let set: Vec<(SymbolId, Vec<f64>)> =
            inputs.cloned().chain(solver.joints.iter().copied().zip(solved.joints.clone())).collect();
        let set_columns: Vec<(SymbolId, &[f64])> =
            set.iter().map(|(id, column)| (*id, column.as_slice())).collect();
        outside.see(&chain, &set_columns, &checked)?;
        for remaining in &solved.remaining {
            count += 1;
            if *remaining > REACHED {
                missed += 1;
                farthest = farthest.max(*remaining);
            }
        }
        let joints = headed.iter().zip(&solved.joints);
        let mut out: Vec<Vec<f64>> =
            joints.map(|(column, own)| own.iter().map(|si| column.packed(*si)).collect()).collect();
        if let Some(ideal) = &mut ideal {
            let nominal = ideal.solve(&set, wanted.as_flattened())?;
            for ((joint, set), nominal) in solver.joints.iter().zip(&solved.joints).zip(&nominal.joints) {
                let scale =
                    if unit(*joint) == Measures::Angle { 648_000.0 / std::f64::consts::PI } else { 1.0 };
                out.push(set.iter().zip(nominal).map(|(set, nominal)| (set - nominal) * scale).collect());
            }
        }
        out.push(solved.remaining);
        Ok(numbers(out))
    })?;
    outside.warning(&chain).iter().for_each(terminal::warn);
    if missed > 0 {
        let far = match quantity {
            "rad" => format!("{:.3e} arcsec", farthest * 648_000.0 / std::f64::consts::PI),
            _ => format!("{farthest:.3e} m"),
        };
        terminal::warn(format_args!(
            "{missed} of {count} targets are out of reach: up to {far} remain; the readings come nearest"
        ));
    }
    Ok(())
}

/// How the readings of a joint are written.
pub struct JointColumn {
    /// Its heading.
    pub heading: String,
    /// The size of its unit, SI.
    in_si: f64,
    /// How its numbers become readings, where a study says it.
    conversion: Option<Conversion>,
}

impl JointColumn {
    /// What stands in the file for a reading in SI.
    pub fn packed(&self, si: f64) -> f64 {
        match self.conversion {
            Some(conversion) => conversion.packed(conversion.plain(si), self.in_si),
            None => si / self.in_si,
        }
    }
}

/// As the study's data have them, where there are such; else, where they are kept, as the table has them; else in SI.
pub fn joint_column(
    chain: &Chain,
    joint: SymbolId,
    table: &ReadingsTable<'_>,
    of_study: Option<(&Headings, usize)>,
    are_kept: bool,
) -> JointColumn {
    let symbol = chain.symbol(joint);
    let written = of_study.and_then(|(headings, source)| headings.written(source, joint));
    if let Some((own, (in_si, unit), conversion)) = written {
        // A column that is there keeps its heading, and a unit in the name is not said again.
        let is_said = table.header().iter().any(|column| column.full == own)
            || conversion.notation.is_some()
            || ColumnName::parse(own).unit().is_some();
        let heading = if is_said { own.to_owned() } else { format!("{own} [{unit}]") };
        return JointColumn { heading, in_si, conversion: Some(conversion) };
    }
    let there = table.header().iter().find(|column| are_kept && table.means(column, &symbol.name));
    if let Some(there) = there
        && let Ok((in_si, _)) = factor_of(there, symbol, table.source())
    {
        return JointColumn { heading: there.full.clone(), in_si, conversion: None };
    }
    JointColumn { heading: with_unit(&symbol.name, symbol.quantity), in_si: 1.0, conversion: None }
}

/// A reading beyond a turn would be doubted without its unit.
fn with_unit(name: &str, quantity: Measures) -> String {
    match quantity {
        Measures::Number => name.to_owned(),
        quantity => format!("{name} [{}]", quantity.unit()),
    }
}
