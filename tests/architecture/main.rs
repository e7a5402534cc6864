//! The invariants of ARCHITECTURE.md, held.

mod circles;
mod dependencies;
mod escaping;
mod house_rules;
mod plain;
mod registries;
mod rooms;
mod sources;
mod words;
