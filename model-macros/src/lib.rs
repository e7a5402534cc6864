//! `chain!` and `chain_file!`: thin macros that parse with `model-core` and expand with `codegen`.
