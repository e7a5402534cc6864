//! Certificates, checked by Coq itself.

mod alterations;
mod coq;
mod outside;
mod readings;
mod statements;
mod support;
