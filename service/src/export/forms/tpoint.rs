//! The terms of TPOINT, the usual pointing model of telescopes.
//!
//! Source of the terms and their signs: see `effects/src/catalogue/names/tpoint.rs`. Source of the file: Software Bisque, TPoint user guide,
//! and ROTSE-III, "A simple TPOINT model": a caption; a line with the method, how many stars, the RMS and two constants of refraction; a
//! line for each term with its name, value and standard uncertainty in arc seconds; `END`.

mod acts;
mod carried;

use std::f64::consts::PI;
use std::fmt::Write as _;

use effects::candidate::Setting;
use effects::catalogue::PointingTerms;
use model_core::{ObservableKind, forms};
use observe::SiUnit;
use report::words::numbers;

use super::{Form, Made, Shown, Subject};
use crate::refusal::Refusal;
use crate::source::Source;
use carried::{Carried, Value, carried};

pub const FORM: Form = Form {
    name: "tpoint",
    what: "terms of TPOINT with their signs, for a mount of two axes",
    template: None,
    write,
    read,
};

const ARCSEC: f64 = PI / 648_000.0;

/// The terms that belong to what is observed.
fn terms(subject: &Subject) -> Result<PointingTerms, Refusal> {
    let observables = [subject.observable];
    let setting = Setting {
        chain: &subject.chain,
        observables: &observables,
        inputs: &[],
        harmonics: 0,
        lines: &[],
        own: &[],
    };
    PointingTerms::of(&setting).ok_or_else(|| {
        let what = match subject.chain.observable(subject.observable).kind {
            ObservableKind::Point => "a point, and TPOINT describes directions",
            ObservableKind::Direction => "a line of sight that runs in another way",
        };
        Refusal::Input(format!(
            "chain {} shows {what}. TPOINT needs two joints, and without errors the direction (sin a cos e, cos a cos e, sin e): an alt-azimuth \
             mount has z up, y north and x east; an equatorial one has z at the pole, y on the meridian, x west, and a constant latitude in its \
             gravity",
            subject.chain.name
        ))
    })
}

fn write(subject: &Subject, _: Option<&Source>) -> Result<Made, Refusal> {
    let terms = terms(subject)?;
    let form = forms::derive(&subject.chain, subject.observable, 1).map_err(Refusal::of)?;
    let Carried { values, lost } = carried(subject, &terms, &form);
    let mut text =
        format!("{}\nT{:>6}{:>11.4}{:>9.3}{:>9.4}\n", caption(&subject.chain.name), 0, 0.0, 0.0, 0.0);
    for Value { term, value, uncertainty, .. } in &values {
        let name = &terms.terms[*term].name;
        let (value, uncertainty) = (value / ARCSEC, uncertainty.unwrap_or(0.0) / ARCSEC);
        let _ = writeln!(text, "  {name:<8}{value:>+16.6}{uncertainty:>14.6}");
    }
    text.push_str("END\n");
    Ok(Made { text, said: said(subject, &terms, &values), lost: Some(subject.lost(&lost)?) })
}

/// A name on one line of plain letters.
fn caption(name: &str) -> String {
    name.chars().map(|letter| if letter.is_ascii_graphic() { letter } else { '_' }).collect()
}

/// The terms for people, each with what to do about it.
fn said(subject: &Subject, terms: &PointingTerms, values: &[Value]) -> String {
    let latitude_rad = terms.latitude.map(|id| subject.values[id.index()]);
    let mut text = "Terms of TPOINT. What they add to a reading makes it the true place.\n".to_owned();
    let told = |value: &Value| match value.uncertainty {
        Some(uncertainty) => numbers::estimate(value.value, uncertainty, SiUnit::RAD),
        None => numbers::told(value.value, SiUnit::RAD),
    };
    for value in values {
        let term = &terms.terms[value.term];
        let act = acts::act(&term.name, value, latitude_rad);
        let _ = writeln!(text, "  {:8} {}, {}\n    {act}", term.name, told(value), term.meaning);
    }
    if values.is_empty() {
        text.push_str("  none: no error of this instrument is a term\n");
    }
    text
}

fn read(subject: &Subject, text: &str, _: Option<&Source>) -> Result<Shown, Refusal> {
    let terms = terms(subject)?;
    let nominal = forms::nominal(&subject.chain, subject.observable).map_err(Refusal::of)?;
    let mut values = Vec::new();
    for line in text.lines().skip(2).take_while(|line| line.trim() != "END") {
        let mut words = line.split_whitespace();
        let term = words.next().and_then(|name| terms.terms.iter().find(|term| term.name == name));
        let value = words.next().and_then(|value| value.parse::<f64>().ok());
        let (Some(term), Some(value)) = (term, value) else {
            return Err(Refusal::Input(format!(
                "the file that was written has a line of another form: {line}"
            )));
        };
        values.push((term, value * ARCSEC));
    }
    let without = subject.without_errors();
    let shown = (0..subject.poses.count).map(|pose| {
        let at = subject.at(pose, &without);
        let mut change = [0.0; 2];
        for (term, value) in &values {
            change.iter_mut().zip(&term.change).for_each(|(sum, unit)| *sum += value * unit.eval(&at));
        }
        let vector = |parts: &[model_core::algebra::Poly; 3]| parts.each_ref().map(|part| part.eval(&at));
        let (mut shown, [across, along]) = (vector(&nominal), terms.frame().each_ref().map(vector));
        for axis in 0..3 {
            shown[axis] += change[0] * across[axis] + change[1] * along[axis];
        }
        shown
    });
    Ok(shown.collect())
}
