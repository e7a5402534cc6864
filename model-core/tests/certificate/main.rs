//! Certificates, checked by Coq itself.

mod alterations;
mod coq;
mod statements;
mod support;
