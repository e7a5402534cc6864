//! The invariants of ARCHITECTURE.md, held.

mod dependencies;
mod house_rules;
mod registries;
mod sources;
