//! What a declaration that was handed in makes of the student's data: its errors fitted anew, and what it predicts at other poses.

use fit::{FitOptions, fit};
use nalgebra::Vector3;
use observe::{Measure, Measured, Observations, Poses, Series};

use crate::instrument::Instrument;
use crate::misread::Row;
use crate::model::{Model, OBSERVABLE};
use crate::readings::{Pose, columns};

/// The RMS over rows of how far a declaration, fitted to `rows`, points from where the instrument points at `unseen`, rad; `None`
/// where the fit does not converge.
#[must_use]
pub fn unseen_rms_rad(model: &Model, instrument: &Instrument, rows: &[Row], unseen: &[Row]) -> Option<f64> {
    let poses: Vec<Pose> = rows.iter().map(|(pose, _)| *pose).collect();
    let series = vec![Series {
        observable: model.pointing,
        measure: Measure::Direction,
        rows: 0..rows.len(),
        source: OBSERVABLE.to_owned(),
    }];
    let observations = Observations {
        poses: Poses { series, columns: columns(&poses, instrument, &model.chain) },
        measured: rows
            .iter()
            .map(|(_, shown)| Measured::Direction(Vector3::from(*shown).normalize()))
            .collect(),
        groups: (0..).take(rows.len()).collect(),
        ..Observations::default()
    };
    let options = FitOptions { estimate: model.errors(), ..FitOptions::for_chain(&model.chain) };
    let values = if options.estimate.is_empty() {
        model.chain.nominal_values()
    } else {
        let result = fit(&model.chain, &observations, &options).ok()?;
        result.outcome.is_usable().then_some(result.values)?
    };
    let poses: Vec<Pose> = unseen.iter().map(|(pose, _)| *pose).collect();
    let predicted = model.pointing(instrument, &poses, &values);
    let off =
        predicted.iter().zip(unseen).map(|(own, (_, truth))| Vector3::from(*own) - Vector3::from(*truth));
    let rms = (off.map(|off| off.norm_squared()).sum::<f64>() / unseen.len() as f64).sqrt();
    rms.is_finite().then_some(rms)
}
