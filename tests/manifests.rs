//! Codes as their folders describe them.

use tristack::code::Code;
use tristack::study::trajectory::{Branch, Quantity, Twin, documented};

/// Every order, with its reason, that is expected of the distance between a code and its twin.
#[test]
fn documented_orders_follow_from_the_manifests() {
    let mut lines = Vec::new();
    for code in Code::ALL {
        for twin in [Twin::Full, Twin::RotatedSpring] {
            for quantity in Quantity::ALL {
                for branch in Branch::ALL {
                    let found = documented(code, twin, quantity, branch);
                    lines.push(format!(
                        "{code}, {twin:?}, {quantity:?}, {branch:?}: {:?}: {}",
                        found.order, found.reason
                    ));
                }
            }
        }
    }
    insta::assert_snapshot!(lines.join("\n"));
}
