//! The language: what texts mean, and what is said of texts that mean nothing.

mod angles;
mod constants;
mod examples;
mod inputs;
mod joints;
mod mistakes;
mod properties;
mod ramps;
mod sight;
