//! Point files of AutoSlew (`.pox`), which the plugin of NINA for mounts of ASA writes: a count, then ten lines a point.
//!
//! Source: photon1503, NINA.Photon.Plugin.ASA, `ModelBuilder.cs`, `FinishAlignment`: a name in quotes, the date and time of UTC in quotes, the
//! minutes and seconds of it, the exposure, right ascension of the mount and of the plate solve (hours, J2000), declination of both (degrees),
//! the side of the pier in quotes (1 east, -1 west), and a line of asterisks. Points named `sync point` repeat the plate solve as the
//! mount's reading.

use super::held::Held;
use super::sights::{Clock, Equinox, NAMES, Sight};
use super::{DataError, Options, WholeFile, clipped};
use crate::sky::Moment;

pub(super) const FORM: WholeFile = WholeFile { name: "points of AutoSlew (.pox)", looks, read };

/// Lines of a point.
const LINES: usize = 10;

fn looks(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim);
    let is_count = lines.next().is_some_and(|line| line.parse::<u32>().is_ok());
    is_count && lines.next().is_some_and(|line| line.starts_with("\"Number "))
}

/// Reads a file.
///
/// # Errors
/// A line that is none of such a file, with its number; no site.
fn read(text: &str, source: &str, options: &Options) -> Result<Held, DataError> {
    let file = || source.to_owned();
    let lines: Vec<(u64, &str)> = (1..).zip(text.lines().map(str::trim)).skip(1).collect();
    let Some(site) = options.site else {
        let why = "these points have a time and no sidereal time: say where the mount stands, in a study as \
                   site = { latitude = \"48.5 deg\", longitude = \"11.2 deg\" }, to `trueaxis init` as --latitude 48.5 --longitude 11.2 (east \
                   positive)";
        return Err(DataError::Unreadable { file: file(), why: why.to_owned() });
    };
    let mut names = vec!["point"];
    names.extend(NAMES);
    let mut held = Held::new(source, &names);
    let mut synced = 0;
    for point in lines.chunks(LINES) {
        let (first, _) = point.first().copied().unwrap_or_default();
        if point.iter().all(|(_, line)| line.is_empty()) {
            break;
        }
        let bad = |at: usize, why: &str| {
            let (line, text) = point.get(at).copied().unwrap_or((first, ""));
            DataError::BadLine { file: file(), line, why: format!("`{}` {why}", clipped(text)) }
        };
        if point.len() + 1 < LINES {
            return Err(bad(point.len() - 1, "is the last line, and a point has ten: was the file cut off?"));
        }
        let quoted = |at: usize| point.get(at).map_or("", |(_, line)| line.trim_matches(['"', '\'']));
        let number = |at: usize, most: f64, what: &str| {
            let value = point.get(at).and_then(|(_, line)| line.replace(',', ".").parse::<f64>().ok());
            value.filter(|value| value.abs() <= most).ok_or_else(|| bad(at, what))
        };
        let name = quoted(0);
        if !name.starts_with("Number ") {
            return Err(bad(0, "is not the name of a point, such as \"Number 3\""));
        }
        if name.contains("sync point") {
            synced += 1;
            continue;
        }
        let instant = Moment::of_text(quoted(1)).ok_or_else(|| bad(1, "is no date and time of UTC"))?;
        let ra = "is no right ascension in hours";
        let dec = "is no declination in degrees";
        let [read_ra, seen_ra] = [number(4, 24.0, ra)?, number(5, 24.0, ra)?];
        let [read_dec, seen_dec] = [number(6, 90.0, dec)?, number(7, 90.0, dec)?];
        let side = match quoted(8) {
            "1" => 1.0,
            "-1" => -1.0,
            _ => return Err(bad(8, "is no side of the pier: \"1\" is east, \"-1\" west")),
        };
        let Some(clock) = Clock::of(None, Some(instant), Some(site)) else {
            unreachable!("an instant at a site has a sidereal time")
        };
        let sight = Sight {
            truth_deg: Some(clock.seen(Equinox::J2000, [seen_ra, seen_dec])),
            read_deg: Some(clock.seen(Equinox::J2000, [read_ra, read_dec])),
            pier: Some(side),
        };
        let cells = sight.cells().map(|cell| cell.map_or_else(String::new, |cell| cell.to_string()));
        held.push(Some(first), std::iter::once(name.to_owned()).chain(cells));
    }
    if held.rows() == 0 {
        return Err(DataError::NoRows { file: file() });
    }
    held.latitude_deg = Some(site.latitude_deg);
    held.remarks.push(format!(
        "{source} is a point file of AutoSlew: {} points of J2000, turned to the date by precession (IAU 2006), nutation and aberration; UTC \
         counts as UT1, within 0.9 s",
        held.rows()
    ));
    if synced > 0 {
        held.remarks.push(format!("{synced} points only set the mount to the plate solve, and say nothing of its errors: they are left out"));
    }
    Ok(held)
}

#[cfg(test)]
mod tests {
    use super::super::{Site, TableReader as _};
    use super::*;

    const FILE: &str = "2\r\n\"Number 1 sync point\"\r\n\"'2026-01-31T18:01:00.00'\"\r\n\"01:00.00\"\r\n\"5\"\r\n4.5\r\n4.5\r\n20.5\r\n20.5\r\n\
                        \"1\"\r\n**************************\r\n\"Number 2\"\r\n\"'2026-01-31T18:02:00.00'\"\r\n\"02:00.00\"\r\n\"5\"\r\n4.5\r\n4.501\r\n\
                        20.5\r\n20.51\r\n\"-1\"\r\n\"**************************\"\r\n";

    fn at_a_site(text: &str) -> Result<Held, String> {
        let site = Some(Site { latitude_deg: 48.0, longitude_deg: 11.0 });
        read(text, "f.pox", &Options { site, ..Options::default() }).map_err(|error| error.to_string())
    }

    #[test]
    fn points_are_read_and_those_that_only_set_the_mount_are_left_out() {
        assert!(looks(FILE) && !looks("2\n3\n") && !looks(""));
        let held = at_a_site(FILE);
        assert_eq!(held.as_ref().map(|held| (held.rows(), held.latitude_deg())), Ok((1, Some(48.0))));
        assert!(
            held.is_ok_and(|held| held.remarks.iter().any(|remark| remark.contains("1 points only set")))
        );
    }

    #[test]
    fn what_is_wrong_has_its_line() {
        let without_site = read(FILE, "f.pox", &Options::default()).map_err(|error| error.to_string());
        assert!(without_site.is_err_and(|said| said.contains("say where the mount stands")));
        for (from, to, why) in [
            ("4.501", "94.501", "line 17: `94.501` is no right ascension"),
            ("\"-1\"", "\"0\"", "line 20: `\"0\"` is no side of the pier"),
            ("18:02", "38:02", "line 13: `\"'2026-01-31T38:02:00.00'\"` is no date"),
            ("\"Number 2\"", "\"2\"", "line 12: `\"2\"` is not the name of a point"),
            ("\"-1\"\r\n\"**************************\"\r\n", "", "was the file cut off?"),
        ] {
            let said = at_a_site(&FILE.replace(from, to)).map(|_| ());
            assert!(said.as_ref().is_err_and(|said| said.contains(why)), "{said:?}");
        }
    }
}
