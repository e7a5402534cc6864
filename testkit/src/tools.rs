//! Programs that a test needs beside Rust and a C compiler.

use std::path::PathBuf;
use std::process::{Command, Stdio};

use crate::skipped::skip;

/// A program, what shows that it works, and how to install it.
#[derive(Debug, Clone, Copy)]
pub struct Tool {
    /// What it is called here, and in `TESTS_WITHOUT`.
    name: &'static str,
    /// The names that it goes by, the first that works is taken.
    programs: &'static [&'static str],
    /// Arguments with which it ends well where it can do what is asked of it.
    works: &'static [&'static str],
    /// What to type where it is missing.
    install: &'static str,
}

/// Runs the shell that completions are written for.
pub const BASH: Tool =
    Tool { name: "bash", programs: &["bash"], works: &["-c", "true"], install: "apt-get install bash" };
/// Renders pages.
pub const BROWSER: Tool = Tool {
    name: "chromium",
    programs: &["chromium", "chromium-browser", "google-chrome"],
    works: &["--version"],
    install: "apt-get install chromium",
};
/// Checks certificates.
pub const COQ: Tool =
    Tool { name: "coq", programs: &["coqc"], works: &["--version"], install: "apt-get install coq" };
/// Runs generated JavaScript.
pub const NODE: Tool =
    Tool { name: "node", programs: &["node"], works: &["--version"], install: "apt-get install nodejs" };
/// Runs simulators.
pub const PYTHON: Tool =
    Tool { name: "python3", programs: PYTHONS, works: &["--version"], install: "apt-get install python3" };
/// Runs generated NumPy.
pub const NUMPY: Tool =
    Tool { name: "numpy", programs: PYTHONS, works: &["-c", "import numpy"], install: "pip install numpy" };
/// Runs generated JAX.
pub const JAX: Tool =
    Tool { name: "jax", programs: PYTHONS, works: &["-c", "import jax"], install: "pip install 'jax[cpu]'" };
/// Runs generated MATLAB.
pub const OCTAVE: Tool = Tool {
    name: "octave",
    programs: &["octave-cli", "octave"],
    works: &["--version"],
    install: "apt-get install octave",
};
/// Compiles generated C++.
pub const CXX: Tool = Tool {
    name: "c++",
    programs: &["c++", "g++", "clang++"],
    works: &["--version"],
    install: "apt-get install g++",
};
/// Derives the formulas of the gallery.
pub const SYMPY: Tool =
    Tool { name: "sympy", programs: PYTHONS, works: &["-c", "import sympy"], install: "pip install sympy" };

const PYTHONS: &[&str] = &["python3", "python"];

/// The program of a tool; `None`, with a word on standard error, where it is missing.
///
/// # Panics
///
/// Where the tool is missing, `CI` is set, and `TESTS_WITHOUT` does not name the tool.
pub fn tool(tool: Tool) -> Option<PathBuf> {
    let works = |program: &&&str| {
        let mut command = Command::new(program);
        command.args(tool.works).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        command.status().is_ok_and(|status| status.success())
    };
    let found = tool.programs.iter().find(works);
    if found.is_none() {
        skip(tool.name, tool.install);
    }
    found.map(PathBuf::from)
}
