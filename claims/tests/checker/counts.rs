//! What it takes to decide the claims of the gallery: terms of the forms that they are compared with. A count is the same on
//! every machine, busy or not.

use std::fs;
use std::path::Path;

use model_core::{Chain, forms};

/// As `docs/src/gallery/peers.md` says.
const MOST_TERMS: usize = 400;

#[test]
fn no_form_of_the_gallery_is_long() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/gallery");
    let mut counted = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "chain") {
            continue;
        }
        let chain = Chain::from_text(&fs::read_to_string(&path).unwrap()).unwrap();
        for observable in &chain.observables {
            let id = chain.find_observable(&observable.name).unwrap();
            let form = forms::derive(&chain, id, 1).unwrap();
            let terms: usize = form.components.iter().map(|part| part.above.len() + part.below.len()).sum();
            assert!(
                (1..=MOST_TERMS).contains(&terms),
                "{}, {}: {terms} terms",
                path.display(),
                observable.name
            );
            counted += 1;
        }
    }
    assert!(counted >= 14, "{counted} observables");
}
