//! The contact convention of a code, measured by micro-tests of one contact each.
//!
//! The declaration of the code serves for comparison alone. Mass, inertia and the times of velocities follow from free
//! motion; stiffness, damping and arms from linear regression of the reported forces on the reported motion. If the law
//! is right, only rounding remains, or what vanishes with the time step.

mod beside;
mod clock;
mod contact_frame;
mod convergence;
mod cycle;
mod experiments;
mod finding;
mod growth;
mod linear_form;
mod measured;
mod measured_arms;
mod micro_tests;
mod no_contact;
mod normal;
mod other_model;
mod passport;
mod passport_file;
mod plan;
mod power;
mod probe;
mod properties;
mod regression;
mod rounding;
mod settle;
mod settled;
mod shape;
mod sliding;
mod space;
mod spring_shape;
mod tangential;

pub(crate) use convergence::{VANISHING, converged};
pub(crate) use experiments::turning;
pub(crate) use finding::{DAMPING_VELOCITY_LAG, FORCE_LAG, LIMIT_DAMPING_SHARE, OVERLAP_LEAD};
pub use finding::{Finding, StepEffect, TOLERANCE, step_effects};
pub use measured::in_single_precision;
pub use measured::{
    Findings, ProbeError, Probed, contradiction, contradictions, probe_all, probe_records,
    read_probe,
};
pub(crate) use measured::{arms_are_measured, forces_are_late, is_contradicted, other_program};
pub use measured_arms::{MeasuredArms, UnusablePassport};
pub(crate) use micro_tests::ask;
pub use no_contact::NO_CONTACT;
pub use passport::{ArmEffects, MeasuredKey, PASSPORT, Passport, passport, reservations};
pub(crate) use passport_file::schema_of;
pub use passport_file::{
    ArmEffect, KeyRow, PassportFile, PropertyRow, UnreadablePassport, permanent_name, plain,
};
pub(crate) use probe::ROUNDS;
pub use probe::probe;
pub(crate) use regression::fit_rows;
pub(crate) use rounding::Rounding;
pub(crate) use settle::settled_by_files;
pub use settle::{Settling, settle, settled_by};
