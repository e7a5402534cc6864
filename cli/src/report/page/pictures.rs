//! Which pictures the page has.

use std::f64::consts::PI;

use calibration::data::{Measure, Measured};
use calibration::diagnose::Harmonics;
use calibration::report::{self as words, numbers};
use maud::{Markup, PreEscaped, html};
use statrs::distribution::{ContinuousCDF as _, Normal};

use super::rows::{Column, Component, Rows, axis_size, trace_reading};
use super::svg::{Axis, Mark, Picture};
use crate::report::Reported;

/// Size of a picture in a card, and of one across the page.
const CARD: (f64, f64) = (380.0, 262.0);
const BROAD: (f64, f64) = (1140.0, 250.0);

/// More arrows than these are drawn as means of cells, so many across and so many up.
const ARROWS: usize = 500;
const CELLS: (usize, usize) = (22, 14);

/// Bins of means along a reading, and of a histogram.
const BINS: usize = 12;
const BARS: usize = 24;

/// The section of residuals.
pub fn residuals(reported: &Reported<'_>, rows: &Rows) -> Markup {
    let drawn = rows.numbers.len();
    html! {
        section id="residuals" {
            h2 { "Residuals" }
            p.quiet {
                "Measured minus what the fitted declaration says. What is left should scatter evenly around zero. Crosses: \
                 rows set aside. Diamonds: means of what is left, with two standard errors."
                @if drawn < rows.of { " " (drawn) " of " (rows.of) " rows drawn, all counted in figures, tables and histograms." }
            }
            fieldset.toggle {
                legend.quiet { "Show" }
                input type="radio" name="show" id="show-before"; label for="show-before" { "△ Before" }
                input type="radio" name="show" id="show-both" checked; label for="show-both" { "Both" }
                input type="radio" name="show" id="show-after"; label for="show-after" { "● After" }
                span.key { "— fitted effect with two standard uncertainties" }
                span id="state" role="status" {}
                button id="clear" type="button" hidden { "Clear" }
            }
            div.grid {
                @for (at, _) in reported.calibration.traces.iter().enumerate() { (effect(reported, rows, at)) }
                (map(reported, rows))
                @if let [across, along, ..] = rows.components.as_slice() { (against(rows, across, along)) }
                @for component in &rows.components { (histogram(reported, component)) (quantiles(component)) }
                (order(rows))
            }
            details open[rows.readings.len() * rows.components.len() <= 6] {
                summary { "Every residual against every reading (" (rows.readings.len() * rows.components.len()) " pictures)" }
                div.grid {
                    @for component in &rows.components {
                        @for reading in &rows.readings { (over(rows, reading, component)) }
                    }
                }
            }
        }
    }
}

fn card(title: &str, note: &str, svg: &str) -> Markup {
    html! {
        section.card {
            h3 { (title) }
            @if !note.is_empty() { p.quiet { (note) } }
            (PreEscaped(svg))
        }
    }
}

/// Pairs of two columns where both have a value, of rows that were set aside or of the others.
fn pairs<'a>(
    rows: &'a Rows,
    x: &'a [Option<f64>],
    y: &'a [Option<f64>],
    aside: bool,
) -> impl Iterator<Item = (f64, f64)> + 'a {
    let kept = move |&at: &usize| rows.aside[at] == aside;
    (0..x.len()).filter(kept).filter_map(|at| Some((x[at]?, y[at]?)))
}

/// Before, after, and rows set aside, of a column against another.
fn marks(
    picture: &mut Picture,
    rows: &Rows,
    x: &[Option<f64>],
    before: &[Option<f64>],
    after: &[Option<f64>],
) {
    picture.marks("before", Mark::Triangle, pairs(rows, x, before, false));
    picture.marks("after", Mark::Dot, pairs(rows, x, after, false));
    picture.marks("after", Mark::Cross, pairs(rows, x, after, true));
}

fn axis_of(column: &Column, centred: bool) -> Axis {
    Axis::around(&column.label, column.values.iter().flatten().copied(), centred)
}

/// Values of kept rows that fill a picture, before and after; those set aside must not squeeze the others.
fn residual_axis(label: &str, rows: &Rows, columns: [&[Option<f64>]; 2]) -> Axis {
    let kept = columns.into_iter().flat_map(|values| {
        values.iter().zip(&rows.aside).filter(|&(_, &aside)| !aside).filter_map(|(value, _)| *value)
    });
    Axis::around(label, kept, true)
}

/// One effect against what drives it, with the fitted function drawn through.
fn effect(reported: &Reported<'_>, rows: &Rows, at: usize) -> Markup {
    let trace = &reported.calibration.traces[at];
    let told = &reported.calibration.diagnosis.effects[at];
    let [without, left] = &rows.effects[at];
    let readings = &reported.calibration.diagnosis.instrument.readings;
    let chain = &reported.calibration.chain;
    let driver = trace.driver.map(|id| chain.symbol(id).name.clone());
    let Some((number, shown)) =
        readings.iter().enumerate().find(|(_, shown)| Some(&shown.name) == driver.as_ref())
    else {
        return html! {};
    };
    let reading = &rows.readings[number];
    let (drawn, in_si) =
        (trace_reading(trace), numbers::reading(shown.unit, axis_size(shown.unit, &shown.range)).in_si);
    let label = format!("{} of {}, {}", told.dof, told.body, drawn.name);
    let mut picture = Picture::new(
        CARD.0,
        CARD.1,
        axis_of(reading, false),
        residual_axis(&label, rows, [&without.values, &left.values]),
    )
    .of_rows(&reading.key, &without.key, &left.key);
    marks(&mut picture, rows, &reading.values, &without.values, &left.values);
    let curve = trace.curve.iter().map(|[q, f, two]| [q / in_si, f / drawn.in_si, two / drawn.in_si]);
    let curve: Vec<[f64; 3]> = curve.collect();
    let band: Vec<[f64; 3]> = curve.iter().map(|[q, f, two]| [*q, f - two, f + two]).collect();
    picture.band("band before", &band);
    picture.line("curve before", curve.iter().map(|[q, f, _]| (*q, *f)));
    let note = format!(
        "What each row says of {} in {}: before, without this effect, and what is left with it.",
        told.dof, told.body
    );
    let name = format!(
        "{} against {}: {}",
        label,
        shown.name,
        words::headline(told, &reported.calibration.diagnosis)
    );
    card(&words::sentence_case(&told.names[0]), &note, &picture.finish(&name))
}

/// Arrows of the residual over where was pointed, or where the point was.
fn map(reported: &Reported<'_>, rows: &Rows) -> Markup {
    let observations = reported.observations;
    let [first, second, ..] = rows.components.as_slice() else { return html! {} };
    let Some(series) = observations.poses.series.first() else { return html! {} };
    if series.measure != series.measure.bare() {
        // Nobody knows where these rows pointed to.
        return html! {};
    }
    let position = |at: usize| -> Option<(f64, f64)> {
        let row = reported.calibration.drawn[at];
        match observations.measured[row] {
            _ if !series.rows.contains(&row) => None,
            Measured::Direction(u) => {
                Some((u.x.atan2(u.y) * 180.0 / PI, u.z.clamp(-1.0, 1.0).asin() * 180.0 / PI))
            }
            Measured::Point(point) => Some((point.x, point.y)),
            _ => None,
        }
    };
    let (title, labels) = match series.measure {
        Measure::Direction => ("Residuals over the sky", ["azimuth, °", "elevation, °"]),
        _ => ("Residuals in space, seen from above", ["x, m", "y, m"]),
    };
    let places: Vec<Option<(f64, f64)>> = (0..rows.numbers.len()).map(position).collect();
    let axis = |label: &str, pick: fn(&(f64, f64)) -> f64| {
        Axis::around(label, places.iter().flatten().map(pick), false)
    };
    let mut picture = Picture::new(CARD.0, CARD.1, axis(labels[0], |p| p.0), axis(labels[1], |p| p.1));
    let lengths = |columns: [&Column; 2]| -> Vec<f64> {
        let both =
            columns[0].values.iter().zip(&columns[1].values).zip(&rows.aside).filter(|(_, aside)| !**aside);
        both.filter_map(|((a, b), _)| Some((*a)?.hypot((*b)?))).collect()
    };
    let mut before = lengths([&first.before, &second.before]);
    before.sort_by(f64::total_cmp);
    let typical = before.get(before.len() * 19 / 20).copied().unwrap_or(1.0).max(f64::MIN_POSITIVE);
    let scale = 22.0 / typical;
    let in_cells = places.len() > ARROWS;
    for (class, columns) in
        [("before", [&first.before, &second.before]), ("after", [&first.after, &second.after])]
    {
        let arrows = (0..places.len()).filter(|&at| !rows.aside[at]).filter_map(|at| {
            Some((places[at]?, (scale * columns[0].values[at]?, scale * columns[1].values[at]?)))
        });
        if in_cells {
            picture.arrows(class, means_of_cells(arrows, picture.cells(CELLS)).into_iter());
        } else {
            picture.arrows(class, arrows);
        }
    }
    let each =
        if in_cells { "Each line is the mean over a cell" } else { "Each line starts where was measured" };
    let note = format!(
        "{each} and runs along the residual; {} long: {}. Dashed: before. Solid: after.",
        "a tenth of the height",
        numbers::told_in(22.0 / scale * rows.unit.in_si, &rows.unit)
    );
    card(title, &note, &picture.finish(&format!("{title}: {note}")))
}

/// A place and an arrow from there.
type Arrow = ((f64, f64), (f64, f64));

/// The mean place and the mean arrow of each cell, in order of the cells.
fn means_of_cells(arrows: impl Iterator<Item = Arrow>, cell: impl Fn((f64, f64)) -> usize) -> Vec<Arrow> {
    let mut sums = vec![[0.0; 5]; CELLS.0 * CELLS.1];
    for ((x, y), (dx, dy)) in arrows {
        let sum = &mut sums[cell((x, y))];
        sum.iter_mut().zip([1.0, x, y, dx, dy]).for_each(|(sum, value)| *sum += value);
    }
    let filled = sums.into_iter().filter(|sum| sum[0] > 0.0);
    filled.map(|[count, x, y, dx, dy]| ((x / count, y / count), (dx / count, dy / count))).collect()
}

/// One component against another.
fn against(rows: &Rows, x: &Component, y: &Component) -> Markup {
    let mut picture = Picture::new(
        CARD.0,
        CARD.1,
        residual_axis(&x.label, rows, [&x.before.values, &x.after.values]),
        residual_axis(&y.label, rows, [&y.before.values, &y.after.values]),
    );
    picture.marks("before", Mark::Triangle, pairs(rows, &x.before.values, &y.before.values, false));
    picture.marks("after", Mark::Dot, pairs(rows, &x.after.values, &y.after.values, false));
    picture.marks("after", Mark::Cross, pairs(rows, &x.after.values, &y.after.values, true));
    let title = format!("{} against {}", words::sentence_case(y.name), x.name);
    let svg = picture.finish(&format!("{title}, before and after"));
    card(&title, "", &svg)
}

/// A component against a reading, with means of what is left.
fn over(rows: &Rows, reading: &Column, component: &Component) -> Markup {
    let (before, after) = (&component.before, &component.after);
    let x = axis_of(reading, false);
    let (low, high) = (x.low, x.high);
    let y = residual_axis(&component.label, rows, [&before.values, &after.values]);
    let mut picture = Picture::new(CARD.0, CARD.1, x, y).of_rows(&reading.key, &before.key, &after.key);
    marks(&mut picture, rows, &reading.values, &before.values, &after.values);
    means(&mut picture, low, high, pairs(rows, &reading.values, &after.values, false));
    let title = format!("{} over {}", words::sentence_case(component.name), reading.key);
    let svg = picture.finish(&format!("{title}, before and after, with means of what is left"));
    card(&title, "", &svg)
}

/// Means of what is left in bins, each with two standard errors.
fn means(picture: &mut Picture, low: f64, high: f64, points: impl Iterator<Item = (f64, f64)>) {
    let mut sums = [[0.0; 4]; BINS];
    for (x, y) in points {
        let share = (x - low) / (high - low) * BINS as f64;
        // Within the axis by its making.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let bin = (share as usize).min(BINS - 1);
        let [count, sum_x, sum, square] = &mut sums[bin];
        (*count, *sum_x, *sum, *square) = (*count + 1.0, *sum_x + x, *sum + y, *square + y * y);
    }
    let mut marks = Vec::new();
    for [count, sum_x, sum, square] in sums.into_iter().filter(|sums| sums[0] >= 4.0) {
        let (x, mean) = (sum_x / count, sum / count);
        let error = 2.0 * ((square / count - mean * mean).max(0.0) / (count - 1.0)).sqrt();
        picture.line("normal", [(x, mean - error), (x, mean + error)].into_iter());
        marks.push((x, mean));
    }
    picture.marks("after", Mark::Diamond, marks.into_iter());
}

/// How often a residual has which size, of every row; the normal distribution of what is left beside it.
fn histogram(reported: &Reported<'_>, component: &Component) -> Markup {
    let all = crate::report::residuals::components(reported);
    let Some(full) = all.iter().find(|full| full.name == component.name) else { return html! {} };
    let reading = numbers::reading(full.unit, largest(&full.before));
    let finite = |values: &[Option<f64>]| -> Vec<f64> {
        values.iter().flatten().filter(|v| v.is_finite()).map(|si| si / reading.in_si).collect()
    };
    let (before, after) = (finite(&full.before), finite(&full.after));
    let reach = middle(&before).max(middle(&after)) * 1.05 + f64::MIN_POSITIVE;
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
    let label = numbers::name_with_unit(component.name, &reading.name);
    let x = Axis { label, low: -reach, high: reach };
    let y = Axis { label: "rows".to_owned(), low: 0.0, high: 1.06 * highest };
    let mut picture = Picture::new(CARD.0, CARD.1, x, y);
    let edges = |at: usize| (-reach + at as f64 * width, -reach + (at as f64 + 1.0) * width);
    picture.bars("after fillbar", (0..BARS).map(|at| (edges(at).0, edges(at).1, of_after[at])));
    picture.bars("before outline", (0..BARS).map(|at| (edges(at).0, edges(at).1, of_before[at])));
    let normal = (0..=96).map(|at| {
        let x = -reach + 2.0 * reach * f64::from(at) / 96.0;
        (x, peak * (-0.5 * (x / spread).powi(2)).exp())
    });
    picture.line("after normal", normal);
    let title = format!("How often: {}", component.name);
    let note = "Filled: after. Dashed: before. Curve: normal, with the spread of what is left.";
    card(&title, note, &picture.finish(&format!("Histogram of {}", component.name)))
}

fn largest(values: &[Option<f64>]) -> f64 {
    values.iter().flatten().filter(|v| v.is_finite()).fold(0.0, |a: f64, b| a.max(b.abs()))
}

/// The size that 99 of 100 values stay below.
fn middle(values: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() * 99 / 100).copied().unwrap_or(1.0)
}

/// 1.4826 times the median size: the standard deviation of normal values.
fn robust_spread(values: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    1.4826 * sizes.get(sizes.len() / 2).copied().unwrap_or(1.0)
}

/// Sorted residuals over the quantiles of a normal distribution: a straight line if the noise is normal.
fn quantiles(component: &Component) -> Markup {
    let sorted = |column: &Column| -> Vec<(f64, f64)> {
        let mut values: Vec<f64> =
            column.values.iter().flatten().copied().filter(|v| v.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let (count, normal) = (values.len() as f64, Normal::standard());
        (0..).zip(values).map(|(at, v)| (normal.inverse_cdf((f64::from(at) + 0.5) / count), v)).collect()
    };
    let (before, after) = (sorted(&component.before), sorted(&component.after));
    let both = || before.iter().chain(&after);
    let x = Axis::around("quantile of the normal distribution", both().map(|p| p.0), false);
    let y = Axis::around(&component.label, both().map(|p| p.1), true);
    let (low, high) = (x.low, x.high);
    let mut picture = Picture::new(CARD.0, CARD.1, x, y);
    let spread = robust_spread(&after.iter().map(|p| p.1).collect::<Vec<_>>());
    picture.line("after normal", [(low, low * spread), (high, high * spread)].into_iter());
    picture.marks("before", Mark::Triangle, before.iter().copied());
    picture.marks("after", Mark::Dot, after.iter().copied());
    let title = format!("Against the normal distribution: {}", component.name);
    card(&title, "On the line: normal.", &picture.finish(&title))
}

/// The length of the residual row by row, in two drawings: one for a broad window, one for a narrow one.
fn order(rows: &Rows) -> Markup {
    let numbers: Vec<Option<f64>> = rows.numbers.iter().map(|&number| Some(number as f64)).collect();
    html! {
        @for component in &rows.components {
            section.card.wide {
                h3 { "In the order of the file: " (component.name) }
                @for (class, (width, height)) in [("broad", BROAD), ("narrow", CARD)] {
                    div class=(class) { (PreEscaped(in_order(rows, component, &numbers, width, height))) }
                }
            }
        }
    }
}

fn in_order(rows: &Rows, component: &Component, numbers: &[Option<f64>], width: f64, height: f64) -> String {
    let (before, after) = (&component.before, &component.after);
    let x = Axis::around("row", numbers.iter().flatten().copied(), false);
    let (low, high) = (x.low, x.high);
    let y = residual_axis(&component.label, rows, [&before.values, &after.values]);
    let mut picture = Picture::new(width, height, x, y).of_rows("order", &before.key, &after.key);
    marks(&mut picture, rows, numbers, &before.values, &after.values);
    means(&mut picture, low, high, pairs(rows, numbers, &after.values, false));
    picture.finish(&format!("{} row by row, before and after", component.name))
}

/// What is left as what is left: in words, what was looked at, and the harmonics of each joint.
pub fn left(reported: &Reported<'_>) -> Markup {
    let diagnosis = &reported.calibration.diagnosis;
    let joints: Vec<&Harmonics> = diagnosis.harmonics.iter().collect();
    html! {
        section id="left" {
            h2 { "What is left" }
            @for line in words::remaining(diagnosis) { p { (words::sentence_case(&line)) "." } }
            @if diagnosis.remaining.is_none() { p { "No search was made." } }
            @if let Some(offer) = diagnosis.remaining.as_ref().and_then(|left| left.offer.as_ref()) {
                p { "To let the declaration have it, write into the study and calibrate again:" }
                pre.copy { (offer) }
            }
            @if !joints.is_empty() {
                details open {
                    summary { "Harmonics of each joint" }
                    p.quiet { "Amplitude of each order in the residual; the dotted line is what noise alone exceeds once in twenty." }
                    div.grid { @for harmonics in joints { (harmonic(harmonics, reported)) } }
                }
            }
            @if let Some(left) = &diagnosis.remaining {
                details {
                    summary { "What was looked at" }
                    div.scroll tabindex="0" role="region" aria-label="Statistics of what is left" {
                        table {
                            thead { tr { th scope="col" { "structure" } th scope="col" { "chance in noise, alone" } } }
                            tbody { @for looked in &left.looked { tr { td { (looked.at) } td { (numbers::chance(looked.p_value)) } } } }
                        }
                    }
                }
            }
        }
    }
}

fn harmonic(harmonics: &Harmonics, reported: &Reported<'_>) -> Markup {
    let all = harmonics.before.iter().chain(&harmonics.after).chain(&harmonics.limit);
    let largest = all.copied().fold(0.0, f64::max);
    let reading = numbers::reading(reported.calibration.diagnosis.unit, largest);
    let orders = harmonics.after.len() as f64;
    let y = Axis {
        label: format!("amplitude, {}", reading.name),
        low: 0.0,
        high: 1.08 * largest / reading.in_si,
    };
    let x = Axis { label: format!("times per turn of {}", harmonics.joint), low: 0.4, high: orders + 0.6 };
    let mut picture = Picture::new(CARD.0, CARD.1, x, y);
    let bars = |values: &[f64], from: f64, to: f64| -> Vec<(f64, f64, f64)> {
        let at = values.iter().zip(1..);
        at.map(|(v, order)| (f64::from(order) + from, f64::from(order) + to, v / reading.in_si)).collect()
    };
    picture.bars("before hatch", bars(&harmonics.before, -0.32, -0.02).into_iter());
    picture.bars("after fillbar", bars(&harmonics.after, 0.02, 0.32).into_iter());
    let limit = harmonics.limit.iter().zip(1..).flat_map(|(v, order)| {
        [(f64::from(order) - 0.5, v / reading.in_si), (f64::from(order) + 0.5, v / reading.in_si)]
    });
    picture.line("limit", limit);
    let title = format!("{} over {}", words::sentence_case(harmonics.component), harmonics.joint);
    card(&title, "", &picture.finish(&format!("Harmonics: {title}")))
}
