//! The language of readings: what is read back, and what is refused with words.

use super::READINGS;
use model_core::syntax::Declaration;
use model_core::{Chain, forms};

/// The chain with another statement for its first observable.
fn with(statement: &str) -> String {
    let first = READINGS.lines().find(|line| line.contains("observe sky")).unwrap();
    READINGS.replace(first, &format!("    {statement}"))
}

#[test]
fn a_declaration_is_printed_as_it_reads() {
    let declaration = Declaration::from_text(READINGS).unwrap();
    let printed = declaration.to_string();
    assert!(printed.contains(
        "observe other: azimuth(y, -x), elevation(-z), cross_elevation(x, -y) of direction(1, 0, 0) of tube;"
    ));
    assert!(printed.contains("observe away: range of point(0, lever, 0) of tube in table;"));
    assert_eq!(Chain::from_text(&printed).unwrap(), Chain::from_text(READINGS).unwrap());
}

#[test]
fn mistakes_say_what_to_write() {
    for (statement, message, help) in [
        (
            "observe sky: azimut of direction(1, 0, 0) of tube;",
            "unknown reading `azimut`",
            "did you mean `azimuth`?",
        ),
        (
            "observe sky: azimuth(x) of direction(1, 0, 0) of tube;",
            "`azimuth` takes two different axes",
            "`azimuth(x, y)`",
        ),
        (
            "observe sky: azimuth(x, -x) of direction(1, 0, 0) of tube;",
            "`azimuth` takes two different axes",
            "`azimuth(x, y)`",
        ),
        (
            "observe sky: azimuth(x, north) of direction(1, 0, 0) of tube;",
            "unknown axis `north`",
            "x, y, z, -x, -y, -z",
        ),
        (
            "observe sky: elevation(x, z) of direction(1, 0, 0) of tube;",
            "`elevation` takes one axis",
            "`elevation(z)`",
        ),
        ("observe sky: range(z) of point(1, 0, 0) of tube;", "`range` takes no axes", "write `range`"),
        (
            "observe sky: range of direction(1, 0, 0) of tube;",
            "a direction has no range",
            "`range of point(0, 0, 0) of body`",
        ),
        (
            "observe sky: azimuth, azimuth of direction(1, 0, 0) of tube;",
            "`azimuth` is read twice",
            "second observable",
        ),
        (
            "observe sky: x, y, z, range of point(1, 0, 0) of tube;",
            "at most three numbers",
            "second observable",
        ),
        (
            "observe sky: direction(1, 0, 0) of tube in tube;",
            "`tube` never moves in its own frame",
            "another body",
        ),
        (
            "observe sky: direction(1, 0, 0) of tube in tabel;",
            "unknown body `tabel`",
            "did you mean `table`?",
        ),
        ("observe sky: direction(1, 0, 0) of tube in;", "expected the name of a body", "leave it out"),
        (
            "observe sky: azimuth, of direction(1, 0, 0) of tube;",
            "expected `of`, found `direction`",
            "azimuth, elevation of direction(0, 0, 1) of body",
        ),
        ("observe sky: azimuth(x y) of direction(1, 0, 0) of tube;", "expected `,`", "azimuth(x, -y)"),
    ] {
        let Err(mistakes) = Chain::from_text(&with(statement)) else { panic!("{statement} is taken") };
        let said = mistakes.to_string();
        assert!(said.contains(message) && said.contains(help), "{statement}\n{said}");
    }
}

#[test]
fn what_has_no_closed_form_says_what_to_observe_instead() {
    let refusal = |statement: &str| {
        let chain = Chain::from_text(&with(statement)).unwrap();
        forms::derive(&chain, model_core::ObservableId(0), 1).unwrap_err().to_string()
    };
    let said = refusal("observe sky: off_axis of direction(1, 0, 0) of tube;");
    assert!(said.contains("no smooth function") && said.contains("`x, y, z of …`"), "{said}");
    // The line of sight stands on the axis that the azimuth turns about.
    let said = refusal("observe sky: azimuth(x, y) of direction(0, 0, 1) of table in pier;");
    assert!(said.contains("no smooth function"), "{said}");
    let said = refusal("observe sky: elevation of direction(1, 1, 0) of tube;");
    assert!(said.contains("whose square has no root") && said.contains("`x, y, z of …`"), "{said}");
}
