//! A check for programs: SI, with the units written out.

use serde_json::{Map, Value, json};

use super::{Part, Verdict, Verified, policy};

/// A check as JSON.
#[must_use]
pub fn as_json(verified: &Verified) -> Value {
    let verdict = match verified.verdict {
        Verdict::StillValid | Verdict::BelowGoal => "still valid",
        Verdict::Recalibrate => "recalibrate",
        Verdict::CannotSay | Verdict::NoRows | Verdict::Misread => "cannot say",
    };
    let reason = match verified.verdict {
        Verdict::StillValid => "agrees",
        Verdict::BelowGoal => "changed by less than the goal",
        Verdict::Recalibrate => "disagrees",
        Verdict::CannotSay => "these rows could not have shown it",
        Verdict::NoRows => "no row inside the measured region",
        Verdict::Misread => "column misread",
    };
    let errors = verified.errors.iter().map(|error| {
        json!({
            "name": error.name,
            "unit": error.unit,
            "change": error.change.map(|[by, _]| by),
            "standard_uncertainty": error.change.map(|[_, uncertainty]| uncertainty),
            "gain": error.gain,
            "would_show": Some(error.shown).filter(|shown| shown.is_finite()),
            "least_to_show": error.least,
        })
    });
    let explaining: Vec<&str> =
        verified.explaining.iter().map(|at| verified.errors[*at].name.as_str()).collect();
    json!({
        "verdict": verdict,
        "reason": reason,
        "p_value": verified.p_value,
        "false_alarm": verified.false_alarm,
        "power": policy::POWER,
        "observable": verified.observable,
        "unit": verified.unit,
        "goal": verified.goal,
        "rows": { "judged": verified.judged, "outside": verified.outside, "undefined": verified.undefined },
        "rms": verified.rms,
        "explained": part(&verified.explained),
        "rest": part(&verified.rest),
        "change_rms": verified.change[0],
        "change_standard_uncertainty": verified.change[1],
        "errors": errors.collect::<Vec<_>>(),
        "explained_by": explaining,
        "explained_by_row": verified.one_row,
        "rows_to_add": verified.added.as_ref().map(|added| {
            let pose = |pose: &Vec<f64>| -> Value {
                let named = added.names.iter().cloned().zip(pose.iter().map(|value| json!(value)));
                Value::Object(named.collect::<Map<String, Value>>())
            };
            json!({ "enough": added.is_enough, "poses": added.poses.iter().map(pose).collect::<Vec<_>>() })
        }),
    })
}

fn part(part: &Part) -> Value {
    json!({ "chi_squared": part.sum, "degrees_of_freedom": part.freedom, "p_value": part.p_value })
}
