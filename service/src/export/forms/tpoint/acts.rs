//! What to do at the mount about a term.
//!
//! Source of what a sign means: P. T. Wallace, notes of `tptPterms`: with a positive ME the pole of a northern mount is below the true pole, of a
//! southern one above it; with a positive MA it is to the right of due north, or of due south; positive CH and NP displace the line of sight to
//! the west; with a positive AN or AW the azimuth axis leans to the north or to the west; a positive TF is a tube that droops.

use observe::SiUnit;
use report::words::numbers;

use super::carried::Value;

/// A value of less than this many standard uncertainties is no reason to act.
const SURE: f64 = 2.0;

/// The cosine of a latitude at which azimuth screws turn the polar axis about itself.
const LEAST: f64 = 0.02;

/// A sentence on what to do.
pub fn act(name: &str, value: &Value, latitude_rad: Option<f64>) -> String {
    if !value.is_determined {
        return "The data do not determine it. Measure more of the sky before you turn a screw.".to_owned();
    }
    if value.uncertainty.is_some_and(|uncertainty| value.value.abs() < SURE * uncertainty) {
        return "It is too small to be sure of. Leave the mount as it is.".to_owned();
    }
    let size = angle(value.value.abs());
    let positive = value.value > 0.0;
    let either = |one: &'static str, other: &'static str| if positive { one } else { other };
    let is_north = latitude_rad.is_none_or(|latitude| latitude >= 0.0);
    match name {
        "ME" => {
            let (verb, is) = if positive == is_north { ("Raise", "below") } else { ("Lower", "above") };
            format!("{verb} the polar axis by {size}: turn the altitude screw. It points {is} the true pole.")
        }
        "MA" => {
            let is = either("east", "west");
            let towards = either("west", "east");
            // Facing south, right is west.
            let (is, towards) = if is_north { (is, towards) } else { (towards, is) };
            // About the plumb line the pole goes round a smaller circle.
            let turn = latitude_rad.map_or(1.0, |latitude| latitude.cos().abs().max(LEAST));
            format!(
                "Turn the mount {} to the {towards} with the azimuth screws. The polar axis points {size} {is} of the pole.",
                angle(value.value.abs() / turn)
            )
        }
        "AN" => {
            let [leans, foot] = either_way(positive, ["north", "south"]);
            format!(
                "The azimuth axis leans {size} to the {leans}. Raise the {leans} foot or lower the {foot} one."
            )
        }
        "AW" => {
            let [leans, foot] = either_way(positive, ["west", "east"]);
            format!(
                "The azimuth axis leans {size} to the {leans}. Raise the {leans} foot or lower the {foot} one."
            )
        }
        "IH" | "ID" | "IA" | "IE" => {
            let axis = match name {
                "IH" => "hour angle",
                "ID" => "declination",
                "IA" => "azimuth",
                _ => "elevation",
            };
            // Azimuths of TPOINT's formulas go the other way round.
            let adds = positive != (name == "IA");
            let verb = if adds { "Add" } else { "Subtract" };
            let from = if adds { "to" } else { "from" };
            format!(
                "The zero of the {axis} is off. {verb} {size} {from} its readings, or synchronise on a star."
            )
        }
        "CH" => format!(
            "The line of sight is {size} {} of square to the declination axis. Shim the tube or camera, or keep the term.",
            either("west", "east")
        ),
        "CA" => format!(
            "The line of sight is {size} {} of square to the elevation axis. Shim the tube or camera, or keep the term.",
            either("left", "right")
        ),
        "NP" => format!(
            "The declination axis is {size} from square to the polar axis. Keep the term, or shim the axis."
        ),
        "NPAE" => format!(
            "The elevation axis is {size} from square to the azimuth axis. Keep the term, or shim the axis."
        ),
        "TF" => {
            let does = either("droops", "rises");
            format!(
                "The tube {does} by {size} at the horizon. Check focuser, rings and mirror cell, then keep the term."
            )
        }
        "FO" => format!("The fork bends by {size}. Keep the term."),
        _ => "Keep the term in the pointing model.".to_owned(),
    }
}

/// Two words in this order, or in the other.
fn either_way(is_first: bool, [one, other]: [&'static str; 2]) -> [&'static str; 2] {
    if is_first { [one, other] } else { [other, one] }
}

/// An angle as screws are turned by: in minutes of arc where it is more than one.
fn angle(value_rad: f64) -> String {
    let minutes = value_rad.to_degrees() * 60.0;
    if (1.0..60.0).contains(&minutes) {
        format!("{minutes:.1} arcmin")
    } else {
        numbers::told(value_rad, SiUnit::RAD)
    }
}
