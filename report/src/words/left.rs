//! What is left after the effects, in words.

use super::numbers;
use calibration::diagnose::{Diagnosis, Form};
use observe::SiUnit;

/// What is left, a sentence each.
#[must_use]
pub fn remaining(diagnosis: &Diagnosis) -> Vec<String> {
    let Some(remaining) = &diagnosis.remaining else { return Vec::new() };
    if remaining.looked.is_empty() {
        return vec!["too few rows, or groups of rows, to tell whether what is left is noise".to_owned()];
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
            "what is left sits in body {}, {}, and follows {}: a {} fits better than the catalogue ({chance} for what the \
             catalogue leaves{sampled})",
            place.body,
            place.dof,
            place.driver,
            function_form(&place.form)
        )];
    }
    let structure = diagnosis.search.is_some_and(|search| remaining.p_value <= search.false_alarm);
    if !structure {
        return vec![format!("what is left looks like noise ({chance}{sampled})")];
    }
    let most = remaining.looked.iter().min_by(|a, b| a.p_value.total_cmp(&b.p_value));
    let most = most.map_or_else(String::new, |most| format!(", most of all: {}", most.at));
    vec![format!(
        "what is left has structure that no function at one place explains ({chance}{sampled}){most}"
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
