//! How the residuals of every row are distributed: how often which size, and beside the normal distribution.

use std::f64::consts::PI;

use maud::Markup;
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF as _, Normal};

use crate::words::component_in_words;

use super::card::{CARD, card};
use super::rows::{Column, Component};
use super::svg::{Axis, Mark, Picture};

/// Bars of a histogram.
const BARS: usize = 24;

/// Marks of a picture of quantiles at most: more would lie on each other.
const QUANTILES: usize = 240;

/// The values of every row, before and after, in the unit of the axis; none before where nothing changed, which is what is after.
fn values(component: &Component, changed: bool) -> [Vec<f64>; 2] {
    let in_unit = |values: &[Option<f64>], column: &Column| -> Vec<f64> {
        let finite = values.iter().flatten().filter(|value| value.is_finite());
        finite.map(|si| si / column.in_si).collect()
    };
    let before = if changed { in_unit(&component.every.before, &component.before) } else { Vec::new() };
    [before, in_unit(&component.every.after, &component.after)]
}

/// How often a residual has which size, of every row; the normal distribution of what is left beside it.
pub fn histogram(component: &Component, changed: bool) -> Markup {
    let [before, after] = values(component, changed);
    let of_before = if changed { size(&before, 99) } else { 0.0 };
    let reach = of_before.max(size(&after, 99)) * 1.05 + f64::MIN_POSITIVE;
    let width = 2.0 * reach / BARS as f64;
    let count = |values: &[f64]| {
        let mut bins = [0.0; BARS];
        for value in values.iter().filter(|value| value.abs() < reach) {
            // Between zero and the number of bars by the filter.
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let bin = (((value + reach) / width) as usize).min(BARS - 1);
            bins[bin] += 1.0;
        }
        bins
    };
    let (of_before, of_after) = (count(&before), count(&after));
    let spread = robust_spread(&after).max(f64::MIN_POSITIVE);
    let peak = after.len() as f64 * width / (spread * (2.0 * PI).sqrt());
    let highest = of_before.iter().chain(&of_after).copied().fold(peak, f64::max);
    let x = Axis { label: component.label.clone(), low: -reach, high: reach };
    let y = Axis { label: "rows".to_owned(), low: 0.0, high: 1.06 * highest };
    let mut picture = Picture::new(CARD.0, CARD.1, x, y);
    let edges = |at: usize| (-reach + at as f64 * width, -reach + (at as f64 + 1.0) * width);
    picture.bars("after fillbar", (0..BARS).map(|at| (edges(at).0, edges(at).1, of_after[at])));
    if changed {
        picture.bars("before outline", (0..BARS).map(|at| (edges(at).0, edges(at).1, of_before[at])));
    }
    let normal = (0..=96).map(|at| {
        let x = -reach + 2.0 * reach * f64::from(at) / 96.0;
        (x, peak * (-0.5 * (x / spread).powi(2)).exp())
    });
    picture.line("after normal", normal);
    let title = format!("Histogram, {}", component_in_words(component.name));
    let note = if changed {
        "Filled: after. Dashed: before. Curve: normal distribution with the same spread as after."
    } else {
        "Curve: normal distribution with the same spread."
    };
    card(&title, note, &picture.finish(&title))
}

/// The size that so many of a hundred values stay below.
fn size(values: &[f64], of_hundred: usize) -> f64 {
    let mut sizes: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    let at = sizes.len() * of_hundred / 100;
    if sizes.is_empty() { 1.0 } else { *sizes.select_nth_unstable_by(at, f64::total_cmp).1 }
}

/// 1.4826 times the median size: the standard deviation of normal values.
fn robust_spread(values: &[f64]) -> f64 {
    1.4826 * size(values, 50)
}

/// Sorted residuals over the quantiles of a normal distribution: a straight line if the noise is normal.
pub fn quantiles(component: &Component, changed: bool) -> Markup {
    let [before, after] = values(component, changed);
    let spread = robust_spread(&after);
    let [before, after] = [before, after].map(|mut values| {
        values.par_sort_unstable_by(f64::total_cmp);
        over_normal(&values)
    });
    let both = || before.iter().chain(&after);
    let x = Axis::around("quantile of the normal distribution", both().map(|p| p.0), false);
    let y = Axis::around(&component.label, both().map(|p| p.1), true);
    let (low, high) = (x.low, x.high);
    let mut picture = Picture::new(CARD.0, CARD.1, x, y);
    picture.line("after normal", [(low, low * spread), (high, high * spread)].into_iter());
    if changed {
        picture.marks("before", Mark::Triangle, before.iter().copied());
    }
    picture.marks("after", Mark::Dot, after.iter().copied());
    let title = format!("Normal Q-Q plot, {}", component_in_words(component.name));
    card(&title, "Normal noise follows the line.", &picture.finish(&title))
}

/// Sorted values with their normal quantiles; of many, those at even steps of the quantile.
fn over_normal(sorted: &[f64]) -> Vec<(f64, f64)> {
    let (count, normal) = (sorted.len() as f64, Normal::standard());
    let quantile = |at: usize| normal.inverse_cdf((at as f64 + 0.5) / count);
    let mut places: Vec<usize> = (0..sorted.len()).collect();
    if sorted.len() > QUANTILES {
        let end = -quantile(0);
        let step = |at: usize| end * (2.0 * at as f64 / (QUANTILES - 1) as f64 - 1.0);
        // A share of the rows, between none and all.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let place = |at: usize| ((normal.cdf(step(at)) * count) as usize).min(sorted.len() - 1);
        places = (0..QUANTILES).map(place).collect();
        places.dedup();
    }
    places.into_iter().map(|at| (quantile(at), sorted[at])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_many_keep_both_ends() {
        let values: Vec<f64> = (0..10_000).map(f64::from).collect();
        let marks = over_normal(&values);
        assert!(marks.len() <= QUANTILES && marks.len() > QUANTILES / 2, "{}", marks.len());
        assert_eq!((marks[0].1, marks[marks.len() - 1].1), (0.0, 9999.0));
        assert!(marks.windows(2).all(|two| two[0].0 < two[1].0 && two[0].1 < two[1].1));
        assert_eq!(over_normal(&values[..3]).len(), 3);
        assert!(over_normal(&[]).is_empty());
    }
}
