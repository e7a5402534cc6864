//! What of a chain an equation states.

use model_core::chain::BodyId;
use model_core::{Axis, Chain, ObservableId, SymbolId, SymbolKind};

use crate::checker::entries::{Entries, EntriesOf, EntryDifference};
use crate::checker::{Checker, Claim, ClosedForm, Difference, Order, PrintedVector, TermSlip, Verdict};
use crate::latex::{self, PrintedSymbols};

/// A way to read an equation as a claim: the keys of a claims file that say so.
#[derive(Debug, Clone)]
pub(super) struct Guess {
    /// Key and value as TOML has them, without the formula.
    pub keys: Vec<(&'static str, String)>,
    /// The key of the formula.
    pub key: &'static str,
    /// Whether it is a true statement.
    pub holds: bool,
    /// Terms that differ, of all that are compared.
    pub differs: [usize; 2],
    /// Of which error it is a claim: an observable, and one of its numbers or all.
    pub of: Option<(ObservableId, Option<usize>)>,
    /// Whether `R_z(\psi)` was read as a turn of vectors.
    pub turned: bool,
}

impl Guess {
    /// That two formulas are one.
    pub fn identity(turned: bool) -> Self {
        Self { keys: Vec::new(), key: "equal", holds: true, differs: [0, 1], of: None, turned }
    }
}

/// The statement about the chain that an equation makes: the first true one, or the one that most of its terms agree with.
pub(super) fn of_equation(
    checker: &mut Checker<'_>,
    chain: &Chain,
    symbols: &PrintedSymbols,
    text: &str,
    turns_vectors: bool,
) -> Option<Guess> {
    let mut best: Option<Guess> = None;
    let found = ways(chain);
    for way in &found {
        let Some(guess) = way.tried(checker, chain, symbols, text) else { continue };
        if guess.holds {
            return Some(guess);
        }
        // It could be a turn of axes.
        if guess.turned && !turns_vectors {
            continue;
        }
        let better = best
            .as_ref()
            .is_none_or(|best| guess.differs[0] * best.differs[1] < best.differs[0] * guess.differs[1]);
        if better {
            best = Some(guess);
        }
    }
    // What agrees with nothing for the most part says nothing of this chain.
    best.filter(|guess| guess.differs[0] * 2 < guess.differs[1])
}

/// One thing that an equation may state.
enum Way {
    /// The error of an observable, all numbers or one, and as a correction.
    Form { observable: ObservableId, is_correction: bool },
    /// One number of an observable's error.
    One { observable: ObservableId, at: usize },
    /// What an observable shows.
    Shown { observable: ObservableId, order: u32 },
    /// One number of what an observable shows, that the name says.
    OneShown { observable: ObservableId, order: u32 },
    /// What the name derives, by the one symbol that it says.
    Derivative { observable: ObservableId },
    /// How a body stands.
    Frame { body: BodyId, order: u32 },
    /// The derivatives of what an observable shows by symbols of a kind.
    Jacobian { observable: ObservableId, by: SymbolKind },
}

/// One number of an observable's error, however little of it agrees: what a name stands for is known already.
pub(super) fn of_component(
    checker: &mut Checker<'_>,
    chain: &Chain,
    symbols: &PrintedSymbols,
    text: &str,
    (observable, at): (ObservableId, usize),
) -> Option<Guess> {
    Way::One { observable, at }.tried(checker, chain, symbols, text)
}

fn ways(chain: &Chain) -> Vec<Way> {
    let observables = || (0u16..).zip(&chain.observables).map(|(index, shown)| (ObservableId(index), shown));
    let mut found = Vec::new();
    for (observable, shown) in observables() {
        found.push(Way::Form { observable, is_correction: false });
        if shown.is_vector() && !shown.is_orientation() {
            found.extend([0, 1].map(|order| Way::Shown { observable, order }));
        }
    }
    for (observable, shown) in observables() {
        found.extend((0..shown.shown.len()).map(|at| Way::One { observable, at }));
        found.push(Way::Form { observable, is_correction: true });
        if shown.has_components_only() && shown.is_vector() {
            found.extend([SymbolKind::Joint, SymbolKind::Error].map(|by| Way::Jacobian { observable, by }));
            found.push(Way::Derivative { observable });
            if !shown.is_orientation() {
                found.extend([0, 1].map(|order| Way::OneShown { observable, order }));
            }
        }
    }
    for body in (0u16..).zip(&chain.bodies).map(|(index, _)| BodyId(index)) {
        found.extend([0, 1].map(|order| Way::Frame { body, order }));
    }
    found
}

impl Way {
    fn tried(
        &self,
        checker: &mut Checker<'_>,
        chain: &Chain,
        symbols: &PrintedSymbols,
        text: &str,
    ) -> Option<Guess> {
        let all: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).collect();
        match *self {
            Self::Form { observable, is_correction } => {
                let shown = chain.observable(observable);
                let printed =
                    PrintedVector::read_shown(chain, symbols, shown, &[text], Order::UpTo(1)).ok()?;
                let key = if is_correction { "correction" } else { "components" };
                let keys = vec![("observable", shown.name.clone())];
                form(checker, chain, keys, key, (observable, None), &all, printed)
            }
            Self::One { observable, at } => {
                let shown = chain.observable(observable);
                let axis = AXES.get(at).copied()?;
                let printed =
                    PrintedVector::read_one(chain, symbols, text, shown, axis, Order::UpTo(1)).ok()?;
                let keys =
                    vec![("observable", shown.name.clone()), ("component", shown.label(at).to_owned())];
                form(checker, chain, keys, "components", (observable, Some(axis)), &all, printed)
            }
            Self::Shown { observable, order } => {
                let shown = chain.observable(observable);
                let names = vec![latex::NameOf::Formula; shown.shown.len()];
                let symbols = symbols.reading(&[text]);
                let (entries, notes) = PrintedVector::texts(&symbols, &names, &[text]).ok()?;
                let matrix = latex::PrintedMatrix { rows: entries.len(), columns: 1, entries, notes };
                if matrix.entries.len() != shown.shown.len() {
                    return None;
                }
                let keys = vec![("observable", shown.name.clone()), ("order", order.to_string())];
                let of = EntriesOf::Shown(observable);
                entries_of(checker, chain, (keys, "shows"), of, order, &all, matrix)
            }
            Self::OneShown { observable, order } => {
                let at = latex::shown_axis(text)?;
                let shown = chain.observable(observable);
                let names = [latex::NameOf::Component(at)];
                let symbols = symbols.reading(&[text]);
                let (entries, notes) = PrintedVector::texts(&symbols, &names, &[text]).ok()?;
                let matrix = latex::PrintedMatrix { rows: 1, columns: 1, entries, notes };
                let keys = vec![
                    ("observable", shown.name.clone()),
                    ("component", shown.label(at).to_owned()),
                    ("order", order.to_string()),
                ];
                let of = EntriesOf::Shown(observable);
                one_of(checker, chain, (keys, "shows"), (of, AXES.get(at).copied()), order, &all, matrix)
            }
            Self::Derivative { observable } => {
                let latex::Derivative { component, by } = latex::derivative_of(text)?;
                let symbol = chain.find_symbol(symbols.name_printed(&by)?)?;
                let symbols = symbols.reading(&[text]);
                let matrix = latex::read_matrix(text, &symbols).ok()?;
                let shown = chain.observable(observable);
                let rows = if component.is_some() { 1 } else { shown.shown.len() };
                if [matrix.rows, matrix.columns] != [rows, 1] {
                    return None;
                }
                let names = format!("[\"{}\"]", chain.symbol(symbol).name);
                let mut keys = vec![("observable", shown.name.clone()), ("by", names)];
                keys.extend(component.map(|at| ("component", shown.label(at).to_owned())));
                let of = EntriesOf::Jacobian { observables: vec![observable], by: vec![symbol] };
                let only = component.and_then(|at| AXES.get(at).copied());
                one_of(checker, chain, (keys, "jacobian"), (of, only), 1, &all, matrix)
            }
            Self::Frame { body, order } => {
                let symbols = symbols.reading(&[text]);
                let matrix = latex::read_matrix(text, &symbols).ok()?;
                if !matches!([matrix.rows, matrix.columns], [3, 3] | [4, 4]) {
                    return None;
                }
                let of = EntriesOf::Frame { body, frame: None, is_homogeneous: matrix.columns == 4 };
                let keys = vec![("body", chain.body(body).name.clone()), ("order", order.to_string())];
                entries_of(checker, chain, (keys, "frame"), of, order, &all, matrix)
            }
            Self::Jacobian { observable, by } => {
                let symbols = symbols.reading(&[text]);
                let matrix = latex::read_matrix(text, &symbols).ok()?;
                let shown = chain.observable(observable);
                let by: Vec<SymbolId> = chain.symbols_of(by).collect();
                if by.len() < 2 || [matrix.rows, matrix.columns] != [shown.shown.len(), by.len()] {
                    return None;
                }
                let names: Vec<String> =
                    by.iter().map(|&id| format!("\"{}\"", chain.symbol(id).name)).collect();
                let keys =
                    vec![("observable", shown.name.clone()), ("by", format!("[{}]", names.join(", ")))];
                let of = EntriesOf::Jacobian { observables: vec![observable], by };
                entries_of(checker, chain, (keys, "jacobian"), of, 1, &all, matrix)
            }
        }
    }
}

/// A closed form, with all errors or with those that it names.
fn form(
    checker: &mut Checker<'_>,
    chain: &Chain,
    mut keys: Vec<(&'static str, String)>,
    key: &'static str,
    (observable, only): (ObservableId, Option<Axis>),
    all: &[SymbolId],
    printed: PrintedVector,
) -> Option<Guess> {
    let is_error = |id: &SymbolId| chain.symbol(*id).kind == SymbolKind::Error;
    let mut named: Vec<SymbolId> =
        printed.components.iter().flat_map(|part| part.value.symbols()).filter(is_error).collect();
    named.sort_unstable();
    named.dedup();
    if named.is_empty() {
        // A formula without errors says nothing of an error.
        return None;
    }
    let is_correction = key == "correction";
    let faces = is_correction.then(|| crate::checker::Faces {
        second: Vec::new(),
        combined: crate::checker::Combination::Correction,
    });
    let mut claim =
        ClosedForm { observable, order: Order::UpTo(1), only, faces, kept: all.to_vec(), printed };
    let mut verdict = checker.closed_form(&claim).ok()?;
    if !verdict.differences.is_empty() && named.len() < all.len() {
        claim.kept.clone_from(&named);
        verdict = checker.closed_form(&claim).ok()?;
        let names: Vec<String> = named.iter().map(|&id| format!("\"{}\"", chain.symbol(id).name)).collect();
        keys.push(("keep", format!("[{}]", names.join(", "))));
    }
    let terms: usize = verdict
        .derived
        .iter()
        .enumerate()
        .filter(|(at, _)| only.is_none_or(|only| only.index() == *at))
        .map(|(_, part)| named.iter().filter(|&&id| part.symbols().contains(&id)).count())
        .sum();
    let differs = verdict.differences.len();
    // A product of errors is compared as well.
    let compared = terms.max(differs).max(1);
    // A term with a usual slip is still that term. A slip before a bracket is one in each term of it.
    let is_near = |difference: &&Difference| {
        !matches!(
            difference.slip,
            None | Some(
                TermSlip::Missing
                    | TermSlip::Superfluous
                    | TermSlip::Neglected
                    | TermSlip::BeyondOrder
                    | TermSlip::BelongsTo(_)
                    | TermSlip::StandsIn(_)
            )
        )
    };
    let of = (!is_correction).then_some((observable, only.map(Axis::index)));
    let near = verdict.differences.iter().filter(is_near).count();
    let score = if compared < FEW { [differs, compared] } else { [3 * differs - 2 * near, 3 * compared] };
    Some(Guess { keys, key, holds: differs == 0, differs: score, of, turned: claim.printed.turned })
}

/// Of fewer terms a likeness says little.
const FEW: usize = 4;

const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

fn entries_of(
    checker: &mut Checker<'_>,
    chain: &Chain,
    keys: (Vec<(&'static str, String)>, &'static str),
    of: EntriesOf,
    order: u32,
    kept: &[SymbolId],
    matrix: latex::PrintedMatrix,
) -> Option<Guess> {
    one_of(checker, chain, keys, (of, None), order, kept, matrix)
}

/// Entries, or one number of them.
fn one_of(
    checker: &mut Checker<'_>,
    chain: &Chain,
    (keys, key): (Vec<(&'static str, String)>, &'static str),
    (of, only): (EntriesOf, Option<Axis>),
    order: u32,
    kept: &[SymbolId],
    matrix: latex::PrintedMatrix,
) -> Option<Guess> {
    let printed = Entries::read(chain, matrix, Order::UpTo(order)).ok()?;
    // In a matrix zeros agree with anything.
    let said = |printed: &&PrintedVector| !printed.components[0].value.above.is_zero();
    let entries = if key == "shows" { printed.len() } else { printed.iter().filter(said).count() };
    let is_single = printed.len() == 1;
    let is_turned = printed.iter().any(|printed| printed.turned);
    let labels = (1..=printed.len()).map(|at| at.to_string()).collect();
    let claim = Entries { of, order: Order::UpTo(order), kept: kept.to_vec(), only, labels, printed };
    let Verdict::Entries(verdict) = checker.check(&Claim::Entries(Box::new(claim))).ok()? else {
        return None;
    };
    let differs = verdict.differences.len();
    // One formula of the same terms, some with slips, is still that formula.
    let is_near = |difference: &EntryDifference| {
        let [printed, derived] = [&difference.printed, &difference.derived];
        printed.above.len() == derived.above.len() && printed.symbols() == derived.symbols()
    };
    let is_near = is_single && verdict.differences.iter().all(is_near);
    Some(Guess {
        keys,
        key,
        holds: differs == 0,
        differs: if is_near { [differs, 3] } else { [differs, entries.max(differs).max(1)] },
        of: None,
        turned: is_turned,
    })
}
