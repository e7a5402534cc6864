//! Claims files as texts: notations, kinds of statements, what is unread.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod hostile;
mod kinds;
mod mathml;
mod names;
mod notation;
mod referee;
mod support;
mod unread;
mod unseen;
