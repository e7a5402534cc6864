//! The instrument as a report draws it: bodies, joints, and the errors at their places.

use model_core::{Chain, Role, SymbolId, SymbolKind, TransformKind};
use serde::Serialize;

use super::errors::ErrorFound;
use super::units::of_reading;
use effects::candidate::Setting;
use observe::{Observations, SiUnit};

/// The chain.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Instrument {
    /// The declared name.
    pub name: String,
    /// Its documentation.
    pub documentation: String,
    /// Bodies from the ground up, each after its lower body.
    pub bodies: Vec<BodyShown>,
    /// What was observed.
    pub observed: Vec<ObservedShown>,
    /// Joints and inputs that were read.
    pub readings: Vec<ReadingShown>,
}

/// A body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyShown {
    /// The declared name.
    pub name: String,
    /// Its documentation.
    pub documentation: String,
    /// The body it hangs on; absent for the ground.
    pub lower: Option<String>,
    /// The joints that move it.
    pub joints: Vec<JointShown>,
    /// The errors in it.
    pub errors: Vec<ErrorShown>,
}

/// A joint of a body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointShown {
    /// The declared name.
    pub name: String,
    /// `Rx` to `Tz`.
    pub dof: String,
    /// Its printed form, LaTeX.
    pub symbol: String,
}

/// An error of a body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ErrorShown {
    /// The declared name.
    pub name: String,
    /// `Rx` to `Tz`.
    pub dof: String,
    /// What these data say of it.
    pub state: ErrorState,
    /// Its documentation, or that of its factor.
    pub documentation: String,
}

/// What data say of an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum ErrorState {
    /// Determined by itself.
    #[serde(rename = "alone")]
    Alone,
    /// Determined in combination with others alone.
    #[serde(rename = "in a sum")]
    InASum,
    /// Not seen at all.
    #[serde(rename = "not shown")]
    NotShown,
    /// Held at a value.
    #[serde(rename = "held")]
    Held,
}

/// Something observed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObservedShown {
    /// The observable.
    pub name: String,
    /// The body that carries it.
    pub body: String,
    /// Its documentation.
    pub documentation: String,
    /// The residual's components.
    pub components: Vec<&'static str>,
}

/// A joint or input that was read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReadingShown {
    /// The declared name.
    pub name: String,
    /// Its printed form, LaTeX.
    pub symbol: String,
    /// Its SI unit.
    pub unit: SiUnit,
    /// Whether it is a joint; else an input.
    pub joint: bool,
    /// The smallest and the largest reading, SI.
    pub range: [f64; 2],
}

/// The chain, with the errors as a fit left them.
pub(super) fn instrument(
    setting: &Setting<'_>,
    chain: &Chain,
    observations: &Observations,
    errors: &[ErrorFound],
) -> Instrument {
    let bodies = chain.bodies.iter().map(|body| {
        let mut joints = Vec::new();
        let mut own: Vec<ErrorShown> = Vec::new();
        for factor in &body.factors {
            let dof = dof(factor.kind, factor.axis.index());
            for id in factor.amount.symbols() {
                let symbol = chain.symbol(id);
                let name = symbol.name.clone();
                match symbol.kind {
                    SymbolKind::Joint if factor.role == Role::Motion => {
                        joints.push(JointShown { name, dof: dof.to_owned(), symbol: symbol.latex.clone() });
                    }
                    SymbolKind::Error if own.iter().all(|error| error.name != name) => {
                        let documentation = if symbol.documentation.is_empty() {
                            factor.documentation.clone()
                        } else {
                            symbol.documentation.clone()
                        };
                        let state = state(&name, errors);
                        own.push(ErrorShown { name, dof: dof.to_owned(), state, documentation });
                    }
                    _ => {}
                }
            }
        }
        BodyShown {
            name: body.name.clone(),
            documentation: body.documentation.clone(),
            lower: body.lower.map(|lower| chain.body(lower).name.clone()),
            joints,
            errors: own,
        }
    });
    Instrument {
        name: chain.name.clone(),
        documentation: chain.documentation.clone(),
        bodies: bodies.collect(),
        observed: observed(chain, observations),
        readings: observations
            .poses
            .columns
            .iter()
            .map(|(id, values)| reading(setting, chain, *id, values))
            .collect(),
    }
}

fn dof(kind: TransformKind, axis: usize) -> &'static str {
    match kind {
        TransformKind::Rotation => ["Rx", "Ry", "Rz"][axis],
        TransformKind::Translation => ["Tx", "Ty", "Tz"][axis],
    }
}

fn state(name: &str, errors: &[ErrorFound]) -> ErrorState {
    match errors.iter().find(|error| error.name == name) {
        None => ErrorState::Held,
        Some(error) if error.separable => ErrorState::Alone,
        Some(error) if error.shown => ErrorState::InASum,
        Some(_) => ErrorState::NotShown,
    }
}

fn observed(chain: &Chain, observations: &Observations) -> Vec<ObservedShown> {
    let mut observed: Vec<ObservedShown> = Vec::new();
    for series in &observations.poses.series {
        let observable = chain.observable(series.observable);
        let shown = ObservedShown {
            name: observable.name.clone(),
            body: chain.body(observable.body).name.clone(),
            documentation: observable.documentation.clone(),
            components: series.measure.component_names().to_vec(),
        };
        if !observed.contains(&shown) {
            observed.push(shown);
        }
    }
    observed
}

fn reading(setting: &Setting<'_>, chain: &Chain, id: SymbolId, values: &[f64]) -> ReadingShown {
    let symbol = chain.symbol(id);
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    ReadingShown {
        name: symbol.name.clone(),
        symbol: symbol.latex.clone(),
        unit: of_reading(setting, chain, id),
        joint: symbol.kind == SymbolKind::Joint,
        range: [low, high],
    }
}
