//! The test vectors in `reference/vectors/`: made from the program, held to another program's numbers.
//!
//! `TRISTACK_UPDATE_GOLDEN=1 cargo test --test physics vectors` writes the files. The numbers of the second route stand in
//! `reference/golden/vector_*.csv`, made by `reference/golden/vectors.py`, which takes its inputs from the files. New
//! inputs are therefore written first, without an answer.

mod file;
mod inputs;
mod limits;
mod readme;
mod trajectories;
