//! Equatorial mounts: right ascensions for hour angles, and a clock that a declared zero takes up.

use calibration::diagnose::Caution;
use calibration::misread::Reading;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::{between, calibrated, misread, noise, table};

/// A polar mount: elevation of the polar axis is left to the frame, so that only small errors are left.
const POLAR: &str = "chain Mount {
    body fork on ground { position_error: Rx(polar_up), Ry(polar_side); motion: Rz(-ha); motion_error: Rz(-ha_index); }
    body tube on fork { position_error: Ry(skew); motion: Rx(dec); motion_error: Rx(dec_index), Rz(collimation); }
    observe sight: direction(0, 1, 0) of tube;
}
";

/// Rows of the hour angle, the declination and both as they are seen, deg: the polar axis three minutes of arc off, and noise of 5″.
fn seen(seed: u64, rows: usize, zero_deg: f64) -> Vec<[f64; 4]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (polar, spread) = (0.05_f64.to_radians(), 2.4e-5);
    let of_row = |_| {
        let (ha, dec) = (between(&mut random, -75.0, 75.0), between(&mut random, -20.0, 70.0));
        let (h, d) = ((ha + zero_deg).to_radians(), dec.to_radians());
        // The first order of a tilt of the polar axis.
        let (h, d) = (h + polar * h.cos() * d.tan(), d - polar * h.sin());
        let (across, along) = (noise(&mut random) * spread, noise(&mut random) * spread);
        [ha, dec, (h + across / d.cos()).to_degrees(), (d + along).to_degrees()]
    };
    (0..rows).map(of_row).collect()
}

fn study(head: &str, joint: &str, shown: &str) -> String {
    format!(
        "chain = 'mount.chain'\ndata = 'data.csv'\n{head}[columns]\nha = {{ column = '{joint}', unit = 'deg' }}\n\
         dec = {{ column = 'dec', unit = 'deg' }}\n[observed]\nkind = 'spherical'\n\
         ha = {{ column = '{shown}', unit = 'deg' }}\ndec = {{ column = 'td', unit = 'deg' }}\n"
    )
}

#[test]
fn right_ascensions_beside_a_sidereal_time_are_told() {
    let mut text = "ra,dec,tra,td,lst\n".to_owned();
    for (row, [ha, dec, tha, td]) in seen(8101, 80, 0.0).into_iter().enumerate() {
        let lst_hours = (20.0 + 6.0 * row as f64 / 80.0).rem_euclid(24.0);
        let [ra, tra] = [ha, tha].map(|angle| (15.0 * lst_hours - angle).rem_euclid(360.0));
        text += &format!("{ra:.7},{dec:.7},{tra:.7},{td:.7},{lst_hours:.7}\n");
    }
    let made = calibrated(POLAR, &study("", "ra", "tra"), &text);
    let told = misread(&made);
    let expected =
        Reading::RightAscension { columns: vec!["ra".into(), "tra".into()], sidereal: "lst".into() };
    assert_eq!(told.readings[0].reading, expected, "{told:?}");
    // With the hour angles in the file nothing is misread, whatever stands beside them.
    let rows = seen(8101, 80, 0.0).into_iter().enumerate();
    let right: String =
        rows.map(|(at, [ha, dec, tha, td])| format!("{ha},{dec},{tha},{td},{}\n", at % 24)).collect();
    let made = calibrated(POLAR, &study("", "ha", "tha"), &format!("ha,dec,tha,td,lst\n{right}"));
    assert!(made.diagnosis.verdict.is_usable(), "{:?}", made.diagnosis.cautions);
}

#[test]
fn a_zero_of_whole_hours_is_said_to_be_a_clock_or_a_zero() {
    for (zero_deg, hours) in [(30.0, Some(2)), (-15.0, Some(1)), (22.0, None)] {
        let data = table("ha,dec,tha,td", &seen(8102, 80, zero_deg));
        let made = calibrated(POLAR, &study("", "ha", "tha"), &data);
        let told = made.diagnosis.cautions.iter().find_map(|caution| match caution {
            Caution::ByTheClock(own) => Some(own.hours),
            _ => None,
        });
        assert_eq!(told, hours, "{zero_deg}: {:?}", made.diagnosis.cautions);
    }
}
