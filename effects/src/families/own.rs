//! The user's own effects: functions written in the plain syntax of amounts, at a place that the user names.

use std::ops::Range;

use model_core::algebra::{AlgebraError, Poly};
use model_core::amount::LowerError;
use model_core::{Chain, Quantity, SymbolId, SymbolKind, names, syntax};

use crate::candidate::{Effect, Family, Freedom, Function, Place, Setting};

pub(super) const FAMILY: Family = Family {
    name: "own",
    what: "An effect that the study brings with it, for what only this instrument has.",
    causes: "What its maker knows.",
    looks: "The pattern of its functions.",
    check: "What its maker suggests.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    setting.own.iter().filter(|effect| effect.family == FAMILY.name).cloned().collect()
}

/// Why a function is none that an effect can have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OwnError {
    /// Which of the functions.
    pub function: usize,
    /// Where in its text, in bytes.
    pub place: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// What to write instead; may be empty.
    pub help: String,
}

/// Reads an effect of `name` from its functions of joints, inputs and constants; each gets a new error that multiplies it.
///
/// # Errors
/// The first function that cannot be read, is not of joints and inputs, or measures what the place cannot.
pub fn own(chain: &Chain, name: &str, place: Place, functions: &[&str]) -> Result<Effect, OwnError> {
    let read = |(number, text): (usize, &&str)| {
        let amount = amount(chain, place.freedom, text).map_err(|refused| refused.of(number))?;
        let stem = if functions.len() == 1 { stem(name) } else { format!("{}_{}", stem(name), number + 1) };
        Ok(Function::new(amount, stem))
    };
    let functions: Vec<Function> = functions.iter().enumerate().map(read).collect::<Result<_, _>>()?;
    let mut drivers: Vec<&str> = Vec::new();
    for symbol in functions.iter().flat_map(Function::symbols) {
        let symbol = chain.symbol(symbol);
        let moves = matches!(symbol.kind, SymbolKind::Joint | SymbolKind::Input);
        if moves && !drivers.contains(&symbol.name.as_str()) {
            drivers.push(&symbol.name);
        }
    }
    let driver = if drivers.is_empty() { "none".to_owned() } else { drivers.join(", ") };
    Ok(Effect {
        bends: None,
        family: FAMILY.name,
        name: name.to_owned(),
        place,
        functions,
        driver,
        form: "own".into(),
    })
}

/// A name that a declaration can have: letters, digits and underscores, not starting with a digit.
fn stem(name: &str) -> String {
    let letters =
        name.trim().chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' });
    let mut stem: String = letters.collect();
    while stem.contains("__") {
        stem = stem.replace("__", "_");
    }
    let stem = stem.trim_matches('_');
    if stem.is_empty() || stem.starts_with(|c: char| c.is_ascii_digit()) {
        format!("own_{stem}")
    } else {
        stem.to_owned()
    }
}

/// What is wrong with one function.
struct Refused {
    place: Range<usize>,
    message: String,
    help: String,
}

impl Refused {
    fn new(place: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { place, message: message.into(), help: help.into() }
    }

    fn of(self, function: usize) -> OwnError {
        OwnError { function, place: self.place, message: self.message, help: self.help }
    }
}

/// The canonical form of a function.
fn amount(chain: &Chain, freedom: Freedom, text: &str) -> Result<Poly, Refused> {
    let expression = syntax::parse_amount(text).map_err(|mistakes| {
        let first = mistakes.iter().next();
        let place = first.map(|mistake| mistake.place.bytes.clone()).filter(|place| !place.is_empty());
        let place = place.unwrap_or(0..text.len());
        let message = first.map_or_else(String::new, |mistake| mistake.message.clone());
        Refused::new(place, message, first.and_then(|mistake| mistake.help.clone()).unwrap_or_default())
    })?;
    let is_angle = |id: SymbolId| {
        let symbol = chain.symbol(id);
        symbol.kind != SymbolKind::Error && symbol.quantity == Quantity::Angle
    };
    let poly = Poly::from_expr(&expression, |name| chain.find_symbol(name), is_angle)
        .map_err(|error| refused(chain, error))?;
    if poly.is_zero() {
        return Err(Refused::new(0..text.len(), "this function is zero everywhere", "leave it out"));
    }
    let of_error = poly.symbols().into_iter().find(|&id| chain.symbol(id).kind == SymbolKind::Error);
    if let Some(error) = of_error {
        let name = &chain.symbol(error).name;
        let used = expression.names().into_iter().find(|(used, _)| used == name);
        let place = used.map_or(0..text.len(), |(_, place)| place);
        let message =
            format!("`{name}` is an error of the chain: an effect is linear in new errors of its own");
        return Err(Refused::new(place, message, "write functions of joints, inputs and constants alone"));
    }
    same_unit(chain, freedom, &poly).map_err(|message| {
        Refused::new(
            0..text.len(),
            message,
            "write one function for each; every function gets an error of its own",
        )
    })?;
    Ok(poly)
}

fn refused(chain: &Chain, error: LowerError<Range<usize>>) -> Refused {
    let place = error.place().clone();
    match error {
        LowerError::UnknownSymbol { name, .. } => {
            let known = || {
                chain
                    .symbols
                    .iter()
                    .filter(|symbol| symbol.kind != SymbolKind::Error)
                    .map(|s| s.name.as_str())
            };
            let help = names::nearest(&name, known()).map_or_else(
                || format!("there are {}", known().collect::<Vec<_>>().join(", ")),
                |near| format!("did you mean `{near}`?"),
            );
            Refused::new(place, format!("no joint, input or constant is called `{name}`"), help)
        }
        LowerError::Algebra { error: AlgebraError::NotDivisible, .. } => Refused::new(
            place,
            "only numbers, and sines and cosines of one angle, can be divided by",
            "give the study a column that holds the quotient",
        ),
        other => Refused::new(place, other.to_string(), ""),
    }
}

/// All terms measure the same: a length added to an angle has no meaning, whatever error multiplies them.
fn same_unit(chain: &Chain, freedom: Freedom, poly: &Poly) -> Result<(), String> {
    // Radians are plain numbers where a length is asked for, as in a lead screw.
    let plain = |quantity| quantity == Quantity::Angle && freedom.quantity() == Quantity::Length;
    let units = poly.terms().map(|term| {
        let mut unit = [0_u32; 2];
        for (id, power) in &term.powers {
            match chain.symbol(*id).quantity {
                quantity if plain(quantity) => {}
                Quantity::Angle if *id == SymbolId::PI => {}
                Quantity::Angle => unit[0] += power,
                Quantity::Length => unit[1] += power,
                Quantity::Number => {}
            }
        }
        unit
    });
    let mut units: Vec<[u32; 2]> = units.collect();
    units.sort_unstable();
    units.dedup();
    let words = |[angles, lengths]: [u32; 2]| match (angles, lengths) {
        (0, 0) => "a plain number".to_owned(),
        (1, 0) => "an angle".to_owned(),
        (0, 1) => "a length".to_owned(),
        (angles, lengths) => format!("rad^{angles} m^{lengths}"),
    };
    match units.as_slice() {
        [one, other, ..] => Err(format!("{} is added to {}", words(*one), words(*other))),
        _ => Ok(()),
    }
}
