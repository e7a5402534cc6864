//! A table of Denavit and Hartenberg: nominal sizes of each link and their corrections.
//!
//! A link is Rz(theta) Tz(d) Tx(a) Rx(alpha) behind the turn (or shift) of its joint about (or along) z. Where the next axis is nearly parallel,
//! its common normal may lie hundreds of metres away; d keeps its nominal size there, and a turn beta about y takes its place.
//!
//! Source: J. Denavit and R. S. Hartenberg, J. Appl. Mech. 22 (1955) 215; S. A. Hayati, "Robot arm geometric link parameter estimation",
//! 22nd IEEE Conference on Decision and Control (1983) 1477 (the link of nearly parallel axes).

pub(super) mod link;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use model_core::SymbolKind;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use observe::SiUnit;
use report::words::numbers;

use super::{Form, Made, Shown, Subject};
use crate::export::links::{Links, constant_errors};
use crate::refusal::Refusal;
use crate::source::Source;
use link::{Aligned, Link};

pub const FORM: Form = Form {
    name: "dh",
    what: "a table of Denavit-Hartenberg parameters: nominal, correction, calibrated",
    template: None,
    write,
    read,
};

/// The header of the table.
const HEADER: &str = "link,parameter,unit,nominal,correction,calibrated,uncertainty";
/// How a base or a tool is placed: a shift, then turns about z, y and x.
const PLACE: [&str; 6] = ["x", "y", "z", "yaw", "pitch", "roll"];
/// Corrections below this are rounding, rad and m.
const ROUNDING: f64 = 1e-12;
const BASE: &str = "base";
const TOOL: &str = "tool";

/// One number of the table.
struct Row {
    link: String,
    parameter: &'static str,
    value: f64,
}

impl Row {
    fn unit(&self) -> SiUnit {
        if matches!(self.parameter, "x" | "y" | "z" | "d" | "a") { SiUnit::METRE } else { SiUnit::RAD }
    }
}

/// The numbers of a chain with these values, link after link.
fn rows(subject: &Subject, values: &[f64], nominal: &[Link]) -> Result<Vec<Row>, Refusal> {
    let links = Links::of(subject, values)?;
    let Aligned { base, between, tool } = Aligned::of(&links, nominal);
    let mut rows = placed(BASE, &base);
    for (at, (joint, link)) in links.joints.iter().zip(&between).enumerate() {
        let name = &subject.chain.symbol(joint.symbol).name;
        let row = |(parameter, value)| Row { link: format!("{}:{name}", at + 1), parameter, value };
        rows.extend(link.parameters().map(row));
    }
    rows.extend(placed(TOOL, &tool));
    Ok(rows)
}

/// A place as six numbers.
fn placed(link: &str, place: &Isometry3<f64>) -> Vec<Row> {
    let (roll, pitch, yaw) = place.rotation.euler_angles();
    let shift = place.translation.vector;
    let values = [shift.x, shift.y, shift.z, yaw, pitch, roll];
    PLACE
        .into_iter()
        .zip(values)
        .map(|(parameter, value)| Row { link: link.to_owned(), parameter, value })
        .collect()
}

/// The links of the chain as it was declared.
fn nominal(subject: &Subject) -> Result<Vec<Link>, Refusal> {
    let links = Links::of(subject, &subject.without_errors())?;
    Link::nominal(&links).map_err(|at| {
        let name = |at: usize| &subject.chain.symbol(links.joints[at].symbol).name;
        Refusal::Input(format!(
            "the axes of `{}` and `{}` lie in one line, which no table of Denavit and Hartenberg describes",
            name(at),
            name(at + 1)
        ))
    })
}

fn write(subject: &Subject, _: Option<&Source>) -> Result<Made, Refusal> {
    let (values, others) = constant_errors(subject);
    let links = nominal(subject)?;
    let declared = rows(subject, &subject.without_errors(), &links)?;
    let found = rows(subject, &values, &links)?;
    let uncertain = uncertainties(subject, &values, &links, &found)?;
    let mut text = format!("{HEADER}\n");
    let mut said = "Corrections of the links, calibrated minus nominal.\n".to_owned();
    for ((before, after), uncertainty) in declared.iter().zip(&found).zip(&uncertain) {
        let correction = difference(after.value, before.value, after.unit());
        let correction = if correction.abs() < ROUNDING { 0.0 } else { correction };
        let unit = after.unit().to_string();
        let shown = uncertainty.map_or_else(String::new, |uncertainty| format!("{uncertainty:e}"));
        let Row { link, parameter, value } = after;
        let nominal = before.value;
        let _ = writeln!(text, "{link},{parameter},{unit},{nominal},{correction:e},{value},{shown}");
        if correction != 0.0 {
            let told = match uncertainty {
                Some(uncertainty) => numbers::estimate(correction, *uncertainty, after.unit()),
                None => numbers::told(correction, after.unit()),
            };
            let _ = writeln!(said, "  {link:<12} {parameter:<6} {told}");
        }
    }
    let parallel: Vec<String> =
        found.iter().filter(|row| row.parameter == "beta").map(|row| row.link.clone()).collect();
    if !parallel.is_empty() {
        let _ = writeln!(
            said,
            "The next axis is nearly parallel to that of {}. There d keeps its nominal size, and beta turns about y behind alpha.",
            model_core::names::listed(parallel.iter().map(String::as_str))
        );
    }
    Ok(Made { text, said, lost: Some(subject.lost(&others)?) })
}

/// By how much a number grew; angles by the shorter way.
fn difference(after: f64, before: f64, unit: SiUnit) -> f64 {
    let grown = after - before;
    if unit == SiUnit::METRE {
        grown
    } else {
        grown - std::f64::consts::TAU * (grown / std::f64::consts::TAU).round()
    }
}

/// The standard uncertainty of each number, by the covariance of the estimates.
fn uncertainties(
    subject: &Subject,
    values: &[f64],
    nominal: &[Link],
    found: &[Row],
) -> Result<Vec<Option<f64>>, Refusal> {
    let Some(covariance) = &subject.covariance else { return Ok(vec![None; found.len()]) };
    let mut slopes: Vec<Vec<f64>> = Vec::new();
    for (at, symbol) in covariance.of.iter().enumerate() {
        let step = covariance.rows[at][at].sqrt();
        let is_carried = subject.chain.symbol(*symbol).kind == SymbolKind::Constant
            || values[symbol.index()] == subject.values[symbol.index()];
        if step == 0.0 || !is_carried {
            slopes.push(vec![0.0; found.len()]);
            continue;
        }
        let mut moved = values.to_vec();
        moved[symbol.index()] += step;
        let moved = rows(subject, &moved, nominal)?;
        let slope =
            moved.iter().zip(found).map(|(moved, own)| difference(moved.value, own.value, own.unit()) / step);
        slopes.push(slope.collect());
    }
    let variance = |row: usize| {
        let mut sum = 0.0;
        for (one, a) in slopes.iter().enumerate() {
            sum += slopes
                .iter()
                .enumerate()
                .map(|(other, b)| a[row] * b[row] * covariance.rows[one][other])
                .sum::<f64>();
        }
        sum
    };
    Ok((0..found.len()).map(|row| Some(variance(row).max(0.0).sqrt())).collect())
}

fn read(subject: &Subject, text: &str, _: Option<&Source>) -> Result<Shown, Refusal> {
    let wrong =
        |line: &str| Refusal::Input(format!("the file that was written has a line of another form: {line}"));
    let mut numbers: BTreeMap<(&str, &str), f64> = BTreeMap::new();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [link, parameter, _, _, _, value, _] = cells.as_slice() else { return Err(wrong(line)) };
        numbers.insert((link, parameter), value.parse().map_err(|_| wrong(line))?);
    }
    let number = |link: &str, parameter: &str| numbers.get(&(link, parameter)).copied();
    let place = |link: &str| {
        let [x, y, z, yaw, pitch, roll] = PLACE.map(|parameter| number(link, parameter).unwrap_or(f64::NAN));
        let turned = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        Isometry3::from_parts(Translation3::from(Vector3::new(x, y, z)), turned)
    };
    let declared = Links::of(subject, &subject.without_errors())?;
    let mut fixed = vec![place(BASE)];
    for (at, joint) in declared.joints.iter().enumerate() {
        let name = format!("{}:{}", at + 1, subject.chain.symbol(joint.symbol).name);
        let size = |parameter| number(&name, parameter).unwrap_or(0.0);
        let link = Link {
            theta: size("theta"),
            d: size("d"),
            a: size("a"),
            alpha: size("alpha"),
            beta: number(&name, "beta"),
        };
        fixed.push(link.transform());
    }
    if let Some(last) = fixed.last_mut() {
        *last *= place(TOOL);
    }
    let joints =
        declared.joints.iter().map(|joint| crate::export::links::Joint { axis: Vector3::z_axis(), ..*joint });
    let links = Links { joints: joints.collect(), fixed };
    Ok(links.shown(subject))
}
