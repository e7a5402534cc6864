//! The user's own effects in a study, and what is said where they cannot be.

use model_core::{Chain, Mistakes, Role};
use study::Study;

use crate::support::{Asked, SCANNER};

const EFFECT: &str = "
[[effect]]
name      = \"ball screw of elevation\"
body      = \"telescope\"
part      = \"motion_error\"
moves     = \"Rx\"
functions = [\"cos(12*elevation)\", \"temperature*sin(12*elevation)\"]

[search]
inputs = [\"temperature\"]
";

fn study(effect: &str) -> (String, Result<(), Mistakes>) {
    let text = format!(
        "chain = \"c\"\nobservable = \"target\"\ndata = \"d\"\n[observed]\nkind = \"point\"\n{effect}"
    );
    let chain = Chain::from_text(SCANNER).unwrap();
    let refused = Study::from_text(&text).and_then(|study| study.plan(&chain).map(|_| ()));
    (text, refused)
}

#[test]
fn an_own_effect_comes_first_and_is_written_like_any_other() {
    let asked = Asked::of(SCANNER, "target", "point", EFFECT);
    let effect = &asked.catalogue()[0];
    assert_eq!((effect.name.as_str(), effect.family), ("ball screw of elevation", "own"));
    assert_eq!(effect.place.role, Role::MotionError);
    assert_eq!(effect.driver, "elevation, temperature");
    let (chain, errors) = effect.add_to(&asked.plan.chain).unwrap();
    assert_eq!(
        effect.text(&chain, &errors),
        "Rx(ball_screw_of_elevation_1*cos(12*elevation) + temperature*ball_screw_of_elevation_2*sin(12*elevation))"
    );
}

/// What is said, and of which part of the study.
fn refused(from: &str, to: &str) -> (String, String, String) {
    assert!(EFFECT.contains(from), "{from}");
    let (text, refused) = study(&EFFECT.replacen(from, to, 1));
    let mistakes = refused.expect_err("refused");
    let mistake = mistakes.iter().next().expect("one at least").clone();
    (text[mistake.place.bytes].to_owned(), mistake.message, mistake.help.unwrap_or_default())
}

#[test]
fn mistakes_are_told_at_their_place() {
    let said: Vec<String> = [
        ("\"telescope\"", "\"telescop\""),
        ("\"motion_error\"", "\"motion\""),
        ("\"Rx\"", "\"Rq\""),
        ("cos(12*elevation)", "cos(12*elevatoin)"),
        ("cos(12*elevation)", "cos(12*elevation"),
        ("cos(12*elevation)", "cos(12*elevation) + range"),
        ("cos(12*elevation)", "elevation_index*elevation"),
        ("cos(12*elevation)", "cos(range)"),
        ("cos(12*elevation)", "1/(1 + cos(elevation))"),
        ("cos(12*elevation)", "elevation - elevation"),
        ("moves     = \"Rx\"", ""),
        ("[\"cos(12*elevation)\", \"temperature*sin(12*elevation)\"]", "[]"),
        ("[search]\n", "[search]\neffects = [\"encodr\"]\n"),
        ("[search]\n", "[search]\nlines = { azimut = 3600 }\n"),
        ("[search]\n", "[search]\nlines = { azimuth = 0 }\n"),
    ]
    .into_iter()
    .map(|(from, to)| {
        let (place, message, help) = refused(from, to);
        format!("{to}\n  at: {}\n  {message}\n  help: {help}", place.replace('\n', " "))
    })
    .collect();
    insta::assert_snapshot!(said.join("\n"));
}
