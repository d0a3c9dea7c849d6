//! Theory against other routes to the same numbers, and over its whole domain.

mod closed_form;
mod domain;
mod fixed_spring;
mod golden;
mod regime_map;
mod spheres;
