//! The search's problem at a fit: row by row, or from merged rows where they are many.

use std::ops::Range;

use faer::Mat;
use model_core::{Axis, BodyId, SymbolId, SymbolKind};

use super::filling::{Filled, each_chunk};
use super::row_set::{RowSet, components, dealt};
use super::stretches::{Chunks, all_rows, sample};
use crate::search::SearchError;
use crate::search::columns::{Columns, Probed, keep, places};
use crate::search::context::{Context, declared};
use crate::search::fitted::{Fitted, tolerance_of};
use crate::search::problem::with_stated;
use crate::search::reach::{Part, Reach, further_out};
use crate::search::standardised::MANY;
use crate::search::{Folds, Problem, ProblemError};
use effects::candidate::{EffectId, Freedom, Place};
use observe::unknowns::OfStation;
use observe::{Poses, golden};

/// Cells of merged rows at most: as many as sign flips tell apart.
const CELLS: usize = 400;

/// A sample of rows that are merged fills one part in so many of what a matrix of the search holds: its columns are held several
/// times over.
const OF_SAMPLE: usize = 6;

/// Poses further out at which effects are judged.
const FURTHER_OUT: usize = 1200;

/// Components of the data's poses, or of those further out, at which effects are compared at most.
const AT_MOST: usize = 4800;

/// Standard deviations by which a column stands out that is as large as an error may be.
const STANDS_OUT: f64 = 4.0;

/// So many times as clearly has a function to show whose form the data choose.
const CLEARLY: f64 = 10.0;

/// The whitened problem at a fit, and the rows behind it.
pub(crate) struct SearchProblem<'a> {
    /// Of all rows. Candidates are the catalogue's effects in order.
    pub problem: Problem,
    /// All rows, or a sample where they are many.
    pub rows: RowSet<'a>,
    /// The whitened problem of the sample; none where `rows` are all.
    sampled: Option<Problem>,
    /// That of `rows` without what is stated of stations; none where nothing is.
    unstated: Option<Problem>,
    /// The folds that the components of all rows were dealt to.
    folds: Folds,
    /// Per effect, whether these data let one use it.
    usable: Vec<bool>,
}

impl<'a> SearchProblem<'a> {
    /// At a fit.
    pub fn at(whole: &Context<'a>, fitted: &Fitted) -> Result<Self, SearchError> {
        let hold_out = &whole.request.plan.hold_out;
        let (all, noise) = (whole.request.observations, &fitted.fit.noise);
        let folds = dealt(all, noise, hold_out.folds, hold_out.seed);
        let functions: usize = whole.catalogue.iter().map(|effect| effect.functions.len()).sum();
        let width = fitted.combinations.ncols() + functions + 1;
        if folds.rows() * width <= whole.held {
            Self::held(whole, fitted, folds)
        } else {
            Self::merged(whole, fitted, folds, width)
        }
    }

    /// With every row in memory.
    fn held(whole: &Context<'a>, fitted: &Fitted, folds: Folds) -> Result<Self, SearchError> {
        let mut rows = RowSet::of(whole, fitted, &all_rows(whole.request.observations), |_| true)?;
        let usable = rows.seen.usable(&whole.catalogue);
        rows.keep(&usable);
        let stated = fitted.stated_of_stations(whole.request.observations.unknowns.as_ref());
        let (problem, unstated) = with_and_without(whole, fitted, &usable, &rows, folds.clone(), &stated)?;
        let reach = reach(whole, fitted, &problem, &rows, &usable)?;
        Ok(Self { problem: problem.with_reach(reach), sampled: None, unstated, rows, folds, usable })
    }

    /// With chunk after chunk merged into what is left of those before, and a sample in memory.
    fn merged(whole: &Context<'a>, fitted: &Fitted, folds: Folds, width: usize) -> Result<Self, SearchError> {
        let observations = whole.request.observations;
        let cells = cells(whole.held / (width * width), folds.count());
        let Filled { cells, spanning, seen } = Filled::of(whole, fitted, &folds, cells, width)?;
        let usable = seen.map_or_else(Vec::new, |seen| seen.usable(&whole.catalogue));
        let functions = whole
            .catalogue
            .iter()
            .zip(&usable)
            .flat_map(|(effect, &usable)| std::iter::repeat_n(usable, effect.functions.len()));
        let declared = fitted.combinations.ncols();
        let kept: Vec<usize> = (0..width)
            .zip(std::iter::repeat_n(true, declared).chain(functions).chain([true]))
            .filter(|&(_, kept)| kept)
            .map(|(column, _)| column)
            .collect();
        let (merged, of_merged) = cells.merged(&spanning.unfolding(&kept));
        let stated = fitted.stated_of_stations(observations.unknowns.as_ref());
        let problem_of_all = problem(whole, fitted, &usable, merged, of_merged, &stated)?;

        let few = whole.held / OF_SAMPLE / width * observations.rows() / folds.rows();
        let sample = sample(observations, few, whole.request.plan.hold_out.seed);
        let mut rows = RowSet::of(whole, fitted, &sample, |_| true)?;
        rows.keep(&usable);
        let hold_out = &whole.request.plan.hold_out;
        let of_sample = dealt(&rows.observations, &fitted.fit.noise, hold_out.folds, hold_out.seed);
        let (sampled, unstated) = with_and_without(whole, fitted, &usable, &rows, of_sample, &stated)?;
        let of_sample = reach(whole, fitted, &sampled, &rows, &usable)?;
        let sampled = sampled.with_reach(of_sample);
        let reach = reach(whole, fitted, &problem_of_all, &rows, &usable)?;
        let problem = problem_of_all.with_reach(reach);
        Ok(Self { problem, sampled: Some(sampled), unstated, rows, folds, usable })
    }

    /// The problem of [`Self::rows`].
    pub fn of_rows(&self) -> &Problem {
        self.sampled.as_ref().unwrap_or(&self.problem)
    }

    /// The same without what is stated of stations, as functions of any form are looked for: they follow any place that is wrong.
    pub fn of_functions(&self) -> &Problem {
        self.unstated.as_ref().unwrap_or(self.of_rows())
    }

    /// How many rows there are for each of [`Self::rows`].
    pub fn share(&self) -> f64 {
        self.folds.rows() as f64 / self.rows.without.len() as f64
    }

    /// The fold that a component of all rows lies in.
    pub fn fold_of(&self, component: usize) -> usize {
        self.folds.of_row(component)
    }

    /// The effect and its function that each candidate column of the problem is of.
    pub fn candidates(&self, whole: &Context<'_>) -> Vec<(EffectId, usize)> {
        let effects =
            whole.catalogue.iter().zip(&self.usable).enumerate().filter(|(_, (_, usable))| **usable);
        effects
            .flat_map(|(number, (effect, _))| {
                (0..effect.functions.len()).map(move |function| (EffectId(number), function))
            })
            .collect()
    }

    /// Lets `take` have what `f` makes of all rows, one set of rows after another, each with its components; with the columns of the
    /// effects that are wanted.
    pub fn each_row_set<T: Send>(
        &self,
        whole: &Context<'a>,
        fitted: &Fitted,
        wanted: impl Fn(EffectId) -> bool + Sync,
        f: impl Fn(&[usize], &RowSet<'_>) -> T + Sync,
        mut take: impl FnMut(T),
    ) -> Result<(), SearchError> {
        if self.sampled.is_none() {
            take(f(&(0..self.folds.rows()).collect::<Vec<_>>(), &self.rows));
            return Ok(());
        }
        // No derivatives but of what is wanted.
        let is_wanted =
            |effect: EffectId| wanted(effect) || fitted.found.iter().any(|found| found.effect == effect);
        let effects = whole.catalogue.iter().enumerate().filter(|&(number, _)| is_wanted(EffectId(number)));
        let places = places(&effects.map(|(_, effect)| effect.clone()).collect::<Vec<_>>());
        let poses = &whole.request.observations.poses;
        let probed = Probed::new(&fitted.chain, poses, declared(whole), &fitted.fit.values, &places)?;
        let made = |stretches: &[Range<usize>]| {
            let mut row_set = RowSet::probed(whole, fitted, &probed, stretches, &wanted)?;
            row_set.keep(&self.usable);
            Ok(f(&components(fitted, stretches), &row_set))
        };
        let chunks = Chunks::in_order(whole.request.observations);
        each_chunk(&chunks, made, |some| some.into_iter().for_each(&mut take))
    }
}

/// How many cells there are where so many fill a matrix of the search. Up to twice as many where flips of the folds but one
/// would else be of too few to be plain: each flip at its own variance costs a hundred times as much.
fn cells(fill: usize, folds: usize) -> usize {
    let plain = MANY.div_ceil(folds.saturating_sub(1).max(1)) * folds;
    let most = if fill < plain && plain <= 2 * fill { plain } else { fill };
    CELLS.min(most)
}

/// The problem of some rows with what is stated of stations, and without it where anything is.
fn with_and_without(
    whole: &Context<'_>,
    fitted: &Fitted,
    usable: &[bool],
    rows: &RowSet<'_>,
    folds: Folds,
    stated: &[OfStation],
) -> Result<(Problem, Option<Problem>), ProblemError> {
    let white = rows.whitened();
    let unstated = match stated {
        [] => None,
        _ => Some(problem(whole, fitted, usable, white.clone(), folds.clone(), &[])?),
    };
    Ok((problem(whole, fitted, usable, white, folds, stated)?, unstated))
}

/// The problem of some whitened rows, which hold the columns of usable effects alone, and of what is stated of stations behind them.
fn problem(
    whole: &Context<'_>,
    fitted: &Fitted,
    usable: &[bool],
    rows: Mat<f64>,
    folds: Folds,
    stated: &[OfStation],
) -> Result<Problem, ProblemError> {
    let (rows, folds) = with_stated(rows, folds, stated);
    let mut count = 0;
    let blocks = whole.catalogue.iter().zip(usable).map(|(effect, &usable)| {
        let start = count;
        count += if usable { effect.functions.len() } else { 0 };
        start..count
    });
    let blocks: Vec<Range<usize>> = blocks.collect();
    let plan = whole.request.plan;
    let effects = whole.catalogue.iter().zip(usable).filter(|(_, usable)| **usable).map(|(effect, _)| effect);
    let of_function =
        effects.flat_map(|effect| std::iter::repeat_n(effect.place.freedom, effect.functions.len()));
    let of_function: Vec<Freedom> = of_function.collect();
    let least: Vec<f64> = of_function.iter().map(|&freedom| least_seen(whole, freedom)).collect();
    let problem = Problem::of_rows(rows, fitted.combinations.ncols(), &blocks, &least, folds)?;
    if !plan.fit.anchored {
        return Ok(problem);
    }
    let (stated, residual) = fitted.sizes(declared(whole).len());
    let sizes: Vec<f64> = of_function.iter().map(|freedom| tolerance_of(plan, freedom.quantity())).collect();
    Ok(problem.with_prior(stated.as_ref(), &residual, &sizes))
}

/// How long a whitened column for a coefficient of one has to be, in its degree of freedom, for an effect to be looked for: beside
/// unknown objects, what would have to be larger than any error to stand out is not.
pub(crate) fn least_seen(whole: &Context<'_>, freedom: Freedom) -> f64 {
    let plan = whole.request.plan;
    if plan.fit.anchored { STANDS_OUT / tolerance_of(plan, freedom.quantity()) } else { 0.0 }
}

/// The same for a function of a reading that follows the data: it finds where the noise of its reading, which objects do not follow, moves
/// it most. That of a range along itself, which that noise moves by itself alone, does not.
pub(crate) fn least_of_function(whole: &Context<'_>, place: Place, driver: Option<SymbolId>) -> f64 {
    let ranges = whole.setting.ranges();
    let along = |(body, axis, range): &(BodyId, Axis, SymbolId)| {
        (place.body, place.freedom, driver) == (*body, Freedom::along(*axis), Some(*range))
    };
    let clearly = if ranges.iter().any(along) { 1.0 } else { CLEARLY };
    clearly * least_seen(whole, place.freedom)
}

/// What the candidates of a problem do at the data's poses and further out, each series in units of its noise.
fn reach(
    whole: &Context<'_>,
    fitted: &Fitted,
    problem: &Problem,
    rows: &RowSet<'_>,
    usable: &[bool],
) -> Result<Reach, SearchError> {
    let all = whole.request.observations;
    let plan = whole.request.plan;
    let limits = plan.next.as_ref().map_or(&[][..], |next| &next.ranges);
    let poses = further_out(&fitted.chain, &all.poses, limits, FURTHER_OUT, plan.hold_out.seed);
    let (mut columns, mut effects) = fitted.at_poses(&whole.catalogue, &poses)?;
    columns.declared = &columns.declared * fitted.of_errors(&columns);
    keep(&mut effects, usable);
    let scales: Vec<f64> = all
        .poses
        .series
        .iter()
        .filter(|series| !series.rows.is_empty())
        .map(|series| {
            let own = &fitted.fit.noise.sigma[fitted.layout.of_rows(series.rows.clone())];
            (own.iter().map(|sigma| sigma * sigma).sum::<f64>() / own.len() as f64).sqrt()
        })
        .collect();
    let part = |columns: &Columns, effects: &[Vec<Vec<f64>>], of: &Poses| {
        let declared = columns.declared.as_ref();
        let counted = of.series.iter().filter(|series| !series.rows.is_empty());
        let scale: Vec<f64> = counted
            .zip(&scales)
            .flat_map(|(series, &scale)| {
                std::iter::repeat_n(scale, series.rows.len() * series.measure.components())
            })
            .collect();
        let count = scale.len().min(AT_MOST);
        let scattered = |i: usize| (golden::share(i) * scale.len() as f64) as usize;
        let chosen: Vec<usize> =
            (0..count).map(|i| if count < scale.len() { scattered(i) } else { i }).collect();
        let declared = Mat::from_fn(chosen.len(), declared.ncols(), |i, j| declared[(chosen[i], j)]);
        let own: Vec<&Vec<f64>> = effects.iter().flatten().collect();
        let each = parallel::each_of(own.iter().enumerate(), |(candidate, own)| {
            let own: Vec<f64> = chosen.iter().map(|&row| own[row]).collect();
            problem.before_whitening(problem.declared() + candidate, declared.as_ref(), &own)
        });
        let reading =
            |readings: &[f64]| chosen.iter().map(|&at| readings[columns.row[at] as usize]).collect();
        let joints = of.columns.iter().filter(|(id, _)| fitted.chain.symbol(*id).kind == SymbolKind::Joint);
        Part {
            columns: Mat::from_fn(chosen.len(), each.len(), |i, j| each[j][i] / scale[chosen[i]]),
            joints: joints.map(|(id, readings)| (*id, reading(readings))).collect(),
            components: chosen,
        }
    };
    // How far effects reach is told by what they do to points, wherever the objects are that were observed.
    let inside = if all.unknowns.is_some() {
        let bare = rows.observations.poses.bare();
        let (mut columns, mut effects) = fitted.at_poses(&whole.catalogue, &bare)?;
        columns.declared = &columns.declared * fitted.of_errors(&columns);
        keep(&mut effects, usable);
        part(&columns, &effects, &bare)
    } else {
        part(&rows.columns, &rows.effects, &rows.observations.poses)
    };
    Ok(Reach::new(inside, part(&columns, &effects, &poses)))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::fmt::Write as _;
    use std::sync::Mutex;

    use approx::assert_relative_eq;
    use model_core::{Chain, exact};

    use super::*;
    use crate::search::context::Found;
    use crate::search::round::Round;
    use crate::search::{Request, Stage};
    use study::Study;
    use tables::formats::{DataError, Input};

    const MOUNT: &str = include_str!("../../../examples/alt-azimuth/alt-azimuth.chain");
    const ROWS: usize = 20_000;
    const STUDY: &str = r#"
        chain = "mount.chain"
        data  = "measured.csv"
        [columns]
        azimuth   = { column = "azimuth", unit = "rad" }
        elevation = { column = "elevation", unit = "rad" }
        [observed]
        kind = "direction"
        x = "x"
        y = "y"
        z = "z"
        [noise]
        group = ["night"]
    "#;

    /// Pointings of a mount that sags, in fifty nights.
    fn measured() -> String {
        let sagging = MOUNT.replace("Rx(elevation_index)", "Rx(elevation_index), Rx(sag*cos(elevation))");
        let chain = Chain::from_text(&sagging).unwrap();
        let path = exact::Path::new(&chain, chain.find_observable("sight").unwrap());
        let [azimuth, elevation, sag] =
            ["azimuth", "elevation", "sag"].map(|name| chain.find_symbol(name).unwrap().index());
        let mut values = chain.nominal_values();
        values[sag] = 1e-4;
        let mut text = String::from("azimuth,elevation,x,y,z,night\n");
        for row in 0..ROWS {
            let turn = |step: f64| (row as f64 * step).fract();
            values[azimuth] = 6.2 * turn(0.754_877_666) - 3.1;
            values[elevation] = 0.2 + 1.2 * turn(0.569_840_291);
            let sight = path.value(&values);
            let noise = |step: f64| 1e-4 * (turn(step) - 0.5);
            let [x, y, z] = [sight.x + noise(0.31), sight.y + noise(0.47), sight.z + noise(0.73)];
            let (a, e) = (values[azimuth], values[elevation]);
            let _ = writeln!(text, "{a},{e},{x},{y},{z},{}", row * 7 % 50);
        }
        text
    }

    /// Merged chunk by chunk, the rows tell the search what they tell it one by one.
    #[test]
    fn merged_rows_find_what_all_rows_find() {
        let chain = Chain::from_text(MOUNT).unwrap();
        let plan = Study::from_text(STUDY).unwrap().plan(&chain).unwrap();
        let data = measured();
        let mut open =
            |_: &str| -> Result<Input<'static>, DataError> { Ok(data.clone().into_bytes().into()) };
        let observations = plan.load(&mut open).unwrap().observations;
        let request = Request {
            text: MOUNT,
            plan: &plan,
            observations: &observations,
            sample: None,
            second: None,
            when: "2026-11-21",
        };
        let observables = [observations.poses.series[0].observable];
        let [all, merged] = [1 << 24, 1 << 19].map(|held| Context::new(request, &observables, held).unwrap());
        let of_all = Round::at(&all, Fitted::first(&all).unwrap()).unwrap();
        let told = Mutex::new(Vec::new());
        let tell = |stage| told.lock().unwrap().push(stage);
        let merged = Context { tell: &tell, ..merged };
        let of_merged = Round::at(&merged, Fitted::first(&merged).unwrap()).unwrap();
        let columns = |rows| Stage::Columns { rows, of: ROWS };
        let is_of_columns = |stage: &&Stage| matches!(stage, Stage::Columns { .. });
        {
            // How long the rest takes is told from where it begins.
            let told = told.lock().unwrap();
            assert_eq!(told.iter().find(is_of_columns), Some(&columns(0)));
            assert!(told.contains(&columns(ROWS)));
        }
        assert!(of_merged.search.problem.rows().nrows() < ROWS / 2);
        assert!(of_merged.search.rows.observations.rows() < ROWS / 4);

        assert_eq!(of_all.sets, of_merged.sets);
        let found = of_all.search(&all);
        assert_eq!(all.catalogue[found[0].effect].driver, "gravity");
        // Fewer cells than nights: the flips can say less, but not something else.
        let of_fewer = of_merged.search(&merged);
        let names = |found: &[Found]| found.iter().map(|f| (f.effect, f.alike.clone())).collect::<Vec<_>>();
        assert_eq!(names(&found), names(&of_fewer));
        assert!(of_fewer.iter().all(|found| found.p_value < 0.01));
        for fold in 0..of_all.search.problem.folds() {
            let [one, other] = [&of_all, &of_merged].map(|round| round.search.problem.fold_gram(fold));
            let candidates = of_all.search.problem.declared()..one.ncols();
            // Cells know a column to 1e-13 of its squares, and so one that follows from others to some 1e-12; as little as 1e-4 of
            // them is left beside the declared columns.
            for (i, j) in candidates.clone().flat_map(|i| candidates.clone().map(move |j| (i, j))) {
                let most = one[(j, j)].max(one[(i, i)]);
                assert_relative_eq!(one[(i, j)], other[(i, j)], epsilon = 1e-7 * most);
            }
        }
        let left = [(&all, &of_all), (&merged, &of_merged)].map(|(whole, round)| {
            let held = round.held_out(whole);
            crate::calibrate::held_out::predicted(whole, round, [&held.after]).unwrap()
        });
        for (one, other) in left[0][0].iter().zip(&left[1][0]) {
            assert_relative_eq!(one, other, epsilon = 1e-12);
        }
    }
}
