//! Headers as nobody should write them, and places where something lies already.

use std::fs;

use crate::support::{Folder, Run};

const ROWS: &str = "10,20,0.163175911,0.925416578,0.342020143\n50,30,0.663413948,0.556670399,0.5\n\
                    120,40,0.663413948,-0.383022222,0.642787610\n200,50,-0.219846310,-0.604022774,0.766044443\n\
                    300,60,-0.433012702,0.25,0.866025404\n350,25,-0.157379,0.892539,0.422618262\n";

fn begin(name: &str, header: &str, arguments: &[&str]) -> (Folder, Run) {
    let folder = Folder::new(&format!("init-hostile-{name}"));
    folder.write("d.csv", format!("{header}\n{ROWS}"));
    let run = folder.trueaxis(&[&["init", "d.csv"], arguments].concat());
    (folder, run)
}

#[test]
fn names_that_are_no_names_are_mapped() {
    for (at, header) in [
        "azimuth [deg],elevation [deg],x,y,z",
        "\u{feff}Mount Az (°),Mount Alt (°),Star X,Star Y,Star Z",
        "\"az \"\"raw\"\" [degrees]\",\"el, raw [Deg]\",east,north,up",
        "fn az,body el,\"a\\b x\",\"a\\b y\",\"a\\b z\"",
        "# az_deg,az_deg,el_deg,x,y,z\naz_deg,el_deg,x,y,z",
        "az\u{2028}1 [deg],el [deg],e,n,u",
    ]
    .into_iter()
    .enumerate()
    {
        let (folder, run) = begin(&format!("names-{at}"), header, &[]);
        assert_eq!(run.code, 0, "{header}: {run}");
        assert_eq!(folder.names(), ["d.chain", "d.csv", "d.toml"]);
        let study = folder.read("d.toml");
        assert!(
            ["deg", "°"].iter().any(|unit| study.contains(&format!("unit = \"{unit}\""))),
            "{header}: {study}"
        );
        let run = folder.trueaxis(&["calibrate", "d.toml", "--format", "json"]);
        assert!(run.code < 2 && run.stdout.contains("\"verdict\""), "{header}: {run}");
    }
}

#[test]
fn what_cannot_be_begun_is_refused_with_words_and_nothing_is_written() {
    for (name, header, arguments, said) in [
        ("numbers", "1,2,3,4,5", &[][..], "no names of columns"),
        ("twice", "az,az,x,y,z", &[], "is there twice"),
        ("unknown", "a,b,c,d,e", &[], "--template alt-azimuth"),
        (
            "unit",
            "az [mil],el [deg],x,y,z",
            &[],
            "`az [mil]`: `mil` is an angle, of which a turn has 6400 or 6000, or a thousandth of an inch",
        ),
        ("length", "az [mm],el [deg],x,y,z", &[], "does not fit what it is"),
        ("no-truth", "az,el,p,q,r", &[], "nothing says where the instrument truly pointed"),
        ("two", "az_1,az_2,el,y,z", &["--template", "alt-azimuth"], "could each be meant"),
        ("missing", "az,tilt,x,y,z", &["--template", "alt-azimuth"], "no column for the elevation"),
        ("other", "az,el,x,y,z", &["--template", "arm"], "0 columns of joints"),
        ("misspelt", "az,el,x,y,z", &["--template", "alt-azimut"], "alt-azimuth"),
        ("itself", "az,el,x,y,z", &["--out", "m.chain"], "is where the chain goes"),
        ("nowhere", "az,el,x,y,z", &["--out", "no/m.toml"], "cannot write"),
    ] {
        let (folder, run) = begin(name, header, arguments);
        assert_eq!(run.code, 2, "{name}: {run}");
        assert!(run.stderr.contains(said), "{name}: {run}");
        assert_eq!(folder.names(), ["d.csv"], "{name}");
    }
}

#[test]
fn files_that_are_no_tables_are_refused() {
    let folder = Folder::new("init-hostile-files");
    folder
        .write("empty.csv", "")
        .write("header.csv", "az,el,x,y,z\n")
        .write("cell.csv", "az,el,x,y,z\n1,,0,1,0\n");
    for (file, said) in [
        ("empty.csv", "the file is empty"),
        ("header.csv", "no rows below the header"),
        ("cell.csv", "`el` has a cell that is no number in row 1"),
        ("missing.csv", "there is no such file"),
        (".", "it is a folder"),
        ("-", "name a file"),
    ] {
        let run = folder.trueaxis(&["init", file, "--template", "alt-azimuth"]);
        assert_eq!(run.code, 2, "{file}: {run}");
        assert!(run.stderr.contains(said), "{file}: {run}");
    }
    assert_eq!(folder.names(), ["cell.csv", "empty.csv", "header.csv"]);
}

#[test]
fn nothing_is_overwritten() {
    for there in ["d.chain", "d.toml"] {
        let folder = Folder::new(&format!("init-hostile-there-{there}"));
        folder.write("d.csv", format!("az [deg],el [deg],x,y,z\n{ROWS}")).write(there, "mine");
        let run = folder.trueaxis(&["init", "d.csv"]);
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains(&format!("`{there}` is there already")), "{run}");
        assert_eq!(folder.read(there), "mine");
        assert_eq!(folder.names().len(), 2, "{:?}", folder.names());
        // Under another name it goes, and the study finds its data.
        fs::create_dir(folder.0.join("sub")).expect("a folder");
        assert_eq!(folder.trueaxis(&["init", "d.csv", "--out", "sub/m.toml"]).code, 0);
        let study = folder.read("sub/m.toml");
        assert!(study.contains("\"m.chain\"") && study.contains("\"../d.csv\""), "{study}");
        assert!(folder.trueaxis(&["calibrate", "sub/m.toml"]).code < 2);
    }
}
