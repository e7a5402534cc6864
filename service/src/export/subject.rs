//! What is exported: an instrument, one observable of it, and the poses of its measured region.

use model_core::{Chain, ObservableId, ObservableKind, SymbolId, names};
use observe::SiUnit;

use super::Lost;
use crate::Instrument;
use crate::apply::{distance, in_vectors};
use crate::evaluation::{self, Evaluator, Exactness, readings_of};
use crate::instrument::Covariance;
use crate::refusal::Refusal;
use crate::sensitivity::{bounds, spread_over, without_errors};

/// What an observable shows, pose after pose.
pub type Shown = Vec<[f64; 3]>;

/// Poses that stand for the measured region.
const POSES: usize = 2000;

/// An instrument as a form sees it.
pub struct Subject {
    /// The chain; its observables show vectors where a study says what was measured.
    pub chain: Chain,
    /// The value of every symbol, SI.
    pub values: Vec<f64>,
    /// What is observed: a direction or a point.
    pub observable: ObservableId,
    /// How sure the estimates are.
    pub covariance: Option<Covariance>,
    /// Poses of the measured region.
    pub poses: Poses,
}

/// Poses.
pub struct Poses {
    /// The joints and inputs of the observable, a column each.
    pub readings: Vec<(SymbolId, Vec<f64>)>,
    /// The range of each.
    ranges: Vec<[f64; 2]>,
    /// How many there are.
    pub count: usize,
}

/// How far two forms of an instrument are apart at the observable, rad or m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// The root of the mean square over the poses.
    pub rms: f64,
    /// The largest.
    pub most: f64,
}

impl Subject {
    /// An instrument with the observable that is named, or the one that its study measured.
    pub fn of(instrument: &Instrument, named: Option<&str>) -> Result<Self, Refusal> {
        let (chain, values) =
            in_vectors(instrument).unwrap_or_else(|| (instrument.chain.clone(), instrument.values.clone()));
        let measured = instrument.headings.iter().flat_map(|headings| &headings.sources);
        let measured: Option<ObservableId> = measured.map(|source| source.observable).next();
        let observable = match (named, measured, chain.observables.as_slice()) {
            (Some(name), _, _) => crate::source::observable(&chain, name)?,
            (None, Some(measured), _) => measured,
            (None, None, [_]) => ObservableId(0),
            (None, None, several) => {
                let several = names::listed(several.iter().map(|own| own.name.as_str()));
                return Err(Refusal::Input(format!("say which of {several} is wanted: --observable NAME")));
            }
        };
        if !chain.observable(observable).is_vector() {
            let name = &chain.observable(observable).name;
            return Err(Refusal::Input(format!(
                "`{name}` shows no direction or point: name one that does with --observable"
            )));
        }
        let poses = Poses::over(instrument, &chain, observable)?;
        Ok(Self { chain, values, observable, covariance: instrument.covariance.clone(), poses })
    }

    /// What the observable is measured in.
    pub fn unit(&self) -> SiUnit {
        match self.chain.observable(self.observable).kind {
            ObservableKind::Direction => SiUnit::RAD,
            ObservableKind::Point => SiUnit::METRE,
        }
    }

    /// The declared values with every error zero.
    pub fn without_errors(&self) -> Vec<f64> {
        without_errors(&self.chain, &self.values)
    }

    /// What the observable shows at the poses with these values of errors and constants.
    pub fn shown(&self, values: &[f64]) -> Result<Shown, Refusal> {
        self.evaluated(values, evaluation::Quantity::Value)
    }

    /// The same at other poses.
    pub fn shown_at(
        &self,
        readings: &[(SymbolId, Vec<f64>)],
        count: usize,
        values: &[f64],
    ) -> Result<Shown, Refusal> {
        self.evaluated_at(readings, count, values, evaluation::Quantity::Value)
    }

    fn evaluated(&self, values: &[f64], what: evaluation::Quantity) -> Result<Shown, Refusal> {
        self.evaluated_at(&self.poses.readings, self.poses.count, values, what)
    }

    fn evaluated_at(
        &self,
        readings: &[(SymbolId, Vec<f64>)],
        count: usize,
        values: &[f64],
        what: evaluation::Quantity,
    ) -> Result<Shown, Refusal> {
        let evaluator = Evaluator::new(&self.chain, vec![self.observable], Exactness::Exact, what, values);
        let readings: Vec<(SymbolId, &[f64])> =
            readings.iter().map(|(id, column)| (*id, column.as_slice())).collect();
        let columns = evaluator.columns(&readings, count)?;
        Ok((0..count).map(|row| [0, 1, 2].map(|axis| columns[axis][row])).collect())
    }

    /// Errors that a form cannot carry, each with what it does alone; those that do nothing are none.
    pub(super) fn lost(&self, errors: &[SymbolId]) -> Result<Vec<Lost>, Refusal> {
        let mut lost = Vec::new();
        for error in errors {
            let mut values = self.without_errors();
            values[error.index()] = self.values[error.index()];
            let added = self.evaluated(&values, evaluation::Quantity::Error)?;
            let squares: f64 = added.iter().flatten().map(|part| part * part).sum();
            let rms = (squares / self.poses.count as f64).sqrt();
            if rms > 0.0 {
                lost.push(Lost { what: self.chain.symbol(*error).name.clone(), rms });
            }
        }
        Ok(lost)
    }

    /// How far what a form shows is from the instrument.
    pub fn difference(&self, shown: &[[f64; 3]]) -> Result<Difference, Refusal> {
        Ok(self.apart(&self.shown(&self.values)?, shown))
    }

    /// How far two lists of what is shown are apart.
    pub fn apart(&self, one: &[[f64; 3]], other: &[[f64; 3]]) -> Difference {
        let is_direction = self.chain.observable(self.observable).kind == ObservableKind::Direction;
        let apart =
            one.iter().zip(other).map(|(a, b)| if is_direction { angle(a, b) } else { distance(a, b) });
        let (mut squares, mut most) = (0.0, 0.0_f64);
        for own in apart {
            squares += own * own;
            most = if own.is_nan() { f64::NAN } else { most.max(own) };
        }
        Difference { rms: (squares / self.poses.count as f64).sqrt(), most }
    }

    /// The range of a joint or input of the observable.
    pub fn range(&self, id: SymbolId) -> [f64; 2] {
        let at = self.poses.readings.iter().position(|(own, _)| *own == id);
        at.map_or([f64::NAN; 2], |at| self.poses.ranges[at])
    }

    /// The values of all symbols at a pose.
    pub fn at(&self, pose: usize, values: &[f64]) -> Vec<f64> {
        let mut all = values.to_vec();
        self.poses.readings.iter().for_each(|(id, column)| all[id.index()] = column[pose]);
        self.chain.set_derived(&mut all);
        all
    }
}

impl Poses {
    /// Poses spread evenly over the ranges that an instrument was measured over; a joint that has no range makes a full turn.
    fn over(instrument: &Instrument, chain: &Chain, observable: ObservableId) -> Result<Self, Refusal> {
        let needed = readings_of(chain, observable);
        let range = |id: &SymbolId| {
            bounds(chain, &instrument.found, *id).ok_or_else(|| {
                Refusal::Input(format!(
                    "the instrument file does not say over which `{0}` it was measured: add it to [found-over], as {0} = [1.0, 2.0]",
                    chain.symbol(*id).name
                ))
            })
        };
        let ranges: Vec<(f64, f64)> = needed.iter().map(range).collect::<Result<_, _>>()?;
        let mut readings = spread_over(chain, &needed, &ranges, POSES);
        let kept = above_the_horizon(chain, observable, &readings);
        for (_, column) in &mut readings {
            *column = kept.iter().map(|&pose| column[pose]).collect();
        }
        let ranges = ranges.into_iter().map(|(low, high)| [low, high]).collect();
        Ok(Self { readings, ranges, count: kept.len() })
    }
}

/// The poses whose line of sight points well above the horizon, where an error follows its angle from up; else all. Ranges of two
/// joints hold poses below the horizon that nobody measured.
fn above_the_horizon(
    chain: &Chain,
    observable: ObservableId,
    readings: &[(SymbolId, Vec<f64>)],
) -> Vec<usize> {
    /// Beyond it, the tangent of the zenith distance is no smooth function of the air.
    ///
    /// Source: R. C. Stone, "An accurate method for computing atmospheric refraction", PASP 108 (1996) 1051: tan and tan³
    /// describe refraction to a zenith distance of some 75°.
    const FARTHEST_RAD: f64 = 75.0 * std::f64::consts::PI / 180.0;
    let used: Vec<SymbolId> =
        chain.way(observable).iter().flat_map(|passed| passed.factor.amount.symbols()).collect();
    let angles = chain.sight_angles.iter().filter(|angle| used.contains(&angle.symbol));
    let angles: Vec<_> = angles.collect();
    let mut values = chain.nominal_values();
    let mut is_above = |pose: usize| {
        readings.iter().for_each(|(id, column)| values[id.index()] = column[pose]);
        angles.iter().all(|angle| angle.value(&values) <= FARTHEST_RAD)
    };
    let kept: Vec<usize> = (0..POSES).filter(|&pose| is_above(pose)).collect();
    if kept.is_empty() { (0..POSES).collect() } else { kept }
}

/// The angle between two directions, rad; to its last digit where it is small.
fn angle(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let dot: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    distance(&cross, &[0.0; 3]).atan2(dot)
}
