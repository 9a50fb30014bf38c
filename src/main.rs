//! The command line of btc.

fn main() -> std::process::ExitCode {
    btc::cli::main()
}
