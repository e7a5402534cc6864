//! Which way an observed point moves as its range grows: the way of a beam, wherever the frame's origin lies.

use codegen::{Form, Interpreter, Program, build_all};
use model_core::{Chain, ObservableId, Quantity, SymbolId, SymbolKind};
use nalgebra::Vector3;

use super::FitError;
use observe::kinds::BeamUse;
use observe::{Poses, Series};

/// What a beam's program says of a series.
#[derive(Debug, Clone)]
pub(super) struct Beam {
    /// The derivative of the point by the range; before it the point itself, where the range is that of the object.
    pub program: Program,
    /// The range, where nobody measures it: a sight ends where its object is.
    sighted: Option<SymbolId>,
}

/// The beams of some rows.
#[derive(Debug, Default)]
pub(super) struct Along {
    /// The beam of each row: its way, or for a sight all of it, m; x of all rows, then y and z.
    pub axes: Vec<f64>,
    /// How far each row's beam goes, where nobody measures that.
    pub ranges: Option<(SymbolId, Vec<f64>)>,
}

/// The input of length that takes an observed point along its beam: the one in the coordinates of the point, else the only one that
/// moves it. `None` if there is none, or are several.
pub fn range_of(chain: &Chain, observable: ObservableId) -> Option<SymbolId> {
    let is_range = |id: &SymbolId| {
        let symbol = chain.symbol(*id);
        symbol.kind == SymbolKind::Input && symbol.quantity == Quantity::Length
    };
    let only = |mut symbols: Vec<SymbolId>| {
        symbols.retain(is_range);
        symbols.sort_unstable();
        symbols.dedup();
        if let [range] = symbols[..] { Some(range) } else { None }
    };
    let components = &chain.observable(observable).components;
    let of_point = components.iter().flat_map(|amount| chain.symbols_in(amount)).collect();
    only(of_point).or_else(|| only(chain.symbols_of_way(observable)))
}

impl Beam {
    /// The beam of each series whose rows are seen along one.
    pub fn of_all(chain: &Chain, poses: &Poses) -> Vec<Option<Self>> {
        let of = |series: &Series| {
            let (forms, is_sight) = match series.measure.kind().beam {
                BeamUse::Direction => (&[Form::ExactJacobian][..], false),
                BeamUse::Whole => (&[Form::ExactValue, Form::ExactJacobian][..], true),
                BeamUse::Nothing => return None,
            };
            let range = range_of(chain, series.observable)?;
            let program = build_all(chain, &[series.observable], forms, &[range]);
            Some(Self { program, sighted: is_sight.then_some(range) })
        };
        poses.series.iter().map(of).collect()
    }

    /// The beams of some rows; `far` says how far the object of a row is from a point of the chain's frame, m.
    pub fn along(
        &self,
        interpreter: &mut Interpreter,
        columns: &[(SymbolId, &[f64])],
        values: &[f64],
        rows: usize,
        far: impl Fn(usize, &Vector3<f64>) -> Option<f64>,
    ) -> Result<Along, FitError> {
        // Of a sight where it begins is asked, at no range.
        let none = vec![0.0; rows];
        let reading = |&(id, own)| (id, if self.sighted == Some(id) { none.as_slice() } else { own });
        let columns: Vec<(SymbolId, &[f64])> = columns.iter().map(reading).collect();
        let mut outputs = vec![0.0; self.program.outputs().len() * rows];
        let mut arrays: Vec<&mut [f64]> = outputs.chunks_exact_mut(rows.max(1)).collect();
        interpreter
            .eval_batch(&columns, values, &mut arrays)
            .map_err(|error| FitError::WrongShape { why: error.to_string() })?;
        let Some(range) = self.sighted else { return Ok(Along { axes: outputs, ranges: None }) };
        let at = |first: usize, row: usize| Vector3::from_fn(|axis, _| outputs[(first + axis) * rows + row]);
        let mut along = Along { axes: vec![0.0; 3 * rows], ranges: None };
        let mut ranges = Vec::with_capacity(rows);
        for row in 0..rows {
            let (origin, by_range) = (at(0, row), at(3, row));
            let far = far(row, &origin).ok_or_else(|| FitError::WrongShape {
                why: "a row sights an object that is none".to_owned(),
            })?;
            (0..3).for_each(|axis| along.axes[axis * rows + row] = by_range[axis] * far / by_range.norm());
            ranges.push(far / by_range.norm());
        }
        along.ranges = Some((range, ranges));
        Ok(along)
    }
}
