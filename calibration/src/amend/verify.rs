//! An amended text held to what was meant: it reads, says what the original said word for word, and beside that the
//! additions and nothing else.

use std::ops::Range;

use model_core::syntax::declaration::Declaration;
use model_core::{Chain, ObservableId, Role};
use proc_macro2::{TokenStream, TokenTree};

use super::{Addition, AmendError, NewInput, Spot};

/// Holds an amended text to its original and to the additions; `inserted` are the bytes that were added.
///
/// # Errors
/// In which way it says something else.
pub(super) fn says_what_was_meant(
    (original, before, chain): (&str, &Declaration, &Chain),
    amended: &str,
    inserted: &[Range<usize>],
    additions: &[Addition],
    inputs: &[NewInput],
) -> Result<(), AmendError> {
    let all = words(amended)?;
    let (added, kept): (Vec<Word>, Vec<Word>) =
        all.into_iter().partition(|word| inserted.iter().any(|range| range.contains(&word.at)));
    if texts(&kept) != texts(&words(original)?) {
        return Err(AmendError::NotAsMeant("the words of the declaration itself would change".to_owned()));
    }
    // Lines at one place are sorted by their role: here the order says nothing.
    let added = without_documentation(added);
    let mut said = Vec::new();
    for range in inserted {
        let own: Vec<String> =
            added.iter().filter(|word| range.contains(&word.at)).map(|word| word.text.clone()).collect();
        said.extend(statements(&own));
    }
    let mut meant = Vec::new();
    let mut bent: Vec<ObservableId> = Vec::new();
    for addition in additions {
        let text = &addition.text;
        let written = match addition.spot {
            Spot::Factor(_, Role::MotionError) => format!("motion_error: {text};"),
            Spot::Factor(..) => format!("position_error: {text};"),
            Spot::Sight(observable) => {
                let name = &chain.observable(observable).name;
                let was_bent =
                    before.observables().any(|own| own.name == name.as_str() && own.bent.is_some());
                let is_bent = was_bent || bent.contains(&observable);
                bent.push(observable);
                if is_bent { format!("+ {text}") } else { format!(", bent up by {text}") }
            }
        };
        meant.push(texts(&words(&written)?));
    }
    for input in inputs {
        meant.push(texts(&words(&input.statement())?));
    }
    said.sort();
    meant.sort();
    if said != meant {
        return Err(AmendError::NotAsMeant("more would be added than was found".to_owned()));
    }
    match Chain::from_text(amended) {
        Ok(_) => Ok(()),
        Err(mistakes) => Err(AmendError::NotAsMeant(mistakes.to_string())),
    }
}

/// A word or sign of a declaration, and the byte where it stands.
struct Word {
    text: String,
    at: usize,
}

/// Every word of a text; a line of documentation is one.
fn words(text: &str) -> Result<Vec<Word>, AmendError> {
    let stream: TokenStream =
        text.parse().map_err(|_| AmendError::NotAsMeant("it could not be read".to_owned()))?;
    let mut words = Vec::new();
    flatten(stream, &mut words);
    Ok(words)
}

fn flatten(stream: TokenStream, words: &mut Vec<Word>) {
    for tree in stream {
        match tree {
            TokenTree::Group(group) => {
                let delimiters = match group.delimiter() {
                    proc_macro2::Delimiter::Parenthesis => ["(", ")"],
                    proc_macro2::Delimiter::Brace => ["{", "}"],
                    proc_macro2::Delimiter::Bracket => ["[", "]"],
                    proc_macro2::Delimiter::None => ["", ""],
                };
                words.push(Word { text: delimiters[0].to_owned(), at: group.span_open().byte_range().start });
                flatten(group.stream(), words);
                words
                    .push(Word { text: delimiters[1].to_owned(), at: group.span_close().byte_range().start });
            }
            other => words.push(Word { text: other.to_string(), at: other.span().byte_range().start }),
        }
    }
}

/// The words without `#[doc = "…"]`, as which lines of documentation are read.
fn without_documentation(words: Vec<Word>) -> Vec<Word> {
    let mut plain: Vec<Word> = Vec::new();
    let mut words = words.into_iter();
    while let Some(word) = words.next() {
        if word.text == "#" {
            words.by_ref().take_while(|word| word.text != "]").for_each(drop);
        } else {
            plain.push(word);
        }
    }
    plain
}

fn texts(words: &[Word]) -> Vec<String> {
    words.iter().map(|word| word.text.clone()).collect()
}

/// The words statement by statement.
fn statements(words: &[String]) -> Vec<Vec<String>> {
    words.split_inclusive(|word| word == ";").map(<[String]>::to_vec).collect()
}
