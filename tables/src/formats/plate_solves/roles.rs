//! Which columns of a table of plate solves are what, by the words of their names.

use crate::formats::sights::Equinox;
use crate::formats::{ColumnName, words};

/// Words of what the mount said, and of what was seen.
const READ: &[&str] = &[
    "mount",
    "telescope",
    "scope",
    "encoder",
    "enc",
    "raw",
    "reading",
    "read",
    "reported",
    "commanded",
    "cmd",
    "instrument",
];
const SEEN: &[&str] = &[
    "solved",
    "solve",
    "plate",
    "platesolve",
    "platesolved",
    "true",
    "truth",
    "actual",
    "image",
    "wcs",
    "sky",
    "astrometric",
    "catalogue",
    "catalog",
    "star",
];
const OF_J2000: &[&str] = &["j2000", "2000", "icrs", "fk5"];
const OF_DATE: &[&str] = &["jnow", "now", "apparent", "topocentric", "date"];
/// Words of columns that speak of others.
const ABOUT: &[&str] = &[
    "error",
    "err",
    "offset",
    "delta",
    "diff",
    "difference",
    "sigma",
    "std",
    "rms",
    "rate",
    "correction",
    "residual",
    "target",
];

/// A right ascension and a declination.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub ra: usize,
    pub dec: usize,
    /// What the names say of it.
    pub equinox: Option<Equinox>,
}

/// How a column says when its row was taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Calendar {
    /// A date with a time of UTC.
    Text,
    JulianDay,
    ModifiedJulianDay,
}

/// The columns of plate solves.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Roles {
    pub read: Place,
    pub seen: Option<Place>,
    pub sidereal: Option<usize>,
    pub instant: Option<(usize, Calendar)>,
    pub pier: Option<usize>,
    pub equinox: Option<usize>,
    pub latitude: Option<usize>,
    pub longitude: Option<usize>,
}

impl Roles {
    /// Those of a header; none where it is not of plate solves: where it has hour angles, say, or one side without a time.
    pub fn of(header: &[ColumnName]) -> Option<Self> {
        let all: Vec<Vec<String>> = header.iter().map(|name| words(&name.stem)).collect();
        let has = |at: usize, of: &[&str]| all[at].iter().any(|word| of.contains(&word.as_str()));
        let plain = |at: &usize| !has(*at, ABOUT);
        let find = |of: &dyn Fn(usize) -> bool| (0..all.len()).filter(plain).find(|at| of(*at));
        let is_ra = |at: usize| {
            has(at, &["ra", "rightascension"]) || (has(at, &["right"]) && has(at, &["ascension"]))
        };
        let is_dec = |at: usize| has(at, &["dec", "declination", "de"]);
        let is_ha = |at: usize| has(at, &["ha", "hourangle"]) || (has(at, &["hour"]) && has(at, &["angle"]));
        if (0..all.len()).any(is_ha) {
            return None;
        }
        let side = |at: usize| match (has(at, READ), has(at, SEEN)) {
            (true, false) => Some(true),
            (false, true) => Some(false),
            _ => None,
        };
        let place = |on: Option<bool>| {
            let ra = find(&|at| is_ra(at) && side(at) == on)?;
            let dec = find(&|at| is_dec(at) && side(at) == on)?;
            let says = |of: &[&str]| has(ra, of) || has(dec, of);
            let equinox = match (says(OF_J2000), says(OF_DATE)) {
                (true, false) => Some(Equinox::J2000),
                (false, true) => Some(Equinox::Date),
                _ => None,
            };
            Some(Place { ra, dec, equinox })
        };
        let (read, seen, unsaid) = (place(Some(true)), place(Some(false)), place(None));
        let (read, seen) = match (read, seen, unsaid) {
            (Some(read), Some(seen), _) => (read, Some(seen)),
            (Some(read), None, unsaid) => (read, unsaid),
            (None, Some(seen), Some(read)) => (read, Some(seen)),
            (None, ..) => return None,
        };
        let sidereal = find(&|at| has(at, &["lst", "last", "lmst", "sidereal", "siderealtime"]));
        let is_local = |at: usize| has(at, &["local"]);
        let instant = find(&|at| has(at, &["mjd"]))
            .map(|at| (at, Calendar::ModifiedJulianDay))
            .or_else(|| {
                find(&|at| has(at, &["jd", "julian", "juliandate"])).map(|at| (at, Calendar::JulianDay))
            })
            .or_else(|| {
                let dated = |at: usize| {
                    has(at, &["utc", "ut", "dateobs", "datetime", "timestamp"])
                        || (has(at, &["date"]) && has(at, &["obs"]))
                };
                find(&|at| dated(at) && !is_local(at) && !is_ra(at) && !is_dec(at))
                    .map(|at| (at, Calendar::Text))
            });
        if seen.is_none() && sidereal.is_none() && instant.is_none() {
            return None;
        }
        let is_site = |long: &'static [&'static str]| find(&move |at| has(at, long));
        Some(Self {
            read,
            seen,
            sidereal,
            instant,
            pier: find(&|at| has(at, &["pier", "pierside", "sideofpier"])),
            equinox: find(&|at| has(at, &["equinox", "epoch"])),
            latitude: is_site(&["latitude", "lat", "sitelat"]),
            longitude: is_site(&["longitude", "long", "lon", "sitelong"]),
        })
    }

    /// The columns that say nothing more where hour angles stand beside them.
    pub fn behind(&self) -> Vec<usize> {
        let places =
            [Some(self.read), self.seen].into_iter().flatten().flat_map(|place| [place.ra, place.dec]);
        places.chain(self.sidereal).chain(self.pier).collect()
    }
}

/// What a word says of the equinox.
pub(super) fn equinox(text: &str) -> Option<Equinox> {
    let word: String = text.to_lowercase().chars().filter(|letter| letter.is_alphanumeric()).collect();
    match word.trim_end_matches('0') {
        "j2" | "2" | "icrs" | "fk5" => Some(Equinox::J2000),
        "jnow" | "now" | "date" | "ofdate" | "apparent" | "topocentric" => Some(Equinox::Date),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn roles(header: &str) -> Option<Roles> {
        Roles::of(&header.split(',').map(ColumnName::parse).collect::<Vec<_>>())
    }

    #[test]
    fn names_say_what_columns_are() {
        let found =
            roles("file,Solved RA J2000 [hour],Solved Dec J2000,MountRA,MountDec,LST,PierSide,DATE-OBS");
        let Some(found) = found else { panic!("these are plate solves") };
        assert_eq!((found.read.ra, found.read.dec, found.read.equinox), (3, 4, None));
        assert_eq!(found.seen, Some(Place { ra: 1, dec: 2, equinox: Some(Equinox::J2000) }));
        assert_eq!(
            (found.sidereal, found.instant, found.pier),
            (Some(5), Some((7, Calendar::Text)), Some(6))
        );
        // What has no side is the other one.
        let found = roles("ra,dec,mount_ra,mount_dec,mjd");
        assert_eq!(
            found.map(|found| (found.read.ra, found.instant)),
            Some((2, Some((4, Calendar::ModifiedJulianDay))))
        );
    }

    #[test]
    fn other_tables_are_none() {
        for header in [
            "ra,dec,lst",
            "true_ha,true_dec,encoder_ha,encoder_dec",
            "mount_ra,mount_dec,az,el",
            "star,RA [hour],dec [deg]",
            "mount_ra,solved_ra,lst",
            "",
        ] {
            assert_eq!(roles(header), None, "{header}");
        }
    }

    #[test]
    fn equinoxes_are_read_as_they_are_written() {
        for (text, expected) in [
            ("J2000", Some(Equinox::J2000)),
            ("2000.0", Some(Equinox::J2000)),
            ("ICRS", Some(Equinox::J2000)),
            ("JNow", Some(Equinox::Date)),
            ("of date", Some(Equinox::Date)),
            ("B1950", None),
            ("", None),
        ] {
            assert_eq!(equinox(text), expected, "{text}");
        }
    }
}
