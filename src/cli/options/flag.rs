//! Flags in place of the keys of case files.

use crate::model::InvalidValue;

/// Returns `error` with the flag in place of the key of a case file. Keys of a convention and of its law have flags of
/// their own names, but for the arms.
pub(in crate::cli) fn as_flag(error: InvalidValue) -> InvalidValue {
    let named = |key: &str| format!("--{}", key.replace('_', "-"));
    let flag = match error.key.as_str() {
        "stack.floor_friction" => "--mu",
        "stack.cylinder_friction" => "--mu-d",
        "stack.stiffness" => "--stiffness",
        "stack.stiffness_ratio" => "--kappa",
        "stack.bodies" => "--bodies",
        "convention.pair" | "convention.pair.torque_arm" => "--pair-arm",
        "convention.pair.kinematic_arm" => "--pair-kinematic-arm",
        "convention.floor" | "convention.floor.torque_arm" => "--floor-arm",
        "convention.floor.kinematic_arm" => "--floor-kinematic-arm",
        "cylinder.density" => "--density",
        "cylinder.poisson_ratio" => "--poisson",
        "mu_uncertainty" => "--mu-uncertainty",
        "protocol.wall_speed" => "--speed",
        "protocol.time_step" => "--dt",
        "protocol.preparation.kind" => "--preparation",
        "protocol.preparation.push" => "--push",
        "protocol.shortcuts" => "--shortcuts",
        other => match other.strip_prefix("convention.") {
            Some(key) => &named(key.trim_start_matches("law.")),
            None => other,
        },
    };
    InvalidValue {
        key: flag.to_owned(),
        ..error
    }
}
