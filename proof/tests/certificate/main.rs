//! Certificates, checked by Coq itself.

mod alterations;
mod coq;
mod jacobians;
mod outside;
mod readings;
mod shown;
mod statements;
mod support;
mod values;
