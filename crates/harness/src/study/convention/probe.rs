//! The probe of a code: two rounds of micro-tests, and the properties that follow from them.

use super::clock::Clock;
use super::contact_frame::contact_rows;
use super::cycle;
use super::experiments::{self, ContactKind};
use super::finding::{Property, RADIUS, SPRING_RADIUS, TOLERANCE};
use super::plan::{Laws, MicroTests, TestedMotion};
use super::space;
use super::tangential::radii_apart;
use crate::code::Declaration;
use crate::model::ContactTest;
use crate::series::Motion;

/// Beginning of the names of properties of spheres, after the kind of contact.
const IN_SPACE: &str = "space_";

const CONTACT_KINDS: [ContactKind; 3] = [ContactKind::Pair, ContactKind::Floor, ContactKind::Wall];

/// Number of rounds of micro-tests: the speed at which a contact reaches the slip threshold must be measured first.
pub const ROUNDS: usize = 2;

/// Measures every property of the contacts of a code at the time step of the micro-tests, and pairs it with what is
/// `declared` of it. `run` carries out micro-tests; it is called `ROUNDS` times.
///
/// # Errors
/// Those of `run`.
pub fn probe<E>(
    declared: &Declaration,
    run: impl FnMut(&[ContactTest]) -> Result<Vec<Motion>, E>,
) -> Result<Vec<Property>, E> {
    let properties = measure(declared, 1, 1, run)?;
    Ok(without_consequences(with_one_radius(properties)))
}

/// Measures all properties by micro-tests whose time steps are divided by `divisor`. Motions are cut off after multiples
/// of `grain` of their steps.
pub(super) fn measure<E>(
    declared: &Declaration,
    divisor: u64,
    grain: u64,
    mut run: impl FnMut(&[ContactTest]) -> Result<Vec<Motion>, E>,
) -> Result<Vec<Property>, E> {
    let convention = &declared.convention;
    let plans = CONTACT_KINDS.map(|kind| MicroTests::new(kind, convention));
    let turning = experiments::turning(convention);
    let mut tests: Vec<ContactTest> = plans.iter().flat_map(MicroTests::tests).copied().collect();
    tests.push(turning);
    let free = tests.len();
    tests.extend(cycle::tests(convention));
    let in_the_plane = tests.len();
    if declared.in_space {
        tests.extend(space::tests(convention));
    }
    let refined = |tests: Vec<ContactTest>| -> Vec<ContactTest> {
        let tests = tests.iter();
        tests
            .map(|test| experiments::refined(test, divisor))
            .collect()
    };
    let tests = refined(tests);
    let motions = run(&tests)?;
    let outcomes: Vec<TestedMotion> = tests.iter().zip(&motions).collect();
    let (outcomes, of_spheres) = outcomes.split_at(in_the_plane);
    let (outcomes, driven) = outcomes.split_at(free);
    let clock = Clock::read(outcomes, grain);
    let turning = outcomes.last().map_or_else(Vec::new, |(test, motion)| {
        contact_rows(ContactKind::Pair, test, motion, &clock)
    });
    let mut unread = outcomes;
    let laws = plans.map(|plan| {
        let (own, others) = unread.split_at(plan.tests().len());
        unread = others;
        plan.read(own, &turning, &clock)
    });

    let of = |kind: ContactKind| {
        let index = CONTACT_KINDS.iter().position(|own| *own == kind)?;
        Some(&laws[index])
    };
    let in_space = space::properties(of_spheres, &clock, declared);
    let cycles = cycle::properties(driven, &clock, |kind| of(kind).map(Laws::tangential));
    let floor_ratio = floor_ratio(of, declared);
    let near_slip: Vec<Vec<ContactTest>> = laws.iter().map(Laws::threshold_tests).collect();
    let tests = refined(near_slip.concat());
    let motions = run(&tests)?;
    let outcomes: Vec<TestedMotion> = tests.iter().zip(&motions).collect();
    let mut unread = outcomes.as_slice();
    let mut properties = clock.properties(declared);
    for (laws, tests) in laws.iter().zip(&near_slip) {
        let (own, others) = unread.split_at(tests.len());
        unread = others;
        properties.extend(laws.properties(own, &clock));
    }
    properties.extend(floor_ratio.into_iter().chain(cycles));
    properties.extend(in_space);
    let properties = properties.into_iter();
    let properties = properties.map(|own| own.unless_left_out(&declared.left_out));
    Ok(properties.collect())
}

/// `properties` without those in space of contacts whose law differs from the declared one. The tests in space take the
/// law as declared, so that all deviations there would follow from that.
pub(super) fn without_consequences(properties: Vec<Property>) -> Vec<Property> {
    let differs = CONTACT_KINDS.map(|kind| {
        let mut own = properties
            .iter()
            .filter(|own| is_of(kind, own) && !is_in_space(own));
        own.any(Property::differs)
    });
    let follows = |own: &Property| {
        let mut kinds = CONTACT_KINDS.into_iter().zip(differs);
        is_in_space(own) && kinds.any(|(kind, differs)| differs && is_of(kind, own))
    };
    properties.into_iter().filter(|own| !follows(own)).collect()
}

/// `properties` without the radii from the growth of springs that are those of the torque.
pub(super) fn with_one_radius(properties: Vec<Property>) -> Vec<Property> {
    let named = |name: &str| properties.iter().find(|own| own.name == name);
    let is_seen = |own: &Property| {
        let Some(kind) = own.name.strip_suffix(SPRING_RADIUS) else {
            return true;
        };
        let of_torque = named(&format!("{kind}{RADIUS}"));
        of_torque.is_some_and(|torque| radii_apart(torque.measured, own.measured) > TOLERANCE)
    };
    let seen = properties.iter().filter(|own| is_seen(own));
    seen.cloned().collect()
}

/// Whether it is a property of a contact of spheres.
fn is_in_space(own: &Property) -> bool {
    let mut kinds = CONTACT_KINDS.into_iter();
    kinds.any(|kind| {
        own.name
            .starts_with(&format!("{}_{IN_SPACE}", kind.as_str()))
    })
}

fn is_of(kind: ContactKind, own: &Property) -> bool {
    own.name.starts_with(kind.as_str())
}

/// K of the floor over K of pairs, where the law is any power.
fn floor_ratio<'a>(
    laws: impl Fn(ContactKind) -> Option<&'a Laws>,
    declared: &Declaration,
) -> Option<Property> {
    let of = |kind| laws(kind)?.power_stiffness();
    let ratio = of(ContactKind::Floor)?.over(of(ContactKind::Pair)?);
    let declared = declared.convention.law.floor_ratio;
    Some(Property::new("floor_ratio", ratio, declared))
}
