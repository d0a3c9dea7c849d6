//! Digest of the sources of the native DEM.

use crate::model::sha256_hex;
use std::sync::LazyLock;

/// Digest of the sources that decide the numbers of the native DEM; it replaces the deck hash of an external code.
pub static SOURCE_DIGEST: LazyLock<String> = LazyLock::new(|| {
    let sources = [
        include_str!("../model/law/contact_law.rs"),
        include_str!("../model/law/damping.rs"),
        include_str!("../model/law/power.rs"),
        include_str!("../model/law/tangential.rs"),
        include_str!("../model/arrangement.rs"),
        include_str!("../model/ring.rs"),
        include_str!("contact.rs"),
        include_str!("contact_run.rs"),
        include_str!("contact_state.rs"),
        include_str!("double_double.rs"),
        include_str!("first_event.rs"),
        include_str!("geometry.rs"),
        include_str!("lane_group.rs"),
        include_str!("lanes.rs"),
        include_str!("loading.rs"),
        include_str!("power_law.rs"),
        include_str!("real.rs"),
        include_str!("scene.rs"),
        include_str!("stack_scene.rs"),
        include_str!("wall.rs"),
    ];
    sha256_hex(sources.concat().as_bytes())
});
