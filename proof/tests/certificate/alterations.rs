//! A certificate that is altered by one sign does not check.

use crate::coq;
use crate::support::{ALT_AZIMUTH, Claim, of_chain, of_claim, paper};

/// The text with one line altered by a sign, for every line of the declaration and of a formula: of the line's first
/// summand, and of the whole where there are several.
fn alterations(text: &str) -> Vec<(String, String)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut altered = Vec::new();
    let mut replace = |index: usize, line: String| {
        let mut lines = lines.clone();
        lines[index] = &line;
        altered.push((line.clone(), lines.join("\n") + "\n"));
    };
    let mut in_formula = false;
    for (index, line) in lines.iter().enumerate() {
        in_formula = (in_formula && line.starts_with("  (")) || line.ends_with(": vec := V");
        if let Some((begin, rest)) = factor(line)
            && let Some(end) = rest.rfind([';', ']'])
        {
            let amount = rest[..end].trim_end();
            replace(index, format!("{begin} (- ({amount})){}", &rest[amount.len()..]));
        } else if in_formula && line.starts_with("  (") && !line.starts_with("  (0)") {
            let formula = line.trim_start().trim_end_matches('.');
            let end = if line.ends_with('.') { "." } else { "" };
            replace(index, format!("  (- {formula}){end}"));
            for (sign, other) in [(" + ", " - "), (" - ", " + ")] {
                for (at, _) in line.match_indices(sign) {
                    replace(index, format!("{}{other}{}", &line[..at], &line[at + sign.len()..]));
                }
            }
        }
    }
    altered
}

/// `  [ Rx tilt; (* role *)` as `  [ Rx` and the rest.
fn factor(line: &str) -> Option<(&str, &str)> {
    let head = line.trim_start_matches([' ', '[']);
    let is_factor = line.contains("(* ")
        && ["Rx ", "Ry ", "Rz ", "Tx ", "Ty ", "Tz "].iter().any(|name| head.starts_with(name));
    is_factor.then(|| line.split_at(line.len() - head.len() + 2)).map(|(begin, rest)| (begin, &rest[1..]))
}

/// Coq accepts the certificate and refuses every alteration of it, of which there are so many.
pub fn every_alteration_is_refused(name: &str, text: &str, count: usize) {
    let Some(folder) = coq::folder() else { return };
    assert!(coq::check(folder, name, text).is_ok(), "{name} itself is accepted");
    let altered = alterations(text);
    assert_eq!(
        altered.len(),
        count,
        "{name}: {:#?}",
        altered.iter().map(|(line, _)| line).collect::<Vec<_>>()
    );
    for (index, (line, text)) in altered.iter().enumerate() {
        let file = format!("{name}_altered_{index}");
        assert!(coq::check(folder, &file, text).is_err(), "{name} is accepted with the line\n{line}");
    }
}

#[test]
fn a_derived_formula_altered_in_any_line_is_refused() {
    let turntable = include_str!("../../../examples/turntable/turntable.chain");
    let text = of_chain(turntable, 1).unwrap_or_default();
    // Four factors, the vector, three components, and the sign within one of them.
    every_alteration_is_refused("altered_turntable", &text, 4 + 1 + 3 + 1);
}

#[test]
fn a_refuted_formula_altered_in_any_line_is_refused() {
    let components = [
        "tilt_north*sin(elevation) + azimuth_index*cos(azimuth)*cos(elevation)",
        "azimuth_index*sin(azimuth)*cos(elevation) - tilt_east*sin(elevation)",
        "tilt_east*cos(azimuth)*cos(elevation)",
    ];
    let keep = &["tilt_east", "azimuth_index"];
    let (holds, text) = of_claim(ALT_AZIMUTH, &Claim { observable: "sight", order: 1, keep, components });
    assert!(!holds);
    // Eight factors, the vector; three components as printed and three as derived, and the signs within two of each.
    every_alteration_is_refused("altered_alt_azimuth", &text, 8 + 1 + (3 + 2) + (3 + 1));
}

#[test]
#[ignore = "a minute of Coq; `.ci/long` has it"]
fn the_papers_equations_altered_in_any_line_are_refused() {
    // The factors; the vector and the formulas of equation (6), as printed and as derived, and of (7); the signs in them.
    every_alteration_is_refused("altered_paper", &paper(), 33 + 10 + 22);
}
