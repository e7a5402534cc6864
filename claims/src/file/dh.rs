//! A Denavit–Hartenberg table as a declaration.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::Range;

use model_core::Mistake;
use model_core::expr::Expr;
use model_core::syntax;
use toml::Spanned;

use super::table::DhTable;

/// The parameters of a row, with what each is measured in.
const PARAMETERS: [&str; 4] = ["theta", "d", "a", "alpha"];

/// The text of the declaration that a table says: a body a row, `link1` and so on, with the observables `tool` (the origin of
/// the last frame) and `attitude`.
///
/// Standard: Rz(θ) Tz(d) Tx(a) Rx(α). Modified: Rx(α) Tx(a) Rz(θ) Tz(d).
/// Source: Denavit, Hartenberg (1955), J. Appl. Mech. 22; Craig, Introduction to Robotics (1986), section 3.4.
///
/// # Errors
/// What is wrong, with its place.
pub fn declaration(table: &DhTable) -> Result<String, Mistake<Range<usize>>> {
    let order: [(&str, &str); 4] = match table.convention.get_ref().as_str() {
        "standard" => [("theta", "Rz"), ("d", "Tz"), ("a", "Tx"), ("alpha", "Rx")],
        "modified" => [("alpha", "Rx"), ("a", "Tx"), ("theta", "Rz"), ("d", "Tz")],
        other => {
            let message = format!("`{other}` is no convention of Denavit–Hartenberg tables");
            return Err(Mistake::new(table.convention.span(), message)
                .with_help("\"standard\", or \"modified\" as Craig has it"));
        }
    };
    if table.rows.is_empty() {
        return Err(Mistake::new(table.convention.span(), "this table has no row"));
    }
    let known: Vec<&str> = table.constants.keys().map(|name| name.get_ref().as_str()).collect();
    let mut constants: BTreeMap<String, &str> = BTreeMap::new();
    let mut joints: Vec<String> = Vec::new();
    let mut bodies = String::new();
    for (at, row) in table.rows.iter().enumerate() {
        let number = at + 1;
        if let Some((_, value)) = row.get_ref().iter().find(|(key, _)| !PARAMETERS.contains(&key.as_str())) {
            return Err(Mistake::new(value.span(), "a row has theta, d, a and alpha"));
        }
        let names = |key: &str| -> Result<Vec<String>, Mistake<Range<usize>>> {
            let Some(value) = row.get_ref().get(key) else { return Ok(Vec::new()) };
            let amount = parsed(value)?;
            Ok(amount.names().into_iter().map(|(name, _)| name.to_owned()).collect())
        };
        // The joint is what no table calls a constant: in θ, or in d where θ has none.
        let free = |key: &str| -> Result<Option<String>, Mistake<Range<usize>>> {
            Ok(names(key)?.into_iter().find(|name| !known.contains(&name.as_str())))
        };
        let (turns, slides) = (free("theta")?, free("d")?);
        let joint = match (&turns, &slides) {
            (Some(joint), _) => Some(("theta", joint.clone())),
            (None, Some(joint)) => Some(("d", joint.clone())),
            (None, None) => None,
        };
        let lower = if at == 0 { "ground".to_owned() } else { format!("link{at}") };
        let _ = write!(bodies, "    body link{number} on {lower} {{");
        for (key, transform) in order {
            let moves = joint.as_ref().is_some_and(|(moved, _)| *moved == key);
            let value = row.get_ref().get(key);
            if let Some(value) = value.filter(|value| value.get_ref().trim() != "0") {
                let role = if moves { "motion" } else { "position" };
                let _ = write!(bodies, " {role}: {transform}({});", value.get_ref().trim());
            }
            if table.errors {
                let role = if moves { "motion_error" } else { "position_error" };
                let _ = write!(bodies, " {role}: {transform}(d{key}{number});");
            }
            let unit = if matches!(key, "theta" | "alpha") { "angle" } else { "length" };
            for name in names(key)? {
                let is_joint = joint.as_ref().is_some_and(|(moved, joint)| *moved == key && *joint == name);
                if is_joint {
                    joints.push(name);
                } else if !known.contains(&name.as_str()) {
                    constants.insert(name, unit);
                }
            }
        }
        bodies.push_str(" }\n");
    }
    constants.retain(|name, _| !joints.contains(name));
    let mut text = String::from("chain Table {\n");
    for (name, unit) in constants {
        let _ = writeln!(text, "    const {name}: {unit};");
    }
    for (name, value) in &table.constants {
        let said = value.get_ref().trim();
        let _ = match said {
            "length" | "angle" => writeln!(text, "    const {}: {said};", name.get_ref()),
            _ => writeln!(text, "    const {} = {said};", name.get_ref()),
        };
    }
    let last = table.rows.len();
    text.push_str(&bodies);
    let _ = write!(
        text,
        "    observe tool: point(0, 0, 0) of link{last};\n    observe attitude: orientation of link{last};\n}}\n"
    );
    Ok(text)
}

fn parsed(value: &Spanned<String>) -> Result<Expr<Range<usize>>, Mistake<Range<usize>>> {
    syntax::parse_amount(value.get_ref()).map_err(|mistakes| {
        let first = mistakes.iter().next();
        Mistake::new(value.span(), first.map_or("an amount is missing", |first| first.message.as_str()))
    })
}
