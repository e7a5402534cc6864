//! Text that others wrote (cells, headers, names, documentation, files), as each target takes it.
//!
//! Every target has one file here, and every writer of a target goes through it. Whatever the text holds, it is shown:
//! it commands no terminal, ends no comment, opens no element and runs nowhere.
//!
//! | target | what it goes through |
//! |---|---|
//! | a message on a terminal, one line | [`message`] |
//! | an answer on a terminal, many lines | [`Screen`] |
//! | JSON | [`json`], [`json_in_script`] |
//! | HTML and SVG | [`markup`] for a text, [`page`] for what is finished |
//! | Markdown and the documentation of Rust | [`markdown`], [`markdown_code`] |
//! | words of LaTeX | [`latex`]; a formula, [`latex_formula`] |
//! | comments of Rust, C, C++, JavaScript, Python, MATLAB, LaTeX and Coq | [`comments`] |

pub mod comments;
mod json;
mod latex;
mod letters;
mod markdown;
mod markup;
mod terminal;

pub use json::{json, json_in_script};
pub use latex::{latex, latex_formula};
pub use letters::is_unseen;
pub use markdown::{markdown, markdown_code};
pub use markup::{markup, page};
pub use terminal::{Screen, clipped, line, message};
