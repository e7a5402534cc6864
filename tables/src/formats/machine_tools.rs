//! Tests of machine tools as separated values: ball bars, R-tests, plates and grids. Deviations become positions and lengths that are
//! absolute, in columns of their own behind those of the file, computed as rows are read.
//!
//! Where something lacks for that (a unit, a radius, an axis) the table is read as it is, and who begins a study of it asks what.
//!
//! Sources: ISO 230-1:2012 and ISO 230-2:2014 (a deviation is the actual position minus the commanded one); ISO 230-4:2022 (circular tests);
//! ISO 841:2001 (a table turns against the sign of its axis); S. Weikert, R-Test, a new device for accuracy measurements on five axis machine
//! tools, CIRP Annals 53 (2004) 429-432; the International Vocabulary of Metrology (an error of indication is the indication minus the true value).

mod roles;
mod said;

use model_core::unit::{Measures, Unit};

use super::{
    Cell, Cells, Chunk, ColumnName, DataError, Form, Kept, TableReader, Texts, Wanted, clipped, no_cells,
};
pub use roles::{Alone, Columns, Lack, Pair, Three};
use said::{Along, Said};

const AXES: [&str; 3] = ["x", "y", "z"];
/// Digits that a sum of two decimal numbers is written with, of the 15 that a double holds.
const DIGITS: usize = 14;

/// A number out of those of a row.
type Computed = Box<dyn Fn(&[f64]) -> f64 + Send>;

/// A column that is computed of others.
struct Added {
    name: ColumnName,
    /// Of which, and what takes their numbers to SI.
    needs: Vec<(usize, f64)>,
    /// Its number, SI, of theirs.
    of: Computed,
    /// The size of its own unit.
    in_si: f64,
}

impl Added {
    /// Its number in its own unit.
    fn at(&self, numbers: &[f64]) -> f64 {
        let number = (self.of)(numbers) / self.in_si;
        // What two decimal numbers make together has no digits beyond theirs.
        format!("{number:.DIGITS$e}").parse().unwrap_or(number)
    }
}

/// What is added to a table.
struct Additions {
    added: Vec<Added>,
    /// The columns that say nothing more.
    behind: Vec<usize>,
    /// What was assumed.
    remark: Option<String>,
}

/// A table with absolute positions beside its deviations, if it is a test of a machine tool. `comments` are the lines above its header.
pub(super) fn seen<'r>(table: Box<dyn TableReader + 'r>, comments: &str) -> Box<dyn TableReader + 'r> {
    let header = table.header();
    let columns = Columns::of(header);
    let (mut additions, lacks) = match additions(header, &columns, &Said(comments)) {
        Ok(None) => return table,
        Ok(Some(additions)) => (additions, None),
        Err(Lack(why)) => (Additions { added: Vec::new(), behind: Vec::new(), remark: None }, Some(why)),
    };
    additions.behind.extend(table.behind());
    let names = additions.added.iter().map(|added| added.name.clone());
    let header: Vec<ColumnName> = header.iter().cloned().chain(names).collect();
    Box::new(Reader { table, header, additions, lacks })
}

fn additions(header: &[ColumnName], columns: &Columns, said: &Said<'_>) -> Result<Option<Additions>, Lack> {
    let of_axes: Vec<usize> = (0..3).filter(|axis| columns.deviations[*axis].is_some()).collect();
    let is_known = said.radius_m().is_ok_and(|radius| radius.is_some()) || columns.radius.is_some();
    // Of what a column called `deviation` alone is one, a radius says.
    let of_bar_alone = columns.bar_deviation.or(columns.deviation.filter(|_| is_known));
    let found = match (of_axes.as_slice(), of_bar_alone) {
        ([], None) => return Ok(None),
        ([], Some(deviation)) => of_bar(header, columns, deviation, said)?,
        (_, _) if columns.pair()?.is_some() => return Ok(None),
        (_, _) => match columns.alone()? {
            None => return Ok(None),
            Some(alone) if columns.turns_any() => Some(of_nest(header, columns, alone, said)?),
            Some(alone) => Some(of_positions(header, columns, alone, said)?),
        },
    };
    if let Some(there) = found
        .iter()
        .flat_map(|found| &found.added)
        .find(|added| header.iter().any(|own| own.full == added.name.full))
    {
        return Err(Lack(format!("the table has a column `{}` already: rename it", there.name.full)));
    }
    Ok(found)
}

/// The unit of a column, which its heading has to say.
fn unit(header: &[ColumnName], at: usize, measures: Measures) -> Result<Unit, Lack> {
    let name = &header[at];
    let example = if measures == Measures::Angle { "deg" } else { "mm" };
    let said = name.said(Some(measures)).map_err(|why| Lack(format!("`{}`: {why}", clipped(&name.full))))?;
    said.filter(|unit| unit.measures() == measures).ok_or_else(|| {
        Lack(format!(
            "`{}` has no unit of {}: write it behind the name, such as `{} [{example}]`",
            clipped(&name.full),
            if measures == Measures::Angle { "an angle" } else { "a length" },
            clipped(&name.stem)
        ))
    })
}

fn length(header: &[ColumnName], at: usize) -> Result<(usize, f64), Lack> {
    Ok((at, unit(header, at, Measures::Length)?.in_si()))
}

fn angle(header: &[ColumnName], at: usize) -> Result<(usize, f64), Lack> {
    Ok((at, unit(header, at, Measures::Angle)?.in_si()))
}

/// A column called so in the unit of another.
fn like(header: &[ColumnName], at: usize, name: &str) -> Result<(ColumnName, f64), Lack> {
    let unit = unit(header, at, Measures::Length)?;
    Ok((ColumnName::parse(&format!("{name} [{}]", unit.name())), unit.in_si()))
}

/// The columns for x, y and z that both have.
fn complete(header: &[ColumnName], columns: &Columns, alone: Alone) -> Result<[[usize; 2]; 3], Lack> {
    let mut found = [[0; 2]; 3];
    for (axis, name) in AXES.iter().enumerate() {
        let (Some(position), Some(deviation)) = (alone.positions[axis], columns.deviations[axis]) else {
            let what = if alone.positions[axis].is_none() { "position" } else { "deviation" };
            let names: Vec<String> = header.iter().map(|name| format!("`{}`", clipped(&name.full))).collect();
            return Err(Lack(format!(
                "a point has three coordinates, and no column has the {what} of {name}; the file has {}: write one, such as `{}`",
                names.join(", "),
                if what == "position" { format!("{name} [mm]") } else { format!("d{name} [um]") }
            )));
        };
        found[axis] = [position, deviation];
    }
    Ok(found)
}

/// Positions of a plate that a machine read, or of a machine that something better measured.
fn of_positions(
    header: &[ColumnName],
    columns: &Columns,
    alone: Alone,
    said: &Said<'_>,
) -> Result<Additions, Lack> {
    let is_true_minus_read = said.is_true_minus_read()?;
    let name = if alone.are_read { "true" } else { "machine" };
    // Usual are the actual position minus the commanded one, and the indication minus the calibrated value.
    let sign = match (is_true_minus_read, alone.are_read) {
        (Some(own), are_read) => {
            if own == are_read {
                1.0
            } else {
                -1.0
            }
        }
        (None, _) => 1.0,
    };
    let mut added = Vec::new();
    let pairs = complete(header, columns, alone)?;
    for ([position, deviation], axis) in pairs.into_iter().zip(AXES) {
        let (own, in_si) = like(header, position, &format!("{name}_{axis}"))?;
        let needs = vec![length(header, position)?, length(header, deviation)?];
        added.push(Added { name: own, needs, of: Box::new(move |of| of[0] + sign * of[1]), in_si });
    }
    let (what, minus, instead) = if alone.are_read {
        ("true positions are the commanded ones", "actual minus commanded", "commanded - actual")
    } else {
        (
            "the machine's readings are the calibrated positions",
            "machine minus calibrated",
            "calibrated - machine",
        )
    };
    let remark = is_true_minus_read.is_none().then(|| {
        format!("{what} plus the deviations ({minus}); where these are the opposite, write `# deviation = {instead}` above the header")
    });
    Ok(Additions { added, behind: columns.deviations.into_iter().flatten().collect(), remark })
}

/// Displacements of a sphere against a nest of sensors while axes turn.
fn of_nest(
    header: &[ColumnName],
    columns: &Columns,
    alone: Alone,
    said: &Said<'_>,
) -> Result<Additions, Lack> {
    let along = said.along()?.ok_or_else(|| {
        Lack(
            "nothing says along which axes the displacements were measured: write `# displacement = table` above the header where the sensors \
             turn with the table, or `# displacement = machine` where they do not"
                .to_owned(),
        )
    })?;
    let [about_x, about_y, about_z] = columns.turns;
    if about_x.is_some() && about_y.is_some() {
        return Err(Lack(
            "tables that turn by a and by b are not read: leave the one that stands still out".to_owned(),
        ));
    }
    let is_true_minus_read = said.is_true_minus_read()?;
    let sign = if is_true_minus_read.unwrap_or(true) { 1.0 } else { -1.0 };
    let pairs = complete(header, columns, alone)?;
    let first = about_x.map(|at| (at, 0)).or(about_y.map(|at| (at, 1)));
    let turning: Vec<(usize, usize)> = first.into_iter().chain(about_z.map(|at| (at, 2))).collect();
    let mut turns = Vec::new();
    let mut of_turns = Vec::new();
    for (at, axis) in turning.into_iter().filter(|_| along == Along::Table) {
        turns.push(angle(header, at)?);
        of_turns.push(axis);
    }
    let mut added = Vec::new();
    for (at, axis) in AXES.into_iter().enumerate() {
        let (name, in_si) = like(header, pairs[at][0], &format!("true_{axis}"))?;
        let mut needs = vec![length(header, pairs[at][0])?];
        for [_, deviation] in pairs {
            needs.push(length(header, deviation)?);
        }
        needs.extend(&turns);
        let of_turns = of_turns.clone();
        let of = move |of: &[f64]| {
            let mut shift = [of[1], of[2], of[3]];
            // The last axis carries the nest, and the first carries the last; a table turns against its sign.
            for (angle, axis) in of[4..].iter().zip(&of_turns).rev() {
                shift = turned(shift, *axis, -angle);
            }
            of[0] + sign * shift[at]
        };
        added.push(Added { name, needs, of: Box::new(of), in_si });
    }
    let remark = is_true_minus_read.is_none().then(|| {
        "displacements are those of the tool against the table; where they are the opposite, write `# deviation = table - tool` above the header"
            .to_owned()
    });
    Ok(Additions { added, behind: columns.deviations.into_iter().flatten().collect(), remark })
}

/// A vector turned about x, y or z.
fn turned([x, y, z]: [f64; 3], axis: usize, angle: f64) -> [f64; 3] {
    let (s, c) = angle.sin_cos();
    match axis {
        0 => [x, c * y - s * z, s * y + c * z],
        1 => [c * x + s * z, y, c * z - s * x],
        _ => [c * x - s * y, s * x + c * y, z],
    }
}

/// Lengths of a bar, and the commanded positions where an angle alone says them.
fn of_bar(
    header: &[ColumnName],
    columns: &Columns,
    deviation: usize,
    said: &Said<'_>,
) -> Result<Option<Additions>, Lack> {
    // What was measured needs no deviation.
    if columns.bar.is_some() {
        return Ok(None);
    }
    let commanded = columns.commanded()?;
    let stated = said.radius_m()?;
    if commanded.is_none() && columns.angle.is_none() {
        return Ok(None);
    }
    let (radius, of_column) = match (stated, columns.radius) {
        (Some(radius), None) => (radius, None),
        (None, Some(at)) => (0.0, Some(length(header, at)?)),
        (Some(_), Some(at)) => {
            return Err(Lack(format!(
                "both a line above the header and the column `{}` state the length of the bar: leave one out",
                clipped(&header[at].full)
            )));
        }
        (None, None) => {
            return Err(Lack(
                "the nominal length of the bar is not stated: write `# radius = 150 mm` above the header, or add a column `radius [mm]`"
                    .to_owned(),
            ));
        }
    };
    let by_column = usize::from(of_column.is_some());
    let deviated = length(header, deviation)?;
    let millimetre = Unit::find("mm").unwrap_or_else(|| unreachable!("mm is a unit"));
    let in_mm = |name: &str| ColumnName::parse(&format!("{name} [mm]"));
    let mut added = vec![Added {
        name: in_mm("bar_length"),
        needs: of_column.into_iter().chain([deviated]).collect(),
        of: Box::new(move |of| if by_column == 1 { of[0] + of[1] } else { radius + of[0] }),
        in_si: millimetre.in_si(),
    }];
    let mut behind = vec![deviation];
    behind.extend(columns.radius);
    let mut remark = None;
    if let (Some(at), None) = (columns.angle, commanded) {
        let plane = said.plane()?;
        behind.push(at);
        for (axis, is_second) in [(plane.axes[0], false), (plane.axes[1], true)] {
            let of = move |of: &[f64]| {
                let (angle, radius) = (of[0], of.get(1).copied().unwrap_or(radius));
                radius * if is_second { angle.sin() } else { angle.cos() }
            };
            added.push(Added {
                name: in_mm(&format!("commanded_{}", AXES[axis])),
                needs: [angle(header, at)?].into_iter().chain(of_column).collect(),
                of: Box::new(of),
                in_si: millimetre.in_si(),
            });
        }
        let [one, other] = plane.axes.map(|axis| AXES[axis]);
        remark = (!plane.is_said).then(|| {
            format!(
                "the angle is taken to run from {one} to {other}: for another plane write `# plane = YZ` or `# plane = ZX` above the header"
            )
        });
    }
    Ok(Some(Additions { added, behind, remark }))
}

/// A table with columns that are computed of others.
struct Reader<'r> {
    table: Box<dyn TableReader + 'r>,
    header: Vec<ColumnName>,
    additions: Additions,
    lacks: Option<String>,
}

impl Reader<'_> {
    /// The numbers of an added column, in its unit.
    fn numbers(&self, added: &Added, needs: &[Cells], chunk: &Chunk) -> Result<Vec<f64>, DataError> {
        let mut of = vec![0.0; needs.len()];
        let mut found = Vec::with_capacity(chunk.rows.len());
        for (at, row) in chunk.rows.iter().enumerate() {
            for (own, cells) in of.iter_mut().zip(needs) {
                let Cells::Numbers(numbers) = cells else { unreachable!("numbers were wanted") };
                *own = numbers[at];
            }
            let number = added.at(&of);
            if !number.is_finite() {
                let (file, column) = (self.table.source().to_owned(), added.name.full.clone());
                let cell = Cell { file, line: chunk.lines.get(at).copied(), row: *row, column };
                return Err(DataError::NotFinite { cell, text: number.to_string() });
            }
            found.push(number);
        }
        Ok(found)
    }
}

impl TableReader for Reader<'_> {
    fn source(&self) -> &str {
        self.table.source()
    }

    fn header(&self) -> &[ColumnName] {
        &self.header
    }

    fn gives_any_label(&self) -> bool {
        self.table.gives_any_label()
    }

    fn latitude_deg(&self) -> Option<f64> {
        self.table.latitude_deg()
    }

    fn remarks(&self) -> Vec<String> {
        let mut remarks = self.table.remarks();
        remarks.extend(self.additions.remark.clone());
        remarks
    }

    fn lacks(&self) -> Option<&str> {
        self.lacks.as_deref()
    }

    fn behind(&self) -> &[usize] {
        &self.additions.behind
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        let first = self.header.len() - self.additions.added.len();
        let mut own = Vec::new();
        for want in wanted {
            match want.column.checked_sub(first) {
                None => own.push(*want),
                Some(at) => {
                    let number =
                        |&(column, in_si): &(usize, f64)| Wanted { column, form: Form::Number(in_si) };
                    own.extend(self.additions.added[at].needs.iter().map(number));
                }
            }
        }
        let mut chunk = self.table.read(&own, at_most)?;
        let mut cells = std::mem::take(&mut chunk.columns).into_iter();
        let mut columns = no_cells(wanted);
        for (want, to) in wanted.iter().zip(&mut columns) {
            let Some(at) = want.column.checked_sub(first) else {
                cells.next().into_iter().for_each(|own| *to = own);
                continue;
            };
            let added = &self.additions.added[at];
            let needs: Vec<Cells> = cells.by_ref().take(added.needs.len()).collect();
            let numbers = self.numbers(added, &needs, &chunk)?;
            *to = match want.form {
                Form::Number(factor) => {
                    Cells::Numbers(numbers.iter().map(|number| number * factor).collect())
                }
                Form::Label => Cells::Labels(numbers.iter().map(f64::to_string).collect()),
                Form::Kept => {
                    let texts: Vec<String> = numbers.iter().map(f64::to_string).collect();
                    Cells::Kept(Kept::Texts(texts.iter().map(String::as_str).collect::<Texts>()))
                }
            };
        }
        chunk.columns = columns;
        Ok(chunk)
    }
}

#[cfg(test)]
mod tests;
