//! The unit of each error and coefficient: what it multiplies, and what that moves, decide it.

use model_core::algebra::Poly;
use model_core::{Chain, SymbolId, SymbolKind, TransformKind};

use effects::candidate::{Kind, Setting};
use observe::SiUnit;

/// The unit of an error or constant of a chain that has it; that of its quantity where it stands in no factor alone.
pub(crate) fn unit_of(setting: &Setting<'_>, chain: &Chain, id: SymbolId) -> SiUnit {
    chain
        .factors()
        .filter(|factor| factor.amount.symbols().contains(&id))
        .find_map(|factor| {
            let parts = factor.amount.collect_by(|symbol| symbol == id);
            let (_, cofactor) = parts.into_iter().find(|(monomial, _)| matches!(monomial[..], [(_, 1)]))?;
            let moved = match factor.kind {
                TransformKind::Rotation => SiUnit::RAD,
                TransformKind::Translation => SiUnit::METRE,
            };
            Some(moved.per(of_amount(setting, chain, &cofactor)?))
        })
        .unwrap_or_else(|| chain.symbol(id).quantity.into())
}

/// The unit of an amount's first term; sines and cosines have none.
fn of_amount(setting: &Setting<'_>, chain: &Chain, amount: &Poly) -> Option<SiUnit> {
    let term = amount.terms().next()?;
    term.powers.iter().try_fold(SiUnit::ONE, |unit, &(id, power)| {
        Some(unit.times(of_reading(setting, chain, id).power(i8::try_from(power).ok()?)))
    })
}

/// The unit of a joint, an input or a constant.
pub(crate) fn of_reading(setting: &Setting<'_>, chain: &Chain, id: SymbolId) -> SiUnit {
    let symbol = chain.symbol(id);
    if symbol.kind != SymbolKind::Input || usize::from(id.0) >= setting.chain.symbols.len() {
        return symbol.quantity.into();
    }
    match Kind::of(setting, id) {
        Kind::Temperature => SiUnit::KELVIN,
        Kind::Time => SiUnit::SECOND,
        Kind::Rate(joint) => SiUnit::from(chain.symbol(joint).quantity).per(SiUnit::SECOND),
        Kind::Inverse(_) => SiUnit::METRE.power(-1),
        _ => symbol.quantity.into(),
    }
}
