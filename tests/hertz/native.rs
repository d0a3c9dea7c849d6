//! The native DEM against the limit.
