//! btc
fn main() {}
