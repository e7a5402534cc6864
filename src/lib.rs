//! The facade of trueaxis: re-exports, no logic.
#![no_std]
