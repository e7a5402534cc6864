//! How uncertain estimates are, and by how many degrees of freedom that is known.
//!
//! With a stated noise that the residuals do not contradict, by what is stated. Else by the residuals: of every kind of
//! component, weighed by what each has part in; of whole groups where rows of a group are not independent; in order of
//! acquisition where rows remember those before; row by row where rows observe objects.

use faer::Mat;
use model_core::SymbolId;

use super::cluster::{Clusters, Share};
use super::coordinates::Coordinates;
use super::estimable::{Estimable, variance_of};
use super::reference::{Followed, FromReference};
use super::sets::Sets;
use super::shared::{Order, Shared};
use super::solver::{Course, Solver};
use super::stated::{Agreement, Stated};
use super::subspace::Subspace;
use super::sweep::Weighting;
use super::{FitError, Partial, robust};
use crate::noise::serial;
use crate::noise::{self, Pools, session, trend};

/// Degrees of freedom from which on it makes no difference which kind of component they come from.
const MANY: f64 = 1000.0;

/// Degrees of freedom that even a random walk leaves to its own size.
const LEAST: f64 = 3.0;

/// Sets of rows whose own residuals say how uncertain they make the estimates; of fewer rows each is one. As many as no period of a
/// file has in common with them.
const SETS_OF_ROWS: usize = 211;

/// Groups above which each has so little part that none needs adjusting one by one.
const MANY_GROUPS: usize = 5000;

/// The uncertainty of every combination of the estimates.
pub(super) struct Uncertainty {
    /// A root of (JᵀJ + P)⁻¹, p × k, SI.
    root: Mat<f64>,
    /// What the data have part in of rootᵀ (JᵀJ + P) root = 1, k × k.
    data: Mat<f64>,
    /// A root of what the prior adds to the covariance, p × (p − rank).
    prior: Mat<f64>,
    spread: Spread,
    /// What the inputs of the reference do beside the errors.
    beside: Option<Followed>,
    /// Components with weight, less what the estimates use up.
    left: f64,
    stated: Option<Stated>,
}

/// What is known of the covariance of Qᵀe, Q the columns times the root.
enum Spread {
    /// Nothing: no degrees of freedom.
    Unknown,
    /// It is this multiple of one.
    Even { factor: f64, degrees_of_freedom: f64 },
    /// The same, pool by pool of components: Q_kᵀQ_k, and the degrees of freedom.
    Pools { factor: f64, pools: Vec<(Mat<f64>, f64)> },
    /// From whole groups, times a factor; and what else adds to it, each with its degrees of freedom: groups that cross them, and what
    /// is stated of places.
    Groups { factor: f64, clusters: Clusters, beside: Vec<(Mat<f64>, f64)> },
    /// From sets of rows, times a factor, and what the errors took at so many degrees of freedom; and what is stated of places.
    Sets { factor: f64, sets: Sets, left: f64, of_stated: Option<Mat<f64>> },
    /// It is this.
    Serial { product: Mat<f64>, degrees_of_freedom: f64 },
}

impl Solver<'_> {
    /// How uncertain the end of a course is, and what rows were found to share; `weight` is that of each row.
    pub(super) fn uncertainty(
        &self,
        course: &Course,
        weight: &[f64],
    ) -> Result<(Uncertainty, Shared), FitError> {
        let (subspace, rest, tally) = (&course.subspace, &course.point.rest, &course.point.sweep.tally);
        let (kept, used) = (self.kept_components(weight) as f64, self.used(course));
        let left = kept - used;
        let full = self.unweighted_at(course, weight)?;
        let known = self.options.noise.known();
        // Of variances, what was found over what the weights assume.
        let found = tally.variance_factor(kept, used);
        let level = if known.is_some() { 1.0 } else { self.level(course) };
        let has_statement = known.is_some() || self.states_noise();
        let efficiency = if course.weighting == Weighting::Biweight { robust::EFFICIENCY } else { 1.0 };
        let stated = has_statement.then(|| Stated::compared(found * efficiency * level, left.max(0.0)));
        let agrees = stated.is_some_and(|stated| stated.agreement == Agreement::Agrees);
        let mut root = subspace.covariance_root(&full, rest);
        let found_noise = self.shared(course, weight, &root)?;
        let spread = if let Some(groups) = self.buckets(&self.observations.units()) {
            root = subspace.covariance_root(&self.partial(&course.point.sweep), rest);
            let Coordinates { q, residual, of_stated } = self.coordinates(course, weight, &root)?;
            // Weights move along with residuals, and by so much more the estimates.
            let clusters = Clusters::new(shares(&q, &residual, &groups));
            let crossed = match &found_noise {
                Shared::Offsets(offsets, own) if offsets.crossed => {
                    let (product, degrees_of_freedom) = offsets.covariance(&q);
                    Some((product * faer::Scale(own * own * tally.stride().powi(2)), degrees_of_freedom))
                }
                _ => None,
            };
            let beside = crossed.into_iter().chain(of_stated.map(taken_at_their_word)).collect();
            Spread::Groups { factor: tally.stride().powi(2), clusters, beside }
        } else if let Shared::Memory(memory, _) = &found_noise {
            let degrees_of_freedom = (memory.independent - used).max(LEAST);
            Spread::Serial { product: &memory.product * faer::Scale(found.max(1.0)), degrees_of_freedom }
        } else if agrees {
            Spread::Even { factor: 1.0 / level / efficiency, degrees_of_freedom: f64::INFINITY }
        } else if left < 1.0 {
            Spread::Unknown
        } else if let Some(objects) = self.objects(&course.point.sweep) {
            // How far off a plane a point is hangs on how it was hit, and across a beam on the range, while along it does not:
            // no variance of the joints is that of every component.
            root = subspace.covariance_root(&self.partial(&course.point.sweep), rest);
            let Coordinates { q, residual, of_stated } = self.coordinates(course, weight, &root)?;
            let followed = self.followed(course, weight, &root, objects)?;
            let taken = Mat::from_fn(q.nrows(), q.ncols(), |row, column| {
                followed[row].by_unknowns * q[(row, column)]
            });
            let of_component = self.layout.row_of_each().map(|row| row % SETS_OF_ROWS).collect();
            let shares = shares(&q, &residual, &Buckets { of_component, count: SETS_OF_ROWS });
            let squares: f64 = residual.iter().map(|value| value * value).sum();
            let sets = Sets::new(shares, &(q.transpose() * taken), squares / left);
            Spread::Sets { factor: tally.stride().powi(2), sets, left, of_stated }
        } else if left < MANY && self.layout.kinds > 1 {
            let pools = Pools::of(self.observations, &self.layout, used);
            let of_component = self.layout.kind_of_each().map(|kind| pools.of_kind[kind]).collect();
            let count = pools.count();
            let counted: Vec<f64> = weight.iter().map(|weight| f64::from(u8::from(*weight > 0.0))).collect();
            let Coordinates { q, residual, of_stated } = self.coordinates(course, &counted, &root)?;
            let shares = shares(&q, &residual, &Buckets { of_component, count });
            let of = |share: Share| {
                let used: f64 = (0..share.score.len()).map(|at| share.gram[(at, at)]).sum();
                (share.gram, (share.count - used).max(1.0))
            };
            // The factor is that of the rows.
            let stated = of_stated.map(|gram| taken_at_their_word(gram * faer::Scale(1.0 / found)));
            Spread::Pools { factor: found, pools: shares.into_iter().map(of).chain(stated).collect() }
        } else {
            Spread::Even { factor: found, degrees_of_freedom: left }
        };
        let by_prior = root.transpose() * subspace.precision_root(rest);
        let k = root.ncols();
        let uncertainty = Uncertainty {
            data: Mat::<f64>::identity(k, k) - &by_prior * by_prior.transpose(),
            prior: &root * by_prior,
            root,
            spread,
            beside: self.beside_inputs(course, weight)?,
            left,
            stated,
        };
        Ok((uncertainty, found_noise))
    }

    /// What rows share that the fit took for independent: an offset of their group, or a memory of the row before.
    fn shared(&self, course: &Course, weight: &[f64], root: &Mat<f64>) -> Result<Shared, FitError> {
        let options = &self.options.noise;
        let declared = self.observations.in_sequence;
        if !options.serial && self.groups().is_none() {
            return Ok(Shared::Nothing);
        }
        let counted: Vec<f64> = weight.iter().map(|weight| f64::from(u8::from(*weight > 0.0))).collect();
        let sigma = course.noise.sigma_without_memory();
        // The columns of all rows take more memory than all else; most data need none.
        let axes = noise::space::axes(self.observations);
        let nothing = |values: &[f64]| serial::is_white(&self.layout, values, axes.as_deref());
        if self.groups().is_none() && nothing(&self.whitened(course, &counted)) {
            return Ok(Shared::Nothing);
        }
        let Coordinates { q, residual: e, .. } = self.coordinates(course, &counted, root)?;
        let beside =
            |most| trend::beside(self.chain, self.observations, &self.layout, &sigma, weight, &q, most);
        let (few, complete) = beside(trend::MOST[0]);
        if options.serial && (declared || self.groups().is_none()) {
            let fitted = |beside: &Mat<f64>| serial::fit(&self.layout, &e, &q, beside, axes.as_deref());
            let alone = trend::determined(&q);
            if let Some(memory) = fitted(if options.beside_effects { &few } else { &alone }) {
                let certain = complete || declared || !options.beside_effects;
                let thorough =
                    if certain { None } else { Some(beside(trend::MOST[1])).filter(|found| found.1) };
                let (memory, certain) = match thorough.and_then(|(all, _)| fitted(&all)) {
                    Some(memory) => (memory, true),
                    None => (memory, certain),
                };
                // Where a missing effect could look alike, only the uncertainties know of a memory that nobody declared.
                let order = match (declared, certain) {
                    (true, _) => Order::Declared,
                    (false, true) => Order::OfFile,
                    (false, false) => Order::Doubtful,
                };
                return Ok(Shared::Memory(memory, order));
            }
        }
        let of_groups =
            self.groups().and_then(|_| session::fit(&self.layout, self.observations, weight, &e, &few));
        Ok(of_groups.map_or(Shared::Nothing, |(offsets, own)| Shared::Offsets(offsets, own)))
    }

    /// The factor of all rows that have any weight, each with its full one, whitened but for serial correlation. Those that are set
    /// aside may be all of a station, and what only they would tell nobody knows.
    fn unweighted_at(&self, course: &Course, weight: &[f64]) -> Result<Partial, FitError> {
        if course.weighting == Weighting::Full {
            return Ok(self.partial(&course.point.sweep));
        }
        let aside: Vec<bool> = weight.iter().map(|&weight| weight == 0.0).collect();
        let (values, noise) = (&course.point.values, &course.noise);
        Ok(self.partial(&self.sweep_without(&aside, values, noise, Weighting::Full)?))
    }

    /// Whether all rows state their noise, or the caller states one for all.
    fn states_noise(&self) -> bool {
        let observations = self.observations;
        let every = !observations.poses.series.is_empty()
            && observations.poses.series.iter().all(|series| observations.states_sigma(series));
        self.options.noise.stated.is_some() || every
    }

    /// The mean over all components of the variance that was found over that which is stated.
    fn level(&self, course: &Course) -> f64 {
        let stated = noise::stated(&self.options.noise, self.observations, &self.layout);
        let unit = self.options.noise.stated.filter(|_| self.observations.sigma.is_empty()).unwrap_or(1.0);
        let sigma = course.noise.sigma_without_memory();
        let ratios =
            sigma.iter().zip(noise::each(&stated)).map(|(sigma, stated)| (sigma / stated / unit).powi(2));
        ratios.sum::<f64>() / (sigma.len() as f64).max(1.0)
    }

    /// The groups of the components, where rows share any and there are several.
    fn groups(&self) -> Option<Buckets> {
        self.buckets(&self.observations.groups)
    }

    /// The units of the components, where several rows have one and there are several.
    fn buckets(&self, groups: &[u32]) -> Option<Buckets> {
        let mut known: Vec<u32> = groups.to_vec();
        known.sort_unstable();
        known.dedup();
        if known.len() < 2 || known.len() >= groups.len() {
            return None;
        }
        // Groups of groups are as independent, and still many.
        let count = known.len().min(MANY_GROUPS);
        let bucket = |row: usize| match known.binary_search(&groups[row]) {
            Ok(bucket) => bucket * count / known.len(),
            Err(_) => unreachable!("`known` holds every group of a row"),
        };
        Some(Buckets { of_component: self.layout.row_of_each().map(bucket).collect(), count })
    }
}

/// What each bucket of components has part in.
fn shares(q: &Mat<f64>, residual: &[f64], buckets: &Buckets) -> Vec<Share> {
    let k = q.ncols();
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); buckets.count];
    for (at, &bucket) in buckets.of_component.iter().enumerate() {
        // What is set aside is zero throughout.
        if residual[at] != 0.0 || (0..k).any(|j| q[(at, j)] != 0.0) {
            members[bucket].push(at);
        }
    }
    let share = |own: Vec<usize>| {
        let mut rows = Mat::<f64>::zeros(own.len(), k);
        for j in 0..k {
            let column = q.col_as_slice(j);
            rows.col_as_slice_mut(j).iter_mut().zip(&own).for_each(|(to, &at)| *to = column[at]);
        }
        let left = Mat::from_fn(own.len(), 1, |row, _| residual[own[row]]);
        let score = rows.transpose() * left;
        Share {
            gram: rows.transpose() * &rows,
            score: score.col_as_slice(0).to_vec(),
            count: own.len() as f64,
        }
    };
    parallel::each_of(members, share)
}

/// Which of some sets each component belongs to.
struct Buckets {
    of_component: Vec<usize>,
    count: usize,
}

impl Uncertainty {
    /// Components with weight, less what the estimates use up.
    pub fn degrees_of_freedom(&self) -> f64 {
        self.left
    }

    /// What each input of the reference does to the estimates.
    pub fn of_reference(self) -> Vec<FromReference> {
        self.beside.map_or_else(Vec::new, |beside| beside.parts)
    }

    /// The stated noise beside that of the residuals.
    pub fn stated(&self) -> Option<Stated> {
        self.stated
    }

    /// The covariance of the estimates, p × p, SI; infinite where nothing is known of it.
    pub fn covariance(&self) -> Mat<f64> {
        let of_data = match &self.spread {
            Spread::Unknown => {
                let p = self.root.nrows();
                return Mat::from_fn(p, p, |row, column| if row == column { f64::INFINITY } else { 0.0 });
            }
            Spread::Even { factor, .. } | Spread::Pools { factor, .. } => {
                &self.root * &self.data * self.root.transpose() * faer::Scale(*factor)
            }
            Spread::Groups { factor, clusters, beside } => {
                let own = &self.root * clusters.scores();
                let of_groups = &own * own.transpose() * faer::Scale(*factor);
                let added = beside.iter().map(|(product, _)| &self.root * product * self.root.transpose());
                added.fold(of_groups, |sum, own| sum + own)
            }
            Spread::Sets { factor, sets, of_stated, .. } => {
                let [shown, by_errors] = sets.parts();
                let product = (shown + by_errors) * faer::Scale(*factor);
                let whole = of_stated.iter().fold(product, |sum, own| sum + own);
                &self.root * whole * self.root.transpose()
            }
            Spread::Serial { product, .. } => &self.root * product * self.root.transpose(),
        };
        let own = of_data + &self.prior * self.prior.transpose();
        let Some(beside) = &self.beside else { return own };
        beside.parts.iter().fold(own + &beside.noise, |sum, part| sum + part.covariance())
    }

    /// Per parameter the degrees of freedom of its variance.
    pub fn of_parameters(&self) -> Vec<f64> {
        let p = self.root.nrows();
        (0..p).map(|at| self.along(&[(at, 1.0)]).1).collect()
    }

    /// The combinations that the data determine, with their values at these values of all symbols.
    pub fn estimable(&self, subspace: &Subspace, parameters: &[SymbolId], values: &[f64]) -> Vec<Estimable> {
        let of = |parts: Vec<(usize, f64)>| {
            let (variance, degrees_of_freedom) = self.along(&parts);
            Estimable {
                value: parts.iter().map(|&(at, factor)| factor * values[parameters[at].index()]).sum(),
                standard_uncertainty: Some(variance.sqrt()).filter(|uncertainty| uncertainty.is_finite()),
                degrees_of_freedom,
                combination: parts.into_iter().map(|(at, factor)| (parameters[at], factor)).collect(),
            }
        };
        subspace.combinations().into_iter().map(of).collect()
    }

    /// The variance of a combination of parameters, SI, and its degrees of freedom.
    fn along(&self, parts: &[(usize, f64)]) -> (f64, f64) {
        let through = |matrix: &Mat<f64>| -> Vec<f64> {
            (0..matrix.ncols())
                .map(|j| parts.iter().map(|&(at, factor)| factor * matrix[(at, j)]).sum())
                .collect()
        };
        let square = |vector: &[f64]| vector.iter().map(|value| value * value).sum::<f64>();
        let form = |matrix: &Mat<f64>, a: &[f64]| {
            let column = Mat::from_fn(a.len(), 1, |row, _| a[row]);
            (column.transpose() * (matrix * &column))[(0, 0)]
        };
        let by_prior = square(&through(&self.prior));
        let a = through(&self.root);
        let (by_data, degrees_of_freedom) = match &self.spread {
            Spread::Unknown => (f64::INFINITY, 0.0),
            Spread::Even { factor, degrees_of_freedom } => {
                (factor * form(&self.data, &a), *degrees_of_freedom)
            }
            Spread::Pools { factor, pools } => {
                let (sum, free) = together(pools.iter().map(|(gram, own)| (form(gram, &a), *own)));
                (factor * sum, if sum > 0.0 { free } else { self.left })
            }
            Spread::Groups { factor, clusters, beside } => {
                let along = Mat::from_fn(1, a.len(), |_, at| a[at]) * clusters.scores();
                let own = (factor * along.squared_norm_l2(), clusters.degrees_of_freedom(&a));
                let beside = beside.iter().map(|(product, free)| (form(product, &a), *free));
                if beside.len() > 0 { together(std::iter::once(own).chain(beside)) } else { own }
            }
            Spread::Sets { factor, sets, left, of_stated } => {
                let [shown, by_errors] = sets.parts().map(|part| factor * form(part, &a));
                let own = [(shown, sets.degrees_of_freedom(&a)), (by_errors, *left)];
                let stated = of_stated.iter().map(|own| (form(own, &a), f64::INFINITY));
                together(own.into_iter().chain(stated))
            }
            Spread::Serial { product, degrees_of_freedom } => (form(product, &a), *degrees_of_freedom),
        };
        let own = by_data + by_prior;
        let Some(beside) = self.beside.as_ref().filter(|_| own.is_finite()) else {
            return (own, degrees_of_freedom);
        };
        let of_noise = variance_of(parts, |i, j| beside.noise[(i, j)]).max(0.0);
        let stated: f64 = beside.parts.iter().map(|part| part.contribution(parts).powi(2)).sum();
        together([(own + of_noise, degrees_of_freedom), (stated, f64::INFINITY)].into_iter())
    }
}

/// What stated places add to a covariance: as much as is stated, which is as sure as anything here.
fn taken_at_their_word(gram: Mat<f64>) -> (Mat<f64>, f64) {
    (gram, f64::INFINITY)
}

/// The sum of independent estimates of variances, and its degrees of freedom.
///
/// Source: F. E. Satterthwaite, Biometrics Bulletin 2 (1946) 110-114.
fn together(parts: impl Iterator<Item = (f64, f64)>) -> (f64, f64) {
    let (sum, squares) = parts.fold((0.0, 0.0), |(sum, squares), (part, own)| {
        (sum + part, if part > 0.0 { squares + part * part / own } else { squares })
    });
    // What is sure by statement alone has no part that scatters.
    (sum, if sum > 0.0 { sum * sum / squares } else { 0.0 })
}
