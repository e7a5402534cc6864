//! Mistakes that people make with the columns of a file, each with the answers that name it.

use testkit::Random;

use crate::data::{Column, Data, unit_si};
use crate::instruments::{Instrument, Observed};

/// The words that name a mistake: any of them is right.
pub type Names = Vec<String>;

pub struct Trap {
    pub name: &'static str,
    pub on: fn(&Instrument) -> bool,
    pub spoil: fn(&mut Data, &mut Random) -> Names,
}

fn angles(data: &mut Data) -> Vec<&mut Column> {
    data.joints.iter_mut().filter(|column| column.unit != Some("m")).collect()
}

fn scaled(column: &mut Column, factor: f64) {
    column.numbers.iter_mut().for_each(|number| *number *= factor);
}

/// Columns whose numbers are in another unit than the study says.
fn written_in(columns: Vec<&mut Column>, unit: &'static str) -> Names {
    let mut names = Vec::new();
    for column in columns {
        let own = column.unit.unwrap_or("rad");
        scaled(column, unit_si(own) / unit_si(unit));
        names.push(column.name.clone());
    }
    vec![format!("{unit}: {}", names.join(" "))]
}

/// Columns of which the study says another unit than they are in.
fn said_to_be(columns: Vec<&mut Column>, unit: &'static str) -> Names {
    let mut names = Vec::new();
    let mut is = "";
    for column in columns {
        is = column.unit.unwrap_or("rad");
        column.unit = Some(unit);
        names.push(column.name.clone());
    }
    vec![format!("{is}: {}", names.join(" "))]
}

/// The same where their headings say the unit that they are not in.
fn headed(mut columns: Vec<&mut Column>, unit: &'static str) -> Names {
    for column in &mut columns {
        let own = column.unit.unwrap_or("rad");
        column.name += &format!(" [{own}]");
    }
    let names = written_in(columns.iter_mut().map(|column| &mut **column).collect(), unit);
    columns.into_iter().for_each(|column| column.unit = None);
    names
}

fn packed(columns: Vec<&mut Column>) -> Names {
    let mut names = Vec::new();
    for column in columns {
        for number in &mut column.numbers {
            let tenths = (number.abs() * 36_000.0).round() as u64;
            let (whole, minutes, left) = (tenths / 36_000, tenths / 600 % 60, tenths % 600);
            let digits = whole as f64 + minutes as f64 / 100.0 + left as f64 / 100_000.0;
            *number = digits.copysign(*number);
        }
        names.push(column.name.clone());
    }
    vec![format!("ddd.mmss: {}", names.join(" "))]
}

fn exchanged(columns: &mut [Column], random: &mut Random) -> Names {
    let one = random.below(columns.len());
    let other = (one + 1 + random.below(columns.len() - 1)) % columns.len();
    let (one, other) = (one.min(other), one.max(other));
    let numbers = columns[one].numbers.clone();
    columns[one].numbers = std::mem::replace(&mut columns[other].numbers, numbers);
    vec![format!("exchanged: {} {}", columns[one].name, columns[other].name)]
}

/// What a column that counts the other way may be called: a declared index hides where it counts from, and of two angles either may turn.
fn reversed(data: &Data, name: &str) -> Names {
    let mut names = vec![format!("reversed: {name}"), format!("zenith: {name}")];
    if data.instrument.observed == Observed::Spherical {
        for column in data.joints.iter().chain(&data.observed) {
            names.extend(["reversed", "zenith"].map(|how| format!("{how}: {}", column.name)));
        }
    }
    names
}

fn shifted(columns: &mut [Column], by: usize) -> Names {
    for column in columns.iter_mut() {
        column.numbers.rotate_left(by);
    }
    vec![format!(
        "rows 1: {}",
        columns.iter().map(|column| column.name.as_str()).collect::<Vec<_>>().join(" ")
    )]
}

/// What was measured, as if the sky were turned about an axis.
fn sky_turned(data: &mut Data, axis: [f64; 3], by_rad: f64) -> Names {
    let is_spherical = data.instrument.observed == Observed::Spherical;
    for row in 0..data.rows {
        let own: Vec<f64> = data.observed.iter().map(|column| column.numbers[row]).collect();
        let vector = match own[..] {
            [azimuth, elevation] => {
                let (azimuth, elevation) = (azimuth.to_radians(), elevation.to_radians());
                [elevation.cos() * azimuth.sin(), elevation.cos() * azimuth.cos(), elevation.sin()]
            }
            [x, y, z] => [x, y, z],
            _ => return Vec::new(),
        };
        let along: f64 = vector.iter().zip(axis).map(|(own, axis)| own * axis).sum();
        let [x, y, z] = vector;
        let [u, v, w] = axis;
        let beside = [v * z - w * y, w * x - u * z, u * y - v * x];
        let turned: [f64; 3] = std::array::from_fn(|at| {
            vector[at] * by_rad.cos() + beside[at] * by_rad.sin() + axis[at] * along * (1.0 - by_rad.cos())
        });
        let numbers = if is_spherical {
            vec![turned[0].atan2(turned[1]).to_degrees(), turned[2].asin().to_degrees()]
        } else {
            turned.to_vec()
        };
        data.observed.iter_mut().zip(numbers).for_each(|(column, number)| column.numbers[row] = number);
    }
    vec!["another frame".to_owned()]
}

fn directions(instrument: &Instrument) -> bool {
    matches!(instrument.observed, Observed::Spherical | Observed::Direction)
}

fn alt_azimuth(instrument: &Instrument) -> bool {
    instrument.name == "alt-azimuth"
}

/// The celestial pole at a latitude of 48 degrees: east, north, up.
fn pole() -> [f64; 3] {
    let latitude = 48.0_f64.to_radians();
    [0.0, latitude.cos(), latitude.sin()]
}

fn any(_: &Instrument) -> bool {
    true
}

fn equatorial(instrument: &Instrument) -> bool {
    instrument.name == "equatorial"
}

fn spherical(instrument: &Instrument) -> bool {
    instrument.observed == Observed::Spherical
}

fn point(instrument: &Instrument) -> bool {
    instrument.observed == Observed::Point
}

fn quaternion(instrument: &Instrument) -> bool {
    instrument.observed == Observed::Quaternion
}

/// Two readings of the words in either order.
fn both(one: &Names, other: &Names) -> Names {
    let pairs = one.iter().flat_map(|one| other.iter().map(move |other| [one, other]));
    pairs.flat_map(|[one, other]| [format!("{one} and {other}"), format!("{other} and {one}")]).collect()
}

fn several(instrument: &Instrument) -> bool {
    instrument.joints.len() > 1
}

/// Two joints that measure the same.
fn two_angles(instrument: &Instrument) -> bool {
    several(instrument) && !(0..instrument.joints.len()).any(|joint| instrument.slides(joint))
}

/// The declared zero of the first joint, of each instrument that has one.
const INDICES: [&str; 6] = ["azimuth_index", "ha_index", "zero1", "pan_index", "zero4", "index"];

pub const TRAPS: &[Trap] = &[
    Trap { name: "joints in gon", on: any, spoil: |data, _| written_in(angles(data), "gon") },
    Trap { name: "joints in gon, headings in deg", on: any, spoil: |data, _| headed(angles(data), "gon") },
    Trap {
        name: "points in mm, headings in m",
        on: point,
        spoil: |data, _| headed(data.observed.iter_mut().collect(), "mm"),
    },
    Trap {
        name: "one joint in rad",
        on: any,
        spoil: |data, random| {
            let mut all = angles(data);
            let at = random.below(all.len());
            written_in(vec![all.swap_remove(at)], "rad")
        },
    },
    Trap {
        name: "joints in degrees, read as rad",
        on: any,
        spoil: |data, _| said_to_be(angles(data), "rad"),
    },
    Trap {
        name: "observed angles in gon",
        on: spherical,
        spoil: |data, _| written_in(data.observed.iter_mut().collect(), "gon"),
    },
    Trap {
        name: "observed in degrees, read as gon",
        on: spherical,
        spoil: |data, _| said_to_be(data.observed.iter_mut().collect(), "gon"),
    },
    Trap {
        name: "all angles in gon",
        on: spherical,
        spoil: |data, _| {
            let all = data.joints.iter_mut().chain(&mut data.observed).collect();
            written_in(all, "gon")
        },
    },
    Trap {
        name: "one angle in hours",
        on: spherical,
        spoil: |data, random| {
            let first = if random.even() < 0.5 { &mut data.joints[0] } else { &mut data.observed[0] };
            written_in(vec![first], "hour")
        },
    },
    Trap {
        name: "points in mm",
        on: point,
        spoil: |data, _| written_in(data.observed.iter_mut().collect(), "mm"),
    },
    Trap {
        name: "points in m, read as mm",
        on: point,
        spoil: |data, _| said_to_be(data.observed.iter_mut().collect(), "mm"),
    },
    Trap {
        name: "points in inches",
        on: point,
        spoil: |data, _| written_in(data.observed.iter_mut().collect(), "inch"),
    },
    Trap {
        name: "x in mm",
        on: point,
        spoil: |data, _| written_in(data.observed.iter_mut().take(1).collect(), "mm"),
    },
    Trap { name: "joints in degrees, minutes, seconds", on: any, spoil: |data, _| packed(angles(data)) },
    Trap {
        name: "observed in degrees, minutes, seconds",
        on: spherical,
        spoil: |data, _| packed(data.observed.iter_mut().collect()),
    },
    Trap {
        name: "joints exchanged",
        on: two_angles,
        spoil: |data, random| exchanged(&mut data.joints, random),
    },
    Trap {
        name: "observed columns exchanged",
        on: any,
        spoil: |data, random| exchanged(&mut data.observed, random),
    },
    Trap {
        name: "a joint counts the other way",
        on: any,
        spoil: |data, random| {
            let at = random.below(angles(data).len());
            scaled(&mut data.joints[at], -1.0);
            reversed(data, &data.joints[at].name)
        },
    },
    Trap {
        name: "an observed column with the other sign",
        on: any,
        spoil: |data, random| {
            let at = random.below(data.observed.len());
            scaled(&mut data.observed[at], -1.0);
            reversed(data, &data.observed[at].name)
        },
    },
    Trap {
        name: "an angle from the zenith",
        on: several,
        spoil: |data, _| {
            data.joints[1].numbers.iter_mut().for_each(|number| *number = 90.0 - *number);
            reversed(data, &data.joints[1].name)
        },
    },
    Trap {
        name: "a joint a quarter turn off, without an index",
        on: |instrument| !instrument.indexed,
        spoil: |data, random| {
            let at = [0, 2][random.below(2)];
            let by = [90.0, -90.0][random.below(2)];
            data.joints[at].numbers.iter_mut().for_each(|number| *number += by);
            vec![format!("turned: {}", data.joints[at].name)]
        },
    },
    Trap {
        name: "points in mm, and a component with the other sign",
        on: point,
        spoil: |data, random| {
            let unit = written_in(data.observed.iter_mut().collect(), "mm");
            let at = random.below(3);
            scaled(&mut data.observed[at], -1.0);
            both(&unit, &vec![format!("reversed: {}", data.observed[at].name)])
        },
    },
    Trap {
        name: "joints in gon, and one counts the other way",
        on: two_angles,
        spoil: |data, random| {
            let unit = written_in(angles(data), "gon");
            let at = random.below(data.joints.len());
            scaled(&mut data.joints[at], -1.0);
            both(&unit, &reversed(data, &data.joints[at].name))
        },
    },
    Trap {
        name: "a quaternion with its scalar last",
        on: quaternion,
        spoil: |data, _| {
            let w = std::mem::take(&mut data.observed[0].numbers);
            for at in 0..3 {
                data.observed[at].numbers = std::mem::take(&mut data.observed[at + 1].numbers);
            }
            data.observed[3].numbers = w;
            vec!["order: x, y, z, w".to_owned()]
        },
    },
    Trap {
        name: "a quaternion of the inverse rotation",
        on: quaternion,
        spoil: |data, _| {
            data.observed[1..].iter_mut().for_each(|column| scaled(column, -1.0));
            vec!["inverse".to_owned()]
        },
    },
    Trap {
        name: "a joint rests on either side of a play of half a degree",
        on: |instrument| instrument.indexed,
        spoil: |data, random| {
            for number in &mut data.joints[0].numbers {
                *number += if random.even() < 0.5 { 0.25 } else { -0.25 };
            }
            INDICES.iter().map(|index| format!("two kinds: {index}")).collect()
        },
    },
    Trap {
        name: "two prism constants, 34.4 mm apart",
        on: |instrument| instrument.name == "total station",
        spoil: |data, random| {
            for row in 0..data.rows {
                let range_m =
                    data.observed.iter().map(|column| column.numbers[row].powi(2)).sum::<f64>().sqrt();
                if random.even() < 0.4 {
                    data.observed.iter_mut().for_each(|column| column.numbers[row] *= 1.0 + 0.0344 / range_m);
                }
            }
            vec!["two kinds: zero".to_owned()]
        },
    },
    Trap {
        name: "a clock one to six hours off",
        on: alt_azimuth,
        spoil: |data, random| {
            let hours = (1 + random.below(6)) as f64 * [1.0, -1.0][random.below(2)];
            sky_turned(data, pole(), (15.0 * hours).to_radians())
        },
    },
    Trap {
        name: "the latitude of the other hemisphere",
        on: alt_azimuth,
        spoil: |data, _| sky_turned(data, [1.0, 0.0, 0.0], 96.0_f64.to_radians()),
    },
    Trap {
        name: "directions in a frame that is turned anyhow",
        on: directions,
        spoil: |data, random| {
            let axis = [random.normal(), random.normal(), random.normal()];
            let size = axis.iter().map(|value| value * value).sum::<f64>().sqrt();
            sky_turned(data, axis.map(|value| value / size), 0.3 + 2.0 * random.even())
        },
    },
    Trap {
        name: "right ascensions for hour angles, sidereal time in hours beside",
        on: equatorial,
        spoil: |data, random| {
            let began = 24.0 * random.even();
            let along: Vec<f64> =
                (0..data.rows).map(|row| began + 5.0 * row as f64 / data.rows as f64).collect();
            let sidereal_hours: Vec<f64> = along.iter().map(|hours| hours.rem_euclid(24.0)).collect();
            let (joint, shown) = (&mut data.joints[0], &mut data.observed[0]);
            for column in [&mut *joint, &mut *shown] {
                let own = column.numbers.iter_mut().zip(&sidereal_hours);
                own.for_each(|(angle, hours)| *angle = (15.0 * hours - *angle).rem_euclid(360.0));
            }
            let names = vec![format!("right ascension: {} {}", joint.name, shown.name)];
            data.beside =
                vec![Column { name: "lst".to_owned(), key: "", unit: None, numbers: sidereal_hours }];
            names
        },
    },
    Trap { name: "joints one row off", on: any, spoil: |data, _| shifted(&mut data.joints, 1) },
    Trap {
        name: "one joint one row off",
        on: several,
        spoil: |data, random| {
            let at = random.below(data.joints.len());
            shifted(&mut data.joints[at..=at], 1)
        },
    },
    Trap {
        name: "a joint in encoder counts",
        on: any,
        spoil: |data, random| {
            let counts = 2_f64.powi(14 + 2 * random.below(5) as i32);
            data.joints[0].numbers.iter_mut().for_each(|number| *number = (*number / 360.0 * counts).round());
            vec![format!("counts: {}", data.joints[0].name)]
        },
    },
    Trap {
        name: "a joint in gon from a row on",
        on: any,
        spoil: |data, random| {
            let from = (data.rows as f64 * (0.3 + 0.5 * random.even())) as usize;
            data.joints[0].numbers[from..].iter_mut().for_each(|number| *number /= 0.9);
            vec![format!("from a row, gon: {}", data.joints[0].name)]
        },
    },
];
