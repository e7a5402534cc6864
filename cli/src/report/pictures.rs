//! Pictures of residuals and shapes, each an SVG that stands in the page itself.

use kuva::prelude::{Layout, Plot, ScatterPlot, render_to_svg};
use statrs::distribution::{ContinuousCDF as _, Normal};

/// Colour of what was before.
const BEFORE: &str = "#b5473c";
/// Colour of what came after.
const AFTER: &str = "#2f6db3";
/// Points of one series at most: more only make the page heavy.
const MOST_POINTS: usize = 1500;

/// What stands along the axes.
pub struct Axes<'a> {
    /// Above the picture.
    pub title: &'a str,
    /// Below it.
    pub x: &'a str,
    /// Beside it.
    pub y: &'a str,
}

/// Points before and after over a reading.
#[must_use]
pub fn before_and_after(axes: &Axes<'_>, before: &[(f64, f64)], after: &[(f64, f64)]) -> String {
    draw(axes, vec![points(before, BEFORE, "before"), points(after, AFTER, "after")])
}

/// Sorted residuals over the quantiles of a normal distribution: a straight line if the noise is normal.
#[must_use]
pub fn normal_quantiles(axes: &Axes<'_>, before: &[f64], after: &[f64]) -> String {
    let plots = [(before, BEFORE, "before"), (after, AFTER, "after")]
        .map(|(residuals, colour, name)| points(&quantiles(residuals), colour, name));
    draw(axes, plots.into())
}

fn points(points: &[(f64, f64)], colour: &str, name: &str) -> Plot {
    let step = points.len().div_ceil(MOST_POINTS).max(1);
    ScatterPlot::new()
        .with_data(points.iter().copied().step_by(step))
        .with_color(colour)
        .with_size(2.2)
        .with_marker_opacity(0.65)
        .with_legend(name)
        .into()
}

fn quantiles(residuals: &[f64]) -> Vec<(f64, f64)> {
    let mut sorted = residuals.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len() as f64;
    let normal = Normal::standard();
    (0..)
        .zip(sorted)
        .map(|(index, residual)| (normal.inverse_cdf((f64::from(index) + 0.5) / count), residual))
        .collect()
}

fn draw(axes: &Axes<'_>, plots: Vec<Plot>) -> String {
    let layout = Layout::auto_from_plots(&plots)
        .with_title(axes.title)
        .with_x_label(axes.x)
        .with_y_label(axes.y)
        .with_width(470.0)
        .with_height(300.0)
        .with_title_size(15)
        .with_label_size(13);
    render_to_svg(plots, layout)
}
