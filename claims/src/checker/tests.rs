//! Verdicts and diagnoses on small formulas; the paper's own are in the suites of whole commands.

use super::*;
use crate::latex::PrintedSymbols;
use model_core::print::Style;

const LIDAR: &str = include_str!("../../../examples/mobile-lidar/mobile-lidar.chain");

/// Equation (6) as it should read for the tilts against the plumb line and the inner axis.
const RIGHT: [&str; 3] = [
    r"\Delta\theta_{y1}^0 \cos\beta + \Delta\theta_{x3}^2 \cos\beta \sin\alpha",
    r"-\Delta\theta_{x1}^0 \cos\beta - \Delta\theta_{x3}^2 \cos\alpha \cos\beta",
    r"-(\Delta\theta_{x1}^0 \cos\alpha + \Delta\theta_{y1}^0 \sin\alpha) \sin\beta - \Delta\theta_{x3}^2 \sin\beta",
];

fn chain() -> Chain {
    Chain::from_text(LIDAR).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn verdict(chain: &Chain, order: u32, components: &[&str]) -> FormVerdict {
    let printed = PrintedVector::read(chain, &PrintedSymbols::of_chain(chain), components)
        .unwrap_or_else(|mistakes| panic!("{mistakes:?}"));
    let mut kept: Vec<_> = ["dtheta_x1", "dtheta_y1", "dtheta_x3"]
        .iter()
        .flat_map(|name| errors_named(chain, name).unwrap_or_default())
        .collect();
    kept.sort_unstable();
    let observable = chain.find_observable("pointing").unwrap_or(ObservableId(0));
    let order = Order::UpTo(order);
    let claim = ClosedForm { observable, order, only: None, faces: None, kept, printed };
    Checker::new(chain).closed_form(&claim).unwrap_or_else(|error| panic!("{error}"))
}

/// Every difference in one line: component, error, printed, derived, the text at its place, the slip.
fn shown(chain: &Chain, verdict: &FormVerdict, components: &[&str]) -> Vec<String> {
    let mut lines: Vec<String> = verdict
        .differences
        .iter()
        .map(|difference| {
            let [printed, derived] =
                [&difference.printed, &difference.derived].map(|value| value.show(chain, Style::Text));
            let text = components[difference.component.index()];
            let place = difference.place.clone().map_or("nowhere", |place| &text[place]);
            let slip =
                difference.slip.as_ref().map(|slip| slip.describe(chain, ObservableId(0), Style::Text));
            format!(
                "{}, {}: {printed} | {derived} | {place} | {}",
                difference.component,
                difference.error_name(chain),
                slip.as_deref().unwrap_or("no diagnosis")
            )
        })
        .collect();
    lines.extend(verdict.slips.iter().map(|slip| slip.describe(chain, ObservableId(0))));
    lines
}

#[test]
fn a_right_formula_has_no_differences() {
    let chain = chain();
    assert_eq!(shown(&chain, &verdict(&chain, 1, &RIGHT), &RIGHT), Vec::<String>::new());
    let plain = [
        "dtheta_y1*cos(beta) + dtheta_x3*cos(beta)*sin(alpha)",
        "-dtheta_x1*cos(beta) - dtheta_x3*cos(alpha)*cos(beta)",
        "-(dtheta_x1*cos(alpha) + dtheta_y1*sin(alpha))*sin(beta) - dtheta_x3*sin(beta)",
    ];
    assert_eq!(shown(&chain, &verdict(&chain, 1, &plain), &plain), Vec::<String>::new());
}

/// One component of the right formula replaced, and what is said of it.
#[test]
fn usual_slips_are_named_with_their_place() {
    let cases: [(usize, &str, &[&str]); 9] = [
        (
            1,
            r"-\Delta\theta_{x1}^0 \cos \beta - \Delta\theta_{x3}^2 \cos\alpha \sin\beta",
            &[
                r"y, dtheta_x3: -cos(alpha)*sin(beta) | -cos(alpha)*cos(beta) | \sin\beta | sin(beta) for cos(beta)",
            ],
        ),
        (
            1,
            r"\Delta\theta_{x1}^0 \cos \beta - \Delta\theta_{x3}^2 \cos\alpha \cos\beta",
            &[r"y, dtheta_x1: cos(beta) | -cos(beta) | \Delta\theta_{x1}^0 \cos \beta | the sign is wrong"],
        ),
        (
            0,
            r"2\Delta\theta_{y1}^0 \cos\beta + \Delta\theta_{x3}^2 \cos\beta \sin\alpha",
            &[
                r"x, dtheta_y1: 2*cos(beta) | cos(beta) | 2\Delta\theta_{y1}^0 \cos\beta | a factor: the printed term is 2 times the derived one",
            ],
        ),
        (
            0,
            r"\Delta\theta_{y1}^0 \cos\beta",
            &[r"x, dtheta_x3: 0 | sin(alpha)*cos(beta) | nowhere | the term is missing"],
        ),
        (
            0,
            r"\Delta\theta_{y1}^0 \cos\beta + \Delta\theta_{x3}^2 \cos\beta",
            &[
                r"x, dtheta_x3: cos(beta) | sin(alpha)*cos(beta) | \Delta\theta_{x3}^2 \cos\beta | the factor sin(alpha) is missing",
            ],
        ),
        (
            0,
            r"\Delta\theta_{y1}^0 \cos\alpha\cos\beta + \Delta\theta_{x3}^2 \cos\beta \sin\alpha",
            &[
                r"x, dtheta_y1: cos(alpha)*cos(beta) | cos(beta) | \cos\alpha | the factor cos(alpha) is too much",
            ],
        ),
        (
            0,
            r"\Delta\theta_{y1}^0 \cos\alpha + \Delta\theta_{x3}^2 \cos\beta \sin\alpha",
            &[r"x, dtheta_y1: cos(alpha) | cos(beta) | \cos\alpha | cos(alpha) for cos(beta)"],
        ),
        (
            0,
            r"\Delta\theta_{y1}^0 \cos\beta + \Delta\theta_{x3}^2 \cos\beta \sin\alpha + \Delta\beta_2",
            &[r"x, db2: 1 | 0 | \Delta\beta_2 | the claim itself neglects this error"],
        ),
        (
            0,
            r"\Delta\theta_{y1}^0 \cos\beta + \Delta\theta_{x3}^2 \cos\beta \sin\alpha + \Delta\theta_{x3}^2 \Delta\theta_{y1}^0",
            &[
                r"x, dtheta_y1*dtheta_x3: 1 | 0 | \Delta\theta_{x3}^2 \Delta\theta_{y1}^0 | a product of more errors than the order of the form",
            ],
        ),
    ];
    let chain = chain();
    for (axis, text, expected) in cases {
        let mut components = RIGHT;
        components[axis] = text;
        assert_eq!(shown(&chain, &verdict(&chain, 1, &components), &components), expected, "{text}");
    }
}

#[test]
fn what_concerns_whole_components_is_said_once() {
    let chain = chain();
    let slips = |components: &[&str]| -> Vec<String> {
        verdict(&chain, 1, components)
            .slips
            .iter()
            .map(|slip| slip.describe(&chain, ObservableId(0)))
            .collect()
    };
    let [x, y, z] = RIGHT;
    assert_eq!(slips(&[y, x, z]), ["components x and y stand in each other's place"]);
    assert_eq!(slips(&[y, z, x]), ["the components are shifted round"]);
    let together = format!("{x} {y}");
    assert_eq!(slips(&[&together, z, "0"]), ["components x and y are run together in x"]);
    let negative = RIGHT.map(|component| format!("-({component})"));
    assert_eq!(
        slips(&negative.each_ref().map(String::as_str)),
        ["every sign is the other one: the error is counted the other way"]
    );
}

#[test]
fn a_wrong_order_and_a_missing_frame_are_recognised() {
    let chain = chain();
    let wrong = [
        // As if the inner axis's perpendicularity came before the turn of the middle frame.
        r"\Delta\theta_{y1}^0 + \Delta\theta_{x3}^2 \sin\alpha",
        r"-\Delta\theta_{x1}^0 - \Delta\theta_{x3}^2 \cos\alpha",
        "0",
    ];
    let said: Vec<String> =
        verdict(&chain, 1, &wrong).slips.iter().map(|slip| slip.describe(&chain, ObservableId(0))).collect();
    assert_eq!(said, ["a missing frame: this follows without Rx(beta) of middle"]);
}

#[test]
fn the_number_of_components_is_minded() {
    let chain = chain();
    let symbols = PrintedSymbols::of_chain(&chain);
    let refused = |texts: &[&str]| -> Vec<String> {
        match PrintedVector::read(&chain, &symbols, texts) {
            Ok(_) => Vec::new(),
            Err(mistakes) => mistakes.into_iter().map(|mistake| mistake.message).collect(),
        }
    };
    assert_eq!(refused(&["0", "0", "0", "0"]), Vec::<String>::new());
    assert_eq!(refused(&["[0, 0, 0, 0]^T"]), Vec::<String>::new());
    assert_eq!(refused(&["0", "0", "0", "1"]), ["the fourth component of an error is always 0"]);
    assert_eq!(refused(&["0", "0"]), ["2 components, where a vector has three"]);
    assert_eq!(refused(&[]), ["0 components, where a vector has three"]);
    assert_eq!(refused(&["[0, 0]"]), ["2 components, where a vector has three"]);
    assert_eq!(refused(&["dtheta_y", "0", "sin(dtheta_y1)"]).len(), 2);
}

#[test]
fn the_assertion_passes_what_is_right_and_says_what_is_wrong() {
    let chain = chain();
    let kept = ["dtheta_[", "dtheta_x1"];
    assert_closed_form(&chain, "pointing", 1, &["dtheta_x1", "dtheta_y1", "dtheta_x3"], RIGHT);
    let said = |observable: &str, kept: &[&str], components: [&str; 3]| {
        assert::closed_form(&chain, observable, 1, kept, &components).err().unwrap_or_default()
    };
    assert!(
        said("pointing", &["dtheta_x1"], ["0", "dtheta_x1*cos(beta)", "0"])
            .contains("y, dtheta_x1: printed cos(beta), derived -cos(beta)")
    );
    assert!(said("aim", &["dtheta_x1"], RIGHT).contains("no observable `aim`"));
    assert!(said("pointing", &kept, RIGHT).contains("no error `dtheta_[`"));
    assert!(said("pointing", &["*"], [r"\cos\bta", "0", "0"]).contains("at `\\bta`: unknown symbol"));
}

/// Print without a backslash or a brace is LaTeX where every word of it is a printed symbol, and nothing else is.
#[test]
fn printed_symbols_need_no_backslash() {
    let text = r#"chain C {
        body b on ground { position_error: Tx(shift*length), Ty(-index); motion: Rz(turn); }
        input length: length;
        observe o: point(0, 1, 0) of b;
        symbol shift = "x_2";
        symbol index = "x_3";
        symbol length = "R";
        symbol turn = "ab";
    }"#;
    let chain = Chain::from_text(text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let symbols = PrintedSymbols::of_chain(&chain);
    let read = |x: &str, y: &str| PrintedVector::read(&chain, &symbols, &[x, y, "0"]).is_ok();
    for (x, y) in [("R x_2", "-x_3"), ("x_2 R", "y = -x_3."), ("shift*length", "-index"), ("R x_2", "-index")]
    {
        assert!(read(x, y), "{x}, {y}");
    }
    // A typing slip is no product of letters.
    for x in ["Rx_2", "x_2R", "x_4", "R shift", "2 3", "R + shfit"] {
        assert!(!read(x, "-x_3"), "{x}");
    }
}
