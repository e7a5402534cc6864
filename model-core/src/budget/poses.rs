//! Sets of poses: a path of one parameter, or ranges of joints and inputs.

use std::f64::consts::TAU;
use std::ops::Range;

use super::BudgetError;
use super::quadrature::{self, Node as RuleNode, Rule};
use crate::algebra::Poly;
use crate::amount::LowerError;
use crate::chain::{Chain, ObservableId};
use crate::expr::Expr;
use crate::remainder::{Domain, DomainError, Parameter, along_path, keep_away};
use crate::symbol::{Quantity, SymbolId, SymbolKind};

/// The poses that a budget goes over.
#[derive(Debug, Clone, PartialEq)]
pub enum Poses {
    /// Joints and inputs as functions of one parameter.
    Path(Path),
    /// Every combination of values within ranges. A joint that is an angle and has no range makes a full turn.
    Ranges(Vec<JointRange>),
}

/// Joints and inputs as functions of a parameter `t`, which runs over (0, 2π).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Path {
    /// What each joint or input is: amounts over π and [`Path::PARAMETER`].
    assignments: Vec<(SymbolId, Poly)>,
}

/// The range of one joint or input, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointRange {
    /// The joint or input.
    pub symbol: SymbolId,
    /// The smallest value.
    pub low: f64,
    /// The largest value.
    pub high: f64,
}

/// Why an assignment cannot be part of a path.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PathError {
    /// What is assigned to is no joint or input.
    #[error("`{0}` is no joint or input of the chain")]
    NotMovable(String),
    /// A joint or input is given twice.
    #[error("`{0}` is given twice")]
    Twice(String),
    /// The amount is no function of `t`.
    #[error("{0}")]
    Amount(LowerError<Range<usize>>),
}

impl Path {
    /// Where the parameter runs from and to.
    pub const PARAMETER: Range<f64> = 0.0..TAU;
    /// The parameter's place in the values that an assignment is evaluated at, π being the first.
    const T: SymbolId = SymbolId(1);

    /// Adds `name = amount`, an amount in `t` and π.
    ///
    /// # Errors
    /// See [`PathError`].
    pub fn assign(
        &mut self,
        chain: &Chain,
        name: &str,
        amount: &Expr<Range<usize>>,
    ) -> Result<(), PathError> {
        let symbol = movable(chain)
            .find(|&id| chain.symbol(id).name == name)
            .ok_or_else(|| PathError::NotMovable(name.to_owned()))?;
        if self.assignments.iter().any(|(earlier, _)| *earlier == symbol) {
            return Err(PathError::Twice(name.to_owned()));
        }
        let resolve = |name: &str| (name == "t").then_some(Self::T);
        let amount = Poly::from_expr(amount, resolve, |_| true).map_err(PathError::Amount)?;
        self.assignments.push((symbol, amount));
        Ok(())
    }

    /// Sets the joints and inputs to their values at `t`.
    pub(super) fn set(&self, t: f64, values: &mut [f64]) {
        for (symbol, amount) in &self.assignments {
            values[symbol.index()] = amount.eval(&[std::f64::consts::PI, t]);
        }
    }

    /// The most waves over the whole path of a function with these highest multiples of the joints and inputs.
    fn fastest(&self, harmonic: impl Fn(SymbolId) -> u32) -> f64 {
        /// Places at which the path's speed is looked at.
        const LOOKS: u32 = 1000;
        let speeds: Vec<(f64, Poly)> = self
            .assignments
            .iter()
            .map(|(symbol, amount)| (f64::from(harmonic(*symbol)), amount.derivative(Self::T)))
            .collect();
        let at = |look| Self::PARAMETER.end * f64::from(look) / f64::from(LOOKS);
        let waves = |t: f64| {
            let speed =
                |(harmonic, slope): &(f64, Poly)| harmonic * slope.eval(&[std::f64::consts::PI, t]).abs();
            speeds.iter().map(speed).sum::<f64>()
        };
        (0..=LOOKS).map(|look| waves(at(look))).filter(|waves| waves.is_finite()).fold(0.0, f64::max)
    }

    fn symbols(&self) -> impl Iterator<Item = SymbolId> + '_ {
        self.assignments.iter().map(|(symbol, _)| *symbol)
    }
}

/// The domain of errors of these sizes, everything else anywhere.
pub(super) fn domain_of(chain: &Chain, sizes: &[(SymbolId, f64)]) -> Result<Domain, DomainError> {
    let mut domain = Domain::new(chain);
    for &(error, size) in sizes {
        domain.set_size(chain, error, size.abs())?;
    }
    Ok(domain)
}

/// Joints and inputs: what has a value at each pose.
pub(super) fn movable(chain: &Chain) -> impl Iterator<Item = SymbolId> + '_ {
    chain.symbols_of(SymbolKind::Joint).chain(chain.symbols_of(SymbolKind::Input))
}

/// The set of poses of one observable as a box of parameters with a rule for means over it.
#[derive(Debug)]
pub(super) struct Space<'a> {
    kind: Kind<'a>,
    /// One rule for each parameter.
    axes: Vec<Vec<RuleNode>>,
    /// Where each parameter runs from and to.
    pub bounds: Vec<(f64, f64)>,
    /// Whether the influences have more waves than a rule has nodes for, so that scattered poses stand for all.
    pub is_sampled: bool,
}

#[derive(Debug)]
enum Kind<'a> {
    Path(&'a Path),
    Ranges(Vec<SymbolId>),
}

/// One pose of the rule.
#[derive(Debug, Clone)]
pub(super) struct Pose {
    pub parameters: Vec<f64>,
    pub weight: f64,
}

/// Poses that a rule over several ranges may have.
const POSES: usize = 20_000;
/// Nodes that one range has where its waves do not ask for more.
const NODES: usize = 256;
/// Poses of a rule whose nodes follow the highest multiples of angles.
const MOST_POSES: f64 = 200_000.0;
/// Panels of a path.
const MOST_PANELS: f64 = 50_000.0;

impl<'a> Space<'a> {
    /// The poses as far as they move the observable; `harmonic` is the highest multiple of each angle in its first-order form.
    pub fn new(
        chain: &Chain,
        observable: ObservableId,
        poses: &'a Poses,
        harmonic: impl Fn(SymbolId) -> u32,
    ) -> Result<Self, BudgetError> {
        let needed = needed(chain, observable);
        let no_value = |id: SymbolId| BudgetError::NoValue {
            observable: chain.observable(observable).name.clone(),
            name: chain.symbol(id).name.clone(),
        };
        match poses {
            Poses::Path(path) => {
                if let Some(&missing) = needed.iter().find(|id| !path.symbols().any(|given| given == **id)) {
                    return Err(no_value(missing));
                }
                let Range { start, end } = Path::PARAMETER;
                // Squares turn twice as fast; a panel of eight nodes does half a wave to ten digits.
                let waves = path.fastest(&harmonic);
                let panels = (4.0 * waves).ceil().max(64.0);
                Ok(Self {
                    kind: Kind::Path(path),
                    axes: vec![quadrature::panels(start, end, panels.min(MOST_PANELS) as usize, 8)],
                    bounds: vec![(start, end)],
                    is_sampled: panels > MOST_PANELS,
                })
            }
            Poses::Ranges(ranges) => {
                let mut bounds = Vec::with_capacity(needed.len());
                for &id in &needed {
                    let symbol = chain.symbol(id);
                    let full_turn = symbol.kind == SymbolKind::Joint && symbol.quantity == Quantity::Angle;
                    match ranges.iter().find(|range| range.symbol == id) {
                        Some(range) => bounds.push((range.low, range.high)),
                        None if full_turn => bounds.push((0.0, TAU)),
                        None => return Err(no_value(id)),
                    }
                }
                let wide = bounds.iter().filter(|(low, high)| low < high).count().max(1);
                let usual = (POSES as f64).powf(1.0 / wide as f64).floor().clamp(2.0, NODES as f64);
                let wanted: Vec<Rule> = needed
                    .iter()
                    .zip(&bounds)
                    .map(|(&id, &(low, high))| Rule::for_squares(low, high, harmonic(id), usual as usize))
                    .collect();
                let is_sampled = wanted.iter().map(|rule| rule.len() as f64).product::<f64>() > MOST_POSES;
                let axes = if is_sampled {
                    bounds.iter().map(|&(low, high)| quadrature::rule(low, high, usual as usize)).collect()
                } else {
                    wanted.iter().map(Rule::nodes).collect()
                };
                Ok(Self { kind: Kind::Ranges(needed), axes, bounds, is_sampled })
            }
        }
    }

    /// The poses of the rule; their weights sum to one.
    pub fn nodes(&self) -> Vec<Pose> {
        if self.is_sampled {
            return self.scattered();
        }
        let mut nodes = vec![Pose { parameters: Vec::new(), weight: 1.0 }];
        for axis in &self.axes {
            nodes = nodes
                .iter()
                .flat_map(|pose| {
                    axis.iter().map(|node| {
                        let mut parameters = pose.parameters.clone();
                        parameters.push(node.at);
                        Pose { parameters, weight: pose.weight * node.weight }
                    })
                })
                .collect();
        }
        nodes
    }

    /// Poses without any period that waves could meet, for what goes too fast for a rule.
    ///
    /// Source: the additive recurrence of the roots of xᵈ⁺¹ = x + 1 (Roberts 2018, "The unreasonable effectiveness of
    /// quasirandom sequences").
    fn scattered(&self) -> Vec<Pose> {
        let dimension = self.bounds.len() as i32;
        let root = (0..64).fold(1.5_f64, |x, _| (1.0 + x).powf(1.0 / f64::from(dimension + 1)));
        let weight = 1.0 / POSES as f64;
        (0..POSES)
            .map(|index| {
                let parameters = self.bounds.iter().zip(1..).map(|(&(low, high), power)| {
                    let fraction = (0.5 + index as f64 * root.powi(-power)).fract();
                    low + (high - low) * fraction
                });
                Pose { parameters: parameters.collect(), weight }
            })
            .collect()
    }

    /// The joints that make full turns, if every parameter is one of these or fixed; none along a path.
    pub fn turning(&self) -> Option<Vec<SymbolId>> {
        let Kind::Ranges(symbols) = &self.kind else { return None };
        let is_turn = |low: f64, high: f64| {
            let turns = (high - low) / TAU;
            turns.round() >= 1.0 && (turns - turns.round()).abs() < 1e-9
        };
        let mut turning = Vec::new();
        for (&symbol, &(low, high)) in symbols.iter().zip(&self.bounds) {
            match (is_turn(low, high), low == high) {
                (true, _) => turning.push(symbol),
                (false, true) => {}
                (false, false) => return None,
            }
        }
        Some(turning)
    }

    /// Refuses poses with a pole: see [`keep_away`]. Errors of these sizes act at once.
    pub fn keeps_from_poles(
        &self,
        chain: &Chain,
        observable: ObservableId,
        sizes: &[(SymbolId, f64)],
    ) -> Result<(), BudgetError> {
        let errors = domain_of(chain, sizes)?;
        let start: Vec<[f64; 2]> = self.bounds.iter().map(|&(low, high)| [low, high]).collect();
        match &self.kind {
            Kind::Ranges(symbols) => {
                let parameters: Vec<Parameter> = symbols.iter().copied().map(Parameter::Symbol).collect();
                let domain_of = |ranges: &[[f64; 2]]| Some(errors.with(symbols, ranges));
                Ok(keep_away(chain, observable, (&parameters, &start), domain_of)?)
            }
            Kind::Path(path) => {
                let symbols: Vec<SymbolId> = path.symbols().collect();
                let domain_of = |ranges: &[[f64; 2]]| {
                    let range = *ranges.first()?;
                    let amounts = path.assignments.iter();
                    let there: Option<Vec<[f64; 2]>> =
                        amounts.map(|(_, amount)| along_path(chain, amount, range)).collect();
                    Some(errors.with(&symbols, &there?))
                };
                Ok(keep_away(chain, observable, (&[Parameter::Path], &start), domain_of)?)
            }
        }
    }

    /// The joints and inputs that are parameters themselves; none along a path.
    pub fn symbols(&self) -> &[SymbolId] {
        match &self.kind {
            Kind::Path(_) => &[],
            Kind::Ranges(symbols) => symbols,
        }
    }

    /// The distance of neighbouring nodes along one parameter, about.
    pub fn spacing(&self, axis: usize) -> f64 {
        let (low, high) = self.bounds[axis];
        (high - low) / self.axes[axis].len() as f64
    }

    /// Sets the joints and inputs of a pose.
    pub fn set(&self, parameters: &[f64], values: &mut [f64]) {
        match &self.kind {
            Kind::Path(path) => path.set(parameters[0], values),
            Kind::Ranges(symbols) => {
                for (symbol, &value) in symbols.iter().zip(parameters) {
                    values[symbol.index()] = value;
                }
            }
        }
    }

    /// A pose in words: the joints and inputs that are set, SI.
    pub fn describe(&self, chain: &Chain, values: &[f64]) -> String {
        let show = |id: SymbolId| format!("{} = {}", chain.symbol(id).name, values[id.index()]);
        let parts: Vec<String> = match &self.kind {
            Kind::Path(path) => path.symbols().map(show).collect(),
            Kind::Ranges(symbols) => symbols.iter().copied().map(show).collect(),
        };
        parts.join(", ")
    }
}

/// The joints and inputs that an observable depends on, in order.
fn needed(chain: &Chain, observable: ObservableId) -> Vec<SymbolId> {
    let mut symbols = chain.symbols_of_way(observable);
    symbols.retain(|&id| matches!(chain.symbol(id).kind, SymbolKind::Joint | SymbolKind::Input));
    symbols
}

/// Points spread evenly over a box, the same ones each time: those of the Kronecker sequence of the generalised golden ratio.
///
/// Source: M. Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018): steps 1/φ, 1/φ², … with φ the
/// positive root of x^(d+1) = x + 1.
pub fn spread(bounds: &[(f64, f64)], count: usize) -> impl Iterator<Item = Vec<f64>> {
    let exponent = 1.0 / (bounds.len() as f64 + 1.0);
    let root = (0..60).fold(2.0_f64, |root, _| (1.0 + root).powf(exponent));
    let steps: Vec<f64> = (1..=bounds.len()).map(|power| root.powf(-(power as f64)).fract()).collect();
    (1..=count).map(move |index| {
        let fraction = |step: &f64| (0.5 + step * index as f64).fract();
        let parameters = bounds.iter().zip(&steps);
        parameters.map(|((low, high), step)| low + (high - low) * fraction(step)).collect()
    })
}
