//! How the truth was observed: as angles, as a unit vector, as offsets, as a point; or what nobody knows the place of.

use super::look::{Column, Look, Read};
use super::words::Part;
use observe::kinds::UNIT_TOLERANCE;

/// What was observed, with its columns.
pub enum Observed {
    /// Two angles of the true direction, with the keys that a study names them by.
    Spherical([&'static str; 2], [Read; 2]),
    /// One true angle.
    Azimuth(Read),
    /// A unit vector.
    Direction([Read; 3]),
    /// True minus nominal, across and along.
    Offset([Read; 2]),
    /// A point.
    Point([Read; 3]),
    /// The distance of a point.
    Range(Read),
    /// An unknown target that one column names, from the station that another names, if there are several.
    Target(String, Option<String>),
    /// Points of unknown planes that one column names.
    Plane(String),
}

impl Observed {
    /// A true direction, by whatever columns tell it.
    ///
    /// # Errors
    /// None do, or several could.
    pub fn direction(
        look: &Look,
        [first, second]: [&[Part]; 2],
        keys: [&'static str; 2],
        remarks: &mut Vec<String>,
    ) -> Result<Self, String> {
        if let (Some(one), Some(other)) = (look.truth(first)?, look.truth(second)?) {
            let read = look.angles(&[one, other], remarks)?;
            return <[Read; 2]>::try_from(read)
                .map(|read| Self::Spherical(keys, read))
                .map_err(|_| unreachable!("two columns were read"));
        }
        if let Some(vector) = vectors(look, true)? {
            return Ok(Self::Direction(vector.map(Column::plain)));
        }
        if let (Some(cross), Some(along)) = (look.reading(&[Part::Cross])?, look.reading(&[Part::Along])?) {
            let read = look.angles(&[cross, along], remarks)?;
            return <[Read; 2]>::try_from(read)
                .map(Self::Offset)
                .map_err(|_| unreachable!("two columns were read"));
        }
        Err(format!(
            "{}: nothing says where the instrument truly pointed: name columns `true_{}` and `true_{}`, or `x`, `y`, `z` \
             of a unit vector, or `offset_cross` and `offset_along`",
            look.file, keys[0], keys[1]
        ))
    }

    /// A true point.
    ///
    /// # Errors
    /// No columns tell one, or several could.
    pub fn point(look: &Look, remarks: &mut Vec<String>) -> Result<Self, String> {
        let missing = || {
            format!(
                "{}: nothing says where the point truly was: name columns `x [mm]`, `y [mm]` and `z [mm]`, with \
                 the unit that they are in",
                look.file
            )
        };
        let vector = vectors(look, false)?.ok_or_else(missing)?;
        let read = look.lengths(&vector, remarks)?;
        <[Read; 3]>::try_from(read).map(Self::Point).map_err(|_| unreachable!("three columns were read"))
    }

    /// A point in columns that are known.
    ///
    /// # Errors
    /// A cell that is no number.
    pub fn point_in(look: &Look, names: &[String; 3], remarks: &mut Vec<String>) -> Result<Self, String> {
        let columns: Vec<&Column> = names.iter().filter_map(|name| look.named(&[name.as_str()])).collect();
        let read = look.lengths(&columns, remarks)?;
        <[Read; 3]>::try_from(read).map(Self::Point).map_err(|_| unreachable!("the columns are there"))
    }

    /// The labels of targets, of which no column says where they are; none where no labels come again.
    ///
    /// # Errors
    /// Several columns could be meant.
    pub fn target(look: &Look) -> Result<Option<Self>, String> {
        if vectors(look, false)?.is_some() {
            return Ok(None);
        }
        let of = |part: Part| {
            let own = look.columns.iter().filter(move |column| column.part() == Some(part));
            own.filter(|column| column.labels_rows())
                .map(|column| column.name.full.as_str())
                .collect::<Vec<_>>()
        };
        let one = |found: Vec<&str>| match found.as_slice() {
            [] => Ok(None),
            [one] => Ok(Some((*one).to_owned())),
            [one, other, ..] => Err(format!(
                "{}: do the labels stand in `{one}` or in `{other}`? take one of the columns out of the table",
                look.file
            )),
        };
        let Some(object) = one(of(Part::Name))? else { return Ok(None) };
        Ok(Some(Self::Target(object, one(of(Part::Station))?)))
    }

    /// The true directions as vectors, where the rows tell them by themselves.
    pub fn vectors(&self) -> Option<Vec<[f64; 3]>> {
        match self {
            Self::Spherical(_, [azimuth, elevation]) => {
                let pairs = azimuth.si.iter().zip(&elevation.si);
                Some(pairs.map(|(a, e)| [a.sin() * e.cos(), a.cos() * e.cos(), e.sin()]).collect())
            }
            Self::Direction([x, y, z]) => {
                Some(x.si.iter().zip(&y.si).zip(&z.si).map(|((&x, &y), &z)| [x, y, z]).collect())
            }
            Self::Azimuth(_)
            | Self::Offset(_)
            | Self::Point(_)
            | Self::Range(_)
            | Self::Target(..)
            | Self::Plane(_) => None,
        }
    }
}

/// The three columns of a vector: their names differ in the axis alone. Of length one, or not.
fn vectors(look: &Look, of_length_one: bool) -> Result<Option<[&Column; 3]>, String> {
    let axes = [(Part::X, ["x", "east", "e"]), (Part::Y, ["y", "north", "n"]), (Part::Z, ["z", "up", "u"])];
    let [first, others @ ..] = axes.map(|(part, words)| {
        let columns = look
            .columns
            .iter()
            .filter(move |column| column.part() == Some(part) && !column.values().is_empty());
        let stems = columns.filter_map(move |column| {
            Some((words.iter().find_map(|word| column.words_without(word))?, column))
        });
        stems.collect::<Vec<_>>()
    });
    let mut found = Vec::new();
    for (stem, x) in &first {
        let beside =
            others.each_ref().map(|axis| axis.iter().find(|(own, _)| own == stem).map(|(_, column)| *column));
        if let [Some(y), Some(z)] = beside {
            let norms = x
                .values()
                .iter()
                .zip(y.values())
                .zip(z.values())
                .map(|((x, y), z)| (x * x + y * y + z * z).sqrt());
            let is_unit = norms.into_iter().all(|norm| (norm - 1.0).abs() <= UNIT_TOLERANCE);
            if is_unit == of_length_one {
                found.push([*x, y, z]);
            }
        }
    }
    match found.as_slice() {
        [] => Ok(None),
        [one] => Ok(Some(*one)),
        [one, other, ..] => Err(format!(
            "{}: is the truth in `{}` or in `{}`? take one of the vectors out of the table",
            look.file, one[0].name.full, other[0].name.full
        )),
    }
}
