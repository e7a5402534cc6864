//! Hostile strings from every input to every output: nothing acts on the terminal, no message is forged, no element opens, no comment ends.

#[path = "../support/mod.rs"]
mod support;

mod calibrations;
mod claims;
mod declarations;
mod handed_on;
mod messages;
mod seen;

use testkit::hostile;

/// A chain that is read without a mistake.
const MOUNT: &str = "chain Mount {
    input far: length;
    body base on ground { position_error: Ry(tilt); motion: Rz(turn); }
    observe sight: direction(0, 1, 0) of base;
    observe mark: point(0, 0, far) of base;
}
";

/// A text as a basic string of TOML.
fn toml(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            letter if letter.is_control() => quoted.push_str(&format!("\\u{:04X}", u32::from(letter))),
            letter => quoted.push(letter),
        }
    }
    quoted + "\""
}

/// A text as a cell of a table.
fn cell(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// The strings joined, so that few runs see all of them: as long as no message leaves any out.
fn joined(longest: usize) -> Vec<String> {
    let mut parts: Vec<String> = vec![String::new()];
    for text in hostile() {
        let last = parts.last_mut().expect("one is there");
        if last.is_empty() || last.chars().count() + text.chars().count() < longest {
            last.push_str(&text);
        } else {
            parts.push(text);
        }
    }
    parts
}
