//! Which pictures stand open: so many as a reader looks at, those with most left in them first; the others are a fold away.

use maud::{Markup, html};

/// Fewer rows than these are a table, and no picture.
pub const FEWEST_ROWS: usize = 6;

/// Pictures of residuals that stand open, at most.
pub const OPEN: usize = 8;

/// Pictures of harmonics that stand open beside them, at most.
pub const HARMONICS: usize = 4;

/// A picture and how much is left in it: what stands out, in units of what noise does.
pub struct Panel {
    /// How much.
    pub left: f64,
    /// Whether it spans the page.
    pub is_wide: bool,
    /// The picture.
    pub picture: Markup,
}

/// The panels that stand open, at most so many, and the others; those with most left in them first, broad ones behind the others.
pub fn parted(mut panels: Vec<Panel>, open: usize) -> [Vec<Panel>; 2] {
    panels.sort_by(|a, b| b.left.total_cmp(&a.left));
    let others = panels.split_off(open.min(panels.len()));
    panels.sort_by_key(|panel| panel.is_wide);
    [panels, others]
}

/// A fold of panels; nothing where there are none.
pub fn fold(title: &str, panels: &[Panel]) -> Markup {
    html! {
        @if !panels.is_empty() {
            details {
                summary { (title) " (" (panels.len()) @if panels.len() == 1 { " picture)" } @else { " pictures)" } }
                div.grid { @for panel in panels { (panel.picture) } }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Panel, fold, parted};
    use maud::html;

    fn panel(left: f64, is_wide: bool) -> Panel {
        Panel { left, is_wide, picture: html! { (left) } }
    }

    #[test]
    fn those_with_most_left_stand_open() {
        let panels = vec![panel(1.0, false), panel(4.0, true), panel(0.5, false), panel(3.0, false)];
        let [open, others] = parted(panels, 2);
        assert_eq!(open.iter().map(|own| own.left).collect::<Vec<_>>(), [3.0, 4.0]);
        assert_eq!(others.iter().map(|own| own.left).collect::<Vec<_>>(), [1.0, 0.5]);
        assert!(fold("Others", &others).0.contains("Others (2 pictures)"));
        assert_eq!(fold("Others", &[]).0, "");
    }
}
