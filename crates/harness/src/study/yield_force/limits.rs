//! The exact limits that measurements are held to.

use crate::code::SettledCode;
use crate::model::{ContactConvention, Problem, Stack};
use crate::theory::{Limit, limit_uncertainty, quasistatic_limit};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Uncertainty of the limit of `stack` from those arms of `code` that were measured; `None` if all arms are declared,
/// or nothing yields.
pub(super) fn convention_uncertainty(
    code: &SettledCode,
    stack: &Stack,
    convention: &ContactConvention,
) -> Option<f64> {
    let uncertainty = code.settled().measured_arms()?;
    limit_uncertainty(&Problem::new(*stack, *convention).ok()?, &uncertainty)
}

/// The exact limit of `stack` under `convention`; none, with the reason, if a value is out of range. It is computed
/// once: the plans of many codes, methods and preparations share it.
pub(super) fn known_limit(stack: &Stack, convention: &ContactConvention) -> Limit {
    static KNOWN: Mutex<BTreeMap<String, Limit>> = Mutex::new(BTreeMap::new());
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let key = format!("{stack:?} {convention:?}");
    if let Some(limit) = known().get(&key) {
        return limit.clone();
    }
    let limit = match Problem::new(*stack, *convention) {
        Ok(problem) => quasistatic_limit(&problem),
        Err(refused) => Limit {
            bodies: stack.bodies,
            time_scale: 1.0,
            reason: Some(refused.to_string()),
            ..Limit::default()
        },
    };
    known().insert(key, limit.clone());
    limit
}
