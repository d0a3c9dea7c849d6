//! The force at which three stacked elastic frictional cylinders slide apart, without time stepping.
//!
//! Two cylinders lie on a rough floor and touch; a third lies on them and is pressed down. The yield force is the load
//! at which the lower two slide apart (arXiv:2511.06807). It follows from floor friction μ, cylinder friction μ_d,
//! stiffness 1/ε = k_n r/(m g) and stiffness ratio κ = k_n/k_t, and from the treatment of torque and spring in a
//! contact:
//!
//! ```
//! use tristack_theory::model::{ContactConvention, Problem, Stack};
//! use tristack_theory::theory::quasistatic_limit;
//!
//! let problem = Problem::new(Stack::paper(0.3, 1e4), ContactConvention::PAPER)?;
//! let limit = quasistatic_limit(&problem);
//! assert!((limit.yield_force.unwrap() - 2118.9646).abs() < 1e-4); // in m g
//! # Ok::<(), tristack_theory::model::InvalidValue>(())
//! ```
//!
//! [`model`] holds stack, contact law and convention, and [`Problem`](model::Problem), a stack under a convention, both
//! checked; [`theory`] the limit and the events on the way to it; [`experiment`] the same for real cylinders, from
//! Young's modulus to newton. Nothing here reads a file or a command line.
//!
//! Two features, both off by default: `schema` derives JSON schemas for everything in a case file; `units` parses
//! quantities as people write them ("1 MPa").

pub mod experiment;
pub mod model;
pub mod theory;
