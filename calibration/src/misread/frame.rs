//! What was measured stands in another frame: turned by a clock or a place that are wrong, or because the instrument stands turned and the
//! declaration does not say so.

use model_core::exact::Path;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::hypotheses::{Hypothesis, Reading};
use super::policy::{FRAME_PRICE, MOST_TILT_RAD, RARE};
use observe::Observations;
use study::Plan;

/// Singular values below this share of the largest say nothing of a turn.
const ONE_DIRECTION: f64 = 1e-6;

/// The turn of all measured directions that brings them nearest to what the chain shows with these errors; `None` where it is no larger than
/// a tilt may be, or where anything but directions was measured.
///
/// Source: W. Kabsch, A solution for the best rotation to relate two sets of vectors, Acta Cryst. A32 (1976) 922.
pub(super) fn turn(plan: &Plan, observations: &Observations, errors: &[f64]) -> Option<UnitQuaternion<f64>> {
    let mut values = errors.to_vec();
    let mut products = Matrix3::zeros();
    for series in &observations.poses.series {
        let path = Path::new(&plan.chain, series.observable);
        for row in series.rows.clone() {
            for (symbol, readings) in &observations.poses.columns {
                values[symbol.index()] = *readings.get(row)?;
            }
            let measured = observations.measured.get(row)?.direction()?;
            products += path.value(&values).normalize() * measured.transpose();
        }
    }
    let svd = products.svd(true, true);
    let (u, v) = (svd.u?, svd.v_t?);
    let [largest, second, _] = *svd.singular_values.as_ref();
    let is_told = second > ONE_DIRECTION * largest && (u * v).iter().all(|value| value.is_finite());
    let handed = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, (u * v).determinant().signum()));
    let turn = Rotation3::from_matrix_unchecked(u * handed * v);
    let turn = is_told.then(|| UnitQuaternion::from_rotation_matrix(&turn))?;
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
    Hypothesis {
        reading: Reading::Frame { by_deg: turn.angle().to_degrees(), axis },
        changes: Vec::new(),
        lines: Vec::new(),
        headings: Vec::new(),
        price: FRAME_PRICE - RARE.ln() + 1.5 * (observations.rows() as f64).ln(),
        digits: 0.0,
    }
}
