#![no_main]

use btc_fuzz::laws::proof;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| proof::holds(bytes));
