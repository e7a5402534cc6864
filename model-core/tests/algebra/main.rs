//! Tries to break the canonical form: expressions rewritten by true identities must meet, others must not.
#![allow(clippy::unwrap_used)]

mod canonical;
mod expressions;
mod limits;
mod operations;
