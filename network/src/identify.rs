//! What a set-up can see of the declared errors, before anybody measures better than roughly: the numeric null space of
//! their columns where objects and stations follow every change of them.

use model_core::{Chain, SymbolId, SymbolKind};
use serde::Serialize;

use super::scale::unheld_scales;
use fit::noise::Layout;
use fit::sweep::{Weighting, tally};
use fit::{FitError, FitOptions, Model, Subspace};
use observe::Observations;
use observe::unknowns::{Freedom, Shape, Station, Unknowns};

/// What can be seen of the errors.
#[derive(Debug, Clone, PartialEq)]
pub struct Visible {
    /// Errors that are asked for.
    pub errors: usize,
    /// Independent combinations that can be seen, as many as the rank: errors with their factors, the first 1.
    pub combinations: Vec<Vec<(SymbolId, f64)>>,
    /// Errors that can be told from all others.
    pub alone: Vec<SymbolId>,
    /// Errors that no combination holds: nothing shows them.
    pub hidden: Vec<SymbolId>,
}

/// Something that would show more.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Remedy {
    /// The length between two objects.
    OneLength,
    /// Where the stations are.
    KnownStations,
    /// Where the objects are.
    KnownObjects,
    /// Where both are.
    KnownBoth,
}

/// What a set-up can see, and what would show the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct SetUp {
    /// Rows.
    pub rows: usize,
    /// Stations that rows name, and how many of them are not known.
    pub stations: [usize; 2],
    /// Objects, and how many of them are not known.
    pub objects: [usize; 2],
    /// As it is.
    pub now: Visible,
    /// What would show more combinations than are seen now, and what one sees then.
    pub remedies: Vec<(Remedy, Visible)>,
}

/// What these rows can see of the errors that are to be estimated, from these places.
///
/// # Errors
/// As a fit of them would have.
pub fn identify(chain: &Chain, observations: &Observations, options: &FitOptions) -> Result<SetUp, FitError> {
    let model = Model::new(chain, &observations.poses, &options.estimate)?.for_determination();
    let now = visible(chain, &model, observations, options)?;
    let mut set_up =
        SetUp { rows: observations.rows(), stations: [0; 2], objects: [0; 2], now, remedies: Vec::new() };
    let Some(unknowns) = &observations.unknowns else { return Ok(set_up) };
    let named = |number: usize| unknowns.station.iter().any(|&own| own as usize == number);
    let stations = unknowns.stations.iter().enumerate().filter(|(number, _)| named(*number));
    set_up.stations = count(stations.map(|(_, station)| station.freedom == Freedom::Given));
    set_up.objects = count(unknowns.objects.iter().map(|object| object.freedom == Freedom::Given));
    for remedy in [Remedy::OneLength, Remedy::KnownStations, Remedy::KnownObjects, Remedy::KnownBoth] {
        let Some(known) = remedy.known(unknowns) else { continue };
        let with = Observations { unknowns: Some(known), ..observations.clone() };
        let seen = visible(chain, &model, &with, options)?;
        let most = set_up.remedies.iter().map(|(_, seen)| seen.combinations.len());
        if seen.combinations.len() > most.chain([set_up.now.combinations.len()]).max().unwrap_or(0) {
            set_up.remedies.push((remedy, seen));
        }
    }
    Ok(set_up)
}

/// How many there are, and how many of them are not known.
fn count(known: impl Iterator<Item = bool>) -> [usize; 2] {
    known.fold([0, 0], |[all, unknown], known| [all + 1, unknown + usize::from(!known)])
}

impl Remedy {
    /// The unknowns with it, where it changes anything.
    fn known(self, unknowns: &Unknowns) -> Option<Unknowns> {
        let mut known = unknowns.clone();
        let stations = known.stations.iter().any(|station| station.freedom != Freedom::Given);
        let objects = known.objects.iter().any(|object| object.freedom != Freedom::Given);
        let (of_stations, of_objects) = match self {
            Self::OneLength => {
                // Where nothing else holds the frame, two points that stay are a length between them, and the frame.
                let free = |station: &Station| station.freedom == Freedom::Free || station.label.is_empty();
                let nothing_held = known.stations.iter().all(free)
                    && known.station.iter().all(|&own| !known.stations[own as usize].label.is_empty())
                    && known.objects.iter().all(|object| object.freedom == Freedom::Free);
                let points = known.objects.iter_mut().filter(|object| object.shape == Shape::Point);
                let two: Vec<_> = points.take(2).collect();
                if !nothing_held || two.len() < 2 {
                    return None;
                }
                two.into_iter().for_each(|object| object.freedom = Freedom::Given);
                return Some(known);
            }
            Self::KnownStations => (stations, false),
            Self::KnownObjects => (false, objects),
            Self::KnownBoth => (stations && objects, stations && objects),
        };
        if !of_stations && !of_objects {
            return None;
        }
        if of_stations {
            known.stations.iter_mut().for_each(|station| station.freedom = Freedom::Given);
        }
        if of_objects {
            known.objects.iter_mut().for_each(|object| object.freedom = Freedom::Given);
        }
        Some(known)
    }
}

/// What can be seen with every error at zero.
fn visible(
    chain: &Chain,
    model: &Model,
    observations: &Observations,
    options: &FitOptions,
) -> Result<Visible, FitError> {
    let layout = Layout::of(observations);
    let mut values = options.start.clone();
    values.resize(chain.symbols.len(), 0.0);
    for &id in &options.estimate {
        if chain.symbol(id).kind == SymbolKind::Error {
            values[id.index()] = 0.0;
        }
    }
    values.resize(chain.symbols.len() + observations.unknowns.as_ref().map_or(0, Unknowns::numbers), 0.0);
    let sigma = vec![1.0; layout.components()];
    let tally = tally(model, observations, &layout, &values, &sigma, Weighting::Full)?;
    let parameters = model.parameters();
    // What noise tells of a scale that nothing holds is nothing.
    let unheld = unheld_scales(chain, observations, options);
    let column = |(id, column): (&SymbolId, &Option<usize>)| column.filter(|_| !unheld.contains(id));
    let partial =
        tally.partial.spread(&parameters.iter().zip(model.column_of()).map(column).collect::<Vec<_>>());
    let subspace = Subspace::determined(&partial, vec![1.0; parameters.len()]);
    let pick = |chosen: &[bool]| {
        let all = parameters.iter().zip(chosen).filter(|(_, chosen)| **chosen);
        all.map(|(&id, _)| id).collect::<Vec<_>>()
    };
    let shown = subspace.shown();
    let alone: Vec<bool> =
        subspace.separable().iter().zip(&shown).map(|(alone, shown)| *alone && *shown).collect();
    let hidden: Vec<bool> = shown.iter().map(|shown| !shown).collect();
    let combinations = subspace.combinations().into_iter();
    Ok(Visible {
        errors: parameters.len(),
        combinations: combinations
            .map(|one| one.into_iter().map(|(at, factor)| (parameters[at], factor)).collect())
            .collect(),
        alone: pick(&alone),
        hidden: pick(&hidden),
    })
}
