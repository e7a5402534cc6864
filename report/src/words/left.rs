//! What is left after the effects, in words.

use super::effects::moves;
use super::numbers;
use calibration::diagnose::{Diagnosis, Form};
use observe::SiUnit;

/// What is left, a sentence each.
#[must_use]
pub fn remaining(diagnosis: &Diagnosis) -> Vec<String> {
    let Some(remaining) = &diagnosis.remaining else { return Vec::new() };
    if remaining.looked.is_empty() {
        return vec![
            "there are too few rows, or groups of rows, to judge whether the residual is noise".to_owned(),
        ];
    }
    let chance = numbers::chance(remaining.p_value);
    let rows = diagnosis.observations.rows;
    let sampled = if remaining.rows < rows {
        format!(", in a sample of {} of {rows} rows", remaining.rows)
    } else {
        String::new()
    };
    if let Some(place) = &remaining.place {
        return vec![format!(
            "the body {} still {} with {}. A {} fits better than the catalogue, whose residual has a pattern ({chance}{sampled})",
            place.body,
            moves(&place.dof),
            place.driver,
            function_form(&place.form)
        )];
    }
    let structure = diagnosis.search.is_some_and(|search| remaining.p_value <= search.false_alarm);
    if !structure {
        return vec![format!("the residual looks like noise ({chance}{sampled})")];
    }
    let most = remaining.looked.iter().min_by(|a, b| a.p_value.total_cmp(&b.p_value));
    let most = most.map_or_else(String::new, |most| format!(". It is clearest in {}", most.at));
    vec![format!(
        "the residual has a pattern that no function at one place explains ({chance}{sampled}){most}"
    )]
}

/// `bump at −145°, 6.9° wide`; drivers are angles or plain numbers.
#[must_use]
pub fn function_form(form: &Form) -> String {
    match form {
        Form::Fourier { order } => format!("Fourier series of order {order}"),
        Form::Cosines { order } => format!("series of cosines of order {order}"),
        Form::Bump { centre, width, unit } => {
            let size = if *unit == SiUnit::RAD { 1.0 } else { centre.abs().max(*width) };
            let reading = numbers::reading(*unit, size);
            format!(
                "bump at {}, {} wide",
                numbers::told_in(*centre, &reading),
                numbers::told_in(*width, &reading)
            )
        }
        Form::Product { form } => form.to_string(),
    }
}
