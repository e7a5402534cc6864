//! What cannot be corrected is refused in words that say what is wrong, where, and what to do; and nothing is written.

use std::fs;

use crate::support::Folder;
use crate::whole::Whole;
use crate::{applied, apply, bytes, folder, refused, steps};

/// A byte, or more, of a file put in another's place.
fn with(name: &str, at: usize, new: &[u8]) -> Vec<u8> {
    let mut file = bytes(name);
    file[at..at + new.len()].copy_from_slice(new);
    file
}

/// Where a text stands in a file.
fn find(file: &[u8], text: &[u8]) -> usize {
    file.windows(text.len()).position(|window| window == text).expect("there")
}

/// The user and the number of the record that says how points are compressed.
fn laszip_head() -> [u8; 18] {
    let mut head = *b"laszip encoded\0\0\0\0";
    head[16..].copy_from_slice(&22204_u16.to_le_bytes());
    head
}

#[test]
fn a_file_that_is_spoiled_or_cut_off_is_told_as_such() {
    let folder = folder("cloud_spoiled_words", &[]);
    let (plain, packed) = (bytes("v14f6.las"), bytes("v14f6.laz"));
    let points_at = |file: &[u8]| u32::from_le_bytes(file[96..100].try_into().expect("four")) as usize;
    let (plain_at, packed_at) = (points_at(&plain), points_at(&packed));
    let length = usize::from(u16::from_le_bytes([plain[105], plain[106]]));
    let extra = find(&plain, b"LASF_Spec") - 2 + 54;
    let copc = find(&plain, b"somebody");
    // Four thousand million chunks of a file of five kilobytes.
    let claims = {
        let mut file = packed.clone();
        let table = u64::from_le_bytes(file[packed_at..packed_at + 8].try_into().expect("eight"));
        let table = usize::try_from(table).expect("small");
        let laszip = find(&packed, b"laszip encoded") - 2 + 54;
        file[laszip + 12..laszip + 16].fill(0xff);
        file[table + 4..table + 8].fill(0xff);
        file[247..255].copy_from_slice(&(1_u64 << 40).to_le_bytes());
        file
    };
    let stale = with("v14f6.las", copc, &laszip_head());
    // The record that says how points are compressed is one of those before the points.
    let mut late = with("v14f6.laz", find(&packed, b"laszip encoded"), b"x");
    let behind = late.len() - 9 * 18 - 60;
    late[behind + 2..behind + 20].copy_from_slice(&laszip_head());
    let items = find(&packed, b"laszip encoded") - 2 + 54 + 34;
    for (name, file, wanted) in [
        ("empty.las", Vec::new(), "it is no LAS file"),
        (
            "text.laz",
            b"azimuth,elevation,range\n1,2,3\n".to_vec(),
            "it is no LAS file: one begins with `LASF`",
        ),
        ("head.las", plain[..200].to_vec(), "ends after 200 bytes, within its header: it is cut off"),
        ("short.las", plain[..300].to_vec(), "ends after 300 bytes, within its header: it is cut off"),
        ("records.las", plain[..plain_at - 1].to_vec(), "points begin at byte"),
        (
            "middle.las",
            with("v12f1.las", 107, &81_u32.to_le_bytes()),
            "counts 81 points, and it ends after 80",
        ),
        (
            "cut.las",
            bytes("v12f1.las")[..bytes("v12f1.las").len() - 1].to_vec(),
            "ends after 79: it is cut off",
        ),
        ("behind.las", plain[..plain.len() - 1].to_vec(), "its extended record 1 goes beyond its end"),
        ("early.las", with("v14f6.las", 235, &((plain_at + length) as u64).to_le_bytes()), "extended rec"),
        (
            "cut.laz",
            bytes("v12f1.laz")[..bytes("v12f1.laz").len() / 2].to_vec(),
            "cut off, or was never finished",
        ),
        ("table.laz", with("v14f6.laz", packed_at, &[0xff; 8]), "cut off, or was never finished"),
        ("version.las", with("v14f6.las", 25, &[5]), "it is LAS 1.5, and LAS 1.0 to 1.4 are read"),
        ("format.las", with("v14f6.las", 104, &[11]), "format 11, and formats 0 to 10 are read"),
        ("long.las", with("v14f6.las", 105, &[9, 0]), "a point has 9 bytes, and one of format 6 has 30"),
        (
            "counts.las",
            with("v14f6.las", 107, &[1, 0, 0, 0]),
            "counts 80 points in one place and 1 in another",
        ),
        ("scale.las", with("v14f6.las", 131, &[0; 8]), "which must be positive"),
        ("offset.las", with("v14f6.las", 155, &f64::NAN.to_le_bytes()), "offsets of x, y and z"),
        (
            "other.laz",
            with("v14f6.laz", items, &[6]),
            "compressed as something else than format 6 with 17 extra bytes",
        ),
        ("record.las", with("v14f6.las", 104, &[0x86]), "no record says how"),
        ("claims.laz", claims, "the table of its chunks is spoiled: it has 4294967295 chunks"),
        ("stale.las", stale, "a record says how its points are compressed, and they are not"),
        ("late.laz", late, "no record says how"),
        ("type.las", with("v14f6.las", extra + 2, &[31]), "has a type 31"),
        ("more.las", with("v14f6.las", extra + 2, &[10]), "extra bytes of each point, and a point has"),
        ("copc.laz", with("v14f6.las", copc, b"copc\0\0\0\0\0\0\0\0\0\0\0\0\x01\0"), "it is a COPC file"),
    ] {
        folder.write(name, file);
        let said = refused(&folder, name, "out.laz", &[]);
        assert!(said.contains(wanted) && said.contains(name), "{name}: {wanted}: {said}");
    }
    folder.write("index.las", with("v14f6.las", copc, b"LAStools\0\0\0\0\0\0\0\0\x1e\0"));
    let run = apply(&folder, "index.las", "out.las", &[]);
    assert!(run.code == 0 && run.stderr.contains("index the new file again"), "{run}");
}

/// A dimension of `v12f1.las`, by the start of its name.
fn dimension(name: &str) -> usize {
    find(&bytes("v12f1.las"), name.as_bytes()) - 4
}

#[test]
fn readings_that_are_not_there_or_are_none_are_told() {
    let folder = folder("cloud_readings", &[]);
    let file = bytes("v12f1.las");
    let points_at = u32::from_le_bytes(file[96..100].try_into().expect("four")) as usize;
    let length = usize::from(u16::from_le_bytes([file[105], file[106]]));
    // Quality comes first, and a pair last: 28 + 1 + 8 + 8 + 8 + 4.
    assert_eq!(length, 57);
    let azimuth = points_at + 11 * length + 29;
    let (named, elevation) = (dimension("azimuth [rad]"), dimension("elevation"));
    let none = |value: f64| {
        let mut file = with("v12f1.las", named + 3, &[1]);
        file[named + 40..named + 48].copy_from_slice(&value.to_le_bytes());
        file[azimuth..azimuth + 8].copy_from_slice(&value.to_le_bytes());
        file
    };
    let untyped = {
        let mut file = with("v12f1.las", named + 2, &[0, 8]);
        file[named + 4..named + 11].copy_from_slice(b"azimuth");
        file
    };
    let listed = "its points have `intensity`, `gps_time`, `quality`, `azimuth [rad]`";
    for (name, file, wanted) in [
        (
            "nan",
            with("v12f1.las", azimuth, &f64::NAN.to_le_bytes()),
            "point 12: dimension `azimuth [rad]` is NaN",
        ),
        (
            "inf",
            with("v12f1.las", azimuth, &f64::INFINITY.to_le_bytes()),
            "point 12: dimension `azimuth [rad]` is inf",
        ),
        ("none", none(-9999.0), "point 12: dimension `azimuth [rad]` has no value there"),
        (
            "upper",
            with("v12f1.las", elevation + 4, b"E"),
            "no dimension `elevation`: did you mean `Elevation [rad]`?",
        ),
        ("other", with("v12f1.las", elevation + 4, b"tangential"), listed),
        ("unit", with("v12f1.las", named + 4, b"azimuth [rod]"), "`rod` is no unit: did you mean `rad`?"),
        ("length", with("v12f1.las", named + 4, b"azimuth [mm] "), "`mm` measures a length"),
        ("untyped", untyped, "`azimuth` cannot be read of dimension"),
        (
            "wrong",
            with("v12f1.las", named + 4, b"azimuth [deg]"),
            "another frame or unit, or these are not the readings",
        ),
        ("twice", with("v12f1.las", elevation + 4, b"azimuth\0\0"), "both `azimuth [rad]` and `azimuth"),
    ] {
        let name = format!("{name}.las");
        folder.write(&name, file);
        let said = refused(&folder, &name, "out.las", &[]);
        assert!(said.contains(wanted) && said.contains(&name), "{name}: {wanted}: {said}");
    }
    // Bytes that nothing describes are said to be there.
    let spec = find(&file, b"LASF_Spec");
    folder.write("silent.las", with("v12f1.las", spec, b"X"));
    let said = refused(&folder, "silent.las", "out.las", &[]);
    assert!(
        said.contains("its points have `intensity`, `gps_time`, and 29 bytes that no record describes"),
        "{said}"
    );
}

#[test]
fn coordinates_of_another_frame_or_already_corrected_ones_are_refused() {
    let folder = folder("cloud_frame", &["v12f1.las"]);
    let moved = |by: f64| {
        let offset = f64::from_le_bytes(bytes("v12f1.las")[155..163].try_into().expect("eight"));
        with("v12f1.las", 155, &(offset + by).to_le_bytes())
    };
    folder.write("frame.las", moved(4e5)).write("near.las", moved(0.004));
    let said = refused(&folder, "frame.las", "out.las", &[]);
    for wanted in [
        "frame.las: point 1: it is at (4000",
        "the chain without errors has it at",
        "400000.000 m away",
        "another frame",
    ] {
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
    let said = refused(&folder, "near.las", "out.las", &[]);
    assert!(
        said.contains("near.las: point 1: ") && said.contains(" mm away, more than rounding explains"),
        "{said}"
    );
    assert!(said.contains("Of the points 1 to 80, 80 are that far apart"), "{said}");
    let said = refused(&folder, "near.las", "out.las", &["--tolerance", "3 mm"]);
    assert!(said.contains("more than the 3.000 mm that were allowed"), "{said}");
    // What was allowed stays: points move by what the errors add.
    let near = applied(&folder, "near.las", "near.out.las", &["--tolerance", "6 mm"]);
    for (found, expected) in Whole::of(&near).steps().iter().zip(steps("v12f1")) {
        assert!(
            (0..3).all(|axis| (f64::from(found[axis]) - expected[axis]).abs() < 1.01),
            "{found:?} {expected:?}"
        );
    }
    // What comes out is corrected, and goes in no second time.
    applied(&folder, "v12f1.las", "once.las", &[]);
    let said = refused(&folder, "once.las", "twice.las", &[]);
    assert!(said.contains("the file is corrected already, with this model"), "{said}");
    // However much is allowed.
    let said = refused(&folder, "once.las", "twice.las", &["--tolerance", "10 cm"]);
    assert!(said.contains("it is corrected already"), "{said}");
}

#[test]
fn a_point_that_the_file_has_no_number_for_is_refused() {
    let folder = folder("cloud_overflow", &[]);
    let file = bytes("v12f1.las");
    let points_at = u32::from_le_bytes(file[96..100].try_into().expect("four")) as usize;
    let length = usize::from(u16::from_le_bytes([file[105], file[106]]));
    let expected = steps("v12f1");
    let step = |row: usize, axis: usize| {
        let at = points_at + row * length + 4 * axis;
        i32::from_le_bytes(file[at..at + 4].try_into().expect("four"))
    };
    // One point alone, with an offset so far away that it lies at the largest number that the file has, or at the smallest.
    for (end, moves) in [(i32::MAX, 1.0), (i32::MIN, -1.0)] {
        let moved = |(row, axis): &(usize, usize)| {
            (expected[*row][*axis] - f64::from(step(*row, *axis))) * moves > 1.5
        };
        let mut all = (0..80).flat_map(|row| (0..3).map(move |axis| (row, axis)));
        let (row, axis) = all.find(moved).expect("one moves so");
        let mut one = file[..points_at].to_vec();
        one.extend(&file[points_at + row * length..points_at + (row + 1) * length]);
        one[107..111].copy_from_slice(&1_u32.to_le_bytes());
        let (at, offset_at) = (points_at + 4 * axis, 155 + 8 * axis);
        one[at..at + 4].copy_from_slice(&end.to_le_bytes());
        let field = |at: usize| f64::from_le_bytes(file[at..at + 8].try_into().expect("eight"));
        let by = f64::from(end) - f64::from(step(row, axis));
        let offset = field(offset_at) - field(131 + 8 * axis) * by;
        one[offset_at..offset_at + 8].copy_from_slice(&offset.to_le_bytes());
        folder.write("far.las", &one);
        let said = refused(&folder, "far.las", "out.las", &[]);
        assert!(
            said.contains("far.las: point 1: it moves to (") && said.contains("has numbers for ("),
            "{said}"
        );
    }
}

/// Steps, offsets and counts as large or as small as numbers go: refused with a sentence, or read as they are.
#[test]
fn extreme_numbers_of_a_header_are_refused_or_read() {
    let folder = folder("cloud_extreme", &[]);
    let file = bytes("v12f1.las");
    let (scale, offset, count) = (131, 155, 107);
    for (at, number) in [
        (scale, 5e-324),
        (scale, 1e-300),
        (scale, 1e300),
        (scale, f64::MAX),
        (scale, f64::NAN),
        (scale, f64::INFINITY),
        (scale, -1e-3),
        (offset, 1e300),
        (offset, f64::MAX),
        (offset, f64::NEG_INFINITY),
        (scale + 16, f64::MAX),
        (offset + 16, -f64::MAX),
    ] {
        folder.write("extreme.las", with("v12f1.las", at, &number.to_le_bytes()));
        for out in ["out.las", "out.laz"] {
            let said = refused(&folder, "extreme.las", out, &["--tolerance", "1000 km"]);
            assert!(said.starts_with("error: extreme.las: "), "{number}: {said}");
        }
    }
    // More points than there are, up to more than any file has; fewer, and none.
    for (points, is_refused) in [(u32::MAX, true), (81, true), (79, false), (1, false), (0, false)] {
        folder.write("counted.las", with("v12f1.las", count, &points.to_le_bytes()));
        let run = apply(&folder, "counted.las", "out.las", &[]);
        assert_eq!(run.code == 2, is_refused, "{points}: {run}");
        if !is_refused {
            assert_eq!(
                fs::read(folder.0.join("out.las")).expect("written").len(),
                file.len(),
                "{points}: every byte stays"
            );
            fs::remove_file(folder.0.join("out.las")).expect("written");
        }
    }
    let mut many = bytes("v14f6.las");
    many[247..255].copy_from_slice(&u64::MAX.to_le_bytes());
    many[107..111].fill(0);
    folder.write("many.las", many);
    assert!(refused(&folder, "many.las", "out.las", &[]).contains("points, and it ends after"));
}

/// A cloud is never written over itself, by whatever name.
#[cfg(unix)]
#[test]
fn what_is_read_is_not_written_over() {
    let folder = folder("cloud_itself", &["v12f1.las"]);
    std::os::unix::fs::symlink("v12f1.las", folder.0.join("linked.las")).expect("a link");
    fs::hard_link(folder.0.join("v12f1.las"), folder.0.join("second.las")).expect("a second name");
    for (data, out) in [
        ("v12f1.las", "v12f1.las"),
        ("v12f1.las", "./v12f1.las"),
        ("v12f1.las", "linked.las"),
        ("linked.las", "v12f1.las"),
        ("v12f1.las", "second.las"),
    ] {
        let said = refused(&folder, data, out, &[]);
        assert!(said.contains("would be written over"), "{data} {out}: {said}");
    }
    assert_eq!(fs::read(folder.0.join("v12f1.las")).expect("there"), bytes("v12f1.las"));
}

#[test]
fn what_is_asked_of_a_cloud_and_cannot_be_is_told() {
    let folder = folder("cloud_asked", &["v12f1.las"]);
    let said = |data: &str, out: &str, more: &[&str]| refused(&folder, data, out, more);
    for (out, more, wanted) in [
        ("out.csv", &[][..], "a point cloud stays one: write a .las or .laz file"),
        ("-", &[], "a point cloud stays one"),
        ("out.las", &["--solve"], "--solve is for tables"),
        ("out.las", &["--correction"], "--correction is for tables"),
        ("out.las", &["--as", "ha-dec"], "--as is for tables"),
        ("out.las", &["--observable", "beam"], "`beam` is no point"),
        ("out.las", &["--observable", "taget"], "did you mean `target`?"),
        ("out.las", &["--tolerance", "2 deg"], "`deg` measures an angle"),
        ("out.las", &["--tolerance", "0 mm"], "above zero"),
        ("no/out.las", &[], "the folder it would lie in is not there"),
    ] {
        let words = said("v12f1.las", out, more);
        assert!(words.contains(wanted), "{out} {more:?}: {words}");
    }
    assert!(said("v12f2.las", "out.las", &[]).contains("did you mean `v12f1.las`?"));
    folder.write("table.csv", "azimuth,elevation,range\n1,1,10\n");
    assert!(said("table.csv", "out.laz", &[]).contains("out.laz: this is a point cloud"));
    assert!(
        said("table.csv", "out.csv", &["--tolerance", "1 mm"]).contains("--tolerance is for point clouds")
    );
    assert!(
        said("table.csv", "out.csv", &["--readings", "t.csv"]).contains("--readings is for point clouds")
    );
    fs::create_dir(folder.0.join("folder.las")).expect("a folder");
    assert!(said("folder.las", "out.las", &[]).contains("it is a folder"));
    let run = folder.trueaxis(&[
        "eval",
        "scanner.chain",
        "--errors",
        "errors.toml",
        "--data",
        "v12f1.las",
        "--out",
        "out.csv",
    ]);
    assert!(run.code == 2 && run.stderr.contains("which `trueaxis apply` corrects"), "{run}");
}

#[test]
fn which_point_the_coordinates_are_is_asked_where_there_are_several() {
    let folder = folder("cloud_which", &["v12f1.las"]);
    let chain = folder.read("scanner.chain");
    let lens = "    /// The lens.\n    observe lens: point(0, 0, 0) of mirror;\n}";
    let brace = chain.rfind('}').expect("a chain ends");
    folder.write("scanner.chain", format!("{}{lens}\n", &chain[..brace]));
    let said = refused(&folder, "v12f1.las", "out.las", &[]);
    assert!(said.contains("say which of `target`, `lens` the coordinates are: --observable NAME"), "{said}");
    applied(&folder, "v12f1.las", "out.las", &["--observable", "target"]);
    let line = chain.find("    /// What the beam meets.").expect("there");
    folder.write("scanner.chain", format!("{}}}\n", &chain[..line]));
    let said = refused(&folder, "v12f1.las", "out2.las", &[]);
    assert!(said.contains("chain Scanner shows no point"), "{said}");
    outside(&folder, &chain);
}

/// Rows outside of what the model was found over are counted, as those of a table are.
fn outside(folder: &Folder, chain: &str) {
    folder.write("scanner.chain", chain);
    let errors = folder.read("errors.toml");
    folder.write("errors.toml", format!("{errors}\n[found-over]\nelevation = [\"-40 deg\", \"10 deg\"]\n"));
    let run = apply(folder, "v12f1.las", "out3.las", &[]);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stderr.contains("of 80 rows are outside what the model was found over"), "{run}");
}
