//! Influences along a path as files: a CSV table, and an SVG figure with one panel for each error that matters.

use std::fmt::Write as _;

use kuva::backend::svg::SvgBackend;
use kuva::plot::LinePlot;
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use model_core::budget::{self, Curve, Curves};
use model_core::{Chain, ObservableId, SymbolId};

use super::reading_unit;
use report::letters;

/// Panels side by side.
const ACROSS: usize = 3;
/// Width and height of a panel, in pixels.
const PANEL: (f64, f64) = (330.0, 230.0);
/// Lines from the smallest size to the largest.
const COLOURS: [&str; 5] = ["#9ecae1", "#6baed6", "#4292c6", "#2171b5", "#08306b"];
/// A line of the figure takes every third point of the curve: that is smooth at the size of a panel.
const EVERY: usize = 3;
/// The top of an axis against the largest influence on it.
const HEADROOM: f64 = 1.01;
/// Against the largest influence of all: below this an error does nothing that a figure can show.
const VISIBLE: f64 = 1e-6;

/// The curves as a table in SI: `t`, then one column for each error and size.
pub fn csv(chain: &Chain, curves: &Curves) -> String {
    let mut out = "t".to_owned();
    for curve in &curves.curves {
        let symbol = chain.symbol(curve.error);
        let _ = write!(out, ",{} {:?} {}", symbol.name, curve.size, symbol.quantity.unit());
    }
    out.push('\n');
    for (point, t) in curves.t.iter().enumerate() {
        let _ = write!(out, "{t:?}");
        for curve in &curves.curves {
            let _ = write!(out, ",{:?}", curve.influence[point]);
        }
        out.push('\n');
    }
    out
}

/// The curves as a figure; `None` if no error has an influence that could be shown.
pub fn svg(chain: &Chain, observable: ObservableId, curves: &Curves) -> Option<String> {
    let largest = |curve: &Curve| curve.influence.iter().copied().fold(0.0, f64::max);
    let most = curves.curves.iter().map(largest).fold(0.0, f64::max);
    let mut errors: Vec<SymbolId> = curves
        .curves
        .iter()
        .filter(|curve| largest(curve) > VISIBLE * most)
        .map(|curve| curve.error)
        .collect();
    errors.dedup();
    if errors.is_empty() {
        return None;
    }
    let (unit, factor) = reading_unit(budget::unit(chain, observable));
    let mut panels = Vec::new();
    let mut layouts = Vec::new();
    for &error in &errors {
        let of_error: Vec<&Curve> = curves.curves.iter().filter(|curve| curve.error == error).collect();
        let lines: Vec<Plot> = of_error
            .iter()
            .enumerate()
            .map(|(step, curve)| {
                let points = curves.t.iter().zip(&curve.influence).step_by(EVERY);
                let points = points.map(|(&t, &value)| (t, value * factor));
                // The largest size has the darkest line.
                let colour = COLOURS[COLOURS.len() - 1 - (of_error.len() - 1 - step) % COLOURS.len()];
                let line = LinePlot::new().with_data(points.collect::<Vec<_>>());
                Plot::Line(line.with_color(colour).with_stroke_width(1.5))
            })
            .collect();
        let mut layout = Layout::auto_from_plots(&lines)
            .with_title(letters::plain(&chain.symbol(error).latex))
            .with_x_label("t, rad")
            .with_y_label(format!("influence, {unit}"));
        // From zero on, an influence that does not change is a level line, and not its rounding.
        let top = factor * of_error.iter().map(|curve| largest(curve)).fold(0.0, f64::max);
        (layout.data_y_range, layout.y_range) = (Some((0.0, top)), (0.0, HEADROOM * top));
        layouts.push(layout);
        panels.push(lines);
    }
    let across = ACROSS.min(errors.len());
    let down = errors.len().div_ceil(across);
    let figure = Figure::new(down, across)
        .with_title(format!("{}: influence of each error alone", chain.observable(observable).name))
        .with_plots(panels)
        .with_layouts(layouts)
        .with_cell_size(PANEL.0, PANEL.1);
    Some(SvgBackend.render_scene(&figure.render()))
}

#[cfg(test)]
mod tests {
    use model_core::budget::{Curve, Curves};
    use model_core::{Chain, ObservableId};

    use super::{COLOURS, svg};

    #[test]
    fn an_influence_that_does_not_change_is_a_level_line() {
        let text = "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); } \
                    observe edge: direction(1, 0, 0) of top; }";
        let chain = Chain::from_text(text).expect("a declaration");
        let error = chain.find_symbol("index").expect("it has it");
        let t: Vec<f64> = (0..31).map(|k| 0.2 * f64::from(k)).collect();
        // What rounding makes of five arc seconds.
        let rounded = |k: u32| 24.24e-6 * (1.0 + f64::EPSILON * f64::from(k % 3));
        let curve = Curve { error, size: 24.24e-6, influence: (0..31).map(rounded).collect() };
        let drawn = svg(&chain, ObservableId(0), &Curves { t, curves: vec![curve] }).expect("a figure");
        let line = drawn.split("<path ").find(|path| path.contains(COLOURS[4])).expect("a line");
        let points = line.split('"').nth(1).expect("its points");
        let heights: Vec<&str> =
            points.split(['M', 'L']).filter_map(|point| point.split_whitespace().nth(1)).collect();
        assert!(heights.len() > 8 && heights.iter().all(|height| *height == heights[0]), "{points}");
        assert!(drawn.contains("text-anchor=\"end\">0</text>"), "{drawn}");
    }
}
