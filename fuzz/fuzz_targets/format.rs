#![no_main]

use btc_fuzz::laws::format;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| format::holds(bytes));
