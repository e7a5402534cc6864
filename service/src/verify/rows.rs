//! The rows of a check beside what the instrument foretells of them.

use fit::Model;
use model_core::{Chain, SymbolId};
use nalgebra::{DMatrix, DVector};
use observe::{Measure, Observations};
use study::{Loaded, OpenTable, Plan};

use super::policy::{OBSERVED, POSES};
use crate::Instrument;
use crate::apply::Outside;
use crate::evaluation::{Evaluator, Exactness, Quantity};
use crate::refusal::Refusal;
use crate::sensitivity::{Watched, derivatives, stacked, without_errors};
use crate::warn::Warn;

/// Rows with what the instrument knows of them. Errors are counted by what they make of the observable: one unit of a column is the change of
/// that error that moves it by 1 rad, or 1 m, root mean square over the measured region.
pub struct Rows {
    /// The chain by which all is computed; its observables show vectors.
    pub chain: Chain,
    /// The values of all of its symbols.
    pub values: Vec<f64>,
    /// What is observed.
    pub watched: Watched,
    /// The errors and constants that move the observable, with the size of their unit.
    pub errors: Vec<(SymbolId, f64)>,
    /// The covariance of these.
    pub covariance: DMatrix<f64>,
    /// Measured less foretold, SI, of rows inside the measured region.
    pub residual: DVector<f64>,
    /// Derivatives of what is foretold.
    pub columns: DMatrix<f64>,
    /// The same at poses over the measured region.
    pub of_region: DMatrix<f64>,
    /// The rows inside, by their numbers in the file, from 1 without the header.
    pub inside: Vec<u64>,
    /// The rows outside of the measured region.
    pub outside: Vec<u64>,
    /// Rows for which the chain has no finite value.
    pub undefined: Vec<u64>,
    /// The standard deviation of each component.
    pub sigma: Vec<f64>,
    /// The degrees of freedom of that.
    pub noise: Option<f64>,
}

impl Rows {
    /// What is measured.
    #[must_use]
    pub fn measure(&self) -> Measure {
        self.watched.measure
    }

    /// Reads a table as the study of an instrument says it.
    ///
    /// # Errors
    /// The instrument lacks what a check needs; no source of its study is like the table.
    pub fn read(
        instrument: &Instrument,
        file: &str,
        open: &mut OpenTable<'_>,
        warn: Warn<'_>,
    ) -> Result<Self, Refusal> {
        let name = instrument.declaration.path.display();
        let lacks = |what: &str| {
            Refusal::Input(format!(
                "`{name}` {what}, which a check needs: calibrate again, and give the `instrument.toml` that is written then"
            ))
        };
        let study = instrument.study.as_ref().ok_or_else(|| lacks("has no [study]"))?;
        let covariance = instrument.covariance.as_ref().ok_or_else(|| lacks("has no [covariance]"))?;
        if instrument.noise.is_empty() {
            return Err(lacks("has no [[noise]]"));
        }
        // Nobody has to label ten rows.
        let mut study = study.clone();
        study.id = None;
        let plan = study.plan(&instrument.chain).map_err(|mistakes| Refusal::Input(mistakes.to_string()))?;
        let (at, loaded) = read_as(&plan, file, open)?;
        let source = &plan.sources[at];
        if source.measure.observes_object() {
            let why = "its rows observe objects whose places are unknown, of which ten rows say nothing: calibrate again with all rows";
            return Err(Refusal::Input(format!("`{name}`: {why}")));
        }
        let noise = instrument.noise.get(at).ok_or_else(|| lacks("has no [[noise]] of this source"))?;
        loaded.doubtful.iter().for_each(|doubt| warn(doubt.to_string()));
        let chain = plan.chain.clone();
        let values = instrument.values_in(&chain);
        let watched = Watched { observable: source.observable, measure: source.measure };
        let observations = &loaded.observations;
        let poses =
            watched.poses(&chain, &instrument.found, POSES).unwrap_or_else(|| observations.poses.bare());
        let all = derivatives(&chain, &poses, &values, &covariance.of)?;
        let at_zero = derivatives(&chain, &poses, &without_errors(&chain, &values), &covariance.of)?;
        let count = poses.rows() as f64;
        let is_observed = |at: usize| at_zero.column(at).norm() > OBSERVED * all.column(at).norm();
        let sizes = all.column_iter().map(|column| column.norm() / count.sqrt());
        let moving: Vec<(usize, f64)> =
            sizes.enumerate().filter(|(at, _)| is_observed(*at)).map(|(at, size)| (at, 1.0 / size)).collect();
        let errors: Vec<(SymbolId, f64)> =
            moving.iter().map(|&(at, size)| (covariance.of[at], size)).collect();
        let scaled = |columns: &DMatrix<f64>| {
            DMatrix::from_fn(columns.nrows(), moving.len(), |row, at| {
                columns[(row, moving[at].0)] * moving[at].1
            })
        };
        let own = DMatrix::from_fn(moving.len(), moving.len(), |a, b| {
            covariance.rows[moving[a].0][moving[b].0] / moving[a].1 / moving[b].1
        });
        let Foretold { residual, columns, defined } =
            foretold(&chain, observations, &values, &covariance.of)?;
        let is_outside = outside(instrument, &chain, watched, observations, &values)?;
        let mut sorted: [Vec<usize>; 3] = Default::default();
        for (row, (is_defined, is_outside)) in defined.iter().zip(&is_outside).enumerate() {
            sorted[if *is_defined { usize::from(*is_outside) } else { 2 }].push(row);
        }
        let told = |rows: &[usize]| rows.iter().map(|row| observations.row_number(*row)).collect();
        let [inside, outside, undefined] = &sorted;
        let m = source.measure.components();
        let kept: Vec<usize> = inside.iter().flat_map(|row| row * m..(row + 1) * m).collect();
        Ok(Self {
            watched,
            covariance: own,
            residual: residual.select_rows(&kept),
            columns: scaled(&columns.select_rows(&kept)),
            of_region: scaled(&all),
            inside: told(inside),
            outside: told(outside),
            undefined: told(undefined),
            sigma: noise.sigma.clone(),
            noise: noise.degrees_of_freedom,
            errors,
            chain,
            values,
        })
    }

    /// A number for each component divided by its standard deviation.
    #[must_use]
    pub fn whitened(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let m = self.sigma.len();
        DMatrix::from_fn(columns.nrows(), columns.ncols(), |row, column| {
            columns[(row, column)] / self.sigma[row % m]
        })
    }
}

/// Reads a table as the first source of a study that it is like.
fn read_as(plan: &Plan, file: &str, open: &mut OpenTable<'_>) -> Result<(usize, Loaded), Refusal> {
    let mut why = None;
    for at in 0..plan.sources.len() {
        let mut own = plan.of_files(&[file.to_owned()]);
        own.sources = vec![own.sources[at].clone()];
        match own.load_tables(open) {
            Ok(loaded) => return Ok((at, loaded)),
            Err(error) => why = why.or(Some(error)),
        }
    }
    Err(why.map_or_else(|| Refusal::Input("the study names no source".to_owned()), Refusal::of))
}

/// All rows beside what is foretold of them.
struct Foretold {
    residual: DVector<f64>,
    columns: DMatrix<f64>,
    defined: Vec<bool>,
}

/// Residuals and derivatives of all rows, and whether the chain has a value there.
fn foretold(
    chain: &Chain,
    observations: &Observations,
    values: &[f64],
    by: &[SymbolId],
) -> Result<Foretold, Refusal> {
    let model = Model::new(chain, &observations.poses, by).map_err(Refusal::of)?;
    let blocks = model.map_blocks(observations, values, |_, _, block| {
        let columns: Vec<Vec<f64>> = block.columns().map(|column| block.by_row(column)).collect();
        (block.by_row(&block.residual), columns, block.defined.clone())
    });
    let (mut residual, mut columns, mut defined) = (Vec::new(), Vec::new(), Vec::new());
    for (own, of_block, rows) in blocks.map_err(Refusal::of)? {
        residual.extend(own);
        columns.push(of_block);
        defined.extend(rows);
    }
    let columns = stacked(&model, &columns, residual.len());
    Ok(Foretold { residual: DVector::from_vec(residual), columns, defined })
}

/// Whether each row is outside of the measured region.
fn outside(
    instrument: &Instrument,
    chain: &Chain,
    watched: Watched,
    observations: &Observations,
    values: &[f64],
) -> Result<Vec<bool>, Refusal> {
    let value = Evaluator::new(chain, vec![watched.observable], Exactness::Exact, Quantity::Value, values);
    let readings: Vec<(SymbolId, &[f64])> =
        observations.poses.columns.iter().map(|(id, column)| (*id, column.as_slice())).collect();
    Outside::new(instrument.found.clone()).see(chain, &readings, &value)
}
