//! A rotary encoder held against a better angle.

use super::{Beside, Template, shown};
use crate::look::Look;
use crate::words::Part;
use crate::{Draft, Frame, Observed};

pub const TEMPLATE: Template = Template {
    name: "encoder",
    what: "a rotary encoder held against a better angle",
    looks_for: "raw (or encoder, reading); reference (or true)",
    fits: |look| both(look).is_ok_and(|found| found.is_some()) && !look.columns.iter().any(is_another),
    draft,
};

/// The reading and the truth.
fn both(look: &Look) -> Result<Option<[&crate::look::Column; 2]>, String> {
    let parts = [Part::Turn];
    Ok(look.reading(&parts)?.zip(look.truth(&parts)?).map(|(reading, truth)| [reading, truth]))
}

/// Whether a column is one of another instrument's.
fn is_another(column: &crate::look::Column) -> bool {
    !matches!(column.part(), None | Some(Part::Turn | Part::Temperature | Part::Name | Part::Group))
}

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let Some([reading, truth]) = both(look)? else {
        return Err(format!(
            "{}: an encoder has a column `raw [deg]` with its reading and one `reference [deg]` with the true angle",
            look.file
        ));
    };
    let mut read = look.angles(&[reading, truth], &mut remarks)?;
    let (Some(truth), Some(joint)) = (read.pop(), read.pop()) else { unreachable!("two columns were read") };
    let (frame, unfollowed) = shown(look, Frame::following(&joint, &truth), "the encoder");
    let beside = Beside::of(look);
    Ok(Draft {
        chain: chain(&frame, &beside.statements),
        observable: "mark",
        columns: [("reading".to_owned(), joint)].into_iter().chain(beside.columns).collect(),
        observed: Observed::Azimuth(truth),
        turned: None,
        estimate: Vec::new(),
        start: frame.starts(["index", ""]),
        tolerance: &[],
        inputs: beside.names,
        is_in_order: false,
        unfollowed,
        remarks,
    })
}

fn chain(frame: &Frame, statements: &str) -> String {
    let scales = frame.scales(&["reading"]);
    let (turn, index) = (frame.turns("reading"), frame.turn("index"));
    format!(
        "/// A rotary encoder: one joint, and what turns on it.
chain Encoder {{
{scales}{statements}    body shaft on ground {{
        motion: {turn};
        motion_error:
            /// Index error: true minus reading.
            {index};
    }}

    /// Where a mark on the shaft points.
    observe mark: direction(0, 1, 0) of shaft;
}}
"
    )
}
