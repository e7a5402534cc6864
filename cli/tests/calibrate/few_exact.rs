//! A few exact targets beside free stations: they hold the frame of all others.

use crate::figures::{calibrated, number};
use crate::room::{Room, STUDY, TRACKER};
use crate::support::Folder;
use testkit::Random;

/// What nobody fitted is foretold as well as with nothing known: without some of these points a fold does not know where all of it is.
#[test]
fn a_few_exact_targets_are_foretold_as_well_as_unknown_ones() {
    let folder = Folder::new("few-exact");
    folder.write("tracker.chain", TRACKER.replace("longer*range", "range_zero"));
    for seed in 1..=4 {
        let random = &mut Random::new(seed);
        let mut room = Room::new(random);
        room.targets.truncate(14);
        folder.write("rows.csv", room.rows(random, 0.0));
        let mut alone = None;
        for exact in [0, 1, 2, 3, 4] {
            let place = |(at, [x, y, z]): (usize, &[f64; 3])| {
                format!("T{at} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\" }}\n")
            };
            let stated: String = room.targets.iter().take(exact).enumerate().map(place).collect();
            let table = if exact > 0 { "[objects]\n" } else { "" };
            folder.write("study.toml", format!("{STUDY}{table}{stated}"));
            let report = calibrated(&folder, "study.toml");
            let held_out = number(&report["after"]["held_out_rms"]);
            let alone = *alone.get_or_insert(held_out);
            assert!(held_out < 1.2 * alone, "{seed}, {exact} exact: {held_out}, {alone} without");
            assert!(report["verdict"] != "not confirmed", "{seed}, {exact} exact: {}", report["verdict"]);
        }
    }
}
