//! What cannot be placed is named, with what to add.

use model_core::Chain;
use study::Study;

use super::{read, text_of};

fn targets(change: impl Fn(&str) -> Option<String>) -> String {
    text_of("examples/objects/targets.csv").lines().filter_map(change).map(|line| line + "\n").collect()
}

fn refused(study: &str, data: &str) -> String {
    let error = read(&text_of("examples/objects/scanner.chain"), study, data).unwrap_err();
    error.to_string()
}

/// Station C shares two targets with the others.
#[test]
fn a_station_that_nothing_connects_is_named() {
    let data = targets(|line| {
        let shared = ["C,T1,", "C,T2,"].iter().any(|start| line.starts_with(start));
        let own = line.strip_prefix("C,").filter(|_| !shared).map(|rest| format!("C,own {rest}"));
        Some(own.unwrap_or_else(|| line.to_owned()))
    });
    let told = refused(&text_of("examples/objects/targets.toml"), &data);
    assert!(
        told.contains("station `C`")
            && told.contains("shares 2 of the targets")
            && told.contains("`A`, `B`, `C`, `D` stood, all in one frame")
            && told.contains("rough = true"),
        "{told}"
    );
}

#[test]
fn a_plane_of_two_rows_is_named_and_left_out() {
    let mut seen = 0;
    let data: String = text_of("examples/objects/walls.csv")
        .lines()
        .filter(|line| {
            let east = line.split(',').nth(1) == Some("east");
            seen += usize::from(east);
            !east || seen <= 2
        })
        .map(|line| format!("{line}\n"))
        .collect();
    let (chain, study) = (text_of("examples/objects/scanner.chain"), text_of("examples/objects/walls.toml"));
    let loaded = read(&chain, &study, &data).unwrap().1;
    let told = loaded.remarks[0].to_string();
    assert!(told.contains("the 2 rows of `east`") && told.contains("three places"), "{told}");
    let unknowns = loaded.observations.unknowns.as_ref().unwrap();
    assert!(unknowns.objects.iter().all(|object| object.label != "east"));
    assert_eq!(loaded.observations.rows() + 3, data.lines().count());
    // Whose the other rows are has not changed.
    let labels =
        data.lines().skip(1).filter_map(|line| line.split(',').nth(1)).filter(|label| *label != "east");
    let kept = (0..loaded.observations.rows()).map(|row| unknowns.labels(row)[1].unwrap());
    assert!(labels.eq(kept));
}

#[test]
fn a_place_that_no_row_names_is_told() {
    let study = text_of("examples/objects/targets.toml")
        + "\n[stations]\nE = { x = \"1 m\", y = 0, z = 0, heading = 0 }\n";
    let told = refused(&study, &text_of("examples/objects/targets.csv"));
    assert!(told.contains("`E`") && told.contains("no row"), "{told}");
}

/// What a study cannot mean, each with the word that helps.
#[test]
fn studies_that_cannot_be_meant_are_refused() {
    let good = text_of("examples/objects/targets.toml");
    let chain = Chain::from_text(&text_of("examples/objects/scanner.chain")).unwrap();
    let cases = [
        (good.replace("object  = \"object\"\n", ""), "which object"),
        (good.replace("kind    = \"target\"", "kind    = \"point\""), "known row by row"),
        (good.replace("kind    = \"target\"", "kind    = \"offset\""), "is a point"),
        (
            good.replace("kind    = \"target\"", "kind    = \"sphere\"")
                .replace("[observed]", "[observed]\nlength = \"d\""),
            "`length` is no column of this kind",
        ),
        (good.replace("kind    = \"target\"", "kind    = \"wire\""), "no column is named for `length`"),
        (good.clone() + "[hold_out]\nfile = \"more.csv\"\n", "objects of its own"),
        (
            good.clone() + "[stations]\nA = { x = \"1 m\", rough = true, sigma = \"1 mm\" }\n",
            "has no uncertainty",
        ),
        (
            good.clone() + "[objects]\nT1 = { x = \"1 m\", y = \"0 m\", z = \"0 m\", sigma = \"0 mm\" }\n",
            "is positive",
        ),
        (
            good.clone() + "[stations]\nA = { x = \"1 m\", heading = 0.797, rough = true }\n",
            "write heading = \"0.797 deg\", \"0.797 gon\" or \"0.797 rad\"",
        ),
        (good.clone() + "[stations]\nA = { y = 4.2, rough = true }\n", "write y = \"4.2 m\" or \"4.2 mm\""),
        (
            good.clone()
                + "[stations]\nA = { x = 0, y = 0, z = 0, heading = 0, sigma = \"2 mm\", sigma_angle = 20 }\n",
            "`sigma_angle` is 20 without a unit",
        ),
        (good.clone() + "[objects]\nT1 = { x = 7.231, y = 0, z = 0 }\n", "`x` is 7.231 without a unit"),
        (good.clone() + "[next]\nplace = { heading = [-90, 90] }\n", "`heading` is -90 without a unit"),
        (good.clone() + "[fit]\ntolerance = { trunnion = \"-1 mrad\" }\n", "tolerance is positive"),
        (
            good.clone() + "[next]\nobjects = { plane = 1 }\n",
            "no kind of object of this study is called `plane`",
        ),
        (good.clone() + "[next]\nobjects = { wal = 1 }\n", "there are `target`"),
        (good.clone() + "[next]\nstations = 100\n", "write a number from 0 to 20"),
        (good.clone() + "[next]\nwalls = 1\n", "unknown key `walls`"),
        (good.clone() + "[next]\nplace = { x = [\"3 m\", \"1 m\"] }\n", "ends before it starts"),
        (good.clone() + "[next]\nplace = { w = [\"3 m\", \"4 m\"] }\n", "no coordinate of a place"),
        (
            good.clone() + "[next]\nrange = { axes_apart = [\"3 m\", \"4 m\"] }\n",
            "no joint or range is called",
        ),
        (
            good.replace("station = \"station\"\n", "") + "[next]\nstations = 1\n",
            "no row of this study names a station",
        ),
        (
            good.clone() + "[fit]\ntolerance = { trunion = \"1 mrad\" }\n",
            "no error or constant is called `trunion`",
        ),
    ];
    // Zero would be as exact as what is named beside it.
    for partly in ["x = 0, y = 0, z = 0", "roll = 0, pitch = 0", "heading = 0, sigma = \"1 mm\""] {
        let mistakes = Study::from_text(&format!("{good}[stations]\nA = {{ {partly} }}\n"))
            .and_then(|study| study.plan(&chain))
            .expect_err(partly);
        assert!(mistakes.to_string().contains("would count as zero"), "{partly}: {mistakes}");
    }
    // Zero is zero in every unit.
    let bare = good.clone() + "[stations]\nA = { x = 0, heading = 0.0, rough = true }\n";
    assert!(Study::from_text(&bare).and_then(|study| study.plan(&chain)).is_ok());
    for (study, expected) in cases {
        let mistakes = match Study::from_text(&study).and_then(|study| study.plan(&chain)) {
            Err(mistakes) => mistakes.render("study", &study),
            Ok(_) => panic!("{study}"),
        };
        assert!(mistakes.contains(expected), "{expected}: {mistakes}");
    }
}
