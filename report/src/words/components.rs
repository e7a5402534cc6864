//! Components of a residual as a person says them; files and programs keep their names.

/// `sideways`, for a component that is called `across` in files.
#[must_use]
pub fn side(name: &str) -> &str {
    match name {
        "across" => "sideways",
        "along" => "lengthwise",
        "up" => "upward",
        other => other,
    }
}

/// `sideways residual`, `x residual`.
#[must_use]
pub fn component_in_words(name: &str) -> String {
    format!("{} residual", side(name))
}
