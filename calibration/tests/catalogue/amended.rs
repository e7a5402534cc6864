//! Amendment keeps the user's text: whatever its layout, taking the inserted lines away gives it back, and what was added
//! means what was found.

use calibration::amend::{Addition, NewInput, Spot, amend};
use effects::candidate::Effect;
use model_core::{Chain, Role, print};
use proptest::prelude::*;

use crate::support::{Asked, example};

const CHAINS: &[(&str, &str)] = &[
    ("mobile-lidar/mobile-lidar.chain", "pointing"),
    ("alt-azimuth/alt-azimuth.chain", "sight"),
    ("equatorial/equatorial.chain", "sight"),
    ("turntable/turntable.chain", "pointing"),
];

/// The text with another layout: line ends that comments do not need become blanks, blank lines, comments or carriage
/// returns as well.
fn laid_out(text: &str, choices: &[u8]) -> String {
    let mut choices = choices.iter().cycle();
    let lines = text.lines().map(|line| {
        let needs_end = line.contains("//");
        let end = match choices.next() {
            Some(1) if !needs_end => " ",
            Some(2) => "\n\n",
            Some(3) if !needs_end => "   // a word\n",
            Some(4) => "\r\n",
            _ => "\n",
        };
        format!("{line}{end}")
    });
    lines.collect()
}

/// Every factor of every body, as printed.
fn factors(chain: &Chain) -> Vec<String> {
    let factors = chain.bodies.iter().flat_map(|body| body.factors.iter().map(move |f| (&body.name, f)));
    factors
        .map(|(body, f)| format!("{body} {:?} {:?} {}", f.role, f.axis, print::text(&f.amount, chain)))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn taking_the_inserted_lines_away_gives_the_text_back(
        which in 0..CHAINS.len(),
        choices in proptest::collection::vec(0_u8..5, 1..40),
        picks in proptest::collection::vec(any::<prop::sample::Index>(), 1..4),
        input in any::<bool>(),
    ) {
        let (path, observable) = CHAINS[which];
        let text = laid_out(&example(path), &choices);
        let asked = Asked::of(&text, observable, "direction", "");
        let mut catalogue = asked.catalogue();
        // A bending stands within a statement of the user's own: see below.
        catalogue.retain(|effect| effect.bends.is_none());
        let mut chain = asked.plan.chain.clone();
        let mut additions = Vec::new();
        for (number, pick) in picks.iter().enumerate() {
            let effect: &Effect = &catalogue[pick.index(catalogue.len())];
            let (with, errors) = effect.add_to(&chain).unwrap();
            chain = with;
            additions.extend(effect.texts(&chain, &errors).into_iter().map(|(spot, text)| Addition {
                spot,
                text,
                documentation: vec![format!("Found in the property test, effect {number}.")],
            }));
        }
        let inputs: Vec<NewInput> = input
            .then(|| NewInput {
                name: "humidity".to_owned(),
                meaning: None,
                documentation: "Found in the property test, input.".to_owned(),
            })
            .into_iter()
            .collect();
        let amended = amend(&text, &chain, &additions, &inputs).unwrap();

        let read = Chain::from_text(&amended)
            .unwrap_or_else(|mistakes| panic!("{}\n{amended}", mistakes.render("amended", &amended)));
        prop_assert_eq!(factors(&read), factors(&chain));
        prop_assert_eq!(read.find_symbol("humidity").is_some(), input);

        let mut left = amended;
        let statements = additions.iter().map(|addition| format!("{};", addition.text));
        for statement in statements.chain(inputs.iter().map(|_| "input humidity;".to_owned())) {
            let end = left.find(&statement).expect("the statement is there") + statement.len();
            let mark = left[..end].rfind("/// Found in the property test").expect("its line is there");
            let start = left[..mark].rfind('\n').expect("a new line");
            // A line that ends with CR LF was inserted with both.
            let start = if left[..start].ends_with('\r') { start - 1 } else { start };
            left.replace_range(start..end, "");
        }
        prop_assert_eq!(left, text);
    }
}

#[test]
fn in_a_body_without_a_motion_a_position_error_stands_before_a_motion_error() {
    let text = example("turntable/turntable.chain");
    let chain = Chain::from_text(&text).unwrap();
    let body = chain.observables[0].body;
    let addition = |role, text: &str| Addition {
        spot: Spot::Factor(body, role),
        text: text.to_owned(),
        documentation: Vec::new(),
    };
    // In the order in which they were found.
    let additions = [addition(Role::MotionError, "Ry(after)"), addition(Role::PositionError, "Ry(before)")];
    let amended = amend(&text, &chain, &additions, &[]).unwrap();
    let pointer: Vec<String> = factors(&Chain::from_text(&amended).unwrap())
        .into_iter()
        .filter(|factor| factor.starts_with("pointer"))
        .collect();
    assert_eq!(pointer[1..], ["pointer PositionError Y before", "pointer MotionError Y after"]);
}

#[test]
fn two_bendings_stand_in_one_observable_whatever_its_layout() {
    let text = example("refraction/equatorial.chain");
    for (from, to) in [
        ("of tube;", "of tube;"),
        ("of tube;", "of tube // the telescope\r\n    ;"),
        ("of tube;", "of tube, bent up by known*tan(zenith); input zenith: angle = between(sky, up);"),
    ] {
        let text = text.replace(from, to);
        let asked = Asked::of(&text, "sky", "direction", "");
        let bending: Vec<Effect> =
            asked.catalogue().into_iter().filter(|effect| effect.bends.is_some()).collect();
        assert_eq!(bending.len(), 2);
        let (mut chain, mut additions) = (asked.plan.chain.clone(), Vec::new());
        for effect in &bending {
            let (with, errors) = effect.add_to(&chain).unwrap();
            chain = with;
            additions.extend(effect.texts(&chain, &errors).into_iter().map(|(spot, text)| Addition {
                spot,
                text,
                documentation: vec!["Found in a test.".to_owned()],
            }));
        }
        let input = NewInput {
            name: "zenith".to_owned(),
            meaning: Some("angle = between(sky, up)".to_owned()),
            documentation: "The zenith distance.".to_owned(),
        };
        let inputs = if text.contains("input zenith") { Vec::new() } else { vec![input] };
        let amended = amend(&text, &chain, &additions, &inputs).unwrap();
        let read = Chain::from_text(&amended)
            .unwrap_or_else(|mistakes| panic!("{}\n{amended}", mistakes.render("amended", &amended)));
        let bent = |chain: &Chain| print::text(&chain.observables[0].bend.as_ref().unwrap().amount, chain);
        assert_eq!(bent(&read), bent(&chain));
        assert!(bent(&read).contains("refraction_cubed"), "{}", bent(&read));
    }
}
