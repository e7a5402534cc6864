//! Budgets for programs: one CSV table in SI, and JSON.

use std::fmt::Write as _;

use model_core::Chain;
use model_core::budget::{Budget, Poses, Summary};
use serde_json::{Value, json};

use super::{Designed, Measured};
use crate::tolerance::{Sample, Simulation};

/// Parts of the draws that are told.
pub const PARTS: [f64; 6] = [0.5, 0.68, 0.9, 0.95, 0.99, 0.997];

/// All budgets as one table, in SI.
pub fn as_csv(chain: &Chain, measured: &[Measured]) -> String {
    let mut out = "observable,error,size,size_unit,sup,rms,unit\n".to_owned();
    for Measured { budget, .. } in measured {
        let (name, unit) = (&chain.observable(budget.observable).name, budget.unit(chain));
        for influence in &budget.influences {
            let symbol = chain.symbol(influence.error);
            let Summary { sup, rms, .. } = influence.summary;
            let _ = writeln!(
                out,
                "{name},{},{:?},{},{sup:?},{rms:?},{unit}",
                symbol.name,
                influence.size,
                symbol.quantity.unit()
            );
        }
        for (label, summary) in
            [("worst case", &budget.worst_case), ("root sum square", &budget.root_sum_square)]
        {
            let _ = writeln!(out, "{name},{label},,,{:?},{:?},{unit}", summary.sup, summary.rms);
        }
    }
    out
}

/// One observable.
pub fn as_json(chain: &Chain, measured: &Measured, poses: &Poses) -> Value {
    let Measured { budget, designed, .. } = measured;
    let summary = |summary: &Summary| json!({"sup": summary.sup, "rms": summary.rms, "at": place(chain, budget, poses, summary)});
    let errors: Vec<Value> = budget
        .influences
        .iter()
        .map(|influence| {
            let symbol = chain.symbol(influence.error);
            let mut value = summary(&influence.summary);
            value["name"] = symbol.name.clone().into();
            value["size"] = influence.size.into();
            value["size_unit"] = symbol.quantity.unit().into();
            value
        })
        .collect();
    let mut value = json!({
        "is_sampled": budget.is_sampled,
        "name": chain.observable(budget.observable).name,
        "unit": budget.unit(chain),
        "errors": errors,
        "worst_case": summary(&budget.worst_case),
        "root_sum_square": summary(&budget.root_sum_square),
    });
    if let Some(designed) = designed {
        value["tolerances"] = of_tolerances(chain, designed);
    }
    value
}

fn of_tolerances(chain: &Chain, designed: &Designed) -> Value {
    let name = |at: usize| chain.symbol(designed.tolerances[at].error).name.clone();
    let worst = designed.worst.iter().copied().fold(0.0, f64::max);
    let wanted = designed.wanted.as_ref().map(|(wanted, _)| *wanted);
    let errors: Vec<Value> = (0..designed.tolerances.len())
        .map(|at| {
            let tolerance = &designed.tolerances[at];
            let mut value = json!({
                "name": name(at),
                "size": tolerance.size,
                "standard_deviation": tolerance.standard_deviation(),
                "share": designed.now.shares[at],
            });
            if let Some((_, allocation)) = &designed.wanted {
                value["size_for_wanted"] = allocation.sizes[at].into();
            }
            if let Some(remaining) = &designed.remaining {
                value["standard_deviation_after"] = remaining.after.standard_deviations[at].into();
                value["share_after"] = remaining.after.spread.shares[at].into();
            }
            value
        })
        .collect();
    let mut value = json!({
        "poses": designed.sensitivity.poses(),
        "registered": designed.registered,
        "root_sum_square": {"rms": designed.now.rms, "largest": designed.now.largest().1},
        "worst_case": {"largest": worst},
        "errors": errors,
    });
    if let Some(drawn) = &designed.drawn {
        value["drawn"] = simulation(drawn, wanted);
    }
    if let Some((wanted, allocation)) = &designed.wanted {
        value["wanted"] = json!({
            "root_sum_square": wanted,
            "cost_now": allocation.costs.0,
            "cost_then": allocation.costs.1,
        });
    }
    if let Some(remaining) = &designed.remaining {
        value["after_calibration"] = json!({
            "poses": remaining.poses,
            "noise": remaining.sigma,
            "root_sum_square": {"rms": remaining.after.spread.rms, "largest": remaining.after.spread.largest().1},
            "share_of_noise": remaining.after.share_of_noise,
        });
        if let Some(drawn) = &remaining.drawn {
            value["after_calibration"]["drawn"] = simulation(drawn, wanted);
        }
    }
    value
}

/// What was drawn, by what is looked at.
pub fn samples(drawn: &Simulation) -> [(&'static str, &Sample); 3] {
    [("single", &drawn.single), ("rms", &drawn.rms), ("largest", &drawn.largest)]
}

fn simulation(drawn: &Simulation, wanted: Option<f64>) -> Value {
    samples(drawn)
        .into_iter()
        .map(|(name, sample)| {
            let percentiles: serde_json::Map<String, Value> = PARTS
                .iter()
                .map(|part| (format!("{}", (1000.0 * part).round() / 10.0), sample.percentile(*part).into()))
                .collect();
            let mut value = json!({ "percentiles": percentiles });
            if let Some(wanted) = wanted {
                value["yield"] = sample.within(wanted).into();
            }
            (name.to_owned(), value)
        })
        .collect::<serde_json::Map<String, Value>>()
        .into()
}

/// Where the largest value is taken, by name.
fn place(chain: &Chain, budget: &Budget, poses: &Poses, summary: &Summary) -> Value {
    let names: Vec<&str> = match poses {
        Poses::Path(_) => vec!["t"],
        Poses::Ranges(_) => budget.parameters.iter().map(|&id| chain.symbol(id).name.as_str()).collect(),
    };
    names.into_iter().map(str::to_owned).zip(summary.at.iter().map(|&value| Value::from(value))).collect()
}
