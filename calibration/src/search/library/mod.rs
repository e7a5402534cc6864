//! The library: functions of one reading at one place that no family spells out, against the effects that were accepted.
//!
//! Three harmonics and a scale can follow any step; that does not make them four effects. At every place where an effect was
//! accepted, and at the most conspicuous place of what is left, each shape of the library competes with what the catalogue
//! made of it; the simplest that the data ask for is taken up, as sums of ramps.
//!
//! Source of the price of a choice: J. Chen and Z. Chen, "Extended Bayesian information criteria for model selection with
//! large model spaces", Biometrika 95 (2008).

mod grid;
mod refine;
mod shape;

use faer::Mat;
use model_core::{Chain, SymbolId, SymbolKind};

use self::grid::Driver;
use self::refine::{Gain, refined};
pub(crate) use self::refine::{orthonormal, take_out};
pub(crate) use self::shape::{Shape, ShapeKind};
use super::competing::AS_GOOD;
use super::contest::{Contender, Price, contender, criterion, likelihood, predicts};
use super::flips::familywise;
use super::scan::{Left, Sheet};
use super::signs::Signs;
use crate::search::SearchError;
use crate::search::columns::Columns;
use crate::search::context::{Context, declared};
use crate::search::round::Round;
use crate::search::search_problem::least_of_function;
use effects::candidate::{Dependence, Effect, Function, Place};
use effects::families::{SHAPE, SmoothPlace, smooth};

/// Penalised log-likelihood by which a function must beat what the catalogue made of it: six units of Schwarz's criterion.
const BETTER: f64 = 3.0;

/// The share of the accepted false alarms that functions at places without an accepted effect may have.
const OWN_SHARE: f64 = 0.2;

/// Functions that are held to rows that were held out, the likeliest first.
const CONFIRMED: usize = 8;

/// Stretches of rows in their order that a function of an input must predict, each from the others.
const STRETCHES: usize = 10;

/// Rows that a function hangs on at least, as an effective number.
const FEWEST_BEHIND: f64 = 8.0;

/// Shapes of one place whose thresholds are refined.
const REFINED: usize = 4;

/// A function that follows the accepted effects more closely than so, as a share of what they do, is theirs by another name.
const SAME_FORM: f64 = 0.15;

/// Bumps of the scan, by their widths as shares of the range, steps, and the stretches of its tables.
const SCANNED_BUMPS: [(usize, f64); 2] = [(60, 0.012), (24, 0.05)];
const SCANNED_STEPS: usize = 24;
const SCANNED_TABLES: [usize; 2] = [6, 12];

/// A function that explains the data better than what the catalogue made of it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Taken {
    pub place: Place,
    pub driver: SymbolId,
    pub shape: Shape,
    /// Accepted effects that stay beside it, by their number among those found.
    pub kept: Vec<usize>,
    /// Familywise p of the scan of what was left, or the smallest of the effects that it replaces.
    pub p_value: f64,
    /// What it leaves of these data over what the accepted model leaves, root mean square.
    pub leaves: f64,
}

/// A function that explains the data about as well as accepted effects that it would replace.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AsGood {
    pub place: Place,
    pub driver: SymbolId,
    pub kind: ShapeKind,
    /// The accepted effects that it would replace, by their number among those found.
    pub instead_of: Vec<usize>,
    /// Whether it is another function over these data, so that they do not determine the form.
    pub differs: bool,
}

impl AsGood {
    /// `step of alpha in mirror about z`
    pub fn name(&self, chain: &Chain) -> String {
        let (driver, body) = (&chain.symbol(self.driver).name, &chain.body(self.place.body).name);
        format!("{} of {driver} in {body} {}", self.kind.words(), self.place.freedom.words())
    }
}

/// What the library made of a fit.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Contest {
    pub taken: Option<Taken>,
    pub as_good: Vec<AsGood>,
}

/// A shape at a place, judged.
struct Judged {
    smooth: SmoothPlace,
    shape: Shape,
    fitted: Contender,
}

/// Lets the library compete with what was accepted, and with nothing at the most conspicuous place of what is left.
pub(crate) fn contest(whole: &Context<'_>, last: &Round<'_>) -> Result<Contest, SearchError> {
    let observations = &*last.search.rows.observations;
    let chain = &last.fitted.chain;
    let mut smooths = smooth(&whole.setting);
    let mut symbols: Vec<SymbolId> = smooths.iter().map(|smooth| smooth.driver).collect();
    symbols.sort_unstable();
    symbols.dedup();
    let drivers: Vec<Driver> = symbols
        .into_iter()
        .filter_map(|id| Driver::of(whole.setting.chain, &observations.poses, id))
        .collect();
    let mut places: Vec<Place> = smooths.iter().map(|smooth| smooth.place).collect();
    places.sort_unstable();
    places.dedup();
    let columns = Columns::at(chain, observations, declared(whole), &last.fitted.fit.values, &places)?;
    smooths.retain(|smooth| {
        columns.probe(smooth.place).is_some() && drivers.iter().any(|driver| driver.symbol == smooth.driver)
    });

    let problem = last.search.of_functions();
    let (shown, accepted): (Vec<usize>, Vec<Vec<usize>>) = last.shown_to_functions().into_iter().unzip();
    let signs = Signs::scattered(problem.group_of_row(), whole.options.flips, whole.options.seed);
    let mut left = Left::new(problem, &accepted, &signs);
    let of = |number: usize| &whole.catalogue[last.fitted.found[number].effect];
    left.thresholds = shown.iter().map(|&number| thresholds(of(number))).collect();
    let library = Library { whole, last, columns, drivers, left, shown };

    let scan = library.left.scan(smooths.len(), |number| library.sheet_of_scan(smooths[number]));
    let p_value = familywise(scan.best, &scan.chance);
    let alarm = p_value <= OWN_SHARE * whole.options.false_alarm;
    let most = if alarm { scan.most_conspicuous().map(|number| smooths[number]) } else { None };

    let places = smooths.len();
    smooths.retain(|smooth| Some(*smooth) == most || library.accepted_at(*smooth).next().is_some());
    let judged = parallel::each_of(&smooths, |smooth| library.judged(*smooth, places));
    let judged: Vec<Judged> = judged.into_iter().flatten().collect();
    Ok(library.verdict(judged, most, p_value))
}

/// Thresholds that the data chose for an effect, beside its coefficients.
fn thresholds(effect: &Effect) -> usize {
    let is = |kind: &ShapeKind| effect.form == Dependence::from(kind.words());
    match effect.family {
        SHAPE if [ShapeKind::Ramp, ShapeKind::Bump, ShapeKind::Plateau].iter().any(is) => 2,
        SHAPE if [ShapeKind::Powers, ShapeKind::Table].iter().any(is) => 0,
        // A step, or where a wave starts.
        SHAPE => 1,
        _ => 0,
    }
}

/// Everything that the contest reads.
struct Library<'a, 'b> {
    whole: &'a Context<'b>,
    last: &'a Round<'b>,
    columns: Columns,
    drivers: Vec<Driver>,
    left: Left<'a>,
    /// Accepted effects that the data show, in the order of the left's, by their number among those found.
    shown: Vec<usize>,
}

impl Library<'_, '_> {
    /// The effects accepted at a place with a driver, as the left numbers them.
    fn accepted_at(&self, smooth: SmoothPlace) -> impl Iterator<Item = usize> + '_ {
        let found = self.shown.iter().map(|&number| self.last.fitted.found[number].effect);
        found.enumerate().filter_map(move |(at, effect)| {
            let effect = &self.whole.catalogue[effect];
            let moved = effect.places().contains(&smooth.place);
            let driven = effect
                .functions
                .iter()
                .flat_map(Function::amounts)
                .any(|amount| self.last.fitted.chain.symbols_in(amount).contains(&smooth.driver));
            (moved && driven).then_some(at)
        })
    }

    fn driver(&self, smooth: SmoothPlace) -> Option<(&Driver, &[f64])> {
        let driver = self.drivers.iter().find(|driver| driver.symbol == smooth.driver)?;
        Some((driver, self.last.search.rows.observations.poses.column(smooth.driver)?))
    }

    /// A shape's columns at a place: the place's derivative times the function's values, whitened.
    fn sheet(&self, smooth: SmoothPlace, values: &Mat<f64>) -> Mat<f64> {
        let SmoothPlace { place, driver } = smooth;
        match self.columns.probe(place) {
            None => Mat::zeros(self.left.residual.len(), values.ncols()),
            Some(probe) => {
                let sheet = self.last.search.rows.sheet(probe, values);
                self.left.shown(sheet, least_of_function(self.whole, place, Some(driver)))
            }
        }
    }

    /// The scan's functions at a place: steps and bumps one by one, tables as blocks.
    fn sheet_of_scan(&self, smooth: SmoothPlace) -> Sheet {
        let empty = || Sheet { columns: Mat::zeros(self.left.residual.len(), 0), blocks: Vec::new() };
        let Some((driver, readings)) = self.driver(smooth) else { return empty() };
        let at = |share: f64| driver.low + share * driver.span();
        let middle = |i: usize, of: usize| at((i as f64 + 0.5) / of as f64);
        let mut shapes: Vec<Shape> =
            (0..SCANNED_STEPS).map(|i| Shape::Step { at: middle(i, SCANNED_STEPS) }).collect();
        for (of, width) in SCANNED_BUMPS {
            let width = width * driver.span();
            shapes.extend((0..of).map(|i| Shape::Bump { middle: middle(i, of), width }));
        }
        shapes.extend(
            SCANNED_TABLES
                .into_iter()
                .filter(|&stretches| driver.resolves(stretches))
                .map(|of| Shape::Table { knots: (0..=of).map(|i| at(i as f64 / of as f64)).collect() }),
        );
        let parts: Vec<Mat<f64>> = shapes.iter().map(|shape| shape.values(readings)).collect();
        let mut blocks = Vec::new();
        let mut values = Mat::zeros(readings.len(), parts.iter().map(Mat::ncols).sum());
        let mut start = 0;
        for part in &parts {
            values.subcols_mut(start, part.ncols()).copy_from(part);
            blocks.push(start..start + part.ncols());
            start += part.ncols();
        }
        Sheet { columns: self.sheet(smooth, &values), blocks }
    }

    /// The shapes at one place of so many: the best of one function each, refined, and those of several.
    fn judged(&self, smooth: SmoothPlace, places: usize) -> Vec<Judged> {
        let Some((driver, readings)) = self.driver(smooth) else { return Vec::new() };
        let column = |shape: &Shape| self.sheet(smooth, &shape.values(readings));
        // What the effects accepted elsewhere leave: those here are what the shape would replace.
        let here: Vec<usize> = self.accepted_at(smooth).collect();
        let beside = (0..self.left.declared).chain(
            self.left
                .accepted
                .iter()
                .enumerate()
                .filter(|(at, _)| !here.contains(at))
                .flat_map(|(_, own)| own.clone()),
        );
        let rows = self.left.residual.len();
        let basis = orthonormal(beside.map(|column| self.left.known.col_as_slice(column).to_vec()), rows);
        let last = self.left.known.ncols() - 1;
        let mut residual = self.left.known.col_as_slice(last).to_vec();
        take_out(&basis, &mut residual);
        let gain = Gain { basis: &basis, residual: &residual };

        let mut starts: Vec<(f64, Shape)> = driver
            .single()
            .into_iter()
            .filter(|shape| shape.is_seen_between(driver.low, driver.high))
            .map(|shape| (gain.of(column(&shape).col_as_slice(0)), shape))
            .collect();
        starts.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut kinds: Vec<ShapeKind> = Vec::new();
        starts.retain(|(_, shape)| {
            let new = kinds.len() < REFINED && !kinds.contains(&shape.kind());
            if new {
                kinds.push(shape.kind());
            }
            new
        });
        let step = driver.span() / 36.0;
        let single = starts
            .into_iter()
            .map(|(_, shape)| refined(shape, driver, step, &gain, column).0.rounded(driver.span()));
        let several = driver.several().into_iter().map(|shape| shape.rounded(driver.span()));
        single
            .chain(several)
            .map(|shape| {
                let price =
                    Price { sets: self.last.sets.len(), functions: places, parameters: shape.parameters() };
                let fitted = contender(&self.left, column(&shape).as_ref(), price);
                Judged { smooth, shape, fitted }
            })
            .collect()
    }

    /// Whether a function predicts rows that were held out better than what was accepted.
    fn is_confirmed(&self, judged: &Judged) -> bool {
        let Some((_, readings)) = self.driver(judged.smooth) else { return false };
        let columns = self.sheet(judged.smooth, &judged.shape.values(readings));
        let problem = self.last.search.of_functions();
        let rows = problem.rows().nrows();
        let (setting, driver) = (&self.whole.setting, judged.smooth.driver);
        let is_pose = setting.chain.symbol(driver).kind == SymbolKind::Joint
            || setting.ranges().iter().any(|(.., range)| *range == driver);
        let folds: Vec<Vec<usize>> = if is_pose {
            problem.rows_of_each_fold()
        } else {
            // Whatever drifts with time is a function of a temperature that does, too, but none that returns with it.
            (0..STRETCHES).map(|i| (i * rows / STRETCHES..(i + 1) * rows / STRETCHES).collect()).collect()
        };
        self.rows_behind(&columns) >= FEWEST_BEHIND
            && predicts(&self.left, columns.as_ref(), &judged.fitted.kept, &folds)
    }

    /// How many rows a function hangs on, as an effective number: of their shares of what is left of its columns.
    fn rows_behind(&self, columns: &Mat<f64>) -> f64 {
        let basis = &self.left.basis;
        let left = columns - basis * (basis.transpose() * columns);
        let share = |component: usize| left.row(component).iter().map(|value| value * value).sum();
        let shares = (0..left.nrows()).map(|component| (component, share(component)));
        self.last.search.rows.rows_behind(shares)
    }

    /// The function that is taken up, and those that are about as good as what they would replace.
    fn verdict(&self, judged: Vec<Judged>, most: Option<SmoothPlace>, p_value: f64) -> Contest {
        let price = Price { sets: self.last.sets.len(), functions: 1, parameters: 0 };
        let present = criterion(&self.left, price);
        let of_accepted = likelihood(&self.left);
        let expected = of_accepted.expected();
        let numbers = |of: &[usize]| -> Vec<usize> { of.iter().map(|&at| self.shown[at]).collect() };
        let replaced = |judged: &Judged| -> Vec<usize> {
            (0..self.shown.len()).filter(|at| !judged.fitted.kept.contains(at)).collect()
        };
        let mut contest = Contest::default();
        // Where nothing stood before, the scan must have been alarmed.
        let stands = |one: &&Judged| most == Some(one.smooth) || !replaced(one).is_empty();
        let mut better: Vec<&Judged> =
            judged.iter().filter(stands).filter(|one| one.fitted.criterion > present + BETTER).collect();
        better.sort_by(|a, b| b.fitted.criterion.total_cmp(&a.fitted.criterion));
        let best = better.into_iter().take(CONFIRMED).find(|one| self.is_confirmed(one));
        if let Some(best) = best {
            let of_replaced =
                replaced(best).into_iter().map(|at| self.last.fitted.found[self.shown[at]].p_value);
            contest.taken = Some(Taken {
                place: best.smooth.place,
                driver: best.smooth.driver,
                shape: best.shape.clone(),
                kept: numbers(&best.fitted.kept),
                p_value: of_replaced.reduce(f64::min).unwrap_or(p_value),
                leaves: best.fitted.leaves,
            });
        }
        for one in &judged {
            let instead_of = numbers(&replaced(one));
            let kind = one.shape.kind();
            let known = |other: &AsGood| {
                (other.place, other.driver, other.kind) == (one.smooth.place, one.smooth.driver, kind)
            };
            // A function that was taken up does not compete with itself.
            let of_its_own = |&number: &usize| {
                let effect = &self.whole.catalogue[self.last.fitted.found[number].effect];
                (effect.place, &effect.form) == (one.smooth.place, &Dependence::from(kind.words()))
                    && effect.driver == self.whole.setting.name(one.smooth.driver)
            };
            // Another function is held to what it is expected to make of new data: a price for every threshold would hide
            // whatever takes more of them than a name of the catalogue does.
            let differs = one.fitted.differs.is_some_and(|share| share > SAME_FORM)
                && one.fitted.likelihood.expected() >= expected - AS_GOOD;
            // The same over these data with more to choose, as powers are beside a scale, says nothing else.
            let is_more_of_the_same = one.fitted.differs.is_some_and(|share| share <= SAME_FORM)
                && one.fitted.likelihood.parameters > of_accepted.parameters;
            if instead_of.is_empty()
                || is_more_of_the_same
                || instead_of.iter().any(of_its_own)
                || !(differs || one.fitted.criterion >= present - AS_GOOD)
            {
                continue;
            }
            match contest.as_good.iter_mut().find(|other| known(other)) {
                Some(other) => other.differs |= differs,
                None => {
                    let SmoothPlace { place, driver } = one.smooth;
                    contest.as_good.push(AsGood { place, driver, kind, instead_of, differs });
                }
            }
        }
        contest
    }
}
