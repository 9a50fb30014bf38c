#![no_main]

use btc_fuzz::laws::parse;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| parse::holds(bytes));
