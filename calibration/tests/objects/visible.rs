//! How many combinations of errors a set-up sees, beside the ranks that `tests/reference/objects_rank.py` printed.

use calibration::fit::fit;
use calibration::objects::{Remedy, identify};
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

/// Readings of one column spoilt by so much, rad or m, row after row in an order without meaning.
fn spoilt(data: &str, columns: &[(usize, f64)]) -> String {
    let mut lines = data.lines();
    let mut text = format!("{}\n", lines.next().unwrap());
    for (row, line) in lines.enumerate() {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        for (step, (column, size)) in [0.324_717_957, 0.754_877_666, 0.569_840_291].iter().zip(columns) {
            let by = 2.0 * ((row + 1) as f64 * step).fract() - 1.0;
            cells[*column] = format!("{:.9}", cells[*column].parse::<f64>().unwrap() + by * size);
        }
        text += &(cells.join(",") + "\n");
    }
    text
}

/// With everything unknown a room that is larger by a part looks the same: nothing shows the scale of the ranges, however rough
/// the readings are, and with known stations it is shown.
#[test]
fn noise_shows_no_scale() {
    let chain = text_of("examples/objects/scanner.chain")
        .replace("Ty(range_zero)", "Ty(range_zero), Ty(longer*range)");
    let study = text_of("examples/objects/targets.toml") + "[fit]\ntolerance = { longer = \"0.1\" }\n";
    for noise_m in [0.0, 1e-4, 1e-3, 1e-2] {
        let data = spoilt(
            &text_of("examples/objects/targets.csv"),
            &[(2, noise_m / 8.0), (3, noise_m / 8.0), (4, noise_m)],
        );
        let (plan, loaded) = read(&chain, &study, &data).unwrap();
        let longer = plan.chain.find_symbol("longer").unwrap();
        let set_up = identify(&plan.chain, &loaded.observations, &plan.fit).unwrap();
        assert_eq!(set_up.now.hidden, [longer], "{noise_m}: {:?}", set_up.now);
        assert_eq!(set_up.now.combinations.len(), 6, "{noise_m}");
        let known = set_up.remedies.iter().find(|(remedy, _)| *remedy == Remedy::KnownStations);
        assert!(known.is_some_and(|(_, seen)| seen.alone.contains(&longer)), "{noise_m}: {set_up:#?}");
        let fitted = fit(&plan.chain, &loaded.observations, &plan.fit).unwrap();
        let at = fitted.parameters.iter().position(|&id| id == longer).unwrap();
        assert!(!fitted.shown[at], "{noise_m}: {:?}", fitted.estimable);
        assert!((fitted.standard_uncertainty(longer).unwrap() / 0.1 - 1.0).abs() < 0.01, "{noise_m}");
    }
}
