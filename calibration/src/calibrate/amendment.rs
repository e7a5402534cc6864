//! The lines of the amended declaration: what was found and when; the statistics stay in the report.

use model_core::{Chain, ObservableId, Quantity, Symbol, SymbolId, SymbolKind};

use crate::amend::{Addition, NewInput};
use crate::diagnose::Diagnosis;
use crate::search::context::{Context, Found};
use effects::candidate::Function;

/// The lines to add to the declaration, for the effects of a chain that has them.
pub(crate) fn additions(
    whole: &Context<'_>,
    diagnosis: &Diagnosis,
    chain: &Chain,
    found: &[Found],
    errors: &[Vec<SymbolId>],
) -> Vec<Addition> {
    let each = found.iter().zip(errors).zip(&diagnosis.effects);
    each.flat_map(|((found, errors), told)| {
        let effect = &whole.catalogue[found.effect];
        let others = match told.causes.len() - 1 {
            0 => String::new(),
            1 => ", or one other cause that fits as well".to_owned(),
            others => format!(", or one of {others} other causes that fit as well"),
        };
        let documentation = format!("Found {} by calibration: {}{others}.", whole.request.when, effect.name);
        effect.texts(chain, errors).into_iter().map(move |(spot, text)| Addition {
            spot,
            text,
            documentation: vec![documentation.clone()],
        })
    })
    .collect()
}

/// Inputs that accepted effects use and the declaration does not have.
pub(crate) fn new_inputs(whole: &Context<'_>, chain: &Chain, found: &[Found]) -> Vec<NewInput> {
    let declared = Chain::from_text(whole.request.text);
    let mut used: Vec<SymbolId> = found
        .iter()
        .flat_map(|found| &whole.catalogue[found.effect].functions)
        .flat_map(Function::amounts)
        .flat_map(|amount| chain.symbols_in(amount))
        .filter(|&symbol| chain.symbol(symbol).kind == SymbolKind::Input)
        .flat_map(|symbol| std::iter::once(symbol).chain(chain.symbol(symbol).of))
        .filter(|&symbol| chain.symbol(symbol).kind == SymbolKind::Input)
        .collect();
    used.sort_unstable();
    used.dedup();
    let is_new = |name: &str| declared.as_ref().is_ok_and(|declared| declared.find_symbol(name).is_none());
    let measured = used.into_iter().map(|symbol| chain.symbol(symbol)).map(|symbol| NewInput {
        name: symbol.name.clone(),
        meaning: meaning(chain, symbol),
        documentation: "Measured beside the joints, in the unit of the data.".to_owned(),
    });
    let mut bent: Vec<ObservableId> = found
        .iter()
        .filter_map(|found| whole.catalogue[found.effect].bends.as_ref())
        .map(|bends| bends.observable)
        .collect();
    bent.sort_unstable();
    bent.dedup();
    let angles = bent.into_iter().filter_map(|observable| chain.sight_angle_of(observable)).map(|angle| {
        let sight = &chain.observable(angle.observable).name;
        NewInput {
            name: chain.symbol(angle.symbol).name.clone(),
            meaning: Some(format!("angle = between({sight}, up)")),
            documentation: "The zenith distance: the angle between what is observed and up.".to_owned(),
        }
    });
    measured.chain(angles).filter(|input| is_new(&input.name)).collect()
}

/// What an input is, as a declaration writes it.
fn meaning(chain: &Chain, symbol: &Symbol) -> Option<String> {
    match (symbol.meaning, symbol.of, symbol.quantity) {
        (Some(meaning), Some(of), _) => Some(format!("{} of {}", meaning.word(), chain.symbol(of).name)),
        (Some(meaning), None, _) => Some(meaning.word().to_owned()),
        (None, _, Quantity::Angle) => Some("angle".to_owned()),
        (None, _, Quantity::Length) => Some("length".to_owned()),
        (None, _, Quantity::Number) => None,
    }
}
