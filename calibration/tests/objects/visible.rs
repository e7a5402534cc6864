//! How many combinations of errors a set-up sees, beside the ranks that `tests/reference/objects_rank.py` printed.

use network::{Remedy, identify};
use std::fmt::Write as _;

use super::{read, text_of};

/// The stations that the reference made its rows from, known or as a rough start.
fn stations(known: bool) -> String {
    let mut text = "[stations]\n".to_owned();
    for line in text_of("calibration/tests/objects/lidar-stations.txt").lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let [label, x, y, z, roll, pitch, heading] = words[..] else { panic!("{line}") };
        let rough = if known { "" } else { ", rough = true" };
        let _ = writeln!(
            text,
            "{label} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\", roll = \"{roll} rad\", pitch = \"{pitch} rad\", \
             heading = \"{heading} rad\"{rough} }}"
        );
    }
    text
}

/// The readings with noise of this size, in m of the range and a tenth of it in rad.
fn noisy(data: &str, size: f64) -> String {
    let mut text = String::new();
    let mut step = 0.0_f64;
    for (number, line) in data.lines().enumerate() {
        let cells = line.split(',').enumerate().map(|(column, cell)| match cell.parse::<f64>() {
            Ok(value) if number > 0 => {
                step += 1.0;
                // Uniform, by steps of the golden section; ranges stand in the last column.
                let noise =
                    2.0 * (step * 0.618_033_988_75 + (step * step * 0.414_213_562).fract()).fract() - 1.0;
                (value + noise * if column == 5 { size } else { 0.1 * size }).to_string()
            }
            _ => cell.to_owned(),
        });
        text += &(cells.collect::<Vec<_>>().join(",") + "\n");
    }
    text
}

/// Source: `tests/reference/objects_rank.py`: 15 combinations with known stations, 11 with unknown ones, of targets as of
/// planes, whether these are known or not.
#[test]
fn the_papers_scanner_shows_fifteen_combinations_and_eleven_from_unknown_stations() {
    for (kind, data) in [("target", "lidar-targets"), ("plane", "lidar-planes")] {
        for (known, expected) in [(true, 15), (false, 11)] {
            let study = format!(
                "chain = \"c\"\nobservable = \"target\"\ndata = \"d\"\n[observed]\nkind = \"{kind}\"\nobject = \"object\"\n\
                 station = \"station\"\n{}",
                stations(known)
            );
            let chain = text_of("examples/mobile-lidar/mobile-lidar.chain");
            let data = text_of(&format!("calibration/tests/objects/{data}.csv"));
            let noisy = noisy(&data, 0.001);
            let (plan, loaded) = read(&chain, &study, &noisy).unwrap();
            let of_noisy = identify(&plan.chain, &loaded.observations, &plan.fit).unwrap();
            assert_eq!(of_noisy.now.combinations.len(), expected, "{kind}, noisy, stations known: {known}");
            let (plan, loaded) = read(&chain, &study, &data).unwrap();
            let set_up = identify(&plan.chain, &loaded.observations, &plan.fit).unwrap();
            assert_eq!(set_up.now.combinations.len(), expected, "{kind}, stations known: {known}");
            assert_eq!(set_up.stations, [4, if known { 0 } else { 4 }]);
            let known_stations = set_up.remedies.iter().find(|(remedy, _)| *remedy == Remedy::KnownStations);
            assert_eq!(known_stations.map(|(_, seen)| seen.combinations.len()), (!known).then_some(15));
            // Known objects show nothing more.
            assert!(
                set_up.remedies.iter().all(|(remedy, _)| *remedy == Remedy::KnownStations),
                "{set_up:#?}"
            );
        }
    }
}
