//! Errors of slides that vary with travel. The data are those of `examples/slides/simulate.py`, which shares no code with ours.

use crate::data::load;

/// The names of the effects that were found, and the RMS of held-out rows before and after, in µm.
fn found(study: &str) -> (Vec<String>, [f64; 2]) {
    let found = load(study).unwrap().calibrate();
    let rms =
        [&found.diagnosis.before, &found.diagnosis.after].map(|rms| rms.held_out_rms_kept.unwrap() * 1e6);
    let names = found.diagnosis.effects.iter().map(|effect| effect.names[0].clone()).collect();
    println!("{study}: {names:?}, held out {rms:?} µm");
    (names, rms)
}

#[test]
fn guides_that_bend_are_named_by_slide_and_shape() {
    let (mut names, [before, after]) = found("examples/slides/plate.toml");
    names.sort();
    assert_eq!(
        names,
        [
            "positioning of y, cubic",
            "roll of x, in proportion to travel",
            "straightness of x along y, quadratic",
            "tilt of z about x, quadratic"
        ]
    );
    // Three coordinates of 0.3 µm each.
    assert!(before > 1.5 && after < 0.58, "{before} {after}");
}

#[test]
fn straight_guides_show_nothing() {
    let (names, _) = found("examples/slides/clean.toml");
    assert!(names.is_empty(), "{names:?}");
}
