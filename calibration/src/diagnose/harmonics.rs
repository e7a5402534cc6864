//! Harmonics of each joint in what is left: how large, and how large noise alone would make them.

use model_core::{Chain, Quantity, SymbolKind};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use crate::data::Observations;
use crate::fit::FitResult;

/// Harmonics that are told.
const ORDERS: usize = 12;

/// √(−2 ln 0.05): noise alone gives a harmonic more than so many standard uncertainties once in twenty.
const LIMIT: f64 = 2.447_746_830_680_816;

/// The harmonics of a joint in one residual component.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Harmonics {
    /// The joint.
    pub joint: String,
    /// The residual component.
    pub component: &'static str,
    /// Amplitude of each order from 1, rad or m, of the declaration as it was.
    pub before: Vec<f64>,
    /// The same after.
    pub after: Vec<f64>,
    /// What noise alone exceeds once in twenty, order by order.
    pub limit: Vec<f64>,
}

/// Every turning joint against every component of the first series, all orders fitted jointly over rows with weight.
pub(super) fn harmonics(
    chain: &Chain,
    observations: &Observations,
    before: &FitResult,
    after: &FitResult,
) -> Vec<Harmonics> {
    let Some(series) = observations.poses.series.first() else { return Vec::new() };
    let names = series.measure.component_names();
    let mut all = Vec::new();
    for (id, readings) in &observations.poses.columns {
        let symbol = chain.symbol(*id);
        if symbol.kind != SymbolKind::Joint || symbol.quantity != Quantity::Angle {
            continue;
        }
        for (component, &name) in names.iter().enumerate() {
            let rows: Vec<usize> = series
                .rows
                .clone()
                .filter(|&row| after.residuals.weight.get(row).is_some_and(|&weight| weight > 0.0))
                .collect();
            let residual = |fit: &FitResult, row: usize| {
                fit.residuals.raw[(row - series.rows.start) * names.len() + component]
            };
            let fitted = joint_fit(&rows, readings, |row| [residual(before, row), residual(after, row)]);
            if let Some([before, after, limit]) = fitted {
                all.push(Harmonics { joint: symbol.name.clone(), component: name, before, after, limit });
            }
        }
    }
    all
}

/// Amplitudes of two residuals, and the limit of the second; `None` where the readings do not tell the orders apart.
fn joint_fit(
    rows: &[usize],
    readings: &[f64],
    residuals: impl Fn(usize) -> [f64; 2],
) -> Option<[Vec<f64>; 3]> {
    let width = 2 * ORDERS + 1;
    if rows.len() <= 2 * width {
        return None;
    }
    let mut normal = DMatrix::<f64>::zeros(width, width);
    let mut right = [DVector::<f64>::zeros(width), DVector::<f64>::zeros(width)];
    let mut square = 0.0;
    for &row in rows {
        let mut wave = DVector::from_element(width, 1.0);
        for order in 1..=ORDERS {
            let (sin, cos) = (order as f64 * readings[row]).sin_cos();
            (wave[2 * order - 1], wave[2 * order]) = (cos, sin);
        }
        normal.ger(1.0, &wave, &wave, 1.0);
        let values = residuals(row);
        right.iter_mut().zip(values).for_each(|(right, value)| right.axpy(value, &wave, 1.0));
        square += values[1] * values[1];
    }
    let largest = normal.diagonal().max();
    let eigen = normal.clone().symmetric_eigenvalues();
    if eigen.min() < 1e-3 * largest {
        return None;
    }
    let inverse = normal.cholesky()?.inverse();
    let [of_before, of_after] = right.each_ref().map(|right| &inverse * right);
    let left = (square - of_after.dot(&right[1])).max(0.0) / (rows.len() - width) as f64;
    let amplitude = |x: &DVector<f64>| -> Vec<f64> {
        (1..=ORDERS).map(|order| x[2 * order - 1].hypot(x[2 * order])).collect()
    };
    let limit = (1..=ORDERS).map(|order| {
        let variance =
            f64::midpoint(inverse[(2 * order - 1, 2 * order - 1)], inverse[(2 * order, 2 * order)]);
        LIMIT * (left * variance).sqrt()
    });
    Some([amplitude(&of_before), amplitude(&of_after), limit.collect()])
}

#[cfg(test)]
mod tests {
    use super::{ORDERS, joint_fit};

    #[test]
    fn a_wave_is_its_amplitude_and_the_limit_that_of_what_is_left() {
        let readings: Vec<f64> = (0..500).map(|row| f64::from(row) * 0.618).collect();
        let rows: Vec<usize> = (0..500).collect();
        let noise = |row: usize| if row.is_multiple_of(2) { 0.1 } else { -0.1 };
        let wave = |row: usize| 3.0 * readings[row].cos() - 4.0 * readings[row].sin();
        let [before, after, limit] =
            joint_fit(&rows, &readings, |row| [wave(row), noise(row)]).expect("orders are told apart");
        assert!((before[0] - 5.0).abs() < 1e-9 && before[1..].iter().all(|&a| a < 1e-9), "{before:?}");
        assert!(after.iter().zip(&limit).filter(|(after, limit)| after > limit).count() <= 2, "{after:?}");
        // 0.1 √(2/500) standard uncertainty of each coefficient.
        assert!((limit[0] / (2.4477 * 0.1 * (2.0_f64 / 500.0).sqrt()) - 1.0).abs() < 0.1, "{limit:?}");
        assert_eq!(limit.len(), ORDERS);
        assert!(joint_fit(&rows[..20], &readings, |_| [0.0, 0.0]).is_none());
    }
}
