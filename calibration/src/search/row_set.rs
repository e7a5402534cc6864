//! Some rows of the data with everything that the search reads of them: all rows, a chunk of them, or a sample.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

use faer::Mat;

use crate::search::columns::{Columns, Probed, Seen, keep};
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use crate::search::{Folds, SearchError};
use effects::candidate::EffectId;
use fit::noise::{Layout, Noise, Run};
use fit::objects::Reduction;
use observe::Observations;
use observe::unknowns::{Freedom, Object};

/// Some rows, with their columns at a fit.
pub(crate) struct RowSet<'a> {
    pub observations: Cow<'a, Observations>,
    /// Its rows that follow each other in the data.
    pub stretches: Vec<Range<usize>>,
    /// Columns before whitening of the declared combinations and of the effects' places.
    pub columns: Columns,
    /// The columns of each effect of the catalogue before whitening.
    pub effects: Vec<Vec<Vec<f64>>>,
    /// Which of them these rows let one use.
    pub seen: Seen,
    /// Measured minus predicted without the accepted effects, with objects of which a place is stated there, before whitening.
    pub without: Vec<f64>,
    noise: Noise,
    /// Root of the robust weight of each component.
    root_weight: Vec<f64>,
    /// What takes the objects out of columns, where rows observe any.
    reduction: Option<Reduction>,
}

impl<'a> RowSet<'a> {
    /// Of rows that follow each other stretch by stretch, each within one series, in order; with the columns of the effects that
    /// are wanted, and of those that were accepted.
    pub fn of(
        whole: &Context<'a>,
        fitted: &Fitted,
        stretches: &[Range<usize>],
        wanted: impl Fn(EffectId) -> bool,
    ) -> Result<Self, SearchError> {
        Self::probed(whole, fitted, &fitted.probed, stretches, wanted)
    }

    /// The same with derivatives at the places of wanted effects, and at any others.
    pub fn probed(
        whole: &Context<'a>,
        fitted: &Fitted,
        probed: &Probed,
        stretches: &[Range<usize>],
        wanted: impl Fn(EffectId) -> bool,
    ) -> Result<Self, SearchError> {
        let all = whole.request.observations;
        let rows: usize = stretches.iter().map(ExactSizeIterator::len).sum();
        let mut observations = if rows == all.rows() {
            Cow::Borrowed(all)
        } else {
            Cow::Owned(all.select(&stretches.iter().flat_map(Clone::clone).collect::<Vec<_>>()))
        };
        if let Some(adjusted) = &fitted.adjusted {
            let of_rows =
                |values: &[f64]| stretches.iter().flat_map(|own| &values[own.clone()]).copied().collect();
            observations.to_mut().poses.columns =
                adjusted.iter().map(|(id, values)| (*id, of_rows(values))).collect();
        }
        let mut columns = probed.columns(&observations)?;
        if fitted.adjusted.is_some() {
            // The residual is that of the readings as they are.
            let raw = &fitted.fit.residuals.raw;
            columns.residual = components(fitted, stretches).into_iter().map(|at| raw[at]).collect();
        }
        columns.declared = &columns.declared * &fitted.combinations;
        let values = &fitted.fit.values;
        let wanted = |effect| wanted(effect) || fitted.found.iter().any(|found| found.effect == effect);
        let (effects, seen) =
            columns.of_part(&fitted.chain, &whole.catalogue, &observations.poses, values, wanted);
        let mut without = columns.residual.clone();
        fitted.put_back(&mut without, |effect| effects[effect.0].iter().map(Vec::as_slice));
        let believed =
            observations.unknowns.as_ref().map(|unknowns| unknowns.believed(unknowns.state(values)));
        if let Some(unknowns) = &believed {
            unknowns.as_if_stated(unknowns.state(values), &columns.row, &columns.unknown, &mut without);
        }
        let weight = stretches.iter().flat_map(|stretch| &fitted.fit.residuals.weight[stretch.clone()]);
        let weight: Vec<f64> = weight.map(|weight| weight.sqrt()).collect();
        let root_weight: Vec<f64> = columns.row.iter().map(|&row| weight[row as usize]).collect();
        let noise = fitted.fit.noise.of_runs(&runs(all, &fitted.layout, stretches));
        let reduction = believed.map(|unknowns| {
            let scale = noise.sigma.iter().zip(&root_weight).map(|(sigma, root)| root / sigma).collect();
            Reduction::as_stated(&unknowns, &columns.row, &columns.unknown, scale)
        });
        let mut end = 0;
        let of_portion = stretches.iter().map(|stretch| {
            end += stretch.len();
            end - stretch.len()..end
        });
        Ok(Self {
            stretches: of_portion.collect(),
            noise,
            reduction,
            observations,
            columns,
            effects,
            seen,
            without,
            root_weight,
        })
    }

    /// Forgets the columns of effects that are not usable.
    pub fn keep(&mut self, usable: &[bool]) {
        keep(&mut self.effects, usable);
    }

    /// Functions, each a column with a value a row, times the derivative of the components at a place, whitened.
    pub fn sheet(&self, probe: &[f64], values: &Mat<f64>) -> Mat<f64> {
        let mut sheet = Mat::zeros(self.columns.row.len(), values.ncols());
        let mixed = self.mixes_rows();
        // Else whitening is a factor to each component.
        let probe = if mixed { probe.to_vec() } else { self.whiten(probe) };
        for j in 0..values.ncols() {
            let (column, values) = (sheet.col_as_slice_mut(j), values.col_as_slice(j));
            for ((target, p), &row) in column.iter_mut().zip(&probe).zip(&self.columns.row) {
                *target = p * values[row as usize];
            }
            if mixed {
                let whitened = self.whiten(column);
                column.copy_from_slice(&whitened);
            }
        }
        sheet
    }

    /// A column of residual components, whitened as the fit whitened its own, without what objects explain of it.
    pub fn whiten(&self, column: &[f64]) -> Vec<f64> {
        let mut column = column.to_vec();
        self.noise.whiten(&mut column);
        column.iter_mut().zip(&self.root_weight).for_each(|(value, root)| *value *= root);
        if let Some(reduction) = &self.reduction {
            reduction.reduce(&mut column);
        }
        column
    }

    /// Whether whitening makes of a component more than a multiple of itself.
    pub fn mixes_rows(&self) -> bool {
        self.noise.mixes_rows() || self.reduction.is_some()
    }

    /// Takes out of a column before whitening what objects, each estimated from its own rows alone, explain of it.
    pub fn with_objects_anew(&self, mut column: Vec<f64>) -> Vec<f64> {
        if let Some(reduction) = &self.reduction {
            reduction.estimate_anew(&mut column);
        }
        column
    }

    /// Components that follow each other in order of acquisition.
    pub fn runs(&self) -> &[Run] {
        &self.noise.runs
    }

    /// The same as if no row remembered the one before.
    pub fn whiten_but_for_memory(&self, column: &[f64]) -> Vec<f64> {
        let mut column = column.to_vec();
        self.noise.without_memory().whiten(&mut column);
        column.iter_mut().zip(&self.root_weight).for_each(|(value, root)| *value *= root);
        column
    }

    /// Whether the last fit gave a component any weight.
    pub fn counts(&self, component: usize) -> bool {
        self.root_weight[component] > 0.0
    }

    /// How many rows something hangs on, as an effective number: (Σ share)² / Σ share² over rows, whose shares are told
    /// component by component; what is stated by itself, behind the components, is a row of its own.
    pub fn rows_behind(&self, shares: impl Iterator<Item = (usize, f64)>) -> f64 {
        let mut by_row: BTreeMap<u32, f64> = BTreeMap::new();
        for (component, share) in shares {
            let row = self.columns.row.get(component).map_or(u32::MAX - component as u32, |row| *row);
            *by_row.entry(row).or_insert(0.0) += share;
        }
        let sum: f64 = by_row.values().sum();
        let squares: f64 = by_row.values().map(|share| share * share).sum();
        if squares > 0.0 { sum * sum / squares } else { 0.0 }
    }

    /// Declared combinations, the columns of each effect, and the residual without the accepted effects, before whitening.
    pub fn all_columns(&self) -> Vec<&[f64]> {
        let declared = (0..self.columns.declared.ncols()).map(|j| self.columns.declared.col_as_slice(j));
        let effects = self.effects.iter().flatten().map(Vec::as_slice);
        declared.chain(effects).chain([self.without.as_slice()]).collect()
    }

    /// The same, whitened.
    pub fn whitened(&self) -> Mat<f64> {
        let columns = self.all_columns();
        let mut rows = Mat::zeros(self.without.len(), columns.len());
        for (j, column) in columns.into_iter().enumerate() {
            rows.col_as_slice_mut(j).copy_from_slice(&self.whiten(column));
        }
        rows
    }
}

/// A matrix of this size, to be filled: the room that is given where it is as large.
pub(super) fn sized(room: Mat<f64>, rows: usize, columns: usize) -> Mat<f64> {
    if room.shape() == (rows, columns) { room } else { Mat::zeros(rows, columns) }
}

/// The components of some stretches of rows.
fn runs(observations: &Observations, layout: &Layout, stretches: &[Range<usize>]) -> Vec<Run> {
    let run = |stretch: &Range<usize>| {
        let series = observations.poses.series.iter().find(|series| series.rows.contains(&stretch.start));
        let stride = series.map_or(1, |series| series.measure.components());
        let Range { start, end } = layout.of_rows(stretch.clone());
        Run { start, end, stride }
    };
    stretches.iter().map(run).collect()
}

/// The rows in folds: what is declared a group is held out together, and so is what observes one object, and of rows that
/// remember each other one stretch a fold.
pub(crate) fn dealt(observations: &Observations, noise: &Noise, folds: usize, seed: u64) -> Folds {
    let layout = Layout::of(observations);
    let of_each = |of: &[u32]| -> Vec<u32> { layout.row_of_each().map(|row| of[row]).collect() };
    let units: Cow<'_, [u32]> = match &observations.unknowns {
        Some(unknowns) => unknowns.together(&observations.units()).into(),
        None if noise.remembers() && observations.rows_are_alone() && observations.together.is_empty() => {
            // Neighbours of a row that is held out know what it remembers.
            let rows = observations.rows();
            (0..rows).map(|row| (row * folds / rows) as u32).collect()
        }
        None => observations.units(),
    };
    let mut dealt = Folds::deal_together(&of_each(&observations.groups), &of_each(&units), folds, seed);
    let Some(unknowns) = &observations.unknowns else { return dealt };
    // The components that go into an object's numbers say nothing of anything else; stated places make up for as many.
    let taken = |object: &Object| if object.freedom == Freedom::Free { object.numbers() } else { 0 };
    let mut left: Vec<usize> = unknowns.objects.iter().map(taken).collect();
    // Points that hold the frame tell how far they are from each other, and no more of each than an unknown one.
    unknowns.points_of_frame().into_iter().take(2).for_each(|object| left[object] = 3);
    for (component, row) in layout.row_of_each().enumerate() {
        if let Some(left) = unknowns.object[row].map(|object| &mut left[object as usize])
            && *left > 0
        {
            *left -= 1;
            dealt.without_component(component);
        }
    }
    dealt
}

/// The number of each component of some stretches of rows.
pub(crate) fn components(fitted: &Fitted, stretches: &[Range<usize>]) -> Vec<usize> {
    stretches.iter().flat_map(|stretch| fitted.layout.of_rows(stretch.clone())).collect()
}
