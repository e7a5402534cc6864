//! What follows from a declaration alone, while somebody types it: closed forms, what no data can tell apart, bounds, code, and whether a
//! formula of a print is right.

use claims::paper::{self, Kind};
use claims::show::{Paint, as_text};
use model_core::{Chain, Mistakes, print, remainder};
use service::claims_file::ClaimsFile;
use service::ranges::{self, RangeArgument};
use service::{Refusal, Source, errors_file, formulas};

use crate::correct::of_files;
use crate::{Answered, Message, Refused, Tell};

/// The name that mistakes in the declaration are shown with.
const DECLARATION: &str = "declaration";

/// Seed of the search for a large difference, as the command has it.
const SEED: u64 = 1;

fn declaration(asked: &Message) -> Result<Source, Refused> {
    Ok(Source::of_text(DECLARATION, asked.text("chain")?))
}

fn told(text: impl Into<Vec<u8>>) -> Message {
    Message::default().with("text", text)
}

/// Closed forms of the errors, as text and in LaTeX, of an `order` from 1 to 3.
pub fn derive(asked: &Message, tell: Tell<'_>, warn: &dyn Fn(String)) -> Answered {
    tell("deriving closed forms");
    let chain = declaration(asked)?.symbolic_chain(warn)?;
    let order = asked.text("order")?.parse().ok().filter(|order| (1..=3).contains(order));
    let order = order.ok_or_else(|| Refused("closed forms are of order 1, 2 or 3".to_owned()))?;
    let forms = formulas::closed_forms(&chain, &[], order, warn)?;
    let shown = |style| {
        let one =
            |form| format!("{}\n{}", formulas::title_of(&chain, form), print::form(form, &chain, style));
        forms.iter().map(one).collect::<Vec<_>>().join("\n")
    };
    Ok((true, told(shown(print::Style::Text)).with("latex", shown(print::Style::Latex))))
}

/// What no data can tell apart.
pub fn identify(asked: &Message, tell: Tell<'_>, warn: &dyn Fn(String)) -> Answered {
    tell("asking what data can determine");
    let chain = declaration(asked)?.symbolic_chain(warn)?;
    Ok((true, told(formulas::identified(&chain, &[], None, warn)?.texts.join("\n"))))
}

/// A proven bound on what the first order leaves out, for `sizes` of the errors and `ranges` of joints and inputs, one a line.
pub fn bound(asked: &Message, tell: Tell<'_>, warn: &dyn Fn(String)) -> Answered {
    tell("proving a bound");
    let chain: Chain = declaration(asked)?.chain(warn)?;
    let sizes = Source::of_text("sizes", asked.text("sizes")?);
    let sizes = errors_file::largest_sizes(&sizes, &chain, warn)?;
    let lines = asked.text("ranges")?.lines().map(str::trim).filter(|line| !line.is_empty());
    let ranges = lines.map(|line| line.parse().map_err(|why: &str| Refused(format!("`{line}`: {why}"))));
    let ranges = ranges::of_chain(&chain, &ranges.collect::<Result<Vec<RangeArgument>, _>>()?, warn)?;
    let bounds = formulas::bounds(&chain, &sizes, &ranges, &[], SEED, warn)?;
    let texts = bounds.iter().map(|(bound, found)| remainder::text(bound, Some(found), &chain));
    Ok((true, told(texts.collect::<Vec<_>>().join("\n"))))
}

/// Code in a `language`; each file as `file:NAME`.
pub fn code(asked: &Message, tell: Tell<'_>, warn: &dyn Fn(String)) -> Answered {
    tell("writing code");
    let source = declaration(asked)?;
    let chain = source.chain(warn)?;
    let files = formulas::files(&source, &chain, asked.text("language")?, &[])?;
    Ok((true, of_files(&codegen::snake_case(&chain.name), files)))
}

/// Whether a `formula`, as a paper prints it in LaTeX, is what the declaration implies. A formula without an environment is put into one.
pub fn check(asked: &Message, tell: Tell<'_>, warn: &dyn Fn(String)) -> Answered {
    tell("checking the formula");
    let declaration = declaration(asked)?;
    let chain = declaration.symbolic_chain(warn)?;
    let formula = asked.text("formula")?;
    if formula.trim().is_empty() {
        return Err(Refused("there is no formula: paste one in LaTeX".to_owned()));
    }
    let drawn = |paper: &str| paper::draft(paper, Kind::Tex, &chain, "formula", DECLARATION);
    let mut draft = drawn(formula);
    if draft.claims == 0 && draft.unread.is_empty() {
        draft = drawn(&format!("\\[\n{formula}\n\\]\n"));
    }
    let unread: Vec<String> =
        draft.unread.iter().map(|(_, _, reason)| format!("not read: {reason}\n")).collect();
    if draft.claims == 0 {
        return Ok((false, told(unread.concat()).with("claims", draft.text)));
    }
    let file = ClaimsFile::of_source(Source::of_text("formula", &draft.text), declaration, warn)?;
    let mistakes = file.said.mistakes();
    if !mistakes.is_empty() {
        let mistakes: Refusal = file.source.mistakes(&Mistakes::locate(&file.source.text, mistakes));
        return Err(mistakes.into());
    }
    let checked = file.checked()?;
    let text = as_text(&file.said, &checked, &Paint::default());
    let holds = checked.iter().all(|checked| checked.verdict.holds());
    Ok((
        holds && unread.is_empty(),
        told(format!("{}{}", text.as_str(), unread.concat())).with("claims", draft.text),
    ))
}
