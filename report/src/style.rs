//! How words are marked where a person looks: the styles of texts for a terminal.

use anstyle::{AnsiColor, Style};

/// Style of the word `error`.
pub const BAD: Style = AnsiColor::Red.on_default().bold();
/// Style of the word `warning`.
pub const CAREFUL: Style = AnsiColor::Yellow.on_default().bold();
/// Style of a good answer.
pub const GOOD: Style = AnsiColor::Green.on_default().bold();
/// Style of headings.
pub const HEADING: Style = Style::new().bold();
