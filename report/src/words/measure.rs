//! Everything that is proposed to measure next.

use super::next::{PoseTable, tables_of_poses};
use super::places::tables_of_places;
use calibration::diagnose::Diagnosis;
use observe::SiUnit;

/// Every proposal: poses, then places.
#[must_use]
pub fn pose_tables(diagnosis: &Diagnosis) -> Vec<PoseTable> {
    let unit = |name: &str| {
        let readings = &diagnosis.instrument.readings;
        readings.iter().find(|reading| reading.name == name).map_or(SiUnit::ONE, |reading| reading.unit)
    };
    [tables_of_poses(diagnosis, unit), tables_of_places(diagnosis, unit)].concat()
}
