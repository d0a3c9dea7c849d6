#![no_main]

libfuzzer_sys::fuzz_target!(
    init: tristack_fuzz::write_seeds("stacks"),
    |data: &[u8]| tristack_fuzz::check_within(5.0, tristack_fuzz::stacks::check, data)
);
