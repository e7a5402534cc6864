//! The `trueaxis` command.

fn main() {}
