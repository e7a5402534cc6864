//! Amendment: what the search found becomes lines in the user's own text.
//!
//! Comments, order and layout of the text stay as they are: new lines go in after the last list of the same role in
//! the body, indented like it and ended like the lines around it. Before an amended text leaves, it is read again, and held to
//! what was meant (`verify`).

mod verify;

use std::ops::Range;

use model_core::escape::comments;
use model_core::syntax::declaration::{BodyStatement, Declaration, FactorGroup, Statement};
use model_core::{Chain, Mistakes, ObservableId, Role, Symbol, SymbolKind, validate};

pub use effects::candidate::Spot;

/// A factor to add, or a bending of a line of sight, as a declaration writes it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Addition {
    /// Where it goes.
    pub spot: Spot,
    /// `Rx(ecc_cos_beta*cos(beta) + ecc_sin_beta*sin(beta))`; of a bending the amount alone, `refraction*tan(zenith)`.
    pub text: String,
    /// What was found, when and with what evidence: one line of comment each.
    pub documentation: Vec<String>,
}

/// An input to declare.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewInput {
    /// Its name.
    pub name: String,
    /// What it is, as a declaration writes it: `temperature`, `direction of beta`; `None` for a plain number.
    pub meaning: Option<String>,
    /// Its `///` line.
    pub documentation: String,
}

impl NewInput {
    /// As a declaration writes it: `input ambient: temperature;`
    fn statement(&self) -> String {
        match &self.meaning {
            Some(meaning) => format!("input {}: {meaning};", self.name),
            None => format!("input {};", self.name),
        }
    }
}

/// Why a text could not be amended.
#[derive(Debug, thiserror::Error)]
pub enum AmendError {
    /// The text itself is no declaration.
    #[error("the declaration cannot be read: {0}")]
    Text(#[from] Mistakes),
    /// The text is not that of the chain.
    #[error("the declaration has no body `{0}`")]
    NoBody(String),
    /// The text is not that of the chain.
    #[error("the declaration has no observable `{0}`")]
    NoObservable(String),
    /// The amended text would not say what was found.
    #[error(
        "the amended declaration would not say what was found ({0}); this is a mistake in trueaxis: please report it"
    )]
    NotAsMeant(String),
}

/// The text with the additions and with inputs that it does not declare yet.
///
/// # Errors
/// A text that is no declaration, or not that of the chain; additions that would make it say something else than them.
pub fn amend(
    text: &str,
    chain: &Chain,
    additions: &[Addition],
    inputs: &[NewInput],
) -> Result<String, AmendError> {
    let declaration = Declaration::from_text(text)?;
    // π, ramps and angles that are numbers are written, not named.
    let read = Chain::from_text(text)?;
    let named = |symbol: &Symbol| {
        !matches!(symbol.kind, SymbolKind::Pi | SymbolKind::Ramp) && read.find_symbol(&symbol.name).is_none()
    };
    let no_name = |symbol: &&Symbol| named(symbol) && !validate::is_name(&symbol.name);
    if let Some(symbol) = chain.symbols.iter().find(no_name) {
        return Err(AmendError::NotAsMeant(format!("`{}` is no name", symbol.name)));
    }
    let mut insertions: Vec<(usize, Role, String)> = Vec::new();
    let mut bent: Vec<ObservableId> = Vec::new();
    for addition in additions {
        let (body, role) = match addition.spot {
            Spot::Factor(body, role) => (body, role),
            Spot::Sight(observable) => {
                let is_bent = bent.contains(&observable);
                bent.push(observable);
                let (at, lines) = bending(text, &declaration, chain, observable, is_bent, addition)?;
                insertions.push((at, Role::MotionError, lines));
                continue;
            }
        };
        let name = &chain.body(body).name;
        let body = declaration
            .bodies()
            .find(|body| body.name == name.as_str())
            .ok_or_else(|| AmendError::NoBody(name.clone()))?;
        let (at, indent) = place(text, body, role);
        let word = if role == Role::MotionError { "motion_error" } else { "position_error" };
        let end = line_end(text, at);
        let mut lines: String = addition
            .documentation
            .iter()
            .map(|line| format!("{end}{indent}/// {}", comments::line(line)))
            .collect();
        lines.push_str(&format!("{end}{indent}{word}: {};", addition.text));
        insertions.push((at, role, lines));
    }
    for input in inputs {
        let (at, indent) = input_place(text, &declaration);
        let (end, documentation) = (line_end(text, at), comments::line(&input.documentation));
        let lines = format!("{end}{indent}/// {documentation}{end}{indent}{}", input.statement());
        insertions.push((at, Role::Position, lines));
    }
    // In a body without a motion all roles go to one place: there as everywhere, what errs before the motion stands
    // first, as it does in the chain. Otherwise those at one place keep their order.
    insertions.sort_by_key(|&(at, role, _)| (at, role));
    let mut amended =
        String::with_capacity(text.len() + insertions.iter().map(|(_, _, s)| s.len()).sum::<usize>());
    let mut from = 0;
    let mut inserted: Vec<Range<usize>> = Vec::new();
    for (at, _, lines) in insertions {
        amended.push_str(&text[from..at]);
        inserted.push(amended.len()..amended.len() + lines.len());
        amended.push_str(&lines);
        from = at;
    }
    amended.push_str(&text[from..]);
    verify::says_what_was_meant((text, &declaration, chain), &amended, &inserted, additions, inputs)?;
    Ok(amended)
}

/// A chain whose symbols measure what the language says that they do in a text: a coefficient that multiplies an angle is a
/// number there. So what is written of them can be read again.
///
/// # Errors
/// A text that is no declaration.
pub fn with_quantities_of(mut chain: Chain, text: &str) -> Result<Chain, Mistakes> {
    let read = Chain::from_text(text)?;
    for symbol in &mut chain.symbols {
        if let Some(id) = read.find_symbol(&symbol.name) {
            symbol.quantity = read.symbol(id).quantity;
        }
    }
    Ok(chain)
}

/// Where a bending goes, behind the last word of an observable, and what is written there. A line of sight that is bent
/// already is bent by more.
fn bending(
    text: &str,
    declaration: &Declaration,
    chain: &Chain,
    observable: ObservableId,
    is_bent: bool,
    addition: &Addition,
) -> Result<(usize, String), AmendError> {
    let name = &chain.observable(observable).name;
    let observe = declaration
        .observables()
        .find(|observe| observe.name == name.as_str())
        .ok_or_else(|| AmendError::NoObservable(name.clone()))?;
    let at = observe.last.byte_range().end;
    let (end, indent) = (line_end(text, at), indentation(text, observe.name.span().byte_range().start));
    let is_bent = is_bent || observe.bent.is_some();
    let mut lines = if is_bent { String::new() } else { ",".to_owned() };
    for line in &addition.documentation {
        lines.push_str(&format!("{end}{indent}    // {}", comments::line(line)));
    }
    let words = if is_bent { "+" } else { "bent up by" };
    lines.push_str(&format!("{end}{indent}    {words} {}", addition.text));
    Ok((at, lines))
}

/// How the line around a byte ends.
fn line_end(text: &str, at: usize) -> &'static str {
    let line = text[at..].find('\n').map_or(text, |end| &text[..at + end]);
    if line.ends_with('\r') { "\r\n" } else { "\n" }
}

/// Where a factor of a role goes in a body: the byte after which a new line starts, and its indentation.
fn place(text: &str, body: &BodyStatement, role: Role) -> (usize, String) {
    let last = |word: &str| body.groups.iter().rev().find(|group| group.role == word);
    let after = |group: &FactorGroup| {
        let at = end_of_line(text, group.semicolon.byte_range().end);
        (at, indentation(text, group.role.span().byte_range().start))
    };
    let found = match role {
        Role::MotionError => last("motion_error").or_else(|| last("motion")).or(body.groups.last()),
        _ => last("position_error").or_else(|| last("position")),
    };
    match found {
        Some(group) => after(group),
        None => {
            let at = end_of_line(text, body.braces.open.byte_range().end);
            (at, format!("{}    ", indentation(text, body.name.span().byte_range().start)))
        }
    }
}

/// Where a new input goes: after the last one, else before what follows the opening brace.
fn input_place(text: &str, declaration: &Declaration) -> (usize, String) {
    let inputs = declaration.statements.iter().filter_map(|statement| match statement {
        Statement::Input(input) => {
            let of = input.between.as_ref().map(|between| &between.up).or(input.of.as_ref());
            let last = of.or(input.meaning.as_ref()).unwrap_or(&input.name);
            Some((after_semicolon(text, last.span().byte_range().end), input.name.span().byte_range().start))
        }
        _ => None,
    });
    match inputs.max() {
        Some((end, start)) => (end_of_line(text, end), indentation(text, start)),
        None => (end_of_line(text, declaration.braces.open.byte_range().end), "    ".to_owned()),
    }
}

/// The byte after the semicolon that ends a statement, from its last word on: only white space and comments stand between.
fn after_semicolon(text: &str, from: usize) -> usize {
    let mut at = from;
    while let Some(next) = text[at..].chars().next() {
        let rest = &text[at..];
        at += match next {
            ';' => return at + 1,
            '/' if rest.starts_with("//") => rest.find('\n').unwrap_or(rest.len()),
            '/' if rest.starts_with("/*") => block_comment(rest),
            other => other.len_utf8(),
        };
    }
    at
}

/// The length of the block comment that a text starts with; such comments hold others.
fn block_comment(text: &str) -> usize {
    let (mut depth, mut at) = (0_usize, 0);
    while let Some(rest) = text.get(at..).filter(|rest| !rest.is_empty()) {
        let (step, deeper) = match rest {
            _ if rest.starts_with("/*") => (2, depth + 1),
            _ if rest.starts_with("*/") => (2, depth - 1),
            _ => (rest.chars().next().map_or(1, char::len_utf8), depth),
        };
        (at, depth) = (at + step, deeper);
        if depth == 0 {
            return at;
        }
    }
    text.len()
}

/// The end of the line if only a comment follows `at` on it, `at` itself otherwise. Documentation is no comment: it belongs to
/// what comes next.
fn end_of_line(text: &str, at: usize) -> usize {
    let rest = &text[at..];
    let line = rest.split('\n').next().unwrap_or_default();
    let bare = line.trim_start_matches([';', ' ', '\t', '\r']);
    let documents = bare.starts_with("//!") || bare.starts_with("///") && !bare.starts_with("////");
    let semicolons = rest.len() - rest.trim_start_matches([';', ' ', '\t']).len();
    let semicolons = rest[..semicolons].rfind(';').map_or(0, |last| last + 1);
    match bare {
        _ if documents => at + semicolons,
        _ if bare.is_empty() || bare.starts_with("//") => at + line.trim_end_matches('\r').len(),
        _ => at,
    }
}

/// The white space that the line around a byte starts with.
fn indentation(text: &str, at: usize) -> String {
    let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    text[start..].chars().take_while(|c| *c == ' ' || *c == '\t').collect()
}
