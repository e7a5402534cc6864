//! What other fields call the errors that a declaration has already.

use model_core::{SymbolId, forms};

use super::mount::Mount;
use super::{Name, Shape, proportional, shapes};
use crate::candidate::{Setting, seen};
use model_core::algebra::Poly;

/// The names of each declared error that has any; none for chains whose line of sight runs in another way, or that have no closed form.
#[must_use]
pub fn names_of_errors(setting: &Setting<'_>) -> Vec<(SymbolId, Vec<Name>)> {
    let Some(mount) = Mount::of(setting) else { return Vec::new() };
    let Ok(form) = forms::derive(setting.chain, mount.observable, 1) else { return Vec::new() };
    let shapes = shapes(&mount);
    let [across, along, out] = &mount.frame;
    let of_error = |(error, change): (SymbolId, [Poly; 3])| {
        let radial = if mount.range.is_some() { seen::dot(out, &change) } else { Poly::zero() };
        let own: Shape = [seen::dot(across, &change), seen::dot(along, &change), radial];
        let names = shapes.iter().filter(|(_, shape)| proportional(setting, &own, shape));
        (error, names.map(|(name, _)| name.clone()).collect::<Vec<_>>())
    };
    let named = form.columns(setting.chain).into_iter().map(of_error);
    named.filter(|(_, names)| !names.is_empty()).collect()
}
