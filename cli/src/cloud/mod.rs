//! Point clouds, LAS and LAZ: the coordinates of their points corrected, every other byte kept.
//!
//! Points are read, moved and written as the bytes that they are; only compression is left to a library, so that what nobody here
//! knows survives.

mod by_time;
mod chunks;
mod correct;
mod dimensions;
mod header;
mod points;
mod readings;
mod records;
mod write;

use std::path::Path;
use std::time::Instant;

use model_core::{Chain, ObservableId, ObservableKind};
use service::apply::Outside;
use service::errors_file::FoundOver;
use service::evaluation::readings_of;
use service::source::observable;

use crate::failure::Failure;
use crate::over_table::so_far;
use crate::{output, table_files, terminal};
use by_time::Opened;
pub use chunks::is_decoding;
use correct::Corrector;
use model_core::names::listed;
use points::Cloud;
use readings::Readings;
use write::Writer;

/// What is corrected, and where from and to.
pub struct Correction<'a> {
    /// The declaration.
    pub chain: &'a Chain,
    /// The value of every symbol, SI.
    pub values: &'a [f64],
    /// The ranges that the errors were found over.
    pub found: Vec<FoundOver>,
    /// The observables that were named.
    pub named: &'a [String],
    /// The cloud.
    pub data: &'a Path,
    /// A table by time.
    pub readings: Option<&'a Path>,
    /// The name of its column of times.
    pub time: Option<&'a str>,
    /// What lines of it begin with that are comments.
    pub comment: Option<u8>,
    /// How far the cloud may be from the chain without errors, m.
    pub tolerance_m: Option<f64>,
    /// Where to.
    pub out: &'a Path,
}

/// Corrects a cloud.
///
/// # Errors
/// Something cannot be read, does not belong together, or cannot be written.
pub fn correct(correction: Correction<'_>) -> Result<(), Failure> {
    let Correction { chain, values, found, named, data, readings, time, comment, tolerance_m, out } =
        correction;
    if !table_files::is_point_cloud(out) {
        return Err(Failure::Input(format!(
            "`{}`: a point cloud stays one: write a .las or .laz file",
            out.display()
        )));
    }
    let observable = point_of(chain, named)?;
    let mut cloud = Cloud::open(data)?;
    let table = readings.map(|path| Opened::open(path, chain, time, comment)).transpose()?;
    let readings = Readings::of(&cloud, table, chain, &readings_of(chain, observable))?;
    let mut corrector = Corrector::new(chain, observable, values, readings, tolerance_m);
    let mut outside = Outside::new(found);
    let (progress, began) = (terminal::progress(), Instant::now());
    output::write_file_with(out, |file| {
        let mut writer = Writer::start(out, file, &mut cloud, table_files::is_compressed_cloud(out))?;
        while let Some(mut points) = cloud.next()? {
            let columns = corrector.readings.columns(&cloud, &points)?;
            let slices: Vec<_> = columns.iter().map(|(id, column)| (*id, column.as_slice())).collect();
            outside.see(chain, &slices, &corrector.amended)?;
            corrector.correct(&cloud, &mut points, &columns)?;
            writer.points(&points)?;
            progress.say(&so_far(
                points.first + points.counts.iter().sum::<usize>() as u64 - 1,
                Some(cloud.share_read()),
                began.elapsed(),
            ));
        }
        writer.finish(&mut cloud, corrector.bounds)
    })?;
    progress.finish_and_clear();
    outside.warning(chain).iter().for_each(terminal::warn);
    Ok(())
}

/// The point that the coordinates are.
fn point_of(chain: &Chain, named: &[String]) -> Result<ObservableId, Failure> {
    let is_point = |id: ObservableId| {
        let shown = chain.observable(id);
        shown.kind == ObservableKind::Point && shown.is_vector()
    };
    let named: Vec<ObservableId> =
        named.iter().map(|name| observable(chain, name)).collect::<Result<_, _>>()?;
    let name = |id: ObservableId| chain.observable(id).name.as_str();
    if let Some(other) = named.iter().copied().find(|&id| !is_point(id)) {
        return Err(Failure::Input(format!(
            "`{}` is no point, and a point cloud has the coordinates of one",
            name(other)
        )));
    }
    let all =
        (0_u16..).zip(&chain.observables).map(|(index, _)| ObservableId(index)).filter(|&id| is_point(id));
    let points: Vec<ObservableId> = if named.is_empty() { all.collect() } else { named };
    match points.as_slice() {
        [one] => Ok(*one),
        [] => Err(Failure::Input(format!(
            "chain {} shows no point, and a point cloud has the coordinates of one: observe one, as in `observe target: point(0, 0, \
             range) of device;`",
            chain.name
        ))),
        several => Err(Failure::Input(format!(
            "say which of {} the coordinates are: --observable NAME",
            listed(several.iter().map(|&id| name(id)))
        ))),
    }
}
