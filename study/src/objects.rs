//! What the rows of a source observe that nobody knows: the object and the station of each, by their labels.

use std::ops::Range;

use super::labels::{Known, number};
use super::plan::{Plan, SourcePlan};
use super::rows::Rows;
use observe::Observations;
use observe::unknowns::{Station, Unknowns};

impl Plan {
    /// The objects and stations of the rows of a source, those behind `start`.
    pub(super) fn append_objects(
        &self,
        all: &mut Observations,
        source: &SourcePlan,
        rows: &Rows,
        start: usize,
    ) {
        let count = rows.row_numbers.len();
        let Some(shape) = source.measure.shape() else {
            if let Some(unknowns) = &mut all.unknowns {
                unknowns.object.extend(std::iter::repeat_n(None, count));
                unknowns.station.extend(std::iter::repeat_n(0, count));
            }
            return;
        };
        let unknowns = all.unknowns.get_or_insert_with(|| Unknowns {
            stations: vec![Station::ground()],
            object: vec![None; start],
            station: vec![0; start],
            ..Unknowns::default()
        });
        let label = |from: usize, of: &[String], row: usize| {
            let parts = rows.labels[from..from + of.len()].iter().map(|labels| labels[row].as_str());
            parts.collect::<Vec<_>>().join(" ")
        };
        let from = self.labels_of_objects(source).start;
        for row in 0..count {
            let name = label(from, &source.object, row);
            let known = unknowns.objects.iter().position(|own| own.label == name && own.shape == shape);
            let object = known.unwrap_or_else(|| {
                unknowns.objects.push(self.places.object(&name, shape));
                unknowns.objects.len() - 1
            });
            let name = label(from + source.object.len(), &source.station, row);
            let known = unknowns.stations.iter().position(|own| own.label == name);
            let station = known.unwrap_or_else(|| {
                unknowns.stations.push(self.places.station(&name));
                unknowns.stations.len() - 1
            });
            unknowns.object.push(Some(object as u32));
            unknowns.station.push(station as u32);
        }
    }

    /// Which columns of labels name the object of a row.
    fn labels_of_objects(&self, source: &SourcePlan) -> Range<usize> {
        let from = self.group.len() + usize::from(self.id.is_some());
        from..from + source.object.len()
    }

    /// The number of the object of each row, where a source observes objects.
    pub(super) fn object_numbers(&self, source: &SourcePlan, rows: &Rows) -> Option<Vec<u32>> {
        source.measure.shape()?;
        let labels = &rows.labels[self.labels_of_objects(source)];
        Some(number(&mut Known::new(), labels, rows.row_numbers.len()))
    }
}
