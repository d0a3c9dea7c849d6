//! The exact limits that measurements are held to.

use crate::code::SettledCode;
use crate::model::{ContactConvention, Stack};
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
    limit_uncertainty(stack, convention, &uncertainty)
}

/// The exact limit of `stack` under `convention`. It is computed once: the plans of many codes, methods and
/// preparations share it.
pub(super) fn known_limit(stack: &Stack, convention: &ContactConvention) -> Limit {
    static KNOWN: Mutex<BTreeMap<String, Limit>> = Mutex::new(BTreeMap::new());
    let known = || KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let key = format!("{stack:?} {convention:?}");
    if let Some(limit) = known().get(&key) {
        return limit.clone();
    }
    let limit = quasistatic_limit(stack, convention);
    known().insert(key, limit.clone());
    limit
}
