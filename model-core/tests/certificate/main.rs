//! Certificates, checked by Coq itself.

mod alterations;
mod coq;
mod outside;
mod statements;
mod support;
