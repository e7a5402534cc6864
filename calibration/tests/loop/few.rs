//! An effect that hangs on a handful of observations is told as one.

use calibration::diagnose::{Caution, Diagnosis, Verdict};
use model_core::Chain;
use observe::{Observations, Poses};
use study::Study;

use crate::simulated::{lidar, measured, pointing, search};

const ARCSEC: f64 = std::f64::consts::PI / 180.0 / 3600.0;

/// The report on 300 poses, of which the first ones belong to a second session: there the middle frame stands otherwise.
fn report(second: usize) -> Diagnosis {
    let text = lidar();
    let study = "chain = \"c\"\nobservable = \"pointing\"\ndata = \"d\"\n\
                 [columns]\ntemperature = { column = \"t\", meaning = \"temperature\" }\n\
                 beta_direction = { column = \"b\", meaning = \"direction of beta\" }\n\
                 session_2 = { column = \"s\", meaning = \"session\" }\n\
                 [observed]\nkind = \"direction\"\n[search]\ninputs = [\"session_2\", \"temperature\", \"beta_direction\"]\n";
    let plan = Study::from_text(study).unwrap().plan(&Chain::from_text(&text).unwrap()).unwrap();
    let chain = Chain::from_text(&text).unwrap();
    let moved = |by: f64| {
        let shifted = |mut readings: [f64; 5]| {
            readings[1] += by;
            pointing(&chain, &[], readings)
        };
        measured(&plan, 300, 11, shifted)
    };
    let (first, other) = (moved(0.0), moved(60.0 * ARCSEC));
    let measured = (0..300).map(|row| if row < second { &other } else { &first }.measured[row]).collect();
    let mut columns = first.poses.columns.clone();
    let session = (0..300).map(|row| if row < second { 1.0 } else { 0.0 }).collect();
    columns.push((plan.chain.find_symbol("session_2").unwrap(), session));
    columns.sort_by_key(|(id, _)| *id);
    search(&text, &plan, &Observations { measured, poses: Poses { columns, ..first.poses.clone() }, ..first })
        .diagnosis
}

/// What the caution about few observations tells.
fn resting_on_few(report: &Diagnosis) -> Vec<&str> {
    let few = |caution| match caution {
        &Caution::FewBehindAnEffect { ref effect, observations } if observations < 5.0 => {
            Some(effect.as_str())
        }
        _ => None,
    };
    report.cautions.iter().filter_map(few).collect()
}

#[test]
fn an_offset_of_three_rows_is_told_as_resting_on_few_and_left_out() {
    let report = report(3);
    let few = resting_on_few(&report);
    assert!(few.len() == 1 && few[0].starts_with("offset of a session in "), "{:?}", report.cautions);
    assert!(report.effects.is_empty(), "{:?}", report.effects);
    assert_eq!(
        report.verdict,
        Verdict::TooFewObservations,
        "{:?} {:?}",
        report.cautions,
        report.observations
    );
}

#[test]
fn the_same_offset_of_thirty_rows_is_explained() {
    let report = report(30);
    assert_eq!(report.effects.len(), 1, "{:?}", report.effects);
    assert!(report.effects[0].driver == "session_2", "{:?}", report.effects);
    assert_eq!(report.verdict, Verdict::Confounded);
    assert!(resting_on_few(&report).is_empty(), "{:?}", report.cautions);
}
