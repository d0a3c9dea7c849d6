//! Native stepping and what is read off a series, as physics; the digest of their sources.

mod balance_of_forces;
mod lanes;
mod source_digest;
