//! Every version of the file that was ever written is read: a sample of each is kept.

use crate::packed;
use crate::support::{Folder, root};

/// The samples: never written again.
const SAMPLES: [&str; 1] = ["version-1.toml"];

#[test]
fn a_sample_of_each_version_is_read() {
    for sample in SAMPLES {
        let folder = Folder::new(&format!("kept-{sample}"));
        folder.copy(&format!("cli/tests/instrument/{sample}"));
        folder.write("new.csv", format!("Az,zenith,pier\n-100,{},1\n", packed(60.0)));
        let run = folder.trueaxis(&["apply", sample, "--data", "new.csv", "--correction", "--out", "-"]);
        assert_eq!(run.code, 0, "{sample}: {run}");
        // It was valid until a day that is over.
        assert!(run.stderr.contains("was valid until 2020-02-29"), "{sample}: {run}");
        let (header, row) = run.stdout.trim_end().split_once('\n').expect("a row");
        assert_eq!(
            header,
            "Az,zenith,pier,true az (deg),true el,true az_correction [arcsec],true el_correction [arcsec]"
        );
        let cells: Vec<f64> = row.split(',').map(|cell| cell.parse().expect("a number")).collect();
        // An index of 40″ was planted.
        assert!((cells[3] + 90.0).abs() < 1e-4 && (cells[4] - 30.0040).abs() < 1e-5, "{cells:?}");
        assert!((cells[6] - 40.0).abs() < 0.05, "{cells:?}");
        for command in [vec!["identify", sample], vec!["bound", sample], vec!["budget", sample]] {
            let run = folder.trueaxis(&command);
            assert_eq!(run.code, 0, "{run}");
        }
    }
}

/// The version that this program writes has a sample.
#[test]
fn the_version_that_is_written_has_a_sample() {
    let written = format!("version-{}.toml", service::instrument::VERSION);
    assert!(
        SAMPLES.contains(&written.as_str()) && root().join("cli/tests/instrument").join(&written).is_file()
    );
}
