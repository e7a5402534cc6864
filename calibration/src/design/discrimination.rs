//! Poses that would tell an accepted effect from the others that explain these data as well: greedy T-optimal design.
//!
//! If one of them is the true one, how much would each other one leave of it, everything declared refitted? The poses are
//! chosen one by one so that this difference grows for every pair: not the accepted effect alone may be the true one. What
//! explains these data somewhat worse is kept in view, so that it does not explain the new poses better.
//!
//! Everything about the data is in the search's Gram matrix, whatever their number.
//!
//! Source: A. C. Atkinson and V. V. Fedorov, "The design of experiments for discriminating between several models",
//! Biometrika 62 (1975).

use faer::Mat;
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use crate::design::{OFTEN, joints, spread};
use crate::search::columns::{Probed, places};
use crate::search::context::{Context, declared};
use crate::search::round::Round;
use effects::candidate::{Effect, EffectId};
use observe::Poses;

/// Poses that are proposed where the study does not say how many.
const POSES: usize = 12;

/// Hypotheses at most, the accepted effect and the best explanations first.
const MOST: usize = 16;

/// By how much, in σ², the poses must be able to raise the squared difference of two effects; less tells nothing apart.
const TELLING: f64 = 4.0;

/// Poses that would tell an accepted effect from those confounded with it and from competing models.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Separation {
    /// The name of the effect.
    pub effect: String,
    /// The joints, in the order of the poses' values.
    pub joints: Vec<String>,
    /// One list of joint values a pose, rad or m, the most telling first.
    pub poses: Vec<Vec<f64>>,
    /// The others that they tell it from.
    pub apart: Vec<Told>,
    /// The others that no pose within the ranges tells from it.
    pub never: Vec<String>,
}

/// How well an effect can be told from another.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Told {
    /// The name of the other.
    pub name: String,
    /// Sum of squares, in units of the noise, that the other leaves of the effect in the data so far, all else refitted.
    pub now: f64,
    /// The same once the poses are measured too; twice the log-likelihood to expect between the two.
    pub then: f64,
}

/// The data as the search sees them, and the poses that could be measured in the same units.
struct Design {
    /// Inner products of the problem's columns.
    gram: Mat<f64>,
    /// The problem's column that holds the residual.
    residual: usize,
    /// Components of an observation.
    components: usize,
    /// Columns that are refitted with every effect, each with its values at the poses.
    base: Vec<Column>,
    poses: usize,
}

/// A column of the problem: its number, and its values at the poses.
type Column = (usize, Vec<f64>);

/// An effect that may be the true one.
struct Hypothesis {
    effect: EffectId,
    columns: Vec<Column>,
    /// What these data make of its columns' coefficients.
    coefficients: DVector<f64>,
}

/// An effect as a model of what the others predict, everything declared refitted.
struct Model {
    /// The columns of what is refitted at each pose.
    rows: Vec<DMatrix<f64>>,
    /// With what has been measured.
    before: State,
    /// With the poses chosen so far as well.
    now: State,
}

/// The regression of every hypothesis's prediction on a model.
#[derive(Clone)]
struct State {
    /// Inverse of the normal matrix of what is refitted.
    spread: DMatrix<f64>,
    /// Σ squared difference from each prediction, σ².
    difference: Vec<f64>,
    /// Of each pose that could be measured: the variance of what would be seen there, and what each prediction would
    /// differ by. Kept up to date, so that a pose is weighed without the whole regression.
    seen: Vec<(DMatrix<f64>, DMatrix<f64>)>,
}

/// A model, and the prediction that it is to be told from.
#[derive(Clone, Copy, PartialEq)]
struct Pair {
    model: usize,
    truth: usize,
}

/// Poses for the accepted effect number `at`, to tell it from the effects `others`, with those in `behind` kept in view.
pub(crate) fn separation(
    whole: &Context<'_>,
    last: &Round<'_>,
    at: usize,
    others: &[EffectId],
    behind: &[EffectId],
) -> Option<Separation> {
    let plan = whole.request.plan;
    let found = &last.fitted.found;
    let own = found.get(at)?.effect;
    let mut candidates: Vec<EffectId> = Vec::new();
    for &effect in [own].iter().chain(others).chain(behind) {
        let visible = !last.search.problem.columns(effect).is_empty();
        if visible && candidates.len() < MOST && !candidates.contains(&effect) {
            candidates.push(effect);
        }
    }
    let ranges = plan.next.as_ref().map_or(&[][..], |next| &next.ranges);
    let count = plan.next.as_ref().and_then(|next| next.count).unwrap_or(POSES);
    let poses = spread(&last.fitted.chain, &whole.request.observations.poses, ranges);
    let kept: Vec<EffectId> = (0..found.len()).filter(|&i| i != at).map(|i| found[i].effect).collect();
    let columns = columns_at(whole, last, &poses, &[&kept[..], &candidates].concat())?;
    let (known, open) = columns.effects.split_at(kept.len());
    let base = columns.declared.into_iter().chain(known.iter().flatten().cloned()).collect();
    let (gram, _) = last.search.problem.gram(|_| true);
    let residual = last.search.problem.residual();
    let design = Design { gram, residual, components: columns.components, base, poses: poses.rows() };
    let hypotheses: Vec<Hypothesis> = candidates
        .iter()
        .zip(open)
        .filter(|(_, columns)| !columns.is_empty())
        .filter_map(|(&effect, columns)| design.hypothesis(effect, columns.clone()))
        .collect();
    if hypotheses.first()?.effect != own {
        return None;
    }
    let targets = design.targets(&hypotheses);
    let mut models: Vec<Model> =
        hypotheses.iter().map(|own| design.model(own, &hypotheses, &targets)).collect::<Option<_>>()?;

    // A pair that no poses tell apart would draw all poses to itself, and leave none for the others.
    let told: Vec<usize> =
        (1..models.len()).filter(|&model| others.contains(&hypotheses[model].effect)).collect();
    let (apart, never): (Vec<usize>, Vec<usize>) = told.iter().partition(|&&model| {
        let pair = Pair { model, truth: 0 };
        choose(&mut models, &[pair], count);
        let gained = models[model].gained(0);
        models.iter_mut().for_each(Model::forget);
        gained >= TELLING
    });
    let pairs = (0..models.len())
        .flat_map(|model| (0..models.len()).map(move |truth| Pair { model, truth }))
        .filter(|pair| pair.model != pair.truth && (pair.truth != 0 || !never.contains(&pair.model)));
    let mut pairs: Vec<Pair> = pairs.collect();
    let mut chosen = Vec::new();
    while !apart.is_empty() {
        chosen = choose(&mut models, &pairs, count);
        let before = pairs.len();
        pairs.retain(|&Pair { model, truth }| {
            truth == 0 && apart.contains(&model) || models[model].gained(truth) >= TELLING
        });
        if pairs.len() == before {
            break;
        }
        models.iter_mut().for_each(Model::forget);
    }
    let name = |model: usize| whole.catalogue[hypotheses[model].effect].name.clone();
    let joints = joints(&last.fitted.chain, &poses);
    let readings: Vec<&[f64]> = joints.iter().filter_map(|id| poses.column(*id)).collect();
    (!told.is_empty()).then(|| Separation {
        effect: name(0),
        poses: chosen.iter().map(|&row| readings.iter().map(|column| column[row]).collect()).collect(),
        joints: joints.iter().map(|id| last.fitted.chain.symbol(*id).name.clone()).collect(),
        apart: apart
            .iter()
            .map(|&model| Told {
                name: name(model),
                now: models[model].before.difference[0],
                then: models[model].now.difference[0],
            })
            .collect(),
        never: never.iter().map(|&model| name(model)).collect(),
    })
}

/// The problem's columns at poses that could be measured, in units of the noise.
struct There {
    components: usize,
    declared: Vec<Column>,
    /// Of each effect; none where they cannot be had.
    effects: Vec<Vec<Column>>,
}

fn columns_at(whole: &Context<'_>, last: &Round<'_>, poses: &Poses, effects: &[EffectId]) -> Option<There> {
    let (fitted, problem) = (&last.fitted, &last.search.problem);
    let values = &fitted.fit.values;
    let list: Vec<Effect> = effects.iter().map(|&effect| whole.catalogue[effect].clone()).collect();
    let columns = Probed::new(&fitted.chain, poses, declared(whole), values, &places(&list))
        .ok()?
        .columns_at(poses)
        .ok()?;
    let own = columns.of_effects(&fitted.chain, &list, poses, values);
    let components = poses.series.first()?.measure.components();
    let sigma = fitted.fit.noise.expected(whole.request.observations);
    let whitened = |mut column: Vec<f64>| {
        column.iter_mut().enumerate().for_each(|(i, value)| *value /= sigma[i % components]);
        column
    };
    let combined = &columns.declared * &fitted.combinations;
    let declared = (0..problem.declared())
        .map(|column| (column, whitened(problem.basis_before_whitening(column, combined.as_ref()))));
    let effects = effects.iter().zip(&own).map(|(&effect, own)| {
        let (first, visible) = (problem.block(effect).start, problem.columns(effect));
        let all = visible.into_iter().map(|column| {
            let own = own.get(column - first)?;
            Some((column, whitened(problem.before_whitening(column, combined.as_ref(), own))))
        });
        all.collect::<Option<Vec<Column>>>().unwrap_or_default()
    });
    Some(There { components, declared: declared.collect(), effects: effects.collect() })
}

impl Design {
    /// Inverse of the normal matrix of some columns, and their inner products with others.
    fn normal(&self, columns: &[&Column], others: &[usize]) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let k = columns.len();
        // What nothing determines so far counts as just about unknown.
        let normal = DMatrix::from_fn(k, k, |i, j| {
            self.gram[(columns[i].0, columns[j].0)] + if i == j { 1e-9 } else { 0.0 }
        });
        let right = DMatrix::from_fn(k, others.len(), |i, j| self.gram[(columns[i].0, others[j])]);
        Some((normal.cholesky()?.inverse(), right))
    }

    fn hypothesis(&self, effect: EffectId, columns: Vec<Column>) -> Option<Hypothesis> {
        let all: Vec<&Column> = self.base.iter().chain(&columns).collect();
        let (spread, right) = self.normal(&all, &[self.residual])?;
        let coefficients = (spread * right).column(0).rows(self.base.len(), columns.len()).into_owned();
        Some(Hypothesis { effect, columns, coefficients })
    }

    /// What each hypothesis predicts at each pose, one a column.
    fn targets(&self, hypotheses: &[Hypothesis]) -> Vec<DMatrix<f64>> {
        let at = |row: usize| {
            DMatrix::from_fn(self.components, hypotheses.len(), |component, truth| {
                let Hypothesis { columns, coefficients, .. } = &hypotheses[truth];
                let value = |(_, values): &Column| values[row * self.components + component];
                columns.iter().zip(coefficients.iter()).map(|(column, c)| c * value(column)).sum()
            })
        };
        (0..self.poses).map(at).collect()
    }

    fn model(&self, own: &Hypothesis, hypotheses: &[Hypothesis], targets: &[DMatrix<f64>]) -> Option<Model> {
        let all: Vec<&Column> = self.base.iter().chain(&own.columns).collect();
        let numbers =
            |truth: &Hypothesis| truth.columns.iter().map(|(number, _)| *number).collect::<Vec<_>>();
        let (spread, _) = self.normal(&all, &[])?;
        let mut fitted = DMatrix::zeros(all.len(), hypotheses.len());
        let mut difference = Vec::new();
        for (column, truth) in hypotheses.iter().enumerate() {
            let (theirs, b) = (numbers(truth), &truth.coefficients);
            let right =
                DMatrix::from_fn(all.len(), theirs.len(), |i, j| self.gram[(all[i].0, theirs[j])]) * b;
            let size = DMatrix::from_fn(theirs.len(), theirs.len(), |i, j| self.gram[(theirs[i], theirs[j])]);
            let best = &spread * &right;
            difference.push((b.dot(&(size * b)) - right.dot(&best)).max(0.0));
            fitted.set_column(column, &best);
        }
        let rows: Vec<DMatrix<f64>> = (0..self.poses)
            .map(|row| {
                DMatrix::from_fn(self.components, all.len(), |component, column| {
                    all[column].1[row * self.components + component]
                })
            })
            .collect();
        let seen = rows.iter().zip(targets).map(|(x, target)| {
            let noise = DMatrix::identity(x.nrows(), x.nrows());
            (noise + x * &spread * x.transpose(), target - x * &fitted)
        });
        let seen = seen.collect();
        let before = State { spread, difference, seen };
        Some(Model { rows, now: before.clone(), before })
    }
}

/// Chooses so many poses one by one, and measures them.
fn choose(models: &mut [Model], pairs: &[Pair], count: usize) -> Vec<usize> {
    let mut chosen = Vec::new();
    while chosen.len() < count && !pairs.is_empty() {
        let Some(best) = best(models, pairs, &chosen) else { break };
        parallel::each_of(models.iter_mut().enumerate(), |(at, model)| {
            if pairs.iter().any(|pair| pair.model == at) {
                model.measure(best);
            }
        });
        chosen.push(best);
    }
    chosen
}

/// The pose by which the differences grow most, the smallest counting most: −ln Σ exp(−difference/2), which is the log
/// of the odds against all confusions together; none that is [`OFTEN`] among the chosen ones.
fn best(models: &[Model], pairs: &[Pair], chosen: &[usize]) -> Option<usize> {
    let poses = models.first().map_or(0, |model| model.rows.len());
    let odds = |row: usize| {
        let gains: Vec<Option<Vec<f64>>> = models
            .iter()
            .enumerate()
            .map(|(at, model)| pairs.iter().any(|p| p.model == at).then(|| model.gain(row)))
            .collect();
        let gain = |pair: &Pair| gains[pair.model].as_ref().map_or(0.0, |gains| gains[pair.truth]);
        let after: Vec<f64> =
            pairs.iter().map(|p| models[p.model].now.difference[p.truth] + gain(p)).collect();
        let least = after.iter().copied().fold(f64::INFINITY, f64::min);
        least / 2.0 - after.iter().map(|d| ((least - d) / 2.0).exp()).sum::<f64>().ln()
    };
    let all = parallel::each(poses, odds);
    all.iter()
        .enumerate()
        .filter(|(row, odds)| odds.is_finite() && chosen.iter().filter(|one| *one == row).count() < OFTEN)
        .max_by(|a, b| a.1.total_cmp(b.1))
        .map(|(row, _)| row)
}

impl Model {
    /// By how much a pose would raise each difference.
    fn gain(&self, row: usize) -> Vec<f64> {
        let (variance, left) = &self.now.seen[row];
        let Some(factor) = variance.clone().cholesky() else { return vec![0.0; left.ncols()] };
        left.column_iter().zip(factor.solve(left).column_iter()).map(|(l, s)| l.dot(&s)).collect()
    }

    /// Counts a pose as measured.
    fn measure(&mut self, row: usize) {
        let State { spread, difference, seen } = &mut self.now;
        let (variance, left) = &seen[row];
        let Some(factor) = variance.clone().cholesky() else { return };
        let across = &self.rows[row] * &*spread;
        let solved = factor.solve(left);
        for (truth, difference) in difference.iter_mut().enumerate() {
            *difference += left.column(truth).dot(&solved.column(truth));
        }
        let gained = factor.solve(&across);
        *spread -= across.transpose() * &gained;
        for (x, (variance, left)) in self.rows.iter().zip(seen) {
            let shared = x * across.transpose();
            *left -= &shared * &solved;
            *variance -= shared * (&gained * x.transpose());
        }
    }

    /// By how much the poses chosen raise the difference from a prediction.
    fn gained(&self, truth: usize) -> f64 {
        self.now.difference[truth] - self.before.difference[truth]
    }

    /// Forgets the poses chosen.
    fn forget(&mut self) {
        self.now = self.before.clone();
    }
}
