//! What is left after the last round: whether it has structure, where, and of what shape.

use faer::Mat;
use model_core::{Quantity, Role, SymbolId, SymbolKind, print};
use rayon::prelude::*;
use serde::Serialize;

use super::basis::Basis;
use super::function::{Form, Function, Kind};
use super::units::of_reading;
use crate::search::SearchError;
use crate::search::columns::{self, Columns};
use crate::search::contest::{Price, contender, criterion, most_telling};
use crate::search::context::{Context, declared};
use crate::search::remains::{Statistic, along, combined, lagged, nearest};
use crate::search::round::Round;
use crate::search::scan::{Left, Sheet};
use crate::search::search_problem::least_of_function;
use crate::search::signs::Signs;
use effects::candidate::{Effect, Freedom, Place};
use effects::families::{SmoothPlace, smooth, tensor};
use fit::noise::Layout;
use observe::{Observations, SiUnit};

/// Harmonics of each joint that are scanned, unless the study asks for more.
const HARMONICS: u32 = 32;

/// Harmonics on one sheet.
const A_SHEET: u32 = 16;

/// Rows between observations that are compared in order of acquisition.
const LAGS: std::ops::RangeInclusive<usize> = 1..=3;

/// Penalised log-likelihood by which a smooth function must beat the catalogue's model: six units of Schwarz's
/// criterion.
const BETTER: f64 = 3.0;

/// What is left of structure in the residual.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Remaining {
    /// Chance of at least as much structure in noise, all that was looked at taken together.
    pub p_value: f64,
    /// The rows that were looked at: all, or a sample from all over the data where they are many.
    pub rows: usize,
    /// What was looked at; nothing where too few degrees of freedom are left to tell.
    pub looked: Vec<Looked>,
    /// Where it sits, if one smooth function at one place explains the data better than the catalogue does.
    #[serde(rename = "where")]
    pub place: Option<Where>,
    /// The smooth function there, whole: driver, value and two standard uncertainties, SI.
    pub shape: Vec<Vec<f64>>,
    /// Lines for the study that make the function there an effect of its own, where functions were not to be taken up
    /// (`functions = false`); absent for a bump.
    pub offer: Option<String>,
}

/// One statistic of what is left.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Looked {
    /// What it looks at: `neighbours along beta`.
    pub at: String,
    /// Chance of as much in noise, of this statistic alone.
    pub p_value: f64,
}

/// A place in the chain.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Where {
    /// The body.
    pub body: String,
    /// `Rx` to `Tz`.
    pub dof: String,
    /// The joint or input.
    pub driver: String,
    /// The kind of function.
    pub form: Form,
}

/// Everything that the scans read.
struct Scanned<'a> {
    whole: &'a Context<'a>,
    last: &'a Round<'a>,
    left: &'a Left<'a>,
    columns: Columns,
    drivers: Vec<Driver>,
    /// Functions of two joints together, and their whitened columns.
    tensors: Vec<(Effect, Mat<f64>)>,
}

/// A joint or input that functions may hang on, and what they are at its readings.
struct Driver {
    symbol: SymbolId,
    basis: Basis,
    series: Mat<f64>,
    bumps: Mat<f64>,
}

impl Driver {
    fn new(whole: &Context<'_>, observations: &Observations, symbol: SymbolId) -> Option<Self> {
        let basis = Basis::of(whole.setting.chain, &observations.poses, symbol)?;
        let readings = observations.poses.column(symbol)?;
        let series = tabulated(readings, |q| basis.series(q));
        let bumps = basis.bumps();
        let bumps = tabulated(readings, |q| bumps.iter().map(|&bump| basis.bump(bump, q)).collect());
        Some(Self { symbol, basis, series, bumps })
    }
}

/// Functions at readings, one row a reading.
fn tabulated(readings: &[f64], functions: impl Fn(f64) -> Vec<f64> + Sync) -> Mat<f64> {
    let values: Vec<Vec<f64>> = readings.par_iter().map(|&q| functions(q)).collect();
    let width = values.first().map_or(0, Vec::len);
    Mat::from_fn(values.len(), width, |row, j| values[row][j])
}

/// Looks for structure in the last residual.
pub(crate) fn remaining(whole: &Context<'_>, last: &Round<'_>) -> Result<Remaining, SearchError> {
    let observations = &*last.search.rows.observations;
    let problem = last.search.of_functions();
    let accepted: Vec<Vec<usize>> = last.shown_to_functions().into_iter().map(|(_, own)| own).collect();
    let options = &whole.options;
    let signs = Signs::scattered(problem.group_of_row(), options.flips, options.seed);
    let left = Left::new(problem, &accepted, &signs);

    let mut smooths = smooth(&whole.setting);
    let mut symbols: Vec<SymbolId> = smooths.iter().map(|smooth| smooth.driver).collect();
    symbols.sort_unstable();
    symbols.dedup();
    let drivers: Vec<Driver> =
        symbols.into_iter().filter_map(|id| Driver::new(whole, observations, id)).collect();
    let harmonics = harmonics(whole);
    let mut places: Vec<Place> = smooths.iter().map(|smooth| smooth.place).collect();
    places.extend(harmonics.iter().map(|(place, ..)| *place));
    let tensors = tensor(&whole.setting);
    places.extend(columns::places(&tensors));
    places.sort_unstable();
    places.dedup();
    let values = &last.fitted.fit.values;
    let columns = Columns::at(&last.fitted.chain, observations, declared(whole), values, &places)?;
    let of_tensors = columns.of_effects(&last.fitted.chain, &tensors, &observations.poses, values);
    let tensors = tensors.into_iter().zip(of_tensors).map(|(effect, own)| {
        let white: Vec<Vec<f64>> = own.iter().map(|column| last.search.rows.whiten(column)).collect();
        let columns = Mat::from_fn(left.residual.len(), white.len(), |i, j| white[j][i]);
        let least = least_of_function(whole, effect.place, None);
        (effect, left.shown(columns, least))
    });
    let tensors = tensors.filter(|(_, own)| own.ncols() > 0).collect();
    let mut scanned = Scanned { whole, last, left: &left, columns, drivers, tensors };
    smooths.retain(|smooth| {
        scanned.columns.probe(smooth.place).is_some() && scanned.driver(smooth.driver).is_some()
    });

    if !last.tells_structure() {
        let (looked, shape) = (Vec::new(), Vec::new());
        return Ok(Remaining {
            p_value: 1.0,
            rows: observations.rows(),
            looked,
            place: None,
            shape,
            offer: None,
        });
    }
    let mut statistics = neighbours(whole, last, &left, &signs);
    let waves = left.scan(harmonics.len(), |number| scanned.harmonics(observations, harmonics[number]));
    statistics.push(Statistic::of_scan("harmonics of a joint", &waves));
    let functions = left.scan(smooths.len(), |number| scanned.smooth(smooths[number]));
    statistics.push(Statistic::of_scan("smooth functions of a joint or input", &functions));
    let pairs = left.scan(scanned.tensors.len(), |number| Sheet::of(scanned.tensors[number].1.clone()));
    statistics.push(Statistic::of_scan("smooth functions of two joints", &pairs));
    let (p_value, alone) = combined(&statistics);
    let looked: Vec<Looked> =
        statistics.iter().zip(alone).map(|(s, p_value)| Looked { at: s.what.clone(), p_value }).collect();

    // Either in place of what was accepted there, or the most conspicuous of what is left.
    // A function is named only where functions stand out by themselves: neighbours may for many reasons.
    let [.., of_one, of_two] = looked.as_slice() else { unreachable!("both scans are statistics") };
    let stands_out = |own: &Looked| p_value.max(own.p_value) <= options.false_alarm;
    let (one_stands_out, two_stand_out) = (stands_out(of_one), stands_out(of_two));
    let most = if one_stands_out { functions.most_conspicuous() } else { None };
    let most = most.and_then(|number| smooths.get(number)).copied();
    smooths.retain(|smooth| Some(*smooth) == most || spelt_out(whole, last, *smooth));
    scanned.tensors.retain(|(of_two, _)| {
        two_stand_out
            || last.fitted.found.iter().any(|found| whole.catalogue[found.effect].place == of_two.place)
    });
    let best = scanned.best_function(&smooths);
    let chain = &last.fitted.chain;
    let place = best.as_ref().map(|function| Where {
        body: chain.body(function.place.body).name.clone(),
        dof: function.place.freedom.word().to_owned(),
        driver: function.driver.clone(),
        form: function.form(),
    });
    // Elsewhere it was taken up, or it was tried and did not predict what it was not fitted to.
    let offered = best.as_ref().filter(|_| whole.request.plan.search.functions == Some(false));
    let offer = offered.and_then(|function| function.offer(chain));
    let shape = best.as_ref().map_or_else(Vec::new, Function::shape);
    Ok(Remaining { p_value, rows: observations.rows(), looked, place, shape, offer })
}

/// Whether an effect was accepted at a place with the same driver: a function there may be what it spells out.
fn spelt_out(whole: &Context<'_>, last: &Round<'_>, smooth: SmoothPlace) -> bool {
    last.fitted
        .found
        .iter()
        .map(|found| &whole.catalogue[found.effect])
        .any(|effect| effect.place == smooth.place && effect.driver == whole.setting.name(smooth.driver))
}

/// Sheets of harmonics: the place, the joint, and the first order of each.
fn harmonics(whole: &Context<'_>) -> Vec<(Place, SymbolId, u32)> {
    let most = HARMONICS.max(whole.setting.harmonics);
    let mut sheets = Vec::new();
    for joint in whole.setting.joints().into_iter().filter(effects::candidate::JointAxis::turns) {
        for freedom in Freedom::ALL.into_iter().filter(|freedom| freedom.kind == joint.freedom.kind) {
            let place = Place { body: joint.body, role: Role::MotionError, freedom };
            sheets.extend((1..=most).step_by(A_SHEET as usize).map(|first| (place, joint.symbol, first)));
        }
    }
    sheets
}

impl Scanned<'_> {
    /// A function's columns at a place: the place's derivative times the function's values, whitened.
    fn sheet(&self, place: Place, driver: SymbolId, values: &Mat<f64>) -> Mat<f64> {
        match self.columns.probe(place) {
            None => Mat::zeros(self.left.residual.len(), values.ncols()),
            Some(probe) => {
                let sheet = self.last.search.rows.sheet(probe, values);
                self.left.shown(sheet, least_of_function(self.whole, place, Some(driver)))
            }
        }
    }

    /// The function that beats the catalogue's model by most; the likelier place of two that are the same.
    fn best_function(&self, smooths: &[SmoothPlace]) -> Option<Function> {
        let (whole, left, places) = (self.whole, self.left, smooths.len());
        let each = parallel::each_of(smooths, |smooth| self.at(*smooth, places));
        let mut each: Vec<Function> = each.into_iter().flatten().collect();
        let price = Price { sets: self.last.sets.len(), functions: self.tensors.len(), parameters: 0 };
        each.extend(parallel::each_of(&self.tensors, |(effect, columns)| Function {
            place: effect.place,
            driver: effect.driver.clone(),
            driver_unit: SiUnit::ONE,
            kind: Kind::OfTwo(
                effect.form.clone(),
                effect.functions.iter().map(|f| print::text(&f.amount, whole.setting.chain)).collect(),
            ),
            fitted: contender(left, columns.as_ref(), price),
        }));
        let least = criterion(left, price) + BETTER;
        each.into_iter().fold(None, |best: Option<Function>, other| {
            let to_beat = best.as_ref().map_or(least, |best| best.fitted.criterion + 1e-6);
            if other.fitted.criterion > to_beat { Some(other) } else { best }
        })
    }

    /// The functions at one place of so many.
    fn at(&self, smooth: SmoothPlace, places: usize) -> Vec<Function> {
        let (whole, left) = (self.whole, self.left);
        let Some(driver) = self.driver(smooth.driver) else { return Vec::new() };
        let (basis, sets) = (driver.basis, self.last.sets.len());
        let function = |kind, fitted| Function {
            place: smooth.place,
            driver: whole.setting.name(smooth.driver).to_owned(),
            driver_unit: of_reading(&whole.setting, whole.setting.chain, smooth.driver),
            kind,
            fitted,
        };
        let mut all = Vec::new();
        let series = self.sheet(smooth.place, smooth.driver, &driver.series);
        let orders: Vec<(u32, usize)> = basis.orders().collect();
        for &(order, width) in orders.iter().filter(|&&(_, width)| width <= series.ncols()) {
            let price = Price { sets, functions: places * orders.len(), parameters: 0 };
            let fitted = contender(left, series.subcols(0, width), price);
            all.push(function(Kind::Series(basis, order), fitted));
        }
        let columns = self.sheet(smooth.place, smooth.driver, &driver.bumps);
        let bumps = basis.bumps();
        for at in most_telling(left, columns.as_ref()) {
            let price = Price { sets, functions: places, parameters: 2 };
            let fitted = contender(left, columns.subcols(at, 1), price);
            all.push(function(Kind::Bump(basis, bumps[at]), fitted));
        }
        all
    }

    fn driver(&self, symbol: SymbolId) -> Option<&Driver> {
        self.drivers.iter().find(|driver| driver.symbol == symbol)
    }

    fn smooth(&self, smooth: SmoothPlace) -> Sheet {
        let columns =
            self.driver(smooth.driver).map(|driver| self.sheet(smooth.place, smooth.driver, &driver.series));
        Sheet::of(columns.unwrap_or_else(|| Mat::zeros(self.last.search.rows.columns.residual.len(), 0)))
    }

    fn harmonics(&self, observations: &Observations, sheet: (Place, SymbolId, u32)) -> Sheet {
        let (place, joint, first) = sheet;
        let wave = |q: f64, order: u32| [(f64::from(order) * q).cos(), (f64::from(order) * q).sin()];
        let values = tabulated(observations.poses.column(joint).unwrap_or_default(), |q| {
            (first..first + A_SHEET).flat_map(|order| wave(q, order)).collect()
        });
        let columns = self.sheet(place, joint, &values);
        let blocks = (0..columns.ncols() / 2).map(|at| 2 * at..2 * at + 2).collect();
        Sheet { columns, blocks }
    }
}

/// Products of neighbours: in the space of all joints, along each joint, and in order of acquisition.
fn neighbours(whole: &Context<'_>, last: &Round<'_>, left: &Left<'_>, signs: &Signs) -> Vec<Statistic> {
    let row_set = &last.search.rows;
    let observations = &*row_set.observations;
    let chain = whole.setting.chain;
    let layout = Layout::of(observations);
    let first: Vec<usize> = (0..=layout.rows()).map(|row| layout.first(row)).collect();
    let joints: Vec<(SymbolId, &[f64])> = observations
        .poses
        .columns
        .iter()
        .filter(|(id, _)| chain.symbol(*id).kind == SymbolKind::Joint)
        .map(|(id, readings)| (*id, readings.as_slice()))
        .collect();
    let mut points = vec![Vec::new(); observations.rows()];
    let mut statistics = Vec::new();
    for (id, readings) in &joints {
        let symbol = chain.symbol(*id);
        let angle = symbol.quantity == Quantity::Angle;
        // Angles on a circle of radius one, lengths in units of their spread.
        let mean = readings.iter().sum::<f64>() / readings.len().max(1) as f64;
        let spread = readings.iter().map(|q| (q - mean).powi(2)).sum::<f64>() / readings.len().max(1) as f64;
        let unit = spread.sqrt().max(f64::MIN_POSITIVE);
        for (point, q) in points.iter_mut().zip(*readings) {
            if angle { point.extend([q.cos(), q.sin()]) } else { point.push((q - mean) / unit) }
        }
        let what = format!("neighbours along {}", symbol.name);
        statistics.push(Statistic::of_pairs(
            what,
            &along(readings, &observations.groups),
            &first,
            left,
            signs,
        ));
    }
    let what = "neighbours in the space of all joints".to_owned();
    statistics
        .insert(0, Statistic::of_pairs(what, &nearest(&points, &observations.groups), &first, left, signs));
    if observations.in_sequence {
        for lag in LAGS {
            let what = format!("observations {lag} rows apart");
            statistics.push(Statistic::of_pairs(what, &lagged(&row_set.stretches, lag), &first, left, signs));
        }
    }
    statistics
}
