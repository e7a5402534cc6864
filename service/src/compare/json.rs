//! A comparison for programs: SI, with the units written out.

use serde_json::{Map, Value, json};

use super::{Comparison, FALSE_ALARM, Observed};

/// A comparison as JSON.
#[must_use]
pub fn as_json(comparison: &Comparison) -> Value {
    let values = comparison.values.iter().map(|value| {
        let points = value.points.iter().map(|point| match point {
            None => Value::Null,
            Some(point) => {
                json!({ "value": point.value, "standard_uncertainty": point.standard_uncertainty })
            }
        });
        json!({
            "name": value.name,
            "unit": value.unit,
            "files": points.collect::<Vec<_>>(),
            "change": value.change.map(|[by, _]| by),
            "standard_uncertainty": value.change.map(|[_, uncertainty]| uncertainty),
            "p_value": value.p_value,
            "p_corrected": value.corrected,
            "changed": value.is_changed(),
            "drift_per_month": value.drift.map(|drift| drift.per_month),
            "drift_standard_uncertainty": value.drift.map(|drift| drift.standard_uncertainty),
        })
    });
    let region = comparison
        .region
        .iter()
        .map(|(name, unit, [low, high])| json!({ "name": name, "unit": unit, "from": low, "to": high }));
    let files = comparison.files.iter().map(|(name, date)| json!({ "path": name, "date": date }));
    json!({
        "changed": comparison.is_changed(),
        "false_alarm": FALSE_ALARM,
        "files": files.collect::<Vec<_>>(),
        "joint": comparison.joint.map(|joint| json!({
            "chi_squared": joint.chi_squared,
            "degrees_of_freedom": joint.freedom,
            "p_value": joint.p_value,
            "changed": comparison.is_changed_jointly(),
        })),
        "values": values.collect::<Vec<_>>(),
        "observables": comparison.observed.iter().map(observed).collect::<Vec<_>>(),
        "region": region.collect::<Vec<_>>(),
    })
}

fn observed(own: &Observed) -> Value {
    let at: Map<String, Value> = own.at.iter().map(|(name, value)| (name.clone(), json!(value))).collect();
    json!({
        "name": own.name,
        "unit": own.unit,
        "rms": own.rms[0],
        "rms_standard_uncertainty": own.rms[1],
        "expected_rms": own.expected_rms,
        "largest": own.largest[0],
        "largest_standard_uncertainty": own.largest[1],
        "largest_at": at,
    })
}
