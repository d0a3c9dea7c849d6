#![no_main]

libfuzzer_sys::fuzz_target!(
    init: tristack_fuzz::write_seeds("forecasts"),
    |data: &[u8]| tristack_fuzz::check_within(5.0, tristack_fuzz::forecasts::check, data)
);
