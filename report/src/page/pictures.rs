//! Which pictures the page has.

use crate::words::{self, component_in_words, motion, numbers, side};
use calibration::diagnose::Harmonics;
use maud::{Markup, PreEscaped, html};
use rayon::prelude::*;

use super::card::{CARD, card};
use super::panels::{FEWEST_ROWS, HARMONICS, OPEN, Panel, fold, parted};
use super::rows::{Column, Component, Rows, axis_size, trace_reading};
use super::svg::{Axis, Mark, Picture};
use super::{distribution, map};
use crate::Reported;

/// Size of a picture across the page.
const BROAD: (f64, f64) = (1140.0, 250.0);

/// Bins of means along a reading.
const BINS: usize = 12;

/// Effects whose pictures are not folded away.
const EFFECTS: usize = 3;

/// The section of residuals.
pub fn residuals(reported: &Reported<'_>, rows: &Rows) -> Markup {
    let drawn = rows.numbers.len();
    if rows.of < FEWEST_ROWS {
        return html! {
            section id="residuals" {
                h2 { "Residuals" }
                p { (rows.of) @if rows.of == 1 { " row is" } @else { " rows are" } " too few for pictures. The residuals are in " code { "residuals.csv" } "." }
            }
        };
    }
    let found = &reported.calibration.diagnosis.effects;
    let mut effects: Vec<usize> = (0..reported.calibration.traces.len()).collect();
    effects.sort_by(|&a, &b| found[b].standing.total_cmp(&found[a].standing));
    let (maps, of_components) = rayon::join(
        || map::maps(reported, rows),
        || {
            rows.components
                .par_iter()
                .map(|component| OfComponent::of(reported, rows, component))
                .collect::<Vec<_>>()
        },
    );
    let against = match rows.components.as_slice() {
        [across, along, ..] => Some(against(rows, across, along)),
        _ => None,
    };
    let effects: Vec<Markup> = effects.into_iter().filter_map(|at| effect(reported, rows, at)).collect();
    let (first, others) = effects.split_at(effects.len().min(EFFECTS));
    let stand_open = first.len() + maps.len() + usize::from(against.is_some());
    let mut panels = Vec::new();
    let mut distributions = Vec::new();
    for own in of_components {
        panels.extend(own.over);
        panels.push(own.order);
        distributions.extend(own.distribution);
    }
    let [open, folded] = parted(panels, OPEN.saturating_sub(stand_open));
    html! {
        section id="residuals" {
            h2 { "Residuals" }
            p.quiet {
                "Residual: measured minus predicted by the fitted model. Good residuals scatter evenly around zero. Crosses: outliers. \
                 Diamonds: means after calibration, with two standard errors."
                @if drawn < rows.of {
                    " " (drawn) " of " (rows.of) " rows are drawn"
                    @if rows.of > reported.calibration.drawn.len() { " (the outliers, those with the largest residuals, and others at random)" }
                    ". Figures, tables, histograms, quantiles, means and maps use every row."
                }
            }
            fieldset.toggle {
                legend.quiet { @if rows.changed { "Show" } @else { "Rows" } }
                @if rows.changed {
                    input type="radio" name="show" id="show-before"; label for="show-before" { "△ Before" }
                    input type="radio" name="show" id="show-both" checked; label for="show-both" { "Both" }
                    input type="radio" name="show" id="show-after"; label for="show-after" { "● After" }
                    span.key { "— fitted effect with two standard uncertainties" }
                }
                span id="state" role="status" {}
                button id="zoom" type="button" hidden { "Zoom to them" }
                button id="clear" type="button" hidden { "Clear" }
            }
            div.grid {
                @for effect in first { (effect) }
                @for map in maps { (map) }
                @if let Some(against) = against { (against) }
                @for panel in open { (panel.picture) }
            }
            @if !others.is_empty() {
                details {
                    summary { "The other " (others.len()) @if others.len() == 1 { " effect" } @else { " effects" } }
                    div.grid { @for effect in others { (effect) } }
                }
            }
            (fold("The residual against other readings and in file order, most structure first", &folded))
            (fold("How the residuals are distributed", &distributions))
        }
    }
}

/// The pictures of one residual component.
struct OfComponent {
    /// Histogram and quantiles.
    distribution: [Panel; 2],
    order: Panel,
    /// Over each reading.
    over: Vec<Panel>,
}

impl OfComponent {
    fn of(reported: &Reported<'_>, rows: &Rows, component: &Component) -> Self {
        let distribution = [
            distribution::histogram(component, rows.changed),
            distribution::quantiles(component, rows.changed),
        ];
        Self {
            distribution: distribution.map(|picture| Panel { left: 0.0, is_wide: false, picture }),
            order: order(reported, rows, component),
            over: rows.readings.par_iter().map(|reading| over(reported, rows, reading, component)).collect(),
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
    if rows.changed {
        picture.marks("before", Mark::Triangle, pairs(rows, x, before, false));
    }
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

/// One effect against what drives it, with the fitted function drawn through; none where no one reading drives it.
fn effect(reported: &Reported<'_>, rows: &Rows, at: usize) -> Option<Markup> {
    let trace = &reported.calibration.traces[at];
    let told = &reported.calibration.diagnosis.effects[at];
    let [without, left] = &rows.effects[at];
    let readings = &reported.calibration.diagnosis.instrument.readings;
    let chain = &reported.calibration.chain;
    let driver = trace.driver.map(|id| chain.symbol(id).name.clone());
    let (number, shown) =
        readings.iter().enumerate().find(|(_, shown)| Some(&shown.name) == driver.as_ref())?;
    let reading = &rows.readings[number];
    let (drawn, in_si) =
        (trace_reading(trace), numbers::reading(shown.unit, axis_size(shown.unit, &shown.range)).in_si);
    let label = format!("{} of {}, {}", told.dof, told.body, drawn.name);
    let y = residual_axis(&label, rows, [&without.values, &left.values]);
    // Of a function that repeats too often, every period is drawn on the first.
    let first = trace.curve.first().map_or(0.0, |point| point[0] / in_si);
    let folded: Option<Vec<Option<f64>>> = trace.period.map(|period| {
        let within = |q: f64| first + (q - first).rem_euclid(period / in_si);
        reading.values.iter().map(|value| value.map(within)).collect()
    });
    let mut picture = match &folded {
        Some(folded) => {
            let label = format!("{}, every period on the first", reading.label);
            Picture::new(CARD.0, CARD.1, Axis::around(label, folded.iter().flatten().copied(), false), y)
        }
        None => Picture::new(CARD.0, CARD.1, axis_of(reading, false), y).of_rows(
            &reading.key,
            &without.key,
            &left.key,
        ),
    };
    marks(&mut picture, rows, folded.as_ref().unwrap_or(&reading.values), &without.values, &left.values);
    let curve = trace.curve.iter().map(|[q, f, two]| [q / in_si, f / drawn.in_si, two / drawn.in_si]);
    let curve: Vec<[f64; 3]> = curve.collect();
    let band: Vec<[f64; 3]> = curve.iter().map(|[q, f, two]| [*q, f - two, f + two]).collect();
    picture.band("band before", &band);
    picture.line("curve before", curve.iter().map(|[q, f, _]| (*q, *f)));
    let note = format!(
        "Triangles: {} of {} implied by each row, before the effect is added. Dots: after.",
        motion(&told.dof),
        told.body
    );
    let name = format!("{} against {}: {}", label, shown.name, words::headline(told));
    Some(card(&words::sentence_case(&told.names[0]), &note, &picture.finish(&name)))
}

/// One component against another.
fn against(rows: &Rows, x: &Component, y: &Component) -> Markup {
    let mut picture = Picture::new(
        CARD.0,
        CARD.1,
        residual_axis(&x.label, rows, [&x.before.values, &x.after.values]),
        residual_axis(&y.label, rows, [&y.before.values, &y.after.values]),
    );
    if rows.changed {
        picture.marks("before", Mark::Triangle, pairs(rows, &x.before.values, &y.before.values, false));
    }
    picture.marks("after", Mark::Dot, pairs(rows, &x.after.values, &y.after.values, false));
    picture.marks("after", Mark::Cross, pairs(rows, &x.after.values, &y.after.values, true));
    let title = format!("{} against {}", words::sentence_case(side(y.name)), component_in_words(x.name));
    let svg = picture.finish(&format!("{title}, before and after"));
    card(&title, "", &svg)
}

/// A component against a reading, with means of what is left.
fn over(reported: &Reported<'_>, rows: &Rows, reading: &Column, component: &Component) -> Panel {
    let (before, after) = (&component.before, &component.after);
    let number = rows.readings.iter().position(|one| one.key == reading.key);
    let every = number.map(|number| reported.observations.poses.columns[number].1.as_slice());
    let x = match every {
        Some(every) => Axis::around(&reading.label, every.iter().map(|si| si / reading.in_si), false),
        None => axis_of(reading, false),
    };
    let (low, high) = (x.low, x.high);
    let y = residual_axis(&component.label, rows, [&before.values, &after.values]);
    let mut picture = Picture::new(CARD.0, CARD.1, x, y).of_rows(&reading.key, &before.key, &after.key);
    marks(&mut picture, rows, &reading.values, &before.values, &after.values);
    let left = every.map_or(0.0, |every| {
        means(&mut picture, low, high, rows.kept(|row| every[row] / reading.in_si, component))
    });
    let title = format!("{} over {}", words::sentence_case(&component_in_words(component.name)), reading.key);
    let svg = picture.finish(&format!("{title}, before and after, with means after"));
    Panel { left, is_wide: false, picture: card(&title, "", &svg) }
}

/// Means of what is left in bins, each with two standard errors; returns how many of these the mean lies off zero that lies off most.
fn means(picture: &mut Picture, low: f64, high: f64, points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let mut sums = [[0.0; 4]; BINS];
    for (x, y) in points {
        let share = (x - low) / (high - low) * BINS as f64;
        // Within the axis by its making, or at its end.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let bin = (share.max(0.0) as usize).min(BINS - 1);
        let [count, sum_x, sum, square] = &mut sums[bin];
        (*count, *sum_x, *sum, *square) = (*count + 1.0, *sum_x + x, *sum + y, *square + y * y);
    }
    let (mut marks, mut most) = (Vec::new(), 0.0_f64);
    for [count, sum_x, sum, square] in sums.into_iter().filter(|sums| sums[0] >= 4.0) {
        let (x, mean) = (sum_x / count, sum / count);
        let error = 2.0 * ((square / count - mean * mean).max(0.0) / (count - 1.0)).sqrt();
        picture.line("normal", [(x, mean - error), (x, mean + error)].into_iter());
        marks.push((x, mean));
        if error > 0.0 {
            most = most.max(mean.abs() / error);
        }
    }
    picture.marks("after", Mark::Diamond, marks.into_iter());
    most
}

/// A component of the residual row by row, in two drawings: one for a broad window, one for a narrow one.
fn order(reported: &Reported<'_>, rows: &Rows, component: &Component) -> Panel {
    let numbers: Vec<Option<f64>> = rows.numbers.iter().map(|&number| Some(number as f64)).collect();
    let [(left, broad), (_, narrow)] =
        [BROAD, CARD].map(|size| in_order(reported, rows, component, &numbers, size));
    let picture = html! {
        section.card.wide {
            h3 { "In file order, " (component_in_words(component.name)) }
            div.broad { (PreEscaped(broad)) }
            div.narrow { (PreEscaped(narrow)) }
        }
    };
    Panel { left, is_wide: true, picture }
}

fn in_order(
    reported: &Reported<'_>,
    rows: &Rows,
    component: &Component,
    numbers: &[Option<f64>],
    (width, height): (f64, f64),
) -> (f64, String) {
    let (before, after) = (&component.before, &component.after);
    let x = Axis::around("row", numbers.iter().flatten().copied(), false);
    let (low, high) = (x.low, x.high);
    let y = residual_axis(&component.label, rows, [&before.values, &after.values]);
    let mut picture = Picture::new(width, height, x, y).of_rows("order", &before.key, &after.key);
    marks(&mut picture, rows, numbers, &before.values, &after.values);
    let number = |row: usize| reported.observations.row_number(row) as f64;
    let left = means(&mut picture, low, high, rows.kept(number, component));
    (left, picture.finish(&format!("{} row by row, before and after", component_in_words(component.name))))
}

/// What remains after the effects: in words, the statistics behind them, and the harmonics of each joint.
pub fn left(reported: &Reported<'_>) -> Markup {
    let diagnosis = &reported.calibration.diagnosis;
    let harmonics = diagnosis.harmonics.iter().map(|own| harmonic(own, reported)).collect();
    let [open, folded] = parted(harmonics, HARMONICS);
    html! {
        section id="left" {
            h2 { "What remains" }
            @for line in words::remaining(diagnosis) { p { (words::sentence_case(&line)) "." } }
            @if diagnosis.remaining.is_none() { p { "No search was made." } }
            @if let Some(offer) = diagnosis.remaining.as_ref().and_then(|left| left.offer.as_ref()) {
                p { "To add this error to the model, write these lines into the study and calibrate again:" }
                pre.copy tabindex="0" { (offer) }
            }
            @if !open.is_empty() {
                h3 { "Harmonics of each joint" }
                p.quiet { "Amplitude of each order in the residual. Noise alone exceeds the dotted line once in twenty times." }
                div.grid { @for panel in open { (panel.picture) } }
                (fold("Other harmonics", &folded))
            }
            @if let Some(left) = &diagnosis.remaining {
                details {
                    summary { "Tests of the residual" }
                    div.scroll tabindex="0" role="region" aria-label="Tests of the residual" {
                        table {
                            thead { tr { th scope="col" { "pattern" } th scope="col" { "p, of this test alone" } } }
                            tbody { @for looked in &left.looked { tr { td { (looked.at) } td { (numbers::chance(looked.p_value)) } } } }
                        }
                    }
                }
            }
        }
    }
}

fn harmonic(harmonics: &Harmonics, reported: &Reported<'_>) -> Panel {
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
    if !reported.calibration.diagnosis.effects.is_empty() {
        picture.bars("before hatch", bars(&harmonics.before, -0.32, -0.02).into_iter());
    }
    picture.bars("after fillbar", bars(&harmonics.after, 0.02, 0.32).into_iter());
    let limit = harmonics.limit.iter().zip(1..).flat_map(|(v, order)| {
        [(f64::from(order) - 0.5, v / reading.in_si), (f64::from(order) + 0.5, v / reading.in_si)]
    });
    picture.line("limit", limit);
    let title = format!(
        "{} over {}",
        words::sentence_case(&component_in_words(harmonics.component)),
        harmonics.joint
    );
    let beside = harmonics.after.iter().zip(&harmonics.limit).filter(|(_, limit)| **limit > 0.0);
    let left = beside.map(|(after, limit)| after / limit).fold(0.0, f64::max);
    Panel { left, is_wide: false, picture: card(&title, "", &picture.finish(&format!("Harmonics: {title}"))) }
}
