//! Choosing from the catalogue by name: an effect's own, its family's, or one of another field's.

use model_core::names;

use super::known_names;
use crate::candidate::{Effect, Setting};
use crate::families::FAMILIES;

/// The effects that some names mean, in the catalogue's order; all of them without names. A name may hold `*` for any
/// letters. A name of another field means the effects that have it and the fewest other functions.
///
/// # Errors
/// The number of the first name that means no effect, and the nearest name that does.
pub fn chosen(
    setting: &Setting<'_>,
    catalogue: Vec<Effect>,
    wanted: &[String],
) -> Result<Vec<Effect>, (usize, Option<String>)> {
    if wanted.is_empty() {
        return Ok(catalogue);
    }
    let known = known_names(setting, &catalogue);
    let mut kept = vec![false; catalogue.len()];
    for (number, wanted) in wanted.iter().enumerate() {
        let ours =
            |effect: &Effect| names::matches(wanted, &effect.name) || names::matches(wanted, effect.family);
        let theirs = |effect: &usize| {
            let names = known.get(*effect).into_iter().flatten();
            let mut names = names.flat_map(|name| [name.name.clone(), name.to_string()]);
            names.any(|name| names::matches(wanted, &name))
        };
        let theirs: Vec<usize> = (0..catalogue.len()).filter(theirs).collect();
        let fewest = theirs.iter().map(|&effect| catalogue[effect].functions.len()).min();
        let mut any = false;
        for (number, effect) in catalogue.iter().enumerate() {
            let meant = ours(effect) || theirs.contains(&number) && Some(effect.functions.len()) == fewest;
            kept[number] |= meant;
            any |= meant;
        }
        if !any {
            let names = known.iter().flatten().map(|name| name.name.as_str());
            let all = FAMILIES.iter().map(|family| family.name).chain(names);
            let all = all.chain(catalogue.iter().map(|effect| effect.name.as_str()));
            return Err((number, names::nearest(wanted, all).map(str::to_owned)));
        }
    }
    Ok(catalogue.into_iter().zip(kept).filter(|&(_, kept)| kept).map(|(effect, _)| effect).collect())
}
