//! Bytes that nobody wrote: no panic, no message of one, and no more memory than a file is worth.

use crate::{apply, bytes, folder};

#[test]
fn spoiled_bytes_are_no_panic() {
    for name in ["v12f1.laz", "v14f6.laz", "v14f6.las"] {
        let folder = folder(&format!("cloud_fuzz_{name}"), &[]);
        let good = bytes(name);
        let points_at = u32::from_le_bytes(good[96..100].try_into().expect("four")) as usize;
        // Every part of the header and of the records' heads, and some of the points.
        let places = (24..375)
            .step_by(5)
            .chain((375..points_at).step_by(37))
            .chain((points_at..good.len()).step_by(61));
        for (turn, at) in places.enumerate() {
            let mut file = good.clone();
            let last = at + 1 + 3 * (turn % 2);
            for byte in file.iter_mut().take(last).skip(at) {
                *byte = [0xff, 0x00, 0x80, *byte ^ 0x5a][turn % 4];
            }
            folder.write(name, file);
            let run = apply(&folder, name, "out.laz", &[]);
            assert!(run.code == 0 || run.code == 2, "byte {at}: {run}");
            assert!(!run.stderr.contains("panicked"), "byte {at}: {run}");
            if run.code == 2 {
                assert!(
                    run.stderr.starts_with("error: ") && !folder.names().contains(&"out.laz".to_owned()),
                    "{run}"
                );
            } else {
                std::fs::remove_file(folder.0.join("out.laz")).expect("written");
            }
        }
        for end in (0..good.len()).step_by(good.len() / 40) {
            folder.write(name, &good[..end]);
            let run = apply(&folder, name, "out.laz", &[]);
            assert_eq!(run.code, 2, "{end} bytes: {run}");
            assert!(
                run.stderr.starts_with("error: ") && !run.stderr.contains("panicked"),
                "{end} bytes: {run}"
            );
        }
    }
}
