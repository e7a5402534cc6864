//! Pictures as SVG: axes with round numbers, one path for each layer of marks.

use model_core::escape::markup;
use std::fmt::Write as _;

/// A shape that marks are drawn as, so that colour is never all that tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Before: an open triangle.
    Triangle,
    /// After: a dot.
    Dot,
    /// A mean: an open diamond.
    Diamond,
    /// Set aside: a cross.
    Cross,
}

/// An axis: what it shows, from where to where.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What it shows, with its unit.
    pub label: String,
    /// Where it begins.
    pub low: f64,
    /// Where it ends.
    pub high: f64,
}

impl Axis {
    /// Around some values, with room at the ends; around zero if `centred`.
    pub fn around(label: impl Into<String>, values: impl Iterator<Item = f64>, centred: bool) -> Self {
        let finite = values.filter(|value| value.is_finite());
        let (mut low, mut high) = finite
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        if low > high {
            (low, high) = (-1.0, 1.0);
        }
        if centred {
            high = low.abs().max(high.abs());
            low = -high;
        }
        if high - low <= 1e-12 * high.abs().max(1e-300) {
            let half = if high == 0.0 { 1.0 } else { high.abs() / 2.0 };
            (low, high) = (low - half, high + half);
        }
        let room = 0.04 * (high - low);
        Self { label: label.into(), low: low - room, high: high + room }
    }

    /// Round numbers within.
    fn ticks(&self, about: f64) -> Vec<f64> {
        let rough = (self.high - self.low) / about;
        let power = 10_f64.powf(rough.log10().floor());
        let step =
            [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|&s| s >= rough).unwrap_or(rough);
        // A handful of ticks at most.
        #[allow(clippy::cast_possible_truncation)]
        let (first, last) = ((self.low / step).ceil() as i64, (self.high / step).floor() as i64);
        (first..=last).take(20).map(|at| at as f64 * step).collect()
    }
}

/// A picture that grows layer by layer.
pub struct Picture {
    width: f64,
    height: f64,
    x: Axis,
    y: Axis,
    body: String,
    /// Names of the columns that hover and brush read: x, y before, y after.
    columns: [String; 3],
}

const LEFT: f64 = 46.0;
const RIGHT: f64 = 10.0;
const TOP: f64 = 10.0;
const BOTTOM: f64 = 36.0;

impl Picture {
    /// An empty one of so many pixels, with both axes.
    #[must_use]
    pub fn new(width: f64, height: f64, x: Axis, y: Axis) -> Self {
        Self { width, height, x, y, body: String::new(), columns: Default::default() }
    }

    /// Lets the script find its rows.
    pub fn of_rows(mut self, x: &str, before: &str, after: &str) -> Self {
        self.columns = [x, before, after].map(str::to_owned);
        self
    }

    /// Which of some cells, so many across and so many up, a point lies in.
    pub fn cells(&self, (across, up): (usize, usize)) -> impl Fn((f64, f64)) -> usize + use<> {
        let (x, y) = (self.x.clone(), self.y.clone());
        // Within the axes by their making; what is not goes to the nearest cell.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let index = |axis: &Axis, value: f64, count: usize| {
            let share = (value - axis.low) / (axis.high - axis.low) * count as f64;
            (share.max(0.0) as usize).min(count - 1)
        };
        move |(at_x, at_y)| index(&y, at_y, up) * across + index(&x, at_x, across)
    }

    fn at(&self, x: f64, y: f64) -> (f64, f64) {
        let across = (x - self.x.low) / (self.x.high - self.x.low);
        let up = (y - self.y.low) / (self.y.high - self.y.low);
        (
            LEFT + across * (self.width - LEFT - RIGHT),
            self.height - BOTTOM - up * (self.height - TOP - BOTTOM),
        )
    }

    /// Marks of one kind; `class` says whose they are.
    pub fn marks(&mut self, class: &str, mark: Mark, points: impl Iterator<Item = (f64, f64)>) {
        let mut path = String::new();
        for (x, y) in points.filter(|(x, y)| x.is_finite() && y.is_finite()) {
            let (x, y) = self.at(x, y);
            let _ = match mark {
                Mark::Triangle => write!(path, "M{x:.1} {:.1}l3 5h-6z", y - 3.0),
                Mark::Dot => write!(path, "M{x:.1} {y:.1}h0"),
                Mark::Diamond => write!(path, "M{x:.1} {:.1}l4 4-4 4-4-4z", y - 4.0),
                Mark::Cross => write!(path, "M{:.1} {:.1}l6 6m0-6l-6 6", x - 3.0, y - 3.0),
            };
        }
        if !path.is_empty() {
            let kind = match mark {
                Mark::Triangle => "tri",
                Mark::Dot => "dot",
                Mark::Diamond => "dia",
                Mark::Cross => "cross",
            };
            let _ = write!(self.body, "<path class=\"{class} {kind}\" d=\"{path}\"/>");
        }
    }

    /// A line through points.
    pub fn line(&mut self, class: &str, points: impl Iterator<Item = (f64, f64)>) {
        let mut path = String::new();
        for (x, y) in points.filter(|(x, y)| x.is_finite() && y.is_finite()) {
            let (x, y) = self.at(x, y);
            let _ = write!(path, "{}{x:.1} {y:.1}", if path.is_empty() { "M" } else { "L" });
        }
        let _ = write!(self.body, "<path class=\"{class}\" d=\"{path}\"/>");
    }

    /// An area between two curves: place, lower, upper.
    pub fn band(&mut self, class: &str, rows: &[[f64; 3]]) {
        let up = rows.iter().map(|row| self.at(row[0], row[2]));
        let down = rows.iter().rev().map(|row| self.at(row[0], row[1]));
        let points: Vec<String> = up.chain(down).map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
        let _ = write!(self.body, "<path class=\"{class}\" d=\"M{}z\"/>", points.join("L"));
    }

    /// Arrows: from where, by how much in units of the picture's points.
    pub fn arrows(&mut self, class: &str, arrows: impl Iterator<Item = ((f64, f64), (f64, f64))>) {
        let mut path = String::new();
        for ((x, y), (dx, dy)) in arrows {
            let (x, y) = self.at(x, y);
            let _ = write!(path, "M{x:.1} {y:.1}l{dx:.1} {:.1}", -dy);
        }
        let _ = write!(self.body, "<path class=\"{class} arrow\" d=\"{path}\"/>");
    }

    /// A bar of some length at the upper edge, with what it stands for.
    pub fn scale(&mut self, length: f64, told: &str) {
        let right = self.width - RIGHT - 4.0;
        let _ = write!(
            self.body,
            "<path class=\"scale\" d=\"M{:.1} {:.1}h{length:.1}m0-3v6m-{length:.1}-6v6\"/>\
             <text class=\"onplot\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            right - length,
            TOP + 8.0,
            right - length - 5.0,
            TOP + 12.0,
            markup(told)
        );
    }

    /// Bars from zero, each from one place to another.
    pub fn bars(&mut self, class: &str, bars: impl Iterator<Item = (f64, f64, f64)>) {
        let mut path = String::new();
        for (from, to, height) in bars {
            let ((x0, y0), (x1, y1)) = (self.at(from, 0.0), self.at(to, height));
            let _ = write!(path, "M{x0:.1} {y0:.1}V{y1:.1}H{x1:.1}V{y0:.1}z");
        }
        let _ = write!(self.body, "<path class=\"{class}\" d=\"{path}\"/>");
    }

    /// The picture with its axes; `name` is what a reader who does not see it is told.
    pub fn finish(&self, name: &str) -> String {
        let mut svg = format!(
            "<svg viewBox=\"0 0 {:.0} {:.0}\" role=\"img\" aria-label=\"{}\"",
            self.width,
            self.height,
            markup(name)
        );
        if !self.columns[0].is_empty() {
            let _ = write!(
                svg,
                " class=\"rows\" data-x=\"{}\" data-before=\"{}\" data-after=\"{}\" data-range=\"{:e},{:e},{:e},{:e}\" \
                 data-box=\"{LEFT},{TOP},{:.1},{:.1}\"",
                markup(&self.columns[0]),
                markup(&self.columns[1]),
                markup(&self.columns[2]),
                self.x.low,
                self.x.high,
                self.y.low,
                self.y.high,
                self.width - LEFT - RIGHT,
                self.height - TOP - BOTTOM
            );
        }
        svg.push_str("><g class=\"axes\">");
        self.axes(&mut svg);
        svg.push_str("</g><g class=\"plot\">");
        svg.push_str(&self.body);
        svg.push_str("</g><g class=\"over\"></g></svg>");
        svg
    }

    fn axes(&self, svg: &mut String) {
        let (right, bottom) = (self.width - RIGHT, self.height - BOTTOM);
        let about = (self.width / 75.0).clamp(3.0, 9.0);
        for tick in self.x.ticks(about) {
            let (x, _) = self.at(tick, self.y.low);
            let _ = write!(
                svg,
                "<path class=\"grid\" d=\"M{x:.1} {TOP}V{bottom:.1}\"/><text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                bottom + 13.0,
                number(tick)
            );
        }
        for tick in self.y.ticks(5.0) {
            let (_, y) = self.at(self.x.low, tick);
            let _ = write!(
                svg,
                "<path class=\"grid\" d=\"M{LEFT} {y:.1}H{right:.1}\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                LEFT - 5.0,
                y + 4.0,
                number(tick)
            );
        }
        if self.y.low < 0.0 && self.y.high > 0.0 {
            let (_, y) = self.at(self.x.low, 0.0);
            let _ = write!(svg, "<path class=\"zero\" d=\"M{LEFT} {y:.1}H{right:.1}\"/>");
        }
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" class=\"label\">{}</text>\
             <text transform=\"translate(11 {:.1}) rotate(-90)\" text-anchor=\"middle\" class=\"label\">{}</text>",
            f64::midpoint(LEFT, right),
            self.height - 6.0,
            markup(&self.x.label),
            f64::midpoint(TOP, bottom),
            markup(&self.y.label)
        );
    }
}

/// A tick's number, with a real minus; many thousands as `200k`.
fn number(tick: f64) -> String {
    if tick.abs() >= 1e4 && tick % 1000.0 == 0.0 {
        return format!("{}k", number(tick / 1000.0));
    }
    let rounded = format!("{tick:.6}");
    let short = rounded.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" || short.is_empty() { "0".to_owned() } else { short.replace('-', "−") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        let axis = Axis { label: String::new(), low: -7.3, high: 12.1 };
        assert_eq!(axis.ticks(5.0), [-5.0, 0.0, 5.0, 10.0]);
        assert_eq!(number(-5.0), "−5");
        assert_eq!(number(0.25), "0.25");
        assert_eq!(number(-200_000.0), "−200k");
        let flat = Axis::around("x", [3.0, 3.0].into_iter(), false);
        assert!(flat.low < 3.0 && flat.high > 3.0);
    }

    #[test]
    fn names_cannot_break_the_markup() {
        let axis = || Axis::around("<b>\"&", [0.0, 1.0].into_iter(), false);
        let mut picture = Picture::new(300.0, 200.0, axis(), axis());
        picture.marks("after", Mark::Dot, [(0.5, 0.5), (f64::NAN, 0.0)].into_iter());
        let svg = picture.finish("a \"name\" <x>");
        assert!(!svg.contains("<b>") && !svg.contains("NaN"), "{svg}");
        assert!(svg.contains("a &quot;name&quot; &lt;x&gt;"));
    }
}
