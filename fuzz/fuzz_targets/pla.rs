#![no_main]

use btc_fuzz::laws::pla;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| pla::holds(bytes));
