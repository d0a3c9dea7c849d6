#![no_main]

libfuzzer_sys::fuzz_target!(
    init: tristack_fuzz::write_seeds("manifests"),
    |data: &[u8]| tristack_fuzz::check_within(1.0, tristack_fuzz::manifests::check, data)
);
