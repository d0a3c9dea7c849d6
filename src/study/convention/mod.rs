//! What a code means by "contact", measured: micro-tests of one contact each, and the law read off them.
//!
//! Nothing is taken from the declaration of a code but what to compare with. Mass, inertia and the moments
//! of velocities come from free motion; stiffness, damping and arms from linear regression of the reported
//! forces on the reported motion, in which a right law leaves nothing but rounding.

mod clock;
mod contact_frame;
mod experiments;
mod measured;
mod normal;
mod plan;
mod properties;
mod regression;
mod sliding;
mod tangential;

pub use measured::{
    Findings, ProbeError, Probed, arms_are_measured, contradictions, is_contradicted,
    other_program, probe_all, record_probe,
};
pub use properties::{Finding, NATIVE_TOLERANCE, Property, TOLERANCE};
pub use regression::Measured;

use crate::code::Declaration;
use crate::model::ContactTest;
use crate::series::Motion;
use clock::Clock;
use contact_frame::contact_rows;
use experiments::ContactKind;
use plan::{Laws, Plan, TestedMotion};

const CONTACT_KINDS: [ContactKind; 3] = [ContactKind::Pair, ContactKind::Floor, ContactKind::Wall];

/// Measures every property of a code that `declared` itself so. `run` carries out micro-tests; it is called
/// twice, because how fast a contact must move to be at the slip threshold has to be measured first.
///
/// # Errors
/// Those of `run`.
pub fn probe<E>(
    declared: &Declaration,
    mut run: impl FnMut(&[ContactTest]) -> Result<Vec<Motion>, E>,
) -> Result<Vec<Property>, E> {
    let convention = &declared.convention;
    let plans = CONTACT_KINDS.map(|kind| Plan::new(kind, convention));
    let turning = experiments::turning(convention);
    let mut tests: Vec<ContactTest> = plans.iter().flat_map(Plan::tests).copied().collect();
    tests.push(turning);
    let motions = run(&tests)?;
    let outcomes: Vec<TestedMotion> = tests.iter().zip(&motions).collect();
    let clock = Clock::read(&outcomes);
    let turning = outcomes.last().map_or_else(Vec::new, |(test, motion)| {
        contact_rows(ContactKind::Pair, test, motion, &clock)
    });
    let mut unread = outcomes.as_slice();
    let laws = plans.map(|plan| {
        let (own, others) = unread.split_at(plan.tests().len());
        unread = others;
        plan.read(own, &turning, &clock)
    });

    let thresholds: Vec<Vec<ContactTest>> = laws.iter().map(Laws::threshold_tests).collect();
    let tests = thresholds.concat();
    let motions = run(&tests)?;
    let outcomes: Vec<TestedMotion> = tests.iter().zip(&motions).collect();
    let mut unread = outcomes.as_slice();
    let mut properties = clock.properties(declared);
    for (laws, thresholds) in laws.iter().zip(&thresholds) {
        let (own, others) = unread.split_at(thresholds.len());
        unread = others;
        properties.extend(laws.properties(own, &clock));
    }
    Ok(properties)
}
