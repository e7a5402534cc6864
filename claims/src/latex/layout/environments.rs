//! Environments of LaTeX: which hold a matrix, and which lay out formulas.

/// Environments whose cells are entries of a matrix.
pub(in crate::latex) const MATRICES: [&str; 11] = [
    "matrix",
    "pmatrix",
    "bmatrix",
    "Bmatrix",
    "vmatrix",
    "smallmatrix",
    "array",
    "cases",
    "dcases",
    "rcases",
    "drcases",
];

/// Environments that lay out formulas; a star may stand behind the name.
const DISPLAYS: [&str; 14] = [
    "equation",
    "align",
    "aligned",
    "alignat",
    "alignedat",
    "IEEEeqnarray",
    "subequations",
    "gather",
    "gathered",
    "eqnarray",
    "split",
    "multline",
    "flalign",
    "displaymath",
];

/// Whether an environment lays out formulas.
pub(super) fn is_display(name: &str) -> bool {
    DISPLAYS.contains(&name.trim_end_matches('*'))
}
