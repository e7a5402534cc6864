//! A campaign as files: a table of the poses, a picture of them, and a page for a browser.

use kuva::backend::svg::SvgBackend;
use kuva::plot::ScatterPlot;
use kuva::render::figure::Figure;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot;
use maud::{DOCTYPE, PreEscaped, html};
use model_core::escape;
use report::page::STYLE;
use report::words::numbers;

use super::text::headline;
use super::{Asked, Axis, Planned, unit_of};

/// Panels side by side.
const ACROSS: usize = 2;
/// Width and height of a panel, in pixels.
const PANEL: (f64, f64) = (420.0, 320.0);
/// Colour of a pose.
const COLOUR: &str = "#2171b5";

/// The poses as a table, in the units in which they are set.
#[must_use]
pub fn as_csv(asked: &Asked<'_>, planned: &Planned) -> String {
    let headings: Vec<String> = asked.axes.iter().map(|axis| axis.heading(asked.chain)).collect();
    let mut lines = vec![headings.join(",")];
    lines.extend(planned.poses.iter().map(|pose| cells(asked, pose).join(",")));
    format!("{}\n", lines.join("\n"))
}

fn cells(asked: &Asked<'_>, pose: &[f64]) -> Vec<String> {
    asked.axes.iter().zip(pose).map(|(axis, &si)| axis.written(si)).collect()
}

/// The poses as a picture: each axis against the next; `None` where nothing moves.
#[must_use]
pub fn svg(asked: &Asked<'_>, planned: &Planned) -> Option<String> {
    let moving: Vec<usize> = (0..asked.axes.len()).filter(|&at| !asked.axes[at].is_fixed()).collect();
    let axis = |at: usize| &asked.axes[at];
    let value = |at: usize, pose: &[f64]| pose[at] / axis(at).unit.map_or(1.0, |unit| unit.in_si());
    let pairs: Vec<(usize, Option<usize>)> = match moving.as_slice() {
        [] => return None,
        [only] => vec![(*only, None)],
        several => several.windows(2).map(|pair| (pair[0], Some(pair[1]))).collect(),
    };
    if planned.poses.is_empty() {
        return None;
    }
    let label = |own: &Axis| own.heading(asked.chain);
    let (mut panels, mut layouts) = (Vec::new(), Vec::new());
    for &(across, up) in &pairs {
        let points = planned.poses.iter().enumerate().map(|(number, pose)| {
            let number = number as f64 + 1.0;
            (value(across, pose), up.map_or(number, |up| value(up, pose)))
        });
        let plot = ScatterPlot::new().with_data(points.collect::<Vec<_>>()).with_color(COLOUR).with_size(4.0);
        let plots = vec![Plot::Scatter(plot)];
        layouts.push(
            Layout::auto_from_plots(&plots)
                .with_x_label(label(axis(across)))
                .with_y_label(up.map_or_else(|| "pose".to_owned(), |up| label(axis(up)))),
        );
        panels.push(plots);
    }
    let columns = ACROSS.min(pairs.len());
    let figure = Figure::new(pairs.len().div_ceil(columns), columns)
        .with_plots(panels)
        .with_layouts(layouts)
        .with_cell_size(PANEL.0, PANEL.1);
    Some(SvgBackend.render_scene(&figure.render()))
}

/// The whole page; nothing in it comes from elsewhere, and it has no script.
#[must_use]
pub fn page(asked: &Asked<'_>, planned: &Planned, command: &str) -> String {
    let chain = asked.chain;
    let (title, more) = headline(asked, planned);
    let seen = &chain.observable(asked.observable).name;
    let told = |value: f64, error| numbers::told(value, unit_of(chain, error));
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Campaign for " (chain.name) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header { strong { (chain.name) } p.quiet { "first campaign, measuring " (seen) } }
                main {
                    h1 { (title) }
                    @for sentence in &more { p.lead { (sentence) } }
                    section {
                        h2 { "What to expect" }
                        table {
                            thead { tr { th { "error" } th { "expected ±" } th { "wanted ±" } th { "" } } }
                            tbody {
                                @for own in &planned.errors {
                                    tr {
                                        td { (chain.symbol(own.error).name) }
                                        td { @if let Some(value) = own.expected { (told(value, own.error)) } @else { "-" } }
                                        td { (told(own.wanted, own.error)) }
                                        td { @if own.is_reached() { "reached" } @else if let Some(why) = &own.lost { (why) } @else { "not reached" } }
                                    }
                                }
                            }
                        }
                    }
                    @if !planned.poses.is_empty() {
                        section {
                            h2 { "Where to measure" }
                            @if let Some(figure) = svg(asked, planned) { (PreEscaped(figure)) }
                            table {
                                thead { tr { th { "" } @for axis in &asked.axes { th { (axis.heading(chain)) } } } }
                                tbody {
                                    @for (at, pose) in planned.poses.iter().enumerate() {
                                        tr { td { (at + 1) } @for cell in cells(asked, pose) { td { (cell) } } }
                                    }
                                }
                            }
                        }
                    }
                }
                footer.quiet { p { "trueaxis " (env!("CARGO_PKG_VERSION")) ": " code { (command) } } }
            }
        }
    };
    escape::page(&page.0).into_owned()
}
