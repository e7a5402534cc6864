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

const PLANAR: &str = "chain Planar { const l1 = 0.5; const l2 = 0.25;
 body upper on ground { motion: Rz(q1); motion_error: Rz(e1); position: Tx(l1); }
 body fore on upper { motion: Rz(q2); motion_error: Rz(e2); position: Tx(l2); }
 observe tip: point(0, 0, 0) of fore; observe turned: orientation of fore; }";

/// A true claim of each kind: what names it, and its keys. `0*q_1` is where an unknown symbol comes.
const KINDS: [(&str, &str); 14] = [
    ("components", "observable = 'turned'\ncomponents = ['0*q_1', '0', 'e_1 + e_2']"),
    ("correction", "observable = 'turned'\ncorrection = ['0*q_1', '0', '-e_1 - e_2']"),
    (
        "shows",
        r"observable = 'tip'
shows = '\begin{bmatrix} l_1 c_1 + l_2 c_{12} + 0*q_1 \\ l_1 s_1 + l_2 s_{12} \\ 0 \end{bmatrix}'",
    ),
    (
        "frame",
        r"body = 'upper'
frame = '\begin{bmatrix} c_1 & -s_1 & 0*q_1 \\ s_1 & c_1 & 0 \\ 0 & 0 & 1 \end{bmatrix}'",
    ),
    (
        "jacobian",
        r"observable = 'turned'
by = ['q1', 'q2']
jacobian = '\begin{bmatrix} 0*q_1 & 0 \\ 0 & 0 \\ 1 & 1 \end{bmatrix}'",
    ),
    (
        "value",
        "observable = 'tip'\nvalue = { of = 'shown', at = { q1 = '0 deg', q2 = '0 deg' }, equals = ['0.75 m', '0.00 m', '0.00 m'] }",
    ),
    ("neglected", "observable = 'tip'\nneglected = { errors = { e2 = '1 arcsec' }, at_most = '2 um' }"),
    ("equal", r"equal = ['\sin 2 q_1 + 0*q_1', '2 \sin q_1 \cos q_1']"),
    (
        "total",
        r"observable = 'turned'
total = '\sqrt{(e_1 + e_2 + 0*q_1)^2}'",
    ),
    (
        "bound",
        "observable = 'tip'\nbound = { errors = { e1 = '1 arcsec', e2 = '1 arcsec' }, at_most = '1 um' }",
    ),
    ("count", "count = { errors = 'e*', equals = 2 }"),
    ("rank", "observable = 'turned'\nrank = { errors = 'e*', equals = 1 }"),
    ("confounded", "observable = 'turned'\nconfounded = ['e1', 'e2']"),
    ("separable", "observable = 'tip'\nseparable = ['e1']"),
];

/// In a file of every kind each claim is spoiled in turn: the others keep their verdicts.
#[test]
fn a_file_of_every_kind_loses_only_what_is_spoiled() {
    let judged = |spoiled: Option<usize>| {
        let mut file = "chain = \"a\"\n".to_owned();
        for (at, (name, keys)) in KINDS.iter().enumerate() {
            let places = ["0*q_1", "e1", "e2", "e*", "q1"];
            let place = places.iter().find(|place| keys.contains(**place) && spoiled == Some(at));
            let unknown = if place == Some(&"0*q_1") { r"0*\zeta" } else { "zeta" };
            let keys = place.map_or_else(|| (*keys).to_owned(), |place| keys.replacen(place, unknown, 1));
            file += &format!("[[claim]]\nname = \"{name}\"\n{keys}\n");
        }
        verdicts(PLANAR, &file)
    };
    let own = |found: &[(String, String)], name: &str| -> Vec<String> {
        let of_claim = |said: &&(String, String)| said.0.split(':').next() == Some(name);
        found.iter().filter(of_claim).map(|(_, said)| said.clone()).collect()
    };
    let right = judged(None);
    for (name, _) in &KINDS {
        let said = own(&right, name);
        assert!(!said.is_empty() && said.iter().all(|said| said == "holds"), "{name}: {right:?}");
    }
    for (at, (name, _)) in KINDS.iter().enumerate() {
        let found = judged(Some(at));
        for (other, _) in &KINDS {
            let said = own(&found, other);
            if other == name {
                assert!(said.len() == 1 && said[0].contains("zeta"), "{name}: {said:?}");
            } else {
                assert_eq!(said, own(&right, other), "{other} beside {name}");
            }
        }
    }
}
