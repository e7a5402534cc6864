//! Chains of equalities: `A = B = C` is several claims, one for each formula that is said to be the same.

use std::ops::Range;

use toml::Spanned;

use super::super::table::{ClaimTable, Texts};
use super::each;
use crate::latex::{equal_sides, is_derivative};

/// What a table claims in several formulas that are said to be the same, one table for each; `None` where there is no chain.
pub(super) fn parts(claim: &ClaimTable) -> Option<Vec<ClaimTable>> {
    if let Some(equal) = &claim.equal {
        let pairs = pairs(equal)?;
        let number = pairs.len();
        let with = |at: usize, pair: [Spanned<String>; 2]| {
            let mut part = claim.clone();
            part.equal = Some(Spanned::new(equal.span(), Texts::Many(pair.into())));
            if number > 1 { named(part, &format!("equality {}", at + 1)) } else { part }
        };
        return Some(pairs.into_iter().enumerate().map(|(at, pair)| with(at, pair)).collect());
    }
    let most = texts(claim).into_iter().map(|text| equal_sides(text).len()).max()?;
    if most < 3 {
        return None;
    }
    // `J = \partial p/\partial q = …`: what says which derivative it is claims nothing.
    let is_definition = |side: usize| {
        let places =
            texts(claim).into_iter().filter_map(|text| Some((text, equal_sides(text).get(side)?.clone())));
        places.into_iter().any(|(text, place)| is_derivative(&text[place]))
    };
    let sides: Vec<usize> = (1..most).filter(|&side| !is_definition(side)).collect();
    if let [only] = sides.as_slice() {
        return Some(vec![with_side(claim, *only)]);
    }
    let part = |side: &usize| named(with_side(claim, *side), &format!("side {}", side + 1));
    Some(sides.iter().map(part).collect())
}

/// Neighbours in a chain of equalities; `None` where two formulas are given as they are.
fn pairs(equal: &Spanned<Texts>) -> Option<Vec<[Spanned<String>; 2]>> {
    let texts = each(equal);
    let all: Vec<Spanned<String>> = match texts.as_slice() {
        [(text, place)] => equal_sides(text)
            .into_iter()
            .map(|side| Spanned::new(place.clone(), only(text, &[side])))
            .collect(),
        many if many.len() > 2 => {
            many.iter().map(|(text, place)| Spanned::new(place.clone(), (*text).to_owned())).collect()
        }
        _ => return None,
    };
    let pairs: Vec<[Spanned<String>; 2]> =
        all.windows(2).filter_map(|pair| <[_; 2]>::try_from(pair.to_vec()).ok()).collect();
    (!pairs.is_empty()).then_some(pairs)
}

/// Every formula of a claim.
fn texts(claim: &ClaimTable) -> Vec<&str> {
    let many = [&claim.components, &claim.correction, &claim.shows, &claim.image];
    let single = [&claim.frame, &claim.jacobian, &claim.total];
    let many = many.into_iter().flatten().flat_map(each).map(|(text, _)| text);
    many.chain(single.into_iter().flatten().map(|text| text.get_ref().as_str())).collect()
}

/// The claim with one of the sides of every chain: the last where a chain has fewer.
fn with_side(claim: &ClaimTable, side: usize) -> ClaimTable {
    let mut part = claim.clone();
    for formulas in [&mut part.components, &mut part.correction, &mut part.shows, &mut part.image] {
        match formulas.as_mut().map(Spanned::get_mut) {
            Some(Texts::One(text)) => *text = chosen(text, side),
            Some(Texts::Many(many)) => {
                for text in many {
                    let text = text.get_mut();
                    *text = chosen(text, side);
                }
            }
            None => {}
        }
    }
    for formula in [&mut part.frame, &mut part.jacobian, &mut part.total].into_iter().flatten() {
        let text = formula.get_mut();
        *text = chosen(text, side);
    }
    part
}

/// The name and one of the sides of a chain.
fn chosen(text: &str, side: usize) -> String {
    let sides = equal_sides(text);
    let [first, .., last] = sides.as_slice() else { return text.to_owned() };
    let side = sides.get(side).unwrap_or(last);
    let equals = text.get(first.end..side.start).and_then(|between| between.find('='));
    let equals = equals.map(|at| first.end + at..first.end + at + 1);
    match equals {
        Some(equals) if sides.len() > 2 => only(text, &[first.clone(), equals, side.clone()]),
        _ => text.to_owned(),
    }
}

/// The text with blanks in place of all but these ranges, so that every place stays where it is.
fn only(text: &str, kept: &[Range<usize>]) -> String {
    let is_kept = |at: usize| kept.iter().any(|range| range.contains(&at));
    text.char_indices()
        .flat_map(|(at, letter)| {
            let (letter, times) = if is_kept(at) { (letter, 1) } else { (' ', letter.len_utf8()) };
            std::iter::repeat_n(letter, times)
        })
        .collect()
}

fn named(mut claim: ClaimTable, part: &str) -> ClaimTable {
    let name = format!("{}: {part}", claim.name.get_ref());
    claim.name = Spanned::new(claim.name.span(), name);
    claim
}
