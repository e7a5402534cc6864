//! Names of columns, and the units that headers carry: `az [deg]`, `az (deg)`, `az_deg`.

use model_core::{Quantity, names};

use super::DataError;
use crate::data::units::{Amount, Unit};

/// The name of one column.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnName {
    /// As it stands in the header.
    pub full: String,
    /// Without the unit.
    pub stem: String,
    /// The unit that the header gives.
    pub unit: Option<Unit>,
}

impl ColumnName {
    /// Reads one cell of a header.
    #[must_use]
    pub fn parse(text: &str) -> Self {
        let full = text.trim();
        let bracketed = [('[', ']'), ('(', ')')].into_iter().find_map(|(open, close)| {
            let (stem, rest) = full.split_once(open)?;
            Some((stem.trim_end(), Unit::find(rest.strip_suffix(close)?.trim())))
        });
        let suffixed = || {
            let (stem, unit) = full.rsplit_once('_')?;
            // One letter is more often part of the name (`pos_m`, the m-th position) than a unit.
            let unit = Unit::find(unit).filter(|unit| unit.name.len() > 1)?;
            Some((stem, Some(unit)))
        };
        let (stem, unit) = bracketed.or_else(suffixed).unwrap_or((full, None));
        Self { full: full.to_string(), stem: stem.to_string(), unit }
    }

    /// The factor that takes this column's numbers to SI.
    ///
    /// `stated` is the unit that the study gives; `bare_is_si` says that an angle without any unit is in rad
    /// (columns that carry a declared name are: the command writes them so).
    ///
    /// # Errors
    /// An angle without a unit, a unit of something else, or two units that differ.
    pub fn factor(
        &self,
        quantity: Quantity,
        stated: Option<Unit>,
        bare_is_si: bool,
        file: &str,
    ) -> Result<f64, DataError> {
        let (file, column) = (file.to_string(), self.full.clone());
        // A plain number is in the unit of the data, whatever the header calls it.
        let header = self.unit.filter(|unit| unit.quantity == quantity || quantity != Quantity::Number);
        let unit = match (stated, header) {
            (Some(stated), Some(header)) if stated.in_si != header.in_si => {
                let (header, study) = (header.name, stated.name);
                return Err(DataError::UnitConflict { file, column, header, study });
            }
            (stated, header) => stated.or(header),
        };
        if unit.is_none() && quantity == Quantity::Angle && !bare_is_si {
            return Err(DataError::NoUnit { file, column });
        }
        Amount { number: 1.0, unit }.to_si(quantity).map_err(|error| DataError::WrongUnit {
            file,
            column,
            why: error.to_string(),
        })
    }
}

/// The column of a name, with or without its unit.
///
/// # Errors
/// It is not there; the message names the nearest, or all.
pub fn find_column(header: &[ColumnName], name: &str, file: &str) -> Result<usize, DataError> {
    let exact = header.iter().position(|column| column.full == name);
    exact.or_else(|| header.iter().position(|column| column.stem == name)).ok_or_else(|| {
        let full = || header.iter().map(|column| column.full.as_str());
        let near = names::nearest(name, header.iter().map(|column| column.stem.as_str()))
            .and_then(|stem| header.iter().find(|column| column.stem == stem))
            .map(|column| column.full.as_str());
        let help = near.or_else(|| names::nearest(name, full())).map_or_else(
            || {
                format!(
                    "the file has {}",
                    full().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
                )
            },
            |near| format!("did you mean `{near}`?"),
        );
        DataError::MissingColumn { file: file.to_string(), column: name.to_string(), help }
    })
}

/// Refuses a header in which a name stands twice.
pub(super) fn unique(header: &[ColumnName], file: &str) -> Result<(), DataError> {
    for (at, column) in header.iter().enumerate() {
        if header.iter().take(at).any(|earlier| earlier.full == column.full) {
            return Err(DataError::DuplicateColumn { file: file.to_string(), column: column.full.clone() });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_stand_in_brackets_or_behind_the_name() {
        for (text, stem, unit) in [
            ("az [deg]", "az", Some("deg")),
            ("az(arcsec)", "az", Some("arcsec")),
            ("true_az_deg", "true_az", Some("deg")),
            ("x_mm", "x", Some("mm")),
            ("alpha", "alpha", None),
            ("delta_x", "delta_x", None),
            ("pos_m", "pos_m", None),
            ("pos [m]", "pos", Some("m")),
            ("ambient [K]", "ambient", None),
            ("ambient_celsius", "ambient_celsius", None),
        ] {
            let name = ColumnName::parse(text);
            assert_eq!((name.stem.as_str(), name.unit.map(|unit| unit.name)), (stem, unit), "{text}");
        }
    }
}
