//! Whole numbers that are typed.

use std::ops::RangeInclusive;

use clap::builder::{StringValueParser, TypedValueParser};

/// Reads a whole number of a range; `1_000` is one too. What is wrong is told with what to write.
pub fn number(range: RangeInclusive<u32>) -> impl TypedValueParser<Value = u32> {
    StringValueParser::new().try_map(move |text| {
        let read = text.replace('_', "").parse().ok().filter(|number| range.contains(number));
        let (least, most) = (range.start(), range.end());
        read.ok_or_else(|| match *most {
            u32::MAX => format!("write a whole number from {least} on, such as {}", 100.max(*least)),
            most => format!("write a whole number from {least} to {most}"),
        })
    })
}

/// Reads a seed.
///
/// # Errors
/// What to write.
pub fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("a seed is a whole number from 0 to {}, such as 1", u64::MAX))
}
