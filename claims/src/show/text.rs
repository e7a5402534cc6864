//! Verdicts as a referee would write them.

use std::fmt::Write as _;

use crate::checker::entries::EntriesVerdict;
use crate::checker::{
    BoundVerdict, Claim, Counted, Difference, FormVerdict, Means, Measured, Outcome, RankSaid, RankVerdict,
    SizeVerdict, TotalVerdict, ValueVerdict, Verdict, hand,
};
use model_core::escape::{Screen, line};
use model_core::mistake::Excerpt;
use model_core::print::Hand;
use model_core::{Chain, budget, print};

use crate::file::{Checked, Claims, NamedClaim};

/// What stands before and behind a word that is painted: a terminal's colours, or nothing.
#[derive(Debug, Clone, Default)]
pub struct Paint {
    /// Around `holds`.
    pub good: [String; 2],
    /// Around `differs`, `open` and carets.
    pub bad: [String; 2],
    /// Around names.
    pub heading: [String; 2],
}

/// All verdicts of a file.
pub fn as_text(file: &Claims, checked: &[Checked<'_>], paint: &Paint) -> Screen {
    let mut out = Screen::default();
    for Checked { claim, verdict } in checked {
        let (style, word) = match verdict.outcome() {
            Outcome::Holds => (&paint.good, "holds"),
            Outcome::Differs => (&paint.bad, "differs"),
            Outcome::Undecided => (&paint.bad, "open"),
        };
        let means = match verdict.means() {
            Means::Decided => "",
            Means::Computed => " (computed)",
            Means::Sampled => " (sampled)",
            Means::Proven => " (proven)",
        };
        let means = if verdict.outcome() == Outcome::Undecided { "" } else { means };
        painted(&mut out, style, word);
        let _ = write!(out, "{}  ", " ".repeat("differs".len() - word.len()));
        painted(&mut out, &paint.heading, &line(&claim.name));
        let _ = writeln!(out, "{means}");
        let style = if claim.is_plain { print::Style::Text } else { print::Style::Latex };
        match verdict {
            Verdict::ClosedForm(form) => {
                let hand = hand::of_claim(&file.hand, &file.chain, &claim.claim);
                write_form(
                    &mut out,
                    &Written { paint, chain: &file.printed, style, hand: &hand },
                    claim,
                    form,
                );
            }
            Verdict::Equality(equality) => {
                if !equality.difference.is_zero() {
                    let difference = equality.difference.show_by(&file.printed, style, &file.hand);
                    let _ = writeln!(out, "    {}{difference}", equality.words());
                }
            }
            Verdict::Total(total) => write_total(&mut out, &file.printed, total, style),
            Verdict::Comparison(measured) => write_measured(&mut out, &file.chain, &claim.claim, measured),
            Verdict::Count(counted) => write_counted(&mut out, counted),
            Verdict::Rank(rank) => write_rank(&mut out, &file.chain, &claim.claim, rank),
            Verdict::Size(size) => write_size(&mut out, &file.chain, &claim.claim, size),
            Verdict::Bound(bound) => write_bound(&mut out, &file.chain, &claim.claim, bound),
            Verdict::Entries(entries) => write_entries(&mut out, &file.printed, entries, style),
            Verdict::Values(values) => write_values(&mut out, &file.chain, &claim.claim, values),
        }
    }
    let held = checked.iter().filter(|checked| checked.verdict.holds()).count();
    let _ = writeln!(out, "\n{held} of {} claims hold", checked.len());
    out
}

/// Words in a paint.
fn painted(out: &mut Screen, [on, off]: &[String; 2], words: &str) {
    out.styled([on, off], words);
}

/// How formulas are written.
struct Written<'a> {
    paint: &'a Paint,
    chain: &'a Chain,
    style: print::Style,
    hand: &'a Hand,
}

/// The differences of a formula, in the symbols of the print.
fn write_form(out: &mut Screen, written: &Written<'_>, claim: &NamedClaim, form: &FormVerdict) {
    let Written { paint, chain, style, hand } = *written;
    if form.differences.is_empty() {
        return;
    }
    let Claim::ClosedForm(claimed) = &claim.claim else { return };
    let observable = claimed.observable;
    let shown = chain.observable(observable);
    for difference in &form.differences {
        let printed =
            quoted(claim, difference).unwrap_or_else(|| difference.printed.show_by(chain, style, hand));
        let _ = writeln!(
            out,
            "    {}, {}: printed {printed}, derived {}",
            shown.label(difference.component.index()),
            print::poly(&difference.error_product(), chain, style),
            difference.derived.show_by(chain, style, hand),
        );
        if let Some((text, before, width)) = place_in_text(claim, difference) {
            let Excerpt { shown, padding, width } = Excerpt::new(text, before, width);
            let _ = write!(out, "        {shown}\n        {padding}");
            painted(out, &paint.bad, &"^".repeat(width));
            let _ = writeln!(out);
        }
        if let Some(slip) = &difference.slip {
            let _ = writeln!(out, "        {}", slip.describe(chain, observable, style));
        }
    }
    for slip in &form.slips {
        let _ = writeln!(out, "    {}", slip.describe(chain, observable));
    }
    let roots: Vec<String> = form
        .positive
        .iter()
        .map(|root| format!("{} > 0", print::by_hand(root, chain, style, hand)))
        .collect();
    let place = if roots.is_empty() { String::new() } else { format!(", where {}", roots.join(" and ")) };
    let _ = writeln!(out, "    what the chain implies{place}:");
    // Of one number that is claimed, the others were not derived.
    let is_claimed = |at: usize| claimed.only.is_none_or(|only| only.index() == at);
    for (_, (label, component)) in
        shown.labels().zip(&form.derived).enumerate().filter(|&(at, _)| is_claimed(at))
    {
        let _ = writeln!(out, "        {label}: {}", component.show_by(chain, style, hand));
    }
}

/// The printed term as it is printed, if it is one.
fn quoted(claim: &NamedClaim, difference: &Difference) -> Option<String> {
    let text = text_of(claim, difference)?;
    let term = text.get(difference.term.clone()?)?;
    Some(format!("`{}`", term.split_whitespace().collect::<Vec<_>>().join(" ")))
}

/// The text that the component of a difference stands in.
fn text_of<'a>(claim: &'a NamedClaim, difference: &Difference) -> Option<&'a str> {
    let Claim::ClosedForm(form) = &claim.claim else { return None };
    let component = &form.printed.components[difference.component.index()];
    claim.texts.get(component.text_index).map(String::as_str)
}

/// The line of the printed text that a difference stands on, and where on it: characters before, and width.
pub(super) fn place_in_text<'a>(
    claim: &'a NamedClaim,
    difference: &Difference,
) -> Option<(&'a str, usize, usize)> {
    let text = text_of(claim, difference)?;
    let place = difference.place.clone()?;
    let start = text.get(..place.start)?.rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[start..].lines().next()?;
    let before = text.get(start..place.start)?.chars().count();
    let inside = text.get(place)?.lines().next()?;
    Some((line, before, inside.chars().count().max(1)))
}

fn write_total(out: &mut Screen, chain: &Chain, total: &TotalVerdict, style: print::Style) {
    for (error, printed, derived) in &total.differences {
        let _ = writeln!(
            out,
            "    {}: printed {}, derived {}",
            print::poly(&product(error), chain, style),
            printed.show(chain, style),
            derived.show(chain, style)
        );
    }
    if !total.differences.is_empty() {
        let _ = writeln!(out, "    what belongs below the root: {}", total.derived.show(chain, style));
    }
}

/// A product of errors as an amount.
pub(super) fn product(error: &[(model_core::SymbolId, u32)]) -> model_core::algebra::Poly {
    use model_core::algebra::Poly;
    error.iter().fold(Poly::one(), |product, &(symbol, power)| {
        (0..power).fold(product, |product, _| &product * &Poly::symbol(symbol))
    })
}

fn write_entries(out: &mut Screen, chain: &Chain, verdict: &EntriesVerdict, style: print::Style) {
    for difference in &verdict.differences {
        let _ = writeln!(
            out,
            "    {}: printed {}, derived {}",
            difference.label,
            difference.printed.show(chain, style),
            difference.derived.show(chain, style)
        );
    }
}

fn write_values(out: &mut Screen, chain: &Chain, claim: &Claim, verdict: &[ValueVerdict]) {
    let Claim::Values(values) = claim else { return };
    let shown = chain.observable(values.observable);
    for (value, reading) in verdict.iter().zip(&shown.shown) {
        if !value.holds() {
            let unit = reading.unit(shown.kind);
            let _ = writeln!(
                out,
                "    {}: printed {:e} {unit}, computed {:e} {unit}",
                value.label, value.claimed, value.found
            );
        }
    }
}

fn write_measured(out: &mut Screen, chain: &Chain, claim: &Claim, measured: &Measured) {
    let Claim::Comparison(comparison) = claim else { return };
    let unit = budget::unit(chain, comparison.observable);
    let name = |id| &chain.symbol(id).name;
    let ratio = measured.ratio.map_or("no ratio".to_owned(), |ratio| format!("ratio {}", short(ratio)));
    let _ = writeln!(
        out,
        "    {} {} {unit}, {} {} {unit}: {ratio}, claimed at most {}",
        name(comparison.error),
        short(measured.error),
        name(comparison.against),
        short(measured.against),
        measured.at_most
    );
}

fn write_counted(out: &mut Screen, counted: &Counted) {
    if counted.found != counted.claimed {
        let _ = writeln!(
            out,
            "    {} are declared, {} are claimed: {}",
            counted.found,
            counted.claimed,
            counted.names.join(", ")
        );
    }
}

fn write_rank(out: &mut Screen, chain: &Chain, claim: &Claim, verdict: &RankVerdict) {
    let Claim::Rank(rank) = claim else { return };
    let names: Vec<&str> = verdict.exceptions.iter().map(|&id| chain.symbol(id).name.as_str()).collect();
    let names = names.join(", ");
    let _ = match &rank.said {
        RankSaid::Is(claimed) if verdict.rank != *claimed => writeln!(
            out,
            "    {} combinations of {} errors are determined, {claimed} are claimed",
            verdict.rank, verdict.errors
        ),
        RankSaid::Confounded if !verdict.holds => writeln!(out, "    determined without the others: {names}"),
        RankSaid::Separable(_) if !verdict.holds => {
            writeln!(out, "    not to be told from the others: {names}")
        }
        _ => Ok(()),
    };
}

fn write_size(out: &mut Screen, chain: &Chain, claim: &Claim, verdict: &SizeVerdict) {
    let Claim::Size(size) = claim else { return };
    let unit = budget::unit(chain, size.observable);
    let mut said = format!("found {} {unit}", short(verdict.found));
    if let Some(poses) = verdict.poses {
        let [low, high] = verdict.between.map(short);
        let _ = write!(said, " at {poses} poses, between {low} and {high} for certain enough");
    }
    for (word, limit) in [("most", size.limits.at_most), ("least", size.limits.at_least)] {
        if let Some(limit) = limit {
            let _ = write!(said, ", claimed at {word} {} {unit}", short(limit));
        }
    }
    let _ = writeln!(out, "    {said}");
}

fn write_bound(out: &mut Screen, chain: &Chain, claim: &Claim, verdict: &BoundVerdict) {
    let Claim::Bound(bound) = claim else { return };
    let unit = budget::unit(chain, bound.observable);
    let found = verdict.found.map_or(String::new(), |found| format!(", found {} {unit}", short(found)));
    let _ = writeln!(
        out,
        "    never more than {} {unit}{found}, claimed at most {} {unit}",
        short(verdict.proven),
        short(bound.at_most)
    );
}

/// Four digits are enough for a reader.
fn short(number: f64) -> String {
    match number.abs() {
        0.0 => "0".to_owned(),
        0.01..1e4 => format!("{number:.4}"),
        _ => format!("{number:.3e}"),
    }
}
