//! Residuals as arrows over where was pointed, or where the point was: before, and after.

use crate::words::numbers;
use maud::{Markup, PreEscaped, html};
use observe::kinds::Map;
use rayon::prelude::*;

use super::card::CARD;
use super::rows::Rows;
use super::svg::{Axis, Mark, Picture};
use crate::Reported;

/// More arrows than these are drawn as means of cells, so many across and so many up.
const ARROWS: usize = 150;
const CELLS: (usize, usize) = (14, 9);

/// Length of the arrow that 19 of 20 residuals stay below, in units of the picture.
const LONG: f64 = 26.0;

/// A place and the residual there, across and along.
type Arrow = ((f64, f64), (f64, f64));

/// A map of what was before, and one of what is left; one where nothing was added, none where no map can show it.
pub fn maps(reported: &Reported<'_>, rows: &Rows) -> Vec<Markup> {
    let observations = reported.observations;
    let [first, second, ..] = rows.components.as_slice() else { return Vec::new() };
    let Some(series) = observations.poses.series.first() else { return Vec::new() };
    // Nobody knows where the rows of others pointed to, or it takes more than a map to say.
    let Some(Map { title, labels, place }) = series.measure.kind().map else { return Vec::new() };
    let arrows = |after: bool| -> Vec<Arrow> {
        let part = |component: &super::rows::Component, row: usize| {
            let every = &component.every;
            Some((if after { &every.after } else { &every.before })[row]? / component.after.in_si)
        };
        series
            .rows
            .clone()
            .into_par_iter()
            .filter(|&row| !rows.every_aside[row])
            .filter_map(|row| {
                Some((place(&observations.measured[row])?, (part(first, row)?, part(second, row)?)))
            })
            .collect()
    };
    // Where nothing changed, what was before is what is.
    let before = arrows(!rows.changed);
    let mut lengths: Vec<f64> = before.iter().map(|(_, (across, along))| across.hypot(*along)).collect();
    let most = lengths.len() * 19 / 20;
    let typical =
        if lengths.is_empty() { 1.0 } else { *lengths.select_nth_unstable_by(most, f64::total_cmp).1 };
    let typical = typical.max(f64::MIN_POSITIVE);
    let scale = numbers::told_in(typical * rows.unit.in_si, &rows.unit);
    let each = if before.len() > ARROWS { "the mean residual of a cell" } else { "a residual" };
    let picture = |arrows: Vec<Arrow>, when: &str, class: &str| {
        let axis = |label: &str, pick: fn(&Arrow) -> f64| Axis::around(label, arrows.iter().map(pick), false);
        let mut picture =
            Picture::new(CARD.0, CARD.1, axis(labels[0], |a| a.0.0), axis(labels[1], |a| a.0.1));
        let arrows = if arrows.len() > ARROWS { means(&arrows, &picture) } else { arrows };
        let to_scale =
            |(at, (across, along)): &Arrow| (*at, (LONG / typical * across, LONG / typical * along));
        picture.marks(class, Mark::Dot, arrows.iter().map(|arrow| arrow.0));
        picture.arrows(class, arrows.iter().map(to_scale));
        picture.scale(LONG, &scale);
        let title = if when.is_empty() { title.to_owned() } else { format!("{title}, {when}") };
        let note = format!("Each arrow is {each}, drawn from its dot. The bar is {scale}.");
        html! {
            section.card { h3 { (title) } p.quiet { (note) } (PreEscaped(picture.finish(&format!("{title}. {note}")))) }
        }
    };
    match rows.changed {
        true => vec![picture(before, "before", "was"), picture(arrows(true), "after", "is")],
        false => vec![picture(before, "", "is")],
    }
}

/// The mean place and the mean arrow of each cell, in order of the cells.
fn means(arrows: &[Arrow], picture: &Picture) -> Vec<Arrow> {
    let cell = picture.cells(CELLS);
    let mut sums = vec![[0.0; 5]; CELLS.0 * CELLS.1];
    for &((x, y), (dx, dy)) in arrows {
        let sum = &mut sums[cell((x, y))];
        sum.iter_mut().zip([1.0, x, y, dx, dy]).for_each(|(sum, value)| *sum += value);
    }
    let filled = sums.into_iter().filter(|sum| sum[0] > 0.0);
    filled.map(|[count, x, y, dx, dy]| ((x / count, y / count), (dx / count, dy / count))).collect()
}
