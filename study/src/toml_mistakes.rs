//! What the reader of TOML says, in the words of a person who writes a study, errors or claims: what is wrong, and what to write.

use std::ops::Range;

use model_core::{Mistake, names};
use toml::de::Error;

use super::orientation::FORMS;

/// What three angles are called that say how a body is turned.
const EULER: [&str; 14] = [
    "roll", "pitch", "yaw", "heading", "omega", "phi", "kappa", "psi", "theta", "alpha", "beta", "gamma",
    "euler", "rpy",
];

/// How a message about the form of a text begins, what is wrong in plain words, and what to write.
const FORM: [(&str, &str, &str); 10] = [
    (
        "string values must be quoted",
        "this is no number and no text in quotes",
        "write a text in quotes, as in \"10 arcsec\"",
    ),
    (
        "invalid boolean",
        "this is no number and no text in quotes",
        "write a text in quotes, as in \"10 arcsec\"",
    ),
    ("invalid basic string", "a text ends without a quote", "write `\"` at its end"),
    ("invalid literal string", "a text ends without a quote", "write `'` at its end"),
    (
        "key with no value",
        "no `=` follows this key",
        "write `key = value`; a key with a blank stands in quotes",
    ),
    ("invalid unquoted key", "this key needs quotes", "write it in quotes, as in \"d*\" = \"10 arcsec\""),
    (
        "unexpected key or value",
        "something follows the value",
        "begin a new line for each key, and write decimals with a point",
    ),
    ("invalid mantissa", "this number has no digit here", "write a number such as 0.5"),
    ("unclosed table", "the name of a table is not closed", "write `]` behind the name"),
    ("duplicate key", "this key stands here twice", "leave one of the two out"),
];

/// What a value was expected to be, in the words of the reader and in plain ones.
const EXPECTED: [(&str, &str); 12] = [
    ("u64", "a whole number from 0 on"),
    ("u32", "a whole number from 0 on"),
    ("usize", "a whole number from 0 on"),
    ("i64", "a whole number"),
    ("f64", "a number"),
    ("floating point number", "a number"),
    ("a boolean", "true or false"),
    ("a string", "a text in quotes"),
    ("string", "a text in quotes"),
    ("a sequence", "a list such as [\"a\", \"b\"]"),
    ("a map", "a table such as { a = 1 }"),
    ("map", "a table such as { a = 1 }"),
];

/// A mistake in a TOML text, with the nearest key where one is misspelt.
#[must_use]
pub fn mistake(error: &Error) -> Mistake<Range<usize>> {
    let place = error.span().unwrap_or_default();
    let message = error.message().trim_end();
    if let Some((wrong, help)) = misspelt(message) {
        return Mistake::new(place, wrong).with_help(help);
    }
    if let Some(key) = message.strip_prefix("missing field ") {
        let help = format!("write a line for it: `{} = …`", key.trim_matches('`'));
        return Mistake::new(place, format!("{key} is missing here")).with_help(help);
    }
    if let Some((found, expected)) = of_another_type(message) {
        return Mistake::new(place, found).with_help(format!("write {expected}"));
    }
    match FORM.iter().find(|(start, ..)| message.starts_with(start)) {
        Some((start, ..)) if place.is_empty() && *start == FORM[0].0 => {
            Mistake::new(place, "no value follows the `=`").with_help("write a number, or a text in quotes")
        }
        Some((_, wrong, help)) => Mistake::new(place, *wrong).with_help(*help),
        None => Mistake::new(place, message),
    }
}

/// A key or a value that is none of those that can stand there.
fn misspelt(message: &str) -> Option<(String, String)> {
    let starts = [("unknown field", "key"), ("unknown variant", "value")];
    let (_, kind) = starts.into_iter().find(|(start, _)| message.starts_with(start))?;
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let (found, expected) = quoted.split_first()?;
    let is_euler = expected.contains(&"rotation_x") && EULER.contains(&found.to_lowercase().as_str());
    let help = match names::nearest(found, expected.iter().copied()) {
        _ if is_euler => format!("three angles turn about other axes with every maker: give {FORMS}"),
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("write one of {}", expected.join(", ")),
    };
    Some((format!("unknown {kind} `{found}`"), help))
}

/// What was found in place of a value of another type, and what was expected.
fn of_another_type(message: &str) -> Option<(String, &str)> {
    let rest = message.strip_prefix("invalid type: ").or_else(|| message.strip_prefix("invalid value: "))?;
    let (found, expected) = rest.split_once(", expected ")?;
    let expected = EXPECTED.iter().find(|(theirs, _)| *theirs == expected).map_or(expected, |(_, own)| own);
    // A table of one concept is told by its name in the code, which says nothing to a reader.
    let expected = if expected.starts_with("struct ") { "a table such as { key = value }" } else { expected };
    let found = match found {
        "sequence" => "a list",
        "map" => "a table",
        other => ["string ", "integer ", "floating point ", "boolean "]
            .iter()
            .find_map(|kind| other.strip_prefix(kind))
            .unwrap_or(other),
    };
    Some((format!("{found} cannot stand here"), expected))
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::mistake;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Told {
        #[allow(dead_code)]
        folds: u64,
        #[serde(default)]
        #[allow(dead_code)]
        inputs: Vec<String>,
    }

    #[test]
    fn what_is_wrong_is_told_with_what_to_write() {
        for (text, wrong, help) in [
            ("folds = \"ten\"", "\"ten\" cannot stand here", "write a whole number from 0 on"),
            ("folds = -1", "`-1` cannot stand here", "write a whole number from 0 on"),
            ("folds = 1\ninputs = 3", "`3` cannot stand here", "write a list such as [\"a\", \"b\"]"),
            ("fold = 1", "unknown key `fold`", "did you mean `folds`?"),
            ("inputs = []", "`folds` is missing here", "write a line for it: `folds = …`"),
            ("folds = ", "no value follows the `=`", "write a number, or a text in quotes"),
            (
                "folds = ten",
                "this is no number and no text in quotes",
                "write a text in quotes, as in \"10 arcsec\"",
            ),
            ("folds = \"ten", "a text ends without a quote", "write `\"` at its end"),
            (
                "folds 1",
                "no `=` follows this key",
                "write `key = value`; a key with a blank stands in quotes",
            ),
            ("f* = 1", "this key needs quotes", "write it in quotes, as in \"d*\" = \"10 arcsec\""),
            (
                "folds = 1,5",
                "something follows the value",
                "begin a new line for each key, and write decimals with a point",
            ),
            ("folds = .5", "this number has no digit here", "write a number such as 0.5"),
            ("[folds\n", "the name of a table is not closed", "write `]` behind the name"),
            ("folds = 1\nfolds = 2", "this key stands here twice", "leave one of the two out"),
        ] {
            let told = mistake(&toml::from_str::<Told>(text).expect_err(text));
            assert_eq!((told.message.as_str(), told.help.as_deref()), (wrong, Some(help)), "{text}");
        }
    }
}
