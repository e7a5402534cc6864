//! What was measured stands in another frame: turned by a clock or a place that are wrong, or because the instrument stands turned and the
//! declaration does not say so.

use fit::align_robustly;
use model_core::exact::Path;
use nalgebra::UnitQuaternion;

use super::clock::whole_hours;
use super::hypotheses::{Hypothesis, Reading};
use super::policy::{FRAME_PRICE, MOST_TILT_RAD, RARE};
use network::is_in_a_line;
use observe::Observations;
use observe::orientation::of_axes;
use study::Plan;

/// The turn of all measured directions that brings them nearest to what the chain shows with these errors; `None` where it is no larger than
/// a tilt may be, or where anything but directions was measured.
pub(super) fn turn(plan: &Plan, observations: &Observations, errors: &[f64]) -> Option<UnitQuaternion<f64>> {
    let mut values = errors.to_vec();
    let (mut from, mut to) = (Vec::new(), Vec::new());
    for series in &observations.poses.series {
        let path = Path::new(&plan.chain, series.observable);
        for row in series.rows.clone() {
            for (symbol, readings) in &observations.poses.columns {
                values[symbol.index()] = *readings.get(row)?;
            }
            let (measured, shown) =
                (*observations.measured.get(row)?.direction()?, path.value(&values).normalize());
            // Both ends, so that nothing is shifted.
            from.extend([measured, -measured]);
            to.extend([shown, -shown]);
        }
    }
    if is_in_a_line(&from) {
        return None;
    }
    let (turn, _) = align_robustly(&from, &to)?;
    let turn = of_axes(&turn);
    (turn.angle() > MOST_TILT_RAD).then_some(turn)
}

/// The observations in the frame of the chain.
pub(super) fn turned(observations: &Observations, turn: &UnitQuaternion<f64>) -> Observations {
    let measured = observations.measured.iter().map(|own| own.turned(turn)).collect();
    Observations { measured, ..observations.clone() }
}

/// The three numbers of a turn cost what three errors do.
pub(super) fn hypothesis(observations: &Observations, turn: &UnitQuaternion<f64>) -> Hypothesis {
    let axis = turn.axis().map_or([0.0; 3], |axis| axis.into_inner().into());
    let reading =
        Reading::Frame { by_deg: turn.angle().to_degrees(), axis, hours: whole_hours(turn.angle()) };
    let price = FRAME_PRICE - RARE.ln() + 1.5 * (observations.rows() as f64).ln();
    Hypothesis::new(reading, Vec::new(), Vec::new(), price)
}
