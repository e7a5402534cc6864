//! Declare an instrument as a chain of bodies with small errors, once, and get everything that follows from it.
//!
//! A turntable is declared with one error, the zero of its scale. Its data hold another one that nobody declared: the scale
//! sits 20″ off centre. The calibration finds it and writes it into the declaration.
//!
//! ```
//! # #[cfg(feature = "analysis")] {
//! use trueaxis::{Calibration, Chain, Study};
//!
//! let text = "
//!     chain Turntable {
//!         body table on ground { motion: Rz(angle); motion_error: Rz(zero); }
//!         observe mark: direction(1, 0, 0) of table;
//!     }
//! ";
//! // What follows from the declaration alone: to first order, the error of the mark is its zero across the line of sight.
//! let chain = Chain::from_text(text).unwrap();
//! let mark = chain.find_observable("mark").unwrap();
//! let error = trueaxis::derive(&chain, mark, 1).unwrap();
//! assert!(trueaxis::print::form(&error, &chain, trueaxis::print::Style::Text).contains("-zero*sin(angle)"));
//!
//! // Measured data: 72 settings, and noise of about 1″.
//! let arcsec = std::f64::consts::PI / 648_000.0;
//! let mut data = "angle [deg],x,y,z\n".to_owned();
//! for step in 0..72_u32 {
//!     let angle = f64::from(5 * step).to_radians();
//!     let noise = f64::from(step.wrapping_mul(2_654_435_761) >> 16) / 65_536.0 - 0.5;
//!     let true_angle = angle + arcsec * (30.0 + 20.0 * angle.cos() + 3.0 * noise);
//!     data += &format!("{},{},{},0\n", 5 * step, true_angle.cos(), true_angle.sin());
//! }
//!
//! let study = Study::from_text(r#"
//!     chain = "turntable.chain"
//!     data = "measured.csv"
//!     [observed]
//!     kind = "direction"
//!     x = "x"
//!     y = "y"
//!     z = "z"
//! "#).unwrap();
//! let mut open = |_: &str| Ok(data.clone().into_bytes().into());
//! let calibration = Calibration::of(text, &study, &mut open, "2026-11-22").unwrap();
//!
//! assert!(calibration.diagnosis.effects[0].names[0].contains("eccentricity"));
//! assert!(calibration.amended.unwrap().contains("cos(angle)"));
//! # }
//! ```
//!
//! - [`chain!`] and [`chain_file!`] expand a declaration to a module: its exact and first-order errors, Jacobians,
//!   closed forms. They work in `no_std` crates with the feature `libm` in place of the default ones.
//! - With the feature `analysis` (on by default): [`Chain`], the declaration, and what follows from it by algebra
//!   ([`model_core`]); printed formulas checked ([`claims`]) and proved ([`proof`]); generated evaluators in other languages ([`codegen`]); [`Study`] and [`Calibration`], measured data
//!   ([`calibration`]).
//!
//! This crate is a facade: it has no logic of its own.
#![no_std]

/// # Example
///
/// ```
/// trueaxis::chain! {
///     chain Turntable {
///         body table on ground { motion: Rz(alpha); motion_error: Rz(zero); }
///         observe arm: direction(1, 0, 0) of table;
///     }
/// }
///
/// let table = turntable::Turntable::new(turntable::Errors { zero: 1e-5 });
/// let error = table.arm_error(&turntable::Joints { alpha: 0.0 });
/// assert!((error.y - 1e-5).abs() < 1e-15);
/// ```
pub use model_macros::chain;

/// # Example
///
/// ```
/// trueaxis::chain_file!("examples/alt-azimuth/alt-azimuth.chain");
///
/// let mount = alt_azimuth::AltAzimuth::new(alt_azimuth::Errors { collimation: 1e-4, ..Default::default() });
/// let level = alt_azimuth::Joints { azimuth: 0.0, elevation: 0.0 };
/// assert!((mount.sight_error(&level).x.abs() - 1e-4).abs() < 1e-11);
/// ```
pub use model_macros::chain_file;

/// The vectors and matrices that expanded declarations give.
///
/// # Example
///
/// ```
/// trueaxis::chain! {
///     chain Turntable {
///         body table on ground { motion: Rz(alpha); motion_error: Rz(zero); }
///         observe arm: direction(1, 0, 0) of table;
///     }
/// }
///
/// let table = turntable::Turntable::new(turntable::Errors { zero: 1e-5 });
/// let arm: trueaxis::nalgebra::Vector3<f64> = table.arm(&turntable::Joints { alpha: 0.5 });
/// assert!((arm.norm() - 1.0).abs() < 1e-15);
/// ```
pub use nalgebra;

/// Measured data: what a [`Calibration`] is made of.
///
/// # Example
///
/// ```
/// use trueaxis::{Calibration, Study};
///
/// let chain = "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); }
///              observe edge: direction(1, 0, 0) of top; }";
/// let study = "chain = 'table.chain'\ndata = 'rows.csv'\n[observed]\nkind = 'direction'\nx = 'x'\ny = 'y'\nz = 'z'";
/// let study = Study::from_text(study)?;
/// // A table without rows is an error that says so.
/// let mut open = |_: &str| Ok(b"turn,x,y,z\n".to_vec().into());
/// let error = Calibration::of(chain, &study, &mut open, "2026-11-22").unwrap_err();
/// assert!(error.to_string().contains("rows.csv"), "{error}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "analysis")]
pub use calibration;

/// Generated evaluators in other languages.
///
/// # Example
///
/// ```
/// use trueaxis::Chain;
/// use trueaxis::codegen::{Form, Language, Unit, generate};
///
/// let text = "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); }
///             observe edge: direction(1, 0, 0) of top; }";
/// let chain = Chain::from_text(text)?;
/// let edge = [chain.find_observable("edge").ok_or("no such observable")?];
/// let files = generate(&Unit::new(&chain, text, &edge, &[Form::ExactError]), Language::C, "table")?;
/// assert_eq!(files.iter().map(|file| file.extension).collect::<Vec<_>>(), ["c", "h"]);
/// assert!(files[1].text.contains("table_exact_error"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "analysis")]
pub use claims;
#[cfg(feature = "analysis")]
pub use codegen;

/// The declaration, and what follows from it by algebra.
///
/// # Example
///
/// ```
/// use trueaxis::Chain;
/// use trueaxis::model_core::SymbolKind;
///
/// let chain = Chain::from_text(
///     "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); }
///      observe edge: direction(1, 0, 0) of top; }",
/// )?;
/// let errors: Vec<&str> =
///     chain.symbols_of(SymbolKind::Error).map(|id| chain.symbol(id).name.as_str()).collect();
/// assert_eq!(errors, ["index"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "analysis")]
pub use model_core;
#[cfg(feature = "analysis")]
pub use proof;

/// # Example
///
/// The example of [this crate](crate) calibrates a turntable. Data that do not fit the declaration are refused with what is missing:
///
/// ```
/// use trueaxis::{Calibration, Study};
///
/// let chain = "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); }
///              observe edge: direction(1, 0, 0) of top; }";
/// let study = "chain = 'table.chain'\ndata = 'rows.csv'\n[observed]\nkind = 'direction'\nx = 'x'\ny = 'y'\nz = 'z'";
/// let study = Study::from_text(study)?;
/// let mut open = |_: &str| Ok(b"angle,x,y,z\n0,1,0,0\n".to_vec().into());
/// let error = Calibration::of(chain, &study, &mut open, "2026-11-22").unwrap_err();
/// assert!(error.to_string().contains("turn"), "{error}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "analysis")]
pub use calibration::calibrate::Calibration;

/// # Example
///
/// ```
/// use trueaxis::Study;
///
/// let study = Study::from_text(
///     "chain = 'table.chain'\ndata = 'rows.csv'\n[observed]\nkind = 'direction'\nx = 'x'\ny = 'y'\nz = 'z'",
/// )?;
/// assert_eq!(study.chain.get_ref(), "table.chain");
/// assert!(Study::from_text("chain = 'table.chain'").is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "analysis")]
pub use study::Study;

/// # Example
///
/// ```
/// use trueaxis::Chain;
///
/// let chain = Chain::from_text(
///     "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); }
///      observe edge: direction(1, 0, 0) of top; }",
/// )?;
/// assert!(chain.find_observable("edge").is_some() && chain.find_symbol("index").is_some());
///
/// let text = "chain Table { body top on base { motion: Rz(turn); } }";
/// let mistakes = Chain::from_text(text).unwrap_err();
/// assert!(mistakes.render("table.chain", text).contains("`base`"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "analysis")]
pub use model_core::Chain;

/// # Example
///
/// ```
/// use trueaxis::{Chain, derive, print};
///
/// let chain = Chain::from_text(
///     "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); }
///      observe edge: direction(1, 0, 0) of top; }",
/// )?;
/// let edge = chain.find_observable("edge").ok_or("no such observable")?;
/// let error = derive(&chain, edge, 1)?;
/// assert!(print::form(&error, &chain, print::Style::Text).contains("index*cos(turn)"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "analysis")]
pub use model_core::forms::derive;

/// # Example
///
/// ```
/// use trueaxis::{Chain, identify};
///
/// let chain = Chain::from_text(
///     "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index), Rx(wobble); }
///      observe edge: direction(1, 0, 0) of top; }",
/// )?;
/// let edge = chain.find_observable("edge").ok_or("no such observable")?;
/// // The edge lies along x: nothing shows a turn about it.
/// let unseen = identify(&chain, &[edge])?.invisible;
/// assert_eq!(unseen.iter().map(|&id| chain.symbol(id).name.as_str()).collect::<Vec<_>>(), ["wobble"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "analysis")]
pub use model_core::identify::identify;

/// # Example
///
/// ```
/// use trueaxis::{Chain, derive, print};
///
/// let chain = Chain::from_text(
///     "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); }
///      observe edge: direction(1, 0, 0) of top; }",
/// )?;
/// let edge = chain.find_observable("edge").ok_or("no such observable")?;
/// let printed = print::form(&derive(&chain, edge, 1)?, &chain, print::Style::Latex);
/// assert!(printed.contains(r"\cos"), "{printed}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "analysis")]
pub use model_core::print;

/// # Example
///
/// ```
/// use trueaxis::model_core::remainder::Domain;
/// use trueaxis::{Chain, bound};
///
/// let chain = Chain::from_text(
///     "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); }
///      observe edge: direction(1, 0, 0) of top; }",
/// )?;
/// let edge = chain.find_observable("edge").ok_or("no such observable")?;
/// let index = chain.find_symbol("index").ok_or("no such error")?;
/// let mut domain = Domain::new(&chain);
/// domain.set_range(&chain, index, -1e-3, 1e-3)?;
/// // What the first order leaves out of a turn by ε is about ε²/2.
/// assert!((bound(&chain, edge, &domain)?.value / 0.5e-6 - 1.0).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "analysis")]
pub use model_core::remainder::bound;

/// What the expansion of [`chain!`] uses; not meant for anything else.
#[doc(hidden)]
pub mod __private {
    pub use nalgebra::{ComplexField, Matrix3, RealField, SMatrix, Vector3};
}
