//! Names of columns, and the units that headers carry: `az [deg]`, `az (deg)`, `az_deg`.

use model_core::{Chain, Quantity, SymbolKind, names};

use super::DataError;
use crate::units::{Amount, Unit};

/// The name of one column.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnName {
    /// As it stands in the header.
    pub full: String,
    /// Without a unit in brackets.
    bare: String,
    /// Without a unit in brackets or behind the name.
    pub stem: String,
    /// What the header says of the unit.
    said: Said,
}

/// What a header says of a column's unit.
#[derive(Debug, Clone, PartialEq)]
enum Said {
    Nothing,
    /// `az [deg]`, `az (deg)`
    InBrackets(Unit),
    /// `az_deg`: a unit, or part of the name.
    BehindName(Unit),
    /// `az [degs]`: brackets with something else in them.
    Unknown(String),
}

/// How the numbers of a column are to be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadAs<'a> {
    /// What they measure.
    pub quantity: Quantity,
    /// The unit that the study gives.
    pub stated: Option<Unit>,
    /// The declared name by which the column was found, if it was: what has no unit is then in SI, as the commands write it.
    pub declared: Option<&'a str>,
}

impl ColumnName {
    /// Reads one cell of a header.
    #[must_use]
    pub fn parse(text: &str) -> Self {
        let full = text.trim();
        let in_brackets = [('[', ']'), ('(', ')')].into_iter().find_map(|(open, close)| {
            let (name, rest) = full.split_once(open)?;
            let unit = rest.strip_suffix(close)?.trim();
            Some((
                name.trim_end(),
                Unit::find(unit).map_or_else(|| Said::Unknown(unit.to_owned()), Said::InBrackets),
            ))
        });
        if let Some((name, said)) = in_brackets {
            return Self { full: full.to_owned(), bare: name.to_owned(), stem: name.to_owned(), said };
        }
        let behind_name = full.rsplit_once('_').and_then(|(stem, unit)| {
            // One letter is more often part of the name (`pos_m`, the m-th position) than a unit.
            Some((stem, Unit::find(unit).filter(|unit| unit.name.len() > 1)?))
        });
        let (stem, said) =
            behind_name.map_or((full, Said::Nothing), |(stem, unit)| (stem, Said::BehindName(unit)));
        Self { full: full.to_owned(), bare: full.to_owned(), stem: stem.to_owned(), said }
    }

    /// The header of a column of numbers in SI, so that it is read as such: the name alone, or with its unit where the name
    /// ends like one.
    #[must_use]
    pub fn of_si(name: &str, quantity: Quantity) -> String {
        match (Self::parse(name).said, quantity) {
            (Said::Nothing, _) | (_, Quantity::Number) => name.to_owned(),
            (_, quantity) => format!("{name} [{}]", quantity.unit()),
        }
    }

    /// Whether a name means this column, with or without its unit. A column that has another of the `declared` names belongs
    /// to that one, though its name may end like a unit.
    #[must_use]
    pub fn means(&self, name: &str, declared: &[&str]) -> bool {
        self.bare == name || self.stem == name && !declared.contains(&self.bare.as_str())
    }

    /// The unit that the header gives, if it is one.
    #[must_use]
    pub fn unit(&self) -> Option<Unit> {
        match self.said {
            Said::InBrackets(unit) | Said::BehindName(unit) => Some(unit),
            Said::Nothing | Said::Unknown(_) => None,
        }
    }

    /// Whether nothing says the unit of these numbers, so that they are taken as SI.
    #[must_use]
    pub fn is_bare(&self, read: ReadAs<'_>) -> bool {
        read.stated.is_none() && self.said == Said::Nothing
    }

    /// The factor that takes this column's numbers to SI.
    ///
    /// # Errors
    /// An angle without a unit, a unit of something else, brackets with something that is none, a name that ends like one
    /// and says no more, or two units that differ.
    pub fn factor(&self, read: ReadAs<'_>, file: &str) -> Result<f64, DataError> {
        let ReadAs { quantity, stated, declared } = read;
        let (file, column) = (file.to_owned(), self.full.clone());
        let is_declared = declared.is_some_and(|declared| declared == self.bare);
        let header = match &self.said {
            Said::Nothing => None,
            // A plain number is in the unit of the data, whatever the header calls it.
            Said::InBrackets(unit) | Said::BehindName(unit)
                if quantity == Quantity::Number && unit.quantity != quantity =>
            {
                None
            }
            Said::InBrackets(unit) => Some(*unit),
            Said::BehindName(unit) if is_declared => match (stated, quantity) {
                (None, Quantity::Angle | Quantity::Length) => {
                    let (unit, si) = (unit.name, quantity.unit());
                    return Err(DataError::NameOrUnit { file, column, unit, si });
                }
                _ => None,
            },
            Said::BehindName(unit) => Some(*unit),
            Said::Unknown(text) => match (stated, quantity) {
                (None, Quantity::Angle | Quantity::Length) => {
                    return Err(DataError::UnknownUnit { file, column, why: unknown(text, quantity) });
                }
                _ => None,
            },
        };
        let unit = match (stated, header) {
            (Some(stated), Some(header)) if stated.in_si != header.in_si => {
                let (header, study) = (header.name, stated.name);
                return Err(DataError::UnitConflict { file, column, header, study });
            }
            (stated, header) => stated.or(header),
        };
        if unit.is_none() && quantity == Quantity::Angle && declared.is_none() {
            return Err(DataError::NoUnit { file, column });
        }
        Amount { number: 1.0, unit }.to_si(quantity).map_err(|error| DataError::WrongUnit {
            file,
            column,
            why: error.to_string(),
        })
    }
}

/// `` `degs` is no unit: did you mean `deg`? Angles are in rad, mrad, … ``
fn unknown(text: &str, quantity: Quantity) -> String {
    let units =
        Unit::all().filter(|unit| unit.quantity == quantity).map(|unit| unit.name).collect::<Vec<_>>();
    let near = names::nearest(text, units.iter().copied());
    let near = near.map_or_else(String::new, |near| format!("did you mean `{near}`? "));
    let what = if quantity == Quantity::Angle { "an angle" } else { "a length" };
    format!("`{text}` is no unit; {near}the units of {what} are {}", units.join(", "))
}

/// The columns that the names of a chain mean: those of joints and inputs, and of what observables show.
#[must_use]
pub fn declared_columns(chain: &Chain) -> Vec<String> {
    let readings = [SymbolKind::Joint, SymbolKind::Input]
        .into_iter()
        .flat_map(|kind| chain.symbols_of(kind))
        .map(|id| chain.symbol(id).name.clone());
    let names = chain.observables.iter().map(|shown| shown.name.as_str());
    let shown = names.flat_map(|name| ["x", "y", "z"].map(|axis| format!("{name}_{axis}")));
    readings.chain(shown).collect()
}

/// The column that a study names, with or without its unit.
///
/// # Errors
/// It is not there (the message names the nearest, or all), or two columns could be meant.
pub fn find_column(header: &[ColumnName], name: &str, file: &str) -> Result<usize, DataError> {
    match header.iter().position(|column| column.full == name) {
        Some(column) => Ok(column),
        None => find_reading(header, name, &[], file),
    }
}

/// The column of a name, with or without its unit, as [`ColumnName::means`] has it.
///
/// # Errors
/// As [`find_column`].
pub fn find_reading(
    header: &[ColumnName],
    name: &str,
    declared: &[&str],
    file: &str,
) -> Result<usize, DataError> {
    let mut meant = header.iter().enumerate().filter(|(_, column)| column.means(name, declared));
    match (meant.next(), meant.next()) {
        (None, _) => Err(missing(header, name, file)),
        (Some((column, _)), None) => Ok(column),
        (Some((_, one)), Some((_, other))) => Err(DataError::TwoColumns {
            file: file.to_owned(),
            name: name.to_owned(),
            one: one.full.clone(),
            other: other.full.clone(),
        }),
    }
}

fn missing(header: &[ColumnName], name: &str, file: &str) -> DataError {
    let full = || header.iter().map(|column| column.full.as_str());
    let near = names::nearest(name, header.iter().map(|column| column.stem.as_str()))
        .and_then(|stem| header.iter().find(|column| column.stem == stem))
        .map(|column| column.full.as_str());
    let help = near.or_else(|| names::nearest(name, full())).map_or_else(
        || format!("the file has {}", full().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")),
        |near| format!("did you mean `{near}`?"),
    );
    DataError::MissingColumn { file: file.to_owned(), column: name.to_owned(), help }
}

/// Refuses a header without a name, or in which a name stands twice. Columns without a name there may be several of, as nobody
/// can ask for one.
pub(super) fn unique(header: &[ColumnName], file: &str) -> Result<(), DataError> {
    let mut seen = std::collections::BTreeSet::new();
    let mut named = header.iter().filter(|column| !column.full.is_empty()).peekable();
    if named.peek().is_none() {
        return Err(DataError::NoNames { file: file.to_owned() });
    }
    match named.find(|column| !seen.insert(column.full.as_str())) {
        None => Ok(()),
        Some(twice) => Err(DataError::DuplicateColumn { file: file.to_owned(), column: twice.full.clone() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANGLE: ReadAs<'_> = ReadAs { quantity: Quantity::Angle, stated: None, declared: None };

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
            assert_eq!((name.stem.as_str(), name.unit().map(|unit| unit.name)), (stem, unit), "{text}");
        }
    }

    #[test]
    fn what_stands_in_brackets_and_is_no_unit_is_refused_with_the_units_there_are() {
        let factor =
            |text: &str, read| ColumnName::parse(text).factor(read, "f.csv").map_err(|e| e.to_string());
        let declared = |quantity| ReadAs { quantity, stated: None, declared: Some("q") };
        for text in ["q [degs]", "q [degrees]", "q [Deg]", "q (mil)", "q [feet]", "q []", "q [DEG]"] {
            for quantity in [Quantity::Angle, Quantity::Length] {
                let message = factor(text, declared(quantity)).err().unwrap_or_default();
                assert!(
                    message.contains("is no unit") && message.contains(quantity.unit()),
                    "{text}: {message}"
                );
            }
            assert_eq!(factor(text, declared(Quantity::Number)), Ok(1.0), "{text}");
        }
        // A study that says the unit settles it.
        let stated = ReadAs { stated: Unit::find("deg"), ..declared(Quantity::Angle) };
        assert_eq!(factor("q [degrees]", stated), Ok(1_f64.to_radians()));
    }

    #[test]
    fn a_declared_name_that_ends_like_a_unit_asks_what_is_meant() {
        let factor = |text: &str, quantity, stated| {
            let read = ReadAs { quantity, stated, declared: Some("az_deg") };
            ColumnName::parse(text).factor(read, "f.csv").map_err(|error| error.to_string())
        };
        let angle = Quantity::Angle;
        assert!(
            factor("az_deg", angle, None).is_err_and(|why| why.contains("`az_deg [deg]` or `az_deg [rad]`"))
        );
        assert_eq!(factor("az_deg [rad]", angle, None), Ok(1.0));
        assert_eq!(factor("az_deg [deg]", angle, None), Ok(1_f64.to_radians()));
        assert_eq!(factor("az_deg", angle, Unit::find("rad")), Ok(1.0));
        let arcsec = Unit::find("arcsec").map_or(0.0, |unit| unit.in_si);
        assert_eq!(factor("az_deg_arcsec", angle, None), Ok(arcsec));
        assert_eq!(factor("az_deg", Quantity::Number, None), Ok(1.0));
        // Another column of that name does say its unit.
        assert_eq!(ColumnName::parse("az_deg").factor(ANGLE, "f.csv"), Ok(1_f64.to_radians()));
    }

    #[test]
    fn what_is_written_in_si_is_read_as_si() {
        for name in ["alpha", "table_turn", "az_deg", "u_mm", "humidity_ppm", "a_b_hour", "x_um"] {
            for quantity in [Quantity::Angle, Quantity::Length, Quantity::Number] {
                let written = ColumnName::parse(&ColumnName::of_si(name, quantity));
                let read = ReadAs { quantity, stated: None, declared: Some(name) };
                assert_eq!(written.factor(read, "f.csv"), Ok(1.0), "{name}");
                assert_eq!(find_reading(&[written], name, &[name], "f.csv"), Ok(0), "{name}");
            }
        }
    }

    #[test]
    fn a_name_means_one_column() {
        let header = |names: &[&str]| names.iter().map(|name| ColumnName::parse(name)).collect::<Vec<_>>();
        let two = header(&["az", "az [deg]", "el_deg"]);
        assert!(matches!(find_reading(&two, "az", &["az"], "f.csv"), Err(DataError::TwoColumns { .. })));
        assert_eq!(find_column(&two, "az", "f.csv"), Ok(0));
        assert_eq!(find_column(&two, "az [deg]", "f.csv"), Ok(1));
        assert_eq!(find_column(&two, "el", "f.csv"), Ok(2));
        // `az_deg` is declared: it is not `az` in degrees.
        let both = header(&["az_deg [rad]", "az_deg_rad", "az"]);
        assert_eq!(find_reading(&both, "az", &["az", "az_deg"], "f.csv"), Ok(2));
        assert!(find_reading(&both, "az_deg", &["az", "az_deg"], "f.csv").is_err());
    }
}
