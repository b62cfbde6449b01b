#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| gridshell_fuzz::surface("3dm", bytes));
