//! Study files as people write them, rightly and wrongly.
#![allow(clippy::unwrap_used)]

mod amended;
mod marks;

use model_core::Chain;
use observe::{Measure, Observations};
use study::Study;
use tables::formats::{DataError, Input};

const MOUNT: &str = include_str!("../../../examples/alt-azimuth/alt-azimuth.chain");

const STUDY: &str = r#"
chain = "mount.chain"
data  = "night.csv"

[columns]
azimuth   = { column = "az", unit = "deg" }
elevation = { column = "el [deg]" }
sense     = { derive = "direction(azimuth)" }
drift     = { derive = "elapsed(time)" }

[observed]
kind  = "offset"
cross = { column = "dx_arcsec" }
along = { column = "dy_arcsec" }

[noise]
sigma = "2 arcsec"
group = ["day"]
order = "time"

[fit]
estimate = ["*index", "collimation"]
fix      = { elevation_index = "1 arcmin" }

[search]
inputs = ["temperature"]
"#;

const NIGHT: &str = "\
az;el [deg];dx_arcsec;dy_arcsec;day;time;temperature
20;30;0;0;b;3;7,5
10;30;1;-2;a;1;8,5
30;30;0;0;b;4;7
15;30;0;0;a;2;8
";

/// The observations of a study, or what is wrong with it.
fn observations(study: &str, data: &'static str) -> Result<Observations, String> {
    let chain = Chain::from_text(MOUNT).unwrap();
    let study = Study::from_text(study).map_err(|mistakes| mistakes.to_string())?;
    let plan = study.plan(&chain).map_err(|mistakes| mistakes.to_string())?;
    let mut open = |_: &str| -> Result<Input<'static>, DataError> { Ok(data.as_bytes().into()) };
    plan.load(&mut open).map(|loaded| loaded.observations).map_err(|error| error.to_string())
}

#[test]
fn a_study_reads_its_data_in_order_and_in_si() {
    let chain = Chain::from_text(MOUNT).unwrap();
    let plan = Study::from_text(STUDY).unwrap().plan(&chain).unwrap();
    let name = |id: &model_core::SymbolId| plan.chain.symbol(*id).name.clone();
    assert_eq!(plan.fit.estimate.iter().map(name).collect::<Vec<_>>(), ["azimuth_index", "collimation"]);
    let fixed = chain.find_symbol("elevation_index").unwrap();
    assert!((plan.fit.start[fixed.index()] - 1.0 / 60.0 * std::f64::consts::PI / 180.0).abs() < 1e-15);

    let read = observations(STUDY, NIGHT).unwrap();
    assert_eq!(read.row_numbers.iter().collect::<Vec<_>>(), [2, 4, 1, 3]);
    assert_eq!(read.groups, [0, 0, 1, 1]);
    assert!(read.in_sequence);
    assert_eq!(read.poses.series[0].measure, Measure::Direction);
    let column = |name: &str| read.poses.column(plan.chain.find_symbol(name).unwrap()).unwrap();
    assert!((column("azimuth")[0] - 10f64.to_radians()).abs() < 1e-15);
    assert_eq!(column("temperature"), [8.5, 8.0, 7.5, 7.0]);
    assert_eq!(column("sense"), [0.0, 1.0, 1.0, 1.0]);
    assert_eq!(column("drift"), [0.0, 1.0, 2.0, 3.0]);
    // The first row in time: 1″ across, −2″ along, from azimuth 10° and elevation 30°.
    let arcsec = std::f64::consts::PI / 648_000.0;
    let (a, e) = (10f64.to_radians() + arcsec / 30f64.to_radians().cos(), 30f64.to_radians() - 2.0 * arcsec);
    let expected = [a.sin() * e.cos(), a.cos() * e.cos(), e.sin()];
    for (found, expected) in read.measured[0].vector().unwrap().iter().zip(expected) {
        assert!((found - expected).abs() < 1e-10, "{found} {expected}");
    }
}

#[test]
fn the_time_since_the_first_row_follows_dates_too() {
    const DATED: &str = "\
az;el [deg];dx_arcsec;dy_arcsec;day;time;temperature
20;30;0;0;b;2026-10-25T02:10:00+01:00;7,5
10;30;1;-2;a;2026-10-25T02:00:00+02:00;8,5
15;30;0;0;a;2026-10-25 02:00:30.5+02:00;8
";
    const NAMED: &str = "\
az;el [deg];dx_arcsec;dy_arcsec;day;time;temperature
20;30;0;0;b;IMG_2;7,5
10;30;1;-2;a;IMG_10;8,5
";
    let chain = Chain::from_text(MOUNT).unwrap();
    let implied = STUDY.replace("[search]", "[search]\nsequence = true").replace("drift ", "elapsed ");
    for (study, name) in [(STUDY, "drift"), (&implied, "elapsed")] {
        let plan = Study::from_text(study).unwrap().plan(&chain).unwrap();
        let id = plan.chain.find_symbol(name).unwrap();
        let read = observations(study, DATED).unwrap();
        assert_eq!(read.poses.column(id).unwrap(), [0.0, 30.5, 4200.0]);
        let refused = observations(study, NAMED).unwrap_err();
        assert_eq!(
            refused,
            "night.csv: line 2, row 1: column `time`: `IMG_2` says no time that an effect could follow (`sequence` under [search]): \
             write seconds, or points in time (2026-01-31T18:01:00), in every row, or leave `sequence` out"
        );
    }
}

#[test]
fn times_are_in_the_unit_that_the_header_says() {
    const HOURS: &str = "az;el [deg];dx_arcsec;dy_arcsec;day;time [h];temperature\n20;30;0;0;b;1,5;7,5\n10;30;1;-2;a;0,5;8,5\n";
    const DAYS: &str =
        "az;el [deg];dx_arcsec;dy_arcsec;day;time [MJD];temperature\n20;30;0;0;b;2;7,5\n10;30;1;-2;a;1;8,5\n";
    let of_rows = STUDY.replace("order = \"time\"\n", "");
    let elapsed = |study: &str, data| {
        let plan = Study::from_text(study).unwrap().plan(&Chain::from_text(MOUNT).unwrap()).unwrap();
        let drift = plan.chain.find_symbol("drift").unwrap();
        observations(study, data).map(|read| read.poses.column(drift).unwrap().to_vec())
    };
    assert_eq!(elapsed(STUDY, HOURS), Ok(vec![0.0, 3600.0]));
    assert_eq!(elapsed(&of_rows, HOURS), Ok(vec![0.0, -3600.0]));
    for study in [STUDY, &of_rows] {
        assert!(
            elapsed(study, DAYS)
                .is_err_and(|why| why.contains("`MJD` is no unit: the units of a time are s, ms"))
        );
    }
}

#[test]
fn mistakes_are_named_with_their_place_and_what_to_write() {
    let with = |from: &str, to: &str| {
        assert!(STUDY.contains(from), "{from}");
        observations(&STUDY.replace(from, to), NIGHT).map(|_| ())
    };
    insta::assert_debug_snapshot!([
        with("[observed]", "[observd]"),
        with("kind  = \"offset\"", "kind = \"ofset\""),
        with("kind  = \"offset\"", "kind = \"point\""),
        with("azimuth   = {", "azimut = {"),
        with("unit = \"deg\"", "unit = \"degr\""),
        with("column = \"az\", unit = \"deg\"", "column = \"az\""),
        with("column = \"az\", unit = \"deg\"", "column = \"azi\", unit = \"deg\""),
        with("column = \"dx_arcsec\"", "column = \"dx_arcsec\", unit = \"deg\""),
        with("direction(azimuth)", "velocity(azimuth)"),
        with("\"2 arcsec\"", "\"2 mm\""),
        with("\"2 arcsec\"", "\"-2 arcsec\""),
        with("\"collimation\"", "\"colimation\""),
        with("cross = {", "# cross = {"),
        with("data  = \"night.csv\"", "data = []"),
        with("column = \"dx_arcsec\"", "column = \"dx_arcsec\", meaning = \"side\""),
        with(
            "[observed]",
            "temperature = { column = \"temperature\", meaning = \"temprature\" }\n[observed]"
        ),
        with(
            "[observed]",
            "temperature = { column = \"temperature\", meaning = \"rate of nothing\" }\n[observed]"
        ),
        with("column = \"az\", unit = \"deg\"", "column = \"az\", unit = \"deg\", meaning = \"side\""),
    ]);
}

#[test]
fn bad_data_are_named_with_their_place() {
    let data = |data: &'static str| observations(STUDY, data).map(|_| ());
    insta::assert_debug_snapshot!([
        data(""),
        data("az;el [deg];dx_arcsec;dy_arcsec;day;time;temperature\n"),
        data("az;el [deg];dx_arcsec;dy_arcsec;day;time;temperature\n1;2;3;x;a;1;2\n"),
        data("az;el [deg];dx_arcsec;day;time;temperature\n1;2;3;a;1;2\n"),
    ]);
    let spherical = STUDY
        .replace("\"offset\"", "\"spherical\"")
        .replace("cross", "azimuth")
        .replace("along", "elevation")
        .replace("dy_arcsec", "time [deg]")
        .replace("order = \"time\"", "")
        .replace("drift     = { derive = \"elapsed(time)\" }", "");
    let beyond = "az;el [deg];dx_arcsec;time [deg];day;temperature\n1;2;3;100;a;2\n";
    insta::assert_debug_snapshot!(observations(&spherical, beyond).map(|_| ()));
}

proptest::proptest! {
    #[test]
    fn no_text_panics(text in "\\PC{0,80}") {
        let _ = observations(&text, NIGHT);
    }
}

/// What is wrong with a study, one line a mistake.
fn refused(study: &str) -> Vec<String> {
    let lines = observations(study, NIGHT).expect_err("refused");
    lines.lines().map(str::to_owned).collect()
}

#[test]
fn every_mistake_of_a_study_is_told_at_once() {
    let study = STUDY
        .replace("unit = \"deg\"", "unit = \"degz\"")
        .replace("direction(azimuth)", "directed(azimuth)")
        .replace("\"collimation\"]", "\"colimation\", \"nothing*\"]")
        .replace("\"1 arcmin\"", "\"1 mm\"")
        + "false_alarm = 2.0\nharmonics = 4294967296\n[hold_out]\nfolds = 0\n[next]\nposes = 1000000000\n";
    let told = refused(&study);
    for part in [
        "degz",
        "directed(azimuth)",
        "colimation",
        "nothing*",
        "false alarms",
        "4294967296",
        "folds",
        "poses",
    ] {
        assert!(told.iter().any(|line| line.contains(part)), "{part}: {told:#?}");
    }
    // A value of the wrong unit is one more, and the lines come in the order of the text.
    assert_eq!(told.len(), 9, "{told:#?}");
    let line = |text: &String| text.split(':').next().and_then(|line| line.parse::<usize>().ok());
    assert!(told.is_sorted_by_key(line), "{told:#?}");
}

#[test]
fn every_key_that_is_none_is_told_at_once() {
    let study = STUDY.replace("cross =", "corss =").replace("group =", "gruop =").replace("[fit]", "[fot]")
        + "sequence = \"yes\"\n";
    let told = refused(&study);
    for part in ["corss", "gruop", "fot", "write true or false"] {
        assert!(told.iter().any(|line| line.contains(part)), "{part}: {told:#?}");
    }
    assert_eq!(told.len(), 4, "nothing follows from a mistake that was told: {told:#?}");
    let broken = refused("chain = \nobservable = 'x\n");
    assert_eq!(broken.len(), 2, "{broken:#?}");
}

#[test]
fn a_study_of_more_sources_than_there_are_kinds_of_residual_is_refused() {
    let also = "[[also]]\ndata = \"more.csv\"\n[also.observed]\nkind = \"offset\"\ncross = { column = \"a\" }\nalong = { column = \"b\" }\n";
    let told = refused(&format!("{STUDY}\n{}", also.repeat(101)));
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].contains("at most 100 further sources"), "{told:?}");
}

#[test]
fn names_of_a_study_are_names_of_the_language() {
    for name in ["mirror-temp", "fn", "\"temp x\"", "\"x; motion: Rz(y)\"", "pi"] {
        let study = STUDY.replace("sense  ", name);
        let told = refused(&study);
        assert!(told.iter().any(|line| line.contains("an input")), "{name}: {told:#?}");
        let inputs = STUDY.replace(
            "[\"temperature\"]",
            &format!("[{}]", name.trim_matches('"').to_owned() + "\"").replacen('[', "[\"", 1),
        );
        assert!(!refused(&inputs).is_empty(), "{name}");
    }
    let effect = |name: &str| {
        format!(
            "{STUDY}[[effect]]\nname = \"{name}\"\nbody = \"tube\"\nmoves = \"Rx\"\nfunctions = [\"cos(azimuth)\"]\n"
        )
    };
    observations(&effect("fork flexure"), NIGHT).unwrap();
    for name in ["fork\\nflexure; */ }", "", "two\\u2028lines", "  ", &"x".repeat(300)] {
        let told = refused(&effect(name));
        assert!(told.iter().any(|line| line.contains("a few words on one line")), "{name}: {told:#?}");
    }
}

/// What derives a column, or declares the meaning of an input, and lets nothing use it, has most likely forgotten to.
#[test]
fn inputs_that_nothing_uses_are_remarked() {
    let remarked = |chain: &str, study: &str| -> Vec<String> {
        let plan = Study::from_text(study).unwrap().plan(&Chain::from_text(chain).unwrap()).unwrap();
        plan.unsought.iter().map(ToString::to_string).collect()
    };
    let told = remarked(MOUNT, STUDY);
    assert_eq!(told.len(), 2, "{told:#?}");
    assert!(
        told[0].contains("input drift (time)") && told[1].contains("input sense (direction)"),
        "{told:#?}"
    );
    assert!(told[1].contains("inputs = [\"sense\"] under [search]"), "{told:#?}");
    let named = STUDY.replace("[\"temperature\"]", "[\"temperature\", \"sense\", \"drift\"]");
    assert_eq!(remarked(MOUNT, &named), [""; 0]);
    // The declaration may use one itself.
    let creeps = MOUNT
        .replace("Rx(elevation_index)", "Rx(elevation_index), Rx(creep*drift)")
        .replace("symbol azimuth", "input drift: time;\n    symbol azimuth");
    let told = remarked(&creeps, STUDY);
    assert!(told.len() == 1 && told[0].contains("input sense"), "{told:#?}");
    // Whoever names the effects that may be found has said what is looked for.
    let only = STUDY.replace("[search]", "[search]\neffects = [\"encoder\"]");
    assert_eq!(remarked(MOUNT, &only), [""; 0]);
}

/// A drift is one of the time since the first row, which nothing says here.
#[test]
fn rows_in_sequence_without_a_time_are_remarked() {
    let remarked = |search: &str, order: &str| {
        let study =
            STUDY.replace("order = \"time\"\n", order).replace("[search]", &format!("[search]\n{search}"));
        Study::from_text(&study).unwrap().plan(&Chain::from_text(MOUNT).unwrap()).unwrap().timeless.is_some()
    };
    assert!(remarked("sequence = true", ""));
    assert!(!remarked("", ""));
    assert!(!remarked("sequence = true", "order = \"time\"\n"));
}

#[test]
fn a_search_that_would_not_fit_into_the_memory_is_refused_before_it_begins() {
    let asked = |text: &str, search: &str, folds: &str| {
        let study = format!("{text}\n{STUDY}").replace("[search]", &format!("[search]\n{search}"));
        observations(&format!("{study}\n[hold_out]\n{folds}\n"), NIGHT).map(|_| ())
    };
    assert_eq!(asked("", "", "folds = 10"), Ok(()));
    for (text, search, folds) in [
        ("", "harmonics = 400", "folds = 1000"),
        ("memory = \"16 MiB\"", "harmonics = 60", "folds = 10"),
        ("memory = \"16 MiB\"", "", "folds = 1000"),
    ] {
        let why = asked(text, search, folds).expect_err("too much");
        assert!(why.contains("MiB are allowed") && why.contains("write memory = "), "{why}");
    }
    assert_eq!(asked("memory = \"128 GiB\"", "harmonics = 400", "folds = 1000"), Ok(()));
    let why = asked("", "harmonics = 1000", "folds = 10").expect_err("beyond all");
    assert!(why.contains("harmonics cannot be 1000; write a number from 0 to 400"), "{why}");
}

#[test]
fn bare_numbers_that_are_hardly_in_si_are_doubted() {
    let chain = Chain::from_text(MOUNT).unwrap();
    let doubts = |from: &str, to: &str| -> Vec<String> {
        let study = STUDY.replace(from, to) + "\n[next]\nposes = 3\nrange = { elevation = [0.2, 1.2] }\n";
        let plan = Study::from_text(&study).unwrap().plan(&chain).unwrap();
        plan.doubts.iter().map(ToString::to_string).collect()
    };
    assert_eq!(doubts("", ""), Vec::<String>::new());
    let said = "sigma = 2 has no unit and is taken as 2 rad; did you mean sigma = \"2 arcsec\"?";
    for written in ["sigma = 2", "sigma = 2.0", "sigma = \"2\""] {
        assert_eq!(doubts("sigma = \"2 arcsec\"", written), [said]);
    }
    assert_eq!(doubts("sigma = \"2 arcsec\"", "sigma = 1e-5"), Vec::<String>::new());
    assert_eq!(
        doubts("elevation_index = \"1 arcmin\"", "elevation_index = 60"),
        [
            "elevation_index = 60 has no unit and is taken as 60 rad; did you mean elevation_index = \"60 arcsec\"?"
        ]
    );
}

#[test]
fn rows_know_their_lines_and_their_names() {
    let read = observations(&format!("id = \"day\"\n{STUDY}"), NIGHT).unwrap();
    let place = |row: usize| (read.origins.of(row).line, read.origins.of(row).name);
    // In the order of time: the second row of the file comes first.
    assert_eq!(
        (0..4).map(place).collect::<Vec<_>>(),
        [(Some(3), Some("a")), (Some(5), Some("a")), (Some(2), Some("b")), (Some(4), Some("b"))]
    );
    let of_some = read.origins.select(&[3, 0]);
    assert_eq!((of_some.of(0).line, of_some.of(1).line), (Some(4), Some(3)));
    assert!(
        observations(&format!("id = \"star\"\n{STUDY}"), NIGHT)
            .is_err_and(|why| why.contains("no column `star`"))
    );
}
