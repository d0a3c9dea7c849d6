//! The network, which foreign programs are shut off from where the system lets it.

use super::Bench;
use std::process::Stdio;

/// Whether this user may leave the network. If not, that is said, and fails with TRISTACK_REQUIRE_FAULTS.
pub fn can_be_left() -> bool {
    let bench = Bench::with_system_programs();
    let mut guard = bench.process("guard --offline -- true");
    let guard = guard.stdin(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let mut guard = guard.expect("it starts");
    let held = guard.stdin.take();
    let output = guard.wait_with_output().expect("it ends");
    drop(held);
    if output.status.success() {
        return true;
    }
    let message = String::from_utf8_lossy(&output.stderr);
    let refused = output.status.code() == Some(127) && message.contains("cannot start");
    assert!(refused, "{:?}: {message}", output.status);
    let required = std::env::var_os("TRISTACK_REQUIRE_FAULTS").is_some();
    assert!(!required, "it is required to leave the network: {message}");
    eprintln!("this user may not leave the network, which is not tested: {message}");
    false
}
