#![no_main]

use btc_fuzz::laws::check;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| check::holds(bytes));
