//! Plate solves as separated values: right ascensions and declinations of the mount and of the solved image, with the sidereal time or the
//! date, become hour angles in columns of their own.
//!
//! What lacks for that (a site, a unit, an equinox) is said, and the table is read as it is.

mod roles;
mod rows;
mod stated;

use std::io::Read;

use super::decimal::parse;
use super::sexagesimal::sexagesimal;
use super::sights::{Clock, Equinox, PIER_REMARK, Sight, Site, pier};
use super::{DataError, Options, TableReader, clipped, csv};
use crate::sky::Moment;
use roles::{Calendar, Place, Roles};
use rows::Rows;
use stated::{DEGREE, HOUR, Lack, degrees, equinoxes, said, sidereal_unit, unit};

/// A table of separated values, with hour angles beside it if it is of plate solves. `comments` are the lines above its header.
///
/// # Errors
/// A row that cannot be read.
pub(super) fn seen<'r, R: Read + Send + 'r>(
    mut table: csv::Reader<R>,
    comments: &str,
    options: &Options,
) -> Result<Box<dyn TableReader + 'r>, DataError> {
    let Some(roles) = Roles::of(table.header()) else { return Ok(Box::new(table)) };
    let rows = Rows::all(&mut table, options)?;
    let reading = match Reading::of(&roles, &rows, comments, options) {
        Ok(reading) => reading,
        Err(Lack(why)) => {
            let mut held = rows.held();
            held.remarks.push(format!("right ascensions are not turned into hour angles: {why}"));
            return Ok(Box::new(held));
        }
    };
    let sights: Vec<Sight> = (0..rows.count()).map(|row| reading.sight(row)).collect::<Result<_, _>>()?;
    let mut held = rows.with_sights(&sights);
    held.latitude_deg = reading.site.map(|site| site.latitude_deg).or(reading.latitude_deg);
    held.remarks = reading.remarks;
    held.behind = roles.behind();
    Ok(Box::new(held))
}

/// How the rows are read.
struct Reading<'t> {
    rows: &'t Rows,
    roles: &'t Roles,
    site: Option<Site>,
    latitude_deg: Option<f64>,
    equinoxes: [Equinox; 2],
    /// The units of right ascensions, read and seen, and of the sidereal time, rad.
    units: [f64; 3],
    remarks: Vec<String>,
}

impl<'t> Reading<'t> {
    fn of(roles: &'t Roles, rows: &'t Rows, comments: &str, options: &Options) -> Result<Self, Lack> {
        let said = |names: &[&str]| said(comments, names);
        let of_site = |column: Option<usize>, names: &[&str]| {
            let cell = column.and_then(|at| rows.column(at).first().cloned()).or_else(|| said(names));
            cell.map(|cell| {
                degrees(&cell).ok_or_else(|| Lack(format!("`{}` is no {}", clipped(&cell), names[0])))
            })
            .transpose()
        };
        let latitude_deg = of_site(roles.latitude, &["latitude", "lat", "sitelat"])?;
        let longitude_deg = of_site(roles.longitude, &["longitude", "long", "lon", "sitelong"])?;
        let site = match (latitude_deg, longitude_deg) {
            (Some(latitude_deg), Some(longitude_deg)) => Some(Site { latitude_deg, longitude_deg }),
            (None, Some(longitude_deg)) => options.site.map(|site| Site { longitude_deg, ..site }),
            (Some(latitude_deg), None) => options.site.map(|site| Site { latitude_deg, ..site }),
            (None, None) => options.site,
        };
        if roles.sidereal.is_none() {
            if roles.instant.is_none() {
                return Err(Lack(
                    "no column has the sidereal time (call it `lst`) or the date and time of UTC (call it `utc`)".to_owned(),
                ));
            }
            if site.is_none() {
                return Err(Lack(
                    "without a sidereal time the site is needed: write lines `# latitude = 48.5` and `# longitude = 11.2` (east positive) \
                     above the header, or give --latitude and --longitude"
                        .to_owned(),
                ));
            }
        }
        let mut remarks = vec![format!("{} is a table of plate solves", rows.source)];
        let equinoxes = equinoxes(roles, rows, comments, &mut remarks)?;
        if equinoxes.contains(&Equinox::J2000) && roles.instant.is_none() {
            return Err(Lack(
                "places of J2000 need the date and time of UTC to become places of date: add a column `utc`"
                    .to_owned(),
            ));
        }
        let seen = roles.seen.unwrap_or(roles.read);
        let ra = |place: Place| unit(rows, place.ra);
        let units =
            [ra(roles.read)?, ra(seen)?, roles.sidereal.map_or(Ok(HOUR), |at| sidereal_unit(rows, at))?];
        if roles.sidereal.is_none() {
            remarks.push("the sidereal time is computed from the date and the longitude; UTC counts as UT1, within 0.9 s".to_owned());
        }
        if roles.pier.is_some() {
            remarks.push(PIER_REMARK.to_owned());
        }
        Ok(Self { rows, roles, site, latitude_deg, equinoxes, units, remarks })
    }

    /// What a row says.
    fn sight(&self, row: usize) -> Result<Sight, DataError> {
        let clock = self.clock(row)?;
        let place = |place: Place, side: usize| {
            let ra = self.angle(place.ra, row, self.units[side])? / HOUR;
            let dec = self.angle(place.dec, row, DEGREE)? / DEGREE;
            if dec.abs() > 90.0 {
                let cell = self.rows.cell(place.dec, row);
                let why = format!("{dec} is beyond a pole: write a declination from -90 to 90 degrees");
                return Err(DataError::UnusableCell { cell, why });
            }
            Ok(clock.seen(self.equinoxes[side], [ra, dec]))
        };
        Ok(Sight {
            truth_deg: self.roles.seen.map(|seen| place(seen, 1)).transpose()?,
            read_deg: Some(place(self.roles.read, 0)?),
            pier: self.roles.pier.map(|at| self.pier(at, row)).transpose()?,
        })
    }

    fn clock(&self, row: usize) -> Result<Clock, DataError> {
        let instant = self.roles.instant.map(|(at, calendar)| {
            let text = &self.rows.column(at)[row];
            let number = || parse(text.trim(), b'\n');
            let instant = match calendar {
                Calendar::Text => Moment::of_text(text),
                Calendar::JulianDay => number().map(Moment::of_julian_day),
                Calendar::ModifiedJulianDay => number().map(Moment::of_modified_julian_day),
            };
            instant.ok_or_else(|| DataError::UnusableCell {
                cell: self.rows.cell(at, row),
                why: format!("`{}` is no date and time: write it as 2026-01-31T18:01:00", clipped(text)),
            })
        });
        let instant = instant.transpose()?;
        let sidereal = self.roles.sidereal.map(|at| self.angle(at, row, self.units[2])).transpose()?;
        let Some(clock) = Clock::of(sidereal.map(|angle| angle / HOUR), instant, self.site) else {
            unreachable!("a time was asked for before any row")
        };
        Ok(clock)
    }

    /// An angle in a cell, rad; its own minutes and seconds are in the same unit.
    fn angle(&self, column: usize, row: usize, unit: f64) -> Result<f64, DataError> {
        let text = self.rows.column(column)[row].trim();
        let cell = || self.rows.cell(column, row);
        if text.is_empty() {
            return Err(DataError::EmptyCell { cell: cell() });
        }
        let number = parse(text, b'\n').or_else(|| sexagesimal(text, unit));
        match number {
            Some(number) if number.is_finite() && (number * unit).abs() <= 2.0 * std::f64::consts::TAU => {
                Ok(number * unit)
            }
            _ => Err(DataError::NotANumber { cell: cell(), text: clipped(text) }),
        }
    }

    fn pier(&self, column: usize, row: usize) -> Result<f64, DataError> {
        let text = self.rows.column(column)[row].trim();
        let sides = || self.rows.column(column).iter().map(|text| text.trim());
        // ASCOM numbers its sides 0 and 1, others 1 and -1: all 1 could be either.
        let is_signed =
            sides().any(|side| side == "-1") && sides().all(|side| matches!(side, "1" | "+1" | "-1"));
        let is_numbered = sides().any(|side| side == "0") && sides().all(|side| matches!(side, "0" | "1"));
        let side = match text {
            "1" | "+1" if is_signed => Some(1.0),
            "-1" if is_signed => Some(-1.0),
            "0" if is_numbered => Some(1.0),
            "1" if is_numbered => Some(-1.0),
            text => pier(text),
        };
        side.ok_or_else(|| DataError::UnusableCell {
            cell: self.rows.cell(column, row),
            why: format!("`{}` is no side of a pier: write East or West", clipped(text)),
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::formats::{Cells, Form, Options, TableReader, Wanted, open};

    fn opened(text: &str) -> Result<Box<dyn TableReader + '_>, String> {
        open(text.as_bytes(), "solves.csv", &Options::default()).map_err(|error| error.to_string())
    }

    fn numbers(text: &str, names: &[&str]) -> Result<Vec<Vec<f64>>, String> {
        let mut reader = opened(text)?;
        let at = |name: &&str| reader.header().iter().position(|column| column.full == **name);
        let wanted: Vec<Wanted> =
            names.iter().filter_map(at).map(|column| Wanted { column, form: Form::Number(1.0) }).collect();
        let chunk = reader.read(&wanted, usize::MAX).map_err(|error| error.to_string())?;
        let numbers = chunk.columns.into_iter().map(|cells| match cells {
            Cells::Numbers(numbers) => numbers,
            _ => Vec::new(),
        });
        Ok(numbers.collect())
    }

    const TABLE: &str = "mount_ra,mount_dec,solved_ra,solved_dec,lst,pier side\n\
                         04 00 00,+20 30 00,04 00 04,+20 30 36,6.0,East\n08 00 00,-00 30 00,8:0:0,-0:30:0,06 00 00,West\n";

    #[test]
    fn right_ascensions_become_hour_angles() {
        let found = numbers(TABLE, &["encoder_ha_deg", "true_ha_deg", "true_dec_deg", "pier_sign"])
            .unwrap_or_default();
        let expected = [[30.0, -30.0], [30.0 - 1.0 / 60.0, -30.0], [20.51, -0.5], [1.0, -1.0]];
        assert_eq!(found.len(), 4);
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
        // Semicolons and decimal commas.
        let table = TABLE.replace(',', ";").replace("6.0", "6,0");
        assert!(numbers(&table, &["encoder_ha_deg"]).is_ok_and(|found| (found[0][0] - 30.0).abs() < 1e-9));
    }

    #[test]
    fn what_lacks_is_said_and_the_table_is_read_as_it_is() {
        for (from, to, why) in [
            (",lst", ",other", "no column has the sidereal time"),
            (",lst", ",utc", "the site is needed"),
            ("mount_ra", "mount_ra_j2000", "the equinox of `solved_ra` is not said"),
            ("04 00 00,", "4.0,", "are not turned into"),
        ] {
            let mut table = TABLE.replace(from, to);
            if from == "04 00 00," {
                table = table.replace("08 00 00,", "8.0,");
            }
            let reader = opened(&table);
            let remarks = reader.as_ref().map(|reader| reader.remarks().join("\n")).unwrap_or_default();
            assert!(remarks.contains(why), "{why}: {remarks}");
            assert_eq!(reader.map(|reader| reader.header().len()).unwrap_or_default(), 6);
        }
    }

    #[test]
    fn cells_that_cannot_be_read_have_their_place() {
        for (from, to, why) in [
            ("+20 30 36", "+20 75 36", "line 2, row 1, column `solved_dec`: `+20 75 36` is no number"),
            ("East", "up", "line 2, row 1, column `pier side`: `up` is no side of a pier"),
            ("-00 30 00", "-95", "beyond a pole"),
            ("8:0:0", "", "line 3, row 2, column `solved_ra`: the cell is empty"),
            ("8:0:0", "1e300", "is no number"),
        ] {
            let table = TABLE.replace(from, to);
            let said = opened(&table).map(|_| ());
            assert!(said.as_ref().is_err_and(|said| said.contains(why)), "{said:?}");
        }
    }
}
