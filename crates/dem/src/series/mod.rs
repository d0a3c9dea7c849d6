//! Time series with named columns, and the yield force derived from them.

mod column;
mod differences;
mod digits;
mod drop;
mod estimate;
mod frame;
mod header;
mod mechanics;
mod motion;
mod oscillator;
mod pair_contact;
mod polynomial;
mod pyramid_run;
mod rebound;
mod reported;
mod sample;
mod samples;
mod summary;

pub use column::Column;
pub use digits::PrintedDigits;
pub use digits::{ENOUGH_DIGITS, EXACT_DIGITS, decimal, most_digits};
pub use drop::DropWatch;
pub use estimate::{Departure, Estimate, YieldEstimates};
pub use frame::{ContactPoint, Frame, Frames, Partner, PlacedBody};
pub use header::Header;
pub use header::{ColumnSource, ColumnSources};
pub use mechanics::{Deviation, MechanicalLaw, Mechanics};
pub use motion::{BodyRow, Motion, MotionRow, RowInSpace};
pub use oscillator::left_of_touch;
pub use polynomial::{value_at_zero, weights_at_zero};
pub use pyramid_run::PyramidRun;
pub use rebound::Rebound;
pub use reported::not_tested;
pub use sample::{FloorContact, Placement, Sample};
pub use samples::{NotFinite, Series, SeriesError};
pub use summary::Summary;
