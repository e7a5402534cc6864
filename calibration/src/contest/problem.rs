//! What a contest is asked: a fit's residual, the columns of its errors and places, and the catalogue's effects.

use std::collections::BTreeMap;

use evidence::problem::{Declared, Frame, Freedom as Moves, Input, Joint, Offered, Place as Point, Rows};
use evidence::{Driver, Problem};
use model_core::algebra::Poly;
use model_core::{BodyId, Meaning, Role, SymbolId, SymbolKind, TransformKind};

use fit::noise::{Layout, Mute, resolution};

use crate::search::SearchError;
use crate::search::columns::functions::Functions;
use crate::search::columns::{Columns, Probed, places};
use crate::search::context::{Context, declared};
use crate::search::fitted::Fitted;
use effects::candidate::{Dependence, Effect, EffectId, Kind, Place};

/// A problem, and what its offered effects are in the catalogue.
pub(super) struct Asked {
    pub problem: Problem,
    /// Of each offered effect.
    pub effects: Vec<EffectId>,
}

/// The problem at a fit: what its effects explain counts as not yet explained.
pub(super) fn asked(whole: &Context<'_>, fitted: &Fitted) -> Result<Asked, SearchError> {
    let (chain, observations) = (&fitted.chain, whole.request.observations);
    let poses = &observations.poses;
    let columns = fitted.probed.columns(observations)?;
    let of_effects = columns.of_effects(chain, &whole.catalogue, poses, &fitted.fit.values);
    let mut residual = columns.residual.clone();
    fitted.put_back(&mut residual, |effect| of_effects[effect.0].iter().map(Vec::as_slice));

    let all = places(&whole.catalogue);
    let nominal = Probed::new(chain, poses, declared(whole), &chain.nominal_values(), &all)?;
    let nominal = nominal.columns(observations)?;
    let mut building = Building::new(whole, poses.rows());
    let points = building.points(&columns, &nominal);
    let mut functions = Functions::new(chain, poses, &fitted.fit.values);
    let (mut offered, mut effects) = (Vec::new(), Vec::new());
    for (number, effect) in whole.catalogue.iter().enumerate() {
        if of_effects[number].is_empty() {
            continue;
        }
        if let Some(own) = building.offered(effect, &mut functions) {
            offered.push(own);
            effects.push(EffectId(number));
        }
    }
    // What the fit found undetermined would only be seen through products of errors.
    let known = fitted.of_errors(&columns);
    let determined = &columns.declared * &known * known.transpose();
    let estimates = declared(whole).iter().enumerate().map(|(at, &id)| Declared {
        name: chain.symbol(id).name.clone(),
        estimate: fitted.fit.values[id.index()],
        column: determined.col_as_slice(at).to_vec(),
    });
    let mut problem = Problem {
        components: residual.len() / poses.rows().max(1),
        residual,
        sigma: sigma(whole),
        declared: estimates.collect(),
        frames: building.frames(),
        places: points,
        offered,
        rows: Rows {
            count: poses.rows(),
            joints: building.joints,
            inputs: building.inputs.into_iter().map(|(_, input)| input).collect(),
            labels: (!whole.request.observations.rows_are_alone()).then(|| of_groups(whole)),
            // Rows stand as they were written, and that is nearly always as they were measured; another order has no memory to show.
            in_order: true,
            given: building.given,
        },
    };
    keep_what_speaks(&mut problem, whole, fitted);
    Ok(Asked { problem, effects })
}

/// Leaves out components of a row that show nothing but rounding: under any noise they would seem to explain themselves.
fn keep_what_speaks(problem: &mut Problem, whole: &Context<'_>, fitted: &Fitted) {
    let observations = whole.request.observations;
    let layout = Layout::of(observations);
    let mute = Mute::of(observations, &layout, &fitted.fit.residuals.raw, resolution(observations));
    let count = problem.components;
    let speaks: Vec<bool> = (0..count).map(|component| !mute.is(component)).collect();
    if speaks.iter().all(|speaks| *speaks) {
        return;
    }
    let keep = |values: &mut Vec<f64>| {
        let mut at = 0;
        values.retain(|_| {
            at += 1;
            speaks[(at - 1) % count]
        });
    };
    keep(&mut problem.residual);
    problem.sigma.iter_mut().for_each(keep);
    problem.declared.iter_mut().for_each(|declared| keep(&mut declared.column));
    for place in &mut problem.places {
        keep(&mut place.column);
        place.nominal.iter_mut().for_each(keep);
    }
    problem.components = speaks.iter().filter(|speaks| **speaks).count();
}

/// The declared group of each row.
fn of_groups(whole: &Context<'_>) -> Vec<usize> {
    let groups = &whole.request.observations.groups;
    let mut known = groups.clone();
    known.sort_unstable();
    known.dedup();
    groups.iter().map(|group| known.partition_point(|other| other < group)).collect()
}

/// Stated uncertainties of each value, where every row states them.
fn sigma(whole: &Context<'_>) -> Option<Vec<f64>> {
    let observations = whole.request.observations;
    let mut all = Vec::new();
    for series in &observations.poses.series {
        let components = series.measure.components();
        for own in observations.sigma.get(series.rows.clone())? {
            all.extend_from_slice(own.as_ref()?.get(..components)?);
        }
    }
    all.iter().all(|value| *value > 0.0).then_some(all)
}

/// A problem while it is built.
struct Building<'a> {
    whole: &'a Context<'a>,
    spots: Vec<(BodyId, Role)>,
    places: Vec<Place>,
    symbols: Vec<SymbolId>,
    joints: Vec<Joint>,
    inputs: Vec<(SymbolId, Input)>,
    known: BTreeMap<String, usize>,
    given: Vec<Vec<f64>>,
}

impl<'a> Building<'a> {
    fn new(whole: &'a Context<'a>, rows: usize) -> Self {
        let (setting, poses) = (&whole.setting, &whole.request.observations.poses);
        let mut symbols: Vec<SymbolId> = Vec::new();
        let mut joints = Vec::new();
        for axis in setting.joints() {
            let Some(values) = poses.column(axis.symbol) else { continue };
            if symbols.contains(&axis.symbol) {
                continue;
            }
            let sense = Kind::Direction(axis.symbol);
            let sense = setting.inputs.iter().find(|&&input| Kind::of(setting, input) == sense);
            symbols.push(axis.symbol);
            joints.push(Joint {
                name: setting.name(axis.symbol).to_owned(),
                values: values.to_vec(),
                direction: sense.and_then(|&input| poses.column(input)).map(<[f64]>::to_vec),
                from_horizon: false,
            });
        }
        let is_quantity = |input: SymbolId| {
            matches!(Kind::of(setting, input), Kind::Temperature | Kind::Time)
                || matches!(setting.chain.symbol(input).meaning, Some(Meaning::Pressure | Meaning::Humidity))
        };
        let of_inputs = setting
            .inputs
            .iter()
            .filter(|&&input| setting.chain.symbol(input).kind == SymbolKind::Input && is_quantity(input));
        let inputs = of_inputs.filter_map(|&input| {
            let values = poses.column(input)?.to_vec();
            let is_time = Kind::of(setting, input) == Kind::Time;
            Some((input, Input { name: setting.name(input).to_owned(), values, is_time }))
        });
        let inputs = inputs.filter(|(_, input)| input.values.len() == rows).collect();
        let spots = setting
            .bodies()
            .into_iter()
            .flat_map(|body| [Role::PositionError, Role::MotionError].map(|role| (body, role)))
            .collect();
        Self {
            whole,
            spots,
            places: Vec::new(),
            symbols,
            joints,
            inputs,
            known: BTreeMap::new(),
            given: Vec::new(),
        }
    }

    /// The places of the catalogue, with their columns.
    fn points(&mut self, columns: &Columns, nominal: &Columns) -> Vec<Point> {
        let setting = &self.whole.setting;
        let axes = setting.joints();
        let number = |symbol: SymbolId| self.symbols.iter().position(|known| *known == symbol);
        let mut points = Vec::new();
        for ((place, column), (_, nominal)) in columns.probes().zip(nominal.probes()) {
            let spot = (place.body, place.role);
            let frame = self.spots.iter().position(|known| *known == spot).unwrap_or_else(|| {
                self.spots.push(spot);
                self.spots.len() - 1
            });
            let axis = place.freedom.axis.index() as u8;
            let turns = place.freedom.kind == TransformKind::Rotation;
            let of_body = axes.iter().filter(|axis| axis.body == place.body);
            let own = of_body.clone().find(|axis| axis.freedom == place.freedom);
            self.places.push(place);
            points.push(Point {
                name: format!("{}.{}", setting.body_name(place.body), place.freedom.word()),
                frame,
                freedom: if turns { Moves::Rotation(axis) } else { Moves::Shift(axis) },
                own: own.and_then(|axis| number(axis.symbol)),
                beside: of_body.filter_map(|axis| number(axis.symbol)).collect(),
                column: column.to_vec(),
                nominal: Some(nominal.to_vec()),
                gravity: None,
                loads: Vec::new(),
            });
        }
        points
    }

    /// The frames, once all places are known.
    fn frames(&self) -> Vec<Frame> {
        let at = |spot: (BodyId, Role), axis: usize| {
            self.places.iter().position(|place| {
                (place.body, place.role) == spot
                    && place.freedom.kind == TransformKind::Rotation
                    && place.freedom.axis.index() == axis
            })
        };
        let frame = |&spot: &(BodyId, Role)| Frame {
            name: self.whole.setting.body_name(spot.0).to_owned(),
            tilts: at(spot, 0).zip(at(spot, 1)).map(|(x, y)| [x, y]),
            whirl: None,
        };
        self.spots.iter().map(frame).collect()
    }

    /// An effect of the catalogue; none where a reading is missing or no number is finite.
    fn offered(&mut self, effect: &Effect, functions: &mut Functions<'_>) -> Option<Offered> {
        let mut columns = Vec::with_capacity(effect.functions.len());
        for function in &effect.functions {
            let mut terms = Vec::new();
            for place in effect.places() {
                let number = self.places.iter().position(|known| *known == place)?;
                for amount in function.at(effect.place, place) {
                    terms.push((number, self.given(amount, functions)?));
                }
            }
            columns.push(terms);
        }
        let place = self.places.iter().position(|known| *known == effect.place)?;
        let order = match effect.form {
            Dependence::Harmonic { order } => Some(order as usize),
            _ => None,
        };
        Some(Offered { name: effect.name.clone(), place, driver: self.driver(effect), order, columns })
    }

    fn driver(&self, effect: &Effect) -> Driver {
        let joint = |name: &str| self.joints.iter().position(|joint| joint.name == name);
        let input = |name: &str| self.inputs.iter().position(|(_, input)| input.name == name);
        if let Some(joint) = joint(&effect.driver) {
            return Driver::Joint(joint);
        }
        if let Some(input) = input(&effect.driver) {
            return Driver::Input(input);
        }
        let mut read: Vec<usize> = effect
            .functions
            .iter()
            .flat_map(|function| function.symbols())
            .filter_map(|symbol| self.symbols.iter().position(|known| *known == symbol))
            .collect();
        read.sort_unstable();
        read.dedup();
        match read[..] {
            [] => Driver::Nothing,
            [only] => Driver::Joint(only),
            [first, second, ..] => Driver::Joints(first, second),
        }
    }

    fn given(&mut self, amount: &Poly, functions: &mut Functions<'_>) -> Option<usize> {
        let key = format!("{amount:?}");
        if let Some(&known) = self.known.get(&key) {
            return Some(known);
        }
        let values = functions.column(amount)?;
        if values.iter().any(|value| !value.is_finite()) {
            return None;
        }
        self.given.push(values);
        self.known.insert(key, self.given.len() - 1);
        Some(self.given.len() - 1)
    }
}
