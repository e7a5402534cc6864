//! The columns of `[observed]`: which they are, what they measure, and what they are called where the study does not say.

use model_core::{Axis, Chain, ObservableId, Quantity};
use toml::Spanned;

use super::column_plan::{ColumnPlan, column_plan};
use super::kind::observes;
use super::mistakes::{Outcome, every, mistake};
use super::orientation::{self, Form};
use super::shown;
use super::written::{Column, Observed};
use observe::Measure;
use observe::kinds::{Asked, Key, Observes, Written};

/// What a source observes, and in which columns.
pub(super) struct ObservedColumns {
    pub measure: Measure,
    /// How that is written.
    pub way: &'static Written,
    /// In their order.
    pub columns: Vec<ColumnPlan>,
    /// The key of each in `[observed]`.
    pub keys: Vec<&'static str>,
    /// How an orientation is written, where one is observed.
    pub orientation: Option<Form>,
}

/// The columns of `[observed]` in their order, and what they measure.
pub(super) fn observed_columns(
    chain: &Chain,
    id: ObservableId,
    written: &Spanned<Observed>,
) -> Outcome<ObservedColumns> {
    let (observed, place) = (written.get_ref(), written.span());
    let observable = chain.observable(id);
    // An observable that shows an azimuth and an elevation has a column of its own name for each.
    let shows_two = !observable.is_vector() && observable.shown.len() == 2;
    let asked = Asked { names: &|key| observed.names(key), shows_two };
    let Some((measure, way)) = observed.kind.way(observes(observable), &asked) else {
        unreachable!("the kind was held to the observable")
    };
    let mut orientation = None;
    let (quantity, keys) = if way.of == Observes::Orientation {
        let (form, keys) = orientation::form(observed, &place)?;
        orientation = Some(form);
        (form.quantity(), keys)
    } else {
        let all = observed.columns();
        let column = |key: &Key| all.iter().copied().find(|(name, _)| *name == key.name);
        (way.quantity, way.columns(&asked).iter().filter_map(column).collect())
    };
    let unread = observed
        .columns()
        .into_iter()
        .find(|(key, column)| column.is_some() && keys.iter().all(|(read, _)| read != key));
    if let Some((key, _)) = unread {
        let read: Vec<String> = keys.iter().map(|(key, _)| format!("`{key}`")).collect();
        let help = if read.is_empty() {
            "leave it out, or write another kind".to_owned()
        } else {
            format!("it reads {}: leave the other out, or write another kind", read.join(", "))
        };
        return Err(mistake(place, format!("`{key}` is no column of this kind"), help));
    }
    // What `simulate` and `eval` write needs no naming.
    let of_its_own = |name: String| ColumnPlan::declared(name, quantity.into());
    let plan = |(key, column): (&str, &Option<Column>)| match column {
        Some(column) => column_plan(column, quantity.into(), &place, false),
        None if matches!(orientation, None | Some(Form::FromDesign)) && is_of_vector(key) => {
            Ok(of_its_own(format!("{}_{key}", observable.name)))
        }
        None if !observable.is_vector() && orientation.is_none() => {
            let place = if matches!(key, "elevation" | "dec") { Axis::Y } else { Axis::X };
            Ok(of_its_own(shown::column(observable, place)))
        }
        None => {
            let unit = if quantity == Quantity::Number { "" } else { ", unit = \"…\"" };
            let help = format!("write `{key} = {{ column = \"…\"{unit} }}`");
            Err(mistake(place.clone(), format!("no column is named for `{key}`"), help))
        }
    };
    let written: Vec<&'static str> = keys.iter().map(|(key, _)| *key).collect();
    let columns = every(keys.into_iter().map(plan))?;
    Ok(ObservedColumns { measure, way, columns, keys: written, orientation })
}

/// Whether a key is a component, whose column `simulate` and `eval` call by the observable and the key.
fn is_of_vector(key: &str) -> bool {
    matches!(key, "x" | "y" | "z" | "rotation_x" | "rotation_y" | "rotation_z" | "u" | "v")
}
