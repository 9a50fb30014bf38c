//! The command line of btc.

/// A search over trees makes and drops millions of small ones: with the system's allocator a quarter of its time goes there.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    btc::cli::main()
}
