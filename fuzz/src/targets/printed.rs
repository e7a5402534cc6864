//! What somebody printed: claims files, and papers in LaTeX and Markdown.

use std::ops::Range;

use claims::file::{Claims, Edge, File, declaration_of_dh, declaration_of_formulas};
use claims::paper::{self, Kind};
use claims::show::{Paint, as_json, as_text, unread_as_json};
use model_core::budget::{JointRange, Path};
use model_core::{Chain, Mistake, Quantity};
use tables::units;

use super::{MOUNT, is_seen, mount, text};

/// Quantities with their units; paths and ranges are the command line's.
struct Units;

impl Edge for Units {
    fn quantity(&self, text: &str, quantity: Quantity) -> Result<f64, String> {
        units::parse(text, quantity).map_err(|error| error.to_string())
    }

    fn example(&self, quantity: Quantity) -> String {
        units::example(quantity).to_owned()
    }

    fn path(&self, _: &Chain, _: &str) -> Result<Path, Mistake<Range<usize>>> {
        Ok(Path::default())
    }

    fn range(&self, _: &Chain, _: &str) -> Result<JointRange, String> {
        Err("no ranges here".to_owned())
    }
}

/// A claims file: every claim has a verdict, or a reason why it has none.
pub fn claims(input: &[u8]) {
    let text = text(input);
    let file: File = match toml::from_str(&text) {
        Ok(file) => file,
        Err(_) => return,
    };
    let declaration = match &file.dh {
        Some(table) => match declaration_of_dh(table.get_ref()) {
            Ok(declaration) => declaration,
            Err(mistake) => return assert!(!mistake.message.is_empty()),
        },
        None if file.chain.is_none() => declaration_of_formulas(&file),
        None => MOUNT.to_owned(),
    };
    let Ok(chain) = Chain::symbolic_from_text(&declaration) else { return };
    judged(&text, &file, &chain);
}

fn judged(text: &str, file: &File, chain: &Chain) {
    let claims = Claims::read(text, file, chain, &Units);
    let (checked, undecided) = claims.check();
    assert_eq!(checked.len() + undecided.len() + claims.unread.len(), file.claim.len(), "a claim is lost");
    is_seen(as_text(&claims, &checked, &Paint::default()).as_str());
    for one in &checked {
        let _ = as_json(&claims, one);
    }
    for one in claims.unread.iter().chain(&undecided) {
        assert!(!one.mistakes.is_empty(), "{}: no reason", one.name);
        let _ = unread_as_json(one);
    }
}

/// A paper, read as LaTeX and as Markdown: what is drawn up is a claims file, which is read.
pub fn papers(input: &[u8]) {
    let text = text(input);
    let chain = mount();
    for (kind, name) in [(Kind::Tex, "f.tex"), (Kind::Markdown, "f.md")] {
        let draft = paper::draft(&text, kind, &chain, name, "mount.chain");
        let file: File = toml::from_str(&draft.text)
            .unwrap_or_else(|error| unreachable!("a draft is read: {error}\n{}", draft.text));
        assert_eq!(file.claim.len(), draft.claims, "claims of the draft");
        judged(&draft.text, &file, &chain);
    }
}
