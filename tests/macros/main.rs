//! What `chain!` and `chain_file!` expand to, compared with the reference in `model-core` and with theory, for
//! chains of one, two, three and six joints, prismatic joints, a tree, harmonics in the errors, and inputs.

mod agreement;
mod chains;
mod closed_forms;
#[rustfmt::skip]
#[warn(clippy::pedantic)]
mod expanded;
mod reference;
mod second_order;
