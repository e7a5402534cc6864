//! What a designer asks of a budget on the command line.

mod designer;
mod options;

pub use designer::designed;
pub use options::{DesignerArguments, positive};
