//! The last program that `cargo test --workspace` runs, as packages are tested in the order of their names: one line says what was
//! skipped, and what to install.

fn main() {
    #[allow(clippy::print_stdout, reason = "what a run ends with")]
    {
        println!("\n{}", testkit::last_line());
    }
}
