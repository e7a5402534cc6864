//! The rows that observe objects, each with the point or direction that the chain says.

use model_core::{Chain, SymbolId, exact};
use nalgebra::Vector3;

use fit::range_of;
use observe::kinds::{BeamUse, PlaceShown};
use observe::unknowns::Unknowns;
use observe::{Measure, Measured, Observations, Series};

/// A row that observes an object: the point that the chain says.
pub struct Row {
    /// Its index among all rows.
    pub number: usize,
    /// The index of its series.
    pub series: usize,
    /// The object that it observes.
    pub object: usize,
    /// The station that it is observed from.
    pub station: usize,
    /// What is measured of the object.
    pub measure: Measure,
    /// The point of the chain in its frame, m.
    pub point: Vector3<f64>,
    /// Where the beam of a sight begins, in the chain's frame, m.
    pub from: Vector3<f64>,
    /// The measured value.
    pub measured: Measured,
}

/// The rows that observe objects, the chain's symbols having these values.
pub fn rows(chain: &Chain, observations: &Observations, unknowns: &Unknowns, values: &[f64]) -> Vec<Row> {
    let mut values = values.to_vec();
    values.truncate(chain.symbols.len());
    let mut rows = Vec::new();
    for (of, series) in observations.poses.series.iter().enumerate() {
        let path = exact::Path::new(chain, series.observable);
        let sighted = sighted(chain, series);
        for row in series.rows.clone() {
            let Some(object) = unknowns.object[row] else { continue };
            for (id, readings) in &observations.poses.columns {
                values[id.index()] = readings[row];
            }
            let point = path.value(&values);
            let from = sighted.map_or_else(Vector3::zeros, |range| {
                values[range.index()] = 0.0;
                path.value(&values)
            });
            if point.iter().all(|part| part.is_finite()) {
                let (station, measured) = (unknowns.station[row] as usize, observations.measured[row]);
                let (object, measure) = (object as usize, series.measure);
                rows.push(Row { number: row, series: of, object, station, measure, point, from, measured });
            }
        }
    }
    rows
}

/// The range of a series' sights, if they are from points of the chain: nobody measures it.
pub(super) fn sighted(chain: &Chain, series: &Series) -> Option<SymbolId> {
    let nobody_measures_it = series.measure.kind().beam == BeamUse::Whole;
    if nobody_measures_it { range_of(chain, series.observable) } else { None }
}

/// Whether a row tells the place of its object from that of its station, and the other way round.
pub fn tells(row: &Row) -> bool {
    row.measure.kind().place == PlaceShown::There
}
