//! Every rule of the language, broken: what is said, and where. The cases are those of `chain!`, in `tests/ui/`.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::PathBuf;

use model_core::Chain;

#[test]
fn every_mistake_is_reported_with_place_and_advice() {
    let cases = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/ui");
    let mut files: Vec<PathBuf> = fs::read_dir(cases).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "chain"));
    files.sort();
    assert!(files.len() > 20, "the cases are there");
    for path in files {
        let name = path.file_stem().unwrap().to_str().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let mistakes = Chain::from_text(&text).expect_err(name);
        insta::assert_snapshot!(name, mistakes.render(&format!("{name}.chain"), &text));
    }
}
