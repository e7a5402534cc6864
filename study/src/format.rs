//! What a study says of how its files are written, and how much memory their rows may take.

use toml::Spanned;

use super::mistakes::{Gathered, Outcome, mistake};
use super::written::{Site as WrittenSite, Study};
use model_core::Quantity;
use tables::formats::{Options, Site};
use tables::units;

impl Study {
    /// How the data files are read.
    pub(super) fn format(&self) -> Outcome<Options> {
        let character = |written: &Option<Spanned<char>>, what: &str, example: &str, not: &[u8]| {
            let Some(character) = written else { return Ok(None) };
            match u8::try_from(*character.get_ref()) {
                Ok(byte) if byte.is_ascii() && !not.contains(&byte) => Ok(Some(byte)),
                _ => Err(mistake(
                    character.span(),
                    format!("no such {what}"),
                    format!("write one ASCII character, such as \"{example}\""),
                )),
            }
        };
        let mut mistakes = Gathered::default();
        let separator = mistakes.take(character(&self.separator, "separator", ";", b"\"#\r\n"));
        let comment =
            mistakes.take(character(&self.comment, "mark of a comment", "#", b"\" \t\r\n+-.0123456789"));
        let memory_bytes = match &self.memory {
            None => Some(Options::default().memory_bytes),
            Some(written) => mistakes.take(memory(written.get_ref()).ok_or_else(|| {
                mistake(written.span(), "this is no amount of memory", "write memory = \"8 GiB\"")
            })),
        };
        let site = mistakes.take(self.site.as_ref().map(site).transpose());
        mistakes.none()?;
        let (Some(separator), Some(comment), Some(memory_bytes), Some(site)) =
            (separator, comment, memory_bytes, site)
        else {
            unreachable!("what is missing comes with a mistake")
        };
        Ok(Options { separator, comment, memory_bytes, site })
    }
}

/// Where the instrument stands.
fn site(written: &WrittenSite) -> Outcome<Site> {
    Ok(Site {
        latitude_deg: angle(&written.latitude, 90.0)?,
        longitude_deg: angle(&written.longitude, 360.0)?,
    })
}

/// An angle of a place, in degrees.
pub(super) fn angle(text: &Spanned<String>, most_deg: f64) -> Outcome<f64> {
    let degrees = units::parse(text.get_ref(), Quantity::Angle).map(f64::to_degrees);
    match degrees {
        Ok(degrees) if degrees.abs() <= most_deg => Ok(degrees),
        Ok(degrees) => {
            let help = format!("write an angle from -{most_deg} deg to {most_deg} deg");
            Err(mistake(text.span(), format!("{degrees:.3} deg is no such angle"), help))
        }
        Err(error) => Err(mistake(text.span(), error.to_string(), "write an angle, as \"48.5 deg\"")),
    }
}

/// `8 GiB` or `500 MiB`, in bytes.
fn memory(text: &str) -> Option<u64> {
    let digits = text.trim_end_matches(|letter: char| !letter.is_ascii_digit());
    let shift = match text.get(digits.len()..)?.trim() {
        "GiB" => 30,
        "MiB" => 20,
        _ => return None,
    };
    let number: u64 = digits.parse().ok()?;
    number.checked_mul(1 << shift).filter(|bytes| *bytes > 0)
}
