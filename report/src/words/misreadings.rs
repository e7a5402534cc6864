//! Mistakes in reading data and places, in words.

use super::numbers::short;
use calibration::diagnose::{MeasuredLengths, Misreading, Otherwise, StatedPlaces, Strayed};
use observe::SiUnit;

/// What is likely wrong, and what the residual is without it.
pub(super) fn misread(otherwise: &Otherwise) -> String {
    let Otherwise { mistakes, before, after, unit } = otherwise;
    let [before, after] = [before, after].map(|rms| short(*rms, *unit));
    let mistakes = all(mistakes);
    format!(
        "Likely {mistakes}. Read that way, the residual falls from {before} to {after}. Change the study or the file, and calibrate again."
    )
}

/// That stations are fitted away from their rough places, and what is likely wrong.
pub(super) fn strayed(strayed: &Strayed) -> String {
    let Strayed { station, away_m, turn_rad, mistakes } = strayed;
    let (away, turn) = (short(*away_m, SiUnit::METRE), turn_rad.to_degrees());
    let off = format!(
        "The fitted stations are not where the study roughly places them, `{station}` by {away} and {turn:.0}°"
    );
    match mistakes.len() {
        0 => format!("{off}. Check their names, x and y, headings, and which way angles run."),
        _ => format!(
            "{off}. Likely {}. Read that way, the stations are where the study places them. Change the study or the file, and calibrate \
             again.",
            all(mistakes)
        ),
    }
}

/// What is likely wrong.
fn all(mistakes: &[Misreading]) -> String {
    let told: Vec<String> = mistakes.iter().map(mistake).collect();
    let others = match told.len() {
        0 | 1 => "",
        _ => " (the data cannot choose)",
    };
    format!("{}{others}", told.join(", or "))
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
        Misreading::FromZenith { joint } => format!("`{joint}` counts from the zenith (write 90 deg − reading)"),
        Misreading::Turned { joint, by_deg } => {
            let sign = if *by_deg < 0 { "−" } else { "+" };
            format!("`{joint}` has another zero (add {sign}{} deg to the readings)", by_deg.abs())
        }
        Misreading::Exchanged { joints: [one, other] } => format!("the columns of `{one}` and `{other}` are exchanged"),
        Misreading::Unit { readings, unit } => in_unit(readings, "", unit),
        Misreading::Doubled { of } => format!("the {} are doubled, perhaps diameters (write half of them)", lengths(*of)),
        Misreading::LengthsUnit { of, unit } => format!("the {} are {unit}", lengths(*of)),
        Misreading::UnitAt { station, readings, unit } => in_unit(readings, &format!(" of station `{station}`"), unit),
    }
}

fn in_unit(readings: &[String], of: &str, unit: &str) -> String {
    let are = if readings.len() == 1 { "is" } else { "are" };
    let named: Vec<String> = readings.iter().map(|reading| format!("`{reading}`")).collect();
    let all = match named.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => unreachable!("a unit is that of a reading"),
    };
    format!("{all}{of} {are} {unit}")
}

fn lengths(of: MeasuredLengths) -> &'static str {
    match of {
        MeasuredLengths::Radii => "radii",
        MeasuredLengths::Distances => "measured lengths, or radii of spheres,",
        MeasuredLengths::Wires => "lengths of the wires",
    }
}

fn places(of: StatedPlaces) -> &'static str {
    match of {
        StatedPlaces::Objects => "the stated objects",
        StatedPlaces::Stations => "the stated stations",
        StatedPlaces::Both => "the stated objects and stations",
    }
}
