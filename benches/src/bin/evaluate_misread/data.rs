//! The files of a simulated study: what an instrument reads and shows, as a table, and the study that says how to read it.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write as _;

use testkit::Random;

use crate::instruments::{Instrument, Observed};

/// A column of the table.
#[derive(Clone)]
pub struct Column {
    pub name: String,
    /// The key of the study that reads it.
    pub key: &'static str,
    /// The unit that the study reads it in; none where it has none.
    pub unit: Option<&'static str>,
    /// As the file has them.
    pub numbers: Vec<f64>,
}

#[derive(Clone)]
pub struct Data {
    pub instrument: &'static Instrument,
    pub joints: Vec<Column>,
    pub observed: Vec<Column>,
    /// Columns that the study does not name.
    pub beside: Vec<Column>,
    pub rows: usize,
}

/// What is unusual of an instrument, and no mistake.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Habit {
    Plain,
    /// The first joint's home lies a quarter or half turn away, in its declared index.
    Home,
    /// Readings of the first joint are within half a turn of zero.
    Wrapped,
    /// Readings of the first joint are whole turns off.
    Turns,
    /// The first joint's scale is off by 1 %.
    Scale,
    /// The first joint has backlash of half a degree.
    Backlash,
    /// An undeclared function of a joint of 30 times the noise.
    Strong,
}

pub const HABITS: &[(Habit, &str)] = &[
    (Habit::Plain, "nothing unusual, up to two undeclared effects"),
    (Habit::Strong, "an undeclared effect of 30 times the noise"),
    (Habit::Home, "a home a quarter or half turn away, with a declared index"),
    (Habit::Wrapped, "readings wrapped at half a turn"),
    (Habit::Turns, "readings whole turns off"),
    (Habit::Scale, "a scale off by 1 %"),
    (Habit::Backlash, "backlash of half a degree"),
];

impl Data {
    /// A study of a seed in which everything is as the study says.
    pub fn simulated(
        instrument: &'static Instrument,
        rows: usize,
        habit: Habit,
        random: &mut Random,
    ) -> Self {
        let kinds = instrument.errors();
        let errors: Vec<f64> =
            kinds.iter().map(|is_length| random.normal() * if *is_length { 3e-4 } else { 5e-4 }).collect();
        let in_order = random.even() < 0.5;
        let mut joints: Vec<Vec<f64>> = vec![Vec::new(); instrument.joints.len()];
        for row in 0..rows {
            for (at, (_, low, high)) in instrument.joints.iter().enumerate() {
                let even = random.even();
                let along = if in_order && at == 0 { (row as f64 + even) / rows as f64 } else { even };
                let value = low + (high - low) * along;
                joints[at].push(if instrument.slides(at) { value } else { value.to_radians() });
            }
        }
        let effects: Vec<(usize, f64, f64, f64)> = (0..random.below(3))
            .map(|_| {
                let size = if habit == Habit::Strong { 30.0 } else { 10_f64.powf(random.even()) };
                let on = random.below(instrument.joints.len());
                (on, size * instrument.noise, 1.0 + random.below(2) as f64, TAU * random.even())
            })
            .collect();
        let quarter = FRAC_PI_2 * [1.0, -1.0, 2.0][random.below(3)];
        let mut read = joints.clone();
        for row in 0..rows {
            let first = joints[0][row];
            read[0][row] = match habit {
                Habit::Home => first + quarter,
                Habit::Wrapped => (first + PI).rem_euclid(TAU) - PI,
                Habit::Turns => first + TAU * (random.below(9) as f64 - 4.0),
                Habit::Scale => first * 1.01,
                Habit::Backlash => {
                    first + if random.even() < 0.5 { 0.25_f64.to_radians() } else { -0.25_f64.to_radians() }
                }
                Habit::Plain | Habit::Strong => first,
            };
        }
        let mut observed: Vec<Vec<f64>> = vec![Vec::new(); instrument.observed_names.len()];
        for row in 0..rows {
            let mut at: Vec<f64> = joints.iter().map(|joint| joint[row]).collect();
            for (on, size, order, phase) in &effects {
                if !instrument.slides(*on) {
                    at[*on] += size * (order * at[*on] + phase).sin();
                }
            }
            for (column, value) in observed.iter_mut().zip(instrument.observed_at(&at, &errors, random)) {
                column.push(value);
            }
        }
        let joint = |(at, values): (usize, Vec<f64>)| {
            let (name, ..) = instrument.joints[at];
            let unit = if instrument.slides(at) { "m" } else { "deg" };
            Column {
                name: format!("{name}_read"),
                key: name,
                unit: Some(unit),
                numbers: in_unit(&values, unit),
            }
        };
        let shown = |(at, values): (usize, Vec<f64>)| {
            let name = instrument.observed_names[at];
            let unit = match instrument.observed {
                Observed::Spherical => Some("deg"),
                Observed::Direction | Observed::Quaternion => None,
                Observed::Point => Some("m"),
            };
            let numbers = unit.map_or_else(|| values.clone(), |unit| in_unit(&values, unit));
            Column { name: format!("{name}_true"), key: name, unit, numbers }
        };
        Self {
            instrument,
            joints: read.into_iter().enumerate().map(joint).collect(),
            observed: observed.into_iter().enumerate().map(shown).collect(),
            beside: Vec::new(),
            rows,
        }
    }

    pub fn table(&self) -> String {
        let columns = || self.joints.iter().chain(&self.observed).chain(&self.beside);
        let mut text = columns().map(|column| column.name.as_str()).collect::<Vec<_>>().join(",");
        for row in 0..self.rows {
            let cells: Vec<String> = columns().map(|column| format!("{:.9}", column.numbers[row])).collect();
            let _ = write!(text, "\n{}", cells.join(","));
        }
        text + "\n"
    }

    pub fn study(&self) -> String {
        let line = |column: &Column| {
            let unit = column.unit.map(|unit| format!(", unit = \"{unit}\"")).unwrap_or_default();
            format!("{} = {{ column = \"{}\"{unit} }}\n", column.key, column.name)
        };
        let kind = match self.instrument.observed {
            Observed::Spherical => "spherical",
            Observed::Direction => "direction",
            Observed::Point => "point",
            Observed::Quaternion => "orientation",
        };
        let mut text = "chain = \"instrument.chain\"\ndata = \"data.csv\"\n[columns]\n".to_owned();
        self.joints.iter().for_each(|column| text += &line(column));
        let _ = writeln!(text, "[observed]\nkind = \"{kind}\"");
        self.observed.iter().for_each(|column| text += &line(column));
        text
    }
}

/// How many rad or m a unit of the simulators is.
pub fn unit_si(unit: &str) -> f64 {
    match unit {
        "deg" => PI / 180.0,
        "gon" => PI / 200.0,
        "hour" => PI / 12.0,
        "arcmin" => PI / 10_800.0,
        "mm" => 1e-3,
        "inch" => 0.0254,
        _ => 1.0,
    }
}

fn in_unit(values: &[f64], unit: &str) -> Vec<f64> {
    values.iter().map(|value| value / unit_si(unit)).collect()
}
