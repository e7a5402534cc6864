//! Values of a study that may be written short (a text or a number) or long (a table or a list).

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::{
    F64Deserializer, I64Deserializer, MapAccessDeserializer, SeqAccessDeserializer, StrDeserializer,
};
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::written::{Column, Correlation, OneOrMore, Sigma};
use tables::units::Amount;

/// Reads a value that may be written short (a text or number) or long (a table or list).
struct Short<T>(&'static str, PhantomData<T>);

impl<'de> Deserialize<'de> for OneOrMore {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Short("a text or a list of texts", PhantomData::<Self>))
    }
}

impl<'de> Visitor<'de> for Short<OneOrMore> {
    type Value = OneOrMore;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<OneOrMore, E> {
        Ok(OneOrMore(vec![text.to_string()]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<OneOrMore, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(OneOrMore)
    }
}

impl<'de> Deserialize<'de> for Column {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Short(
            "the name of a column, or a table such as { column = \"az\", unit = \"deg\" }",
            PhantomData::<Self>,
        ))
    }
}

impl<'de> Visitor<'de> for Short<Column> {
    type Value = Column;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Column, E> {
        Ok(Column { column: Some(name.to_string()), ..Column::default() })
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Column, A::Error> {
        let column = Column::deserialize(MapAccessDeserializer::new(map))?;
        if column.derive.is_some() && (column.sigma.is_some() || !column.correlation.is_empty()) {
            let key = if column.sigma.is_some() { "sigma" } else { "correlation" };
            let help = "what is derived is as uncertain as what it is derived from: leave out";
            return Err(Error::custom(format!("{help} `{key}`")));
        }
        let is_converted = column.sign.is_some()
            || column.offset.is_some()
            || column.notation.is_some()
            || column.shift.is_some();
        if column.derive.is_some() && is_converted {
            let why = "a derived column has no sign, offset, notation or shift";
            return Err(Error::custom(format!("{why}: write them at the columns that it is derived from")));
        }
        match (&column.column, &column.unit, &column.derive) {
            (Some(_), _, None) | (None, None, Some(_)) => Ok(column),
            (Some(_), _, Some(_)) => {
                Err(Error::custom("a column is read or derived, not both: leave out `column` or `derive`"))
            }
            (None, Some(_), Some(_)) => Err(Error::custom("a derived column has no unit: leave out `unit`")),
            (None, _, None) => Err(Error::custom("which column? write `column = \"…\"` or `derive = \"…\"`")),
        }
    }
}

impl<'de> Deserialize<'de> for Correlation {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer
            .deserialize_any(Short("a number from -1 to 1, or the name of a column", PhantomData::<Self>))
    }
}

impl<'de> Visitor<'de> for Short<Correlation> {
    type Value = Correlation;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Correlation, E> {
        Ok(Correlation::Column(name.to_owned()))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Correlation, E> {
        Ok(Correlation::Evenly(number))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Correlation, E> {
        Ok(Correlation::Evenly(number as f64))
    }
}

impl<'de> Deserialize<'de> for Sigma {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Short(
            "a quantity such as \"2 arcsec\", a column, or a list of columns",
            PhantomData::<Self>,
        ))
    }
}

impl<'de> Visitor<'de> for Short<Sigma> {
    type Value = Sigma;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Sigma, E> {
        Amount::deserialize(StrDeserializer::new(text)).map(Sigma::Amount)
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Sigma, E> {
        Amount::deserialize(F64Deserializer::new(number)).map(Sigma::Amount)
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Sigma, E> {
        Amount::deserialize(I64Deserializer::new(number)).map(Sigma::Amount)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Sigma, A::Error> {
        Short("", PhantomData::<Column>).visit_map(map).map(|column| Sigma::Columns(vec![column]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Sigma, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(Sigma::Columns)
    }
}
