//! A declaration and a study to start from, out of a table that somebody dropped: what `init` says.

use std::path::Path;

use init::robot::Description;
use init::{Draft, Look, Names, templates};
use serde_json::{Value, json};
use service::Source;
use service::beginning::{Begun, begun};
use tables::formats::{self, Cells, Form, Input, Options, Wanted};
use tables::urdf::Robot;

use crate::{Answered, Message, Refused, Tell};

/// Rows of a table that are shown.
const SHOWN: usize = 5;

/// Looks at a `table` of a `name`, or only at a robot's description, `urdf`. Answers with the kind of instrument, a declaration, a study, and
/// the first rows. `template` chooses the kind, `tip` the link that is measured.
pub fn begin(asked: &Message, tell: Tell<'_>, warn: &dyn Fn(String)) -> Answered {
    tell("looking at the table");
    let (name, bytes) = (asked.text("name")?, asked.bytes("table")?);
    let open = || formats::open(bytes.to_vec(), name, &Options::default());
    let look = Look::at(&mut *open()?)?;
    let of_robot = asked.find("urdf").map(|_| asked.text("urdf")).transpose()?;
    let (template, what, draft) = match of_robot {
        Some(text) => ("robot", "a robot as its URDF describes it", robot(asked, text, &look)?),
        None => {
            let chosen = asked.find("template").map(|_| asked.text("template")).transpose()?;
            let (template, draft) = init::draft(&look, chosen.and_then(templates::named))?;
            (template.name, template.what, draft)
        }
    };
    let stem = Path::new(name).file_stem().map_or_else(|| name.into(), |stem| stem.to_string_lossy());
    let (chain_name, study_name) = (format!("{stem}.chain"), format!("{stem}.toml"));
    let command = format!("trueaxis calibrate {}", report::shell_word(&study_name));
    let names = Names { chain: &chain_name, data: name, command: &command, site: None, trajectory: None };
    let Begun { study, remarks, doubtful } =
        begun(&draft, &look, names, &mut |_| Ok(Input::from(bytes.to_vec())))?;
    doubtful.into_iter().for_each(warn);
    let answer = Message::default()
        .with("template", template)
        .with("what", what)
        .with("remarks", json!(remarks).to_string())
        .with("columns", first_rows(&mut *open()?)?.to_string())
        .with("chain-name", chain_name)
        .with("chain", draft.chain)
        .with("study-name", study_name)
        .with("study", study);
    Ok((true, answer))
}

fn robot(asked: &Message, text: &str, look: &Look) -> Result<Draft, Refused> {
    let source = Source::of_text("the robot's URDF", text);
    let robot = Robot::of(&source.text).map_err(|mistake| source.mistake(mistake))?;
    let tip = asked.find("tip").map(|_| asked.text("tip")).transpose()?;
    Ok(init::robot::draft(&Description::urdf(robot), tip, look)?)
}

/// The first rows of a table, column by column.
fn first_rows(reader: &mut dyn formats::TableReader) -> Result<Value, Refused> {
    let header = reader.header().to_vec();
    let wanted: Vec<Wanted> = (0..header.len()).map(|column| Wanted { column, form: Form::Kept }).collect();
    let chunk = reader.read(&wanted, SHOWN)?;
    let mut columns = Vec::new();
    for (name, cells) in header.iter().zip(chunk.columns) {
        let Cells::Kept(kept) = cells else { unreachable!("kept columns were wanted") };
        let texts = kept.texts()?;
        columns.push(json!({ "name": name.full, "cells": texts.iter().collect::<Vec<&str>>() }));
    }
    Ok(Value::from(columns))
}

/// The first rows of a `table` of a `name`, for who has a study already.
pub fn look(asked: &Message, _: Tell<'_>, _: &dyn Fn(String)) -> Answered {
    let (name, bytes) = (asked.text("name")?, asked.bytes("table")?);
    let mut reader = formats::open(bytes.to_vec(), name, &Options::default())?;
    Ok((true, Message::default().with("columns", first_rows(&mut *reader)?.to_string())))
}

/// The kinds of instrument that a table can be said to be of.
pub fn templates(_: &Message, _: Tell<'_>, _: &dyn Fn(String)) -> Answered {
    let one = |one: &init::Template| json!({ "name": one.name, "what": one.what, "columns": one.looks_for });
    let all: Vec<Value> = templates::TEMPLATES.iter().map(one).collect();
    Ok((true, Message::default().with("templates", Value::from(all).to_string())))
}
