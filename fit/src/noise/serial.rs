//! What an observation remembers of the one before: AR(1), ARMA(1,1) or white noise with a random walk, by restricted maximum
//! likelihood, each only if it earns its place against white noise.
//!
//! Source: D. A. Harville, Maximum likelihood approaches to variance component estimation, Journal of the American Statistical
//! Association 72 (1977) 320-338, for the restricted likelihood, which knows what the fit took out of the residuals; C. M.
//! Hurvich, C.-L. Tsai, Biometrika 76 (1989) 297-307, for the price of parameters in few observations (AICc).

use faer::{Mat, Side};

use super::space::Filter;
use super::{Carried, Layout, Run, Serial};

/// Components below which no serial correlation is looked for.
pub const FEWEST: usize = 30;

/// Components from which on what the fit took out of the residuals makes no difference.
pub(super) const MANY: usize = 50_000;

/// Values further out than this count as this far, so that outliers do not decide.
const CLIP: f64 = 3.0;

/// Coefficients of the value before that are tried, below the largest.
const AUTOREGRESSIVE: [f64; 10] = [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98];

/// Coefficients of the innovation before that are tried, as shares of the other coefficient below zero, and as they are above.
const MOVING_AVERAGE: [f64; 7] = [-0.95, -0.9, -0.82, -0.7, -0.5, -0.25, 0.4];

/// Twice the logarithm of the likelihood that memory must gain over white noise.
///
/// Source: the upper 1 % point of the chi-squared distribution with two degrees of freedom.
const EARNS: f64 = 9.21;

/// No memory.
const WHITE: Serial = Serial { autoregressive: 0.0, moving_average: 0.0 };

/// Rows of a run whose part of a product is made at once.
const PIECE: usize = 8192;

/// Of many rows, models are told apart first in so many stretches of so many components.
const STRETCHES: usize = 50;
const STRETCH: usize = 4_000;

/// A model that is less likely by so much in the stretches, as twice a logarithm, is so in all rows.
const RULED_OUT: f64 = 50.0;

/// Neighbours that hang together by less than so many standard deviations of chance are not looked at closely.
const LOOKED_AT: f64 = 1.0;

/// Serial correlation that was found.
#[derive(Debug, Clone)]
pub struct Memory {
    /// The likeliest model.
    pub serial: Serial,
    /// What whitens by it, where it is one of axes that stand still in space.
    pub in_space: Option<Filter>,
    /// Standard deviation of its innovations, in units of the values.
    pub innovation: f64,
    /// QᵀVQ, V the covariance of the values: the mean over all models, each weighed by its likelihood, so that what is not
    /// known of the model is in it. k × k.
    pub product: Mat<f64>,
    /// Of how many independent values the square tells as much as that of all of them.
    ///
    /// Source: G. V. Bayley, J. M. Hammersley, The effective number of independent observations in an autocorrelated time series,
    /// Supplement to the Journal of the Royal Statistical Society 8 (1946) 184-197.
    pub independent: f64,
}

/// A memory in the residuals' own axes, or in those of space.
#[derive(Debug, Clone)]
pub struct Model {
    /// How residuals of consecutive rows depend on each other.
    pub serial: Serial,
    /// The axes of space that the memory is in; `None` for the residuals' own.
    pub in_space: Option<Filter>,
}

impl Model {
    /// Turns values into innovations in place.
    pub fn whiten(&self, column: &mut [f64], runs: &[Run]) {
        for &run in runs {
            match &self.in_space {
                Some(filter) => filter.whiten(column, run),
                None => self.serial.whiten(column, run),
            }
        }
    }

    /// ln |V| of values whose innovations have variance one.
    pub fn ln_determinant(&self, runs: &[Run]) -> f64 {
        match &self.in_space {
            Some(filter) => filter.ln_determinant(),
            // Only the first value of each run is scaled.
            None => runs.iter().map(|run| 2.0 * run.stride as f64 * self.serial.gain().ln()).sum(),
        }
    }
}

/// A model before it is made: its filter takes as much memory as the rows.
#[derive(Debug, Clone, Copy)]
struct Kind {
    serial: Serial,
    in_space: bool,
    /// The number of its coefficients.
    coefficients: f64,
}

impl Kind {
    /// In the residuals' own axes, and in those of space where they differ.
    fn all(length: usize, has_axes: bool) -> impl Iterator<Item = Self> {
        let spaces: &[bool] = if has_axes { &[false, true] } else { &[false] };
        spaces.iter().flat_map(move |&in_space| {
            serials(length).map(move |(serial, coefficients)| Self { serial, in_space, coefficients })
        })
    }

    fn model(&self, axes: Option<&[[f64; 3]]>, runs: &[Run]) -> Option<Model> {
        let Self { serial, in_space, .. } = *self;
        let in_space = if in_space { Some(Filter::new(serial, axes?, runs)?) } else { None };
        Some(Model { serial, in_space })
    }
}

/// A model, and how likely it is.
struct Tried {
    kind: Kind,
    /// −2 ln of the restricted likelihood, and AICc.
    deviance: f64,
    criterion: f64,
    innovation: f64,
}

/// What the data bear out of the serial correlation of values, in order; `q` holds the orthonormal columns that were fitted to
/// them (n × k), `beside` those with what else they may hold, and `axes` the [axes](super::space::axes) of the components.
#[must_use]
pub fn fit(
    layout: &Layout,
    values: &[f64],
    q: &Mat<f64>,
    beside: &Mat<f64>,
    axes: Option<&[[f64; 3]]>,
) -> Option<Memory> {
    let length = longest(&layout.runs)?;
    if values.len() < FEWEST + beside.ncols() || length < 4 || looks_white(layout, values, axes) {
        return None;
    }
    let problem = Problem::new(&layout.runs, axes, values, beside);
    let white = problem.tried(Kind { serial: WHITE, in_space: false, coefficients: 0.0 })?;
    let kinds = shortlist(layout, values, axes, Kind::all(length, axes.is_some()).collect());
    let tried = parallel::each_of(kinds, |kind| problem.tried(kind));
    let tried: Vec<Tried> = tried.into_iter().flatten().collect();
    let best = tried.iter().min_by(|a, b| a.criterion.total_cmp(&b.criterion))?;
    if white.deviance - best.deviance < EARNS || best.criterion >= white.criterion {
        return None;
    }
    let (Model { serial, in_space }, innovation, least) =
        (best.kind.model(axes, &layout.runs)?, best.innovation, best.criterion);
    let mut product = Mat::zeros(q.ncols(), q.ncols());
    let mut sum = 0.0;
    for model in tried {
        let weight = (0.5 * (least - model.criterion)).exp();
        if weight > 0.01 {
            sum += weight;
            product += faer::Scale(weight) * problem.product(&model, q)?;
        }
    }
    product *= faer::Scale(1.0 / sum);
    // Source of the correlations: Box and Jenkins, Time Series Analysis, equation (3.4.7).
    let (phi, theta) = (serial.autoregressive, serial.moving_average);
    let first = (1.0 + phi * theta) * (phi + theta) / (1.0 + 2.0 * phi * theta + theta * theta);
    let squares = first * first / (1.0 - phi * phi) * (1.0 - phi.powi(2 * length as i32));
    Some(Memory {
        serial,
        in_space,
        innovation,
        product,
        independent: values.len() as f64 / (1.0 + 2.0 * squares),
    })
}

/// Whether neighbours among the values hang together so little that no memory is looked for.
fn looks_white(layout: &Layout, values: &[f64], axes: Option<&[[f64; 3]]>) -> bool {
    neighbours(layout, values, axes) < LOOKED_AT
}

/// Whether no memory can come of the values: neighbours hang together too little for it to be looked for or, of many rows, no
/// model earns its place. Nobody needs the columns that were fitted to them then.
#[must_use]
pub fn is_white(layout: &Layout, values: &[f64], axes: Option<&[[f64; 3]]>) -> bool {
    let none = Mat::zeros(values.len(), 0);
    looks_white(layout, values, axes)
        || values.len() > MANY && fit(layout, values, &none, &none, axes).is_none()
}

/// Of many rows the models that some stretches of them do not rule out, and those that remember longer than a stretch.
fn shortlist(layout: &Layout, values: &[f64], axes: Option<&[[f64; 3]]>, kinds: Vec<Kind>) -> Vec<Kind> {
    let stretches = stretches(&layout.runs, values.len());
    if stretches.is_empty() {
        return kinds;
    }
    let mut runs = Vec::new();
    let (mut own, mut own_axes) = (Vec::new(), Vec::new());
    for stretch in &stretches {
        let start = own.len();
        own.extend(&values[stretch.start..stretch.end]);
        own_axes.extend(axes.into_iter().flat_map(|axes| &axes[stretch.start..stretch.end]));
        runs.push(Run { start, end: own.len(), ..*stretch });
    }
    let problem = Problem::new(&runs, axes.map(|_| own_axes.as_slice()), &own, &Mat::zeros(own.len(), 0));
    let tried = parallel::each_of(kinds, |kind| (kind, problem.tried(kind)));
    let deviances = tried.iter().filter_map(|(_, tried)| Some(tried.as_ref()?.deviance));
    let least = deviances.fold(f64::INFINITY, f64::min);
    let is_listed = |(kind, tried): &(Kind, Option<Tried>)| {
        kind.serial.autoregressive > AUTOREGRESSIVE[AUTOREGRESSIVE.len() - 1]
            || tried.as_ref().is_some_and(|tried| tried.deviance <= least + RULED_OUT)
    };
    tried.into_iter().filter(is_listed).map(|(kind, _)| kind).collect()
}

/// Stretches of runs from all over so many components; none where these are few.
fn stretches(runs: &[Run], components: usize) -> Vec<Run> {
    if components <= 2 * STRETCH * STRETCHES {
        return Vec::new();
    }
    let each = components / STRETCHES;
    let of_run = |run: &Run| {
        let run = *run;
        (run.start..run.end).step_by(each / run.stride * run.stride).map(move |start| Run {
            start,
            end: run.end.min(start + STRETCH / run.stride * run.stride),
            ..run
        })
    };
    runs.iter().flat_map(of_run).collect()
}

/// The models that are tried on runs of at most so many rows, each with its number of coefficients: in the residuals' own axes,
/// and in those of space where they differ.
pub fn models<'a>(
    length: usize,
    runs: &'a [Run],
    axes: Option<&'a [[f64; 3]]>,
) -> impl Iterator<Item = (Model, f64)> + 'a {
    Kind::all(length, axes.is_some())
        .filter_map(move |kind| Some((kind.model(axes, runs)?, kind.coefficients)))
}

fn serials(length: usize) -> impl Iterator<Item = (Serial, f64)> {
    // Away from the circle by what so many rows can tell: at this coefficient a run remembers its beginning.
    let largest = 1.0 - 1.0 / length as f64;
    AUTOREGRESSIVE.into_iter().filter(move |phi| *phi < largest).chain([largest]).flat_map(move |phi| {
        // A random walk has no coefficient to choose.
        let free = if phi == largest { 0.0 } else { 1.0 };
        let with = move |moving_average: f64| Serial { autoregressive: phi, moving_average };
        let mixed = MOVING_AVERAGE.into_iter().map(move |share| {
            let theta = if share < 0.0 { share * phi } else { share };
            (with(theta), 1.0 + free)
        });
        std::iter::once((with(0.0), 1.0)).chain(mixed)
    })
}

/// Rows of the longest run.
pub fn longest(runs: &[Run]) -> Option<usize> {
    runs.iter().map(|run| (run.end - run.start) / run.stride.max(1)).max()
}

/// The correlation of each value with the one before, in standard deviations of what chance makes: by component, or in space.
fn neighbours(layout: &Layout, values: &[f64], axes: Option<&[[f64; 3]]>) -> f64 {
    let clipped: Vec<f64> = values.iter().map(|value| value.clamp(-CLIP, CLIP)).collect();
    let square = clipped.iter().map(|value| value * value).sum::<f64>() / clipped.len() as f64;
    let correlation = |between: &dyn Fn(usize, usize, usize) -> f64| {
        let (mut products, mut variance) = (0.0, 0.0);
        for run in &layout.runs {
            for row in (run.start + run.stride..run.end).step_by(run.stride) {
                for (a, b) in
                    (row..row + run.stride).flat_map(|a| (row - run.stride..row).map(move |b| (a, b)))
                {
                    let between = between(a, b, run.stride);
                    products += between * clipped[a] * clipped[b];
                    variance += between * between;
                }
            }
        }
        if square > 0.0 && variance > 0.0 { products / square / variance.sqrt() } else { 0.0 }
    };
    let own = correlation(&|a, b, stride| if a == b + stride { 1.0 } else { 0.0 });
    let in_space =
        |axes: &[[f64; 3]]| correlation(&|a, b, _| axes[a].iter().zip(&axes[b]).map(|(a, b)| a * b).sum());
    axes.map_or(own, |axes| own.max(in_space(axes)))
}

/// The values and what was fitted to them.
struct Problem<'a> {
    runs: &'a [Run],
    axes: Option<&'a [[f64; 3]]>,
    /// Columns that were fitted, then the values.
    columns: Mat<f64>,
}

impl<'a> Problem<'a> {
    fn new(runs: &'a [Run], axes: Option<&'a [[f64; 3]]>, values: &[f64], q: &Mat<f64>) -> Self {
        let k = if values.len() > MANY { 0 } else { q.ncols() };
        let columns = Mat::from_fn(values.len(), k + 1, |row, column| {
            if column == k { values[row].clamp(-CLIP, CLIP) } else { q[(row, column)] }
        });
        Self { runs, axes, columns }
    }

    /// How likely a model is; `None` where its columns are not independent, or where no noise is like it.
    fn tried(&self, kind: Kind) -> Option<Tried> {
        let model = kind.model(self.axes, self.runs)?;
        let mut white = self.columns.clone();
        (0..white.ncols()).for_each(|j| model.whiten(white.col_as_slice_mut(j), self.runs));
        let gram = white.transpose() * &white;
        let factor = gram.llt(Side::Lower).ok()?;
        let l = factor.L();
        let (n, k) = (white.nrows() as f64, white.ncols() - 1);
        let ln_columns: f64 = (0..k).map(|at| 2.0 * l[(at, at)].ln()).sum();
        let left = n - k as f64;
        let innovation = l[(k, k)] / left.sqrt();
        let deviance = left * (innovation * innovation).ln() + model.ln_determinant(self.runs) + ln_columns;
        // The size of the innovations is a parameter too.
        let price = kind.coefficients + 1.0;
        let criterion = deviance + 2.0 * price * left / (left - price - 1.0).max(1.0);
        deviance.is_finite().then_some(Tried { kind, deviance, criterion, innovation })
    }

    /// QᵀVQ for a model, piece by piece of the runs: a root of V times Q would be larger than Q.
    fn product(&self, tried: &Tried, q: &Mat<f64>) -> Option<Mat<f64>> {
        let Model { serial, in_space } = tried.kind.model(self.axes, self.runs)?;
        let mut product = Mat::<f64>::zeros(q.ncols(), q.ncols());
        for run in self.runs {
            let mut after = vec![Carried::default(); q.ncols()];
            let starts = (run.start..run.end).step_by(PIECE * run.stride);
            for start in starts.rev() {
                let piece = Run { start, end: run.end.min(start + PIECE * run.stride), ..*run };
                let begins = start == run.start;
                let coloured = |j: usize, after: &mut Carried| match &in_space {
                    Some(filter) => filter.coloured(q.col_as_slice(j), piece, after, begins),
                    None => {
                        let mut column = q.col_as_slice(j)[piece.start..piece.end].to_vec();
                        serial.colour(&mut column, piece.stride, after, begins);
                        column
                    }
                };
                let columns =
                    parallel::each_of(after.iter_mut().enumerate(), |(j, after)| coloured(j, after));
                let rows = columns.first().map_or(0, Vec::len);
                let all = Mat::from_fn(rows, columns.len(), |row, column| columns[column][row]);
                product += all.transpose() * &all;
            }
        }
        let deviation = tried.innovation * serial.gain();
        Some(product * faer::Scale(deviation * deviation))
    }
}
