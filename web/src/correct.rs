//! What one does with an instrument that was calibrated: correct a table, and have code of it.

use serde_json::json;
use service::apply::Beside;
use service::{Instrument, Source, formulas, over_memory};

use crate::{Answered, Message, Refused, Tell};

/// Corrects a `table` of a `name` with an `instrument` file, and answers with the table as separated values. A part `correction` or
/// `uncertainty` asks for these columns, too.
pub fn correct(asked: &Message, tell: Tell<'_>, warn: &dyn Fn(String)) -> Answered {
    tell("correcting the table");
    let (name, table) = (asked.text("name")?, asked.bytes("table")?);
    let beside = Beside {
        correction: asked.find("correction").is_some(),
        uncertainty: asked.find("uncertainty").is_some(),
    };
    let corrected = over_memory::corrected(&instrument(asked, warn)?, (name, table), beside, warn)?;
    Ok((true, Message::default().with("table", corrected)))
}

/// Code of an `instrument` in a `language`, with its errors and constants written into it; each file as `file:NAME`.
pub fn generate(asked: &Message, tell: Tell<'_>, warn: &dyn Fn(String)) -> Answered {
    tell("writing code");
    let own = instrument(asked, warn)?;
    let files = formulas::files_of_instrument(&own, asked.text("language")?)?;
    Ok((true, of_files(&codegen::snake_case(&own.chain.name), files)))
}

/// Files of code, and their names as a list.
pub fn of_files(stem: &str, files: Vec<codegen::File>) -> Message {
    let name = |file: &codegen::File| format!("{stem}.{}", file.extension);
    let names: Vec<String> = files.iter().map(name).collect();
    let answer = Message::default().with("files", json!(names).to_string());
    names
        .iter()
        .zip(files)
        .fold(answer, |answer, (name, file)| answer.with(&format!("file:{name}"), file.text))
}

fn instrument(asked: &Message, warn: &dyn Fn(String)) -> Result<Instrument, Refused> {
    Ok(Instrument::of(&Source::of_text("instrument.toml", asked.text("instrument")?), warn)?)
}
