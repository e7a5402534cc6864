//! A picture in a card of its own.

use maud::{Markup, PreEscaped, html};

/// Size of the picture.
pub const CARD: (f64, f64) = (380.0, 262.0);

/// A picture under its title, with a note.
pub fn card(title: &str, note: &str, svg: &str) -> Markup {
    html! {
        section.card {
            h3 { (title) }
            @if !note.is_empty() { p.quiet { (note) } }
            (PreEscaped(svg))
        }
    }
}
