//! What a declaration means: the rules of the language, and the chain that a declaration without mistakes stands
//! for.
//!
//! declaration → `scope` (what each name is) → `amounts` (canonical forms) → `rules` → `build`. Every
//! rule is one function in `rules/`, with one line in `rules::RULES`; each looks at the whole declaration, so
//! that all mistakes are reported at once.

mod amounts;
mod build;
mod limits;
mod printed_form;
mod quantity;
mod rules;
mod scope;
mod sight;
mod words;

pub use words::is_name;

use proc_macro2::{Span, TokenStream};

use crate::chain::Chain;
use crate::mistake::{Mistake, Mistakes};
use crate::syntax::declaration::ConstantStatement;
use crate::syntax::{self, Declaration};
use amounts::Amount;
use scope::Scope;

/// What the rules look at.
struct Subject<'a> {
    declaration: &'a Declaration,
    scope: Scope,
    amounts: Vec<Amount<'a>>,
}

impl Chain {
    /// Reads and checks the text of a `.chain` file.
    ///
    /// # Errors
    ///
    /// Every mistake in it, sorted by place.
    ///
    /// # Example
    ///
    /// ```
    /// use model_core::{Chain, forms, print};
    ///
    /// let text = "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); } \
    ///             observe edge: direction(1, 0, 0) of top; }";
    /// let chain = Chain::from_text(text)?;
    /// let edge = chain.find_observable("edge").ok_or("no such observable")?;
    /// let error = forms::derive(&chain, edge, 1)?;
    /// let shown = print::form(&error, &chain, print::Style::Text);
    /// assert!(shown.contains("-index*sin(turn)") && shown.contains("index*cos(turn)"), "{shown}");
    ///
    /// let mistakes = Chain::from_text(&text.replace("of top", "of tpo")).unwrap_err();
    /// assert!(mistakes.to_string().contains("`tpo`"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_text(text: &str) -> Result<Self, Mistakes> {
        match read(syntax::tokens_of(text)?) {
            Ok((_, chain)) => Ok(chain),
            Err(mistakes) => Err(syntax::located(text, mistakes)),
        }
    }

    /// The same for those who want formulas and no numbers: constants need no value.
    ///
    /// Everything that calculates with numbers needs a chain from [`Self::from_text`].
    ///
    /// # Errors
    ///
    /// Every other mistake in it, sorted by place.
    pub fn symbolic_from_text(text: &str) -> Result<Self, Mistakes> {
        read_symbolic_text(text).map(|(_, chain)| chain)
    }
}

/// A declaration as it is written beside the chain that it means; constants need no value.
///
/// # Errors
///
/// Every mistake in it, sorted by place.
pub fn read_symbolic_text(text: &str) -> Result<(Declaration, Chain), Mistakes> {
    read_symbolic(syntax::tokens_of(text)?).map_err(|mistakes| syntax::located(text, mistakes))
}

/// Reads and checks a declaration: all mistakes of form and of meaning, sorted by place.
///
/// # Errors
///
/// Every mistake, at the token at fault.
pub fn read(tokens: TokenStream) -> Result<(Declaration, Chain), Vec<Mistake<Span>>> {
    read_for(tokens, Purpose::Numbers)
}

/// The same, where constants need no value.
///
/// # Errors
///
/// Every mistake, at the token at fault.
pub fn read_symbolic(tokens: TokenStream) -> Result<(Declaration, Chain), Vec<Mistake<Span>>> {
    read_for(tokens, Purpose::Formulas)
}

/// What a chain is wanted for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Purpose {
    Numbers,
    Formulas,
}

fn read_for(tokens: TokenStream, purpose: Purpose) -> Result<(Declaration, Chain), Vec<Mistake<Span>>> {
    let mut mistakes = Vec::new();
    let declaration = syntax::read(tokens, &mut mistakes);
    if purpose == Purpose::Numbers {
        mistakes.extend(declaration.iter().flat_map(without_value));
    }
    // What is told of the meaning is told with what is told of the form; only a text without either is built.
    let chain = declaration.as_ref().and_then(|declaration| validated(declaration, &mut mistakes));
    match (declaration, chain) {
        (Some(declaration), Some(chain)) => Ok((declaration, chain)),
        _ => {
            mistakes.sort_by_key(|mistake| (mistake.place.start(), mistake.place.end()));
            Err(mistakes)
        }
    }
}

/// The constants without a value.
fn without_value(declaration: &Declaration) -> Vec<Mistake<Span>> {
    let unknown = declaration.constants().filter(|constant| constant.is_open);
    let mistake = |constant: &ConstantStatement| {
        let name = &constant.name;
        let stated = constant.quantity.as_ref().map_or(String::new(), |quantity| format!(": {quantity}"));
        let message = format!("the constant `{name}` has no value, and numbers are asked for");
        Mistake::new(name.span(), message).with_help(format!(
            "write its value: `const {name}{stated} = 0.25;`; the formulas of `derive`, `check` and `identify` do without"
        ))
    };
    unknown.map(mistake).collect()
}

/// The chain that a declaration stands for, if neither the mistakes known before nor a rule that it breaks forbid it.
fn validated(declaration: &Declaration, mistakes: &mut Vec<Mistake<Span>>) -> Option<Chain> {
    if let Some(mistake) = limits::beyond(declaration) {
        mistakes.push(mistake);
        return None;
    }
    let scope = Scope::collect(declaration);
    let amounts = amounts::collect(declaration, &scope, mistakes);
    let subject = Subject { declaration, scope, amounts };
    for (_, rule) in rules::RULES {
        rule(&subject, mistakes);
    }
    if !mistakes.is_empty() {
        return None;
    }
    match build::chain(&subject) {
        Ok(chain) => Some(chain),
        Err(found) => {
            mistakes.extend(found);
            None
        }
    }
}
