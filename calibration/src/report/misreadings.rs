//! Mistakes in reading data and places, in words.

use super::numbers::short;
use crate::diagnose::{Misreading, Otherwise, StatedPlaces};

/// What is likely wrong, and what the residual is without it.
pub(super) fn misread(otherwise: &Otherwise) -> String {
    let Otherwise { mistakes, before, after, unit } = otherwise;
    let told: Vec<String> = mistakes.iter().map(mistake).collect();
    let [before, after] = [before, after].map(|rms| short(*rms, *unit));
    let others = match told.len() {
        0 | 1 => "",
        _ => " (which of these, the data do not say)",
    };
    format!(
        "Likely {}{others}: read that way the residual goes from {before} to {after}. Change the study or the file, and calibrate again.",
        told.join(", or ")
    )
}

fn mistake(mistake: &Misreading) -> String {
    match mistake {
        Misreading::ExchangedXY { of } => format!("x and y of {} are exchanged", places(*of)),
        Misreading::PlacesUnit { of, unit } => format!("the coordinates of {} are {unit}", places(*of)),
        Misreading::HeadingsReversed => "the headings of the stations run the other way (write −heading)".to_owned(),
        Misreading::HeadingsFromY { exchanged: false } => {
            "the headings of the stations are bearings from y to x (write 90 deg − heading)".to_owned()
        }
        Misreading::HeadingsFromY { exchanged: true } => {
            "x and y are northing and easting and the headings bearings (exchange x and y, and write 90 deg − heading)".to_owned()
        }
        Misreading::Reversed { joint } => format!("`{joint}` runs the other way"),
        Misreading::FromZenith { joint } => format!("`{joint}` counts from the zenith (it is 90 deg − what was read)"),
        Misreading::Exchanged { joints: [one, other] } => format!("the columns of `{one}` and `{other}` are exchanged"),
        Misreading::Unit { readings, unit } => {
            let are = if readings.len() == 1 { "is" } else { "are" };
            format!("`{}` {are} {unit}", readings.join("` and `"))
        }
    }
}

fn places(of: StatedPlaces) -> &'static str {
    match of {
        StatedPlaces::Objects => "the stated objects",
        StatedPlaces::Stations => "the stated stations",
        StatedPlaces::Both => "the stated objects and stations",
    }
}
