//! What a declaration that was handed in makes of the student's data: its errors fitted anew, and what it predicts at other poses.

use fit::{FitOptions, fit};
use nalgebra::{UnitQuaternion, Vector3};
use observe::kinds::{Cells, ways};
use observe::{Observations, Poses, Series, direction_from_spherical};

use crate::instrument::Instrument;
use crate::misread::Row;
use crate::model::{Model, OBSERVABLE};
use crate::readings::{Pose, columns};

/// The kind of observation that the study of a sheet names.
pub const KIND: &str = "direction";

/// The measured x, y and z of a row, as that kind reads them.
struct Shown([f64; 3]);

impl Cells for Shown {
    fn at(&self, column: usize) -> f64 {
        self.0.get(column).copied().unwrap_or_default()
    }

    fn direction(&self, azimuth_rad: f64, second_rad: f64) -> (Vector3<f64>, f64) {
        (direction_from_spherical(azimuth_rad, second_rad), second_rad)
    }

    fn nominal(&mut self) -> Vector3<f64> {
        self.0.into()
    }

    fn orientation(&mut self) -> Result<UnitQuaternion<f64>, String> {
        Err("a direction says nothing of an orientation".to_owned())
    }
}

/// The RMS over rows of how far a declaration, fitted to `rows`, points from where the instrument points at `unseen`, rad; `None`
/// where the fit does not converge.
#[must_use]
pub fn unseen_rms_rad(model: &Model, instrument: &Instrument, rows: &[Row], unseen: &[Row]) -> Option<f64> {
    let poses: Vec<Pose> = rows.iter().map(|(pose, _)| *pose).collect();
    let (measure, way) = ways().find(|(_, way)| way.name == KIND)?;
    let measured: Result<_, _> = rows.iter().map(|(_, shown)| (way.read)(&mut Shown(*shown))).collect();
    let series = vec![Series {
        observable: model.pointing,
        measure,
        rows: 0..rows.len(),
        source: OBSERVABLE.to_owned(),
    }];
    let observations = Observations {
        poses: Poses { series, columns: columns(&poses, instrument, &model.chain) },
        measured: measured.ok()?,
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
