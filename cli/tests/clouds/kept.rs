//! Every version and format: coordinates as NumPy has them, bounds that hold them, and every other byte as it came.

use crate::whole::{Whole, bounds, coordinates};
use crate::{applied, assert_steps, bytes, folder, steps};

const CLOUDS: [&str; 8] = ["v12f1", "v12f3", "v13f4", "v14f0", "v14f6", "v14f8", "v14f10", "none"];

#[test]
fn coordinates_are_corrected_and_every_other_byte_stays() {
    for name in CLOUDS {
        let (plain, packed) = (format!("{name}.las"), format!("{name}.laz"));
        let folder = folder(&format!("cloud_kept_{name}"), &[&plain, &packed]);
        let expected = steps(name);
        for given in [plain.as_str(), &packed] {
            let before = Whole::of(&bytes(given));
            let given_steps = before.steps();
            let moved = given_steps.iter().zip(&expected).filter(|(before, expected)| {
                (0..3).any(|axis| (f64::from(before[axis]) - expected[axis]).abs() > 1.5)
            });
            assert_eq!(moved.count(), expected.len(), "{name}: the errors move every point");
            for out in ["out.las", "out.laz"] {
                let file = applied(&folder, given, out, &[]);
                let after = Whole::of(&file);
                assert_steps(name, &after.steps(), &expected);
                assert_eq!(
                    after.clone().without_coordinates(),
                    before.clone().without_coordinates(),
                    "{given} {out}"
                );
                if expected.is_empty() {
                    assert_eq!(bounds(&file), bounds(&bytes(given)), "{given} {out}");
                    continue;
                }
                let corrected = coordinates(&file, &after.steps());
                let reach = [0, 1, 2].map(|axis: usize| {
                    let all = || corrected.iter().map(|point| point[axis]);
                    [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
                });
                assert_eq!(bounds(&file), reach, "{given} {out}");
            }
        }
    }
}

/// What is not compressed differs in nothing else, wherever a byte stands.
#[test]
fn an_uncompressed_file_keeps_its_length_and_its_places() {
    for name in CLOUDS {
        let plain = format!("{name}.las");
        let folder = folder(&format!("cloud_places_{name}"), &[&plain]);
        let (before, after) = (bytes(&plain), applied(&folder, &plain, "out.las", &[]));
        let points_at = u32::from_le_bytes([before[96], before[97], before[98], before[99]]) as usize;
        let length = usize::from(u16::from_le_bytes([before[105], before[106]]));
        let points_end = points_at + steps(name).len() * length;
        let may_change = |at: usize| {
            (179..227).contains(&at)
                || (points_at..points_end).contains(&at) && (at - points_at) % length < 12
        };
        assert_eq!(before.len(), after.len(), "{name}");
        let changed = (0..before.len()).find(|&at| before[at] != after[at] && !may_change(at));
        assert_eq!(changed, None, "{name}");
    }
}

/// LASzip refuses wave packets of the older formats that say version 2.
#[test]
fn wave_packets_say_the_version_that_laszip_opens() {
    let folder = folder("cloud_wave_packets", &["v13f4.las"]);
    let file = applied(&folder, "v13f4.las", "out.laz", &[]);
    let name = b"laszip encoded";
    let at = file.windows(name.len()).position(|bytes| bytes == name).expect("LASzip's record");
    // Behind the name, the number and the length of the record, and a description, as the format has them.
    let record = &file[at + 16 + 2 + 2 + 32..];
    let count = usize::from(u16::from_le_bytes([record[32], record[33]]));
    let items: Vec<_> = record[34..].chunks_exact(6).take(count).map(|item| (item[0], item[4])).collect();
    assert_eq!(items[..3], [(6, 2), (7, 2), (9, 1)], "{items:?}");
}

/// Without errors nothing moves: through compression and back a file is the same, byte for byte.
#[test]
fn compressed_and_decompressed_a_file_is_what_it_was() {
    for name in CLOUDS {
        let plain = format!("{name}.las");
        let folder = folder(&format!("cloud_back_{name}"), &[&plain]);
        folder.write("errors.toml", "tilt = 0.0\n");
        applied(&folder, &plain, "packed.laz", &[]);
        let again = applied(&folder, "packed.laz", "again.laz", &[]);
        assert_eq!(again, std::fs::read(folder.0.join("packed.laz")).expect("written"), "{name}");
        let back = applied(&folder, "again.laz", "back.las", &[]);
        // How far its points reach is written anew, and laspy writes bounds of its own where there are none.
        assert_eq!(without_bounds(back), without_bounds(bytes(&plain)), "{name}");
    }
}

/// In version 1.3 waveforms stand behind the points, where one field of the header says; before it, nothing says what stands there.
#[test]
fn what_stands_behind_the_points_moves_with_them() {
    let (older, newer) = (bytes("v12f1.las"), bytes("v13f4.las"));
    let end = u64::try_from(newer.len()).expect("small").to_le_bytes();
    let mut newer = [&newer, &b"waveforms \x00\xff and more"[..]].concat();
    newer[227..235].copy_from_slice(&end);
    let older = [&older, &b"whatever"[..]].concat();
    let folder = folder("cloud_behind", &[]);
    folder.write("newer.las", &newer).write("older.las", &older);
    let before = Whole::of(&newer).without_coordinates();
    assert!(before.behind.starts_with(b"waveforms"));
    for (given, out) in [("newer.las", "same.las"), ("newer.las", "packed.laz")] {
        let after = Whole::of(&applied(&folder, given, out, &[]));
        assert_eq!(after.without_coordinates(), before, "{given} {out}");
    }
    folder.write("errors.toml", "tilt = 0.0\n");
    for (name, file) in [("newer", newer), ("older", older)] {
        applied(&folder, &format!("{name}.las"), "1.laz", &[]);
        applied(&folder, "1.laz", "2.laz", &[]);
        assert!(without_bounds(applied(&folder, "2.laz", "3.las", &[])) == without_bounds(file), "{name}");
    }
}

/// A file without how far its points reach.
fn without_bounds(mut file: Vec<u8>) -> Vec<u8> {
    file[179..227].fill(0);
    file
}
