//! Harmonics of each joint in what is left: how large, and how large noise alone would make them.

use faer::Mat;
use model_core::{Chain, Quantity, SymbolKind};
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use crate::search::products::add_products;
use fit::FitResult;
use observe::Observations;
use observe::waves::waves;

/// Harmonics that are told.
const ORDERS: usize = 12;

/// The constant, and a cosine and a sine an order.
const WIDTH: usize = 2 * ORDERS + 1;

/// Rows taken at a time.
const CHUNK: usize = 2048;

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
    let rows: Vec<usize> = series
        .rows
        .clone()
        .filter(|&row| after.residuals.weight.get(row).is_some_and(|&weight| weight > 0.0))
        .collect();
    let mut all = Vec::new();
    for (id, readings) in &observations.poses.columns {
        let symbol = chain.symbol(*id);
        if symbol.kind != SymbolKind::Joint || symbol.quantity != Quantity::Angle {
            continue;
        }
        let residuals = |row: usize| {
            let own = (row - series.rows.start) * names.len()..(row - series.rows.start + 1) * names.len();
            [&before.residuals.raw[own.clone()], &after.residuals.raw[own]]
        };
        let fitted = joint_fit(&rows, readings, names.len(), residuals);
        all.extend(fitted.into_iter().zip(names).map(|([before, after, limit], &component)| Harmonics {
            joint: symbol.name.clone(),
            component,
            before,
            after,
            limit,
        }));
    }
    all
}

/// Per component the amplitudes of two residuals, and the limit of the second; none where the readings do not tell the orders
/// apart.
fn joint_fit<'a>(
    rows: &[usize],
    readings: &[f64],
    components: usize,
    residuals: impl Fn(usize) -> [&'a [f64]; 2] + Sync,
) -> Vec<[Vec<f64>; 3]> {
    if rows.len() <= 2 * WIDTH {
        return Vec::new();
    }
    let products = products(rows, readings, WIDTH + 2 * components, residuals);
    let at = |i: usize, j: usize| products[(i.max(j), i.min(j))];
    let normal = DMatrix::from_fn(WIDTH, WIDTH, at);
    let largest = normal.diagonal().max();
    let eigen = normal.clone().symmetric_eigenvalues();
    if eigen.min() < 1e-3 * largest {
        return Vec::new();
    }
    let Some(inverse) = normal.cholesky().map(|factor| factor.inverse()) else { return Vec::new() };
    (0..components)
        .map(|component| {
            let [before, after] = [component, components + component].map(|column| WIDTH + column);
            let right = [before, after].map(|column| DVector::from_fn(WIDTH, |i, _| at(i, column)));
            let [of_before, of_after] = right.each_ref().map(|right| &inverse * right);
            let left = (at(after, after) - of_after.dot(&right[1])).max(0.0) / (rows.len() - WIDTH) as f64;
            let amplitude = |x: &DVector<f64>| -> Vec<f64> {
                (1..=ORDERS).map(|order| x[2 * order - 1].hypot(x[2 * order])).collect()
            };
            let limit = (1..=ORDERS).map(|order| {
                let variance =
                    f64::midpoint(inverse[(2 * order - 1, 2 * order - 1)], inverse[(2 * order, 2 * order)]);
                LIMIT * (left * variance).sqrt()
            });
            [amplitude(&of_before), amplitude(&of_after), limit.collect()]
        })
        .collect()
}

/// The lower half of the inner products of 1, cos q, sin q, cos 2q, …, and both residuals, component by component. Chunks are
/// added up in order, so that the number of processors changes no bit.
fn products<'a>(
    rows: &[usize],
    readings: &[f64],
    width: usize,
    residuals: impl Fn(usize) -> [&'a [f64]; 2] + Sync,
) -> Mat<f64> {
    let of_chunk = |rows: &[usize]| {
        let mut columns = Mat::zeros(rows.len(), width);
        let [sine, cosine] = waves(&rows.iter().map(|&row| readings[row]).collect::<Vec<_>>(), 1.0);
        columns.col_as_slice_mut(0).fill(1.0);
        let (mut s, mut c) = (vec![0.0; rows.len()], vec![1.0; rows.len()]);
        for order in 1..=ORDERS {
            for (((s, c), sine), cosine) in s.iter_mut().zip(&mut c).zip(&sine).zip(&cosine) {
                (*s, *c) = (*s * cosine + *c * sine, *c * cosine - *s * sine);
            }
            columns.col_as_slice_mut(2 * order - 1).copy_from_slice(&c);
            columns.col_as_slice_mut(2 * order).copy_from_slice(&s);
        }
        for (at, &row) in rows.iter().enumerate() {
            let values = residuals(row).into_iter().flatten();
            values.enumerate().for_each(|(number, &value)| columns[(at, WIDTH + number)] = value);
        }
        let mut products = Mat::zeros(width, width);
        add_products(products.as_mut(), columns.as_ref());
        products
    };
    let chunks = parallel::each_of(rows.chunks(CHUNK), of_chunk);
    chunks.into_iter().fold(Mat::zeros(width, width), |whole, part| whole + part)
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
        let values: Vec<[f64; 2]> = (0..500).map(|row| [wave(row), noise(row)]).collect();
        let residuals = |row: usize| [&values[row][..1], &values[row][1..]];
        let [[before, after, limit]] =
            <[_; 1]>::try_from(joint_fit(&rows, &readings, 1, residuals)).expect("orders are told apart");
        assert!((before[0] - 5.0).abs() < 1e-9 && before[1..].iter().all(|&a| a < 1e-9), "{before:?}");
        assert!(after.iter().zip(&limit).filter(|(after, limit)| after > limit).count() <= 2, "{after:?}");
        // 0.1 √(2/500) standard uncertainty of each coefficient.
        assert!((limit[0] / (2.4477 * 0.1 * (2.0_f64 / 500.0).sqrt()) - 1.0).abs() < 0.1, "{limit:?}");
        assert_eq!(limit.len(), ORDERS);
        assert!(joint_fit(&rows[..20], &readings, 1, residuals).is_empty());
    }
}
