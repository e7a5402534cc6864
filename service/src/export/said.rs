//! What an export says: what was carried, what was not, and how far what was read back is from the instrument.

use std::fmt::Write as _;

use report::words::numbers;

use super::Lost;
use super::subject::{Difference, Subject};

/// Differences below this are rounding, rad and m.
const ROUNDING: f64 = 1e-11;

/// How large a difference is.
pub fn size(subject: &Subject, difference: &Difference) -> String {
    let Difference { rms, most } = *difference;
    if most < ROUNDING {
        return "nothing but rounding".to_owned();
    }
    let told = |value: f64| numbers::told(value, subject.unit());
    format!("{} RMS and {} at most", told(rms), told(most))
}

/// What a form cannot carry, and how far what was written is from the instrument.
pub fn read_back(subject: &Subject, lost: Option<&[Lost]>, difference: &Difference) -> String {
    let told = |value: f64| numbers::told(value, subject.unit());
    let name = &subject.chain.observable(subject.observable).name;
    let mut text = String::new();
    match lost {
        None => {}
        Some([]) => text.push_str("The form carries every error of the instrument.\n"),
        Some(lost) => {
            let _ = writeln!(
                text,
                "The form cannot carry these errors. Each is RMS at `{name}` over the measured region:"
            );
            let width = lost.iter().map(|own| own.what.chars().count()).max().unwrap_or(0);
            for Lost { what, rms } in lost {
                let _ = writeln!(text, "  {what:width$}  {}", told(*rms));
            }
        }
    }
    if difference.rms.is_nan() {
        text.push_str(
            "The file was read back. At some poses of the measured region the instrument shows no number.\n",
        );
        return text;
    }
    let _ = writeln!(
        text,
        "The file was read back. At `{name}` it differs from the instrument by {}, at {} poses of the measured region.",
        size(subject, difference),
        subject.poses.count
    );
    text
}
