//! Poses at which nothing was measured: what would be seen there moves as the exact chain says, wherever the beam points.

use fit::Model;
use model_core::{Chain, SymbolKind, exact};
use nalgebra::Vector3;
use observe::{Measure, Poses, Series};

const MOUNT: &str = include_str!("../../../examples/alt-azimuth/alt-azimuth.chain");

/// How far each error turns the beam, by differences of the exact direction, against the length of its derivatives across and
/// along. Poses point to the east and to the west, where a plane across y shows one of the two alone.
#[test]
fn derivatives_are_across_the_beam_of_each_pose() {
    let chain = Chain::from_text(MOUNT).unwrap();
    let observable = chain.find_observable("sight").unwrap();
    let errors: Vec<_> = chain.symbols_of(SymbolKind::Error).collect();
    let readings = [(0.0, 0.3), (1.571, 0.2), (-1.571, 0.9), (3.1, 1.2), (2.0, 0.0), (-0.8, 0.7)];
    let [azimuth, elevation] = ["azimuth", "elevation"].map(|name| chain.find_symbol(name).unwrap());
    let mut columns = vec![
        (azimuth, readings.map(|(azimuth, _)| azimuth).to_vec()),
        (elevation, readings.map(|(_, elevation)| elevation).to_vec()),
    ];
    columns.sort_by_key(|(id, _)| *id);
    let series = vec![Series {
        observable,
        measure: Measure::Direction,
        rows: 0..readings.len(),
        source: String::new(),
    }];
    let poses = Poses { series, columns };
    let model = Model::new(&chain, &poses, &errors).unwrap();
    let nominal = chain.nominal_values();
    let lengths: Vec<Vec<f64>> = model
        .map_poses(&poses, &nominal, |_, rows, block| {
            assert!(block.residual.iter().all(|residual| residual.abs() < 1e-15));
            let length = |column: &[f64], row: usize| column[row].hypot(column[rows.len() + row]);
            block
                .columns()
                .map(|column| (0..rows.len()).map(|row| length(column, row)).collect())
                .collect::<Vec<_>>()
        })
        .unwrap()
        .concat();
    let path = exact::Path::new(&chain, observable);
    for (error, column) in errors.iter().zip(model.column_of()) {
        for (row, (az, el)) in readings.iter().enumerate() {
            let beam = |by: f64| -> Vector3<f64> {
                let mut values = nominal.clone();
                (values[azimuth.index()], values[elevation.index()]) = (*az, *el);
                values[error.index()] = by;
                path.value(&values).normalize()
            };
            let turned = (beam(1e-6) - beam(-1e-6)).norm() / 2e-6;
            let derivative = column.map_or(0.0, |column| lengths[column][row]);
            let name = &chain.symbol(*error).name;
            assert!((turned - derivative).abs() < 1e-8, "{name} at {az}, {el}: {turned} {derivative}");
        }
    }
}
