//! Why a file is not written.

use crate::program::Form;

/// What is asked for has no code.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum GenerateError {
    /// No observable is asked for.
    #[error(
        "there is no observable to compute: declare one with `observe name: direction(0, 0, 1) of body;`"
    )]
    NoObservable,
    /// An observable is asked for twice.
    #[error("the observable `{name}` is asked for twice")]
    RepeatedObservable {
        /// Its name.
        name: String,
    },
    /// A form is asked for twice.
    #[error("the form `{}` is asked for twice", super::form_name(*form))]
    RepeatedForm {
        /// The form.
        form: Form,
    },
    /// No form is left: Jacobians are asked for of a chain without errors.
    #[error("there is nothing to compute: a chain without errors has no Jacobians")]
    NoForm,
    /// A number of the declaration, or what follows from it, is beyond the precision that is asked for.
    #[error("{}: a number is beyond what f64, or f32 if that is asked for, can hold: check the constants and factors of the declaration", super::form_name(*form))]
    NotFinite {
        /// The form that has it.
        form: Form,
    },
    /// Single precision is asked for in a language that has none here.
    #[error("single precision is written in Rust, C and C++ only")]
    SinglePrecision,
    /// Single precision is asked for of readings.
    #[error(
        "single precision has no arc tangent here, which `{name}` needs: observe its components, `x, y, z of …`"
    )]
    SingleReading {
        /// The observable.
        name: String,
    },
    /// Single precision is asked for of a line of sight that is bent, or whose angle from up stands in an error.
    #[error("single precision has no angle between `{name}` and up here: ask for double precision")]
    SingleSight {
        /// The observable.
        name: String,
    },
    /// Derivatives are asked for of an angle that has none where there are no errors.
    #[error(
        "the angle off the axis of `{name}` has no derivative where errors are zero: leave out {}",
        super::form_name(*form)
    )]
    NoDerivative {
        /// The observable.
        name: String,
        /// The form.
        form: Form,
    },
    /// A constant of the declaration has no value.
    #[error("the constant `{name}` has no value: write it into the declaration, `const {name} = 0.25;`")]
    NoValue {
        /// The constant's name.
        name: String,
    },
    /// A value is neither one of an error nor of a constant, or not a number.
    #[error(
        "`{name}` cannot be written into the file: only errors and constants can, with finite values, each once"
    )]
    Value {
        /// The symbol's name.
        name: String,
    },
    /// The name of the file cannot stand in an include.
    #[error(
        "the file name `{}` cannot stand in an `#include`: take letters, digits, `_`, `-` and `.`",
        model_core::escape::line(name)
    )]
    FileName {
        /// The name.
        name: String,
    },
    /// The name of a file of MATLAB is that of its function.
    #[error(
        "the file name `{}` is that of a function in MATLAB: take a letter, then letters, digits and `_`, 63 at most, and no word of the language",
        model_core::escape::line(name)
    )]
    FunctionName {
        /// The name.
        name: String,
    },
    /// Standard uncertainties are asked for, and nothing says how sure the values are.
    #[error(
        "uncertainty needs a covariance: generate from an instrument file that has [covariance], or leave out uncertainty"
    )]
    NoCovariance,
    /// Standard uncertainties are asked for in single precision.
    #[error(
        "single precision has no square root here, which uncertainty needs: leave out uncertainty, or --precision f32"
    )]
    SingleUncertainty,
    /// A covariance is no square of finite numbers.
    #[error("a covariance of {count} estimates has {count} rows of {count} finite numbers; write them so")]
    Covariance {
        /// How many estimates it is of.
        count: usize,
    },
    /// A day is not written as one.
    #[error("`{}` is no day: write it as 2027-06-30", model_core::escape::line(text))]
    Date {
        /// The text.
        text: String,
    },
}
