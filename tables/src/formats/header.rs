//! Names of columns, and the units that headers carry: `az [deg]`, `az (deg)`, `az_deg`.

use model_core::unit::{Measures, Unit, UnitError};
use model_core::{Chain, Quantity, SymbolKind, names};

use super::DataError;

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
    /// `az [deg]`, `az (deg)`, or something else in brackets.
    InBrackets(String),
    /// `az_deg`: a unit, or part of the name.
    BehindName(Unit),
}

/// How the numbers of a column are to be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadAs<'a> {
    /// What they measure.
    pub measures: Measures,
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
            Some((name.trim_end(), Said::InBrackets(unit.to_owned())))
        });
        if let Some((name, said)) = in_brackets {
            return Self { full: full.to_owned(), bare: name.to_owned(), stem: name.to_owned(), said };
        }
        let behind_name = Unit::behind_name(full);
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
        self.said(None).ok().flatten()
    }

    /// The unit that the header gives of what is measured, if it gives one.
    ///
    /// # Errors
    /// Something in brackets that is no unit, or could be two.
    pub fn said(&self, measures: Option<Measures>) -> Result<Option<Unit>, UnitError> {
        match &self.said {
            Said::Nothing => Ok(None),
            Said::InBrackets(text) => Unit::read(text, measures).map(Some),
            Said::BehindName(unit) => Ok(Some(*unit)),
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
        let ReadAs { measures, stated, declared } = read;
        let (file, column) = (file.to_owned(), self.full.clone());
        let unknown = |why: UnitError| DataError::UnknownUnit {
            file: file.clone(),
            column: column.clone(),
            why: why.to_string(),
        };
        let is_declared = declared.is_some_and(|declared| declared == self.bare);
        let header = match (&self.said, measures) {
            // A plain number is in the unit of the data, whatever the header calls it.
            (Said::InBrackets(_), Measures::Number) => self.unit().filter(|unit| unit.measures() == measures),
            (Said::InBrackets(_), _) if stated.is_some() => self.said(Some(measures)).ok().flatten(),
            (Said::InBrackets(_), _) => self.said(Some(measures)).map_err(unknown)?,
            (_, measures) if measures.needs_meaning() => {
                let behind = self.full.rsplit_once('_').filter(|_| !is_declared);
                let unit = behind.and_then(|(_, text)| Unit::read(text, Some(measures)).ok());
                unit.filter(|unit| unit.measures() == measures)
            }
            (Said::Nothing, _) => None,
            (Said::BehindName(unit), Measures::Angle | Measures::Length) if is_declared => {
                if stated.is_none() {
                    let (unit, si) = (unit.name(), measures.quantity().unit());
                    return Err(DataError::NameOrUnit { file, column, unit, si });
                }
                None
            }
            (Said::BehindName(unit), Measures::Angle | Measures::Length) => Some(*unit),
            (Said::BehindName(unit), _) => {
                Some(*unit).filter(|unit| unit.measures() == measures && !is_declared)
            }
        };
        let unit = match (stated, header) {
            (Some(stated), Some(header)) if stated.in_si().to_bits() != header.in_si().to_bits() => {
                let (header, study) = (header.name(), stated.name());
                return Err(DataError::UnitConflict { file, column, header, study });
            }
            (stated, header) => stated.or(header),
        };
        if unit.is_none() && measures == Measures::Angle && declared.is_none() {
            return Err(DataError::NoUnit { file, column });
        }
        let wrong = |error: UnitError| DataError::WrongUnit { file, column, why: error.to_string() };
        unit.map_or(Ok(1.0), |unit| unit.factor(measures).map_err(wrong))
    }
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
/// can ask for one, and numbers alone are no names: what they lack is said where columns are looked for.
pub(super) fn unique(header: &[ColumnName], file: &str) -> Result<(), DataError> {
    let mut seen = std::collections::BTreeSet::new();
    let mut named = header.iter().filter(|column| !column.full.is_empty()).peekable();
    if named.peek().is_none() {
        return Err(DataError::NoNames { file: file.to_owned() });
    }
    if named.clone().all(|column| column.full.parse::<f64>().is_ok()) {
        return Ok(());
    }
    match named.find(|column| !seen.insert(column.full.as_str())) {
        None => Ok(()),
        Some(twice) => Err(DataError::DuplicateColumn { file: file.to_owned(), column: twice.full.clone() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANGLE: ReadAs<'_> = ReadAs { measures: Measures::Angle, stated: None, declared: None };

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
            ("ambient [K]", "ambient", Some("K")),
            ("ambient_celsius", "ambient_celsius", None),
        ] {
            let name = ColumnName::parse(text);
            assert_eq!((name.stem.as_str(), name.unit().map(Unit::name)), (stem, unit), "{text}");
        }
    }

    #[test]
    fn what_stands_in_brackets_and_is_no_unit_is_refused_with_the_units_there_are() {
        let factor =
            |text: &str, read| ColumnName::parse(text).factor(read, "f.csv").map_err(|e| e.to_string());
        let declared = |measures| ReadAs { measures, stated: None, declared: Some("q") };
        for text in ["q [degz]", "q [furlong]", "q []", "q (encoder)"] {
            for quantity in [Quantity::Angle, Quantity::Length] {
                let message = factor(text, declared(quantity.into())).err().unwrap_or_default();
                assert!(
                    message.contains("is no unit") && message.contains(quantity.unit()),
                    "{text}: {message}"
                );
            }
            assert_eq!(factor(text, declared(Measures::Number)), Ok(1.0), "{text}");
            // Of what a time is counted in, nothing is taken for granted.
            assert!(factor(text, declared(Measures::Time)).is_err(), "{text}");
        }
        for text in ["q [h]", "q [s]", "q [grad]", "q (mil)", "q [']", "q [\"]", "q [d]"] {
            let message = factor(text, declared(Measures::Angle)).err().unwrap_or_default();
            assert!(message.contains(" or ") && message.contains("write `"), "{text}: {message}");
        }
        // A study that says the unit settles it.
        let stated = ReadAs { stated: Unit::find("deg"), ..declared(Measures::Angle) };
        assert_eq!(factor("q [grad]", stated), Ok(1_f64.to_radians()));
    }

    #[test]
    fn temperatures_times_and_pressures_have_units_where_they_are_declared() {
        let factor = |text: &str, measures| {
            let read = ReadAs { measures, stated: None, declared: Some("q") };
            ColumnName::parse(text).factor(read, "f.csv").map_err(|error| error.to_string())
        };
        for (text, measures, expected) in [
            ("q [K]", Measures::Temperature, 1.0),
            ("q [°C]", Measures::Temperature, 1.0),
            ("q [s]", Measures::Time, 1.0),
            ("q [h]", Measures::Time, 3_600.0),
            ("q [min]", Measures::Time, 60.0),
            ("clock_ms", Measures::Time, 1e-3),
            ("clock_hours", Measures::Time, 3_600.0),
            ("q", Measures::Time, 1.0),
            ("q [hPa]", Measures::Pressure, 100.0),
            ("q [K]", Measures::Number, 1.0),
            ("q [h]", Measures::Number, 1.0),
            ("q [%]", Measures::Number, 0.01),
        ] {
            assert_eq!(factor(text, measures), Ok(expected), "{text}");
        }
        for (text, measures, why) in [
            ("q [°F]", Measures::Temperature, "another zero"),
            ("ambient_F", Measures::Temperature, "another zero"),
            ("q [MJD]", Measures::Time, "the units of a time are s, ms"),
            ("q [deg]", Measures::Temperature, "`deg` measures an angle, but a temperature is wanted"),
        ] {
            assert!(factor(text, measures).is_err_and(|said| said.contains(why)), "{text}");
        }
    }

    #[test]
    fn a_declared_name_that_ends_like_a_unit_asks_what_is_meant() {
        let factor = |text: &str, measures, stated| {
            let read = ReadAs { measures, stated, declared: Some("az_deg") };
            ColumnName::parse(text).factor(read, "f.csv").map_err(|error| error.to_string())
        };
        let angle = Measures::Angle;
        assert!(
            factor("az_deg", angle, None).is_err_and(|why| why.contains("`az_deg [deg]` or `az_deg [rad]`"))
        );
        assert_eq!(factor("az_deg [rad]", angle, None), Ok(1.0));
        assert_eq!(factor("az_deg [deg]", angle, None), Ok(1_f64.to_radians()));
        assert_eq!(factor("az_deg", angle, Unit::find("rad")), Ok(1.0));
        let arcsec = Unit::find("arcsec").map_or(0.0, Unit::in_si);
        assert_eq!(factor("az_deg_arcsec", angle, None), Ok(arcsec));
        assert_eq!(factor("az_deg", Measures::Number, None), Ok(1.0));
        // Another column of that name does say its unit.
        assert_eq!(ColumnName::parse("az_deg").factor(ANGLE, "f.csv"), Ok(1_f64.to_radians()));
    }

    #[test]
    fn what_is_written_in_si_is_read_as_si() {
        for name in ["alpha", "table_turn", "az_deg", "u_mm", "humidity_ppm", "a_b_hour", "x_um"] {
            for quantity in [Quantity::Angle, Quantity::Length, Quantity::Number] {
                let written = ColumnName::parse(&ColumnName::of_si(name, quantity));
                let read = ReadAs { measures: quantity.into(), stated: None, declared: Some(name) };
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
