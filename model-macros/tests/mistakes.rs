//! Declarations that break the rules do not compile, and the compiler says what it says of the same text in a
//! file. `tests/ui/NAME.chain` are the cases; `NAME.rs` beside it is the same text in `chain!`.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::PathBuf;

use model_core::Chain;

const CASES: &str = "../tests/ui";

fn cases() -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = fs::read_dir(CASES).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "chain"));
    files.sort();
    assert!(files.len() > 20, "the cases are there");
    files
}

#[test]
fn wrong_declarations_do_not_compile() {
    let cases = trybuild::TestCases::new();
    cases.compile_fail("../tests/ui/*.rs");
    // A name that is most likely misspelt is a warning at its token, which is an error where warnings are.
    cases.compile_fail("../tests/ui/warned/*.rs");
}

#[test]
fn macro_and_file_say_the_same() {
    for case in cases() {
        let text = fs::read_to_string(&case).unwrap();
        let source = fs::read_to_string(case.with_extension("rs")).unwrap();
        assert_eq!(
            source,
            format!("model_macros::chain! {{\n{text}}}\n\nfn main() {{}}\n"),
            "{}",
            case.display()
        );

        let in_file: Vec<String> = Chain::from_text(&text)
            .expect_err("a case breaks a rule")
            .iter()
            .map(|mistake| match &mistake.help {
                Some(help) => format!("{}: {help}", mistake.message),
                None => mistake.message.clone(),
            })
            .collect();
        let compiler = fs::read_to_string(case.with_extension("stderr")).unwrap();
        let in_macro: Vec<&str> = compiler.lines().filter_map(|line| line.strip_prefix("error: ")).collect();
        assert_eq!(in_macro, in_file, "{}", case.display());
    }
}
