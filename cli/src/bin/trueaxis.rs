//! The `trueaxis` command.

fn main() -> std::process::ExitCode {
    trueaxis_cli::main()
}
