#![no_main]

use btc_fuzz::laws::table;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| table::holds(bytes));
