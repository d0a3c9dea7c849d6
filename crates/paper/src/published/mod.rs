//! The authors' published data, the runs of their program that made it, and contradictions in it.

mod checkout;
mod contradictions;
mod given;
mod points;
mod repetition;

pub use checkout::{Checkout, DataFile, Printed, Subject};
pub use contradictions::{Contradiction, Quotation};
pub use given::{GivenCase, GivenOutcome};
pub use points::{
    ForceOrigin, PublishedForce, PublishedSeries, WALL_STARTS, published_forces, published_series,
};
pub use repetition::{ALIKE, Fit, Published, RepeatedForce, RepeatedSeries};
