//! What cannot be read voids nothing but its own claim.

use super::support::verdicts;

#[test]
fn an_unreadable_symbol_voids_its_own_claim() {
    let chain = "chain C { body a on ground { motion: Rz(q); motion_error: Rz(e); } observe t: direction(1, 0, 0) of a; }";
    let file = r#"
chain = "c"
[symbols]
'\frac' = "e"
'x' = "nothing"
[[claim]]
name = "reads"
components = ['-e*sin(q)', 'e*cos(q)', '0']
[[claim]]
name = "unknown"
components = ['-\theta \sin q', '0', '0']
[[claim]]
name = "wrong"
components = ['e*sin(q)', 'e*cos(q)', '0']
"#;
    let found = verdicts(chain, file);
    let said = |name: &str| found.iter().find(|(own, _)| own == name).map(|(_, said)| said.as_str());
    assert_eq!((said("reads"), said("wrong")), (Some("holds"), Some("differs")), "{found:?}");
    assert!(said("unknown").is_some_and(|said| said.contains(r"unknown symbol `\theta`")), "{found:?}");
    assert_eq!(found.iter().filter(|(name, _)| name == "file").count(), 2, "{found:?}");
}
